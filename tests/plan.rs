//! Plans: what a scene needs and what is left out; needs no device.

#[path = "plan/cases.rs"]
mod cases;
#[path = "plan/golden.rs"]
mod golden;

use std::collections::{BTreeSet, HashSet};

use cases::{cases, scene, settings};
use depthleap::method;
use depthleap::part::access::Usage;
use depthleap::part::form::Form;
use depthleap::part::resource::Resource;
use depthleap::part::{Group, Step, Work};
use depthleap::plan::{Plan, form, plan};
use depthleap::resource;
use depthleap::scene::Settings;
use depthleap::scene::settings::{Alpha, Cull, Filter, Last, Mark, Offset, ShellMode};
use glam::DVec3;

/// Reads of what no step before has written.
fn unwritten(steps: &[Step]) -> Vec<String> {
    let mut there: HashSet<Resource> = HashSet::new();
    let mut found = Vec::new();
    for step in steps {
        let reads = step.accesses.iter().filter(|access| access.usage.reads());
        let missing = reads.filter(|access| !there.contains(&access.resource));
        found.extend(missing.map(|access| format!("{} reads {}", step.name, access.resource.name())));
        there.extend(step.accesses.iter().filter(|access| access.usage.writes()).map(|access| access.resource));
    }
    found
}

#[test]
fn every_read_was_written_before() {
    // In f64 twins go to the scene itself.
    for case in cases().iter().filter(|case| case.plan.method.on_device) {
        assert_eq!(unwritten(&case.plan.steps), [""; 0], "{}", case.name);
    }
}

#[test]
fn read_before_its_write_is_seen() {
    for (name, group, left) in [
        ("nn-omni_bounds_fragdepth", "clear", "near_neighbor #0 reads accumulated"),
        ("rc", "entry", "direction reads entry"),
        ("rc", "frame", "entry reads frame"),
        ("nn-optimal_ztest_copy", "bundle", "bundle.4 reads bundle"),
        ("rc-block", "cell_range", "block_skip #1 reads cell_range"),
        ("nn-omni_ztest_copy", "distance_x", "distance_y reads squares"),
        ("nn-optimal_ztest_copy", "wide_2", "wide_4 reads wide_2"),
        ("nn-omni_ztest_copy", "mark_copy #0", "main_pass #0 reads stored"),
        ("nn-omni+fused_ztest_copy", "mark_copy #0", "fused #0 reads stored"),
    ] {
        let mut steps = cases().into_iter().find(|case| case.name == name).unwrap().plan.steps;
        steps.retain(|step| step.name != group);
        assert_eq!(unwritten(&steps).first().map(String::as_str), Some(left));
    }
}

#[test]
fn names_of_steps_are_unique_and_numbers_those_of_their_pass() {
    for case in cases() {
        let names: BTreeSet<&str> = case.plan.steps.iter().map(|step| step.name.as_str()).collect();
        assert_eq!(names.len(), case.plan.steps.len(), "{}", case.name);
        for step in case.plan.steps.iter().filter(|step| step.name.contains('#')) {
            let part = step.section.checked_sub(1).map_or(String::new(), |layer| format!(" behind layer {layer}"));
            assert_eq!(step.name, format!("{} #{}{part}", step.pass_name(), step.pass));
        }
    }
}

#[test]
fn frames_look_up_the_distances_that_they_are_planned_for() {
    let mut seen = 0;
    for case in cases().into_iter().filter(|case| case.plan.distance.is_some()) {
        let asset = case.plan.asset(resource::NEAREST_DISTANCE);
        // Those of all views are built before those along rays, and stand in the list too.
        assert_eq!(asset.lookup, case.plan.distance, "{}", case.name);
        let built: Vec<_> = case.plan.builds.iter().map(|build| build.asset).collect();
        assert!(built.contains(&asset), "{}: {built:?}", case.name);
        seen += usize::from(asset.lookup.is_some_and(|lookup| lookup.view.is_some()));
    }
    assert!(seen > 2, "{seen} frames look up distances along rays");
}

