//! What rows of methods have in common, and the orders of passes that several share.

use crate::error::{Error, Result};
use crate::feature::layers::{LAYER_BEFORE, LAYER_BEHIND, first_section};
use crate::feature::{APART, BATCH, CLIP_BEGIN, COUNTING, DECISIONS, EARLY_ENDS, ISO_SURFACE, MARK_COPIES, START};
use crate::feature::{BACKDROP, adaptive, cells, clip_volume, light_paths, refraction, surface};
use crate::geometry::rest_begins;
use crate::part::Step;
use crate::part::form::Form;
use crate::part::resource::Resource;
use crate::part::rows::{Ahead, Context, Method, Traversal};
use crate::part::steps::Steps;
use crate::pass::{
    alive, backdrop, clear, clip_begin, clip_winding, direction, entry, layer, lighting, main_pass, mark_copy, peel,
    slices, start,
};
use crate::scene::Scene;
use crate::scene::settings::{Cull, Mark};

/// Steps before the first main pass, and room for the uploads and builds that a plan puts in front of them: some thirty at
/// the most.
const STEPS_BEFORE: usize = 64;

/// The bound of main passes that are switched on and off only: rays that go on hold 0, others 0.5 or 1.
pub const SWITCH: f32 = 0.25;

/// The papers' form of the ray casters: the early z-test, and depth written by the shader [KW03 §2.1].
pub const EARLY_Z: Option<Form> = Some(Form { cull: Cull::Ztest, mark: Mark::Fragdepth });

/// The papers' form of near-neighbor skipping [Thesis §5.3].
pub const BOUNDS: Option<Form> = Some(Form { cull: Cull::Bounds, mark: Mark::Fragdepth });

/// A ray caster on a device that takes every scene without what one loop alone can do, ends rays and knows nothing of what lies
/// ahead.
pub const RAY_CASTER: Method = Method {
    name: "",
    about: "",
    source: "",
    takes: takes_in_passes,
    papers: EARLY_Z,
    forms: every_form,
    ends_rays: true,
    on_device: true,
    ahead: Ahead::Nothing,
    fused: false,
    traversal: Traversal::Passes,
    skips_of: None,
    steps: |context, steps| cast(context, steps, unswitched),
};

/// Takes every scene but those that ask for adaptive steps, or for what one loop alone can do.
pub fn takes_in_passes(scene: &Scene) -> Result<()> {
    adaptive::refuse(scene)?;
    takes_any_steps(scene)
}

/// Takes every scene but those that ask for what one loop alone can do, or cannot be with adaptive steps.
pub fn takes_any_steps(scene: &Scene) -> Result<()> {
    adaptive::check(scene)?;
    cells::takes_voxels(scene)?;
    surface::check_opaque(scene)?;
    light_paths::check_passes(scene)?;
    refraction::check_passes(scene)?;
    clip_volume::check_passes(scene)?;
    without_effect(scene)
}

/// Takes every scene but those with an effect, whose GLSL is a part of one loop.
fn without_effect(scene: &Scene) -> Result<()> {
    let Some(effect) = &scene.effect else { return Ok(()) };
    Err(Error::usage(
        format!("--method {}", scene.settings.method.name),
        format!("takes no effect, and {} is given", effect.file()),
        "use --method single-pass, or another single-pass method, or leave the effect out (--effect)",
    ))
}

/// Every way to cull with every way to mark.
pub fn every_form() -> Vec<Form> {
    let culls = [Cull::Bounds, Cull::Ztest, Cull::Discard];
    let marks = [Mark::Fragdepth, Mark::FragdepthAny, Mark::Copy];
    culls.into_iter().flat_map(|cull| marks.map(|mark| Form { cull, mark })).collect()
}

/// The forms in which an intermediate pass can be culled: by the bounds test, or with marks that are copied.
pub fn culled_forms() -> Vec<Form> {
    let mut forms = every_form();
    forms.retain(|form| form.cull == Cull::Bounds || form.mark == Mark::Copy);
    forms
}

/// ENTRY and DIR, which every ray caster begins with, and what rays begin with, after room was made for its passes.
pub fn begin(context: &Context, steps: &mut Steps) {
    let decides = context.has(&DECISIONS) && !context.method.fused;
    let a_pass = 1 + usize::from(decides) + usize::from(context.has(&MARK_COPIES));
    steps.reserve(a_pass * context.passes as usize + (context.passes / BATCH) as usize + STEPS_BEFORE);
    // Samples on slices need no ray.
    if context.method.stack().is_none() {
        steps.push(entry::entry(context));
        steps.push(direction::direction(context));
    }
    steps.extend(context.has(&START).then(|| start::start(context)));
}

/// Empties RES where an intermediate pass reads it before the first main pass, unless rays begin with something.
pub fn empty(context: &Context, steps: &mut Steps) {
    if context.section == 0 && context.has(&EARLY_ENDS) && !context.has(&START) {
        steps.push(clear::clear(context));
    }
}

