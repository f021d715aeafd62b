//! How volumes are kept and interpolated on a device: what the plan states holds, and skipping stays lossless for fields
//! with nearest voxels, no data, empty and narrow ranges.

use std::collections::BTreeMap;
use std::sync::Arc;

use depthleap::method::{self, METHODS};
use depthleap::part::rows::Method;
use depthleap::plan;
use depthleap::read;
use depthleap::scene::range::RangeEnd::{Percentile, Value};
use depthleap::scene::settings::{Component, Filter, Settings, VolumeTexture};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, Scene, TransferFunction, Volume, field::NanPolicy, transfer::Knot};
use depthleap::vulkan::Device;

use super::scenes::{Shot, Stage, VIEWS, by, checked, differing, forms, lawful, scene, seen, shapes};
use crate::formulas::Random;
use crate::harness::{Need, Test, share, test};

/// Voxels along the sides of the volumes.
const DIMS: [usize; 3] = [11, 12, 10];

pub fn tests() -> Vec<Test> {
    let mut tests = vec![
        test("textures::default_is_as_precise_as_its_plan_states", default_is_as_precise_as_its_plan_states),
        test("textures::named_format_is_warned_of", named_format_is_warned_of),
        test("textures::empty_range_shows_x_zero", empty_range_shows_x_zero),
        test("textures::nearest_is_that_of_the_twin", nearest_is_that_of_the_twin),
        test("textures::nothing_between_labels_shows", nothing_between_labels_shows).needs(Need::Thoroughness),
        test("textures::every_label_is_told_from_its_neighbours", every_label_is_told_from_its_neighbours),
    ];
    for (number, (name, make)) in LAWFUL.into_iter().enumerate() {
        let run = move |device: &Arc<Device>| law(device, &make(device), number);
        tests.push(test(&format!("textures::law_of_skipping::{name}"), run));
    }
    tests
}

/// A scene of these voxels, on the device's texture unit.
fn of(device: &Arc<Device>, voxels: Voxels, tf: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut scene = scene("constant:4", tf, |s| {
        s.image.size = [62, 48];
        change(s);
    });
    let volume = Volume::new("made", DIMS, [1.0, 1.2, 0.8], voxels).expect("a volume");
    scene.field = Arc::new(Field::of(volume, &scene.settings.volume.normalisation()).expect("a field"));
    scene.unit = checked(device).unit;
    scene
}

/// A scene of a file with the sparse voxels and these lines in its header: alone, or as the middle one of three components.
fn of_file(device: &Arc<Device>, lines: &str, components: usize, change: impl FnOnce(&mut Settings)) -> Scene {
    let Voxels::U8(voxels) = sparse() else { unreachable!("made as u8") };
    let values: Vec<u8> = match components {
        1 => voxels,
        _ => voxels.iter().flat_map(|&v| [255 - v, v, v / 2]).collect(),
    };
    let [x, y, z] = DIMS;
    let sizes = if components == 1 { format!("{x} {y} {z}") } else { format!("{components} {x} {y} {z}") };
    let space = if lines.contains("space directions") { "space dimension: 3\n" } else { "" };
    let header = format!("NRRD0005\ntype: uint8\nencoding: raw\n{space}{lines}\nsizes: {sizes}\n\n");
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("made.nrrd");
    std::fs::write(&path, [header.as_bytes(), &values].concat()).expect("a file");
    let mut settings = Settings::default();
    settings.volume.path = Some(path);
    settings.transfer.preset = Some("surface".to_owned());
    settings.image.size = [62, 48];
    settings.sampling.samples_per_pass = 4;
    change(&mut settings);
    let mut scene = read::scene(&settings).expect("a sound scene");
    scene.unit = checked(device).unit;
    scene
}

/// `value` for each voxel.
fn each<T>(value: impl FnMut(usize) -> T) -> Vec<T> {
    (0..DIMS.iter().product()).map(value).collect()
}

/// Two to eight points, now and then a jump.
fn random_transfer(random: &mut Random) -> TransferFunction {
    let count = 2 + (random.next() * 7.0) as usize;
    let mut x = vec![];
    for i in 0..count {
        x.push(if i > 0 && random.next() < 0.1 { x[i - 1] } else { random.next() });
        x.sort_by(f64::total_cmp);
    }
    let knot = |x: f64| {
        let opacity = if random.next() < 0.4 { 0.0 } else { 0.3 * random.next() };
        Knot { x, color: [random.next(), random.next(), random.next()], opacity }
    };
    TransferFunction::new("random", x.into_iter().map(knot).collect(), 1.0).expect("a transfer function")
}

