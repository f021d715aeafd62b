//! From records to tables, plots and the report.

mod choices;
mod growth;
mod pages;
#[path = "../measure/runs.rs"]
mod runs;
mod savings;
mod tables;
