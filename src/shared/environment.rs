//! What shaders know of an environment besides its picture.

use glam::DMat3;

use crate::scene::Environment;

/// `EnvironmentPlace` of `glsl/shared/environment.glsl`: the rows of the turn to volume space, and the reflectivity.
pub fn environment_rows(environment: &Environment) -> [[f32; 4]; 4] {
    let turn = DMat3::from_quat(environment.turn);
    let row = |axis: usize| {
        let [x, y, z] = turn.row(axis).to_array().map(|part| part as f32);
        [x, y, z, 0.0]
    };
    [row(0), row(1), row(2), [environment.reflectivity as f32, 0.0, 0.0, 0.0]]
}
