//! A folder of results: pictures beside the JSON, and pages that are made of both.

use depthleap::experiment::bench::keep;
use depthleap::experiment::folder::{file_name, keep_picture};
use depthleap::experiment::render::render;
use depthleap::measure::write::write_json;
use depthleap::measure::{Measured, Picture};

use crate::runs::{picture, results, run};

fn measured(method: &str, picture: Picture) -> Measured {
    let run = run(method, &[10], &[5]);
    let reference = Some(picture.clone());
    Measured {
        method: depthleap::method::METHODS.into_iter().find(|row| row.name == method).unwrap(),
        run,
        picture,
        reference,
        trusted: true,
        differing: None,
        differing_frames: None,
    }
}

#[test]
fn names_are_those_that_every_system_takes() {
    assert_eq!(
        file_name(&["bench", "003", "fuel, ramp", "nn-omni+fused", "bounds + copy"]),
        "bench-003-fuel-ramp-nn-omni-fused-bounds-copy"
    );
    assert_eq!(file_name(&["../..", "A\u{e9}\n:B"]), "a-b");
    let long = file_name(&[&"x-".repeat(400)]);
    assert!(long.len() <= 80 && !long.ends_with('-'), "{long}");
}

#[test]
fn pictures_are_kept_by_run_and_shown_again() {
    let folder = tempfile::tempdir().unwrap();
    let kept =
        keep(folder.path(), vec![measured("rc", picture([8, 6])), measured("nn-omni", picture([8, 6]))]).unwrap();
    let names: Vec<&str> = kept.pictures.iter().map(|record| record.file.as_str()).collect();
    assert_eq!(names, ["pictures/bench-000-fuel-rc-ztest.png", "pictures/bench-001-fuel-nn-omni-bounds-copy.png"]);
    assert_eq!(image::image_dimensions(folder.path().join(names[1])).unwrap(), (8, 6));
    let written = render(folder.path()).unwrap();
    assert!(written.missing.is_empty() && written.reports == [folder.path().join("report.html")]);
    let page = std::fs::read_to_string(&written.reports[0]).unwrap();
    assert_eq!(page.matches("<img").count(), 4, "two pictures and their differences");
}

#[test]
fn picture_that_cannot_be_encoded_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let broken = Picture { size: [3, 3], pixels: Vec::new() };
    let error = keep_picture(folder.path(), &["bench", "nn-omni"], &broken, [0.0; 3]).unwrap_err().to_string();
    assert!(error.contains("picture pictures/bench-nn-omni.png"), "{error}");
}

#[test]
fn names_that_lead_elsewhere_and_files_that_are_no_pictures_are_missing() {
    let outside = tempfile::tempdir().unwrap();
    let secret = keep_picture(outside.path(), &["secret"], &picture([2, 2]), [0.0; 3]).unwrap();
    let folder = outside.path().join("results");
    let mut kept = keep(&folder, (0..4).map(|_| measured("rc", picture([8, 6]))).collect()).unwrap();
    kept.pictures.iter_mut().for_each(|record| record.difference = None);
    kept.pictures[0].file = format!("../{secret}");
    kept.pictures[1].file = outside.path().join(&secret).display().to_string();
    kept.pictures[2].file = "results.json".to_owned();
    kept.pictures[3].file = "pictures".to_owned();
    write_json(&folder.join("results.json"), &kept).unwrap();
    let missing = render(&folder).unwrap().missing;
    assert_eq!(missing.len(), 4, "{missing:?}");
    for (line, why) in missing.iter().zip(["leads out", "leads out", "not a PNG", "not the file of a picture"]) {
        assert!(line.contains(why), "{line}");
    }
}

#[test]
fn results_that_name_no_pictures_have_a_report() {
    let folder = tempfile::tempdir().unwrap();
    let mut value = serde_json::to_value(results()).unwrap();
    value.as_object_mut().unwrap().remove("pictures");
    write_json(&folder.path().join("results.json"), &value).unwrap();
    assert!(render(folder.path()).unwrap().missing.is_empty());
}
