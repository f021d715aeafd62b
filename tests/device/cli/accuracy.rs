//! `depthleap accuracy`: orders against theory, its files, and what it refuses.

use std::sync::Arc;

use depthleap::experiment::accuracy::{Accuracy, Curve};
use depthleap::vulkan::Device;

use super::program::Place;
use crate::harness::{Test, test};

/// How far a measured order may be from theory's.
const ORDER: f64 = 0.15;

/// How far an order of places may be from theory's, which holds for steps of much less than a voxel.
const SURFACE_ORDER: f64 = 0.35;

pub fn tests() -> Vec<Test> {
    vec![
        test("accuracy finds the orders of theory", orders),
        test("accuracy measures places, normals and colours of surfaces", surfaces),
        test("accuracy finds the order of shells in their number", shells),
        test("accuracy leaves out what cannot be drawn of a surface", nearest),
        test("accuracy measures what is asked for", asked_for),
        test("accuracy refuses what it cannot measure", refused),
    ]
}

fn read(place: &Place) -> Accuracy {
    serde_json::from_slice(&place.read("out/accuracy.json")).unwrap()
}

fn curve<'a>(found: &'a Accuracy, name: &str) -> &'a Curve {
    let names: Vec<String> = found.curves.iter().map(Curve::name).collect();
    found.curves.iter().find(|curve| curve.name() == name).unwrap_or_else(|| panic!("no {name} in {names:?}"))
}

fn orders(_: &Arc<Device>) {
    let place = Place::new();
    let options = "--tf linear --viewport 40x40 --steps 2,1,0.5,0.25,0.125 --repeats 0";
    place.done(&format!("accuracy builtin:gaussian:64 {options} --method rc,nn-omni --validate -o out"));
    let found = read(&place);
    for (name, theory) in [
        ("rc, partial, exact filter", 1.0),
        ("rc, midpoint, partial, exact filter", 2.0),
        ("rc, pre-integrated, partial, exact filter", 2.0),
    ] {
        let curve = curve(&found, name);
        let order = curve.order.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", curve.points)).order;
        println!("{name}: {order:.3}");
        assert_eq!(curve.expected, Some(theory), "{name}");
        assert!((order - theory).abs() < ORDER, "{name} has the order {order}");
    }
    // Rays that end early stop falling where what lies behind begins to show.
    let ended = curve(&found, "nn-omni, midpoint, partial");
    assert!(ended.remarks.iter().any(|r| r.contains("0.999")), "{:?}", ended.remarks);
    let last = ended.points.last().unwrap();
    assert!(last.max.is_some_and(|max| max <= 1e-3 + 1e-5), "{last:?}");
}

fn asked_for(_: &Arc<Device>) {
    let place = Place::new();
    let options = "--viewport 24x20 --steps 2,1,0.5 --method rc-block --repeats 2";
    let said = place.done(&format!("accuracy builtin:shells:24 {options} -o out")).text();
    assert!(said.contains("For an error of at most 1/255") || said.contains("No run comes within"), "{said}");
    let found = read(&place);
    for curve in &found.curves {
        assert_eq!(curve.method, "rc-block");
        let steps: Vec<f64> = curve.points.iter().map(|p| p.step).collect();
        assert_eq!(steps, [2.0, 1.0, 0.5]);
        for point in &curve.points {
            assert!(point.time().is_some_and(|ms| ms > 0.0) && point.timed == 2 && point.samples > 0, "{point:?}");
        }
        assert!(curve.points[0].samples < curve.points[2].samples);
    }
    assert!(found.curves.iter().flat_map(|c| &c.points).any(|p| p.pareto));
    for (file, part) in [
        ("accuracy.csv", "rc-block"),
        ("accuracy.html", "<svg"),
        ("error-time.svg", "</svg>"),
        ("error-step.svg", "</svg>"),
    ] {
        let text = String::from_utf8(place.read(&format!("out/{file}"))).unwrap();
        assert!(text.contains(part), "{file}");
    }
}

