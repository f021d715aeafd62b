//! Scenes and views that skipping could get wrong, and how a test runs one.

use std::sync::{Arc, OnceLock};

use depthleap::frame::{
    CpuFrame, EarlyEnd, FrameRun, GpuFrame, Measure, Resident, SelfCheck, Structures, cpu, self_check,
};
use depthleap::method::{self, METHODS};
use depthleap::part::form::Form;
use depthleap::part::rows::{Ahead, Method, Traversal};
use depthleap::plan::{self, Choice, Plan};
use depthleap::read;
use depthleap::scene::settings::{Cull, Distance, Filter, MethodName, Settings, VolumeTexture};
use depthleap::scene::slices::Stack;
use depthleap::scene::{Camera, Scene};
use depthleap::vulkan::Device;

use super::law::trusted;
use super::matrix_scenes;
use crate::harness::{self, share, some_forms};

/// A scene by its volume (`shells:48`, or a file of `../shared/data`) and transfer function.
pub fn scene(volume: &str, tf: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    match volume.ends_with(".nrrd") {
        true => settings.volume.path = Some(crate::harness::data(volume)),
        false => settings.volume.builtin = Some(volume.to_owned()),
    }
    settings.transfer.preset = Some(tf.to_owned());
    // At this size no edge of a box runs along a column of pixel centres in any of the views: all of the column would
    // be the rasteriser's to decide.
    settings.image.size = [122, 98];
    settings.sampling.samples_per_pass = 4;
    change(&mut settings);
    read::scene(&settings).expect("a sound scene")
}

/// Hardware filters are as exact as they are; a comparison with f64 interpolates in the shader.
pub fn exactly(settings: &mut Settings) {
    settings.sampling.filter = Filter::Exact;
    settings.volume.texture = VolumeTexture::R32f;
}

/// Eye and target of the views, by name.
pub static VIEWS: [(&str, [f64; 3], [f64; 3]); 6] = [
    ("head-on", [0.0, 0.0, 1.91], [0.0; 3]),
    ("rotated", [0.8974, 0.6533, 1.5544], [0.0; 3]),
    // Rays of several octants, and parallel to faces.
    ("inside", [0.11, 0.07, -0.13], [-0.3, 0.2, 0.4]),
    // The eye in the plane of a face: rays graze it.
    ("grazing", [0.5, 0.2, 1.4], [0.5, 0.0, 0.0]),
    ("corner", [1.3, 1.3, 1.3], [0.0; 3]),
    ("behind", [-0.2, -1.5, -0.9], [0.1, 0.0, 0.0]),
];

/// Whether so large that each view takes seconds: by voxels.
pub fn large(scene: &Scene) -> bool {
    scene.field.dims().iter().product::<usize>() > 1 << 22
}

/// A large volume is seen from one in so many of [`VIEWS`], from others than the next one is.
const SIDES: usize = 3;

/// The [`VIEWS`] that a test sees a scene from, each with its number.
pub fn views_of(scene: &Scene, turn: usize) -> Vec<(usize, NamedView)> {
    let all = VIEWS.into_iter().enumerate();
    match large(scene) {
        true => all.skip(turn % SIDES).step_by(SIDES).collect(),
        false => share(all, turn),
    }
}

/// The scene seen from one of [`VIEWS`].
pub fn seen(scene: &Scene, (_, eye, target): (&str, [f64; 3], [f64; 3])) -> Scene {
    let camera = Camera { eye: eye.into(), target: target.into(), ..(&scene.settings.camera).into() };
    scene.clone().seen_by(camera)
}

/// The scene by another method.
pub fn by(scene: &Scene, method: MethodName) -> Scene {
    let mut scene = scene.clone();
    scene.settings.method.name = method;
    scene
}

/// Forms of a method that the device has the features for.
pub fn forms(device: &Device, method: MethodName) -> Vec<Option<Form>> {
    let has = |form: &Option<Form>| device.info.depth_bounds || form.is_none_or(|form| form.cull != Cull::Bounds);
    let mut forms = method::find(method).map_or_else(Vec::new, matrix_scenes::forms);
    forms.retain(has);
    forms
}

/// The forms that a scene is drawn in by tests over many scenes, of those that the self-check found right: all of them, or one that
/// follows from the scene, by the bounds test where the device has it.
pub fn forms_here(device: &Arc<Device>, scene: &Scene) -> Vec<Option<Form>> {
    let forms = right_forms(device, scene.settings.method.name);
    match some_forms() {
        true => vec![forms[number_of(scene) % forms.len()]],
        false => forms,
    }
}

/// Tests of one scene, or scenes on end, that have all forms of a method between them.
const FORM_TURNS: usize = 3;

/// The forms that a scene is drawn in at its turn: as [`forms_here`] or, where that is all of them, one in [`FORM_TURNS`] of them from the
/// first, second or third on.
pub fn forms_in_turn(device: &Arc<Device>, scene: &Scene, turn: usize) -> Vec<Option<Form>> {
    let forms = forms_here(device, scene);
    let first = turn % FORM_TURNS % forms.len();
    forms.into_iter().skip(first).step_by(FORM_TURNS).collect()
}

/// The forms of a method that the self-check found right; where another driver draws in all forms, those with the bounds test.
pub fn right_forms(device: &Arc<Device>, method: MethodName) -> Vec<Option<Form>> {
    let mut forms = forms(device, method);
    forms.retain(|form| trusted(device, method, *form));
    let by_bounds = |form: &Option<Form>| form.is_none_or(|form| form.cull == Cull::Bounds);
    if some_forms() && forms.iter().any(by_bounds) {
        forms.retain(by_bounds);
    }
    forms
}

