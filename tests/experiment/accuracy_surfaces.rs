//! Error against run time of iso-surfaces: places, normals and colours, each by itself.

use depthleap::experiment::accuracy::{
    About, Accuracy, SurfaceError, SurfaceOrders, SurfacePictures, csv, fit, page, questions, step_svgs, surface_error,
    text, time_svgs,
};
use depthleap::frame::{Structures, cpu};
use depthleap::measure::Picture;
use depthleap::method::RC_ERT;
use depthleap::plan::plan;
use depthleap::read;
use depthleap::scene::settings::{Filter, GradientOperator, GradientTexture, Gradients, Refine, Settings, Shows};
use depthleap::truth::exact::ExactIntegrator;

use crate::accuracies::found;

const HERE: [f32; 4] = [0.1, 0.2, 0.3, 1.0];
const UP: [f32; 4] = [0.0, 0.0, 1.0, 1.0];
const GREY: [f32; 4] = [0.5, 0.5, 0.5, 1.0];
const NOTHING: [f32; 4] = [0.0; 4];

/// The error of one pixel of place, normal and colour against another one; the step is 0.1 long.
fn error(found: [[f32; 4]; 3], truth: [[f32; 4]; 3]) -> SurfaceError {
    let pictures = |pixels: [[f32; 4]; 3]| pixels.map(|pixel| Picture::new([1, 1], vec![pixel]).unwrap());
    let (found, truth) = (pictures(found), pictures(truth));
    surface_error(of(&found), of(&truth), 0.1)
}

/// Pictures of places, normals and colours.
fn of([places, normals, colors]: &[Picture; 3]) -> SurfacePictures<'_> {
    SurfacePictures { places, normals, colors }
}

#[test]
fn errors_are_those_of_the_same_sheet() {
    let same = [HERE, UP, GREY];
    let none = SurfaceError { position: None, normal: None, color: None, missed: 0, pixels: 0 };
    let met = |position, normal, color| SurfaceError {
        position: Some(position),
        normal: Some(normal),
        color: Some(color),
        missed: 0,
        pixels: 1,
    };
    assert_eq!(error(same, same), met(0.0, 0.0, 0.0));
    assert_eq!(error([NOTHING; 3], [NOTHING; 3]), none, "no ray meets it, and nothing is divided by 0");
    let missed = SurfaceError { missed: 1, pixels: 1, ..none };
    assert_eq!(error([NOTHING; 3], same), missed);
    assert_eq!(error(same, [NOTHING; 3]), missed);
    // One step away it is the same sheet, beyond that another one; a place that is no number is on none.
    let near = error([[0.1, 0.2, 0.4, 1.0], UP, GREY], same).position.unwrap();
    assert!((near - 0.1).abs() < 1e-7, "{near}");
    assert_eq!(error([[0.1, 0.2, 0.401, 1.0], UP, GREY], same), missed);
    assert_eq!(error([[0.1, f32::NAN, 0.3, 1.0], UP, GREY], same), missed);
    // A normal may point either way.
    let normal = |normal: [f32; 4]| error([HERE, normal, GREY], same).normal.unwrap();
    let turned = normal([0.0, 0.6, -0.8, 1.0]);
    assert!((turned - 0.75f64.atan()).abs() < 1e-6, "{turned}");
    assert!(normal([0.0, 0.0, -1.0, 1.0]) < 1e-6);
    assert_eq!(normal([0.0, 0.0, 0.0, 1.0]), std::f64::consts::FRAC_PI_2, "the truth alone has one");
    let flat = error(same, [HERE, [0.0, 0.0, 0.0, 1.0], GREY]);
    assert_eq!((flat.normal, flat.missed, flat.color), (None, 0, Some(0.0)), "there is nothing to hold against");
    let color = error([HERE, UP, [0.5, 0.5, 0.8, 1.0]], same).color.unwrap();
    assert!((color - 0.3 / 3.0f64.sqrt()).abs() < 1e-7, "{color}");
}

