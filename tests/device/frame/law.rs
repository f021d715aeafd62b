//! The law of skipping: which fragments run is a method's own; the picture never changes, bit for bit. What `matrix` holds
//! for every form on tiny scenes is held here from all sides, on volumes of many blocks and words, and on real ones.

use std::sync::Arc;

use depthleap::feature::tiles;
use depthleap::frame::Verdict;
use depthleap::method::{
    self, METHODS, SINGLE_PASS, SINGLE_PASS_COMPUTE, SLICES_2D_FTB, SLICES_3D_FTB, SLICES_SHELLS_FTB,
};
use depthleap::part::form::Form;
use depthleap::part::rows::Method;
use depthleap::scene::Scene;
use depthleap::scene::settings::{
    Accumulate, CELLS, Classification, ClipSettings, Find, GradientTexture, Gradients, Last, LightSettings,
    MeshSettings, MethodName, Offset, Refine, Settings, Tiles,
};
use depthleap::structure::Lookup;
use depthleap::vulkan::Device;

use super::scenes::{Stage, VIEWS, by, checked, differing, forms, large, lawful, right_forms, scene, seen};
use crate::harness::{Need, Test, beside, least, share, some_forms, test};

type Change = fn(&mut Settings);

/// Changes of a method's own settings that may change counts and never the picture.
const TURNS: [(&str, Change); 4] = [
    ("as it is", |_| {}),
    ("block first", |s| s.method.block_first = true),
    ("a lookup for every sample", |s| s.method.lookups = s.sampling.samples_per_pass),
    ("no exit lookahead", |s| s.method.exit_lookahead = false),
];

/// Volume, transfer function and what else is set.
const BUILT_IN: [(&str, &str, Change); 18] = [
    ("shells:48", "ramp", |_| {}),
    // A jump of opacity, walls on block seams.
    ("blocks:64", "surface", |_| {}),
    // A pass of one sample: nothing is skipped at distance 0. Small, since some drivers compile a shader for each pass' bound.
    ("jets:20x24x28", "ramp", |s| s.sampling.samples_per_pass = 1),
    // Nothing to skip.
    ("marschner-lobb:24", "haze", |_| {}),
    // Steps below and above a voxel, samples in the middle, a short last one.
    ("shells:32", "ramp", |s| (s.sampling.step, s.sampling.samples_per_pass) = (0.3, 7)),
    ("blocks:48", "ramp", |s| {
        s.sampling.step = 2.5;
        (s.sampling.offset, s.sampling.last) = (Offset::Midpoint, Last::Partial);
    }),
    // One voxel thick, and N forced beyond and below what the view needs.
    ("shells:64x64x1", "ramp", |s| s.sampling.passes = 40),
    ("jets:32", "linear", |s| (s.sampling.passes, s.sampling.termination) = (5, 0.3)),
    // Opacities that the blend unit rounds, about T.
    ("shells:40", "ramp", |s| (s.image.accumulate, s.sampling.termination) = (Accumulate::Rgba16f, 0.7)),
    ("gaussian:32", "linear", |s| {
        (s.image.accumulate, s.sampling.termination, s.sampling.samples_per_pass) = (Accumulate::Rgba8, 0.5, 2);
    }),
    // Samples that stand for all values up to the next one, which may lie in another block or beyond a wall.
    ("blocks:40", "ramp", |s| {
        (s.sampling.classification, s.sampling.last) = (Classification::PreIntegrated, Last::Partial);
        s.sampling.step = 3.7;
    }),
    ("shells:40x36x32", "surface", |s| {
        (s.sampling.classification, s.sampling.step) = (Classification::PreIntegrated, 0.7);
        s.method.cell = 2;
    }),
    // 1 - 0.99^8 = 0.077 is a little above T when the last pass begins.
    ("constant:24", "haze", |s| {
        (s.image.accumulate, s.sampling.termination) = (Accumulate::Rgba8, 0.075);
        (s.sampling.samples_per_pass, s.sampling.passes) = (8, 2);
    }),
    // Surfaces as the texture unit interpolates them: on block seams, a sample a pass, colours of few bits.
    ("blocks:56", "surface", |s| s.surface.iso = Some(100.0)),
    ("jets:24x22x20", "ramp", |s| {
        (s.surface.iso, s.surface.find, s.surface.iso_width) = (Some(70.0), Find::Range, Some(20.0));
        (s.sampling.samples_per_pass, s.image.accumulate) = (1, Accumulate::Rgba8);
    }),
    ("shells:32", "surface", all_at_once),
    // Light on samples, with values that 8 bits move across a jump.
    ("gaussian:44", "ramp", |s| {
        s.lights = vec![light()];
        s.transfer.preset = None;
        s.transfer.points = Some(vec![[0.3328, 0.9, 0.6, 0.3, 0.0], [0.3328, 0.9, 0.6, 0.3, 0.3]]);
        s.shading.gradients = Gradients::Precomputed;
        s.shading.format = GradientTexture::Rgba8;
    }),
    ("jets:36", "ramp", |s| (s.lights, s.image.accumulate) = (vec![light()], Accumulate::Rgba16f)),
];

