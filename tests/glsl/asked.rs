//! Every shader that the program may ask for: those of the plans of all methods, forms and kinds of scenes, of the probe,
//! and of the self-check. Kinds of scenes are those of the matrix, in turns for loops that leap, and all that may be combined besides.

use std::collections::BTreeSet;
use std::sync::{Arc, LazyLock};

use depthleap::frame::texture_unit;
use depthleap::glsl::compile::{CompiledModule, compile_unoptimised};
use depthleap::glsl::{self, Shader};
use depthleap::method::METHODS;
use depthleap::part::form::Form;
use depthleap::part::rows::{Method, Traversal};
use depthleap::plan::{Choice, Plan, plan, plan_for};
use depthleap::probe::{Case, pipelines};
use depthleap::projection::{COMPOSITE, MIP, Projection, XRAY};
use depthleap::read;
use depthleap::scene::field::{Field, NanPolicy};
use depthleap::scene::settings::{Accumulate, Classification, Filter, MethodName, SliceCut};
use depthleap::scene::slices::Stack;
use depthleap::scene::volume::{Volume, Voxels};
use depthleap::scene::{Scene, Settings};
use rayon::prelude::*;

#[path = "../matrix/scenes.rs"]
mod matrix;

/// What a scene may be like, apart from its method and form.
#[derive(Clone, Copy, Debug)]
struct Like {
    preintegrated: bool,
    nearest: bool,
    holes: bool,
    planner: bool,
    /// Some rays end before they leave the volume.
    ends: bool,
    /// Some cells show nothing.
    skips: bool,
    cell: u32,
    projection: &'static Projection,
}

fn likes() -> Vec<Like> {
    let bit = |bits: u32, of: u32| bits >> of & 1 == 1;
    let each = move |bits: u32, projection: &'static Projection| Like {
        preintegrated: bit(bits, 0),
        nearest: bit(bits, 1),
        holes: bit(bits, 2),
        planner: bit(bits, 3),
        ends: bit(bits, 4),
        skips: bit(bits, 5),
        cell: if bit(bits, 6) { 4 } else { 1 },
        projection,
    };
    // One of colours, one whose rays end and one whose rays never do; the others have a scene each in the matrix.
    let all = [&COMPOSITE, &MIP, &XRAY].into_iter().flat_map(|row| (0..1 << 7).map(move |bits| each(bits, row)));
    // A table makes colours of the values between two samples, which neither labels nor holes have.
    let refused = |like: &Like| like.nearest || like.holes || like.projection.shows_values();
    all.filter(|like| !(like.preintegrated && refused(like))).collect()
}

fn scene(method: MethodName, like: Like) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:8".to_owned());
    settings.image.size = [8, 8];
    settings.method.name = method;
    settings.projection.kind = like.projection.name();
    settings.method.cell = like.cell;
    settings.method.planner = like.planner;
    settings.sampling.samples_per_pass = 4;
    settings.sampling.termination = if like.ends { 0.5 } else { 1.0 };
    settings.sampling.filter = if like.nearest { Filter::Nearest } else { Filter::Hardware };
    if like.preintegrated {
        settings.sampling.classification = Classification::PreIntegrated;
    }
    let first = if like.skips { 0.0 } else { 0.5 };
    settings.transfer.points =
        Some(vec![[0.0, 0.2, 0.4, 1.0, first], [0.5, 0.2, 0.4, 1.0, first], [1.0, 1.0, 0.5, 0.1, 0.9]]);
    let mut scene = read::scene(&settings).unwrap();
    if like.holes {
        let mut volume: Volume = scene.field.volume.clone();
        let mut values: Vec<f32> = (0..volume.voxels.len()).map(|i| volume.voxels.get(i) as f32).collect();
        values[0] = f32::NAN;
        volume.voxels = Voxels::F32(values);
        scene.field = Arc::new(Field::new(volume, None, NanPolicy::Hole).unwrap());
    }
    scene
}

/// The plans of everything above and of the matrix, with what tells them apart; made once for all tests of a program.
pub fn plans() -> &'static [(String, Plan)] {
    static PLANS: LazyLock<Vec<(String, Plan)>> = LazyLock::new(made);
    &PLANS
}

