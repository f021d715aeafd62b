//! Projections of values against closed forms: the exact integral and the f64 twin, of a constant medium, a ramp and a
//! Gaussian; what they refuse, and what they skip.

use depthleap::frame::{Structures, cpu};
use depthleap::math::ray::box_interval;
use depthleap::method;
use depthleap::plan::{self, Plan};
use depthleap::projection::{MIP, PROJECTIONS, Projection, XRAY};
use depthleap::read;
use depthleap::scene::settings::{Accumulate, Classification, Filter, Last, Offset, Settings, VolumeTexture};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Scene, Volume};
use depthleap::structure::cells;
use depthleap::truth::exact::ExactIntegrator;

const SIDE: usize = 16;

/// Every projection of values. A new one is given its closed forms below: none stands for it by default.
fn of_values() -> impl Iterator<Item = &'static Projection> {
    PROJECTIONS.into_iter().filter(|row| row.shows_values())
}

/// What the levels of `mip` and `minip` may take from a value, relative, with the rounding of voxels to f32.
const SLACK: f64 = 2e-6;

/// A cube of voxels by their place, under the range 0 to 1, head-on from in front of +z, or as `change` says.
fn scene(row: &Projection, value: impl Fn([usize; 3]) -> f64, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.projection.kind = row.name();
    settings.volume.range = Some([0.0, 1.0].map(Into::into));
    settings.volume.texture = VolumeTexture::R32f;
    settings.image.size = [21, 21];
    settings.camera.eye = [0.0, 0.0, 1.91];
    settings.method.name = method::RC.name();
    (settings.sampling.filter, settings.sampling.last) = (Filter::Exact, Last::Partial);
    change(&mut settings);
    let voxels = (0..SIDE.pow(3)).map(|i| value([i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)])).collect();
    let volume = Volume::new("cube", [SIDE; 3], [1.0; 3], Voxels::F64(voxels)).unwrap();
    read::scene_of(&settings, |_| Ok(volume.clone())).unwrap()
}

fn planned(scene: &Scene) -> Plan {
    plan::plan(scene, method::papers_form(scene.settings.method.name)).unwrap()
}

/// The picture by the twins.
fn twin(scene: &Scene) -> Vec<[f64; 4]> {
    let plan = planned(scene);
    let mut structures = Structures::default();
    structures.prepare(scene, &plan);
    cpu::run(scene, &plan, &structures, cpu::SUB_PIXEL_BITS).pixels
}

fn exact(scene: &Scene) -> Vec<[f64; 4]> {
    let size = scene.settings.image.size;
    ExactIntegrator::of(scene).picture(&scene.camera.rays(size).unwrap(), size)
}

/// Entry and exit of each pixel's ray in voxels from the volume's corner, and its length in voxels.
fn rays(scene: &Scene) -> Vec<Option<([[f64; 3]; 2], f64)>> {
    let size = scene.settings.image.size;
    let rays = scene.camera.rays(size).unwrap();
    let pixel = |i: u32| {
        let ray = rays.of(i % size[0], i / size[0]);
        let (enter, leave) = box_interval(&ray, 0.5 * scene.field.extent(), rays.near)?;
        let place = |t: f64| ((ray.at(t) + 0.5) * SIDE as f64).to_array();
        Some(([place(enter), place(leave)], (leave - enter) * ray.direction.length() * SIDE as f64))
    };
    (0..size[0] * size[1]).map(pixel).collect()
}

/// Every pixel is grey, and that of the closed form of its ray; transparent off the box.
#[track_caller]
fn held(scene: &Scene, picture: &[[f64; 4]], tolerance: f64, form: impl Fn([[f64; 3]; 2], f64) -> f64) {
    let name = scene.settings.projection.kind;
    let mut seen = 0;
    for (i, (pixel, ray)) in picture.iter().zip(rays(scene)).enumerate() {
        let Some((ends, length)) = ray else {
            assert_eq!(*pixel, [0.0; 4], "{name}: pixel {i} is off the box");
            continue;
        };
        let expected = form(ends, length);
        let near = (pixel[0] - expected).abs() <= tolerance * expected.abs().max(1.0);
        assert!(near && pixel[1..] == [pixel[0], pixel[0], 1.0], "{name}: pixel {i} is {pixel:?}, not {expected}");
        seen += 1;
    }
    assert!(seen > 100, "{name}: {seen} pixels");
}

#[test]
fn a_constant_medium_is_its_value_and_xray_its_length() {
    // All negative, far beyond the range, and in it.
    for value in [0.3, -2.0, 40.0] {
        for row in of_values() {
            let scene = scene(row, |_| value, |_| {});
            let form = |_, length: f64| match row.name {
                "mip" | "minip" | "average" => value,
                "xray" => value * length,
                other => panic!("{other} has no closed form here"),
            };
            held(&scene, &exact(&scene), 1e-6, form);
            held(&scene, &twin(&scene), SLACK, form);
        }
    }
}

