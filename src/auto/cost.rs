//! What work costs: constants in nanoseconds of CPU time, fitted to frames that were measured on llvmpipe of Mesa 22.3
//! (`benches/results/lavapipe-22.3/auto.md` says how, and which of them were set by hand). [`DeviceCosts`] says how far those of a device
//! differ from them.

use super::device_costs::{DeviceCosts, KINDS, Way};
use super::tunings::Tuning;
use super::work::Work;
use crate::part::rows::{Ahead, Method};
use crate::projection;
use crate::scene::Scene;
use crate::scene::settings::{Distance, Gradients};
use crate::structure::blocks::BLOCK;

/// Nanoseconds for one of each thing that a frame does.
struct Costs {
    frame: f64,
    pass: f64,
    pixel: f64,
    /// A pixel of a pass, whether its fragment is culled or not.
    covered: f64,
    main: f64,
    sample: SampleCosts,
    intermediate: f64,
    /// Looking up a block, or a distance.
    block: f64,
    distance: f64,
    /// What a look-up takes more for each doubling of the bytes of a structure beyond [`OF_CACHES`]: rays beside each other look at places
    /// that are farther apart than their samples.
    distance_of_twice: f64,
    /// What rays that look for surfaces take more: a pixel, and a main fragment.
    surface: [f64; 2],
}

/// Nanoseconds for a sample, by what is made of it.
struct SampleCosts {
    color: f64,
    /// All colours from one value to the next.
    preintegrated: f64,
    /// A projection of values.
    value: f64,
    /// A look for a surface.
    surface: f64,
    /// What a fetch takes more for each doubling of the texels beyond [`CACHED`]: fewer are found in the caches.
    of_twice: f64,
}

/// A loop that holds a ray. As compute shaders they take as long, give or take what scenes do not explain.
const LOOP: Costs = Costs {
    frame: 4.5e5,
    pass: 0.0,
    pixel: 20.0,
    covered: 0.0,
    main: 0.0,
    sample: SampleCosts { color: 5.7, preintegrated: 34.0, value: 6.0, surface: 84.0, of_twice: 0.63 },
    intermediate: 0.0,
    block: 12.5,
    distance: 8.2,
    distance_of_twice: 2.2,
    surface: [240.0, 0.0],
};

/// Main passes with intermediate ones between them.
const PASSES: Costs = Costs {
    frame: 5e5,
    pass: 1.8e5,
    pixel: 8.0,
    covered: 2.9,
    main: 24.0,
    sample: SampleCosts { color: 5.8, preintegrated: 26.5, value: 5.9, surface: 8.2, of_twice: 0.68 },
    intermediate: 11.0,
    block: 64.0,
    distance: 13.0,
    distance_of_twice: 3.6,
    surface: [240.0, 6.0],
};

/// Main passes that decide where rays go on.
const FUSED: Costs = Costs {
    pass: 1.4e5,
    pixel: 5.0,
    covered: 2.5,
    main: 18.0,
    sample: SampleCosts { color: 6.2, preintegrated: 27.0, value: 7.0, surface: 16.0, of_twice: 0.68 },
    intermediate: 4.5,
    block: 0.0,
    distance: 18.0,
    distance_of_twice: 5.5,
    surface: [160.0, 2.0],
    ..PASSES
};

/// Slices, which are blended sample by sample.
const SLICES: Costs = Costs {
    pass: 3.8e5,
    pixel: 0.0,
    covered: 0.0,
    main: 18.0,
    sample: SampleCosts { color: 9.3, preintegrated: 36.0, value: 0.5, surface: 0.0, of_twice: 1.2 },
    intermediate: 30.0,
    block: 87.0,
    distance: 45.0,
    distance_of_twice: 8.7,
    surface: [0.0; 2],
    ..PASSES
};

/// Texels of a texture that stays in the caches.
const CACHED: f64 = (1 << 15) as f64;

/// By how many times what a fetch takes more for its texture's size grows for each doubling of the texels from a ray to the next beyond one:
/// rays have fewer lines of memory in common.
const APART: f64 = 1.15;

/// Bytes of a structure that stays in the caches.
const OF_CACHES: f64 = (1 << 20) as f64;
/// Bytes of a cell that tells octants apart.
const OCTANT_BYTES: f64 = 8.0;

/// The part of a sample's colour that each further fetch is taken to cost, which was not measured.
const FETCH_SHARE: f64 = 0.4;

/// Fetches of a gradient in the shader: one on each side along each axis.
const GRADIENT_FETCHES: f64 = 6.0;

/// Milliseconds that a frame takes on a device with such costs, estimated.
pub fn frame_ms(method: &Method, tuning: Tuning, work: &Work, scene: &Scene, device: &DeviceCosts) -> f64 {
    let factors = device.of(Way::of(method)).in_order();
    frame_parts(method, tuning, work, scene).iter().zip(factors).map(|(ms, factor)| ms * factor).sum()
}