/// Voxels of a type that fill `1 / 2^halvings` of its range.
fn narrow(kind: usize, halvings: i32, random: &mut Random) -> Voxels {
    let part = 0.5f64.powi(halvings);
    let begin = (1.0 - part) * random.next();
    let mut at = |least: f64, codes: f64| least + ((begin + part * random.next()) * codes).floor();
    match kind {
        0 => Voxels::U8(each(|_| at(0.0, 256.0) as u8)),
        1 => Voxels::I8(each(|_| at(-128.0, 256.0) as i8)),
        2 => Voxels::U16(each(|_| at(0.0, 65536.0) as u16)),
        3 => Voxels::I16(each(|_| at(-32768.0, 65536.0) as i16)),
        _ => Voxels::F32(each(|_| (begin + part * random.next()) as f32)),
    }
}

fn largest(a: &Shot, b: &Shot) -> f64 {
    let channels = a.picture.as_flattened().iter().zip(b.picture.as_flattened());
    channels.map(|(p, q)| f64::from((p - q).abs())).fold(0.0, f64::max)
}

fn extremes(voxels: &Voxels) -> [f64; 2] {
    let values = (0..voxels.len()).map(|i| voxels.get(i));
    [values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max)]
}

fn default_is_as_precise_as_its_plan_states(device: &Arc<Device>) {
    let mut random = Random(31);
    let mut stage = Stage::new(device);
    let mut telling = 0;
    for kind in 0..5 {
        for halvings in [1, 2, 4, 7, 9, 12, 15] {
            let voxels = narrow(kind, halvings, &mut random);
            let range = extremes(&voxels).map(Value);
            let mut plain = of(device, voxels, "linear", |s| {
                (s.volume.range, s.sampling.termination) = (Some(range), 1.0);
            });
            plain.transfer = random_transfer(&mut random);
            let mut exact = plain.clone();
            (exact.settings.sampling.filter, exact.settings.volume.texture) = (Filter::Exact, VolumeTexture::R32f);
            for method in [method::RC.name(), method::NN_OMNI.name()] {
                let form = forms(device, method).pop().flatten();
                let shots = [&plain, &exact].map(|scene| {
                    stage.clear();
                    stage.shoot(&by(scene, method), form)
                });
                let (off, stated) = (largest(&shots[0], &shots[1]), shots[0].plan.pixel_error);
                let texture = shots[0].plan.texture.expect("a texture");
                assert!(texture.error <= plain.settings.volume.precision, "{kind}, 1/2^{halvings}: {texture:?}");
                assert!(off <= stated, "{kind}, 1/2^{halvings}: {off:e} off where {stated:e} is stated, {texture:?}");
                telling += usize::from(stated < 0.05);
            }
        }
    }
    // Jumps have no bound but the brightest colour; most have one that tells something.
    assert!(telling > 20, "only {telling} bounds are below 0.05");
}

/// A 0/1 mask in the codes of its type, which fill 1/255 of them: units that round to codes are far off, and say so.
fn named_format_is_warned_of(device: &Arc<Device>) {
    let mask = of(device, Voxels::U8(each(|i| u8::from(i % 3 == 0))), "linear", |s| {
        s.volume.range = Some([0.0, 1.0].map(Value));
        s.volume.texture = VolumeTexture::Native;
        s.sampling.termination = 1.0;
    });
    let scene = by(&mask, method::RC.name());
    let native = Stage::new(device).shoot(&scene, None);
    let mut exact = scene.clone();
    (exact.settings.sampling.filter, exact.settings.volume.texture) = (Filter::Exact, VolumeTexture::R32f);
    let off = largest(&native, &Stage::new(device).shoot(&exact, None));
    let error = native.plan.texture.expect("a texture").error;
    let warned =
        plan::warnings(&scene, &native.plan).iter().any(|warning| warning.contains("an interpolated x is off"));
    assert_eq!(warned, error > scene.settings.volume.precision, "{error:e}");
    assert!(off <= native.plan.pixel_error, "{off:e} off where {:e} is stated", native.plan.pixel_error);
    // What is not warned of is not far off.
    assert!(warned || off < 1e-3, "{off:e} off without a warning");
}

