//! Small scenes and their plans, one for each method and form that makes another plan.

use depthleap::method;
use depthleap::part::form::Form;
use depthleap::plan::{Plan, plan};
use depthleap::projection::{MIP, Projection};
use depthleap::read;
use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{ClipSettings, Cull, Mark, MeshSettings, MethodName, PartialSegments, ShellMode};
use depthleap::scene::{Scene, Settings};

/// 16 voxels a side, three main passes, few pixels.
pub fn settings(method: MethodName) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:16".to_owned());
    settings.image.size = [32, 32];
    if method::find(method).is_some_and(|method| method.goes_through_cells()) {
        settings.volume.builtin = Some("tets-ball:2".to_owned());
    }
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

/// By near-neighbor skipping, another projection than that of the others.
fn projected(row: &Projection, form: Option<Form>) -> Plan {
    let mut settings = settings(method::NN_OMNI.name());
    settings.projection.kind = row.name();
    plan(&scene(&settings), form).unwrap()
}

/// With a transparent and an opaque mesh, and two layers at the most.
fn layered(method: MethodName, form: Option<Form>) -> Plan {
    let mut settings = settings(method);
    let mesh = |opacity| MeshSettings { builtin: Some("box".to_owned()), opacity, ..MeshSettings::default() };
    (settings.meshes, settings.layers.most) = (vec![mesh(0.5), mesh(1.0)], 2);
    plan(&scene(&settings), form).unwrap()
}

/// Shells, with an opaque mesh where `meshed`.
fn shells(mode: ShellMode, meshed: bool) -> Plan {
    let mut settings = settings(method::SHELLS.name());
    (settings.shells.mode, settings.shells.count) = (Some(mode), 3);
    settings.shells.a = if mode == ShellMode::Surface { 0.0 } else { 0.5 };
    let mesh = || MeshSettings { builtin: Some("box".to_owned()), ..MeshSettings::default() };
    settings.meshes = meshed.then(mesh).into_iter().collect();
    plan(&scene(&settings), None).unwrap()
}

/// Through the cells of a ring.
fn through_cells(method: MethodName, form: Option<Form>) -> Plan {
    let mut settings = settings(method);
    settings.volume.builtin = Some("tets-torus:1".to_owned());
    settings.camera.eye = [0.9, 0.8, 1.0];
    plan(&scene(&settings), form).unwrap()
}

/// With a clip plane that the eye is cut off by, and a mesh.
fn cut(method: MethodName, form: Option<Form>) -> Plan {
    let mut settings = settings(method);
    settings.clips = vec![ClipSettings { plane: Some([0.0, 0.5, -1.0, 0.4]), ..ClipSettings::default() }];
    settings.meshes = vec![MeshSettings { builtin: Some("box".to_owned()), ..MeshSettings::default() }];
    plan(&scene(&settings), form).unwrap()
}

/// With an iso-surface in the light at the eye, and a transparent mesh.
fn on_surface(method: MethodName, form: Option<Form>) -> Plan {
    let mut settings = settings(method);
    settings.surface.iso = Some(90.0);
    let mesh = MeshSettings { builtin: Some("box".to_owned()), opacity: 0.5, ..MeshSettings::default() };
    (settings.meshes, settings.layers.most) = (vec![mesh], 1);
    plan(&scene(&settings), form).unwrap()
}

/// By early z, with clip geometry around the eye, and with a mesh where it keeps what is outside.
fn clipped(keep: Keep, partial: PartialSegments, form: Option<Form>) -> Plan {
    let mut settings = settings(method::RC_ERT.name());
    let shape = Some("box".to_owned());
    let near = [0.0, 0.0, settings.camera.eye[2]];
    let translate = if keep == Keep::Outside { near } else { [0.0; 3] };
    settings.clips = vec![ClipSettings { builtin: shape.clone(), keep, translate, ..ClipSettings::default() }];
    if keep == Keep::Outside {
        settings.meshes = vec![MeshSettings { builtin: shape, opacity: 0.5, ..MeshSettings::default() }];
    }
    (settings.layers.most, settings.layers.partial) = (2, partial);
    plan(&scene(&settings), form).unwrap()
}