/// A surface in light, clip planes, and two meshes that cut each other.
fn all_at_once(settings: &mut Settings) {
    (settings.surface.iso, settings.surface.refine, settings.lights) = (Some(90.0), Refine::Exact, vec![light()]);
    settings.clips = [[1.0, 0.2, 0.1, 0.2], [-0.3, 0.9, -0.2, 0.3]]
        .map(|plane| ClipSettings { plane: Some(plane), ..ClipSettings::default() })
        .to_vec();
    let mesh = |opacity: f64, scale: f64| MeshSettings {
        builtin: Some("sphere".to_owned()),
        opacity,
        scale,
        ..MeshSettings::default()
    };
    (settings.meshes, settings.layers.most) = (vec![mesh(0.4, 0.7), mesh(1.0, 0.3)], 2);
    settings.meshes[1].translate = [0.2, 0.1, 0.0];
}

fn light() -> LightSettings {
    LightSettings { direction: Some([-1.0, 1.0, 1.0]), color: [1.0, 0.7, 0.4], ..LightSettings::default() }
}

const REAL: [(&str, &str, Change); 8] = [
    ("fuel.nrrd", "ramp", |_| {}),
    ("nucleon.nrrd", "surface", |_| {}),
    ("engine_256cube.nrrd", "ramp", |s| s.sampling.samples_per_pass = 8),
    ("aneurism.nrrd", "ramp", |s| s.sampling.samples_per_pass = 8),
    ("mri_head.nrrd", "ramp", |s| s.sampling.samples_per_pass = 8),
    // Spacings differ from axis to axis.
    ("ct_vismale.nrrd", "surface", |s| s.sampling.samples_per_pass = 8),
    ("ct_head.nrrd", "linear", |s| {
        all_at_once(s);
        s.sampling.samples_per_pass = 8;
    }),
    ("foot_cadaver.nrrd", "surface", |s| {
        (s.lights, s.sampling.samples_per_pass) = (vec![light()], 8);
        s.shading.gradients = Gradients::Precomputed;
    }),
];

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    for (number, (volume, tf, change)) in BUILT_IN.into_iter().chain(REAL).enumerate() {
        let mut one = test(&format!("law_of_skipping::{volume}::{tf}"), move |device| {
            law(device, &scene(volume, tf, change), number);
        });
        if volume.ends_with(".nrrd") {
            one = one.needs(Need::Data(volume));
        }
        tests.push(one);
    }
    tests.push(test("law_of_skipping::would_see_a_changed_pixel", would_see_a_changed_pixel));
    tests
}

