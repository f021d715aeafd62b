//! What may make a picture mislead: one sentence each, with what to try.

use super::Plan;
use crate::scene::Scene;
use crate::scene::settings::{Filter, VolumeTexture};
use crate::scene::texture::{TextureChoice, Within};
use crate::structure::cells::any_interesting;

/// The warnings of a plan: of the volume's file, of a picture that is bound to be empty, of an imprecise texture.
pub fn warnings(scene: &Scene, plan: &Plan) -> Vec<String> {
    let mut warnings = scene.field.volume.warnings.clone();
    warnings.extend(empty(scene, plan));
    warnings.extend(plan.texture.and_then(|texture| imprecise(scene, &texture)));
    warnings
}

/// Why nothing can show, where that is certain.
fn empty(scene: &Scene, plan: &Plan) -> Option<String> {
    let field = &scene.field;
    if plan.passes == 0 {
        let (eye, target) = (scene.settings.camera.eye, scene.settings.camera.target);
        return Some(format!(
            "the picture is empty: from the eye {eye:?} towards {target:?} no ray meets the volume; it lies about 0,0,0 \
             and its longest side is 1"
        ));
    }
    if any_interesting(scene) {
        return None;
    }
    if scene.transfer.knots().iter().all(|knot| knot.opacity == 0.0) {
        return Some(format!("the picture is empty: the transfer function {} has no opacity", scene.transfer.name));
    }
    let count = field.values.len();
    if field.missing == count {
        return Some(format!(
            "the picture is empty: all {count} voxels are NaN, infinite or no data; check --no-data and --nan"
        ));
    }
    if field.holes.as_ref().is_some_and(|holes| holes.iter().all(|hole| *hole)) {
        return Some(format!(
            "the picture is empty: every cell has one of {} voxels that are NaN, infinite or no data; try --nan replace",
            field.missing
        ));
    }
    let [low, high] = field.range;
    let [least, most] = field.extremes().map(|x| low + (high - low) * f64::from(x));
    Some(if field.has_empty_range() {
        format!(
            "the picture is empty: the scalar range is the one value {low}, where x is 0 and the transfer function {} \
             shows nothing; give another --range",
            scene.transfer.name
        )
    } else {
        format!(
            "the picture is empty: values run from {least} to {most}, and over the scalar range {low} to {high} the \
             transfer function {} shows nothing there; try --range {least},{most}",
            scene.transfer.name
        )
    })
}

/// That the texture is less precise than was asked for, with how much.
fn imprecise(scene: &Scene, texture: &TextureChoice) -> Option<String> {
    let settings = &scene.settings;
    if texture.error <= settings.volume.precision {
        return None;
    }
    let named = settings.volume.texture != VolumeTexture::Auto;
    let exact = {
        let mut other = scene.clone();
        other.settings.sampling.filter = Filter::Exact;
        other.settings.volume.texture = VolumeTexture::Auto;
        TextureChoice::of(&other).error
    };
    let advice = match settings.sampling.filter {
        Filter::Hardware if exact <= settings.volume.precision => "--filter exact holds it",
        _ if named => "try --texture auto",
        _ => "a wider --range would help",
    };
    let bound = if texture.error.is_finite() {
        format!("is off by up to {}", Within(texture.error))
    } else {
        "is off by an amount that has no bound".to_owned()
    };
    Some(format!(
        "with the volume kept as {} an interpolated x {bound}, more than the {} asked for; {advice}",
        texture.name(),
        Within(settings.volume.precision)
    ))
}