/// A number that is the same in every run, and most likely another one for another scene.
fn number_of(scene: &Scene) -> usize {
    let text = serde_json::to_string(&scene.settings).expect("settings are JSON");
    // The hash of Fowler, Noll and Vo, in 32 bits.
    let hash = text.bytes().fold(0x811c_9dc5, |hash: u32, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193));
    (hash >> 8) as usize
}

/// Ray casters of a device, the first of those that differ in no more than the distances they read; of loops, in no more than what they
/// leap with.
pub fn shapes() -> Vec<&'static Method> {
    let shape = |method: &Method| {
        let ahead = (method.skips_blocks(), method.distance().is_some());
        (method.ends_rays, ahead, method.fused, method.traversal)
    };
    let mut shapes: Vec<&Method> = Vec::new();
    for method in
        METHODS.into_iter().filter(|method| method.on_device && method.takes_samples() && method.stack().is_none())
    {
        let leaps = method.loops() && method.looks_ahead();
        if !leaps && shapes.iter().all(|one| shape(one) != shape(method)) {
            shapes.push(method);
        }
    }
    shapes
}

/// Whether a loop is one of those that a scene is drawn by in its turn: fragment or compute shaders, the one that does not leap and one
/// that does. Drivers take most of their time to compile them.
pub fn loops_in_turn(method: &Method, turn: usize) -> bool {
    let kind = if turn.is_multiple_of(2) { Traversal::FragmentLoop } else { Traversal::ComputeLoop };
    let leaps = match turn / 2 % 3 {
        0 => Ahead::Blocks,
        1 => Ahead::Distances(Distance::Omni),
        _ => Ahead::Distances(Distance::Directional),
    };
    method.traversal == kind && [Ahead::Nothing, leaps].contains(&method.ahead)
}

/// Whether a method is one of those that a scene is drawn by in its turn: every ray caster of several passes, loops as
/// [`loops_in_turn`], and of slices one stack, back to front, front to back, and with one way to skip.
pub fn in_turn(method: &Method, turn: usize) -> bool {
    let ahead = if (turn / STACKS.len()).is_multiple_of(2) { Ahead::Blocks } else { Ahead::Distances(Distance::Omni) };
    match method.traversal {
        Traversal::Passes | Traversal::Shells | Traversal::Cells(_) => true,
        Traversal::FragmentLoop | Traversal::ComputeLoop => loops_in_turn(method, turn),
        Traversal::Slices(stack) => {
            stack == STACKS[turn % STACKS.len()] && [Ahead::Nothing, ahead].contains(&method.ahead)
        }
    }
}

const STACKS: [Stack; 3] = [Stack::View, Stack::Objects, Stack::Shells];

/// Methods whose pictures are that of `rc-ert`, bit for bit.
pub fn lawful() -> impl Iterator<Item = &'static Method> {
    METHODS.into_iter().filter(|method| method.under_the_law() && method.traversal == Traversal::Passes)
}

/// A view by its name: eye and target.
pub type NamedView = (&'static str, [f64; 3], [f64; 3]);

/// What one scene keeps on the device for all its views and methods, and compiled pipelines for the next one too.
pub struct Stage {
    device: Arc<Device>,
    structures: Structures,
    resident: Resident,
    pub early_end: Option<EarlyEnd>,
    /// The most texels of a buffer that plans count on.
    pub most_texels: u32,
}

/// A picture and what was counted.
#[derive(Clone, Debug)]
pub struct Shot {
    pub plan: Plan,
    pub picture: Vec<[f32; 4]>,
    pub run: FrameRun,
}

impl Stage {
    pub fn new(device: &Arc<Device>) -> Self {
        let (structures, resident) = (Structures::default(), harness::lent(device));
        let most_texels = device.info.max_texel_buffer;
        Self { device: device.clone(), structures, resident, early_end: None, most_texels }
    }

    /// Makes room for another volume or transfer function; what was compiled stays.
    pub fn clear(&mut self) {
        self.structures = Structures::default();
        self.resident.forget_scene();
    }

    /// One frame with counts.
    pub fn shoot(&mut self, scene: &Scene, form: Option<Form>) -> Shot {
        // The host builds, which is the faster on most devices under test.
        let choice = Choice { form, on_host: true, most_texels: Some(self.most_texels), ..Choice::default() };
        let plan = plan::plan_for(scene, choice).expect("a plan");
        self.resident.prepare(scene, &plan).expect("room on the device");
        let mut frame = GpuFrame::new(&self.device, scene, &plan, &mut self.resident, self.early_end)
            .expect("a frame for the device");
        let run = frame.run(Measure::Counts { statistics: false }).expect("a frame");
        Shot { plan, picture: frame.picture().expect("a picture"), run }
    }

    /// The same in f64.
    pub fn twin(&mut self, scene: &Scene, form: Option<Form>) -> CpuFrame {
        let plan = plan::plan(scene, form).expect("a plan");
        self.structures.prepare(scene, &plan);
        cpu::run(scene, &plan, &self.structures, self.device.info.sub_pixel_bits)
    }
}

impl Drop for Stage {
    fn drop(&mut self) {
        let resident = std::mem::replace(&mut self.resident, Resident::new(&self.device));
        harness::give_back(&self.device, resident);
    }
}

/// Pixels whose bits differ.
pub fn differing(a: &[[f32; 4]], b: &[[f32; 4]]) -> usize {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).filter(|(p, q)| p.map(f32::to_bits) != q.map(f32::to_bits)).count()
}

/// What the self-check found on the device under test.
pub fn checked(device: &Arc<Device>) -> &'static SelfCheck {
    static CHECK: OnceLock<SelfCheck> = OnceLock::new();
    CHECK.get_or_init(|| self_check(device).expect("the self-check runs"))
}
