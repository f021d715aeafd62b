//! Orders, answers and explanations of error against run time.

use depthleap::experiment::accuracy::{
    Accuracy, Curve, FORMAT, Point, Question, answers, csv, expected_order, fastest, fit, mark_pareto, page, questions,
    remarks, step_svgs, text, time_svgs,
};
use depthleap::measure::picture::similarity;
use depthleap::measure::record::Clock;
use depthleap::method;
use depthleap::provenance::Provenance;
use depthleap::read;
use depthleap::report::plot::DISTINCT;
use depthleap::scene::Scene;
use depthleap::scene::settings::{Accumulate, Alpha, Filter, Last, Offset, Settings};

use crate::runs::picture;

const STEPS: [f64; 8] = [8.0, 4.0, 2.0, 1.0, 0.5, 0.25, 0.125, 0.0625];

fn law(error: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    STEPS.iter().map(|&step| (step, error(step))).collect()
}

#[test]
fn orders_are_those_of_power_laws() {
    for order in [0.5, 1.0, 2.0, 3.5] {
        let found = fit(&law(|step| 0.01 * step.powf(order))).unwrap();
        assert!((found.order - order).abs() < 1e-9, "{found:?}");
        assert_eq!((found.points, found.steps.map(f64::round)), (6, [2.0, 0.0]));
    }
    // Longer steps than a cell do not count, wherever they are in the list.
    let mut wild = law(|step| if step > 2.0 { 1e-9 } else { step });
    wild.reverse();
    assert!((fit(&wild).unwrap().order - 1.0).abs() < 1e-9);
}

#[test]
fn what_does_not_fall_with_the_step_is_left_out_of_a_fit() {
    let found = fit(&law(|step| step * step + 0.05)).unwrap();
    assert!(found.points == 5 && found.order < 2.0, "{found:?}");
    // A step between at which errors cancel is no floor.
    let cancelled = fit(&law(|step| step * step * if step == 2.0 { 0.3 } else { 1.0 })).unwrap();
    assert!(cancelled.points == 6 && cancelled.order > 1.5, "{cancelled:?}");
    // A floor from the beginning, errors that grow, too few points, none.
    assert_eq!(fit(&law(|_| 1e-3)), None);
    assert_eq!(fit(&law(|step| 1.0 / step)), None);
    assert_eq!(fit(&[(1.0, 0.1), (0.5, 0.05)]), None);
    assert_eq!(fit(&[]), None);
    assert_eq!(fit(&law(|_| f64::INFINITY)), None);
    assert_eq!(fit(&law(|_| 0.0)), None);
}

fn scene(volume: &str, tf: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(volume.to_owned());
    settings.transfer.preset = Some(tf.to_owned());
    change(&mut settings);
    read::scene(&settings).unwrap()
}

#[test]
fn theory_knows_faces_offsets_and_jumps() {
    let of = |volume: &str, tf: &str, offset, last, alpha| {
        expected_order(&scene(volume, tf, |s| {
            (s.sampling.offset, s.sampling.last, s.sampling.alpha) = (offset, last, alpha);
        }))
    };
    let (left, midpoint) = (Offset::Left, Offset::Midpoint);
    // Filled up to the faces.
    assert_eq!(of("constant:8", "haze", left, Last::Full, Alpha::Exponential), Some(1.0));
    assert_eq!(of("constant:8", "haze", midpoint, Last::Partial, Alpha::Exponential), Some(2.0));
    assert_eq!(of("constant:8", "haze", midpoint, Last::Full, Alpha::Exponential), Some(1.0));
    // Nothing on the faces.
    assert_eq!(of("shells:24", "ramp", left, Last::Full, Alpha::Exponential), Some(2.0));
    assert_eq!(of("shells:24", "surface", left, Last::Full, Alpha::Exponential), None, "a jump");
    assert_eq!(of("shells:24", "ramp", left, Last::Full, Alpha::Paper), None);
}

#[test]
fn explanations_are_those_that_apply() {
    let of = |volume: &str, tf: &str, method, opaque, change: fn(&mut Settings)| {
        remarks(&scene(volume, tf, change), method, opaque).join("\n")
    };
    let exact: fn(&mut Settings) = |s| s.sampling.filter = Filter::Exact;
    assert_eq!(of("constant:8", "haze", method::RC.name(), true, exact), "");
    assert!(of("shells:24", "ramp", method::RC.name(), false, exact).contains("trapezoid"));
    assert!(of("shells:24", "surface", method::RC.name(), false, exact).contains("jumps"));
    assert!(of("constant:8", "haze", method::NN_OMNI.name(), true, exact).contains("rays end at an opacity of 0.95"));
    assert_eq!(of("constant:8", "haze", method::NN_OMNI.name(), false, exact), "", "no ray gets that far");
    assert!(of("constant:8", "haze", method::RC.name(), true, |_| ()).contains("texture unit"));
    let midpoint: fn(&mut Settings) = |s| {
        (s.sampling.filter, s.sampling.offset) = (Filter::Exact, Offset::Midpoint);
        (s.image.accumulate, s.sampling.alpha) = (Accumulate::Rgba8, Alpha::Paper);
    };
    let words = of("constant:8", "haze", method::RC.name(), true, midpoint);
    for part in ["order 1 instead of 2", "fewer bits than f32", "has no limit"] {
        assert!(words.contains(part), "{part}: {words}");
    }
}

