//! Distances built by compute shaders are those of the host, voxel for voxel; what is built again when something
//! changes, and what is not.

use std::sync::Arc;

use depthleap::frame::{Resident, Structures};
use depthleap::method::{self, METHODS};
use depthleap::part::rows::Method;
use depthleap::plan::plan;
use depthleap::read;
use depthleap::resource;
use depthleap::resource::texels::Texels;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::gradients::GradientCoding;
use depthleap::scene::settings::{
    Builder, CELLS, Filter, GradientOperator, GradientTexture, Gradients, MethodName, Settings, ShadingSettings,
    VolumeTexture,
};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, Scene, TransferFunction, Volume};
use depthleap::structure::gradients::texels;
use depthleap::vulkan::Device;

use crate::frame::scenes::{VIEWS, by, seen};
use crate::harness::{Need, Test, data, test};

/// One method for each kind of distances.
fn methods() -> impl Iterator<Item = MethodName> {
    METHODS.into_iter().filter(|method| method.distance().is_some() && !method.fused).map(Method::name)
}

/// Built-in volumes: sizes that fill no word, one voxel thick, longer than a distance can be, in the type's own units.
const BUILT_IN: [(&str, &str); 8] = [
    ("shells:48", "ramp"),
    ("blocks:37x41x29", "surface"),
    ("jets:33x65x30", "ramp"),
    ("marschner-lobb:20", "haze"),
    ("shells:64x64x1", "ramp"),
    ("jets:1x40x1", "linear"),
    ("blocks:600x5x4", "surface"),
    ("constant:1", "linear"),
];

pub fn tests() -> Vec<Test> {
    let mut tests: Vec<Test> = BUILT_IN
        .into_iter()
        .map(|(volume, tf)| {
            test(&format!("device_and_host_agree::{volume}::{tf}"), move |device| {
                agree(device, &built_in(volume, tf, |_| {}));
            })
        })
        .collect();
    for texture in [VolumeTexture::R16, VolumeTexture::R32f] {
        let run =
            move |device: &Arc<Device>| agree(device, &built_in("shells:30", "ramp", |s| s.volume.texture = texture));
        tests.push(test(&format!("device_and_host_agree::{texture:?}"), run));
    }
    let nearest = |device: &Arc<Device>| {
        agree(device, &built_in("blocks:33x20x30", "surface", |s| s.sampling.filter = Filter::Nearest));
    };
    tests.push(test("device_and_host_agree::nearest", nearest));
    for (name, tf) in [("fuel.nrrd", "ramp"), ("nucleon.nrrd", "linear"), ("mra_tof.nrrd", "ramp")] {
        let run = move |device: &Arc<Device>| {
            let mut settings = Settings::default();
            settings.volume.path = Some(data(name));
            settings.transfer.preset = Some(tf.to_owned());
            agree(device, &read::scene(&settings).expect("a sound scene"));
        };
        tests.push(test(&format!("device_and_host_agree::{name}"), run).needs(Need::Data(name)));
    }
    tests.push(test("device_and_host_agree::spacings_and_holes", spacings_and_holes));
    tests.push(test("device_and_host_agree::nothing_and_all_interesting", nothing_and_all_interesting));
    for operator in [GradientOperator::Central, GradientOperator::Sobel] {
        let run = move |device: &Arc<Device>| gradients(device, operator);
        tests.push(test(&format!("device_and_host_agree::gradients::{operator:?}").to_lowercase(), run));
    }
    tests.push(test("another_transfer_function_keeps_the_ranges", another_transfer_function_keeps_the_ranges));
    tests.push(test("distances_of_the_host_follow_the_transfer_function", distances_of_the_host_follow));
    tests.into_iter().map(|test| test.within("structure")).collect()
}

fn built_in(volume: &str, tf: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(volume.to_owned());
    settings.transfer.preset = Some(tf.to_owned());
    change(&mut settings);
    read::scene(&settings).expect("a sound scene")
}

/// Every kind of distance, from two views and from within, in cells of every size.
fn agree(device: &Arc<Device>, scene: &Scene) {
    let mut resident = Resident::new(device);
    let large = scene.field.dims().iter().product::<usize>() > 1 << 20;
    for cell in CELLS.into_iter().filter(|cell| !large || *cell > 1) {
        for view in [VIEWS[0], VIEWS[1], VIEWS[2]] {
            for method in methods() {
                let mut scene = by(&seen(scene, view), method);
                scene.settings.method.cell = cell;
                let plan = plan(&scene, method::papers_form(method)).expect("a plan");
                let Some(lookup) = plan.distance else { continue };
                resident.prepare(&scene, &plan).expect("room on the device");
                let found = resident.read_distances(&lookup).expect("a copy").expect("distances were built");
                let mut host = Structures::default();
                host.prepare(&scene, &plan);
                let expected = &host.distance(&lookup).expect("distances were built").value;
                let name = format!("{}, cell {cell}, {}", method.name(), view.0);
                assert_eq!(found.len(), expected.bytes.len(), "{name}");
                let differing = found.iter().zip(&expected.bytes).filter(|(a, b)| a != b).count();
                let first = found.iter().zip(&expected.bytes).position(|(a, b)| a != b);
                let pair = first.map(|i| (i, found[i], expected.bytes[i]));
                assert_eq!(differing, 0, "{name}: of {} distances, the first: {pair:?}", found.len());
            }
        }
    }
}

