//! What work costs: constants in nanoseconds of CPU time, fitted to frames that were measured on llvmpipe of Mesa 22.3
//! (`benches/results/lavapipe-22.3/auto.md` says how, and which of them were set by hand). Other devices have none of their own: what
//! counts is the order of methods, and that is theirs where they spend their time alike.

use super::work::{Tuning, Work};
use crate::part::rows::{Ahead, Method, Traversal};
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
}

/// A loop that holds a ray. As compute shaders they take as long, give or take what scenes do not explain.
const LOOP: Costs = Costs {
    frame: 4.5e6,
    pass: 0.0,
    pixel: 20.0,
    covered: 0.0,
    main: 0.0,
    sample: SampleCosts { color: 4.5, preintegrated: 42.0, value: 4.5, surface: 100.0 },
    intermediate: 0.0,
    block: 15.0,
    distance: 7.5,
    distance_of_twice: 1.8,
    surface: [330.0, 0.0],
};

/// Main passes with intermediate ones between them.
const PASSES: Costs = Costs {
    frame: 4e6,
    pass: 5.5e5,
    pixel: 250.0,
    covered: 3.6,
    main: 110.0,
    sample: SampleCosts { color: 7.5, preintegrated: 75.0, value: 8.0, surface: 12.0 },
    intermediate: 125.0,
    block: 69.0,
    distance: 0.0,
    distance_of_twice: 8.0,
    surface: [240.0, 180.0],
};

/// Main passes that decide where rays go on.
const FUSED: Costs = Costs {
    pass: 6e5,
    pixel: 230.0,
    covered: 9.8,
    main: 140.0,
    sample: SampleCosts { color: 9.0, preintegrated: 80.0, value: 10.0, surface: 12.0 },
    intermediate: 100.0,
    block: 0.0,
    surface: [210.0, 340.0],
    ..PASSES
};

/// Slices, which are blended sample by sample.
const SLICES: Costs = Costs {
    frame: 2.4e6,
    pass: 3e5,
    pixel: 260.0,
    covered: 44.0,
    main: 49.0,
    sample: SampleCosts { color: 3.2, preintegrated: 120.0, value: 0.3, surface: 0.0 },
    intermediate: 79.0,
    block: 110.0,
    surface: [0.0; 2],
    ..PASSES
};

/// Nanoseconds that a fetch takes more for each doubling of the texels beyond [`CACHED`]: fewer are found in the caches.
const FETCH_OF_TWICE: f64 = 0.6;
/// Texels of a texture that stays in the caches.
const CACHED: f64 = (1 << 15) as f64;

/// Bytes of a structure that stays in the caches.
const OF_CACHES: f64 = (1 << 20) as f64;
/// Bytes of a cell that tells octants apart.
const OCTANT_BYTES: f64 = 8.0;

/// The part of a sample's colour that each further fetch is taken to cost, which was not measured.
const FETCH_SHARE: f64 = 0.4;

/// Fetches of a gradient in the shader: one on each side along each axis.
const GRADIENT_FETCHES: f64 = 6.0;

/// Milliseconds that a frame takes, estimated.
pub fn frame_ms(method: &Method, tuning: Tuning, work: &Work, scene: &Scene) -> f64 {
    let costs = match method.traversal {
        Traversal::FragmentLoop | Traversal::ComputeLoop => &LOOP,
        Traversal::Passes if method.fused => &FUSED,
        // Nobody weighs shells, or cells.
        Traversal::Passes | Traversal::Shells | Traversal::Cells(_) => &PASSES,
        Traversal::Slices(_) => &SLICES,
    };
    let [each, of_shown] = fetches(scene);
    let voxels = scene.field.values.len() as f64;
    let far = |texels: f64| FETCH_OF_TWICE * (texels / CACHED).log2().max(0.0);
    let sample = sample(&costs.sample, scene) + far(voxels) + costs.sample.color * FETCH_SHARE * each;
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
    let parts = [
        (costs.frame, 1.0),
        (costs.pass, work.passes),
        (costs.pixel + surface_pixel, work.pixels),
        (costs.covered, work.pixels * work.passes),
        (costs.main + surface_main, work.main_lanes),
        (sample, work.samples),
        (costs.sample.color * FETCH_SHARE * of_shown, work.shown),
        (costs.intermediate, work.intermediate_lanes),
        (lookup, work.lookups),
    ];
    NANOSECONDS * parts.iter().map(|(cost, number)| cost * number).sum::<f64>()
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

/// Milliseconds to build what a method looks up, estimated.
pub fn build_ms(method: &Method, tuning: Tuning, scene: &Scene) -> f64 {
    let voxels = scene.field.values.len() as f64;
    let side = f64::from(tuning.cell);
    let of_cells = |each: f64| {
        let ranges = if tuning.cell > 1 { RANGE * voxels } else { 0.0 };
        ranges + each * voxels / (side * side * side)
    };
    NANOSECONDS
        * match method.ahead {
            Ahead::Nothing => 0.0,
            Ahead::Blocks => RANGE * voxels + voxels / (BLOCK * BLOCK * BLOCK) as f64,
            Ahead::Distances(Distance::Omni) => of_cells(OMNI),
            Ahead::Distances(Distance::Directional) => of_cells(DIRECTIONAL),
            Ahead::Distances(Distance::Optimal | Distance::Cone) => of_cells(ALONG),
        }
}

/// Whether so many frames that each take so many milliseconds less save more than ranges of all voxels take to be found.
pub fn ranges_pay(saved_ms: f64, voxels: f64, frames: u32) -> bool {
    saved_ms * f64::from(frames) > NANOSECONDS * RANGE * voxels
}

/// How many of so many frames are served by what a method builds: all of them, or one, where it is made for a view that changes.
pub fn served(method: &Method, frames: u32, moving: bool) -> u32 {
    let for_a_view = matches!(method.ahead, Ahead::Distances(Distance::Optimal | Distance::Cone));
    if moving && for_a_view { 1 } else { frames.max(1) }
}
