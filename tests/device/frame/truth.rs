//! Frames against the truth: the f64 twins of their passes, the exact integral, closed forms.

use std::sync::Arc;

use depthleap::math::ray::box_interval;
use depthleap::method;
use depthleap::part::rows::Method;
use depthleap::scene::Scene;
use depthleap::scene::settings::{Classification, Last, Offset, Settings};
use depthleap::truth::exact::ExactIntegrator;
use depthleap::vulkan::Device;

use super::compare::{SAME_SUM, difference, held};
use super::scenes::{Stage, VIEWS, by, exactly, forms, scene, seen, shapes, views_of};
use crate::harness::{Need, Test, test};

/// Share of pixels in which f32 may not be able to tell on which side of a jump or an end a sample lies. Those on the
/// outline of the box, which are the rasteriser's to decide, are counted by themselves: their share falls with the
/// size of the picture, and these are small.
const UNDECIDED: f64 = 1e-3;

const SCENES: [(&str, &str); 12] = [
    ("shells:48", "ramp"),
    ("blocks:64", "surface"),
    ("jets:40x48x56", "linear"),
    ("marschner-lobb:41", "haze"),
    ("gaussian:32", "linear"),
    ("shells:64x64x1", "surface"),
    ("fuel.nrrd", "ramp"),
    ("nucleon.nrrd", "surface"),
    ("engine_256cube.nrrd", "ramp"),
    ("aneurism.nrrd", "ramp"),
    ("mri_head.nrrd", "ramp"),
    ("ct_vismale.nrrd", "surface"),
];

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    for (number, (volume, tf)) in SCENES.into_iter().enumerate() {
        let one = test(&format!("twin::{volume}::{tf}"), move |device| {
            twin(device, &scene(volume, tf, exactly), number);
        });
        tests.push(if volume.ends_with(".nrrd") { one.needs(Need::Data(volume)) } else { one });
    }
    tests.extend([
        test("twin::small_steps_and_partial_samples", |device| {
            twin(
                device,
                &scene("blocks:24", "ramp", |s| {
                    exactly(s);
                    s.sampling.step = 0.25;
                    (s.sampling.offset, s.sampling.last) = (Offset::Midpoint, Last::Partial);
                }),
                0,
            );
        }),
        test("twin::steps_classified_as_a_whole", |device| {
            for (turn, last) in [Last::Full, Last::Partial].into_iter().enumerate() {
                twin(
                    device,
                    &scene("shells:32x28x30", "surface", |s| {
                        exactly(s);
                        (s.sampling.classification, s.sampling.last) = (Classification::PreIntegrated, last);
                        s.sampling.step = 1.7;
                    }),
                    turn,
                );
            }
        }),
        test("twin::full_size", full_size),
        test("twin::would_see_a_shifted_sample", would_see_a_shifted_sample),
        test("exact::constant_medium_is_beers_law", constant_medium_is_beers_law),
        test("exact::midpoint_samples_approach_the_integral", midpoint_samples_approach_the_integral),
        test("exact::every_method_is_near_the_integral", every_method_is_near_the_integral),
    ]);
    tests
}

/// Every shape of a method, all views of a volume that is not large: counts and picture are those of the twins.
fn twin(device: &Arc<Device>, scene: &Scene, turn: usize) {
    let mut stage = Stage::new(device);
    let (mut largest, mut open, mut outline, mut pixels) = (0.0f64, 0, 0, 0);
    for (_, view) in views_of(scene, turn) {
        for method in shapes().into_iter().map(Method::name) {
            let scene = by(&seen(scene, view), method);
            // The last form of each method is the one every device has.
            let form = forms(device, method).pop().flatten();
            let name = format!("{}, {}", method.name(), view.0);
            let twin = stage.twin(&scene, method::papers_form(method));
            let shot = stage.shoot(&scene, form);
            let undecided = twin.undecided.iter().filter(|u| **u).count();
            (open, outline) = (open + undecided as u64 - twin.outline, outline + twin.outline);
            pixels += twin.undecided.len() as u64;
            largest = largest.max(held(&shot, &twin, 0.0).unwrap_or_else(|e| panic!("{name}: {e}")));
        }
    }
    println!("largest difference {largest:.1e}, {open} of {pixels} pixels undecided, and {outline} on the outline");
    assert!((open as f64) < UNDECIDED * pixels as f64, "{open} of {pixels} pixels are undecided");
}

/// At the size of the papers' pictures those on the outline are few too.
fn full_size(device: &Arc<Device>) {
    let scene = seen(&scene("shells:64", "ramp", exactly), VIEWS[1]);
    let mut scene = by(&scene, method::RC_ERT.name());
    scene.settings.image.size = [500, 500];
    let form = forms(device, method::RC_ERT.name()).pop().flatten();
    let mut stage = Stage::new(device);
    let (shot, twin) = (stage.shoot(&scene, form), stage.twin(&scene, method::papers_form(method::RC_ERT.name())));
    let largest = difference(&shot.picture, &twin, SAME_SUM).unwrap_or_else(|e| panic!("{e}"));
    let open = twin.undecided.iter().filter(|u| **u).count();
    println!(
        "largest difference {largest:.1e}, {open} of 250000 pixels undecided, {} of them on the outline",
        twin.outline
    );
    assert!((open as f64) < UNDECIDED * 250_000.0, "{open} pixels are undecided");
}

