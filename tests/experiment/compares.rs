//! Two results side by side: what differs is found, and nothing else.

use depthleap::experiment::compare::{compare, text};
use depthleap::measure::Results;
use depthleap::measure::Timing;
use depthleap::measure::record::OrbitFrame;

use crate::runs::results;

fn changed(change: impl FnOnce(&mut Results)) -> Results {
    let mut results = results();
    change(&mut results);
    results
}

#[test]
fn results_are_the_same_as_themselves() {
    let found = compare(&results(), &results());
    assert!(found.same_counts() && found.runs.len() == results().runs.len());
    assert!(found.runs.iter().all(|run| run.settings.is_empty() && run.counts.is_empty()));
    assert!(found.runs.iter().flat_map(|run| &run.times).all(|time| !time.apart && time.a == time.b));
    assert!(text(&found).ends_with("All counts are the same.\n"));
}

#[test]
fn one_fragment_more_in_one_pass_is_found() {
    let last = results().runs[1].fragments.main_per_pass.len() - 1;
    let other = changed(|results| results.runs[1].fragments.main_per_pass[last] += 1);
    let found = compare(&results(), &other);
    assert!(!found.same_counts());
    let differing: Vec<usize> = (0..found.runs.len()).filter(|i| !found.runs[*i].counts.is_empty()).collect();
    assert_eq!(differing, [1]);
    let text = text(&found);
    assert!(text.contains(&format!("the first difference at {last}")) && text.ends_with("Counts differ.\n"), "{text}");
}

#[test]
fn one_fragment_more_in_one_frame_of_an_orbit_is_found() {
    let with = |main: u64| {
        let frame = |main| OrbitFrame {
            frame: 0,
            turned: 0.0,
            structure: None,
            age: None,
            main,
            intermediate: 7,
            frame_ms: 1.0,
            cpu_ms: 1.0,
            build_ms: 0.0,
            stack: None,
            change: None,
        };
        changed(|results| results.runs[1].orbit = Some(vec![frame(5), frame(main)]))
    };
    assert!(compare(&with(9), &with(9)).same_counts());
    let found = compare(&with(9), &with(10));
    assert_eq!(found.runs[1].counts[0].what, "main fragments of the orbit, frame by frame");
    assert!(text(&found).contains("14 -> 15 in all, the first difference at 1"), "{}", text(&found));
}

#[test]
fn a_run_that_one_lacks_is_named() {
    let fewer = changed(|results| drop(results.runs.remove(0)));
    let found = compare(&results(), &fewer);
    assert!(!found.same_counts() && found.only_in_a.len() == 1 && found.only_in_b.is_empty());
    assert!(found.only_in_a[0].contains(&results().runs[0].method), "{:?}", found.only_in_a);
    assert_eq!(compare(&fewer, &results()).only_in_b, found.only_in_a);
    assert!(text(&found).ends_with("one lacks runs of the other.\n"), "{}", text(&found));
}

#[test]
fn settings_that_differ_are_named_and_folders_are_not() {
    let with_path = |path: &str, step: f64| {
        changed(|results| {
            results.runs[0].settings.volume.path = Some(path.into());
            results.runs[0].settings.sampling.step = step;
        })
    };
    let named = |a: &Results, b: &Results| {
        compare(a, b).runs[0].settings.iter().map(|difference| difference.what.clone()).collect::<Vec<_>>()
    };
    assert_eq!(named(&with_path("here/a.nrrd", 1.0), &with_path("there/a.nrrd", 1.0)), [""; 0]);
    assert_eq!(named(&with_path("a.nrrd", 1.0), &with_path("b.nrrd", 0.5)), ["sampling.step", "volume.path"]);
}

#[test]
fn times_differ_where_their_samples_lie_apart() {
    let timed = |samples: [f64; 3]| changed(|results| results.runs[0].host.cpu = Timing::of(&samples));
    let apart = |a: [f64; 3], b: [f64; 3]| {
        let found = compare(&timed(a), &timed(b));
        found.runs[0].times.iter().find(|time| time.what == "cpu_ms").unwrap().apart
    };
    assert!(!apart([1.0, 2.0, 3.0], [2.9, 4.0, 5.0]));
    assert!(apart([1.0, 2.0, 3.0], [3.1, 4.0, 5.0]));
    assert!(apart([3.1, 4.0, 5.0], [1.0, 2.0, 3.0]));
}
