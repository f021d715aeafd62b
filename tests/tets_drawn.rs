//! Pictures of meshes of tetrahedra in f64: twins of all methods against the exact integral, closed forms, and the picture of the voxels
//! that a mesh was cut of.

use glam::DVec3;

use depthleap::frame::{Structures, cpu};
use depthleap::method::{TET_PROPAGATION, TET_SINGLE_PASS};
use depthleap::part::rows::Method;
use depthleap::plan::plan;
use depthleap::projection::{MINIP, MIP, XRAY};
use depthleap::read;
use depthleap::scene::light::{Light, LitPoint, lit};
use depthleap::scene::settings::{Classification, Find, Settings, Shows, SurfaceLevel};
use depthleap::scene::tetrahedra::builtin;
use depthleap::scene::volume::{Volume, Voxels};
use depthleap::scene::{Content, Scene};
use depthleap::truth::exact::ExactIntegrator;

fn scene(name: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(name.to_owned());
    settings.image.size = [31, 27];
    settings.transfer.preset = Some("linear".to_owned());
    settings.method.name = TET_SINGLE_PASS.name();
    settings.sampling.termination = 1.0;
    change(&mut settings);
    read::scene(&settings).unwrap()
}

fn twin(scene: &Scene, method: &Method) -> Vec<[f64; 4]> {
    let mut scene = scene.clone();
    scene.settings.method.name = method.name();
    let plan = plan(&scene, method.papers).unwrap();
    cpu::run(&scene, &plan, &Structures::default(), cpu::SUB_PIXEL_BITS).pixels
}

fn exact(scene: &Scene) -> Vec<[f64; 4]> {
    let rays = scene.camera.rays(scene.settings.image.size).unwrap();
    ExactIntegrator::of(scene).picture(&rays, scene.settings.image.size)
}

fn apart(a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
    assert_eq!(a.len(), b.len());
    let of = |(a, b): (&[f64; 4], &[f64; 4])| (0..4).map(|c| (a[c] - b[c]).abs()).fold(0.0, f64::max);
    a.iter().zip(b).map(of).fold(0.0, f64::max)
}

type Change = fn(&mut Settings);

const VIEWS: [(&str, Change); 4] = [
    ("from outside", |_| {}),
    ("from within", |s| (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4])),
    ("along faces", |s| (s.camera.eye, s.camera.target, s.camera.height) = ([0.0, 0.0, 2.0], [0.0; 3], Some(1.0))),
    ("in a ring", |s| (s.camera.eye, s.camera.target) = ([0.34, 0.02, 0.01], [0.0, 0.35, 0.0])),
];

#[test]
fn twins_are_the_exact_integral() {
    for name in ["tets-cube:3", "tets-ball:3", "tets-torus:3"] {
        for (view, change) in VIEWS {
            for projection in [None, Some(MIP.name()), Some(MINIP.name()), Some(XRAY.name())] {
                let scene = scene(name, |s| {
                    change(s);
                    if let Some(projection) = projection {
                        s.projection.kind = projection;
                    }
                });
                let truth = exact(&scene);
                assert!(truth.iter().any(|pixel| pixel[0] > 0.0), "{name}, {view}: nothing shows");
                for method in [&TET_SINGLE_PASS, &TET_PROPAGATION] {
                    let off = apart(&twin(&scene, method), &truth);
                    // Levels of extremes are rounded to f32.
                    assert!(off < 2e-6, "{name}, {view}, {projection:?}, {}: {off:e}", method.name);
                }
            }
        }
    }
}

/// A linear value along a ray through a cube: its sum is the mean of both ends times the way.
#[test]
fn the_sum_of_a_linear_field_is_that_of_its_ends() {
    let scene = scene("tets-cube:5", |s| s.projection.kind = XRAY.name());
    let rays = scene.camera.rays(scene.settings.image.size).unwrap();
    let truth = exact(&scene);
    let unit = 1.0 / (scene.transfer.reference * scene.field.finest());
    for (i, pixel) in truth.iter().enumerate() {
        let ray = rays.of(i as u32 % 31, i as u32 / 31);
        let interval = depthleap::math::ray::box_interval(&ray, 0.5 * scene.field.extent(), rays.near);
        let rule = interval.map_or(0.0, |(enter, leave)| {
            let value = |depth: f64| ray.at(depth).element_sum() / 3.0 + 0.5;
            0.5 * (value(enter) + value(leave)) * (leave - enter) * ray.direction.length() * unit
        });
        assert!((pixel[0] - rule).abs() < 1e-5 * rule.max(1.0), "pixel {i}: {} where {rule} is its sum", pixel[0]);
    }
}

