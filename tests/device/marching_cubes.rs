//! Shells by compute shaders are those of the host: the same vertices in the same order, the same triangles; and a level that changes
//! leaves the others.

use std::sync::Arc;

use depthleap::frame::Resident;
use depthleap::measure::limits;
use depthleap::method::SHELLS;
use depthleap::plan::builds::Maker;
use depthleap::plan::{Choice, Plan, plan_for};
use depthleap::read;
use depthleap::resource;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::settings::{Settings, ShellMode, VolumeTexture};
use depthleap::scene::shells::{Faces, polygons};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, Scene, Shells, Volume};
use depthleap::vulkan::{Device, DeviceInfo};

use crate::frame::recorded::alone;
use crate::harness::{Need, Test, data, test};

/// How far a place that is found in f32 among a texture's values may be from that in f64 among x, in units of volume space: values of
/// neighbours differ by a code at the least, of which levels lie a part off.
const APART: f32 = 3e-6;

pub fn tests() -> Vec<Test> {
    let of = |name: &str, run: fn(&Arc<Device>)| test(name, run);
    let mut tests = vec![
        of("numbers_of_a_signal", |device| agree(device, &shells("shells:35x33x31", |_| {}))),
        of("bytes_in_16_bits", |device| agree(device, &in_16_bits())),
        of("numbers", |device| agree(device, &random([31, 6, 5], Voxels::F32, NanPolicy::Replace, |v| v))),
        of("holes", |device| {
            agree(device, &random([13, 34, 7], Voxels::F32, NanPolicy::Hole, |v| if v < 0.02 { f32::NAN } else { v }))
        }),
        of("plateaus", |device| {
            agree(device, &random([70, 5, 4], Voxels::F32, NanPolicy::Replace, |v| (4.0 * v).round() / 4.0))
        }),
        of("words", |device| {
            let words = |values: Vec<f32>| Voxels::I16(values.iter().map(|v| (9000.0 * v - 4000.0) as i16).collect());
            agree(device, &random([19, 22, 17], words, NanPolicy::Replace, |v| v));
        }),
        of("one_voxel", |device| agree(device, &random([1; 3], Voxels::F32, NanPolicy::Replace, |_| 0.7))),
        of("a_sheet", |device| agree(device, &random([40, 33, 1], Voxels::F32, NanPolicy::Replace, |v| v))),
        of("sums_of_sums", |device| agree(device, &shells("shells:80", |s| s.shells.count = 1))),
        of("a_level_that_changes_leaves_the_others", a_level_that_changes),
        of("shells_that_do_not_fit_are_refused_before_they_are_made", too_large),
    ];
    for name in ["neghip.nrrd", "mra_tof.nrrd"] {
        let run = move |device: &Arc<Device>| {
            let mut settings = settings(|s| s.shells.count = 2);
            settings.volume.path = Some(data(name));
            agree(device, &read::scene(&settings).expect("a sound scene"));
        };
        tests.push(test(name, run).needs(Need::Data(name)));
    }
    tests.into_iter().map(|test| test.within("marching_cubes")).collect()
}