/// What a frame takes by the constants as they are, in milliseconds, by the kinds of work that devices differ in: see
/// [`super::device_costs::Factors`].
pub fn frame_parts(method: &Method, tuning: Tuning, work: &Work, scene: &Scene) -> [f64; KINDS] {
    let costs = match Way::of(method) {
        Way::Loops => &LOOP,
        Way::Passes => &PASSES,
        Way::Fused => &FUSED,
        Way::Slices => &SLICES,
    };
    let [each, of_shown] = fetches(scene);
    let voxels = scene.field.values.len() as f64;
    let apart = (voxels.cbrt() / work.met.max(1.0).sqrt()).log2().max(0.0);
    let far = costs.sample.of_twice * (voxels / CACHED).log2().max(0.0) * (1.0 + APART * apart);
    let sample = sample(&costs.sample, scene) + far + costs.sample.color * FETCH_SHARE * each;
    let [surface_pixel, surface_main] = if scene.surface.is_some() { costs.surface } else { [0.0; 2] };
    let lookup = match method.skips_blocks() {
        true => costs.block,
        false => {
            let cells = voxels / f64::from(tuning.cell).powi(3);
            let octants = method.ahead == Ahead::Distances(Distance::Directional);
            let bytes = if octants { OCTANT_BYTES * cells } else { cells };
            costs.distance + costs.distance_of_twice * (bytes / OF_CACHES).log2().max(0.0)
        }
    };
    let fragments = [
        (costs.pixel + surface_pixel, work.pixels),
        (costs.covered, work.pixels * work.passes),
        (costs.main + surface_main, work.main_lanes),
        (costs.intermediate, work.intermediate_lanes),
    ];
    let shown = costs.sample.color * FETCH_SHARE * of_shown * work.shown;
    [
        costs.frame + costs.pass * work.passes,
        fragments.iter().map(|(cost, number)| cost * number).sum(),
        sample * work.samples + shown,
        lookup * work.lookups,
    ]
    .map(|ns: f64| NANOSECONDS * ns)
}

/// In milliseconds.
const NANOSECONDS: f64 = 1e-6;

/// Nanoseconds for a sample of a scene.
fn sample(costs: &SampleCosts, scene: &Scene) -> f64 {
    match () {
        () if scene.surface.is_some() => costs.surface,
        () if projection::of(&scene.settings).shows_values() => costs.value,
        () if scene.settings.sampling.preintegrates() => costs.preintegrated,
        () => costs.color,
    }
}

/// Fetches that each sample takes beyond its value, and those that one which shows takes besides.
fn fetches(scene: &Scene) -> [f64; 2] {
    let extra = f64::from(scene.settings.sampling.extra_fetches);
    // A surface is lit once for a ray.
    let lit = scene.reads_gradients() && scene.surface.is_none();
    let on_the_fly = lit && scene.settings.shading.gradients != Gradients::Precomputed;
    [extra, if on_the_fly { GRADIENT_FETCHES } else { 0.0 }]
}

/// Nanoseconds a voxel to find ranges of blocks, and a cell to find distances.
const RANGE: f64 = 4.0;
const OMNI: f64 = 12.0;
const DIRECTIONAL: f64 = 43.0;
const ALONG: f64 = 110.0;

/// Milliseconds to build what a method looks up on a device with such costs, estimated.
pub fn build_ms(method: &Method, tuning: Tuning, scene: &Scene, device: &DeviceCosts) -> f64 {
    let voxels = scene.field.values.len() as f64;
    let side = f64::from(tuning.cell);
    let of_cells = |each: f64| {
        let ranges = if tuning.cell > 1 { RANGE * voxels } else { 0.0 };
        ranges + each * voxels / (side * side * side)
    };
    NANOSECONDS
        * device.builds
        * match method.ahead {
            Ahead::Nothing => 0.0,
            Ahead::Blocks => RANGE * voxels + voxels / (BLOCK * BLOCK * BLOCK) as f64,
            Ahead::Distances(Distance::Omni) => of_cells(OMNI),
            Ahead::Distances(Distance::Directional) => of_cells(DIRECTIONAL),
            Ahead::Distances(Distance::Optimal | Distance::Cone) => of_cells(ALONG),
        }
}

/// Whether so many frames that each take so many milliseconds less save more than the host takes to find the ranges of all voxels.
pub fn ranges_pay(saved_ms: f64, voxels: f64, frames: u32) -> bool {
    saved_ms * f64::from(frames) > NANOSECONDS * RANGE * voxels
}

/// How many of so many frames are served by what a method builds: all of them, or one, where it is made for a view that changes.
pub fn served(method: &Method, frames: u32, moving: bool) -> u32 {
    let for_a_view = matches!(method.ahead, Ahead::Distances(Distance::Optimal | Distance::Cone));
    if moving && for_a_view { 1 } else { frames.max(1) }
}
