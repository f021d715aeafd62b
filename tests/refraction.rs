//! Rays that bend, and what is behind the volume, held against closed forms. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;

use std::f64::consts::SQRT_2;

use depthleap::feature::REFRACTION;
use depthleap::method::{METHODS, RC_ERT, SINGLE_PASS};
use depthleap::plan::plan;
use depthleap::read;
use depthleap::scene::backdrop::GREYS;
use depthleap::scene::settings::{Filter, Gradients, LightSettings, Offset, Refraction, Settings, Shows};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Scene, Volume};
use drawn::drawn;
use glam::DVec3;

/// A scene of a transparent volume of `side`^3 voxels, with these values of their indices.
fn scene(side: usize, value: impl Fn(DVec3) -> f64, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.transfer.points = Some(vec![[0.0, 1.0, 1.0, 1.0, 0.0]]);
    settings.image.size = [40, 30];
    settings.sampling.filter = Filter::Exact;
    settings.method.name = SINGLE_PASS.name();
    change(&mut settings);
    let at = |i: usize| DVec3::new((i % side) as f64, (i / side % side) as f64, (i / side / side) as f64);
    let voxels = Voxels::F32((0..side.pow(3)).map(|i| value(at(i)) as f32).collect());
    read::scene_of(&settings, |_| Ok(Volume::new("test", [side; 3], [1.0; 3], voxels).unwrap())).unwrap()
}

fn refraction(points: &[[f64; 2]]) -> Option<Refraction> {
    Some(Refraction { points: points.to_vec() })
}

const SIDE: usize = 64;
const INDEX: f64 = 1.5;

/// A plane across z, smoothed over half of the volume: 0 in front of it, 1 behind.
fn smoothed_plane(at: DVec3) -> f64 {
    let s = ((47.5 - at.z) / 32.0).clamp(0.0, 1.0);
    s * s * s * (10.0 + s * (6.0 * s - 15.0))
}

/// The largest angle between rays behind a smoothed plane and what Snell's law has for them, radians, and how many rays there are.
fn off_snell(step: f64, offset: Offset) -> (f64, usize) {
    let scene = scene(SIDE, smoothed_plane, |s| {
        (s.camera.eye, s.camera.target) = ([0.9, 0.3, 2.0], [0.0, 0.0, 0.4]);
        (s.sampling.step, s.sampling.offset) = (step, offset);
        s.effects.refraction = refraction(&[[0.0, 1.0], [1.0, INDEX]]);
    });
    let (plan, frame) = drawn(&scene);
    let (mut worst, mut count) = (0.0f64, 0);
    for (i, leaves) in frame.leaves.iter().enumerate() {
        // Rays that leave by the sides are still on their way through the plane.
        let Some(ray) = leaves.filter(|ray| ray.point.z < -0.27) else { continue };
        let (rays, size) = (plan.view.rays, plan.view.size);
        let straight = rays.of(i as u32 % size[0], i as u32 / size[0]);
        let (enter, _) = scene.interval(&straight, rays.near).unwrap();
        // Nor are those that enter by them at its begin.
        if straight.at(enter).z < 0.27 {
            continue;
        }
        let before = straight.direction.normalize();
        let angle = |way: DVec3| way.x.hypot(way.y).asin();
        worst = worst.max((angle(ray.direction) - (before.x.hypot(before.y) / INDEX).asin()).abs());
        // The plane of incidence is kept, up to the rounding of the direction that is stored.
        assert!((before.x * ray.direction.y - before.y * ray.direction.x).abs() < 1e-6);
        count += 1;
    }
    (worst, count)
}

#[test]
fn rays_behind_a_smoothed_plane_obey_snell() {
    for offset in [Offset::Left, Offset::Midpoint] {
        let (worst, rays) = off_snell(0.5, offset);
        println!("{offset:?}: {worst:.1e} rad at most, {rays} rays");
        assert!(rays > 100 && worst < 1e-4, "{offset:?}: {worst:e} rad, {rays} rays");
    }
}

