//! Ends of rays before they leave the volume.

use super::effect::EFFECT;
use super::reasons::never_ends;
use super::surface::ISO_SURFACE;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::projection::{self, Ends};
use crate::scene::gathered::Gathered;
use crate::scene::settings::Alpha;
use crate::scene::{Scene, TransferFunction};
use crate::twin::fused::blend_rounding;

/// Rays that need no further samples end there.
pub const EARLY_ENDS: Feature =
    Feature { without: Some("ENDLESS"), ..Feature::at(Hook::Decide, "early ends of rays", needed) };

fn needed(context: &Context) -> Result<(), Why> {
    if may_end(context) {
        return Ok(());
    }
    // A method that culls nothing ends nothing either.
    Err(if context.form.is_some() || context.method.loops() { never_ends(context).into() } else { Why::Untold })
}

/// Whether any ray may end early.
pub fn may_end(context: &Context) -> bool {
    let gathered = || Gathered::of(context.scene, context.view, context.passes);
    // Polygons and effects add to the opacity as much as they like.
    let adds = context.blends || context.has(&EFFECT);
    !context.plans() || rays_may_end(context.scene, context.has(&ISO_SURFACE), adds, gathered)
}

/// Whether any ray of a scene may end early: where its opacity comes above T, or as the projection has it. `surface`: rays look for
/// surfaces; `adds`: something adds to the opacity of the volume; `gathered`: the most that any ray gathers.
pub fn rays_may_end(scene: &Scene, surface: bool, adds: bool, gathered: impl FnOnce() -> Gathered) -> bool {
    match projection::of(&scene.settings).ends {
        // A surface is opaque.
        Ends::Opaque if surface || adds => scene.settings.sampling.termination < 1.0,
        Ends::Opaque => comes_above(scene, &gathered()),
        Ends::Reached => true,
        Ends::Never(_) => false,
    }
}

/// What f32 takes from a value by interpolation, or from an opacity by a sample: some units in the last place.
const ROUNDING: f64 = 1e-6;

/// Whether the opacity of any ray may come above T: a bound from the greatest opacity that any value has and what the longest ray
/// gathers, rounding included.
fn comes_above(scene: &Scene, longest: &Gathered) -> bool {
    let sampling = &scene.settings.sampling;
    // Opacities never exceed 1.
    if sampling.termination >= 1.0 {
        return false;
    }
    let [low, high] = scene.field.extremes().map(f64::from);
    let slack = scene.value_slack();
    let greatest = greatest_opacity(&scene.transfer, low - slack, high + slack);
    if greatest == 0.0 {
        return false;
    }
    // One more than there should be, whatever rounding does to the number of samples.
    let samples = longest.samples + 1.0;
    let clear = match sampling.alpha {
        Alpha::Exponential => {
            (longest.steps * scene.settings.step() / scene.transfer.reference * (-greatest).ln_1p()).exp()
        }
        Alpha::Paper => (samples * (-greatest).ln_1p()).exp(),
    };
    let rounding = longest.blends * f64::from(blend_rounding(scene.settings.image.accumulate)) + samples * ROUNDING;
    1.0 - clear + rounding > sampling.termination
}

/// The greatest opacity of any value from `low` to `high`.
fn greatest_opacity(transfer: &TransferFunction, low: f64, high: f64) -> f64 {
    // Interpolation may leave the range by its rounding.
    let by = ROUNDING * low.abs().max(high.abs());
    let (low, high) = (low - by, high + by);
    let inside = transfer.knots().iter().filter(|knot| low <= knot.x && knot.x <= high).map(|knot| knot.opacity);
    let ends = [low, high].map(|x| transfer.evaluate(x)[3]);
    inside.chain(ends).fold(0.0, f64::max)
}
