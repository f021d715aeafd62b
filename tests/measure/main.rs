//! From counts, times and pictures to tables, JSON, CSV and the report.

mod accuracies;
mod compares;
mod orbits;
mod pages;
mod pictures;
mod probes;
mod records;
mod reproduce;
mod runs;
mod savings;