fn planned(settings: &Settings) -> Plan {
    let scene = scene(settings);
    plan(&scene, form(&scene, method::papers_form(settings.method.name)).unwrap()).unwrap()
}

/// Scenes that need more, each beside the same with that need gone.
fn needs() -> Vec<(&'static str, Settings, Settings)> {
    let pair = |name, method, alter: fn(&mut Settings)| {
        let less = settings(method);
        let mut more = less.clone();
        alter(&mut more);
        (name, more, less)
    };
    let mut pairs = vec![
        pair("opacity correction", method::NN_OMNI.name(), |s| s.sampling.step = 0.5),
        pair("length of the last sample", method::NN_OMNI.name(), |s| s.sampling.last = Last::Partial),
        pair("interpolation in the shader", method::RC.name(), |s| s.sampling.filter = Filter::Exact),
        pair("test before the first pass", method::RC_BLOCK.name(), |s| s.method.block_first = true),
        pair("more passes", method::RC_ERT.name(), |s| s.sampling.samples_per_pass = 2),
        pair("marks on their way", method::NN_OMNI.name(), |s| s.method.mark = Mark::Copy),
    ];
    for (more, less) in [
        (method::RC_ERT.name(), method::RC.name()),
        (method::RC_BLOCK.name(), method::RC.name()),
        (method::RC_BLOCK.name(), method::RC_ERT.name()),
        (method::NN_OMNI.name(), method::RC.name()),
    ] {
        pairs.push((more.name(), settings(more), settings(less)));
    }
    pairs
}

#[test]
fn nothing_a_scene_needs_less_adds_a_step() {
    let passes = |plan: &Plan| plan.steps.iter().map(|s| s.pass_name().to_owned()).collect::<Vec<_>>();
    // Rays in single floats take less than others, and read numbers of their own.
    let steps = |plan: &Plan| plan.steps.iter().filter(|step| step.name != resource::SINGLE_RAYS.name()).count();
    let count = |list: &[String], name: &str| list.iter().filter(|other| *other == name).count();
    let mut fewer = 0;
    for (name, more, less) in needs() {
        let (more, less) = (planned(&more), planned(&less));
        assert!(steps(&less) <= steps(&more), "without {name}");
        fewer += usize::from(steps(&less) < steps(&more));
        // What decides goes by another name in another method.
        let (more, less) = (passes(&more), passes(&less));
        for pass in less.iter().filter(|pass| !matches!(pass.as_str(), "termination" | "block_skip" | "single_rays")) {
            assert!(count(&less, pass) <= count(&more, pass), "without {name} there is more of {pass}");
        }
    }
    assert!(fewer > 4, "{fewer}");
}

fn constant(plan: &Plan, name: &str) -> u32 {
    let draws = plan.steps.iter().filter(|step| step.group == Group::Main);
    let constants = draws.map(|step| match &step.work {
        Work::Draw(draw) => draw.constants.iter().find(|(n, _)| *n == name).unwrap().1,
        other => panic!("a main pass is {other:?}"),
    });
    let values: BTreeSet<u32> = constants.collect();
    assert_eq!(values.len(), 1, "{name} differs between main passes");
    values.into_iter().next().unwrap()
}

#[test]
fn shader_code_a_scene_does_not_need_is_left_out() {
    for (what, constant_name, alter) in [
        ("opacity correction", "CORRECT_OPACITY", (|s| s.sampling.step = 0.5) as fn(&mut Settings)),
        ("length of the last sample", "LAST_PARTIAL", |s| s.sampling.last = Last::Partial),
        ("interpolation in the shader", "FILTER", |s| s.sampling.filter = Filter::Exact),
    ] {
        let plain = settings(method::RC.name());
        let mut needy = plain.clone();
        alter(&mut needy);
        for (settings, needed) in [(plain, false), (needy, true)] {
            let plan = planned(&settings);
            assert_eq!(constant(&plan, constant_name), u32::from(needed), "{what}");
            assert_eq!(plan.left_out.iter().any(|left| left.what == what), !needed, "{what}");
        }
    }
    // The papers take opacities as they stand, whatever the step.
    let mut papers = settings(method::RC.name());
    (papers.sampling.step, papers.sampling.alpha) = (0.5, Alpha::Paper);
    assert_eq!(constant(&planned(&papers), "CORRECT_OPACITY"), 0);
}

