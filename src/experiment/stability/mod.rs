//! Stiff and extreme scenes, each with the picture it must give: from a closed form, the exact integral or the same sum in
//! f64. See [`battery()`] and [`judge()`].

mod battery;
mod case;
mod device;
pub mod judge;
mod page;
mod record;
mod text;

pub use battery::battery;
pub use case::{Expect, StabilityCase, Tolerance};
pub use device::OnDevice;
pub use judge::{Integrator, Outcome, Rendered, StabilityVerdict, judge};
pub use page::page;
pub use record::{CaseRecord, FORMAT, Stability};
pub use text::{line, text};