fn point(step: f64, error: f64, ms: f64) -> Point {
    Point {
        step,
        samples_per_pass: 8,
        shells: None,
        table: None,
        tolerance: None,
        max: Some(10.0 * error),
        rmse: Some(error),
        psnr: Some(-20.0 * error.log10()),
        ssim: Some(0.99),
        ms: Some([ms, 0.9 * ms, 1.2 * ms, 0.1 * ms]),
        timed: 3,
        samples: 1_000,
        pareto: false,
        surface: None,
    }
}

/// Two methods with some pictures each.
pub fn found() -> Accuracy {
    let curve = |method: &str, variation: &str, points: Vec<Point>| Curve {
        method: method.to_owned(),
        variation: variation.to_owned(),
        settings: Settings::default(),
        order: fit(&points.iter().map(|p| (p.step, p.rmse.unwrap())).collect::<Vec<_>>()),
        points,
        expected: Some(1.0),
        remarks: vec!["a remark <here>".to_owned()],
        surface: None,
    };
    let mut curves = vec![
        curve("rc", "", vec![point(1.0, 1e-3, 10.0), point(0.5, 5e-4, 20.0), point(0.25, 2.5e-4, 40.0)]),
        curve("nn-omni", "midpoint", vec![point(1.0, 2e-4, 15.0), point(0.5, 5e-5, 30.0), point(0.25, 1e-5, 60.0)]),
    ];
    mark_pareto(&mut curves);
    Accuracy {
        provenance: Provenance {
            version: FORMAT,
            program: "depthleap".into(),
            commit: "abc".into(),
            command: "depthleap accuracy".into(),
            date: "2026-01-02T03:04:05Z".into(),
        },
        scene: "gaussian".into(),
        view: "front".into(),
        device: "llvmpipe".into(),
        driver: "Mesa".into(),
        clock: Some(Clock::Cpu),
        curves,
        remarks: vec!["of all".into()],
        settings: Settings::default(),
        picture: None,
    }
}

#[test]
fn front_and_answers_are_what_nothing_beats() {
    let found = found();
    let front: Vec<Vec<bool>> = found.curves.iter().map(|c| c.points.iter().map(|p| p.pareto).collect()).collect();
    assert_eq!(front, [vec![true, false, false], vec![true, true, true]]);
    let (curve, at) = fastest(&found.curves, 1.0 / 255.0).unwrap();
    assert_eq!((curve.name().as_str(), at.step), ("nn-omni, midpoint", 1.0));
    let answers = answers(&found.curves);
    assert!(
        answers[0].contains("1/255, nn-omni, midpoint at a step of 1 voxel is the fastest: 15.00 ms"),
        "{answers:?}"
    );
    assert!(answers[1].contains("1/1000, nn-omni, midpoint at a step of 0.5 voxels"), "{answers:?}");
    assert!(fastest(&found.curves, 1e-9).is_none());
    let mut untimed = found;
    untimed.curves.iter_mut().flat_map(|c| &mut c.points).for_each(|p| p.ms = None);
    assert!(depthleap::experiment::accuracy::answers(&untimed.curves)[0].contains("No run comes within"));
}

#[test]
fn files_say_what_was_found() {
    let found = found();
    let json = serde_json::to_string(&found).unwrap();
    assert_eq!(serde_json::from_str::<Accuracy>(&json).unwrap(), found);
    let (table, html) = (text(&found), page(&found, &|_| Err(String::new())).unwrap());
    for part in ["order 1.00 over steps 1 to 0.25 (theory: 1)", "15.00 ± 1.50 *", "of all", "a remark <here>"] {
        assert!(table.contains(part), "{part} is not in\n{table}");
    }
    assert!(html.contains("a remark &lt;here&gt;") && html.matches("<svg").count() == 2);
    let rows = csv(&found).unwrap();
    assert_eq!(rows.lines().count(), 7);
    assert!(rows.lines().nth(4).unwrap().starts_with("nn-omni,midpoint,1,8,0.002,0.0002"), "{rows}");
    let (time, step) = (time_svgs(&found).unwrap().concat(), step_svgs(&found).unwrap().concat());
    assert!(time.contains("time of a frame / ms") && time.contains("nn-omni, midpoint"));
    assert!(step.contains("step / voxels") && step.contains("order 2"));
    let mut empty = found;
    empty.curves.clear();
    assert_eq!((time_svgs(&empty).unwrap(), step_svgs(&empty).unwrap()), (vec![], vec![]));
}