/// Surfaces within cells: opaque, transparent, and within the colours of the mesh.
const SURFACES: [(&str, Change); 3] = [
    ("opaque", |s| s.surface.iso = Some(0.55)),
    ("transparent", |s| s.surface.levels = [(0.3, 0.4), (0.52, 0.5), (0.7, 1.0)].map(level).to_vec()),
    ("in the mesh", |s| {
        s.surface.levels = [(0.45, 0.4), (0.7, 0.6)].map(level).to_vec();
        s.surface.volume = true;
    }),
];

fn level((iso, opacity): (f64, f64)) -> SurfaceLevel {
    SurfaceLevel { iso, color: Some([0.9, iso, 0.3]), opacity }
}

#[test]
fn twins_of_surfaces_are_the_exact_integral() {
    for name in ["tets-cube:3", "tets-ball:3", "tets-torus:3"] {
        for (view, of_view) in VIEWS {
            for (surfaces, of_surfaces) in SURFACES {
                let scene = scene(name, |s| {
                    of_view(s);
                    of_surfaces(s);
                });
                let truth = exact(&scene);
                assert!(truth.iter().any(|pixel| pixel[3] > 0.3), "{name}, {view}, {surfaces}: nothing shows");
                for method in [&TET_SINGLE_PASS, &TET_PROPAGATION] {
                    let off = apart(&twin(&scene, method), &truth);
                    assert!(off < 2e-6, "{name}, {view}, {surfaces}, {}: {off:e}", method.name);
                }
            }
        }
    }
}

#[test]
fn what_surfaces_within_cells_cannot_be_is_refused_by_name() {
    let cases: [(&str, Change); 5] = [
        ("--classification pre-integrated", |s| s.sampling.classification = Classification::PreIntegrated),
        ("--find range", |s| s.surface.find = Find::Range),
        ("--surface-shows", |s| s.surface.shows = Shows::Normal),
        ("[effects]", |s| s.effects.shadows = true),
        ("--projection mip", |s| s.projection.kind = MIP.name()),
    ];
    for (input, change) in cases {
        let scene = scene("tets-ball:2", |s| {
            s.surface.iso = Some(0.5);
            change(s);
        });
        let message = plan(&scene, None).unwrap_err().to_string();
        assert!(message.contains(input), "{message}");
    }
}