/// A frame of rays: `passes` for each part of them, with the polygons between.
pub fn cast(context: &Context, steps: &mut Steps, passes: fn(&Context, &mut Steps)) {
    if context.passes > 0 && !context.method.loops() {
        begin(context, steps);
    }
    // A loop that computes goes through pixels beside the box as well.
    let beside = context.passes == 0 || context.method.traversal != Traversal::ComputeLoop;
    steps.extend((beside && context.has(&BACKDROP)).then(|| backdrop::backdrop(context)));
    let guards = peel(context, steps);
    let first = first_section(context);
    steps.enter(0, None);
    // Passes behind a layer that no ray has do not run, and do not empty RES.
    steps.extend((first > 0).then(|| clear::clear(context)));
    for part in context.sections(first) {
        // Without the layer in front there is nothing behind it.
        let guard = part.section.checked_sub(1).map(|layer| guards[layer as usize]);
        steps.enter(part.section, guard);
        if context.passes > 0 {
            passes(&part, steps);
            let ends = part.has(&LAYER_BEHIND) || part.opaque;
            if let Some(form) = part.form.filter(|_| ends && part.has(&APART)) {
                steps.enter(part.section, guard);
                steps.push(main_pass::partial_pass(&part, form));
            }
        }
        steps.enter(0, guard);
        steps.extend((context.blends && part.section < context.layers).then(|| layer::layer(&part, part.section)));
    }
    steps.enter(0, None);
    // A loop lights a surface where it meets it.
    let deferred = context.has(&ISO_SURFACE) && !context.method.loops();
    steps.extend(deferred.then(|| lighting::lighting(context)));
    steps.extend(context.opaque.then(|| layer::opaque(context)));
}

/// Polygons: where clip geometry lets rays begin, the opaque ones once, the transparent ones layer by layer. For each layer the
/// number of the step that counts it.
pub fn peel(context: &Context, steps: &mut Steps) -> Vec<u32> {
    if context.has(&CLIP_BEGIN) && context.scene.polygons.cuts_in_front() {
        steps.push(peel::clip(context));
    } else if context.has(&CLIP_BEGIN) {
        steps.push(clip_winding::clip_winding(context));
        steps.push(clip_begin::clip_begin(context));
    }
    steps.extend(context.opaque.then(|| peel::opaque(context)));
    // Each layer hangs on the one in front of it, not on opaque polygons.
    steps.enter(0, None);
    (0..context.layers)
        .map(|layer| {
            steps.push(peel::transparent(context, layer));
            layer + u32::from(context.opaque)
        })
        .collect()
}

/// A main pass: a segment of each ray, or some slices.
pub fn main(context: &Context, pass: u32, culled: Option<(Cull, f32)>) -> Step {
    match context.method.stack() {
        Some(_) => slices::slices(context, pass, culled),
        None => main_pass::main_pass(context, pass, culled),
    }
}

/// Main passes that run for every fragment.
pub fn unswitched(context: &Context, steps: &mut Steps) {
    steps.extend(context.drawn_passes().map(|pass| main(context, pass, None)));
}

/// Main passes switched by an intermediate pass before each, from main pass `first` on [KW03 §2.1].
pub fn switched(context: &Context, steps: &mut Steps, first: u32, decide: fn(&Context, u32, Form) -> Step) {
    let Some(form) = context.form.filter(|_| context.has(&DECISIONS)) else { return unswitched(context, steps) };
    // Behind a layer many rays have nothing to do, and a segment that ends at a surface may be the first.
    let first = if context.has(&LAYER_BEFORE) || context.has(&APART) { 0 } else { first };
    // Else a main pass comes before all that look at what rays have gathered.
    if context.drawn_passes().next().is_none_or(|pass| pass >= first) {
        empty(context, steps);
    }
    let mut decides = None;
    for pass in context.drawn_passes() {
        let mut culled: Option<(Cull, f32)> = None;
        if pass >= first {
            steps.push(decide(context, pass, form));
            decided(context, steps, pass, decides.replace(pass).map(|_| pass), None);
            culled = Some((form.cull, SWITCH));
        }
        steps.push(main(context, pass, culled));
    }
}

/// What follows a step that has decided about main pass `pass`: the copy of what was marked in the tiles of main pass `marked`, of all
/// pixels where nothing was copied before, where marks go that way; and now and then the count of rays left, with a target `beside` it.
pub fn decided(context: &Context, steps: &mut Steps, pass: u32, marked: Option<u32>, beside: Option<Resource>) {
    if context.has(&MARK_COPIES) {
        steps.push(mark_copy::mark_copy(pass, marked));
    }
    if context.has(&COUNTING) && pass > 0 && pass.is_multiple_of(BATCH) {
        steps.push(alive::alive(rest_begins(context.view), pass, beside));
    }
}
