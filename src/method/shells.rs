//! `shells`: nested iso-surfaces of an emissive volume as flat polygons [Heidrich95 §2].

use super::rows::{RAY_CASTER, peel, takes_in_passes};
use crate::error::{Error, Result};
use crate::feature::START;
use crate::part::rows::{Context, Method, Traversal};
use crate::part::steps::Steps;
use crate::pass::{direction, entry, layer, lighting, shells, start};
use crate::scene::Scene;
use crate::scene::settings::{Accumulate, Filter, Find, ShellMode, ShellOrder, ShellSum};
use crate::scene::shells::ShellDepth;

pub const SHELLS: Method = Method {
    name: "shells",
    about: "Nested iso-surfaces of an emissive volume as polygons, their greatest emission, the sum, or the outermost in light",
    source: "Heidrich95",
    takes,
    papers: None,
    forms: Vec::new,
    ends_rays: false,
    traversal: Traversal::Shells,
    steps: draw,
    ..RAY_CASTER
};

/// Takes emissive volumes with opaque polygons.
fn takes(scene: &Scene) -> Result<()> {
    takes_in_passes(scene)?;
    let settings = &scene.settings.shells;
    let method = || format!("--method {}", scene.settings.method.name);
    let Some(mode) = settings.mode else {
        return Err(Error::usage(
            method(),
            "does not know what to make of shells",
            "use --shells max, --shells sum, or --shells surface",
        ));
    };
    let refused = |problem: &str, remedy: &str| Err(Error::usage(method(), problem, remedy));
    let (polygons, opaque) = (&scene.polygons, !scene.polygons.opaque().is_empty());
    let one_sided = || polygons.materials.iter().any(|material| material.is_opaque() && !material.two_sided);
    match () {
        () if scene.surface.is_some() && mode != ShellMode::Surface => {
            refused("draws no iso-surfaces but shells", "use --shells surface, or leave the surface out (--iso)")
        }
        () if !scene.clip_planes().is_empty() || !polygons.clips().is_empty() => {
            refused("draws whole shells, which nothing cuts", "use a ray caster, or leave out [[clip]] (--clip-plane)")
        }
        () if mode == ShellMode::Surface && scene.settings.surface.find == Find::Range => refused(
            "draws the surface of a value, and surface.find (--find range) asks for all values about it",
            "use crossing, or a ray caster",
        ),
        () if !polygons.transparent().is_empty() => refused(
            "blends shells in no order, among which transparent polygons have no place [Heidrich95 §4]",
            "make the meshes opaque, or use a ray caster",
        ),
        () if opaque && one_sided() => refused(
            "draws polygons into the depth buffer from both sides, and the backs of a mesh do not show (two_sided = false)",
            "let them show, or use a ray caster",
        ),
        () if scene.settings.sampling.filter == Filter::Nearest => refused(
            "draws surfaces between voxels, and --filter nearest has nothing between them",
            "use --filter exact or hardware, or a ray caster",
        ),
        () if mode == ShellMode::Max && opaque && settings.a == 0.0 => Err(Error::usage(
            "shells.a (--shell-a) 0",
            "gives a shell and the surfaces in it one depth, so that neither hides the other [Heidrich95 equation 5]",
            "give a above 0, such as 0.001, or leave the meshes out",
        )),
        () if mode == ShellMode::Max && opaque && settings.order == ShellOrder::Brightest => Err(Error::usage(
            "shells.order (--shell-order) brightest",
            "lets surfaces in the depth of a bright shell hide the dim ones in front of them [Heidrich95 §4]",
            "use auto or dimmest, or leave the meshes out",
        )),
        () if mode == ShellMode::Sum && settings.sum == ShellSum::Lengths => takes_lengths(scene),
        () => Ok(()),
    }
}

/// Takes scenes in which ways through shells may be counted from where they are entered and left.
fn takes_lengths(scene: &Scene) -> Result<()> {
    let refused = |problem: &str, remedy: &str| Err(Error::usage("shells.sum (--shell-sum) lengths", problem, remedy));
    match () {
        () if scene.settings.image.accumulate != Accumulate::Rgba32f => refused(
            "takes the ways to where a ray enters from those to where it leaves, for which there are no digits but in rgba32f",
            "use --accumulate rgba32f, or --shell-sum crossings",
        ),
        () if scene.field.holes.is_some() => refused(
            "asks for shells that are closed, and there are holes in this volume, at which they are open",
            "use --nan replace, or --shell-sum crossings",
        ),
        () if !scene.polygons.opaque().is_empty() && begins_within(scene) => refused(
            "does not know which shells rays begin within that a surface ends, and the eye, or its near plane, is in the volume",
            "move the eye out of it, leave the meshes out, or use --shell-sum crossings",
        ),
        () => Ok(()),
    }
}

/// Whether rays begin within the volume.
fn begins_within(scene: &Scene) -> bool {
    let rays = scene.camera.rays(scene.settings.image.size).ok();
    rays.and_then(|rays| Some(ShellDepth::of(scene, &rays)?.is_within(&rays))).unwrap_or(false)
}

/// Surfaces, then the shells in their order; those that hide what is behind them once more before each shell, in its depth.
fn draw(context: &Context, steps: &mut Steps) {
    let settings = &context.scene.settings.shells;
    if settings.mode == Some(ShellMode::Surface) {
        return draw_outermost(context, steps);
    }
    steps.extend(context.has(&START).then(start::black));
    peel(context, steps);
    steps.enter(0, None);
    steps.extend(context.opaque.then(|| layer::opaque_first(context)));
    let greatest = settings.mode == Some(ShellMode::Max);
    if context.opaque && !greatest && context.passes > 0 {
        steps.push(shells::surfaces(context, None));
    }
    let brightest_first = match settings.order {
        ShellOrder::Auto => greatest && !context.opaque,
        ShellOrder::Brightest => true,
        ShellOrder::Dimmest => false,
    };
    let numbers = |i: u32| if brightest_first { context.passes - 1 - i } else { i };
    for number in (0..context.passes).map(numbers).filter(|number| has_polygons(context, *number)) {
        steps.extend((context.opaque && greatest).then(|| shells::surfaces(context, Some(number))));
        steps.push(shells::shell(context, number));
    }
}

/// The outermost shell and surfaces hide each other; then it is lit as where rays meet it.
fn draw_outermost(context: &Context, steps: &mut Steps) {
    if context.passes > 0 {
        steps.push(entry::entry(context));
        steps.push(direction::direction(context));
    }
    peel(context, steps);
    steps.enter(0, None);
    if context.passes > 0 {
        steps.extend(context.opaque.then(|| shells::surfaces(context, None)));
        steps.push(shells::shell(context, 0));
        steps.push(lighting::of_polygons(context));
    }
    steps.extend(context.opaque.then(|| layer::opaque(context)));
}

/// Whether there is anything of a shell to be drawn.
fn has_polygons(context: &Context, number: u32) -> bool {
    let (shells, field) = (&context.scene.shells, &context.scene.field);
    shells.as_ref().is_some_and(|shells| shells.count_of(number as usize, field)[1] > 0)
}