/// By a loop that leaps, with a clip volume.
fn clipped_by_volume() -> Plan {
    let mut settings = settings(method::SINGLE_PASS_OMNI.name());
    let builtin = Some("gaussian:12".to_owned());
    settings.clips = vec![ClipSettings { builtin, iso: Some(0.5), keep: Keep::Outside, ..ClipSettings::default() }];
    plan(&scene(&settings), None).unwrap()
}

pub fn cases() -> Vec<Case> {
    use {Cull::*, Mark::*};
    let form = |cull, mark| Some(Form { cull, mark });
    let rows = [
        ("rc", method::RC.name(), None, false),
        ("cpu", method::CPU.name(), form(Ztest, Fragdepth), false),
        ("rc-ert", method::RC_ERT.name(), form(Ztest, Fragdepth), false),
        ("rc-ert_bounds_copy", method::RC_ERT.name(), form(Bounds, Mark::Copy), false),
        ("rc-block", method::RC_BLOCK.name(), form(Ztest, Fragdepth), false),
        ("rc-block_first", method::RC_BLOCK.name(), form(Ztest, Fragdepth), true),
        ("nn-omni_bounds_fragdepth", method::NN_OMNI.name(), form(Bounds, Fragdepth), false),
        ("nn-omni_bounds_fragdepth-any", method::NN_OMNI.name(), form(Bounds, FragdepthAny), false),
        ("nn-omni_bounds_copy", method::NN_OMNI.name(), form(Bounds, Mark::Copy), false),
        ("nn-omni_ztest_copy", method::NN_OMNI.name(), form(Ztest, Mark::Copy), false),
        ("nn-omni_discard_copy", method::NN_OMNI.name(), form(Discard, Mark::Copy), false),
        ("nn-omni_ztest_copy_cell-4", method::NN_OMNI.name(), form(Ztest, Mark::Copy), false),
        ("nn-directional_ztest_copy", method::NN_DIRECTIONAL.name(), form(Ztest, Mark::Copy), false),
        ("nn-optimal_ztest_copy", method::NN_OPTIMAL.name(), form(Ztest, Mark::Copy), false),
        ("nn-cone_ztest_copy", method::NN_CONE.name(), form(Ztest, Mark::Copy), false),
        ("nn-omni+fused_bounds_fragdepth", method::NN_OMNI_FUSED.name(), form(Bounds, Fragdepth), false),
        ("nn-omni+fused_ztest_copy", method::NN_OMNI_FUSED.name(), form(Ztest, Mark::Copy), false),
        ("nn-omni+fused_discard_copy", method::NN_OMNI_FUSED.name(), form(Discard, Mark::Copy), false),
        ("nn-directional+fused_ztest_copy", method::NN_DIRECTIONAL_FUSED.name(), form(Ztest, Mark::Copy), false),
        ("nn-optimal+fused_ztest_copy", method::NN_OPTIMAL_FUSED.name(), form(Ztest, Mark::Copy), false),
        ("nn-cone+fused_ztest_copy", method::NN_CONE_FUSED.name(), form(Ztest, Mark::Copy), false),
        ("single-pass", method::SINGLE_PASS.name(), None, false),
        ("single-pass-block", method::SINGLE_PASS_BLOCK.name(), None, false),
        ("single-pass-omni", method::SINGLE_PASS_OMNI.name(), None, false),
        ("single-pass-directional", method::SINGLE_PASS_DIRECTIONAL.name(), None, false),
        ("single-pass+compute", method::SINGLE_PASS_COMPUTE.name(), None, false),
        ("single-pass-block+compute", method::SINGLE_PASS_BLOCK_COMPUTE.name(), None, false),
        ("single-pass-omni+compute", method::SINGLE_PASS_OMNI_COMPUTE.name(), None, false),
        ("single-pass-directional+compute", method::SINGLE_PASS_DIRECTIONAL_COMPUTE.name(), None, false),
        ("slices-2d", method::SLICES_2D.name(), None, false),
        ("slices-2d+ftb", method::SLICES_2D_FTB.name(), form(Ztest, Fragdepth), false),
        ("slices-2d-block+ftb", method::SLICES_2D_BLOCK.name(), form(Ztest, Fragdepth), false),
        ("slices-2d-omni+ftb", method::SLICES_2D_OMNI.name(), form(Bounds, Fragdepth), false),
        ("slices-3d", method::SLICES_3D.name(), None, false),
        ("slices-3d+ftb", method::SLICES_3D_FTB.name(), form(Ztest, Fragdepth), false),
        ("slices-3d-block+ftb", method::SLICES_3D_BLOCK.name(), form(Ztest, Fragdepth), false),
        ("slices-3d-omni+ftb", method::SLICES_3D_OMNI.name(), form(Bounds, Fragdepth), false),
        ("slices-shells", method::SLICES_SHELLS.name(), None, false),
        ("slices-shells+ftb", method::SLICES_SHELLS_FTB.name(), form(Ztest, Fragdepth), false),
        ("slices-shells-block+ftb", method::SLICES_SHELLS_BLOCK.name(), form(Ztest, Fragdepth), false),
        ("slices-shells-omni+ftb", method::SLICES_SHELLS_OMNI.name(), form(Bounds, Fragdepth), false),
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
    let mut settings = settings(method::NN_OMNI_FUSED.name());
    settings.sampling.samples_per_pass = 2;
    let plan = plan(&scene(&settings), form(Bounds, Mark::Copy)).unwrap();
    cases.push(Case { name: "nn-omni+fused_bounds_copy_counted", plan });
    for (name, method, form) in [
        ("rc-ert_layers", method::RC_ERT.name(), form(Ztest, Fragdepth)),
        ("nn-omni_bounds_fragdepth_layers", method::NN_OMNI.name(), form(Bounds, Fragdepth)),
        ("nn-omni+fused_ztest_copy_layers", method::NN_OMNI_FUSED.name(), form(Ztest, Mark::Copy)),
        ("single-pass_layers", method::SINGLE_PASS.name(), None),
        ("single-pass+compute_layers", method::SINGLE_PASS_COMPUTE.name(), None),
        ("slices-3d_layers", method::SLICES_3D.name(), None),
        ("slices-3d-omni+ftb_layers", method::SLICES_3D_OMNI.name(), form(Ztest, Mark::Copy)),
    ] {
        cases.push(Case { name, plan: layered(method, form) });
    }
    for (name, keep, partial) in [
        ("rc-ert_clip_inside", Keep::Inside, PartialSegments::Within),
        ("rc-ert_clip_thesis", Keep::Thesis, PartialSegments::Within),
        ("rc-ert_clip_outside_apart", Keep::Outside, PartialSegments::Apart),
    ] {
        cases.push(Case { name, plan: clipped(keep, partial, form(Ztest, Fragdepth)) });
    }
    let planes = cut(method::NN_OMNI.name(), form(Bounds, Fragdepth));
    cases.push(Case { name: "nn-omni_bounds_fragdepth_planes", plan: planes });
    for (name, method, form) in [
        ("rc-ert_surface", method::RC_ERT.name(), form(Ztest, Fragdepth)),
        ("nn-omni_bounds_fragdepth_surface", method::NN_OMNI.name(), form(Bounds, Fragdepth)),
        ("single-pass-omni_surface", method::SINGLE_PASS_OMNI.name(), None),
    ] {
        cases.push(Case { name, plan: on_surface(method, form) });
    }
    for (name, mode, meshed) in [
        ("shells_max", ShellMode::Max, false),
        ("shells_max_surface", ShellMode::Max, true),
        ("shells_sum_surface", ShellMode::Sum, true),
        ("shells_outermost_surface", ShellMode::Surface, true),
    ] {
        cases.push(Case { name, plan: shells(mode, meshed) });
    }
    for (name, method, form) in [
        ("tet-propagation_ztest_fragdepth", method::TET_PROPAGATION.name(), form(Ztest, Fragdepth)),
        ("tet-propagation_bounds_copy", method::TET_PROPAGATION.name(), form(Bounds, Mark::Copy)),
        ("tet-single-pass", method::TET_SINGLE_PASS.name(), None),
        ("tet-single-pass+compute", method::TET_SINGLE_PASS_COMPUTE.name(), None),
    ] {
        cases.push(Case { name, plan: through_cells(method, form) });
    }
    cases.push(Case { name: "single-pass-omni_clip_volume", plan: clipped_by_volume() });
    cases.push(Case { name: "nn-omni_ztest_copy_mip", plan: projected(&MIP, form(Ztest, Mark::Copy)) });
    cases
}
