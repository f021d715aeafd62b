//! What work costs on a device is measured once, kept, and asked for by `auto`.

use std::path::PathBuf;
use std::sync::Arc;

use depthleap::vulkan::Device;
use serde_json::Value;

use super::SMALL;
use super::program::{Ended, Place};
use crate::harness::{Test, test};

pub fn tests() -> Vec<Test> {
    vec![test("what work costs is measured once and kept", measured_once)]
}

/// Runs the program with a cache of its own.
fn run(place: &Place, arguments: &str) -> Ended {
    let ended = Ended::of(place.command(arguments).env("XDG_CACHE_HOME", place.path()).output().unwrap());
    assert_eq!(ended.code, Some(0), "{arguments}: {}", ended.err);
    ended
}

/// The files that are kept of what work costs.
fn kept(place: &Place) -> Vec<PathBuf> {
    let folder = place.path().join("depthleap/costs");
    std::fs::read_dir(folder).map_or(vec![], |files| files.map(|file| file.unwrap().path()).collect())
}

fn measured_once(_: &Arc<Device>) {
    let place = Place::new();
    let render = |more: &str| run(&place, &format!("render {SMALL} --repeats 0 -o a.png {more}")).err;
    let fitted = render("--costs fitted");
    assert!(fitted.contains("taken from lavapipe") && kept(&place).is_empty(), "{fitted}");
    render("--method nn-omni --samples-per-pass 8 --lookups 1");
    assert!(kept(&place).is_empty(), "nothing is chosen, and nothing measured");

    let first = render("");
    let [file] = &kept(&place)[..] else { panic!("{first}") };
    let read = || serde_json::from_slice::<Value>(&std::fs::read(file).unwrap()).unwrap();
    let record = read();
    let date = record["costs"]["measured"].as_str().unwrap();
    assert!(first.contains(&format!("measured on {date}")), "{first}");
    assert!(record["frames"].as_array().unwrap().len() > 10, "{record}");
    for way in ["loops", "passes", "fused", "slices"] {
        for kind in ["passes", "fragments", "samples", "lookups"] {
            assert!(record["costs"][way][kind].as_f64().unwrap() > 0.0, "{way}, {kind}: {record}");
        }
    }
    // A choice of another scene, and of numbers alone, asks for the same.
    assert!(render("--step 0.5 --method nn-omni").contains(&format!("measured on {date}")));
    assert_eq!(read(), record);
    let info = run(&place, "info").text();
    assert!(info.contains(date) && info.contains("look-ups"), "{info}");

    std::fs::write(file, b"{\"version\": 1, \"costs\"").unwrap();
    assert!(render("").contains("was measured on"), "a file that is broken is made anew");
    assert!(read()["frames"].is_array());
    std::fs::write(file, b"").unwrap();
    assert!(render("--costs again").contains("was measured on") && read()["frames"].is_array());
}
