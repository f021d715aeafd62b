//! Extreme but legal scenes: every method gives a finite picture, those on the device the same to the bit, and the
//! device that of the f64 reference.

use super::METHODS;
use super::program::Place;
use crate::harness::{Test, test};

/// Largest difference of a channel from f64: some hundred samples rounded to f32. Pixels that f32 cannot decide (a
/// sample at the very end of a ray, an edge of the box) may differ by more, and the run says how many they are.
const ROUNDING: f64 = 1e-5;

const VIEW: &str = "--azimuth 31 --elevation 17";
const SHELLS: &str = "builtin:shells:24";

pub fn tests() -> Vec<Test> {
    let raw = |x: usize, y: usize, z: usize| format!("{x}x{y}x{z}.raw --dims {x},{y},{z} --type u8");
    let (one, cube) = (raw(1, 1, 1), raw(6, 6, 6));
    let scenes = [
        ("1x1x1 voxels", format!("{one} {VIEW}")),
        ("Nx1x1 voxels", format!("{} --eye 0.03,0.02,0.05", raw(50, 1, 1))),
        ("1xNx1 voxels", format!("{} --eye 0.02,0.03,0.05", raw(1, 50, 1))),
        ("1x1xN voxels", format!("{} --eye 0.05,0.02,0.03 --fov 60", raw(1, 1, 50))),
        ("2048x2x2 voxels", format!("{} --eye 0.002,0.0015,0.003 --fov 80", raw(2048, 2, 2))),
        ("2048x2x2 voxels from an end", format!("{} --eye 0.5003,0.0001,0.0002 --fov 10", raw(2048, 2, 2))),
        ("spacing 1:2000", format!("{cube} --spacing 1,1,2000 --eye 0.002,0.0013,0.0017 --step 8")),
        ("spacing 2000:1", format!("{cube} --spacing 2000,2000,1 {VIEW} --step 8")),
        ("eye inside", format!("{SHELLS} --eye 0.1,0.05,0.02 --target 0.5,0.3,-0.4")),
        ("eye inside with a field of view of 170", format!("{SHELLS} --eye 0.1,0.05,0.02 --fov 170")),
        ("eye on a face", format!("{SHELLS} --eye 0,0,0.5 --target 0.1,0.05,0")),
        ("eye on a corner", format!("{SHELLS} --eye 0.5,0.5,0.5")),
        ("eye on a corner, looking away", format!("{SHELLS} --eye 0.5,0.5,0.5 --target 1,1.2,1.1")),
        ("eye far away", format!("{SHELLS} --eye 3000,2500,3100 --fov 0.02")),
        ("eye too far away to see anything", format!("{SHELLS} --eye 3000,2500,3100")),
        ("looking away", format!("{SHELLS} --eye 0,0.1,2 --target 0,0,5")),
        ("looking away with passes forced", format!("{SHELLS} --eye 0,0.1,2 --target 0,0,5 --passes 5")),
        ("field of view of 1", format!("{SHELLS} {VIEW} --fov 1")),
        ("one pixel", format!("{SHELLS} {VIEW} --viewport 1x1")),
        ("1x64 pixels", format!("{SHELLS} {VIEW} --viewport 1x64")),
        ("64x1 pixels", format!("{SHELLS} {VIEW} --viewport 64x1 --fov 1")),
        ("step 1/64", format!("{SHELLS} {VIEW} --step 0.015625 --samples-per-pass 100")),
        ("step 2000", format!("builtin:linear:24 {VIEW} --step 2000")),
        ("one sample a pass", format!("{SHELLS} {VIEW} --samples-per-pass 1")),
        ("10000 samples a pass", format!("{SHELLS} {VIEW} --samples-per-pass 10000")),
        ("fewer passes than needed", format!("{SHELLS} {VIEW} --passes 3")),
        ("far more passes than needed", format!("{SHELLS} {VIEW} --passes 300")),
        ("termination 0", format!("{SHELLS} {VIEW} --termination 0")),
        ("no opacity", format!("{SHELLS} {VIEW} --tf clear.json")),
        ("all opaque", format!("{SHELLS} {VIEW} --tf opaque.json")),
        ("a range of one value", format!("{SHELLS} {VIEW} --range 7,7")),
        ("midpoints and a partial last sample", format!("{SHELLS} {VIEW} --offset midpoint --last partial")),
    ];
    let scene = |(name, arguments): (&str, String)| test(&format!("extreme: {name}"), move |_| agree(&arguments));
    scenes.into_iter().map(scene).collect()
}

fn agree(arguments: &str) {
    let place = Place::new();
    place.file("clear.json", r#"{"points": [[0, 1, 1, 1, 0], [1, 1, 1, 1, 0]]}"#);
    place.file("opaque.json", r#"{"points": [[0, 1, 0.5, 0.2, 1], [1, 0.2, 1, 1, 1]]}"#);
    raw_file(&place, arguments);
    let mut options = "--filter exact --texture r32f --repeats 1 --warmups 0".to_owned();
    for (option, usual) in [("--viewport", "24x18"), ("--termination", "1")] {
        if !arguments.contains(option) {
            options += &format!(" {option} {usual}");
        }
    }
    // One start of the program for all methods: a start costs some drivers seconds.
    place.done(&format!("bench {arguments} {options} --method {} -o out", METHODS.join(",")));
    let results = place.json("out/results.json");
    let runs = results["runs"].as_array().unwrap();
    assert_eq!(runs.len(), METHODS.len());
    let (last, on_device) = runs.split_last().unwrap();
    assert_eq!(last["method"], "cpu");
    for run in on_device {
        let (method, error) = (&run["method"], &run["error"]);
        if run["passes"] == 0 {
            assert!(error.is_null() && run["fragments"]["main"] == 0, "{method}: {error}");
            continue;
        }
        // A pixel that is not finite is infinitely far, which JSON has as null.
        assert!(error["rmse"].is_number(), "{method} is not finite: {error}");
        assert!(error["max"].as_f64().unwrap() <= ROUNDING, "{method}: {error}");
        // `rc` ends no ray early; where the others end none either, its picture is theirs.
        if method != "rc" || !arguments.contains("--termination") {
            assert_eq!(error, &on_device[3]["error"], "{method} and nn-omni differ");
        }
        if method == "rc-block" || method == "nn-omni" {
            let notes = run["notes"].as_array().unwrap();
            assert!(notes.iter().any(|n| n.as_str().unwrap().contains("bit for bit")), "{method}: {notes:?}");
        }
    }
}

/// The raw file that `arguments` name, if they do. Its values rise and fall slowly: a coordinate in f32 is only good to
/// 1e-4 voxels of 2048.
fn raw_file(place: &Place, arguments: &str) {
    let name = arguments.split(' ').next().unwrap_or_default();
    let Some(sizes) = name.strip_suffix(".raw") else { return };
    let sizes: Vec<usize> = sizes.split('x').map(|n| n.parse().unwrap()).collect();
    let value = |i: usize| {
        let (x, y, z) = (i % sizes[0], i / sizes[0] % sizes[1], i / (sizes[0] * sizes[1]));
        255_usize.abs_diff((2 * x + 19 * y + 23 * z + 55) % 510)
    };
    place.file(name, (0..sizes.iter().product()).map(|i| value(i) as u8).collect::<Vec<_>>());
}
