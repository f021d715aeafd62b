//! What is to be known of a picture: what was done to its volume, and what may make it mislead, with what to try.

use super::Plan;
use crate::part::rows::Traversal;
use crate::projection;
use crate::scene::mesh::ClipMesh;
use crate::scene::range::RangeEnd;
use crate::scene::settings::{Accumulate, Filter, Find, ShellMode, VolumeTexture};
use crate::scene::shells::ShellDepth;
use crate::scene::texture::{TextureChoice, Within};
use crate::scene::view::View;
use crate::scene::{ClipPlanes, Scene};
use crate::structure::cells::any_interesting;

/// The warnings of a plan: of the volume's file, of a picture that is bound to be empty, of an imprecise texture, of values
/// that the picture's format cannot hold.
pub fn warnings(scene: &Scene, plan: &Plan) -> Vec<String> {
    let mut warnings = scene.field.volume.warnings.clone();
    warnings.extend(scene.polygons.warnings.clone());
    warnings.extend(scene.clip_volume.iter().flat_map(|clip| clip.warnings.clone()));
    warnings.extend(scene.environment.iter().flat_map(|environment| environment.warnings.clone()));
    warnings.extend(scene.effect.iter().flat_map(|effect| effect.warnings.clone()));
    warnings.extend(scene.polygons.clips().iter().filter_map(open_clip));
    let shells = scene.shells.iter().filter(|_| !plan.method.takes_samples());
    warnings.extend(shells.flat_map(|shells| shells.warnings(&scene.field)));
    warnings.extend(empty(scene, plan));
    warnings.extend(black(scene, plan));
    warnings.extend(not_told_apart(scene, plan));
    warnings.extend(plan.texture.and_then(|_| imprecise(scene, &TextureChoice::of(scene))));
    warnings.extend(rounded_beside_gradients(scene));
    warnings.extend(plan.method.on_device.then(|| out_of_format(scene, plan)).flatten());
    warnings
}

/// What was done to the volume before it was drawn.
pub fn notes(scene: &Scene) -> Vec<String> {
    let mut notes = scene.field.volume.notes.clone();
    let ([low, high], asked) = (scene.field.range, scene.settings.volume.range);
    if let Some(ends) = asked.filter(|ends| ends.iter().any(|end| matches!(end, RangeEnd::Percentile(_)))) {
        notes.push(format!("the scalar range {} to {} is {low} to {high}", ends[0], ends[1]));
    }
    notes.extend(scene.clip_volume.iter().map(|clip| clip.words()));
    if scene.field.missing > 0 {
        let becomes = match scene.field.holes {
            Some(_) => "cells with one are transparent",
            None => "NaN, no data and -inf stand for the low end of the range, +inf for the high end",
        };
        notes.push(format!(
            "{} not finite, or no data: {becomes}",
            match scene.field.is_of_mesh() {
                true => counted(scene.field.missing, "point is", "points are"),
                false => counted(scene.field.missing, "voxel is", "voxels are"),
            }
        ));
    }
    notes
}

