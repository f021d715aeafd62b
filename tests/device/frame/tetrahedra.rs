//! Meshes of tetrahedra: pictures of all methods in all forms are those of the twin and of the exact integral; counts are the twin's.

use std::sync::Arc;

use depthleap::feature::BATCH;
use depthleap::method::{TET_PROPAGATION, TET_SINGLE_PASS, TET_SINGLE_PASS_COMPUTE};
use depthleap::projection::{MINIP, MIP, XRAY};
use depthleap::read;
use depthleap::scene::Scene;
use depthleap::scene::settings::{Classification, LightSettings, Settings, SurfaceLevel};
use depthleap::truth::exact::ExactIntegrator;
use depthleap::vulkan::Device;

use super::compare::{SAME_SUM, difference, held, held_in_batches, same_picture};
use super::scenes::{Shot, Stage, by, forms_in_turn};
use crate::harness::{Need, Test, data, test};

type Change = fn(&mut Settings);

/// Views: the eye, its target, and how high an orthographic picture is.
const VIEWS: [(&str, Change); 4] = [
    ("from_outside", |_| {}),
    ("from_within", |s| (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4])),
    // Rays run along faces and through vertices of cubes.
    ("along_faces", |s| {
        (s.camera.eye, s.camera.target, s.camera.height) = ([0.0, 0.0, 2.0], [0.0; 3], Some(1.0));
        s.image.size = [32, 32];
    }),
    ("side_by_side_in_a_ring", |s| {
        (s.camera.eye, s.camera.target, s.camera.height) = ([0.34, 0.02, 0.01], [0.0, 0.35, 0.0], Some(1.1));
    }),
];

/// Meshes, and what is made of them.
const MESHES: [(&str, Change); 8] = [
    ("tets-cube:8", |_| {}),
    ("tets-ball:5", |s| {
        s.transfer.preset = None;
        s.transfer.points = Some(vec![
            [0.0, 0.9, 0.2, 0.1, 0.0],
            [0.3, 0.2, 0.8, 0.3, 0.2],
            [0.3, 0.1, 0.2, 0.9, 0.0],
            [0.6, 0.9, 0.9, 0.2, 0.6],
            [0.9, 0.2, 0.4, 0.9, 0.05],
        ]);
    }),
    ("tets-torus:4", |s| s.transfer.preset = Some("surface".to_owned())),
    ("tets-torus:3", |s| s.projection.kind = MIP.name()),
    ("tets-ball:4", |s| s.projection.kind = XRAY.name()),
    ("tets-cube:5", |s| {
        (s.sampling.classification, s.sampling.table) = (Classification::PreIntegrated, 17);
    }),
    ("tets-cube:6", |s| {
        s.surface.iso = Some(0.55);
        s.sampling.termination = 0.95;
    }),
    ("tets-ball:6", |s| {
        s.surface.volume = true;
        // One at the eye would be in the very place of what rays begin within, and one along axes in the plane of a face.
        s.lights = vec![LightSettings { direction: Some([1.0, 2.1, 3.4]), ..LightSettings::default() }];
        s.surface.levels = [(0.35, 0.3), (0.6, 0.6), (0.8, 1.0)]
            .map(|(iso, opacity)| SurfaceLevel { iso, color: Some([0.9, iso, 0.3]), opacity })
            .to_vec();
    }),
];

/// Meshes of the literature, and the array that is shown.
const FILES: [(&str, &str); 2] = [("bluntfin_tet.vtk", "density"), ("post_grid.vtk", "velocity_magnitude")];

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    for (turn, (name, of_mesh)) in MESHES.into_iter().enumerate() {
        for (number, (view, of_view)) in VIEWS.into_iter().enumerate() {
            let scene = move || {
                shown(|s| {
                    s.volume.builtin = Some(name.to_owned());
                    of_view(s);
                    of_mesh(s);
                })
            };
            let (mesh, size) = name.split_once(':').unwrap_or((name, ""));
            // Which of the cells beside a face a ray goes through is open there, and with it the normal of a surface.
            if view == "along_faces" && scene().surface.is_some() {
                continue;
            }
            let one = test(&format!("tetrahedra::{mesh}_{size}_{view}"), move |device| all_methods(device, &scene()));
            tests.push(one.needs(Need::Turn(number + turn)));
        }
    }
    for (file, array) in FILES {
        for (view, of_view) in &VIEWS[..2] {
            let scene = move || {
                shown(|s| {
                    (s.volume.path, s.volume.array) = (Some(data(file)), Some(array.to_owned()));
                    of_view(s);
                })
            };
            let name = format!("tetrahedra::{}_{view}", file.trim_end_matches(".vtk"));
            tests.push(test(&name, move |device| all_methods(device, &scene())).needs(Need::Data(file)));
        }
    }
    tests.push(test("tetrahedra::least_values_and_ends", |device| {
        for change in [(|s| s.projection.kind = MINIP.name()) as Change, |s| s.sampling.termination = 0.4] {
            let scene = shown(|s| {
                s.volume.builtin = Some("tets-torus:4".to_owned());
                change(s);
            });
            all_methods(device, &scene);
        }
    }));
    tests.push(test("tetrahedra::mesh_data_in_storage_buffers", in_storage));
    tests
}