#[test]
fn a_ramp_has_its_ends_its_middle_and_its_area() {
    // x = (z - 0.5) / 8 - 3 between the outermost centres, level beyond: negative for the most part.
    let ramp = |z: f64| (z.clamp(0.5, SIDE as f64 - 0.5) - 0.5) / 8.0 - 1.5;
    // Its integral over z.
    let area = |z: f64| {
        let (low, high) = (0.5, SIDE as f64 - 0.5);
        let inside = |z: f64| (z - low).powi(2) / 16.0 - 1.5 * (z - low);
        inside(z.clamp(low, high)) + ramp(low) * (z - low).min(0.0) + ramp(high) * (z - high).max(0.0)
    };
    for row in of_values() {
        let scene = scene(
            row,
            |[_, _, z]| z as f64 / 8.0 - 1.5,
            |s| {
                (s.sampling.step, s.sampling.offset) = (1.0 / 64.0, Offset::Midpoint);
                (s.sampling.samples_per_pass, s.image.size) = (256, [15, 15]);
            },
        );
        let form = |[[_, _, a], [_, _, b]]: [[f64; 3]; 2], length: f64| {
            let mean = if (b - a).abs() > 1e-9 { (area(b) - area(a)) / (b - a) } else { ramp(a) };
            match row.name {
                "mip" => ramp(a).max(ramp(b)),
                "minip" => ramp(a).min(ramp(b)),
                "average" => mean,
                "xray" => mean * length,
                other => panic!("{other} has no closed form here"),
            }
        };
        held(&scene, &exact(&scene), 1e-6, form);
        // Half a step misses 1 / 1024 of an extremum at the very end; sums are of the second order.
        held(&scene, &twin(&scene), 2e-3, form);
    }
}

/// The exact pictures of a Gaussian against samples so close that they are nearly exact.
#[test]
fn a_gaussian_is_approached_in_the_orders_that_theory_knows() {
    let gaussian = |[x, y, z]: [usize; 3]| {
        let square = |at: usize| ((at as f64 - 7.3) / 4.0).powi(2);
        (-(square(x) + square(y) + square(z))).exp() + 0.1
    };
    let error = |row: &Projection, step: f64, offset: Offset| {
        let scene = scene(row, gaussian, |s| {
            (s.sampling.step, s.sampling.offset, s.sampling.samples_per_pass) = (step, offset, 64);
            (s.image.size, s.camera.eye) = ([9, 9], [0.9, 0.65, 1.55]);
        });
        // A ray that touches a corner may have no sample at all.
        let long: Vec<bool> = rays(&scene).iter().map(|ray| ray.is_some_and(|(_, length)| length > 2.0)).collect();
        let pairs = twin(&scene).into_iter().zip(exact(&scene)).zip(long).filter(|(_, long)| *long);
        let squares: Vec<f64> = pairs.map(|((p, q), _)| (p[0] - q[0]).powi(2)).collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    };
    for row in of_values() {
        for (offset, least) in [(Offset::Left, 1.0), (Offset::Midpoint, 2.0)] {
            // Far apart: how samples lie to the faces between cells moves an error by a factor of two.
            let (coarse, fine) = (error(row, 1.0, offset), error(row, 1.0 / 64.0, offset));
            let order = (coarse / fine).log2() / 6.0;
            println!("{}, {offset:?}: {coarse:.1e} to {fine:.1e}, order {order:.2}", row.name);
            if row.values.as_ref().is_some_and(|values| (values.order)(offset, Last::Partial, false).is_some()) {
                assert!((order - least).abs() < 0.3, "{}, {offset:?}: order {order}", row.name);
            } else {
                assert!(order > 0.8, "{}, {offset:?}: order {order}", row.name);
            }
        }
    }
}

/// A comparison that would not see a shifted sample sees nothing.
#[test]
#[should_panic(expected = "pixel")]
fn a_wrong_closed_form_is_seen() {
    let scene = scene(&XRAY, |_| 0.3, |_| {});
    held(&scene, &exact(&scene), 1e-6, |_, length| 0.3 * length + 1e-3);
}

/// The true extremum lies between samples, and inside a cell, where the field along a diagonal is a cubic.
#[test]
fn the_exact_extremum_is_no_sample() {
    let saddle = |[x, y, z]: [usize; 3]| f64::from(u8::from((x + y + z) % 2 == 1));
    let scene = scene(&MIP, saddle, |s| s.camera.eye = [0.9, 0.65, 1.55]);
    let (truth, sampled) = (exact(&scene), twin(&scene));
    assert!(truth.iter().zip(&sampled).all(|(p, q)| p[0] >= q[0] - SLACK));
    assert!(truth.iter().zip(&sampled).any(|(p, q)| p[0] > q[0] + 1e-3));
}