/// The picture of a scene in f64, and the exact one.
fn pictures(settings: &Settings, shows: Shows) -> (Picture, Picture) {
    let mut settings = settings.clone();
    settings.surface.shows = shows;
    let scene = read::scene(&settings).unwrap();
    let plan = plan(&scene, RC_ERT.papers).unwrap();
    let mut structures = Structures::default();
    structures.prepare(&scene, &plan);
    let frame = cpu::run(&scene, &plan, &structures, cpu::SUB_PIXEL_BITS);
    let exact = ExactIntegrator::of(&scene).picture(&plan.view.rays, plan.view.size);
    let picture = |pixels: Vec<[f64; 4]>| {
        let pixels = pixels.into_iter().map(|pixel| pixel.map(|c| c as f32)).collect();
        Picture::new(plan.view.size, pixels).unwrap()
    };
    (picture(frame.pixels), picture(exact))
}

/// The errors of a gaussian's surface by the step.
fn errors(change: fn(&mut Settings)) -> Vec<(f64, SurfaceError)> {
    let measured = |step: f64| {
        let mut settings = Settings::default();
        settings.volume.builtin = Some("gaussian:48".to_owned());
        (settings.surface.iso, settings.sampling.filter) = (Some(0.4), Filter::Exact);
        (settings.image.size, settings.sampling.step) = ([48, 40], step);
        (settings.camera.eye, settings.camera.fov_y) = ([0.9, 0.65, 1.5], 15.0);
        settings.method.name = RC_ERT.name();
        change(&mut settings);
        let (found, truth): (Vec<Picture>, Vec<Picture>) =
            [Shows::Position, Shows::Normal, Shows::Color].map(|shows| pictures(&settings, shows)).into_iter().unzip();
        let (found, truth) = (found.try_into().unwrap(), truth.try_into().unwrap());
        (step, surface_error(of(&found), of(&truth), step / 48.0))
    };
    [2.0, 1.0, 0.5, 0.25, 0.125].map(measured).to_vec()
}

#[test]
fn places_are_of_the_order_of_their_refinement() {
    type Change = fn(&mut Settings);
    // A step that goes through a face between cells is refined to the first order only.
    let changes: [(&str, Change, [f64; 2]); 2] = [
        ("not refined", |s| s.surface.refine = Refine::None, [0.8, 1.2]),
        ("refined linear", |s| s.surface.refine = Refine::Linear, [1.4, 2.2]),
    ];
    for (name, change, [least, most]) in changes {
        let errors = errors(change);
        let places: Vec<(f64, f64)> = errors.iter().map(|(step, error)| (*step, error.position.unwrap())).collect();
        let found = fit(&places).unwrap().order;
        println!("{name}: order {found:.3} of {errors:?}");
        assert!((least..most).contains(&found), "{name}: order {found} of {errors:?}");
    }
}

#[test]
fn places_at_the_root_are_off_by_rounding_alone() {
    for (step, error) in errors(|s| s.surface.refine = Refine::Exact) {
        println!("{step}: {error:?}");
        assert!(error.pixels > 300 && 50 * error.missed < error.pixels, "with steps of {step}: {error:?}");
        assert!(error.position.unwrap() < 5e-6, "with steps of {step}: {error:?}");
        assert!(error.normal.unwrap() < 0.1 && error.color.unwrap() < 0.1, "with steps of {step}: {error:?}");
    }
}

/// A record of a surface: the scene's own way by two methods, and others by the first.
fn of_a_surface() -> Accuracy {
    let mut all = found();
    let curve = |method: &str, variation: &str, change: fn(&mut Settings)| {
        let mut curve = found().curves[0].clone();
        (curve.method, curve.variation) = (method.to_owned(), variation.to_owned());
        curve.settings.surface.iso = Some(90.0);
        change(&mut curve.settings);
        for point in &mut curve.points {
            let position = Some(0.01 * point.step);
            let color = Some(0.02 * point.step);
            point.surface = Some(SurfaceError { position, normal: Some(0.03), color, missed: 12, pixels: 3400 });
        }
        let order = |of: fn(&SurfaceError) -> Option<f64>| {
            fit(&curve.points.iter().filter_map(|p| Some((p.step, of(p.surface.as_ref()?)?))).collect::<Vec<_>>())
        };
        let (position, color) = (order(|error| error.position), order(|error| error.color));
        curve.surface = Some(SurfaceOrders { position, normal: None, color, expected_position: Some(1.0) });
        curve
    };
    all.curves = vec![
        curve("rc", "", |_| {}),
        curve("nn-omni", "", |_| {}),
        curve("rc", "not refined", |s| s.surface.refine = Refine::None),
        curve("rc", "refined exact", |s| s.surface.refine = Refine::Exact),
        curve("rc", "refined exact, sobel rgba8", |s| {
            s.surface.refine = Refine::Exact;
            (s.shading.gradients, s.shading.gradient) = (Gradients::Precomputed, GradientOperator::Sobel);
            s.shading.format = GradientTexture::Rgba8;
        }),
    ];
    all
}