/// Directions in which rays leave a lens whose index falls from its centre like a Gaussian.
fn behind_a_gaussian(step: f64) -> Vec<Option<DVec3>> {
    let gaussian = |at: DVec3| (-(at - 31.5).length_squared() / (2.0 * 9.0f64.powi(2))).exp();
    let scene = scene(SIDE, gaussian, |s| {
        (s.sampling.step, s.sampling.offset) = (step, Offset::Midpoint);
        s.effects.refraction = refraction(&[[0.0, 1.0], [1.0, 1.4]]);
    });
    drawn(&scene).1.leaves.into_iter().map(|ray| ray.map(|ray| ray.direction)).collect()
}

#[test]
fn rays_bend_with_second_order() {
    let rule = behind_a_gaussian(0.125);
    let off = |step: f64| {
        let found = behind_a_gaussian(step);
        let apart: Vec<f64> =
            found.iter().zip(&rule).filter_map(|(a, b)| Some((*a)?.distance_squared((*b)?))).collect();
        assert!(apart.len() > 100, "{} rays bend", apart.len());
        (apart.iter().sum::<f64>() / apart.len() as f64).sqrt()
    };
    // Below two voxels the interpolant shows, whose gradient has a bend in each face of a cell.
    let errors = [6.0, 4.0, 3.0, 2.0].map(off);
    let orders = [(errors[0] / errors[2]).log2(), (errors[1] / errors[3]).log2()];
    println!("{errors:?}: orders {orders:?}");
    assert!(orders.into_iter().all(|order| (1.7..2.6).contains(&order)), "{orders:?} of {errors:?}");
}

#[test]
fn luneburg_lens_has_its_focus_on_its_far_side() {
    const LENS: usize = 65;
    const RADIUS: f64 = 30.0;
    let index = |at: DVec3| (2.0 - (at - 32.0).length_squared() / RADIUS.powi(2)).max(1.0).sqrt();
    let scene = scene(LENS, index, |s| {
        // From so far away that rays are parallel.
        (s.camera.eye, s.camera.target, s.camera.fov_y) = ([0.0, 0.0, 300.0], [0.0; 3], 0.2);
        s.sampling.step = 0.5;
        s.effects.refraction = refraction(&[[0.0, 1.0], [1.0, SQRT_2]]);
    });
    let (plan, frame) = drawn(&scene);
    let radius = RADIUS / LENS as f64;
    let focus = DVec3::new(0.0, 0.0, -radius);
    let mut off: Vec<f64> = frame
        .leaves
        .iter()
        .enumerate()
        // At the rim, where the index has a bend of its own, the interpolant has another idea of it.
        .filter(|(i, _)| {
            let [column, row] = [*i as u32 % plan.view.size[0], *i as u32 / plan.view.size[0]];
            let before = plan.view.rays.of(column, row).direction.normalize();
            plan.view.rays.origin.cross(before).length() < 0.95 * radius
        })
        .filter_map(|(_, ray)| *ray)
        .map(|ray| (focus - ray.point).cross(ray.direction).length() / radius)
        .collect();
    off.sort_by(f64::total_cmp);
    println!(
        "{} rays pass the focus within {:.4} of the radius, half of them within {:.4}",
        off.len(),
        off[off.len() - 1],
        off[off.len() / 2]
    );
    assert!(off.len() > 200 && off[off.len() - 1] < 0.01, "{:?} of {}", off.last(), off.len());
}

