//! What each experiment makes of its record, and the battery of stiff scenes.

mod accuracies;
mod accuracy_surfaces;
mod compares;
mod folders;
mod orbits;
mod probes;
mod reproduce;
mod reproduce_rates;
#[path = "../measure/runs.rs"]
mod runs;
mod stability;
