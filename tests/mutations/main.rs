//! Damaged files: whatever a file holds, it is read or refused, and what is read can be planned. What refuses it names it and
//! repeats little of it. Seeded, so that a failure comes again.

#[path = "../read/cell_samples.rs"]
mod cell_samples;
mod cells;
mod damage;
#[path = "../read/mesh_samples.rs"]
mod mesh_samples;
mod meshes;
mod nrrd;
mod plans;
mod raw;
mod text;

use depthleap::error::Error;

/// Inputs to each reader.
const INPUTS: usize = 100_000;

/// Whether an error names its input, and nothing of the input steers a terminal or fills it.
fn is_fit(error: &Error, input: &str) {
    let message = error.to_string();
    assert!(error.input.contains(input), "{input} is not named: {message}");
    assert!(!message.contains(char::is_control), "{message:?}");
    for part in [&error.input, &error.problem, &error.remedy] {
        assert!(!part.is_empty() && part.chars().count() <= 1001, "{} characters: {part}", part.chars().count());
    }
}
