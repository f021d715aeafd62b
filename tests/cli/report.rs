//! `depthleap report`: the pages of a folder again, and what it refuses.

use crate::driverless;
use crate::program::Place;

/// A folder `out` with a bench of two scenes by the method that needs no device.
fn bench() -> Place {
    let place = driverless();
    place.done("bench builtin:shells:12 builtin:jets:12 --method cpu --viewport 12x8 -o out");
    place
}

const PAGES: [&str; 2] = ["out/report.html", "out/results.csv"];

fn pages(place: &Place) -> Vec<Vec<u8>> {
    PAGES.iter().map(|name| place.read(name)).collect()
}

#[test]
fn pages_come_again_byte_for_byte() {
    let place = bench();
    let before = pages(&place);
    PAGES.iter().for_each(|name| std::fs::remove_file(place.path().join(name)).unwrap());
    // The folder may have moved.
    std::fs::rename(place.path().join("out"), place.path().join("moved")).unwrap();
    let ended = place.done("report moved");
    assert_eq!((ended.text().as_str(), ended.err.as_str()), ("Report: moved/report.html\n", ""));
    std::fs::rename(place.path().join("moved"), place.path().join("out")).unwrap();
    assert!(pages(&place) == before, "the pages differ");
    let report = String::from_utf8(before[0].clone()).unwrap();
    assert_eq!(
        report.matches("<img src=\"data:image/png;base64,").count(),
        4,
        "pictures are in the page, which can be mailed"
    );
}

#[test]
fn pages_of_all_experiments_of_a_folder_come_again() {
    let place = bench();
    place.done("reproduce -o out");
    let names = ["out/report.html", "out/results.csv", "out/reproduce.html", "out/reproduce.csv"];
    let before: Vec<Vec<u8>> = names.iter().map(|name| place.read(name)).collect();
    names.iter().for_each(|name| std::fs::remove_file(place.path().join(name)).unwrap());
    assert_eq!(place.done("report out").text(), "Report: out/report.html\nReport: out/reproduce.html\n");
    assert!(names.iter().map(|name| place.read(name)).eq(before));
}

#[test]
fn missing_pictures_are_named_in_page_and_warning() {
    let place = bench();
    let first = "pictures/bench-000-shells-12-ramp-cpu.png";
    std::fs::remove_file(place.path().join("out").join(first)).unwrap();
    place.file("out/pictures/bench-001-jets-12-ramp-cpu.png", "no picture");
    let ended = place.done("report out");
    assert_eq!(ended.err.lines().count(), 2, "{}", ended.err);
    assert!(ended.err.contains(&format!("warning: picture {first}: there is no such file\n")), "{}", ended.err);
    assert!(ended.err.contains("is not a PNG file"), "{}", ended.err);
    let report = String::from_utf8(place.read("out/report.html")).unwrap();
    assert!(report.contains(&format!("The picture {first} is missing: there is no such file.")));
    assert_eq!(report.matches("<img").count(), 2, "the differences are still there");
}

#[test]
fn folders_without_results_are_refused() {
    let place = driverless();
    place.file("file", "x");
    std::fs::create_dir(place.path().join("empty")).unwrap();
    place.refused("report", 2, &["<DIR>"]);
    place.refused("report nowhere", 3, &["nowhere", "is not there", "give a folder that bench"]);
    place.refused("report file", 3, &["file", "is not a folder"]);
    place.refused("report empty", 3, &["empty", "has no results", "results.json", "stability.json"]);
}

#[test]
fn broken_and_foreign_results_are_refused_and_nothing_is_written() {
    let place = bench();
    let good = place.read("out/results.json");
    std::fs::remove_file(place.path().join("out/report.html")).unwrap();
    for name in ["results", "probe", "reproduce", "accuracy", "stability"] {
        let file = format!("out/{name}.json");
        for (text, problem) in [
            (&good[..good.len() / 2], "is not a result"),
            (&b"{\"version\": 9}"[..], "format version 9"),
            (&b"{\"version\": 1}"[..], "missing field"),
            (&b"[]"[..], "is not a result"),
            (&b"\xff"[..], "UTF-8"),
            (&b""[..], "is not a result"),
        ] {
            place.file(&file, text);
            place.refused("report out", 3, &[&file, problem]);
        }
        match name {
            "results" => drop(place.file(&file, &good)),
            _ => std::fs::remove_file(place.path().join(&file)).unwrap(),
        }
    }
    place.done("report out");
}