#[test]
fn whatever_is_left_out_has_a_reason() {
    // What frames without samples lack of these, nobody expects.
    for case in cases().into_iter().filter(|case| case.plan.method.takes_samples()) {
        assert!(!case.plan.left_out.is_empty(), "{}", case.name);
        let bare: Vec<_> = case.plan.left_out.iter().filter(|l| l.what.is_empty() || l.why.len() < 10).collect();
        assert!(bare.is_empty(), "{}: {bare:?}", case.name);
        // And nothing that is left out is used.
        let uses =
            |r: Resource| case.plan.steps.iter().any(|s| s.accesses.iter().any(|a| a.resource.name() == r.name()));
        for (what, resource) in [
            ("distance structure", resource::NEAREST_DISTANCE),
            ("block ranges and their table", resource::block_ranges()),
            ("hole mask", resource::HOLES),
        ] {
            let left = case.plan.left_out.iter().any(|l| l.what == what);
            assert_ne!(left, uses(resource), "{what} in {}", case.name);
        }
    }
}

#[test]
fn camera_that_looks_away_has_an_empty_plan() {
    for method in method::METHODS.map(|method| method.name()) {
        let mut settings = settings(method);
        settings.shells.mode = (method == method::SHELLS.name()).then_some(ShellMode::Max);
        settings.camera.target = [0.0, 0.0, 4.0];
        let plan = planned(&settings);
        assert_eq!((plan.passes, plan.steps.len(), plan.view.longest_samples), (0, 0, 0));
        let told: Vec<_> = plan.left_out.iter().map(|l| (l.what.as_str(), l.why.as_str())).collect();
        assert_eq!(told, [("every pass", "no ray of this view meets the volume")]);
    }
}

#[test]
fn passes_are_those_of_the_longest_ray_of_this_view() {
    let mut cube = settings(method::RC.name());
    cube.volume.builtin = Some("blocks:256".to_owned());
    let mut cube = scene(&cube);
    cube.settings.image.size = [500, 500];
    // N, and the samples of the longest ray, head on.
    let mut seen = |distance: f64, fov_y: f64, step: f64, offset: Offset| {
        (cube.camera.eye, cube.camera.fov_y) = (distance * DVec3::Z, fov_y);
        (cube.settings.sampling.step, cube.settings.sampling.offset) = (step, offset);
        let plan = plan(&cube, None).unwrap();
        (plan.passes, plan.view.longest_samples)
    };
    // The longest ray goes from the front face through a corner of the back face, which lies 0.5 beside the axis and
    // distance + 0.5 away: sqrt(1 + 2 (0.5 / 2.41)^2) of a side, 266.77 voxels; through the pixel beside that corner,
    // 0.0008 off at most, 266.68. Both are 267 samples, 34 passes of 8.
    assert_eq!(seen(1.91, 45.0, 1.0, Offset::Left), (34, 267));
    // Half the step, twice the samples: 533.5 and 533.4.
    assert_eq!(seen(1.91, 45.0, 0.5, Offset::Left), (67, 534));
    // From far away rays run along the axis: 256 voxels and a little, so that the sample that begins at their end
    // counts; sampled in the middle of each step there are 256, 32 passes of 8.
    assert_eq!(seen(1000.0, 0.05, 1.0, Offset::Left), (33, 257));
    assert_eq!(seen(1000.0, 0.05, 1.0, Offset::Midpoint), (32, 256));
}