#[test]
fn shells_are_told_by_their_number() {
    let mut found = found();
    for (point, count) in found.curves[1].points.iter_mut().zip([4, 8, 16]) {
        (point.step, point.shells, point.samples_per_pass) = (1.0 / f64::from(count), Some(count), 0);
    }
    let fitted: Vec<(f64, f64)> = found.curves[1].points.iter().map(|p| (p.step, p.rmse.unwrap())).collect();
    found.curves[1].order = fit(&fitted);
    let json = serde_json::to_string(&found).unwrap();
    assert_eq!(serde_json::from_str::<Accuracy>(&json).unwrap(), found);
    assert_eq!(json.matches("\"shells\":").count(), 3 + 2 + 1, "points of samples have none; settings are three");
    let slow = &mut found.curves[1].points[0];
    (slow.rmse, slow.ms) = (Some(4e-4), Some([50.0, 49.0, 52.0, 0.5]));
    let (table, beside) =
        (text(&found), "with 8 (30.0 ms, no rays come as near), 16 (60.0 ms, no rays come as near) of them");
    for part in [
        "in 1 / n over 4 to 16 shells (theory: 1)",
        "fragments",
        "midpoint with 8 of them is the fastest",
        beside,
        "not with 4 (50.0 ms, rays 40.0 ms)",
    ] {
        assert!(table.contains(part), "{part} is not in\n{table}");
    }
    let rows = csv(&found).unwrap();
    let last = |row: usize| rows.lines().nth(row).unwrap().rsplit(',').next().unwrap().to_owned();
    assert_eq!([0, 1, 4, 6].map(last), ["shells", "", "4", "16"], "{rows}");
    let plots = step_svgs(&found).unwrap();
    assert!(plots.len() == 2 && plots[0].contains("step / voxels") && plots[1].contains("1 / number of shells"));
}

/// A curve of a method in a way of sampling.
fn sampled(method: &str, variation: &str, change: fn(&mut Settings)) -> Curve {
    let mut curve = found().curves[0].clone();
    (curve.method, curve.variation) = (method.to_owned(), variation.to_owned());
    change(&mut curve.settings);
    curve
}

/// No question has two curves of one label, or more than there are colours; every curve stands somewhere.
fn check(questions: &[Question], curves: &[Curve]) {
    let mut shown = vec![false; curves.len()];
    for question in questions {
        let mut labels: Vec<&String> = question.curves.iter().map(|(_, label)| label).collect();
        assert!((1..=DISTINCT).contains(&labels.len()), "{question:?}");
        labels.sort();
        labels.dedup();
        assert_eq!(labels.len(), question.curves.len(), "{question:?}");
        question.curves.iter().for_each(|(i, _)| shown[*i] = true);
    }
    assert!(shown.iter().all(|shown| *shown), "{shown:?} of {questions:?}");
}

#[test]
fn curves_are_held_against_each_other_a_question_at_a_time() {
    let mut curves: Vec<Curve> = ["rc", "rc-ert", "nn-omni"].map(|method| sampled(method, "", |_| {})).to_vec();
    curves.extend(["rc", "rc-ert"].map(|method| sampled(method, "midpoint", |s| s.sampling.offset = Offset::Midpoint)));
    curves.push(sampled("rc", "rgba8", |s| s.image.accumulate = Accumulate::Rgba8));
    let titles = |curves: &[Curve]| questions(curves).into_iter().map(|question| question.title).collect::<Vec<_>>();
    check(&questions(&curves), &curves);
    assert_eq!(
        titles(&curves),
        ["Methods", "Methods, midpoint", "Ways of sampling, rc", "Formats of voxels and colours, rc"]
    );
    // A way that another method alone was run in is asked of that method.
    curves.push(sampled("nn-omni", "exact filter", |s| s.sampling.filter = Filter::Exact));
    check(&questions(&curves), &curves);
    assert!(titles(&curves).contains(&"Ways of sampling, nn-omni".to_owned()));
    // One alone, and very many.
    check(&questions(&curves[..1]), &curves[..1]);
    let many: Vec<Curve> = (0..50).map(|i| sampled("rc", &format!("way {i}"), |_| {})).collect();
    check(&questions(&many), &many);
    assert_eq!(questions(&[]), []);
}

#[test]
fn curves_with_the_same_errors_are_one() {
    let mut found = found();
    found.curves = ["rc", "rc-ert", "nn-omni"].map(|method| sampled(method, "", |_| {})).to_vec();
    found.curves[0].points[0].rmse = Some(0.5);
    let svg = step_svgs(&found).unwrap().concat();
    assert!(svg.contains("rc-ert = nn-omni") && !svg.contains("rc = "), "{svg}");
}

#[test]
fn similarity_is_one_of_equal_pictures_only() {
    let a = picture([24, 16]);
    assert!((similarity(&a, &a, [0.0; 3]).unwrap().unwrap() - 1.0).abs() < 1e-6);
    let mut b = a.clone();
    b.pixels.iter_mut().step_by(3).for_each(|p| p[0] = 0.9);
    assert!(similarity(&a, &b, [0.0; 3]).unwrap().unwrap() < 0.95);
    assert_eq!(similarity(&picture([4, 4]), &picture([4, 4]), [0.0; 3]).unwrap(), None);
    assert!(similarity(&a, &picture([16, 24]), [0.0; 3]).is_err());
}