fn would_see_a_shifted_sample(device: &Arc<Device>) {
    let scene = by(&scene("shells:24", "ramp", exactly), method::RC.name());
    let mut shifted = scene.clone();
    // A ten thousandth of a step.
    shifted.settings.sampling.step += 1e-4;
    let mut stage = Stage::new(device);
    let picture = stage.shoot(&scene, None).picture;
    assert!(difference(&picture, &stage.twin(&scene, None), SAME_SUM).is_ok());
    assert!(difference(&picture, &stage.twin(&shifted, None), SAME_SUM).is_err());
}

/// `haze` is 0.01 a voxel everywhere; with a last sample for what is left of the ray, opacity is 1 - 0.99^length.
fn constant_medium_is_beers_law(device: &Arc<Device>) {
    let scene = scene("constant:16", "haze", |s| {
        s.sampling.last = Last::Partial;
        s.sampling.termination = 1.0;
        s.sampling.step = 0.7;
    });
    for view in VIEWS {
        let scene = by(&seen(&scene, view), method::RC.name());
        let picture = Stage::new(device).shoot(&scene, None).picture;
        let exact = ExactIntegrator::new(&scene.field, &scene.transfer);
        let rays = scene.camera.rays(scene.settings.image.size).unwrap();
        let half = 0.5 * scene.field.extent();
        let width = scene.settings.image.size[0];
        let mut seen = 0;
        for (i, pixel) in picture.iter().enumerate() {
            let (column, row) = (i as u32 % width, i as u32 / width);
            let ray = rays.of(column, row);
            let Some((enter, leave)) = box_interval(&ray, half, rays.near) else { continue };
            let direction = ray.direction;
            let voxels = (leave - enter) * direction.length() / scene.field.finest();
            let alpha = 1.0 - 0.99f64.powf(voxels);
            let unit = direction.normalize();
            let integral = exact.ray(ray.at(enter), unit, (leave - enter) * direction.length());
            // A ray that only touches an edge may be left out by the rasteriser, which works in 1/256 pixel.
            if voxels < 0.1 {
                continue;
            }
            seen += 1;
            assert!((f64::from(pixel[3]) - alpha).abs() < 1e-6, "{}: pixel {i} {pixel:?}, Beer {alpha}", view.0);
            assert!((integral[3] - alpha).abs() < 1e-9, "{}: {integral:?}, Beer {alpha}", view.0);
        }
        assert!(seen > 1000, "{}: {seen} pixels", view.0);
    }
}

/// A Gaussian that is nearly 0 at the faces: errors of midpoint samples fall by four when the step is halved.
fn midpoint_samples_approach_the_integral(device: &Arc<Device>) {
    let error = |step: f64| {
        let scene = scene("gaussian:16", "linear", |s| smooth(s, step));
        integral_error(device, &by(&scene, method::RC.name()))
    };
    let errors = [2.0, 1.0, 0.5, 0.25].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.7..2.6).contains(&order), "errors {errors:?}, order {order}");
    }
}

fn smooth(settings: &mut Settings, step: f64) {
    exactly(settings);
    settings.camera.eye = [0.6, 0.5, 1.5];
    settings.sampling.step = step;
    settings.sampling.termination = 1.0;
    (settings.sampling.offset, settings.sampling.last) = (Offset::Midpoint, Last::Partial);
}

/// Root mean square of the differences to the exact integral.
fn integral_error(device: &Arc<Device>, scene: &Scene) -> f64 {
    let form = forms(device, scene.settings.method.name).pop().flatten();
    let picture = Stage::new(device).shoot(scene, form).picture;
    let size = scene.settings.image.size;
    let exact =
        ExactIntegrator::new(&scene.field, &scene.transfer).picture(&scene.camera.rays(size).expect("a camera"), size);
    let squares = picture.iter().zip(&exact).flat_map(|(p, q)| (0..4).map(|c| (f64::from(p[c]) - q[c]).powi(2)));
    (squares.sum::<f64>() / (4 * picture.len()) as f64).sqrt()
}

/// An eighth of a voxel: second order leaves 1/64 of what a whole voxel does (1e-2 here), rounding is far below.
fn every_method_is_near_the_integral(device: &Arc<Device>) {
    for method in shapes().into_iter().map(Method::name) {
        let scene = scene("shells:24", "ramp", |s| smooth(s, 0.125));
        let error = integral_error(device, &by(&scene, method));
        println!("{}: {error:.1e}", method.name());
        assert!(error < 2e-4, "{}: {error:e} from the integral", method.name());
    }
}
