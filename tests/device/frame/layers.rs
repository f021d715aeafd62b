//! Polygons in the volume: layers that are peeled are those that a ray meets in f64, sorted; pictures and counts are those of the
//! twins, in every form; skipping changes nothing.

use std::collections::BTreeMap;
use std::sync::Arc;

use depthleap::part::Group;
use depthleap::part::form::Form;
use depthleap::plan::plan;
use depthleap::scene::Scene;
use depthleap::scene::settings::{Accumulate, Last, MeshSettings, Offset, PartialSegments, Settings};
use depthleap::vulkan::Device;

use super::compare::{self, same_picture};
use super::scenes::{Shot, Stage, VIEWS, by, differing, exactly, forms, forms_in_turn, lawful, scene, seen, shapes};
use crate::harness::{Need, Test, test};

type Meshes = fn() -> Vec<MeshSettings>;

/// Layers at the most of scenes whose segments are drawn apart: in the crowded one some surfaces lie behind.
const MOST_APART: u32 = 8;

/// What stands where, and how many layers it has; of large faces, since a rasteriser may see another one at each edge.
const SCENES: [(&str, u32, Meshes); 12] = [
    ("a sphere", 2, || vec![mesh("sphere:8")]),
    ("meshes that cut each other", 6, || {
        vec![mesh("torus:7"), MeshSettings { color: [0.1, 0.2, 0.9], scale: 0.7, ..mesh("box") }]
    }),
    ("across the faces of the box", 2, || vec![MeshSettings { scale: 1.3, translate: [0.2, 0.1, 0.0], ..mesh("box") }]),
    ("in front", 2, || vec![MeshSettings { scale: 0.2, translate: [0.1, 0.05, 0.9], ..mesh("box") }]),
    ("behind", 2, || vec![MeshSettings { scale: 0.6, translate: [0.0, 0.0, -1.5], ..mesh("sphere:8") }]),
    ("beside", 2, || vec![MeshSettings { scale: 0.3, translate: [0.8, 0.4, 0.0], ..mesh("sphere:8") }]),
    ("eight shells in each other", 16, || {
        (1..=8).map(|i| MeshSettings { scale: 0.12 * f64::from(i), opacity: 0.15, ..mesh("box") }).collect()
    }),
    ("two faces in one plane", 4, || {
        let faces = |color| MeshSettings { color, scale: 0.6, rotate: [0.0; 3], ..mesh("box") };
        vec![faces([0.9, 0.1, 0.1]), faces([0.1, 0.1, 0.9])]
    }),
    ("seen from inside", 1, || vec![MeshSettings { scale: 6.0, ..mesh("box") }]),
    ("through the eye", 1, || vec![MeshSettings { scale: 1.0, translate: [0.0, 0.0, 1.91], ..mesh("sphere:6") }]),
    ("opaque", 0, || vec![MeshSettings { opacity: 1.0, scale: 0.5, ..mesh("sphere:8") }]),
    ("an opaque one among transparent ones", 2, || {
        vec![mesh("box"), MeshSettings { opacity: 1.0, scale: 0.3, translate: [0.2, 0.0, 0.1], ..mesh("sphere:8") }]
    }),
];

pub fn mesh(builtin: &str) -> MeshSettings {
    MeshSettings {
        builtin: Some(builtin.to_owned()),
        color: [0.8, 0.5, 0.1],
        back: Some([0.2, 0.7, 0.4]),
        opacity: 0.4,
        rotate: [17.0, 29.0, 41.0],
        scale: 0.8,
        ..MeshSettings::default()
    }
}

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    for (number, (name, layers, meshes)) in SCENES.into_iter().enumerate() {
        for (turn, last) in [Last::Full, Last::Partial].into_iter().enumerate() {
            let scene = move || {
                scene("shells:24", "ramp", |settings| {
                    exactly(settings);
                    settings.meshes = meshes();
                    settings.image.size = [62, 50];
                    // As many as there are, and one that ends the peeling.
                    settings.layers.most = layers + 1;
                    settings.sampling.last = last;
                    if last == Last::Partial {
                        (settings.sampling.offset, settings.sampling.step) = (Offset::Midpoint, 0.8);
                    }
                })
            };
            let kind = if last == Last::Full { "whole samples" } else { "parts of samples" };
            let one = test(&format!("layers::{name}::{kind}"), move |device| {
                let scene = scene();
                assert_eq!(most_layers(&scene), layers, "layers of the scene");
                held(device, &scene, view_for(last), turn);
            });
            // One of the two of each scene is on either of two drivers.
            tests.push(one.needs(Need::Turn(number + turn)));
        }
    }
    for (name, layers, meshes) in [SCENES[0], SCENES[1], SCENES[6], SCENES[11]] {
        let most = (layers + 1).min(MOST_APART);
        let one = test(&format!("layers::{name}::partial segments apart"), move |device| apart(device, meshes, most));
        // The first is held on two drivers; what `matrix` has of it is drawn on every one.
        let need = if name == SCENES[0].0 { Need::Thoroughness } else { Need::AnyDriver };
        tests.push(one.needs(need));
    }
    let elsewhere = test("layers::partial_segments_apart_in_other_formats", apart_elsewhere);
    tests.push(elsewhere.needs(Need::EveryForm));
    tests.push(test("layers::ten_thousand_triangles_in_a_pixel", crowded).needs(Need::Thoroughness));
    tests.push(test("layers::fewer_than_there_are", fewer).needs(Need::Thoroughness));
    tests.push(test("layers::fragments_are_hardly_more", fragments));
    tests
}

