//! Every method on every scene: the table, the rows for spreadsheets and the report. Its record is
//! [`Results`](crate::measure::Results).

mod csv;
mod page;
mod scene;
mod text;

pub use csv::csv;
pub use page::{Difference, ReportInput, report_html};
pub use text::table;