fn settings(change: impl FnOnce(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    (settings.method.name, settings.shells.mode) = (SHELLS.name(), Some(ShellMode::Max));
    (settings.shells.count, settings.image.size) = (3, [40, 30]);
    change(&mut settings);
    settings
}

fn shells(volume: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = settings(change);
    settings.volume.builtin = Some(volume.to_owned());
    read::scene(&settings).expect("a sound scene")
}

/// Shells of voxels without any order, of any spacing.
fn random(dims: [usize; 3], voxels: fn(Vec<f32>) -> Voxels, nan: NanPolicy, value: fn(f32) -> f32) -> Scene {
    let values = (0..dims.iter().product()).map(|i: usize| value((i * 7919 % 997) as f32 / 997.0)).collect();
    let volume = Volume::new("random", dims, [1.0, 2.5, 0.7], voxels(values)).expect("a sound volume");
    let range = match volume.voxels {
        Voxels::F32(_) => Some([0.0, 1.0]),
        _ => None,
    };
    let field = Field::new(volume, range, nan).expect("a sound field");
    let settings = settings(|s| {
        s.shells.shell_levels =
            [0.25, 0.5, 0.77].map(|x| field.range[0] + x * (field.range[1] - field.range[0])).to_vec()
    });
    let mut scene = shells("constant:2", |_| {});
    scene.shells = Shells::new(&settings.shells, &field, None).expect("sound levels").map(Arc::new);
    (scene.settings, scene.field) = (settings, Arc::new(field));
    scene
}

fn in_16_bits() -> Scene {
    let bytes = |values: Vec<f32>| Voxels::U8(values.iter().map(|v| (255.0 * v) as u8).collect());
    let mut scene = random([20, 34, 9], bytes, NanPolicy::Replace, |v| v);
    scene.settings.volume.texture = VolumeTexture::R16;
    scene
}

fn on_device(scene: &Scene) -> Plan {
    plan_for(scene, Choice::default()).expect("a plan")
}

/// The polygons of each shell, by compute shaders and by the host.
fn agree(device: &Arc<Device>, scene: &Scene) {
    let plan = on_device(scene);
    let mut resident = Resident::new(device);
    resident.prepare(scene, &plan).expect("room on the device");
    let all = &scene.shells.as_ref().expect("shells").list;
    let mut triangles = 0;
    for (number, shell) in all.iter().enumerate() {
        let host = polygons(&scene.field, shell.emission as f32, Faces::Closed).expect("room");
        if host.triangles.is_empty() {
            continue;
        }
        let built = plan.builds.iter().find(|build| build.asset.level == Some(shell.level)).expect("it is built");
        assert_eq!(built.maker, Maker::Compute);
        let bytes = resident.read_shell(&plan, number as u16).expect("a copy").expect("it is there");
        let (vertices, numbers) = bytes.split_at(size_of_val(host.corners.as_slice()));
        let found: Vec<[u32; 3]> = bytemuck::pod_collect_to_vec(numbers);
        let apart = found.iter().zip(&host.triangles).position(|(a, b)| a != b);
        assert_eq!((apart, found.len()), (None, host.triangles.len()), "triangles at {}", shell.level);
        let found: Vec<[f32; 3]> = bytemuck::pod_collect_to_vec(vertices);
        for (i, (found, host)) in found.iter().zip(&host.corners).enumerate() {
            let apart = (0..3).map(|axis| (found[axis] - host[axis]).abs()).fold(0.0, f32::max);
            assert!(apart <= APART, "vertex {i} at {}: {found:?}, of the host {host:?}", shell.level);
        }
        triangles += host.triangles.len();
    }
    assert!(triangles > 0, "there are no polygons");
}

/// Asked of a plan alone, whose shells are counted and not made.
fn too_large(device: &Arc<Device>) {
    let scene = shells("shells:40", |s| s.shells.count = 5);
    let plan = on_device(&scene);
    let bytes: u64 = resource::shell_bytes(&scene).iter().sum();
    let info = || device.info.clone();
    assert!(limits::check_device(&info(), &scene, &plan).is_ok());
    let small = DeviceInfo { memory_bytes: bytes - 1, ..info() };
    let said = limits::check_device(&small, &scene, &plan).expect_err("it does not fit").to_string();
    assert!(said.contains("shells that take") && said.contains("fewer shells"), "{said}");
    let few = DeviceInfo { max_vertex_number: 1000, ..info() };
    let said = limits::check_device(&few, &scene, &plan).expect_err("it does not fit").to_string();
    assert!(said.contains("numbers at most 1000"), "{said}");
}

fn a_level_that_changes(_: &Arc<Device>) {
    let device = &alone();
    let levels = |levels: &[f64], disabled: &[u32]| {
        shells("jets:16", |s| (s.shells.shell_levels, s.shells.disabled) = (levels.to_vec(), disabled.to_vec()))
    };
    let mut resident = Resident::new(device);
    let mut prepare = |scene: &Scene| {
        let plan = on_device(scene);
        device.begin_trace();
        resident.prepare(scene, &plan).expect("room on the device");
        let made = device.end_trace().iter().filter(|step| step.starts_with("shell_polygons")).count();
        let shell = resident.read_shell(&plan, 1).expect("a copy");
        (made, shell.map(|bytes| bytes.len()))
    };
    let (first, second) = prepare(&levels(&[50.0, 100.0, 150.0], &[]));
    assert_eq!(first, 3);
    let (changed, other) = prepare(&levels(&[50.0, 110.0, 150.0], &[]));
    assert_eq!(changed, 1);
    assert_ne!(second, other);
    assert_eq!(prepare(&levels(&[50.0, 110.0, 150.0], &[2])).0, 0, "one is left out");
    assert_eq!(prepare(&levels(&[50.0, 110.0, 150.0], &[])), (0, other), "and comes back");
    assert_eq!(
        prepare(&levels(&[20.0, 50.0, 110.0, 150.0], &[])).0,
        1,
        "one is added, which others have numbers after"
    );
    assert_eq!(prepare(&levels(&[50.0, 150.0], &[])).0, 0, "one is removed");
    assert_eq!(prepare(&levels(&[50.0, 110.0, 150.0], &[])).0, 1, "and is made again");
}
