//! Clip planes, in a medium whose rays' lengths are known.

use super::super::case::{Expect, ROUNDING, SAME_SUM, StabilityCase};
use crate::scene::settings::{ClipSettings, Offset};

const PLANES: &str = "clip planes";

/// A medium that is cut at planes, seen aslant.
fn cut(name: &str, planes: &[[f64; 4]]) -> StabilityCase {
    StabilityCase::medium(PLANES, name, "constant:24", 0.03).with(|s| {
        s.camera.eye = [0.9, 0.7, 1.5];
        s.clips = planes.iter().map(|plane| ClipSettings { plane: Some(*plane), ..ClipSettings::default() }).collect();
    })
}

pub fn cases() -> Vec<StabilityCase> {
    let slab = |half: f64| [[0.0, 0.0, 1.0, half], [0.0, 0.0, -1.0, half]];
    vec![
        cut("across the volume", &[[1.0, 0.3, -0.2, 0.1]]),
        cut("a slab thinner than a step", &slab(4e-3)),
        cut("a slab of 1e-6 of the side", &slab(5e-7)),
        cut("through the eye", &[[1.0, 0.0, -0.5, -0.15], [0.0, 1.0, -0.2, -0.4]]),
        cut("through the eye, along the middle of the picture", &[[1.5, 0.0, -0.9, 0.0]]),
        cut("in a face of the box", &[[0.0, 0.0, -1.0, 0.5]]),
        cut("a hair within a face of the box", &[[0.0, 0.0, -1.0, 0.499_999_9]]),
        cut("a corner", &[[1.0, 1.0, 1.0, -1.2]]),
        cut("a sharp wedge", &[[0.0, 1.0, 0.02, 0.01], [0.0, -1.0, 0.02, 0.01]]),
        cut(
            "six around the middle",
            &[
                [1.0, 0.1, 0.0, 0.2],
                [-1.0, 0.0, 0.1, 0.2],
                [0.1, 1.0, 0.0, 0.2],
                [0.0, -1.0, 0.1, 0.2],
                [0.0, 0.1, 1.0, 0.2],
                [0.1, 0.0, -1.0, 0.2],
            ],
        ),
        cut("normals of 1e-200 and 1e200", &[[1e-200, 0.0, 0.0, 1e-201], [0.0, -1e200, 1e200, 3e199]]),
        cut("seen from within", &[[0.0, 1.0, 0.0, 0.2], [0.0, -1.0, 0.3, 0.3]])
            .with(|s| (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4])),
        cut("the eye cut off within the box", &[[0.0, 1.0, 0.0, -0.2]])
            .with(|s| (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.1, 0.4, 0.1])),
        cut("all of it cut off", &[[1.0, 0.0, 0.0, -0.2], [-1.0, 0.0, 0.0, 0.1]]).expect(Expect::Nothing, SAME_SUM),
        cut("a slab between samples", &slab(4e-3))
            .with(|s| s.sampling.offset = Offset::Midpoint)
            .expect(Expect::Nothing, SAME_SUM),
        cut("no normal", &[[0.0, 0.0, 0.0, 1.0]]).expect(Expect::Refused("clip.plane"), ROUNDING),
    ]
}