/// Whole samples are seen head-on and parts of samples aslant, so that each scene is seen from both places.
pub fn view_for(last: Last) -> &'static [(&'static str, [f64; 3], [f64; 3])] {
    if last == Last::Full { &VIEWS[..1] } else { &VIEWS[1..2] }
}

/// The most surfaces that divide one ray.
pub fn most_layers(scene: &Scene) -> u32 {
    let of = |view| {
        let scene = seen(scene, view);
        let size = scene.settings.image.size;
        let rays = scene.camera.rays(size).expect("a camera");
        scene.polygons.lacking(&rays, size, 0).into_iter().max().unwrap_or(0)
    };
    VIEWS.into_iter().take(2).map(of).max().unwrap_or(0)
}

/// Methods that cover all ways to end and to skip give their twins' pictures and counts in the forms of this turn, and one picture.
pub fn held(device: &Arc<Device>, scene: &Scene, views: &[(&str, [f64; 3], [f64; 3])], turn: usize) {
    let mut stage = Stage::new(device);
    let (mut largest, mut undecided) = (0.0f64, 0);
    for view in views {
        let scene = seen(scene, *view);
        // By the method with the same samples that skips nothing.
        let mut rules: BTreeMap<&str, Shot> = BTreeMap::new();
        for row in shapes() {
            let scene = by(&scene, row.name());
            let twin = stage.twin(&scene, row.papers);
            undecided = undecided.max(twin.undecided.iter().filter(|open| **open).count());
            for form in forms_in_turn(device, &scene, turn) {
                let shot = stage.shoot(&scene, form);
                let name = format!("{}, {}, {}", row.name, form.map_or_else(String::new, Form::name), view.0);
                assert!(shot.picture.iter().any(|pixel| pixel[3] > 0.0), "{name}: nothing is seen");
                // Scenes are interpolated as exactly as twins are.
                let off = compare::held(&shot, &twin, 0.0).unwrap_or_else(|what| panic!("{name}: {what}"));
                largest = largest.max(off);
                if row.ends_rays {
                    let rule = rules.entry(row.unskipped().name).or_insert_with(|| shot.clone());
                    let same = same_picture(&shot.picture, &rule.picture);
                    same.unwrap_or_else(|what| panic!("{name}, the first method beside it: {what}"));
                }
            }
        }
    }
    println!("largest difference {largest:.1e}, at most {undecided} pixels undecided");
}

/// Segments that end at a surface, drawn in a pass of their own: the twin's picture, and the one of segments drawn within their
/// passes, bit for bit and with as many main fragments.
fn apart(device: &Arc<Device>, meshes: Meshes, most: u32) {
    held(device, &apart_scene(meshes, most, |_| {}, PartialSegments::Apart), &VIEWS[1..2], 0);
    same_apart(device, |partial| apart_scene(meshes, most, |_| {}, partial));
}

/// The same where the format of the picture rounds so much that rays end a pass later, and where no ray ends early.
fn apart_elsewhere(device: &Arc<Device>) {
    let changes: [fn(&mut Settings); 3] = [
        |s| s.image.accumulate = Accumulate::Rgba16f,
        |s| (s.image.accumulate, s.sampling.termination) = (Accumulate::Rgba8, 0.6),
        |s| s.sampling.termination = 1.0,
    ];
    for change in changes {
        same_apart(device, |partial| apart_scene(SCENES[11].2, 3, change, partial));
    }
    held(device, &apart_scene(SCENES[11].2, 3, changes[2], PartialSegments::Apart), &VIEWS[1..2], 1);
}

fn apart_scene(meshes: Meshes, most: u32, change: fn(&mut Settings), partial: PartialSegments) -> Scene {
    scene("shells:24", "ramp", |settings| {
        exactly(settings);
        settings.meshes = meshes();
        (settings.image.size, settings.layers.most) = ([62, 50], most);
        (settings.sampling.last, settings.layers.partial) = (Last::Partial, partial);
        change(settings);
    })
}

