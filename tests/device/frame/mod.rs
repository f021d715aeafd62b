//! Frames on a device: every method in every form on tiny scenes (`matrix`); the law of skipping, the f64 twins and the exact
//! integral on larger ones; what a frame leaves out.

mod clips;
mod compare;
mod effects;
mod features;
#[path = "../../plan/lacking.rs"]
mod lacking;
mod law;
mod layers;
mod matrix;
#[path = "../../matrix/scenes.rs"]
mod matrix_scenes;
mod orbit;
mod planner;
mod projections;
pub mod recorded;
mod refraction;
pub mod scenes;
mod shells;
mod single_pass;
mod slices;
mod tetrahedra;
mod textures;
mod truth;

use crate::harness::Test;

pub fn tests() -> Vec<Test> {
    [
        matrix::tests(),
        law::tests(),
        layers::tests(),
        clips::tests(),
        orbit::tests(),
        truth::tests(),
        features::tests(),
        planner::tests(),
        recorded::tests(),
        textures::tests(),
        projections::tests(),
        single_pass::tests(),
        slices::tests(),
        shells::tests(),
        tetrahedra::tests(),
        effects::tests(),
        refraction::tests(),
    ]
    .into_iter()
    .flatten()
    .map(|test| test.within("frame"))
    .collect()
}