/// What shows of a volume with a haze, with and without an index that is the same everywhere.
#[test]
fn rays_in_a_constant_index_are_straight_to_the_bit() {
    let hazy = |s: &mut Settings| {
        s.transfer.points = Some(vec![[0.0, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.5]]);
        s.method.planner = false;
    };
    let straight = drawn(&scene(20, |at| at.length(), hazy)).1;
    for index in [1.0, 1.7] {
        let with = scene(
            20,
            |at| at.length(),
            |s| {
                hazy(s);
                s.effects.refraction = refraction(&[[0.0, index], [1.0, index]]);
            },
        );
        let frame = drawn(&with).1;
        assert!(frame.leaves.iter().all(Option::is_none));
        assert_eq!(frame.pixels, straight.pixels, "index {index}");
        // Where things are left out, it is one of them.
        let mut planned = with;
        planned.settings.method.planner = true;
        let left_out = plan(&planned, None).unwrap().left_out;
        assert!(
            left_out.iter().any(|left| left.what == REFRACTION.name && left.why.contains("the same")),
            "{left_out:?}"
        );
    }
}

#[test]
fn plane_behind_a_transparent_volume_has_no_seam() {
    let scene = scene(16, |at| at.x, |s| s.effects.behind = Some("checker".into()));
    let (plan, frame) = drawn(&scene);
    let [width, height] = plan.view.size;
    assert_eq!(plan.view.region.size(), [width, height]);
    let grey = |i: u32| {
        let square = |at: u32| ((f64::from(at) + 0.5) * 12.0 / f64::from(height)).floor() as i64;
        GREYS[(square(i % width) + square(i / width)).rem_euclid(2) as usize]
    };
    for (i, pixel) in frame.pixels.iter().enumerate() {
        let grey = grey(i as u32);
        assert_eq!(*pixel, [grey, grey, grey, 1.0], "pixel {i}");
    }
}

/// A ray that bends sees the place of the plane that its line meets: the closed form of a lens that only turns rays at one plane.
#[test]
fn bent_rays_see_where_their_lines_meet_the_plane() {
    let with = |background: bool| {
        scene(SIDE, smoothed_plane, |s| {
            (s.camera.eye, s.camera.target) = ([0.9, 0.3, 2.0], [0.0, 0.0, 0.4]);
            s.effects.refraction = refraction(&[[0.0, 1.0], [1.0, INDEX]]);
            s.effects.behind = background.then(|| "checker".into());
            (s.effects.background_distance, s.effects.background_squares) = (0.7, 7.0);
        })
    };
    let scene = with(true);
    let (plan, frame) = drawn(&scene);
    let [width, height] = plan.view.size;
    let (rays, forward) =
        (plan.view.rays, plan.view.rays.base - plan.view.rays.base.project_onto(plan.view.rays.right));
    let forward = (forward - forward.project_onto(rays.down)).normalize();
    let corner = |i: usize| DVec3::new([-0.5, 0.5][i & 1], [-0.5, 0.5][i >> 1 & 1], [-0.5, 0.5][i >> 2]);
    let depth = (0..8).map(|i| (corner(i) - rays.origin).dot(forward)).fold(0.0, f64::max) + 0.7;
    let (mut held, mut moved) = (0, 0);
    for (i, leaves) in frame.leaves.iter().enumerate() {
        let Some(ray) = leaves.filter(|_| !frame.undecided[i]) else { continue };
        let on =
            ray.point + (depth - (ray.point - rays.origin).dot(forward)) / ray.direction.dot(forward) * ray.direction;
        // The view's own axes have their pixel of length |right| at depth 1.
        let arm = (on - rays.origin) / depth;
        let right = rays.right.normalize();
        let down = rays.down.normalize();
        let place = [
            arm.dot(right) / rays.right.length() + 0.5 * f64::from(width),
            arm.dot(down) / rays.down.length() + 0.5 * f64::from(height),
        ];
        let square = place.map(|at| (at * 7.0 / f64::from(height)).floor() as i64);
        let grey = GREYS[(square[0] + square[1]).rem_euclid(2) as usize];
        assert_eq!(frame.pixels[i][..3], [grey; 3], "pixel {i} sees {place:?}");
        held += 1;
        let own = [i as u32 % width, i as u32 / width].map(|at| f64::from(at) + 0.5);
        moved += usize::from((place[0] - own[0]).hypot(place[1] - own[1]) > 1.0);
    }
    let open = frame.undecided.iter().filter(|undecided| **undecided).count();
    assert!(held > 200 && moved > 100, "{held} rays, {moved} of them see another place, {open} undecided");
}

