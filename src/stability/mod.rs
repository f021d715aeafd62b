//! Stiff and extreme scenes, each with the picture it must give: from a closed form, the exact integral or the same sum in
//! f64. See [`battery()`] and [`judge()`].

mod battery;
mod case;
mod depth;
pub mod judge;
mod optical;
mod sampling;
mod transfer;
mod traps;
mod values;
mod views;

pub use battery::battery;
pub use case::{Case, Expect, Tolerance};
pub use judge::{Integrator, Outcome, Rendered, Verdict, judge};
