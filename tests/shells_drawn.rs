//! The method `shells` in f64: against closed forms on concentric spheres, against the projections that its pictures go to, and what it
//! refuses; needs no device.

mod drawn;

use depthleap::frame::CpuFrame;
use depthleap::math::ray::box_interval;
use depthleap::method::{RC, SHELLS};
use depthleap::plan;
use depthleap::projection::MIP;
use depthleap::read;
use depthleap::scene::Scene;
use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{
    Accumulate, ClipSettings, Filter, Find, Last, MeshSettings, MethodName, Offset, Refine, Settings, ShellMode,
    ShellOrder, ShellSum, Shows, VolumeTexture,
};
use depthleap::scene::shells::ShellDepth;
use depthleap::truth::exact::ExactIntegrator;
use drawn::drawn;
use glam::DVec3;

fn settings(volume: &str, mode: ShellMode, change: impl FnOnce(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(volume.to_owned());
    settings.volume.texture = VolumeTexture::R32f;
    (settings.sampling.filter, settings.sampling.last) = (Filter::Exact, Last::Partial);
    settings.sampling.offset = Offset::Midpoint;
    settings.image.size = [40, 32];
    settings.camera.eye = [0.5, 0.7, 1.4];
    settings.method.name = SHELLS.name();
    settings.shells.mode = Some(mode);
    change(&mut settings);
    settings
}

fn scene(volume: &str, mode: ShellMode, change: impl FnOnce(&mut Settings)) -> Scene {
    read::scene(&settings(volume, mode, change)).unwrap()
}

fn picture(scene: &Scene) -> CpuFrame {
    drawn(scene).1
}

/// The radius at which the built-in Gaussian, whose half side is 1 there, has a value, in volume space; its deviation is 0.3.
fn radius(x: f64) -> f64 {
    0.5 * 0.3 * (-2.0 * x.ln()).sqrt()
}

/// How far polygons of this test's volumes may lie off the spheres.
const OFF: f64 = 2e-3;

/// For each ray the way from the middle of the volume at which it is nearest to it, the depth there, and whether it passes the box.
fn rays(scene: &Scene) -> Vec<Option<[f64; 3]>> {
    let size = scene.settings.image.size;
    let rays = scene.camera.rays(size).unwrap();
    let of = |i: u32| {
        let ray = rays.of(i % size[0], i / size[0]);
        box_interval(&ray, 0.5 * scene.field.extent(), rays.near)?;
        let depth = -ray.origin.dot(ray.direction) / ray.direction.length_squared();
        Some([ray.at(depth).length(), depth, ray.direction.length()])
    };
    (0..size[0] * size[1]).map(of).collect()
}

#[test]
fn the_greatest_of_spheres_is_the_innermost_by_the_paper_and_dimmed_by_depth() {
    for (a, b, beta0) in [(0.0, 1.0, 0.0), (0.8, 0.3, 0.0), (0.5, 0.0, 0.4)] {
        let scene = scene("gaussian:48", ShellMode::Max, |s| {
            (s.shells.shell_levels, s.shells.a) = (vec![0.2, 0.5, 0.8], a);
            (s.shells.b, s.shells.beta0) = (b, beta0);
            s.volume.range = Some([0.0, 1.0].map(Into::into));
        });
        let frame = picture(&scene);
        let rays_of_view = scene.camera.rays(scene.settings.image.size).unwrap();
        let depth = ShellDepth::of(&scene, &rays_of_view).unwrap();
        let (mut seen, mut left) = (0, 0);
        for (i, ray) in rays(&scene).into_iter().enumerate() {
            let Some([nearest, at, length]) = ray else { continue };
            let spheres = [0.2, 0.5, 0.8].map(|x| (x, radius(x)));
            if spheres.iter().any(|(_, radius)| (nearest - radius).abs() < 3.0 * OFF) {
                left += 1;
                continue;
            }
            // Where the ray goes into each sphere, its front lies nearest.
            let of = |(x, radius): &(f64, f64)| {
                let half = (radius * radius - nearest * nearest).max(0.0).sqrt() / length;
                x * depth.cue(depth.stored(at - half))
            };
            let expected = spheres.iter().filter(|(_, radius)| nearest < *radius).map(of).fold(0.0, f64::max);
            let found = frame.pixels[i];
            // A place off by so much along a ray that is nearly a tangent is off by more in depth.
            let tolerance = 1e-6 + a * 0.02;
            assert!(
                (found[0] - expected).abs() < tolerance * expected.max(1.0),
                "pixel {i} is {found:?}, not {expected}"
            );
            seen += usize::from(expected > 0.0);
        }
        assert!(seen > 100 && left < 60, "{seen} pixels held, {left} left out");
    }
}

/// The greatest difference in rms of shells to the exact projection, by their number.
fn errors(mode: ShellMode, counts: &[u32], change: impl Fn(&mut Settings)) -> Vec<f64> {
    let of = |count: &u32| {
        let scene = scene("gaussian:40", mode, |s| {
            s.shells.count = *count;
            change(s);
        });
        let size = scene.settings.image.size;
        let exact = ExactIntegrator::of(&scene).picture(&scene.camera.rays(size).unwrap(), size);
        let frame = picture(&scene);
        let squares = frame.pixels.iter().zip(&exact).map(|(a, b)| (a[0] - b[0]).powi(2)).sum::<f64>();
        (squares / exact.len() as f64).sqrt()
    };
    counts.iter().map(of).collect()
}

#[test]
fn the_greatest_goes_to_the_maximum_projection_with_the_first_order() {
    let off = errors(ShellMode::Max, &[4, 8, 16, 32], |_| {});
    let order = (off[0] / off[3]).log2() / 3.0;
    assert!((0.8..1.2).contains(&order), "{order} of {off:?}");
}

#[test]
fn the_sum_of_ways_goes_to_the_emission_integral_and_that_of_crossings_does_not() {
    for ortho in [None, Some(1.2)] {
        let off = errors(ShellMode::Sum, &[4, 8, 16], |s| s.camera.height = ortho);
        // What lies below the dimmest shell is not summed up.
        let order = (off[0] / off[2]).log2() / 2.0;
        assert!((0.85..1.2).contains(&order), "{order} of {off:?}");
        let crossings = errors(ShellMode::Sum, &[4, 16], |s| s.shells.sum = ShellSum::Crossings);
        assert!(crossings[1] > 0.3 * crossings[0], "{crossings:?}");
    }
}

#[test]
fn rays_that_begin_within_shells_sum_up_the_ways_from_there() {
    for height in [None, Some(0.4)] {
        let within = |s: &mut Settings| {
            (s.camera.eye, s.camera.target, s.camera.height) = ([0.05, 0.1, 0.15], [0.3, -0.2, -0.3], height);
        };
        let off = errors(ShellMode::Sum, &[4, 16], within);
        assert!(off[1] < 0.35 * off[0], "{off:?}");
        let among = settings("gaussian:16", ShellMode::Sum, |s| {
            within(s);
            s.meshes = vec![cuboid(1.0)];
        });
        assert!(refused(&among).contains("out of it"));
    }
}

#[test]
fn rays_that_meet_no_shell_are_black_and_pixels_of_surfaces_opaque() {
    // All values lie between 0.25 and 1 of the scalar range, and above all levels but one that shells dim.
    let scene = scene("gaussian:16", ShellMode::Max, |s| {
        s.volume.range = Some([-1.0, 1.0].map(Into::into));
        (s.shells.shell_levels, s.shells.b) = (vec![0.9], 0.1);
    });
    let frame = picture(&scene);
    let [dark, shown] = [0.0, 0.095].map(|x: f64| frame.pixels.iter().filter(|p| (p[0] - x).abs() < 1e-6).count());
    assert!(shown > 3 && dark > 100 && dark + shown == frame.pixels.len(), "{dark} and {shown}");
    let sum = picture(&crate::scene("gaussian:16", ShellMode::Sum, |s| s.meshes = vec![cuboid(1.0)]));
    assert!(sum.pixels.iter().all(|pixel| pixel[3] == 0.0 || pixel[3] == 1.0));
}

/// The same pixels whatever the order, with fewer fragments where the brightest come first.
#[test]
fn the_order_of_shells_changes_counts_alone() {
    let of =
        |order: ShellOrder| picture(&scene("jets:24", ShellMode::Max, |s| (s.shells.order, s.shells.a) = (order, 0.0)));
    let (bright, dim, auto) = (of(ShellOrder::Brightest), of(ShellOrder::Dimmest), of(ShellOrder::Auto));
    assert_eq!(bright.pixels, dim.pixels);
    let sum = |frame: &CpuFrame| frame.counts.main.iter().sum::<u64>();
    assert!(sum(&bright) < sum(&dim), "{} and {}", sum(&bright), sum(&dim));
    assert_eq!((sum(&bright), bright.ideal), (sum(&auto), sum(&bright)), "each fragment is the greatest of its pixel");
}

fn cuboid(opacity: f64) -> MeshSettings {
    MeshSettings {
        builtin: Some("box".to_owned()),
        opacity,
        scale: 0.4,
        rotate: [20.0, 30.0, 0.0],
        ..MeshSettings::default()
    }
}

#[test]
fn a_surface_hides_the_shells_behind_it() {
    for mode in [ShellMode::Max, ShellMode::Sum] {
        let with = |meshes: Vec<MeshSettings>| {
            picture(&scene("gaussian:24", mode, |s| {
                (s.shells.a, s.shells.b, s.meshes) = (0.5, 0.5, meshes);
                s.shells.count = 5;
            }))
        };
        // Black, so that it takes away and adds nothing.
        let black = MeshSettings { color: [0.0; 3], ..cuboid(1.0) };
        let (alone, among) = (with(Vec::new()), with(vec![black]));
        let mut less = 0;
        for (a, b) in alone.pixels.iter().zip(&among.pixels) {
            assert!(b[0] <= a[0] + 1e-9, "{b:?} is more than {a:?}");
            less += usize::from(b[0] < a[0] - 1e-3);
        }
        assert!(less > 30, "{mode:?}: {less} pixels are dimmer");
    }
}

#[test]
fn ways_end_at_a_surface() {
    // In a constant medium of x = 0.5 the sum is half the way to the box, in voxels.
    let scene = scene("constant:16", ShellMode::Sum, |s| {
        s.volume.range = Some([0.0, 1.0].map(Into::into));
        s.shells.shell_levels = vec![0.5];
        s.meshes = vec![MeshSettings { color: [0.0; 3], rotate: [0.0; 3], ..cuboid(1.0) }];
        (s.camera.eye, s.camera.height) = ([0.0, 0.0, 2.0], Some(0.6));
    });
    let frame = picture(&scene);
    let [width, height] = scene.settings.image.size;
    let middle = frame.pixels[(height / 2 * width + width / 2) as usize];
    // The box reaches 0.2 from the middle to the eye, the volume 0.5.
    assert!((middle[0] - 0.5 * 0.3 * 16.0).abs() < 1e-6, "{middle:?}");
    // Within a volume that all lies within the shell, rays end where it ends.
    let corner = frame.pixels[(width / 2) as usize];
    assert!((corner[0] - 0.5 * 16.0).abs() < 1e-6, "{corner:?}");
}

#[test]
fn outermost_shell_is_where_rays_meet_its_level_and_lit_as_there() {
    let shown = |shows: Shows, method: MethodName| {
        picture(&scene("gaussian:48", ShellMode::Surface, |s| {
            (s.shells.shell_levels, s.shells.disabled) = (vec![0.2, 0.5, 0.8], vec![1]);
            (s.surface.shows, s.surface.refine, s.method.name) = (shows, Refine::Exact, method);
            s.volume.range = Some([0.0, 1.0].map(Into::into));
            s.transfer.preset = Some("haze".to_owned());
            s.sampling.offset = Offset::Left;
        }))
    };
    let [places, colors] = [Shows::Position, Shows::Color].map(|shows| shown(shows, SHELLS.name()));
    let rays = shown(Shows::Color, RC.name());
    let (mut met, mut differing) = (0, 0);
    for ((place, color), ray) in places.pixels.iter().zip(&colors.pixels).zip(&rays.pixels) {
        // A polygon lies within the sphere, and rays that pass between them meet none.
        differing += usize::from(color[3] != ray[3]);
        if place[3] == 0.0 || color[3] != ray[3] {
            continue;
        }
        let off = (DVec3::new(place[0], place[1], place[2]).length() - radius(0.5)).abs();
        assert!(off < OFF, "{place:?} is {off:e} off the sphere");
        let apart = (0..3).map(|c| (color[c] - ray[c]).abs()).fold(0.0, f64::max);
        assert!(apart < 0.03 && color[3] == 1.0, "{color:?}, of rays {ray:?}");
        met += 1;
    }
    assert!(met > 40 && differing < 8, "{met} pixels held, {differing} are of one of both");
}

#[test]
fn outermost_shell_and_meshes_hide_each_other() {
    let scene = |depth: f64| {
        picture(&scene("gaussian:32", ShellMode::Surface, |s| {
            (s.shells.shell_levels, s.sampling.offset) = (vec![0.5], Offset::Left);
            s.volume.range = Some([0.0, 1.0].map(Into::into));
            s.meshes =
                vec![MeshSettings { color: [0.0, 9.0, 0.0], translate: [0.0, 0.0, depth], scale: 0.1, ..cuboid(1.0) }];
            (s.camera.eye, s.camera.height) = ([0.0, 0.0, 2.0], Some(1.0));
        }))
    };
    let middle = 16 * 40 + 20;
    let is_green = |frame: &CpuFrame| frame.pixels[middle][1] > 1.0;
    assert!(is_green(&scene(0.4)) && !is_green(&scene(0.0)) && !is_green(&scene(-0.4)));
}

#[test]
fn a_level_that_changes_leaves_the_other_shells() {
    use depthleap::scene::Shells;
    let first = scene("jets:16", ShellMode::Max, |s| s.shells.shell_levels = vec![50.0, 100.0, 150.0]);
    let before = first.shells.as_ref().unwrap();
    before.count(&first.field).unwrap();
    let mut settings = first.settings.shells.clone();
    settings.shell_levels = vec![50.0, 110.0, 150.0];
    let after = Shells::new(&settings, &first.field, Some(before)).unwrap().unwrap();
    let same = |i: usize| std::sync::Arc::ptr_eq(&before.list[i].mesh, &after.list[i].mesh);
    assert_eq!([0, 1, 2].map(same), [true, false, true]);
    settings.disabled = vec![2];
    let fewer = Shells::new(&settings, &first.field, Some(&after)).unwrap().unwrap();
    let levels = |shells: &Shells| shells.list.iter().map(|shell| shell.level).collect::<Vec<_>>();
    assert_eq!(levels(&fewer), [50.0, 150.0]);
    assert!(std::sync::Arc::ptr_eq(&fewer.list[1].mesh, &after.list[2].mesh));
}

#[test]
fn depths_that_hardly_differ_are_warned_of() {
    let warned = |a: f64, eye: [f64; 3]| {
        let scene = scene("gaussian:16", ShellMode::Max, |s| {
            (s.shells.a, s.meshes, s.camera.eye) = (a, vec![cuboid(1.0)], eye);
            s.camera.target = [0.3, 0.1, -0.4];
        });
        let warnings = plan::warnings(&scene, &plan::plan(&scene, None).unwrap());
        warnings.iter().any(|warning| warning.contains("--shell-a"))
    };
    let (outside, within) = ([0.5, 0.7, 1.4], [0.1, 0.05, 0.2]);
    assert_eq!([1e-3, 1e-5].map(|a| warned(a, outside)), [false, true]);
    assert_eq!([1.0, 1e-3].map(|a| warned(a, within)), [false, true]);
}

/// Words of the message.
fn refused(settings: &Settings) -> String {
    let error = match read::scene(settings) {
        Ok(scene) => plan::plan(&scene, None).expect_err("it is refused"),
        Err(error) => error,
    };
    error.to_string()
}

#[test]
fn what_shells_cannot_draw_is_refused_with_a_reason() {
    type Change = fn(&mut Settings);
    let cases: [(Change, &str); 20] = [
        (|s| s.shells.mode = None, "--shells max"),
        (|s| s.shells.count = 0, "shells.count"),
        (|s| s.shells.count = 1000, "shells.count"),
        (|s| s.shells.shell_levels = vec![1.0; 257], "257 levels"),
        (|s| s.shells.shell_levels = vec![f64::NAN], "NaN"),
        (|s| s.shells.shell_levels = vec![-3.0], "below 0"),
        (|s| s.shells.a = -1.0, "shells.a"),
        (|s| s.shells.disabled = vec![12], "number 12"),
        (|s| (s.shells.mode, s.shells.a) = (Some(ShellMode::Surface), 0.5), "depth cue"),
        (|s| (s.shells.mode, s.surface.find) = (Some(ShellMode::Surface), Find::Range), "--find range"),
        (|s| (s.shells.mode, s.surface.iso) = (Some(ShellMode::Surface), Some(0.5)), "leave one of them out"),
        (
            |s| (s.shells.mode, s.shells.disabled) = (Some(ShellMode::Surface), (1..=11).collect()),
            "leaves all shells out",
        ),
        (|s| s.projection.kind = "xray".parse().unwrap(), "--projection xray"),
        (|s| (s.method.name, s.shells.a) = (RC.name(), 0.5), "depth cue"),
        (|s| s.surface.iso = Some(90.0), "iso-surfaces"),
        (|s| s.meshes = vec![cuboid(0.5)], "transparent polygons"),
        (|s| s.meshes = vec![cuboid(1.0)], "shells.a"),
        (|s| (s.meshes, s.shells.a, s.shells.order) = (vec![cuboid(1.0)], 1.0, ShellOrder::Brightest), "brightest"),
        (|s| s.sampling.filter = Filter::Nearest, "nearest"),
        (
            |s| {
                s.clips = vec![ClipSettings {
                    builtin: Some("box".to_owned()),
                    keep: Keep::Inside,
                    ..ClipSettings::default()
                }]
            },
            "nothing cuts",
        ),
    ];
    for (change, words) in cases {
        let said = refused(&settings("shells:16", ShellMode::Max, change));
        assert!(said.contains(words), "{said} lacks {words}");
    }
    let sum = |s: &mut Settings| s.image.accumulate = Accumulate::Rgba16f;
    let said = refused(&settings("shells:16", ShellMode::Sum, sum));
    assert!(said.contains("rgba32f"), "{said}");
}

#[test]
fn odd_levels_are_told_and_ray_casters_show_the_same_emission() {
    let odd = scene("shells:16", ShellMode::Max, |s| s.shells.shell_levels = vec![120.0, 50.0, 50.0, 1e6, 900.0]);
    let shells = odd.shells.as_ref().unwrap();
    assert_eq!(shells.list.iter().map(|shell| shell.level).collect::<Vec<_>>(), [50.0, 120.0]);
    let told = shells.warnings(&odd.field).join(" ");
    assert!(told.contains("given again") && told.contains("900, 1000000"), "{told}");
    let none = scene("shells:16", ShellMode::Max, |s| s.shells.shell_levels = vec![1e6]);
    let plan = plan::plan(&none, None).unwrap();
    assert!(plan.passes == 0 && plan::warnings(&none, &plan).join(" ").contains("any shell"));
    let cast = |s: &mut Settings| s.method.name = RC.name();
    let (shown, projected) = (scene("shells:16", ShellMode::Max, cast), settings("shells:16", ShellMode::Max, cast));
    let mut projected = projected;
    (projected.shells.mode, projected.projection.kind) = (None, MIP.name());
    assert_eq!(picture(&shown).pixels, picture(&read::scene(&projected).unwrap()).pixels);
}

#[test]
fn volumes_of_one_voxel_are_a_box() {
    let scene = scene("constant:1", ShellMode::Max, |s| {
        s.volume.range = Some([0.0, 1.0].map(Into::into));
        s.shells.shell_levels = vec![0.25];
    });
    let frame = picture(&scene);
    let box_shows = rays(&scene).iter().filter(|ray| ray.is_some()).count();
    assert_eq!(frame.pixels.iter().filter(|pixel| pixel[0] == 0.25).count(), box_shows);
}
