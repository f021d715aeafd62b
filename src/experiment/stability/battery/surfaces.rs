//! Iso-surfaces and lights, held against the same rays in f64.

use super::super::case::{Expect, ROUNDING, SAME_SUM, StabilityCase};
use crate::scene::Volume;
use crate::scene::settings::{
    Find, GradientOperator, GradientTexture, Gradients, LightSettings, Refine, Settings, ShadingSettings,
};
use crate::scene::volume::Voxels;

const SURFACES: &str = "surfaces and lights";

/// A surface of a built-in volume, found to the root.
fn surface(name: &str, builtin: &str, iso: f64) -> StabilityCase {
    StabilityCase::new(SURFACES, name, builtin).expect(Expect::Sum, SAME_SUM).with(|s| {
        (s.surface.iso, s.surface.refine, s.sampling.termination) = (Some(iso), Refine::Exact, 0.9);
    })
}

/// The same in one light.
fn lit(name: &str, change: impl FnOnce(&mut LightSettings)) -> StabilityCase {
    let mut light = LightSettings { direction: Some([1.0, 2.0, 3.0]), specular: 0.6, ..LightSettings::default() };
    change(&mut light);
    surface(name, "gaussian:24", 0.1).with(|s| s.lights = vec![light])
}

/// 12^3 bytes, by their place along x.
fn along_x(name: &str, value: impl Fn(usize) -> u8) -> Option<Volume> {
    const SIDE: usize = 12;
    let voxels = (0..SIDE * SIDE * SIDE).map(|i| value(i % SIDE)).collect();
    Volume::new(name, [SIDE; 3], [1.0; 3], Voxels::U8(voxels)).ok()
}

fn of_voxels(name: &str, iso: f64, value: impl Fn(usize) -> u8) -> Option<StabilityCase> {
    Some(surface(name, "constant:2", iso).voxels(along_x(name, value)?))
}

fn precomputed(gradient: GradientOperator, texture: GradientTexture) -> ShadingSettings {
    ShadingSettings { gradients: Gradients::Precomputed, gradient, format: texture }
}

/// A value that grows to 1e38 with its place in a list of 12^3.
fn huge(i: usize) -> f32 {
    1e38 * (i % 12) as f32 / 11.0
}

/// A surface that shows nothing but what it reflects.
fn mirror(name: &str, builtin: &str, iso: f64) -> StabilityCase {
    surface(name, builtin, iso)
        .with(|s| (s.environment.builtin, s.environment.reflectivity) = (Some("sky".to_owned()), 1.0))
}