/// Every view by every method against `rc-ert` as KW03 has it. Forms and turns go round: a scene's views have different
/// ones, a view has all of them in one scene or another.
fn law(device: &Arc<Device>, scene: &Scene, number: usize) {
    let mut stage = Stage::new(device);
    for (i, view) in VIEWS.into_iter().enumerate().filter(|(i, _)| drawn_here(scene, *i, number)) {
        let scene = seen(scene, view);
        let ert = by(&scene, method::RC_ERT.name());
        let rule = stage.shoot(&ert, method::papers_form(method::RC_ERT.name()));
        let (turn, change) = TURNS[(i + number) % TURNS.len()];
        for method in share(lawful(), number / VIEWS.len()) {
            let mut scene = by(&scene, method.name());
            change(&mut scene.settings);
            // A structure for each view of a large volume takes seconds: in the smallest cells for every other one.
            let per_view = method.distance().is_some_and(|kind| Lookup::new(&scene, kind).view.is_some());
            if large(&scene) && per_view {
                scene.settings.method.cell = CELLS[number % 2];
            }
            let mut some = forms(device, method.name());
            some.retain(|form| trusted(device, method.name(), *form));
            let form = some[(i + number) % some.len()];
            let differs = differing(&stage.shoot(&scene, form).picture, &rule.picture);
            let name = format!("{}, {turn}, {}, {}", method.name, form.map_or_else(String::new, Form::name), view.0);
            assert_eq!(differs, 0, "{name}: {differs} pixels are not those of rc-ert");
        }
        let rules: [&Method; 5] =
            [&SINGLE_PASS, &SLICES_3D_FTB, &SINGLE_PASS_COMPUTE, &SLICES_2D_FTB, &SLICES_SHELLS_FTB];
        let rule = rules[(i + number) % rules.len()];
        let mut named = by(&scene, rule.name());
        change(&mut named.settings);
        if (rule.takes)(&named).is_ok() {
            leaps(device, &mut stage, &scene, rule, change, i + number);
        }
    }
}

/// Loops that leap, and slices that skip, have the picture of the method that does not, with one way to look ahead.
fn leaps(
    device: &Arc<Device>,
    stage: &mut Stage,
    scene: &Scene,
    rule: &'static Method,
    change: fn(&mut Settings),
    turn: usize,
) {
    let mut picture = |method: &Method, drawn: Tiles| {
        let mut scene = by(scene, method.name());
        change(&mut scene.settings);
        scene.settings.method.tiles = drawn;
        let forms = right_forms(device, method.name());
        stage.shoot(&scene, forms[turn % forms.len()]).picture
    };
    let of_rule = picture(rule, Tiles::All);
    for method in METHODS.into_iter().filter(|method| method.looks_ahead() && method.unskipped().name == rule.name) {
        let in_tiles = tiles::are_left_out_by(method) && tiles::serve(scene).is_ok();
        for drawn in [Some(Tiles::All), in_tiles.then_some(Tiles::Live)].into_iter().flatten() {
            let differs = differing(&picture(method, drawn), &of_rule);
            assert_eq!(differs, 0, "{}, {drawn:?} tiles: {differs} pixels are not those of {}", method.name, rule.name);
        }
    }
}

/// Whether a view is drawn on this driver: of a large volume one, since `orbit` sees it from further sides; of others all or, beside
/// another driver, every other one and there the rest. Where other drivers do more of everything, one.
fn drawn_here(scene: &Scene, view: usize, number: usize) -> bool {
    let odd = !(view + number).is_multiple_of(2);
    match () {
        () if large(scene) || least() => view == number % VIEWS.len(),
        () if beside() => !odd,
        () => odd || !some_forms(),
    }
}

/// A form of near-neighbor skipping that the self-check found wrong on this driver is known and named; the law is
/// not asked of it.
pub fn trusted(device: &Arc<Device>, method: MethodName, form: Option<Form>) -> bool {
    let verdict = form.and_then(|form| checked(device).forms.get(&form));
    method::find(method).and_then(Method::distance).is_none() || !matches!(verdict, Some(Verdict::Wrong(_)))
}

fn would_see_a_changed_pixel(device: &Arc<Device>) {
    let scene = scene("shells:16", "ramp", |_| {});
    let shot = Stage::new(device).shoot(&scene, method::papers_form(method::RC_ERT.name()));
    let mut changed = shot.picture.clone();
    assert_eq!(differing(&shot.picture, &changed), 0);
    let bits = changed[4321][2].to_bits() ^ 1;
    changed[4321][2] = f32::from_bits(bits);
    assert_eq!(differing(&shot.picture, &changed), 1);
}