#[test]
fn rays_too_short_for_a_sample_do_not_stand_out() {
    for row in of_values() {
        // A cube on its edge, by long steps from the middle of each: rays at its outline are shorter than half a step.
        let scene = scene(
            row,
            |[x, _, _]| 0.25 + 0.5 * (x as f64 / (SIDE - 1) as f64),
            |s| {
                s.camera.eye = [1.4, 1.1, 1.0];
                (s.sampling.offset, s.sampling.step) = (Offset::Midpoint, 4.0);
            },
        );
        let (picture, rays) = (twin(&scene), rays(&scene));
        let short = rays.iter().zip(&picture).filter(|(ray, _)| ray.is_some_and(|(_, length)| length < 2.0));
        let shown: Vec<f64> = short.map(|(_, pixel)| pixel[0]).collect();
        assert!(!shown.is_empty(), "{}: no ray is that short", row.name);
        assert!(shown.iter().all(|value| *value < 0.2501), "{}: {shown:?}", row.name);
    }
}

#[test]
fn what_cannot_change_a_pixel_is_not_interesting() {
    // One voxel of 1 in nothing: the eight cells around it are all that counts, but for minip, which sees everything else.
    let dot = |at: [usize; 3]| f64::from(u8::from(at == [7, 8, 9]));
    for row in of_values() {
        let scene = scene(row, dot, |s| s.method.name = method::NN_OMNI.name());
        assert!(cells::any_interesting(&scene), "{}", row.name);
        let mut plain = scene.clone();
        plain.settings.method.name = method::RC.name();
        assert_eq!(twin(&scene), twin(&plain), "{}", row.name);
    }
    // Nothing rises above the one value there is, and nothing is no more than nothing.
    for row in of_values() {
        let value = match row.name {
            "mip" => 0.7,
            "minip" => -0.7,
            "average" | "xray" => 0.0,
            other => panic!("{other} has no value here that changes no pixel"),
        };
        assert!(!cells::any_interesting(&scene(row, |_| value, |_| {})), "{}", row.name);
    }
}

#[test]
fn pixels_change_by_no_more_than_their_magnification_says() {
    const BY: f64 = 0.01;
    for row in of_values() {
        let pictures =
            [0.5, 0.5 + BY].map(|value| scene(row, move |_| value, |_| {})).map(|scene| (exact(&scene), scene));
        let longest = rays(&pictures[0].1).into_iter().flatten().map(|(_, length)| length).fold(0.0, f64::max);
        let most = BY * (row.values.as_ref().unwrap().magnification)(longest);
        let moved = pictures[0].0.iter().zip(&pictures[1].0).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f64::max);
        assert!((0.9 * most..=most + 1e-6).contains(&moved), "{}: moved by {moved}, at most {most}", row.name);
        assert!(!row.source.is_empty(), "{}", row.name);
    }
}

#[test]
fn plans_leave_the_transfer_function_out() {
    for row in of_values() {
        let plan = planned(&scene(row, |[x, _, _]| x as f64, |_| {}));
        let text = plan.lines().join("\n");
        assert!(text.contains("classification left out"), "{text}");
        assert!(text.contains("start") && !text.contains("transfer"), "{text}");
        assert!(plan.pixel_error > 0.0, "{}", row.name);
    }
}

#[test]
fn values_that_a_format_cannot_hold_are_named() {
    let warned = |row: &Projection, value: f64, accumulate: Accumulate| {
        let scene = scene(row, |_| value, |s| s.image.accumulate = accumulate);
        plan::warnings(&scene, &planned(&scene)).iter().any(|warning| warning.contains("holds"))
    };
    for row in of_values() {
        assert!(warned(row, -0.5, Accumulate::Rgba8), "{}", row.name);
        assert!(!warned(row, -0.5, Accumulate::Rgba16f), "{}", row.name);
        assert!(!warned(row, 1e9, Accumulate::Rgba32f), "{}", row.name);
        // A sum over the way is above 1 where no value is.
        assert_eq!(warned(row, 0.5, Accumulate::Rgba8), row.name == "xray", "{}", row.name);
    }
}

#[test]
fn tables_of_colours_are_refused() {
    for row in of_values() {
        let scene = scene(row, |_| 0.5, |s| s.sampling.classification = Classification::PreIntegrated);
        let error = plan::plan(&scene, None).unwrap_err().to_string();
        assert!(error.contains(row.name) && error.contains("--classification post"), "{error}");
    }
}
