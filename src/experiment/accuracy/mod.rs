//! Error against run time: pictures of many steps, held against the exact integral, and how fast their error falls.

mod explain;
mod fit;
mod page;
mod plot;
mod record;
mod text;

pub use explain::{expected_order, remarks};
pub use fit::{answers, fastest, fit, mark_pareto};
pub use page::page;
pub use plot::{step_svg, time_svg};
pub use record::{Accuracy, Curve, FORMAT, Fit, Point};
pub use text::{csv, text};