#[test]
fn forced_passes_are_as_many() {
    for passes in [1, 2, 3, 40] {
        let mut settings = settings(method::NN_OMNI.name());
        settings.sampling.passes = passes;
        let plan = planned(&settings);
        let main = plan.steps.iter().filter(|step| step.group == Group::Main).count();
        assert_eq!((plan.passes, main), (passes, passes as usize));
        assert!(!plan.left_out.iter().any(|left| left.what.starts_with("main pass")));
    }
}

#[test]
fn passes_that_only_other_views_need_are_left_out() {
    // Three passes of 8 samples here, and four for the diagonal of 16 voxels, 27.7; of 4, five here and seven.
    for (samples_per_pass, what) in [(8, "main pass 3"), (4, "main passes 5 to 6")] {
        let mut settings = settings(method::RC.name());
        settings.sampling.samples_per_pass = samples_per_pass;
        let left = planned(&settings).left_out.into_iter().find(|left| left.what.starts_with("main pass")).unwrap();
        assert_eq!((left.what.as_str(), left.why.as_str()), (what, "the longest ray of this view has 17 samples"));
    }
}

#[test]
fn too_many_passes_are_refused() {
    let mut settings = settings(method::RC.name());
    settings.sampling.samples_per_pass = 1;
    settings.sampling.step = 2e-4;
    let error = plan(&scene(&settings), None).unwrap_err().to_string();
    assert!(error.contains("--step 0.0002 --samples-per-pass 1"), "{error}");
    assert!(error.contains("at most 65536 are possible") && error.contains("longer steps"), "{error}");
}

#[test]
fn rays_left_are_counted_every_eight_passes() {
    for method in [method::RC_ERT.name(), method::RC_BLOCK.name(), method::NN_OMNI.name(), method::NN_OMNI_FUSED.name()]
    {
        let mut settings = settings(method);
        settings.sampling.passes = 26;
        let counted: Vec<u32> =
            planned(&settings).steps.iter().filter(|s| s.group == Group::Alive).map(|s| s.pass).collect();
        assert_eq!(counted, [8, 16, 24], "{}", method.name());
    }
}

/// Decisions follow a main pass in the papers' order, so that nothing is built for those that would follow the only one.
#[test]
fn blocks_are_built_where_some_pass_asks_for_them() {
    let mut settings = settings(method::RC_BLOCK.name());
    let asks = |settings: &Settings| {
        let plan = planned(settings);
        let uses = plan.steps.iter().any(|s| s.accesses.iter().any(|a| a.resource == resource::block_ranges()));
        assert_eq!(uses, plan.steps.iter().any(|step| step.group == Group::Intermediate));
        uses
    };
    assert!(asks(&settings));
    settings.sampling.samples_per_pass = 1024;
    assert!(!asks(&settings));
    settings.method.block_first = true;
    assert!(asks(&settings));
}

#[test]
fn fused_passes_mark_for_the_next_one_and_the_last_for_nobody() {
    for method in [
        method::NN_OMNI_FUSED.name(),
        method::NN_DIRECTIONAL_FUSED.name(),
        method::NN_OPTIMAL_FUSED.name(),
        method::NN_CONE_FUSED.name(),
    ] {
        for (form, passes) in method::forms(method).into_iter().flat_map(|form| [1, 2, 17].map(|passes| (form, passes)))
        {
            let mut settings = settings(method);
            settings.sampling.passes = passes;
            let plan = plan(&scene(&settings), Some(form)).unwrap();
            let name = |step: &Step| step.name.clone();
            let decided = |pass: u32| {
                let copy = (form.mark == Mark::Copy).then(|| format!("mark_copy #{pass}"));
                let count = (pass > 0 && pass.is_multiple_of(8)).then(|| format!("alive #{pass}"));
                copy.into_iter().chain(count)
            };
            let main = (0..passes).flat_map(|pass| decided(pass).chain([format!("fused #{pass}")]));
            let before = ["entry", "direction", "clear", "near_neighbor #0"].map(str::to_owned);
            let expected: Vec<String> = before.into_iter().chain(main).collect();
            let steps = plan.frame().iter();
            assert_eq!(steps.map(name).collect::<Vec<_>>(), expected, "{}", form.name());

            let fused = plan.steps.iter().filter(|step| step.group == Group::Main);
            let marks = |step: &Step| {
                step.accesses.iter().any(|a| *a == Usage::Color.of(resource::MARKS) || a.usage == Usage::DepthWrite)
            };
            let marking: Vec<bool> = fused.map(marks).collect();
            let last = marking.len() - 1;
            assert!(marking.iter().enumerate().all(|(i, marks)| *marks == (i < last)), "{}", form.name());
        }
    }
}