/// Where buffers of texels have no room for a mesh it is in storage buffers, and the picture is the same to the bit.
fn in_storage(device: &Arc<Device>) {
    let mut stage = Stage::new(device);
    for (name, of_mesh) in [MESHES[1], MESHES[7]] {
        let scene = shown(|s| {
            s.volume.builtin = Some(name.to_owned());
            of_mesh(s);
        });
        for method in [&TET_SINGLE_PASS, &TET_SINGLE_PASS_COMPUTE, &TET_PROPAGATION] {
            let scene = by(&scene, method.name());
            let shots = [device.info.max_texel_buffer, 0].map(|most| {
                stage.clear();
                stage.most_texels = most;
                stage.shoot(&scene, method.papers)
            });
            let stored = |shot: &Shot| shot.plan.view.cells.as_ref().is_some_and(|cells| cells.in_storage);
            assert_eq!(shots.each_ref().map(stored), [false, true], "{name}, {}", method.name);
            assert!(shots[0].picture.iter().any(|pixel| pixel[3] > 0.1), "{name}, {}: nothing is seen", method.name);
            let same = same_picture(&shots[1].picture, &shots[0].picture);
            same.unwrap_or_else(|what| panic!("{name}, {}: {what}", method.name));
            assert_eq!(shots[1].run.fragments, shots[0].run.fragments, "{name}, {}", method.name);
        }
    }
}

fn shown(change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.transfer.preset = Some("linear".to_owned());
    settings.image.size = [41, 33];
    settings.sampling.termination = 1.0;
    change(&mut settings);
    read::scene(&settings).expect("a sound scene")
}

/// The most pixels, as a part of all, that a rasteriser may see or not.
const UNDECIDED: f64 = 0.1;

fn all_methods(device: &Arc<Device>, scene: &Scene) {
    let mut stage = Stage::new(device);
    let loops = by(scene, TET_SINGLE_PASS.name());
    let twin = stage.twin(&loops, None);
    let undecided = twin.undecided.iter().filter(|undecided| **undecided).count();
    let shows = twin.pixels.iter().filter(|pixel| pixel[0] > 0.01).count();
    assert!(shows > 60, "{shows} pixels show");
    assert!((undecided as f64) < UNDECIDED * twin.undecided.len() as f64, "{undecided} pixels are undecided");
    let ends = scene.settings.sampling.termination < 1.0;
    let mut found = Vec::new();
    for method in [&TET_SINGLE_PASS, &TET_SINGLE_PASS_COMPUTE] {
        let shot = stage.shoot(&by(scene, method.name()), None);
        let largest = held(&shot, &twin, 0.0).unwrap_or_else(|what| panic!("{}: {what}", method.name));
        found.push(format!("{} {largest:.1e}", method.name));
    }
    if !ends && !scene.has_cell_table() {
        let rays = scene.camera.rays(scene.settings.image.size).unwrap();
        let truth = ExactIntegrator::of(scene).picture(&rays, scene.settings.image.size);
        let off = |(a, b): (&[f64; 4], &[f64; 4])| (0..4).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max);
        let largest = truth.iter().zip(&twin.pixels).map(off).fold(0.0, f64::max);
        assert!(largest < 2e-6, "the twin is {largest:e} from the exact integral");
    }
    let scene = by(scene, TET_PROPAGATION.name());
    for form in forms_in_turn(device, &scene, shows) {
        let shot = stage.shoot(&scene, form);
        let own = stage.twin(&scene, form);
        let largest =
            held_in_batches(&shot, &own, 0.0, BATCH as usize).unwrap_or_else(|what| panic!("{form:?}: {what}"));
        // Which cells a ray goes through is open near edges; what they show together is not.
        let all = if ends {
            largest
        } else {
            difference(&shot.picture, &twin, SAME_SUM).unwrap_or_else(|what| panic!("{form:?}: {what}"))
        };
        found.push(format!("{} {all:.1e}", form.map_or(String::new(), |form| form.name())));
    }
    println!("{shows} pixels show, {undecided} undecided: {}", found.join(", "));
}
