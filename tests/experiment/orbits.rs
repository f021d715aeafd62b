//! An orbit in a few numbers, and where it shows.

use depthleap::experiment::bench::{page, table};
use depthleap::experiment::orbit::Summary;
use depthleap::measure::Results;
use depthleap::measure::record::OrbitFrame;

use crate::runs::results;

fn frame(frame: usize, structure: &str, age: Option<i64>, main: u64) -> OrbitFrame {
    OrbitFrame {
        frame,
        turned: 90.0 * frame as f64,
        structure: Some(structure.to_owned()),
        age,
        main,
        intermediate: 10 * main,
        frame_ms: 2.0 + frame as f64,
        cpu_ms: 4.0,
        build_ms: 0.5,
        stack: None,
        change: None,
    }
}

fn frames() -> Vec<OrbitFrame> {
    vec![
        frame(0, "omni", None, 4000),
        frame(1, "cone", Some(-1), 1000),
        frame(2, "cone", Some(3), 2000),
        frame(3, "omni", None, 3000),
    ]
}

#[test]
fn summary_counts_structures_and_takes_medians() {
    let summary = Summary::of(&frames()).unwrap();
    assert_eq!(summary.structures, [("omni".to_owned(), 2), ("cone".to_owned(), 2)]);
    assert_eq!((summary.frames, summary.ages, summary.main), (4, Some([-1, 3]), 3000));
    assert_eq!(summary.frame.median, 3.5);
    let words = summary.words();
    assert!(words.starts_with("4 frames, 2 by omni, 2 by cone (made -1 to 3 frames before); main 3,000"), "{words}");
    assert_eq!(Summary::of(&[]), None);
}

#[test]
fn orbits_are_in_the_table_the_report_and_the_file() {
    let mut results = results();
    assert!(!table(&results.runs).contains("Orbit"));
    results.runs[1].orbit = Some(frames());
    assert!(table(&results.runs).contains("4 frames, 2 by omni, 2 by cone"));
    let page = page(&results, None, &|file| Err(format!("no {file}"))).unwrap();
    assert!(page.contains("Fragments of each frame of an orbit") && page.contains("frames of the orbit"));
    let text = results.to_json().unwrap();
    assert_eq!(Results::from_json("results.json", &text).unwrap(), results);
    // Files of before orbits were there are read still.
    let older = text.replace("\"orbit\": null,", "");
    assert!(Results::from_json("older.json", &older).unwrap().runs[0].orbit.is_none());
}
