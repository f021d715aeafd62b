//! Small scenes and their plans, one for each method and form that makes another plan.

use depthleap::pass::cull::Form;
use depthleap::plan::{Plan, plan};
use depthleap::read;
use depthleap::scene::settings::{Cull, Mark, MethodName};
use depthleap::scene::{Scene, Settings};

/// 16 voxels a side, three main passes, few pixels.
pub fn settings(method: MethodName) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:16".to_owned());
    settings.image.size = [32, 32];
    settings.method.name = method;
    settings
}

pub fn scene(settings: &Settings) -> Scene {
    read::scene(settings).unwrap()
}

pub struct Case {
    /// Of its golden, `tests/golden/plan_NAME.txt`.
    pub name: &'static str,
    pub plan: Plan,
}

pub fn cases() -> Vec<Case> {
    use {Cull::*, Mark::*, MethodName::*};
    let form = |cull, mark| Some(Form { cull, mark });
    let rows = [
        ("rc", Rc, None, false),
        ("cpu", Cpu, form(Ztest, Fragdepth), false),
        ("rc-ert", RcErt, form(Ztest, Fragdepth), false),
        ("rc-ert_bounds_copy", RcErt, form(Bounds, Mark::Copy), false),
        ("rc-block", RcBlock, form(Ztest, Fragdepth), false),
        ("rc-block_first", RcBlock, form(Ztest, Fragdepth), true),
        ("nn-omni_bounds_fragdepth", NnOmni, form(Bounds, Fragdepth), false),
        ("nn-omni_bounds_fragdepth-any", NnOmni, form(Bounds, FragdepthAny), false),
        ("nn-omni_bounds_copy", NnOmni, form(Bounds, Mark::Copy), false),
        ("nn-omni_ztest_copy", NnOmni, form(Ztest, Mark::Copy), false),
        ("nn-omni_discard_copy", NnOmni, form(Discard, Mark::Copy), false),
        ("nn-omni_ztest_copy_cell-4", NnOmni, form(Ztest, Mark::Copy), false),
        ("nn-directional_ztest_copy", NnDirectional, form(Ztest, Mark::Copy), false),
        ("nn-optimal_ztest_copy", NnOptimal, form(Ztest, Mark::Copy), false),
        ("nn-omni+fused_bounds_fragdepth", NnOmniFused, form(Bounds, Fragdepth), false),
        ("nn-omni+fused_ztest_copy", NnOmniFused, form(Ztest, Mark::Copy), false),
        ("nn-omni+fused_discard_copy", NnOmniFused, form(Discard, Mark::Copy), false),
    ];
    let mut cases: Vec<Case> = rows
        .map(|(name, method, form, block_first)| {
            let mut settings = settings(method);
            settings.method.block_first = block_first;
            settings.method.cell = if name.ends_with("cell-4") { 4 } else { 1 };
            Case { name, plan: plan(&scene(&settings), form).unwrap() }
        })
        .into();
    // Long enough for the rays left to be counted.
    let mut settings = settings(NnOmniFused);
    settings.sampling.samples_per_pass = 2;
    let plan = plan(&scene(&settings), form(Bounds, Mark::Copy)).unwrap();
    cases.push(Case { name: "nn-omni+fused_bounds_copy_counted", plan });
    cases
}
