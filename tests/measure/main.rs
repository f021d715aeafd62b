//! From counts, times and pictures to tables, JSON, CSV and the report.

mod pages;
mod pictures;
mod records;
mod runs;
