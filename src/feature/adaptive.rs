//! Adaptive sampling (Weiler03 "Adaptive Sampling").

use super::cells::one_color;
use super::classification::CLASSIFICATION;
use crate::error::{Error, Result};
use crate::part::Constant;
use crate::part::rows::{Context, Feature, Hook, Why};
use crate::projection::{self, COMPOSITE};
use crate::resource;
use crate::scene::Scene;
use crate::scene::settings::{Alpha, Classification, Filter, Offset};

/// Steps as long as the importance volume allows, and what integrates them.
pub const ADAPTIVE: Feature = Feature {
    with: Some("ADAPTIVE"),
    constants: |context| match context.has(&ADAPTIVE) {
        true => vec![one_color(context), voxel_doublings(context.scene)],
        false => Vec::new(),
    },
    reads: |_| vec![resource::IMPORTANCE],
    ..Feature::at(Hook::Sample, "adaptive steps", needed)
};

fn needed(context: &Context) -> Result<(), Why> {
    match context.scene.settings.adaptive.importance {
        true => Ok(()),
        false if context.has(&CLASSIFICATION) => Err("all steps are alike".into()),
        false => Err(Why::Untold),
    }
}

/// Of `adaptive.glsl`.
fn voxel_doublings(scene: &Scene) -> Constant {
    ("VOXEL_DOUBLINGS", scene.settings.adaptive.voxel_doublings().into())
}

/// Takes scenes without adaptive steps.
///
/// # Errors
/// When the scene asks for them.
pub fn refuse(scene: &Scene) -> Result<()> {
    match scene.settings.adaptive.importance {
        false => Ok(()),
        true => Err(Error::usage(
            format!("--method {}", scene.settings.method.name),
            "takes steps that are all alike, and adaptive ones are asked for (adaptive.importance, --importance)",
            "use --method rc-ert, single-pass or single-pass+compute, or leave it out",
        )),
    }
}

/// Takes scenes with adaptive steps that go together with all else they ask for, and those without.
///
/// # Errors
/// When they do not.
pub fn check(scene: &Scene) -> Result<()> {
    let settings = &scene.settings;
    if !settings.adaptive.importance {
        return Ok(());
    }
    let refused = |input: &str, why: &str, remedy: &str| {
        let input = format!("adaptive.importance (--importance) with {input}");
        Err(Error::usage(input, why, remedy))
    };
    let sampling = &settings.sampling;
    match () {
        () if settings.adaptive.longest < settings.adaptive.shortest => refused(
            "--longest, --shortest",
            "the longest step is shorter than the shortest one",
            "give a longest step that is no shorter than the shortest one",
        ),
        () if projection::of(settings).name != COMPOSITE.name => refused(
            "projection.kind (--projection)",
            "lengths of steps follow from what the transfer function makes of values, and this projection shows values",
            "use --projection composite",
        ),
        () if sampling.classification == Classification::PreIntegrated => refused(
            "sampling.classification (--classification pre-integrated)",
            "its table is made for steps of one length, and adaptive steps are integrated exactly as it is",
            "use --classification post",
        ),
        () if sampling.alpha == Alpha::Paper => refused(
            "sampling.alpha (--alpha paper)",
            "opacities are taken as they stand, whatever the length of a step",
            "use exponential",
        ),
        () if sampling.filter == Filter::Nearest => refused(
            "sampling.filter (--filter nearest)",
            "a step takes the field for linear, and between nearest voxels it jumps",
            "use hardware or exact",
        ),
        () if sampling.offset != Offset::Left => refused(
            "sampling.offset (--offset midpoint)",
            "a step is integrated from its begin to its end, and has no sample in between",
            "use left",
        ),
        () if scene.field.holes.is_some() => {
            refused("volume.nan = \"hole\"", "a step may cross cells without values", "use nan = \"replace\"")
        }
        () if !scene.polygons.is_empty() || scene.clip_volume.is_some() => refused(
            "[[mesh]], [[clip]] with a mesh or a volume",
            "steps are not cut at surfaces among the voxels",
            "leave them out (planes cut rays as a whole, and may stay)",
        ),
        () if scene.surface.is_some() || settings.shells.mode.is_some() => refused(
            "[surface], [shells] (--iso, --shells)",
            "lengths of steps follow from colours, and a surface may lie within one",
            "leave them out",
        ),
        () if !scene.lights.is_empty() => {
            refused("[[light]]", "light asks for a gradient at each sample, and a step has none", "leave it out")
        }
        () if scene.environment.is_some() || scene.effect.is_some() || settings.effects.refraction.is_some() => {
            refused(
                "[environment], [effects]",
                "they are of samples and surfaces, and a step is integrated as a whole",
                "leave them out",
            )
        }
        () => Ok(()),
    }
}