#[test]
fn form_that_does_not_apply_is_refused_by_those_that_do() {
    let mut settings = settings(method::NN_OMNI.name());
    for (cull, mark) in [(Cull::Ztest, Mark::Fragdepth), (Cull::Discard, Mark::FragdepthAny)] {
        (settings.method.cull, settings.method.mark) = (cull, mark);
        let error = form(&scene(&settings), method::papers_form(method::NN_OMNI.name())).unwrap_err().to_string();
        let asked = Form { cull, mark };
        assert!(error.contains(&format!("--cull {} --mark {}", asked.cull_name(), asked.mark_name())), "{error}");
        assert!(error.contains("method nn-omni has no such form"), "{error}");
        for possible in ["bounds+fragdepth", "bounds+fragdepth-any", "bounds+copy", "ztest+copy", "discard+copy"] {
            assert!(error.contains(possible), "{possible} is missing in: {error}");
        }
    }
}

#[test]
fn what_a_scene_leaves_open_is_filled_in() {
    use {Cull as C, Mark as M};
    let resolved = |method, cull, mark| {
        let mut settings = settings(method);
        (settings.method.cull, settings.method.mark) = (cull, mark);
        form(&scene(&settings), method::papers_form(method)).unwrap().map(Form::name)
    };
    for (method, cull, mark, expected) in [
        (method::RC.name(), C::Bounds, M::Copy, None),
        (method::RC_ERT.name(), C::Auto, M::Auto, Some("ztest+fragdepth")),
        (method::RC_ERT.name(), C::Bounds, M::Auto, Some("bounds+fragdepth")),
        (method::RC_BLOCK.name(), C::Auto, M::Copy, Some("ztest+copy")),
        (method::NN_OMNI.name(), C::Auto, M::Auto, Some("bounds+fragdepth")),
        // These two always mark by copy [DESIGN 2.3].
        (method::NN_OMNI.name(), C::Ztest, M::Auto, Some("ztest+copy")),
        (method::NN_OMNI.name(), C::Discard, M::Auto, Some("discard+copy")),
        (method::NN_OMNI.name(), C::Auto, M::FragdepthAny, Some("bounds+fragdepth-any")),
        (method::NN_OMNI.name(), C::Auto, M::Copy, Some("bounds+copy")),
    ] {
        assert_eq!(resolved(method, cull, mark).as_deref(), expected, "{method:?} {cull:?} {mark:?}");
    }
}

#[test]
fn every_form_of_a_method_has_a_plan_with_its_cull_and_mark() {
    for method in method::METHODS.map(|method| method.name()) {
        for form in method::forms(method) {
            let plan = plan(&scene(&settings(method)), Some(form)).unwrap();
            let uses = |usage: Usage, resource| plan.steps.iter().any(|s| s.accesses.contains(&usage.of(resource)));
            assert_eq!(uses(Usage::Color, resource::MARKS), form.mark == Mark::Copy, "{}", form.name());
            assert_eq!(uses(Usage::DepthWrite, resource::STORED), form.mark != Mark::Copy, "{}", form.name());
            assert_eq!(uses(Usage::Sampled, resource::STORED), form.cull == Cull::Discard, "{}", form.name());
            let bounds = plan.steps.iter().any(|s| matches!(&s.work, Work::Draw(draw) if draw.test.bounds));
            assert_eq!(bounds, form.cull == Cull::Bounds, "{}", form.name());
        }
    }
}