fn surfaces(_: &Arc<Device>) {
    let place = Place::new();
    let view = "--viewport 40x40 --azimuth 30 --elevation 20 --fov 15";
    let options = "--iso 0.4 --filter exact --steps 2,1,0.5 --repeats 0 --method rc-ert";
    place.done(&format!("accuracy builtin:gaussian:48 {view} {options} --validate -o out"));
    let found = read(&place);
    for (name, theory) in [("rc-ert, not refined", Some(1.0)), ("rc-ert", Some(2.0)), ("rc-ert, refined exact", None)] {
        let curve = curve(&found, name);
        let orders = curve.surface.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", curve.points));
        println!("{name}: {orders:?} of {:?}", curve.points);
        assert_eq!(orders.expected_position, theory, "{name}");
        if let Some(theory) = theory {
            let order = orders.position.unwrap_or_else(|| panic!("{name}: {:?}", curve.points)).order;
            assert!((order - theory).abs() < SURFACE_ORDER, "{name} has the order {order}");
        }
        for point in &curve.points {
            let error = point.surface.unwrap();
            assert!(error.pixels > 100 && 20 * error.missed < error.pixels, "{name}: {error:?}");
            assert!(theory.is_some() || error.position.unwrap() < 2e-5, "{name}: {error:?}");
        }
    }
    // Every kind of texture, at the same places.
    let normals = |name: &str| curve(&found, name).points.last().unwrap().surface.unwrap().normal.unwrap();
    for operator in ["central", "sobel"] {
        let [coarse, half, single] = ["rgba8", "rgba16f", "rgba32f"]
            .map(|texture| normals(&format!("rc-ert, refined exact, {operator} {texture}")));
        // Each of them is read, and few bits are off by more.
        assert!(coarse != half && half != single, "{operator}: {coarse} {half} {single}");
        assert!((half - single).abs() < (coarse - single).abs(), "{operator}: {coarse} {half} {single}");
        assert!((coarse - single).abs() < 0.1 * single, "{operator}: {coarse} {half} {single}");
    }
}

fn shells(_: &Arc<Device>) {
    for mode in ["max", "sum"] {
        let place = Place::new();
        let options = "--viewport 40x32 --steps 1 --shell-counts 16,4,8,4 --repeats 1 --range 0,1";
        let of = format!("accuracy builtin:gaussian:40 --shells {mode} --method shells,rc --last partial {options}");
        let said = place.done(&format!("{of} --validate -o out")).text();
        let found = read(&place);
        let curve = curve(&found, "shells");
        let counts: Vec<Option<u32>> = curve.points.iter().map(|point| point.shells).collect();
        assert_eq!(counts, [4, 8, 16].map(Some), "each once");
        let order = curve.order.as_ref().unwrap_or_else(|| panic!("{mode}: {:?}", curve.points)).order;
        println!("{mode}: {order:.3}");
        assert_eq!(curve.expected, Some(1.0));
        assert!((order - 1.0).abs() < 0.4, "{mode} has the order {order}");
        assert!(curve.points.iter().all(|point| point.samples > 0 && point.time().is_some()), "{:?}", curve.points);
        assert!(found.curves.iter().any(|curve| curve.method == "rc" && !curve.is_of_shells()));
        assert!(said.contains("in 1 / n over 4 to 16 shells (theory: 1)"), "{said}");
    }
}

fn nearest(_: &Arc<Device>) {
    let place = Place::new();
    let options =
        "--iso 0.4 --filter nearest --refine none --viewport 24x20 --fov 20 --steps 1,0.5 --repeats 0 --method rc";
    place.done(&format!("accuracy builtin:gaussian:24 {options} -o out"));
    let found = read(&place);
    assert!(found.curves.len() > 3, "{}", found.curves.len());
    assert!(found.remarks.iter().any(|remark| remark.contains("Left out") && remark.contains("refined linear")));
    let numbers = found.curves.iter().flat_map(|curve| &curve.points).filter_map(|point| point.surface?.position);
    assert!(numbers.clone().count() > 3 && numbers.clone().all(f64::is_finite), "{:?}", numbers.collect::<Vec<_>>());
}

fn refused(_: &Arc<Device>) {
    let place = Place::new();
    place.refused("accuracy builtin:gaussian:16 --iso 2 -o out", 2, &["surface (--iso)", "met by no ray"]);
    place.refused("accuracy builtin:gaussian:16 --iso 0.4 --filter nearest -o out", 2, &["--refine none"]);
    place.refused("accuracy builtin:gaussian:16 --iso 0.4 --surface-shows normal -o out", 2, &["--surface-shows"]);
    place.refused("accuracy builtin:shells:16 --method cpu -o out", 2, &["--method cpu", "no frame time"]);
    place.refused("accuracy builtin:shells:16 --steps 1,0 -o out", 2, &["--step"]);
    place.refused("accuracy builtin:shells:16 --steps 1,nan -o out", 2, &["--step"]);
    let shells = "accuracy builtin:gaussian:16 --method shells";
    for (options, said) in [
        ("--shells surface", "nothing to do with their number"),
        ("--shells max --shell-levels 0.5", "--shell-counts"),
        ("--shells sum --shell-sum crossings", "goes to no integral"),
        ("--shells max --shell-a 0.5", "depth cue"),
        ("--shells max --shell-counts 4,0", "shells.count"),
        ("--shells max --shell-counts 1000", "shells.count"),
        ("", "--shells max"),
    ] {
        place.refused(&format!("{shells} {options} -o out"), 2, &[said]);
    }
    place.refused("accuracy missing.nrrd -o out", 3, &["missing.nrrd"]);
}
