//! What a driver culls before shading, measured: mechanisms that reject fragments, held against shaders that may forbid to
//! do so early.
//!
//! The specification puts the depth bounds test after the shader and lets a driver run it before where nobody can tell;
//! it promises so only with `early_fragment_tests`. What a driver makes of that is asked here, case by case.
//!
//! 1. [`case`]: mechanism, shader, compare: a line of the table. [`depth`]: depths as formats keep them.
//! 2. [`rule`]: what each fragment has to leave behind, the one definition of right.
//! 3. [`rig`], with its [`pipelines`]: draws a case on a device. [`correct`]: what it leaves against the rule.
//! 4. [`measure`]: times and counts. [`statistics`], [`decide`]: from these to a verdict.
//! 5. [`run`]: all of it for a device. [`record`]: what came out, as it is kept; [`known`]: what came out before.

pub mod case;
pub mod correct;
pub mod decide;
pub mod depth;
pub mod known;
pub mod marks;
pub mod measure;
pub mod pattern;
pub mod pipelines;
pub mod record;
pub mod rig;
pub mod rule;
pub mod run;
pub mod statistics;

pub use case::{Case, CaseShader, Compare, History, Mechanism};
pub use correct::CaseFault;
pub use decide::{Culling, CullingVerdict};
pub use pattern::Pattern;
pub use record::Probe;
pub use rig::Rig;
