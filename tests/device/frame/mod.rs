//! Frames on a device: the law of skipping, equal counts, the f64 twins, the exact integral, and what a frame leaves
//! out.

mod features;
#[path = "../../plan/lacking.rs"]
mod lacking;
mod law;
mod orbit;
mod planner;
mod projections;
pub mod scenes;
mod textures;
mod truth;

use crate::harness::Test;

pub fn tests() -> Vec<Test> {
    [
        law::tests(),
        orbit::tests(),
        truth::tests(),
        features::tests(),
        planner::tests(),
        textures::tests(),
        projections::tests(),
    ]
    .into_iter()
    .flatten()
    .map(|test| test.within("frame"))
    .collect()
}