fn made() -> Vec<(String, Plan)> {
    let mut plans = Vec::new();
    let mut every_form = |method: &Method, scene: &Scene, like: &str| {
        for form in matrix::forms(method) {
            let name = format!("{} {} {like}", method.name, form.map(Form::name).unwrap_or_default());
            plans.push((name, plan(scene, form).unwrap()));
        }
    };
    // Shells are drawn by scenes of the matrix.
    for method in METHODS.into_iter().filter(|method| method.takes_samples()) {
        for like in likes() {
            every_form(method, &scene(method.name(), like), &format!("{like:?}"));
        }
    }
    // Shells are drawn by scenes of the matrix.
    for method in METHODS.into_iter().filter(|method| method.takes_samples()) {
        for accumulate in [Accumulate::Rgba16f, Accumulate::Rgba8] {
            let mut scene = scene(method.name(), likes()[0]);
            scene.settings.image.accumulate = accumulate;
            every_form(method, &scene, &format!("{accumulate:?}"));
        }
    }
    for method in METHODS.into_iter().filter(|method| method.goes_through_cells()) {
        for accumulate in [Accumulate::Rgba16f, Accumulate::Rgba8] {
            let mut settings = Settings::default();
            settings.volume.builtin = Some("tets-ball:1".to_owned());
            (settings.image.size, settings.method.name) = ([8, 8], method.name());
            settings.image.accumulate = accumulate;
            every_form(method, &read::scene(&settings).unwrap(), &format!("{accumulate:?}"));
        }
    }
    for method in METHODS.into_iter().filter(|method| method.stack().is_some_and(|stack| stack != Stack::Shells)) {
        let mut scene = scene(method.name(), likes()[0]);
        scene.settings.method.slice_cut = SliceCut::Device;
        every_form(method, &scene, "cut by the vertex shader");
    }
    for (number, (name, scene)) in matrix::scenes().into_iter().enumerate() {
        for (view, scene) in matrix::views(&scene) {
            for method in matrix::methods(&scene).filter(|method| in_turn(method, number)) {
                every_form(method, &matrix::by(&scene, method), &format!("{name} {view}"));
            }
        }
    }
    // As for a device whose buffers of texels hold no mesh.
    for method in METHODS.into_iter().filter(|method| method.goes_through_cells()) {
        let mut settings = Settings::default();
        settings.volume.builtin = Some("tets-ball:1".to_owned());
        (settings.image.size, settings.method.name) = ([8, 8], method.name());
        let choice = Choice { form: method.papers, most_texels: Some(0), ..Choice::default() };
        let plan = plan_for(&read::scene(&settings).unwrap(), choice).unwrap();
        plans.push((format!("{} in storage buffers", method.name), plan));
    }
    plans
}

/// Whether a method is one that the shaders of a scene are asked for by: of loops that leap, which take longest to compile, one in turn.
fn in_turn(method: &Method, turn: usize) -> bool {
    let traversal = [Traversal::FragmentLoop, Traversal::ComputeLoop][turn % 2];
    let of_blocks = (turn / 2).is_multiple_of(2);
    let leaps = method.loops() && method.looks_ahead();
    // Slices of all stacks are one shader, but for the textures that they take values from.
    if let Some(stack) = method.stack() {
        return stack == [Stack::View, Stack::Objects, Stack::Shells][turn % 3];
    }
    !leaps || method.traversal == traversal && method.skips_blocks() == of_blocks
}

/// The shaders of these plans and of what has no plan.
pub fn shaders(plans: &[(String, Plan)]) -> BTreeSet<Shader> {
    let steps = || plans.iter().flat_map(|(_, plan)| &plan.steps);
    let planned = steps().filter_map(|step| step.work.shader()).map(|shader| Shader::clone(shader));
    let corners = steps().filter_map(|step| step.work.vertex());
    let others = pipelines::shaders(&Case::all()).into_iter().chain([texture_unit::shader()]);
    planned.chain(corners).chain(others).collect()
}

/// All shaders that may be asked for, made by the compiler itself. The optimiser, which takes most of the time, is left out: it may take
/// constants, bindings and structs away, and changes none. What it makes of them is held by the tests that draw.
pub fn unoptimised() -> impl ParallelIterator<Item = (Shader, CompiledModule)> {
    shaders(plans()).into_par_iter().map(|shader| {
        let text = glsl::built_in().text(shader.file).unwrap().with(shader.insert.as_deref());
        let defines: Vec<&str> = shader.defines.iter().copied().collect();
        let made = compile_unoptimised(&text, &defines).unwrap_or_else(|broken| panic!("{shader}: {broken}"));
        (shader, made)
    })
}