pub fn cases() -> Vec<StabilityCase> {
    let from_low = |s: &mut Settings| s.camera.eye = [-1.5, 0.4, 0.6];
    let volumes = [
        of_voxels("a plateau of the very value", 120.0, |x| if x < 6 { 20 } else { 120 }),
        of_voxels("a plateau of the very value, from within", 120.0, |x| if x < 6 { 120 } else { 20 }),
        of_voxels("a sheet of one voxel, thinner than a step", 100.0, |x| if x == 5 { 200 } else { 0 })
            .map(|case| case.with(|s| s.sampling.step = 3.7)),
        of_voxels("a range that no voxel is in", 100.0, |x| if x < 6 { 0 } else { 255 })
            .map(|case| case.with(|s| (s.surface.find, s.surface.iso_width) = (Find::Range, Some(4.0)))),
        // Within what rounding may move a value, and beyond.
        of_voxels("a value a hair above all there are", 200.000_01, |x| if x == 5 { 200 } else { 0 }),
        of_voxels("a value above all there are", 200.01, |x| if x == 5 { 200 } else { 0 }),
        of_voxels("gradients in 8 bits of a plateau", 120.0, |x| if x < 6 { 20 } else { 120 })
            .map(|case| case.with(|s| s.shading = precomputed(GradientOperator::Sobel, GradientTexture::Rgba8))),
        Volume::new("values to 1e38", [12; 3], [1.0; 3], Voxels::F32((0..12 * 12 * 12).map(huge).collect())).ok().map(
            |volume| {
                surface("gradients of values to 1e38", "constant:2", 2e37).voxels(volume).with(|s| {
                    s.shading = precomputed(GradientOperator::Central, GradientTexture::Rgba16f);
                })
            },
        ),
    ];
    let mut cases = vec![
        surface("the value of a voxel", "linear:25", 0.5).with(from_low),
        surface("on the face where rays enter", "linear:24", 0.0).with(from_low),
        surface("on the face where rays leave", "linear:24", 1.0).with(from_low),
        surface("a constant volume above the value", "constant:8", 0.4),
        surface("a constant volume of the value", "constant:8", 0.5),
        surface("a constant volume below the value", "constant:8", 0.6),
        surface("rays that touch a surface", "gaussian:40", 0.2)
            .with(|s| (s.camera.eye, s.camera.fov_y) = ([0.0, 0.0, 1.9], 30.0)),
        surface("ripples", "marschner-lobb:40", 0.5),
        surface("not refined", "marschner-lobb:40", 0.5).with(|s| s.surface.refine = Refine::None),
        surface("refined evenly", "marschner-lobb:40", 0.5).with(|s| s.surface.refine = Refine::Linear),
        surface("steps of half a volume", "gaussian:24", 0.1).with(|s| s.sampling.step = 12.0),
        surface("steps of a hundredth of a voxel", "gaussian:12", 0.1).with(|s| s.sampling.step = 0.01),
        mirror("a mirror of the sky", "gaussian:40", 0.2),
        mirror("a mirror of the sky in ripples", "marschner-lobb:40", 0.5),
        mirror("a mirror without a normal, which reflects nothing", "constant:8", 0.4),
        mirror("a mirror of which the part 1.5 is to be reflected", "gaussian:12", 0.2)
            .with(|s| s.environment.reflectivity = 1.5)
            .expect(Expect::Refused("environment.reflectivity"), ROUNDING),
        lit("a light behind", |light| light.direction = Some([-1.0, -1.0, -2.0])),
        lit("a light on the surface", |light| (light.direction, light.position) = (None, Some([0.0, 0.0, 0.236]))),
        lit("a light in the eye", |light| {
            (light.direction, light.position) = (None, Some([0.8974, 0.6533, 1.5544]));
        }),
        lit("a light 1e12 away", |light| (light.direction, light.position) = (None, Some([1e12, 2e12, 1e12]))),
        lit("shininess 0", |light| light.shininess = 0.0),
        lit("shininess 10^4", |light| light.shininess = 1e4),
        lit("a direction of length 1e-300", |light| light.direction = Some([1e-300, 0.0, 2e-300])),
        lit("no direction", |light| light.direction = Some([0.0; 3]))
            .expect(Expect::Refused("light.direction"), ROUNDING),
        lit("a place that is no number", |light| light.direction = Some([f64::NAN, 0.0, 1.0]))
            .expect(Expect::Refused("light.direction"), ROUNDING),
        StabilityCase::new(SURFACES, "samples where nothing changes", "constant:12")
            .points(&[[0.0, 0.8, 0.6, 0.3, 0.05]])
            .with(|s| s.lights = vec![LightSettings { direction: Some([0.0, 1.0, 1.0]), ..LightSettings::default() }]),
        StabilityCase::new(SURFACES, "samples of ripples", "marschner-lobb:24")
            .preset("ramp")
            .with(|s| s.lights = vec![LightSettings { position: Some([0.4, 1.0, 1.0]), ..LightSettings::default() }]),
        StabilityCase::new(SURFACES, "samples of ripples by gradients in 8 bits", "marschner-lobb:24")
            .preset("ramp")
            .with(|s| {
                s.lights = vec![LightSettings { position: Some([0.4, 1.0, 1.0]), ..LightSettings::default() }];
                s.shading = precomputed(GradientOperator::Central, GradientTexture::Rgba8);
            }),
    ];
    cases.extend(volumes.into_iter().flatten());
    cases
}