fn refused(change: impl FnOnce(&mut Settings)) -> String {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:16".to_owned());
    settings.method.name = SINGLE_PASS.name();
    settings.effects.refraction = refraction(&[[0.2, 1.0], [0.8, 1.4]]);
    settings.effects.behind = Some("checker".into());
    change(&mut settings);
    let found = settings.check().and_then(|()| read::scene(&settings)).and_then(|scene| plan(&scene, None).map(|_| ()));
    found.expect_err("refused").to_string()
}

#[test]
fn indices_that_are_none_are_refused() {
    for (points, named) in [
        (vec![], "0 points"),
        (vec![[0.0, 0.0]], "index 0"),
        (vec![[0.0, 1.0], [0.5, -1.5]], "index -1.5 at point 1"),
        (vec![[0.0, f64::NAN]], "index NaN"),
        (vec![[0.0, f64::INFINITY]], "index inf"),
        (vec![[f64::NAN, 1.0]], "x = NaN"),
        (vec![[1e300, 1.0]], "x = 1"),
        (vec![[0.5, 1.0], [0.5, 1.5]], "after x = 0.5"),
        (vec![[0.5, 1.0], [0.4, 1.5]], "x = 0.4"),
        (vec![[0.5, 1.0]; 300], "300 points"),
    ] {
        let said = refused(|s| s.effects.refraction = refraction(&points));
        assert!(said.contains("effects.refraction") && said.contains(named), "{named}: {said}");
    }
}

#[test]
fn what_has_no_meaning_with_bent_rays_is_refused() {
    let alone = |change: fn(&mut Settings)| {
        refused(|s| {
            s.effects.behind = None;
            change(s);
        })
    };
    for (said, named) in [
        (alone(|s| s.projection.kind = depthleap::projection::MIP.name()), "projection.kind"),
        (alone(|s| s.surface.iso = Some(90.0)), "surface"),
        (alone(|s| s.meshes = vec![Default::default()]), "mesh"),
        (alone(|s| s.sampling.filter = Filter::Nearest), "sampling.filter"),
        (
            alone(|s| {
                s.lights = vec![LightSettings { direction: Some([1.0, 0.0, 0.0]), ..Default::default() }];
                s.shading.gradients = Gradients::Precomputed;
            }),
            "shading.gradients",
        ),
    ] {
        assert!(said.contains(named), "{named}: {said}");
    }
}

#[test]
fn what_has_no_meaning_before_a_background_is_refused() {
    let alone = |change: fn(&mut Settings)| {
        refused(|s| {
            s.effects.refraction = None;
            change(s);
        })
    };
    for (said, named) in [
        (alone(|s| s.projection.kind = depthleap::projection::MIP.name()), "projection.kind"),
        (alone(|s| (s.surface.iso, s.surface.shows) = (Some(90.0), Shows::Normal)), "surface.shows"),
        (alone(|s| s.effects.behind = Some("no-such-picture.png".into())), "no-such-picture.png"),
        (alone(|s| s.effects.behind = Some("Cargo.toml".into())), "not a picture"),
        (alone(|s| s.effects.background_distance = -1.0), "background_distance"),
        (alone(|s| s.effects.background_squares = 0.0), "background_squares"),
    ] {
        assert!(said.contains(named), "{named}: {said}");
    }
}

#[test]
fn methods_of_several_passes_refuse_both() {
    for method in METHODS.into_iter().filter(|method| !method.loops() && !method.goes_through_cells()) {
        let said = refused(|s| s.method.name = method.name());
        assert!(said.contains("effects.refraction") && said.contains("single-pass"), "{}: {said}", method.name);
    }
    let said = refused(|s| (s.method.name, s.effects.refraction) = (RC_ERT.name(), None));
    assert!(said.contains("effects.background"), "{said}");
}