/// Why nothing can show, where that is certain.
fn empty(scene: &Scene, plan: &Plan) -> Option<String> {
    let field = &scene.field;
    if scene.polygons.show() || scene.backdrop.is_some() {
        return None;
    }
    if plan.passes == 0 && plan.method.traversal == Traversal::Shells && plan.view.region.pixels() > 0 {
        return Some(no_shell(scene));
    }
    if plan.passes == 0 {
        let (eye, target) = (scene.settings.camera.eye, scene.settings.camera.target);
        let sides = field.extent().to_array().map(|side| format!("{side:.3}")).join(" x ");
        if cut_off(scene) {
            return Some(format!(
                "the picture is empty: clip planes leave less than one sample of the volume on any ray from the eye {eye:?}; it lies \
                 about 0,0,0 with the sides {sides}, and a plane [nx, ny, nz, d] keeps what has n . p + d >= 0: turn its signs, give \
                 another d or a smaller --step"
            ));
        }
        return Some(format!(
            "the picture is empty: from the eye {eye:?} towards {target:?} no ray meets the volume, which lies about 0,0,0 \
             with the sides {sides}; choose another --eye or --target, or more pixels (--viewport)"
        ));
    }
    // Where values are shown the box is opaque everywhere.
    if projection::of(&scene.settings).shows_values() || any_interesting(scene) {
        return None;
    }
    if scene.surface.is_some() && field.missing < field.values.len() {
        return Some(no_surface(scene));
    }
    if scene.surface.is_none() && scene.transfer.knots().iter().all(|knot| knot.opacity == 0.0) {
        return Some(format!("the picture is empty: the transfer function {} has no opacity", scene.transfer.name));
    }
    let count = field.values.len();
    if field.missing == count {
        let each = if field.is_of_mesh() { "point" } else { "voxel" };
        return Some(format!(
            "the picture is empty: every {each} is NaN, infinite or no data; check --no-data and --nan"
        ));
    }
    if field.holes.as_ref().is_some_and(|holes| holes.iter().all(|hole| *hole)) {
        return Some(format!(
            "the picture is empty: every cell has one of {} NaN, infinite or no data; try --nan replace",
            counted(field.missing, "voxel that is", "voxels that are")
        ));
    }
    let [low, high] = field.range;
    let transfer = &scene.transfer.name;
    if field.has_empty_range() {
        return Some(format!(
            "the picture is empty: the scalar range is the one value {low}, where x is 0 and the transfer function \
             {transfer} shows nothing; give another --range"
        ));
    }
    let [least, most] = field.value_extremes().unwrap_or(field.range);
    let between = if scene.settings.sampling.filter == Filter::Nearest { ", none between them" } else { "" };
    let (values, advice) = match least == most {
        true => (format!("every value is {least}"), String::new()),
        false => (format!("values run from {least} to {most}{between}"), format!(", or --range {least},{most}")),
    };
    Some(format!(
        "the picture is empty: {values}, and over the scalar range {low} to {high} the transfer function {transfer} shows \
         nothing there; try another --tf{advice}"
    ))
}

/// Why there is no shell to be seen.
fn no_shell(scene: &Scene) -> String {
    let all_left_out = scene.shells.as_ref().is_some_and(|shells| shells.list.is_empty() && shells.empty.is_empty());
    let why = match all_left_out {
        true => "all shells are left out; give fewer numbers in shells.disabled (--shell-disabled)",
        false => "no value of the volume reaches the level of any shell; give lower levels (--shell-levels)",
    };
    format!("the picture is empty: {why}")
}

/// That all shells are black.
fn black(scene: &Scene, plan: &Plan) -> Option<String> {
    let shells = scene.shells.as_ref().filter(|_| !plan.method.takes_samples() && plan.passes > 0)?;
    if shells.mode == ShellMode::Surface {
        return None;
    }
    let settings = &scene.settings.shells;
    let why = match () {
        () if shells.list.iter().all(|shell| shell.emission == 0.0) => {
            "all levels are at the low end of the scalar range, where emission is 0; give another --range or higher levels"
        }
        () if settings.a == 0.0 && settings.beta0 + settings.b == 0.0 => {
            "the depth cue is 0; give --shell-a, --shell-b or --shell-beta0 above 0"
        }
        () => return None,
    };
    Some(format!("the picture is black: {why}"))
}

/// How near to each other a shell and a surface may lie, in volume space, before it is of interest that none is told to be in front.
const HARDLY_APART: f64 = 1e-3;

/// That depths of shells and of surfaces among them hardly differ, where depth is brightness.
fn not_told_apart(scene: &Scene, plan: &Plan) -> Option<String> {
    let among = scene.settings.shells.mode == Some(ShellMode::Max) && !scene.polygons.opaque().is_empty();
    if !among || plan.method.takes_samples() || plan.passes == 0 {
        return None;
    }
    let apart = ShellDepth::of(scene, &plan.view.rays)?.told_apart();
    (apart > HARDLY_APART).then(|| {
        format!(
            "surfaces may show through shells, or the other way round: at the far end of the volume they are told apart from {apart:.1e} of its \
             longest side on alone; give a larger shells.a (--shell-a), or move the eye out of the volume"
        )
    })
}