fn empty_range_shows_x_zero(device: &Arc<Device>) {
    let value = 100.0;
    let mut stage = Stage::new(device);
    for voxels in [Voxels::U8(each(|_| 100)), Voxels::I16(each(|i| 90 + i as i16 % 20)), Voxels::F32(each(|_| 100.0))] {
        for tf in ["surface", "haze"] {
            let textures = [VolumeTexture::Auto, VolumeTexture::Native, VolumeTexture::R16, VolumeTexture::R32f];
            // Loops join samples in another order than passes do.
            let mut first: BTreeMap<String, Vec<[f32; 4]>> = BTreeMap::new();
            for (texture, method) in
                textures.into_iter().flat_map(|t| shapes().into_iter().map(move |method| (t, method)))
            {
                let order = format!("{:?}", method.traversal);
                let method = method.name();
                let scene = of(device, voxels.clone(), tf, |s| {
                    (s.volume.range, s.volume.texture) = (Some([value, value].map(Value)), texture);
                    s.sampling.termination = 1.0;
                });
                let scene = by(&scene, method);
                let form = forms(device, method).pop().flatten();
                stage.clear();
                let picture = stage.shoot(&scene, form).picture;
                let shows = picture.iter().any(|pixel| pixel[3] > 0.0);
                assert_eq!(shows, tf == "haze", "{tf}, {texture:?}, {}", method.name());
                let same = differing(&picture, first.entry(order).or_insert_with(|| picture.clone()));
                assert_eq!(same, 0, "{tf}, {texture:?}, {}", method.name());
            }
        }
    }
}

/// Labels in lumps, of which the middle one is rare.
fn labels() -> Voxels {
    let lump = |i: usize| {
        let [x, y, z] = [i % DIMS[0], i / DIMS[0] % DIMS[1], i / (DIMS[0] * DIMS[1])];
        (x / 4 * 5 + y / 3 * 3 + z / 4 * 7) % 6
    };
    Voxels::U8(each(|i| [0, 0, 200, 0, 100, 0][lump(i)]))
}

/// The transfer function that shows label 100 alone.
fn only_100(mut scene: Scene) -> Scene {
    let knot = |x, opacity| Knot { x, color: [1.0, 0.2, 0.0], opacity };
    let knots = vec![knot(0.25, 0.0), knot(0.25, 0.6), knot(0.6, 0.6), knot(0.6, 0.0)];
    scene.transfer = TransferFunction::new("only 100", knots, 1.0).expect("a transfer function");
    scene
}

fn nearest_is_that_of_the_twin(device: &Arc<Device>) {
    let scene = only_100(of(device, labels(), "ramp", |s| s.sampling.filter = Filter::Nearest));
    let mut stage = Stage::new(device);
    for view in VIEWS {
        for method in shapes().into_iter().map(Method::name) {
            let scene = by(&seen(&scene, view), method);
            let shot = stage.shoot(&scene, forms(device, method).pop().flatten());
            let twin = stage.twin(&scene, method::papers_form(method));
            let decided = twin.undecided.iter().filter(|undecided| !**undecided).count();
            assert!(decided > twin.undecided.len() * 9 / 10, "{}: {decided} pixels decided", view.0);
            for (i, (found, right)) in shot.picture.iter().zip(&twin.pixels).enumerate() {
                let off = (0..4).map(|c| (f64::from(found[c]) - right[c]).abs()).fold(0.0, f64::max);
                assert!(off < 2e-5 || twin.undecided[i], "{}, {}: pixel {i} is {off:e} off", method.name(), view.0);
            }
        }
    }
}

fn nothing_between_labels_shows(device: &Arc<Device>) {
    let far = || Voxels::U8(each(|i| if i % 5 < 2 { 200 } else { 0 }));
    for method in METHODS.into_iter().filter(|method| method.on_device && method.takes_samples()) {
        let scene = only_100(of(device, far(), "ramp", |s| s.sampling.filter = Filter::Nearest));
        let scene = by(&scene, method.name());
        let shot = Stage::new(device).shoot(&scene, forms(device, method.name()).pop().flatten());
        assert!(shot.picture.iter().all(|pixel| *pixel == [0.0; 4]), "{}", method.name);
        if method.marks_sections() {
            let main: u64 = shot.run.fragments.expect("counts").main.iter().sum();
            assert_eq!(main, 0, "{} runs main fragments for nothing", method.name);
        }
    }
}

