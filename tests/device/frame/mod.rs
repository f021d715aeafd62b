//! Frames on a device: the law of skipping, equal counts, the f64 twins, the exact integral, and what a frame leaves
//! out.

mod features;
mod law;
mod orbit;
pub mod scenes;
mod truth;

use crate::harness::Test;

pub fn tests() -> Vec<Test> {
    [law::tests(), orbit::tests(), truth::tests(), features::tests()]
        .into_iter()
        .flatten()
        .map(|test| test.within("frame"))
        .collect()
}
