//! What single-pass methods do besides [Stegmaier05 §6]: light through surfaces, bent rays and what is behind the volume, held against
//! the same rays in f64.

use super::super::case::{Expect, ROUNDING, SAME_SUM, StabilityCase};
use crate::method::{SINGLE_PASS, SINGLE_PASS_COMPUTE, SINGLE_PASS_OMNI};
use crate::scene::settings::{LightSettings, Refine, Refraction, Settings, SurfaceLevel, Translucency};

const FAMILY: &str = "light through surfaces and bent rays";

/// A volume by the loop as it is, as a compute shader, and with leaps.
fn case(name: &str, builtin: &str) -> StabilityCase {
    StabilityCase::new(FAMILY, name, builtin)
        .by(&[SINGLE_PASS.name(), SINGLE_PASS_COMPUTE.name(), SINGLE_PASS_OMNI.name()])
        .preset("ramp")
        .expect(Expect::Sum, SAME_SUM)
}

/// Rays that bend, in front of a checker whose edges are at no pixel's centre.
fn bending(name: &str, builtin: &str, points: &[[f64; 2]]) -> StabilityCase {
    case(name, builtin).with(|s| {
        s.effects.refraction = Some(Refraction { points: points.to_vec() });
        (s.effects.behind, s.effects.background_squares) = (Some("checker".into()), 4.0);
    })
}

/// Sheets that let something through, in one light.
fn sheets(name: &str, levels: usize, change: impl FnOnce(&mut Settings)) -> StabilityCase {
    let level = |i: usize| SurfaceLevel {
        iso: 0.05 + 0.9 * i as f64 / levels as f64,
        opacity: 0.5 / levels as f64,
        ..SurfaceLevel::default()
    };
    case(name, "gaussian:24").with(|s| {
        (s.surface.levels, s.surface.refine) = ((0..levels).map(level).collect(), Refine::Exact);
        s.lights = vec![LightSettings { direction: Some([1.0, 2.0, 3.0]), ..LightSettings::default() }];
        change(s);
    })
}

pub fn cases() -> Vec<StabilityCase> {
    vec![
        sheets("a sheet", 1, |_| {}),
        sheets("as many sheets as there may be", 64, |_| {}),
        sheets("sheets in the shadow of each other, without a bias", 3, |s| {
            (s.effects.shadows, s.effects.shadow_bias) = (true, 0.0);
        }),
        sheets("light that a hair of the volume takes away", 1, |s| {
            s.effects.translucency = Some(Translucency { absorption: 1e6, part: 1.0 });
        }),
        sheets("light that nothing takes away", 2, |s| {
            s.effects.translucency = Some(Translucency { absorption: 0.0, part: 0.5 });
        }),
        bending("an index of 1", "gaussian:24", &[[0.0, 1.0], [1.0, 1.0]]).with(|s| s.method.planner = false),
        bending("an index of 100 everywhere", "gaussian:24", &[[0.0, 100.0], [1.0, 100.0]])
            .with(|s| s.method.planner = false),
        bending("an index that changes by a millionth", "gaussian:24", &[[0.0, 1.0], [1.0, 1.000_001]]),
        bending("a lens", "gaussian:24", &[[0.0, 1.0], [1.0, 1.3]]),
        bending("a lens that scatters", "gaussian:24", &[[0.0, 1.0], [1.0, 0.7]]),
        bending("a lens, in steps of half a volume", "gaussian:24", &[[0.0, 1.0], [1.0, 1.1]])
            .with(|s| s.sampling.step = 12.0),
        bending("a lens, in steps of a tenth of a voxel", "gaussian:12", &[[0.0, 1.0], [1.0, 1.2]])
            .with(|s| s.sampling.step = 0.1),
        bending("a constant volume on a slope of the index", "constant:8", &[[0.0, 1.0], [1.0, 1.5]]),
        bending("one voxel", "constant:1", &[[0.0, 1.0], [1.0, 1.5]]),
        bending("from within", "gaussian:24", &[[0.0, 1.0], [1.0, 1.3]])
            .with(|s| (s.camera.eye, s.camera.target) = ([0.05, 0.1, 0.2], [-0.3, 0.1, -0.4])),
        bending("an index of 0", "gaussian:12", &[[0.0, 1.0], [1.0, 0.0]])
            .expect(Expect::Refused("effects.refraction"), ROUNDING),
        bending("an index that is no number", "gaussian:12", &[[0.0, f64::NAN]])
            .expect(Expect::Refused("effects.refraction"), ROUNDING),
        bending("an index that jumps", "gaussian:12", &[[0.5, 1.0], [0.5, 1.5]])
            .expect(Expect::Refused("effects.refraction"), ROUNDING),
        case("a checker at the volume itself", "gaussian:24")
            .with(|s| s.effects.behind = Some("checker".into()))
            .with(|s| (s.effects.background_distance, s.effects.background_squares) = (0.0, 3.0)),
    ]
}