/// Transfer functions that jump at a label itself: whether it shows is for the last bit to say, in every format alike.
fn every_label_is_told_from_its_neighbours(device: &Arc<Device>) {
    let mut stage = Stage::new(device);
    for most in [7u16, 11] {
        let voxels = || Voxels::U16(each(|i| (i as u16 / 3) % (most + 1)));
        for label in 1..most {
            let [begin, end] = [label, label + 1].map(|label| f64::from(label) / f64::from(most));
            let knot = |x, opacity| Knot { x, color: [1.0; 3], opacity };
            let knots = vec![knot(begin, 0.0), knot(begin, 0.6), knot(end, 0.6), knot(end, 0.0)];
            let shot = |texture| {
                stage.clear();
                let mut scene = of(device, voxels(), "ramp", |s| {
                    (s.sampling.filter, s.volume.texture) = (Filter::Nearest, texture);
                });
                scene.transfer = TransferFunction::new("one label", knots.clone(), 1.0).expect("a transfer function");
                stage.shoot(&by(&scene, method::RC.name()), None)
            };
            let [auto, native, float] = [VolumeTexture::Auto, VolumeTexture::Native, VolumeTexture::R32f].map(shot);
            assert!(auto.picture.iter().any(|pixel| pixel[3] > 0.0), "label {label} of {most} does not show");
            for other in [native, float] {
                assert_eq!(differing(&auto.picture, &other.picture), 0, "label {label} of {most}");
            }
        }
    }
}

/// A scene to be made on a device, by name.
type Lawful = (&'static str, fn(&Arc<Device>) -> Scene);

const LAWFUL: [Lawful; 11] = [
    ("nearest", |device| only_100(of(device, labels(), "ramp", |s| s.sampling.filter = Filter::Nearest))),
    ("nearest, cells of four", |device| {
        only_100(of(device, labels(), "ramp", |s| {
            (s.sampling.filter, s.method.cell, s.sampling.step) = (Filter::Nearest, 4, 0.4);
        }))
    }),
    ("no data, replaced", |device| of(device, with_no_data(), "surface", |s| s.volume.no_data = vec![-9999.0])),
    ("no data, holes", |device| {
        of(device, with_no_data(), "surface", |s| {
            (s.volume.no_data, s.volume.nan) = (vec![-9999.0], NanPolicy::Hole);
        })
    }),
    ("no data, nearest holes", |device| {
        of(device, with_no_data(), "surface", |s| {
            (s.volume.no_data, s.volume.nan, s.sampling.filter) = (vec![-9999.0], NanPolicy::Hole, Filter::Nearest);
        })
    }),
    ("percentiles", |device| {
        of(device, sparse(), "ramp", |s| s.volume.range = Some([Percentile(10.0), Percentile(99.0)]))
    }),
    ("a range that clips", |device| {
        of(device, sparse(), "surface", |s| {
            (s.volume.range, s.volume.texture) = (Some([150.0, 160.0].map(Value)), VolumeTexture::Native);
        })
    }),
    ("reoriented voxels", |device| {
        of_file(device, "dimension: 3\nspace directions: (0,0,2) (-1,0,0) (0,1.5,0)", 1, |_| {})
    }),
    ("a tilted volume", |device| {
        of_file(device, "dimension: 3\nspace directions: (0.8,0.6,0) (-0.48,0.64,0.6) (0.36,-0.48,0.8)", 1, |_| {})
    }),
    ("one of three components", |device| {
        of_file(device, "dimension: 4\nkinds: RGB-color domain domain domain", 3, |s| {
            s.volume.component = Some(Component::Number(1));
        })
    }),
    ("an empty range", |device| of(device, sparse(), "haze", |s| s.volume.range = Some([150.0, 150.0].map(Value)))),
];

/// Lumps of 200 in 0, with a slope about them.
fn sparse() -> Voxels {
    Voxels::U8(each(|i| {
        let [x, y, z] = [i % DIMS[0], i / DIMS[0] % DIMS[1], i / (DIMS[0] * DIMS[1])];
        let near = [[2, 3, 3], [8, 8, 6]].map(|[a, b, c]: [usize; 3]| x.abs_diff(a) + y.abs_diff(b) + z.abs_diff(c));
        [200, 155, 60][near[0].min(near[1]).min(2)] * u8::from(near[0].min(near[1]) < 3)
    }))
}

fn with_no_data() -> Voxels {
    let Voxels::U8(values) = sparse() else { unreachable!("made as u8") };
    Voxels::I16(values.iter().enumerate().map(|(i, v)| if i % 37 == 5 { -9999 } else { i16::from(*v) }).collect())
}

/// Every method from two sides against `rc-ert`, bit for bit, in the form that every device has.
fn law(device: &Arc<Device>, scene: &Scene, number: usize) {
    let mut stage = Stage::new(device);
    for (side, view) in [VIEWS[1], VIEWS[2]].into_iter().enumerate() {
        let scene = seen(scene, view);
        let rule = stage.shoot(&by(&scene, method::RC_ERT.name()), method::papers_form(method::RC_ERT.name()));
        for method in share(lawful().map(Method::name), number + side) {
            let shot = stage.shoot(&by(&scene, method), forms(device, method).pop().flatten());
            assert_eq!(differing(&shot.picture, &rule.picture), 0, "{}, {}", method.name(), view.0);
        }
    }
}
