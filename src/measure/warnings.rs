//! What may make a run's picture mislead: what its plan says, and what the picture itself shows.

use super::picture::Picture;
use crate::feature::EARLY_ENDS;
use crate::math::ray::ViewRay;
use crate::plan::{self, Plan};
use crate::projection::{self, Ends};
use crate::resource;
use crate::scene::Scene;
use crate::scene::settings::Shows;
use crate::truth::importance::Importance;

/// The warnings of a run, a sentence each; with the importance volume of adaptive steps, where there is one.
pub fn warnings(scene: &Scene, plan: &Plan, picture: &Picture, importance: Option<&Importance>) -> Vec<String> {
    let mut warnings = plan::warnings(scene, plan);
    let known_empty = warnings.iter().any(|warning| warning.starts_with("the picture is empty"));
    if !known_empty && picture.pixels.iter().all(|pixel| pixel[3] == 0.0) {
        warnings.push(
            match scene.settings.clips[..] {
                [] => "the picture is empty: what shows lies out of view or between samples; try another view or a smaller --step",
                _ => "the picture is empty: what shows is clipped, out of view or between samples; try another [[clip]] or view",
            }
            .to_owned(),
        );
    }
    warnings.extend(layers_left(scene, plan));
    warnings.extend(uncovered(scene, plan));
    warnings.extend(background_left(scene, plan));
    warnings.extend(no_numbers(scene, picture));
    warnings.extend(clipped(scene, picture));
    warnings.extend(importance.and_then(|importance| beyond_tolerance(scene, importance)));
    warnings
}

/// That adaptive steps leave more error than is asked for, as short as they may be.
fn beyond_tolerance(scene: &Scene, importance: &Importance) -> Option<String> {
    let settings = &scene.settings.adaptive;
    (importance.error > settings.tolerance).then(|| {
        format!(
            "adaptive steps down to {} voxels are off from the exact integral by up to {:.1e}, and a tolerance of {:.1e} is asked for; \
             give shorter ones (--shortest)",
            settings.shortest, importance.error, settings.tolerance
        )
    })
}

/// That more surfaces lie behind each other than are peeled.
fn layers_left(scene: &Scene, plan: &Plan) -> Option<String> {
    let most = scene.settings.layers.most;
    let lacking = scene.polygons.lacking(&plan.view.rays, plan.view.size, most);
    let (pixels, layers) = (lacking.iter().filter(|n| **n > 0).count(), lacking.iter().max().copied().unwrap_or(0));
    let of = match scene.polygons.clips() {
        [] => "layers of transparent polygons",
        _ => "layers of transparent polygons and clip geometry",
    };
    (pixels > 0).then(|| {
        let number = |n: usize, one: &str, more: &str| if n == 1 { format!("1 {one}") } else { format!("{n} {more}") };
        format!(
            "{} {of}, up to {}, since {most} are peeled: what lies behind is drawn, or clipped, as if they were not there; raise layers.most (--layers)",
            number(pixels, "pixel lacks", "pixels lack"),
            number(layers as usize, "layer", "of them"),
        )
    })
}

/// That clip geometry which cuts in front of its first surface does not cover the volume.
fn uncovered(scene: &Scene, plan: &Plan) -> Option<String> {
    let rays = &plan.view.rays;
    let meets = |ray: &ViewRay| scene.interval(ray, rays.near).is_some();
    let pixels = scene.polygons.uncovered(rays, plan.view.size, meets);
    (pixels > 0).then(|| {
        format!(
            "clip geometry does not cover the volume in {pixels} {} of its box, where nothing of the volume is drawn; make it \
             larger, or use clip.keep = \"inside\" or \"outside\"",
            if pixels == 1 { "pixel" } else { "pixels" }
        )
    })
}

/// How much of the background stays where rays end early.
fn background_left(scene: &Scene, plan: &Plan) -> Option<String> {
    let settings = &scene.settings;
    let termination = settings.sampling.termination;
    // Surfaces are opaque to the bit.
    let by_opacity = projection::of(settings).ends == Ends::Opaque && scene.surface.is_none();
    let ends_rays = match plan.method.loops() {
        true => plan.method.ends_rays && !plan.left_out.iter().any(|left_out| left_out.what == EARLY_ENDS.name),
        false => plan.steps.iter().any(|step| step.accesses.iter().any(|access| access.resource == resource::STORED)),
    };
    let ends = by_opacity && ends_rays;
    let seen = settings.image.background.iter().any(|channel| *channel != 0.0);
    let left = 100.0 * (1.0 - termination);
    (ends && seen && left > 0.0).then(|| {
        format!(
            "rays end at an opacity above {termination}, so that up to {left:.3} % of the background stays in what is opaque; \
             --termination 1 ends none early"
        )
    })
}

/// That an effect has left pixels that are no numbers.
fn no_numbers(scene: &Scene, picture: &Picture) -> Option<String> {
    let effect = scene.effect.as_ref()?;
    let pixels = picture.pixels.iter().filter(|pixel| !pixel.iter().all(|channel| channel.is_finite())).count();
    (pixels > 0).then(|| {
        let pixels = if pixels == 1 { "1 pixel is".to_owned() } else { format!("{pixels} pixels are") };
        format!("{pixels} not a number, or infinite: look for a division by 0 in the effect {}", effect.file())
    })
}

/// What is less than half a step of a byte beyond a PNG's least and greatest colour is lost in none.
const UNSEEN: f32 = 0.5 / 255.0;

/// That a PNG does not show all of the picture.
fn clipped(scene: &Scene, picture: &Picture) -> Option<String> {
    let colors = || picture.pixels.iter().flat_map(|pixel| &pixel[..3]).copied();
    let [least, greatest] = [colors().fold(0.0, f32::min), colors().fold(1.0, f32::max)];
    (least < -UNSEEN || greatest > 1.0 + UNSEEN).then(|| {
        let advice = match (&scene.surface, scene.lights.is_empty()) {
            _ if scene.effect.is_some() => ", or change the effect",
            (Some(_), _) if scene.settings.surface.shows != Shows::Color => "",
            (Some(_), _) if scene.environment.is_some() => ", or give weaker lights or a smaller --reflectivity",
            (_, false) => ", or give weaker lights",
            (Some(_), true) => ", or give darker colours of the surface",
            (None, true) => ", or give another --range",
        };
        format!("the picture's values run from {least} to {greatest}, and a PNG shows 0 to 1: write EXR or NPY{advice}")
    })
}
