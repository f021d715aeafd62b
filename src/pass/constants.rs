//! Specialization constants that no feature sets, by the shader header that declares them.

use crate::part::Constant;
use crate::part::rows::Context;
use crate::scene::Scene;
use crate::scene::slices::SliceSurface;

/// M, of `frame.glsl`.
pub fn samples(scene: &Scene) -> Constant {
    ("SAMPLES_PER_PASS", scene.settings.sampling.samples_per_pass)
}

/// Of `projection.glsl`: how samples become a pixel.
pub fn projection(context: &Context) -> Constant {
    ("PROJECTION", context.projection().code)
}

/// Of passes that look ahead: a sample stands for all values up to the next one.
pub fn spans(scene: &Scene) -> Constant {
    ("SPANS", u32::from(scene.spans()))
}

/// Of `mark.glsl`: how marks that are copied are written.
pub fn depth_bits(scene: &Scene) -> Constant {
    ("DEPTH_BITS", scene.settings.method.depth.bits())
}

/// Of `slices.glsl`: on which surfaces slices lie, by the codes there.
pub fn slice_surface(context: &Context) -> Constant {
    let code = match context.view.slices.as_ref().map(|slices| slices.surface) {
        Some(SliceSurface::Axis(axis)) => axis as u32,
        Some(SliceSurface::Depth) | None => 3,
        Some(SliceSurface::Distance) => 4,
    };
    ("SLICE_SURFACE", code)
}