/// The surface of a linear field is a plane, and what lies beyond it is solid to the faces of the mesh.
#[test]
fn the_surface_of_a_linear_field_is_a_plane() {
    let color = [0.2, 0.6, 0.9];
    let scene = scene("tets-cube:5", |s| {
        s.surface.levels = vec![SurfaceLevel { iso: 0.6, color: Some(color), opacity: 1.0 }];
        s.camera.eye = [-1.4, 0.7, 0.9];
    });
    let rays = scene.camera.rays(scene.settings.image.size).unwrap();
    let headlight = [Light::headlight(&scene.camera)];
    let (mut met, mut capped) = (0, 0);
    for (i, pixel) in exact(&scene).iter().enumerate() {
        let ray = rays.of(i as u32 % 31, i as u32 / 31);
        let interval = depthleap::math::ray::box_interval(&ray, 0.5 * scene.field.extent(), rays.near);
        let value = |depth: f64| ray.at(depth).element_sum() / 3.0 + 0.5;
        let rule = interval.and_then(|(enter, leave)| {
            let (first, last) = (value(enter), value(leave));
            if (first - 0.6).abs() < 1e-5 || (last - 0.6).abs() < 1e-5 {
                return None;
            }
            let at = enter + (0.6 - first) / (last - first) * (leave - enter);
            let depth = if first >= 0.6 { Some(enter) } else { (last >= 0.6).then_some(at) };
            (met, capped) = (met + u32::from(depth.is_some()), capped + u32::from(first >= 0.6));
            let view = -ray.direction.normalize();
            let shown = |depth| lit(color, &headlight, &LitPoint { place: ray.at(depth), normal: DVec3::ONE, view });
            Some(depth.map_or([0.0; 4], |depth| {
                let [r, g, b] = shown(depth);
                [r, g, b, 1.0]
            }))
        });
        if let Some(rule) = rule {
            let off = (0..4).map(|c| (pixel[c] - rule[c]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-5, "pixel {i}: {pixel:?} where the plane shows {rule:?}");
        }
    }
    assert!(capped > 20 && met > capped + 10, "{met} rays meet it, {capped} begin behind it");
}

/// Constant opacity over a way: 1 - (1 - alpha)^way.
#[test]
fn a_mesh_of_one_opacity_is_as_opaque_as_its_way_is_long() {
    let scene = scene("tets-ball:6", |s| {
        (s.transfer.preset, s.transfer.points) = (None, Some(vec![[0.5, 0.2, 0.5, 0.9, 0.1]]));
    });
    let rays = scene.camera.rays(scene.settings.image.size).unwrap();
    let mesh = scene.tetrahedra.clone().unwrap();
    for (i, pixel) in twin(&scene, &TET_SINGLE_PASS).iter().enumerate() {
        let ray = rays.of(i as u32 % 31, i as u32 / 31);
        let way: f64 = mesh.ways(&ray, rays.near).iter().map(|way| way.to.depth - way.from.depth).sum();
        let lengths = way * ray.direction.length() / scene.field.finest();
        let alpha = 1.0 - 0.9f64.powf(lengths);
        for (found, color) in pixel.iter().zip([0.2, 0.5, 0.9, 1.0]) {
            assert!((found - color * alpha).abs() < 1e-9, "pixel {i}: {pixel:?} where {alpha} is its opacity");
        }
    }
}

/// The table's error falls with the square of the distance between its nodes, where the transfer function has no bends between them.
#[test]
fn the_error_of_a_table_falls_with_its_size() {
    let off = |nodes: u32| {
        let scene = scene("tets-cube:4", |s| {
            (s.sampling.classification, s.sampling.table) = (Classification::PreIntegrated, nodes);
            (s.transfer.preset, s.transfer.points) =
                (None, Some(vec![[0.0, 0.1, 0.5, 0.9, 0.05], [1.0, 0.9, 0.4, 0.2, 0.4]]));
        });
        apart(&twin(&scene, &TET_SINGLE_PASS), &exact(&scene))
    };
    let errors = [5, 9, 17, 33].map(off);
    println!("errors of tables of 5, 9, 17 and 33 nodes a side: {errors:?}");
    assert!(errors[0] > 1e-4, "{errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[1] < 0.35 * pair[0], "{errors:?}");
    }
}

/// What the voxels of a lattice show, and the cells that it is cut into: both are linear between points, so that pictures differ by the
/// square of the distance between them.
#[test]
fn a_lattice_of_voxels_cut_into_cells_shows_what_the_voxels_do() {
    let off = |boxes: usize| {
        let side = boxes + 1;
        // Smooth, and 0 to all faces.
        let value = |p: [f64; 3]| p.map(|c| (c * std::f64::consts::PI).cos().max(0.0).powi(2)).iter().product::<f64>();
        let mut grid = builtin::mesh(&format!("tets-cube:{boxes}")).unwrap().unwrap();
        grid.values = grid.points.iter().map(|point| value(*point)).collect();
        let voxels = grid.values.iter().map(|value| *value as f32).collect();
        let volume = Volume::new("lattice", [side; 3], [1.0; 3], Voxels::F32(voxels)).unwrap();
        let settings = |scale: f64| {
            let mut settings = Settings::default();
            settings.image.size = [25, 21];
            (settings.transfer.preset, settings.transfer.reference) = (Some("linear".to_owned()), boxes as f64 / 8.0);
            settings.sampling.termination = 1.0;
            settings.camera.eye = [0.8974, 0.6533, 1.5544].map(|c| c * scale);
            settings
        };
        // The volume's longest side is that of its voxels, half of one beyond the points at each end.
        let of_voxels = read::scene_of(&settings(1.0), |_| Ok(volume)).unwrap();
        let mut of_cells = settings(side as f64 / boxes as f64);
        of_cells.method.name = TET_SINGLE_PASS.name();
        let of_cells = read::scene_of(&of_cells, |_| Ok(Content::Cells(grid))).unwrap();
        assert!((of_cells.field.finest() * boxes as f64 - 1.0).abs() < 1e-6);
        let (cells, voxels) = (twin(&of_cells, &TET_SINGLE_PASS), exact(&of_voxels));
        assert!(voxels.iter().any(|pixel| pixel[3] > 0.5));
        apart(&cells, &voxels)
    };
    let errors = [8, 16, 32].map(off);
    println!("cells differ from voxels by {errors:?} for 8, 16 and 32 boxes a side");
    assert!(errors[0] < 0.1, "{errors:?}");
    assert!(errors[1] < 0.35 * errors[0] && errors[2] < 0.35 * errors[1], "{errors:?}");
}