/// Pictures are the same bit for bit, wherever segments that end at a surface are drawn.
fn same_apart(device: &Arc<Device>, of: impl Fn(PartialSegments) -> Scene) {
    let mut stage = Stage::new(device);
    for row in lawful() {
        let form = forms(device, row.name()).pop().flatten();
        let mut shot = |partial| stage.shoot(&by(&of(partial), row.name()), form);
        let (within, apart) = (shot(PartialSegments::Within), shot(PartialSegments::Apart));
        let differs = differing(&within.picture, &apart.picture);
        assert_eq!(differs, 0, "{}: {differs} pixels differ", row.name);
        let sums = |shot: &Shot| {
            let counts = shot.run.fragments.as_ref().expect("counts");
            [counts.main.iter().sum::<u64>(), counts.intermediate.iter().sum()]
        };
        let ([main, before], [main_apart, before_apart]) = (sums(&within), sums(&apart));
        println!("{}: main {main}, apart {main_apart}; intermediate {before}, apart {before_apart}", row.name);
        // Without a decision before its first pass a ray takes part in it, whether it has work there or not.
        assert!(main_apart <= main, "{}: {main_apart} main fragments, {main} with segments within", row.name);
        let has = apart.plan.steps.iter().any(|step| step.pass_name() == "partial_pass");
        assert!(has, "{}: no pass for segments that end at a surface", row.name);
    }
}

/// As many triangles behind each other, and no more than so many peeled.
fn crowded(device: &Arc<Device>) {
    const TRIANGLES: usize = 10_000;
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("crowd.obj");
    // One behind the other by 1e-4, the nearest last, so that their order is not that of the file.
    let corners = (0..TRIANGLES).map(|i| {
        let z = i as f64 / TRIANGLES as f64 - 0.5;
        format!("v -0.4 -0.3 {z}\nv 0.4 -0.2 {z}\nv 0.05 0.4 {z}\nf -3 -2 -1\n")
    });
    std::fs::write(&file, corners.collect::<String>()).expect("a file");
    let of = |opacity: f64, most: u32| {
        scene("shells:24", "ramp", |settings| {
            exactly(settings);
            let mesh = MeshSettings { path: Some(file.clone()), color: [0.3, 0.9, 0.4], opacity, ..Default::default() };
            settings.meshes = vec![mesh];
            (settings.image.size, settings.layers.most, settings.sampling.passes) = ([12, 10], most, 12);
        })
    };
    let transparent = of(0.02, 3);
    let plan = plan(&transparent, None).expect("a plan");
    let lacking = transparent.polygons.lacking(&plan.view.rays, plan.view.size, 3);
    assert_eq!(lacking.iter().max(), Some(&(TRIANGLES as u32 - 3)), "as many behind each other");
    held(device, &transparent, &VIEWS[..1], 0);
    held(device, &of(1.0, 3), &VIEWS[..1], 1);
}

/// More layers than are peeled: the twin's picture all the same.
fn fewer(device: &Arc<Device>) {
    let scene = scene("shells:24", "ramp", |settings| {
        exactly(settings);
        settings.meshes = SCENES[6].2();
        (settings.image.size, settings.layers.most) = ([62, 50], 2);
    });
    held(device, &scene, &VIEWS[..1], 0);
    held(device, &scene, &VIEWS[1..2], 1);
}

/// Main fragments are at most those without polygons, and one more for each segment that a surface cuts.
fn fragments(device: &Arc<Device>) {
    let mut stage = Stage::new(device);
    let settings = |meshes: Vec<MeshSettings>| {
        move |settings: &mut Settings| (settings.meshes, settings.image.size) = (meshes, [122, 98])
    };
    let plain = scene("shells:24", "ramp", settings(Vec::new()));
    let opaque = scene("shells:24", "ramp", settings(vec![MeshSettings { opacity: 1.0, ..mesh("sphere:8") }]));
    let cut_scene = scene("shells:24", "ramp", settings(vec![mesh("sphere:8")]));
    for row in lawful() {
        let mut main = |scene: &Scene| {
            let shot = stage.shoot(&by(scene, row.name()), forms(device, row.name()).pop().flatten());
            let main: u64 = shot.run.fragments.expect("counts").main.iter().sum();
            (main, shot.plan)
        };
        let ((plain, _), (opaque, _), (cut, plan)) = (main(&plain), main(&opaque), main(&cut_scene));
        assert!(opaque <= plain, "{}: {opaque} main fragments behind opaque polygons, {plain} without", row.name);
        let crossed = |i: u32| cut_scene.polygons.divided(&plan.view.rays, [i % 122, i / 122], 4).surfaces.len() as u64;
        let cuts: u64 = (0..122 * 98).map(crossed).sum();
        assert!(cut <= plain + cuts, "{}: {cut} main fragments, {plain} without layers, {cuts} cuts", row.name);
        println!("{}: {plain} main fragments, {opaque} with an opaque sphere, {cut} with a transparent one", row.name);
        assert!(plan.steps.iter().any(|step| step.group == Group::Peel));
    }
}