fn spacings_and_holes(device: &Arc<Device>) {
    let dims = [23, 18, 31];
    for (spacing, policy) in [
        ([1.0, 2.5, 1.7], NanPolicy::Replace),
        ([2000.0, 1.0, 1.0], NanPolicy::Replace),
        ([0.3, 0.3, 0.9], NanPolicy::Hole),
    ] {
        let value = |i: usize| match i * 7919 % 997 {
            0..3 => 0.9,
            3 => f32::NAN,
            other => other as f32 * 2e-4,
        };
        let values = (0..dims.iter().product()).map(value).collect();
        let volume = Volume::new("dots", dims, spacing, Voxels::F32(values)).expect("a sound volume");
        let mut scene = built_in("constant:2", "ramp", |_| {});
        scene.field = Arc::new(Field::new(volume, Some([0.0, 1.0]), policy).expect("a sound field"));
        agree(device, &scene);
    }
}

fn nothing_and_all_interesting(device: &Arc<Device>) {
    let invisible = TransferFunction::new("invisible", Vec::new(), 1.0);
    let mut scene = built_in("shells:33", "haze", |_| {});
    agree(device, &scene);
    if let Ok(invisible) = invisible {
        scene.transfer = invisible;
        agree(device, &scene);
    }
}

/// Texels of gradients in every format, to the bit: of volumes kept in 8, in 16 bits and in f32, one voxel thick, of any spacing.
fn gradients(device: &Arc<Device>, operator: GradientOperator) {
    let random = |name: &str, dims: [usize; 3], voxels: fn(Vec<f32>) -> Voxels| {
        let value = |i: usize| (i * 7919 % 997) as f32 / 997.0;
        let values = (0..dims.iter().product()).map(value).collect();
        Volume::new(name, dims, [1.0, 2.5, 0.7], voxels(values)).expect("a sound volume")
    };
    let bytes = |values: Vec<f32>| Voxels::U8(values.iter().map(|v| (255.0 * v) as u8).collect());
    let words = |values: Vec<f32>| Voxels::I16(values.iter().map(|v| (9000.0 * v - 4000.0) as i16).collect());
    let volumes = [
        random("bytes", [23, 18, 31], bytes),
        random("a sheet of bytes", [40, 33, 1], bytes),
        random("words", [19, 22, 17], words),
        random("numbers", [21, 16, 14], Voxels::F32),
    ];
    for volume in volumes {
        for texture in [GradientTexture::Rgba8, GradientTexture::Rgba16f, GradientTexture::Rgba32f] {
            let mut settings = Settings::default();
            settings.surface.iso = Some(0.5);
            settings.shading =
                ShadingSettings { gradients: Gradients::Precomputed, gradient: operator, format: texture };
            settings.method.name = method::RC_ERT.name();
            let scene = read::scene_of(&settings, |_| Ok(volume.clone())).expect("a sound scene");
            let plan = plan(&scene, method::papers_form(method::RC_ERT.name())).expect("a plan");
            let mut resident = Resident::new(device);
            resident.prepare(&scene, &plan).expect("room on the device");
            let found = resident.read_gradients(&scene).expect("a copy").expect("gradients were built");
            let coding = GradientCoding::of(&scene);
            let expected = texels(&scene.field, &Texels::of(&scene).values, operator, &coding);
            let differing = found.iter().zip(&expected).filter(|(a, b)| a != b).count();
            let first = found.iter().zip(&expected).position(|(a, b)| a != b);
            let name = format!("{}, {}", volume.name, texture.name());
            assert_eq!((differing, found.len()), (0, expected.len()), "{name}: the first at {first:?}");
        }
    }
}

/// What depends on the volume alone stays, and distances are those of the new function.
fn another_transfer_function_keeps_the_ranges(device: &Arc<Device>) {
    let mut scene = by(&built_in("shells:48", "ramp", |s| s.method.cell = 4), method::NN_OMNI.name());
    let mut resident = Resident::new(device);
    let plan = plan(&scene, method::papers_form(method::NN_OMNI.name())).expect("a plan");
    let lookup = plan.distance.expect("distances");
    let mut found = Vec::new();
    for tf in ["ramp", "haze", "ramp"] {
        scene.transfer = TransferFunction::preset(tf, 1.0).expect("built in").expect("sound");
        resident.forget_transfer();
        assert!(resident.distance(&lookup).is_none());
        assert_eq!(resident.has(resource::CELL_RANGE.at(4)), !found.is_empty(), "ranges do not depend on the function");
        resident.prepare(&scene, &plan).expect("room on the device");
        found.push(resident.read_distances(&lookup).expect("a copy").expect("distances"));
    }
    assert_eq!(found[0], found[2]);
    assert_ne!(found[0], found[1]);
}

/// What the host updates is what it builds anew, for one look-up after another.
fn distances_of_the_host_follow(device: &Arc<Device>) {
    let mut resident = Resident::new(device);
    resident.follow_transfer();
    for method in [method::NN_OMNI.name(), method::NN_DIRECTIONAL.name(), method::NN_OMNI.name()] {
        let mut scene = by(&built_in("shells:48", "ramp", |s| s.method.build = Builder::Host), method);
        let plan = plan(&scene, method::papers_form(method)).expect("a plan");
        let lookup = plan.distance.expect("distances");
        let ramp = scene.transfer.clone();
        for by in [0.0, 1.0 / 255.0, 0.2, 0.0, 0.0] {
            scene.transfer = ramp.mapped(|x| x + by);
            resident.forget_transfer();
            resident.prepare(&scene, &plan).expect("room on the device");
            let found = resident.read_distances(&lookup).expect("a copy").expect("distances");
            let mut host = Structures::default();
            host.prepare(&scene, &plan);
            let expected = &host.distance(&lookup).expect("distances were built").value.bytes;
            assert!(found == *expected, "{}, moved by {by}", method.name());
        }
    }
}