/// That no value is on any surface of a scene.
fn no_surface(scene: &Scene) -> String {
    let (field, surface) = (&scene.field, &scene.settings.surface);
    let of_shell = scene.shells.as_ref().filter(|shells| shells.mode == ShellMode::Surface);
    let asked =
        surface.asked().into_iter().map(|level| level.iso).chain(of_shell.and_then(|shells| shells.outermost()));
    let asked: Vec<String> = asked.map(|iso| iso.to_string()).collect();
    let [least, most] = field.value_extremes().unwrap_or(field.range);
    let asked = asked.join(", ");
    let values = match least == most {
        true => format!("every value is {least}"),
        false => format!("values run from {least} to {most}"),
    };
    if field.has_empty_range() && least < most {
        let [low, _] = field.range;
        return format!(
            "the picture is empty: the scalar range is the one value {low}, which every voxel then has, and {asked} is not it, where \
             {values}; give another --range"
        );
    }
    match surface.find {
        Find::Crossing => {
            let option = if of_shell.is_some() { "lower --shell-levels" } else { "a smaller --iso" };
            format!("the picture is empty: no value reaches {asked}, where {values}; give {option}")
        }
        Find::Range => {
            let advice = "give another --iso, or a larger --iso-width";
            format!("the picture is empty: no value is in the range about {asked}, where {values}; {advice}")
        }
    }
}

/// Whether rays would have samples if it were not for clip planes.
fn cut_off(scene: &Scene) -> bool {
    if scene.clip_planes().is_empty() {
        return false;
    }
    let whole = Scene { planes: ClipPlanes::default(), ..scene.clone() };
    View::new(&whole).is_ok_and(|view| view.longest_samples > 0)
}

/// That a clip mesh has no inside of its own.
fn open_clip(clip: &ClipMesh) -> Option<String> {
    (clip.open_edges > 0).then(|| {
        format!(
            "the clip mesh {} is open at {}: what a ray enters without leaving it goes on without an end, and a ray that leaves \
             more often than it enters begins inside; close it, or turn its faces one way",
            clip.name,
            counted(clip.open_edges, "edge", "edges")
        )
    })
}

/// What is worth advising has an error that is so many times less.
const CLEARLY_LESS: f64 = 2.0;

/// That the texture is less precise than was asked for, with how much.
fn imprecise(scene: &Scene, texture: &TextureChoice) -> Option<String> {
    let settings = &scene.settings;
    if texture.error <= settings.volume.precision {
        return None;
    }
    let by = |filter: Filter| {
        let mut other = scene.clone();
        (other.settings.sampling.filter, other.settings.volume.texture) = (filter, VolumeTexture::Auto);
        TextureChoice::of(&other).error
    };
    let (auto, exact) = (by(settings.sampling.filter), by(Filter::Exact));
    let advice = if auto <= settings.volume.precision {
        format!("--texture auto is within {}", Within(auto))
    } else if settings.sampling.filter == Filter::Hardware && CLEARLY_LESS * exact < texture.error {
        format!("--filter exact is within {}", Within(exact))
    } else if CLEARLY_LESS * auto < texture.error {
        format!("--texture auto is within {}", Within(auto))
    } else {
        "a wider --range would help".to_owned()
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

/// That samples take their values from where they are less precise than was asked for.
fn rounded_beside_gradients(scene: &Scene) -> Option<String> {
    let (error, asked) = (scene.error_beside(), scene.settings.volume.precision);
    (error > asked).then(|| {
        format!(
            "beside gradients kept as {} an interpolated x is off by up to {}, more than the {} asked for; use --gradient-texture \
             rgba32f, --filter exact, or --gradients on-the-fly",
            scene.settings.shading.format.name(),
            Within(error),
            Within(asked)
        )
    })
}

/// That values are shown which the format of the picture may not hold.
fn out_of_format(scene: &Scene, plan: &Plan) -> Option<String> {
    let values = projection::of(&scene.settings).values.as_ref()?;
    let (name, [least, greatest]) = match scene.settings.image.accumulate {
        Accumulate::Rgba8 => ("rgba8", [0.0, 1.0]),
        Accumulate::Rgba16f => ("rgba16f", [-LARGEST_HALF, LARGEST_HALF]),
        Accumulate::Rgba32f => return None,
    };
    let lengths = f64::from(plan.view.longest_samples) * scene.settings.step() / scene.transfer.reference;
    let times = (values.magnification)(lengths);
    let [low, high] = scene.field.extremes().map(|x| f64::from(x) * times);
    (low < least || high > greatest).then(|| {
        format!(
            "the projection {} may come to values from {low} to {high}, and --accumulate {name} holds {least} to {greatest}; \
             use rgba32f, or another --range",
            projection::of(&scene.settings).name
        )
    })
}

/// The largest number of 16 bits.
const LARGEST_HALF: f64 = 65504.0;

/// `1 voxel is`, `3 voxels are`.
fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}