#[test]
fn curves_of_a_surface_are_asked_how_places_and_gradients_are_found() {
    let found = of_a_surface();
    let asked: Vec<(About, String)> =
        questions(&found.curves).into_iter().map(|question| (question.about, question.title)).collect();
    let expected = [
        (About::Methods, "Methods"),
        (About::Sampling, "Ways to find a place, rc"),
        (About::Gradients, "Gradients, refined exact, rc"),
    ];
    assert_eq!(asked, expected.map(|(about, title)| (about, title.to_owned())));
    let labels: Vec<String> = questions(&found.curves).swap_remove(2).curves.into_iter().map(|(_, l)| l).collect();
    assert_eq!(labels, ["gradients on the fly", "sobel rgba8"]);
}

#[test]
fn files_say_what_was_found_of_a_surface() {
    let found = of_a_surface();
    let json = serde_json::to_string(&found).unwrap();
    assert_eq!(serde_json::from_str::<Accuracy>(&json).unwrap(), found);
    let table = text(&found);
    for part in [
        "  places: order 1.00 over steps 1 to 0.25 (theory: 1)",
        "  normals: no order: the error does not fall with the step (theory gives none)",
        "  colours: order 1.00",
        "normals / rad",
        "12 of 3,400",
        "1.0e-2",
    ] {
        assert!(table.contains(part), "{part} is not in\n{table}");
    }
    let rows = csv(&found).unwrap();
    let columns = |line: &str| line.split(',').count();
    assert!(rows.lines().next().unwrap().ends_with(",position_order,normal_order,color_order,expected_position_order"));
    assert!(rows.lines().nth(1).unwrap().contains(",0.01,0.03,0.02,12,3400,"), "{rows}");
    assert_eq!(columns(rows.lines().next().unwrap()), columns(rows.lines().nth(1).unwrap()));
    let html = page(&found, &|_| Err(String::new())).unwrap();
    assert!(html.contains("places: order 1.00") && html.matches("<svg").count() == 2);
    for svg in [time_svgs(&found).unwrap().concat(), step_svgs(&found).unwrap().concat()] {
        for part in [
            "Places: Methods",
            "Places: Ways to find a place, rc",
            "Normals: Gradients, refined exact, rc",
            "Colours: Methods",
            "rms error of places / volume units",
            "rms error of normals / radians",
            "refined linear, hardware filter",
        ] {
            assert!(svg.contains(part), "{part} is not in\n{svg}");
        }
        // Gradients move no place.
        assert!(!svg.contains("Places: Gradients"));
    }
}

#[test]
fn records_without_surfaces_have_nothing_of_them_and_old_ones_are_read() {
    let found = found();
    let json = serde_json::to_string(&found).unwrap();
    assert!(!json.contains("\"missed\"") && !json.contains("\"expected_position\""), "{json}");
    assert!(!csv(&found).unwrap().contains("position_rmse") && !text(&found).contains("missed"));
    // A record of a surface from before any of this was measured.
    let mut old = of_a_surface();
    for curve in &mut old.curves {
        curve.surface = None;
        curve.points.iter_mut().for_each(|point| point.surface = None);
    }
    let json = serde_json::to_string(&old).unwrap();
    assert_eq!(serde_json::from_str::<Accuracy>(&json).unwrap(), old);
    let svg = step_svgs(&old).unwrap().concat();
    assert!(svg.contains("root mean squared error") && !svg.contains("Places:"), "{svg}");
}
