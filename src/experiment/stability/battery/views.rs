//! Shapes of the volume, places of the eye, fields of view and pictures, in a medium whose rays' lengths are known.

use super::super::case::{Expect, ROUNDING, SAME_SUM, StabilityCase, Tolerance};
use crate::scene::Volume;
use crate::scene::settings::Settings;
use crate::scene::volume::Voxels;

const FORM: &str = "shape of the volume";
const VIEW: &str = "view";

/// A medium in a box of these voxels and spacings.
fn solid(name: &str, dims: [usize; 3], spacing: [f64; 3]) -> Option<StabilityCase> {
    let voxels = Voxels::F32(vec![0.5; dims.iter().product()]);
    let volume = Volume::new("voxels", dims, spacing, voxels).ok()?;
    // In the middle of the picture, whatever its shape.
    let sides: [f64; 3] = std::array::from_fn(|a| dims[a] as f64 * spacing[a]);
    let longest = sides.iter().copied().fold(0.0, f64::max);
    let shortest = sides.iter().copied().fold(longest, f64::min) / longest;
    let finest = spacing.iter().copied().fold(f64::INFINITY, f64::min) / longest;
    let case = StabilityCase::medium(FORM, name, "", 0.05).voxels(volume).with(|s| {
        // Steps of about a hundredth of the longest side.
        s.sampling.step = (0.01 / finest).max(1.0);
        s.transfer.reference = s.sampling.step;
        s.camera.fov_y = (60.0 * shortest.max(0.02)).min(60.0);
    });
    Some(case)
}

/// Rays along faces: of how long a ray is near an edge f32 knows less.
const GRAZING: Tolerance = Tolerance {
    absolute: 2e-5,
    relative: 5e-4,
    reason: "where a ray runs along a face, the rounding of its direction moves where it leaves",
};

/// From far away a pixel's ray is known to f32's digits of the distance alone, were it not for double-floats.
const FAR: Tolerance = Tolerance {
    absolute: 1e-6,
    relative: 5e-4,
    reason: "the eye is thousands of volumes away: double-floats keep 48 bits",
};

pub fn cases() -> Vec<StabilityCase> {
    let shapes = [
        ("1x1x1 voxels", [1, 1, 1], [1.0; 3]),
        ("50x1x1 voxels", [50, 1, 1], [1.0; 3]),
        ("1x50x1 voxels", [1, 50, 1], [1.0; 3]),
        ("1x1x50 voxels", [1, 1, 50], [1.0; 3]),
        ("30x30x1 voxels", [30, 30, 1], [1.0; 3]),
        ("2048x2x2 voxels", [2048, 2, 2], [1.0; 3]),
        ("spacing 1:1:2000", [6, 6, 6], [1.0, 1.0, 2000.0]),
        ("spacing 2000:2000:1", [6, 6, 6], [2000.0, 2000.0, 1.0]),
    ];
    let mut cases: Vec<StabilityCase> =
        shapes.into_iter().filter_map(|(name, dims, spacing)| solid(name, dims, spacing)).collect();
    let view = |name: &str, change: &dyn Fn(&mut Settings)| {
        StabilityCase::medium(VIEW, name, "constant:24", 0.03).with(change)
    };
    let eye = |eye: [f64; 3], target: [f64; 3]| move |s: &mut Settings| (s.camera.eye, s.camera.target) = (eye, target);
    let along = |case: StabilityCase| {
        case.expect(Expect::Beer { color: super::super::case::COLOR, opacity: 0.03, steps: None }, GRAZING)
    };
    cases.extend([
        view("eye inside", &eye([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4])),
        view("eye in the middle", &eye([0.0; 3], [0.3, 0.2, 0.4])),
        view("eye on a face", &eye([0.0, 0.0, 0.5], [0.1, 0.05, 0.0])),
        view("eye on an edge", &eye([0.5, 0.1, 0.5], [0.0, 0.05, 0.0])),
        view("eye on a corner", &eye([0.5, 0.5, 0.5], [0.0, 0.05, 0.1])),
        along(view("rays in a face", &eye([0.5, 0.2, 1.4], [0.5, 0.0, 0.0]))),
        along(view("rays along an edge", &eye([0.5, 0.5, 1.4], [0.5, 0.5, 0.0]))),
        view("rays from corner to corner", &eye([1.3, 1.3, 1.3], [0.0; 3])),
        view("rays along an axis", &eye([0.0, 0.0, 1.91], [0.0; 3])),
        along(view("rays nearly along an axis", &|s| {
            (s.camera.eye, s.camera.fov_y) = ([1e-4, 2e-4, 40.0], 1.0);
        })),
        view("eye 5000 away", &|s| (s.camera.eye, s.camera.fov_y) = ([3000.0, 2500.0, 3100.0], 0.02))
            .expect(Expect::Beer { color: super::super::case::COLOR, opacity: 0.03, steps: None }, FAR),
        view("looking away", &|s| (s.camera.eye, s.camera.target) = ([0.0, 0.1, 2.0], [0.0, 0.0, 5.0]))
            .expect(Expect::Nothing, SAME_SUM),
        view("looking away from a corner", &eye([0.5, 0.5, 0.5], [1.0, 1.2, 1.1])).expect(Expect::Nothing, SAME_SUM),
        view("passes forced that nothing needs", &|s| {
            (s.camera.eye, s.camera.target, s.sampling.passes) = ([0.0, 0.1, 2.0], [0.0, 0.0, 5.0], 5);
        })
        .expect(Expect::Nothing, SAME_SUM),
        view("field of view of 1", &|s| s.camera.fov_y = 1.0),
        view("field of view of 170", &|s| s.camera.fov_y = 170.0),
        view("field of view of 170 from inside", &|s| (s.camera.eye, s.camera.fov_y) = ([0.1, 0.05, 0.02], 170.0)),
        view("orthographic", &|s| s.camera.height = Some(1.3)),
        view("orthographic from inside", &|s| {
            (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4]);
            s.camera.height = Some(1.3);
        }),
        view("orthographic along an axis", &|s| {
            (s.camera.eye, s.camera.height) = ([0.0, 0.0, 1.4], Some(1.1));
        }),
        view("orthographic from 5000 away", &|s| {
            (s.camera.eye, s.camera.height) = ([3000.0, 2500.0, 3100.0], Some(1.8));
        })
        .expect(Expect::Beer { color: super::super::case::COLOR, opacity: 0.03, steps: None }, FAR),
        view("orthographic, a picture of a thousandth", &|s| {
            (s.camera.eye, s.camera.height) = ([1.3, 1.1, 0.9], Some(1e-3));
        }),
        view("one pixel", &|s| s.image.size = [1, 1]),
        view("1x64 pixels", &|s| s.image.size = [1, 64]),
        view("64x1 pixels", &|s| (s.image.size, s.camera.fov_y) = ([64, 1], 1.0)),
        view("no camera: the eye is where it looks", &eye([0.3; 3], [0.3; 3]))
            .expect(Expect::Refused("target"), ROUNDING),
    ]);
    cases
}
