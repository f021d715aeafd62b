//! What work costs on a device, from frames whose times are made up of known costs.

use depthleap::auto::{DeviceCosts, DeviceFacts, Factors, KINDS, TimedFrame, Way, choose};
use depthleap::method;
use depthleap::part::rows::Method;
use depthleap::scene::settings::Tiles;

fn frame(method: &Method, parts: [f64; KINDS], factors: [f64; KINDS]) -> TimedFrame {
    let ms = parts.iter().zip(factors).map(|(part, factor)| part * factor).sum();
    TimedFrame { method: method.name.to_owned(), parts, ms }
}

/// Frames that differ in each kind of work.
const PARTS: [[f64; KINDS]; 5] =
    [[4.0, 1.0, 0.1, 0.0], [4.0, 20.0, 1.0, 0.5], [5.0, 2.0, 60.0, 0.0], [5.0, 2.0, 4.0, 30.0], [40.0, 3.0, 2.0, 1.0]];

fn near(found: Factors, expected: [f64; KINDS], within: f64) -> bool {
    found.in_order().iter().zip(expected).all(|(found, expected)| (found / expected).ln().abs() < within)
}

fn fit(frames: &[TimedFrame]) -> DeviceCosts {
    DeviceCosts::fit("2026-01-01T00:00:00Z".to_owned(), frames, None)
}

#[test]
fn factors_are_found_from_frames_that_tell_them_apart() {
    for factors in [[1.0; KINDS], [0.5, 0.8, 1.5, 2.0], [0.3; KINDS], [0.02, 0.01, 0.01, 0.015]] {
        let costs = fit(&PARTS.map(|parts| frame(&method::SINGLE_PASS, parts, factors)));
        assert!(near(costs.loops, factors, 0.1), "{factors:?}: {costs:?}");
        assert_eq!((costs.passes, costs.slices), (costs.loops, costs.loops), "nothing else was timed");
    }
}

#[test]
fn each_way_of_working_has_its_own() {
    let (slow, fast) = ([3.0; KINDS], [0.25; KINDS]);
    let of = |method: &'static Method, factors| PARTS.map(|parts| frame(method, parts, factors)).to_vec();
    let frames = [of(&method::SINGLE_PASS, fast), of(&method::NN_OMNI, slow)].concat();
    let costs = fit(&frames);
    assert!(near(costs.of(Way::Loops), fast, 0.05) && near(costs.of(Way::Passes), slow, 0.05), "{costs:?}");
    assert_eq!((costs.fused, costs.slices), (costs.loops, costs.loops));
}

#[test]
fn a_kind_that_no_frame_has_costs_as_many_times_as_all_work() {
    let parts = PARTS.map(|[passes, fragments, samples, _]| [passes, fragments, samples, 0.0]);
    let costs = fit(&parts.map(|parts| frame(&method::RC, parts, [0.1; KINDS])));
    assert!(near(costs.passes, [0.1; KINDS], 1e-6), "{costs:?}");
}

#[test]
fn frames_that_say_nothing_change_nothing() {
    let nothing = TimedFrame { ms: 0.0, ..frame(&method::RC, PARTS[0], [1.0; KINDS]) };
    for frames in [vec![], vec![nothing]] {
        assert_eq!(fit(&frames), DeviceCosts::default(), "nothing was measured");
    }
}

#[test]
fn no_factor_is_below_none() {
    // Times that fall with a kind of work are those of a machine that does other things besides.
    let frames = PARTS.map(|parts| frame(&method::RC, parts, [1.0, 1.0, -0.01, 1.0]));
    assert!(fit(&frames).passes.in_order().iter().all(|factor| *factor > 0.0));
}

#[test]
fn what_work_costs_decides_what_is_chosen() {
    let scene = super::scene("jets:48", "ramp", |s| s.method.tiles = Tiles::All);
    let all = |factor: f64| Factors { passes: factor, fragments: factor, samples: factor, lookups: factor };
    let chosen = |costs: DeviceCosts| choose(&scene, &DeviceFacts { costs, ..DeviceFacts::default() }).unwrap();
    let dear =
        DeviceCosts { loops: all(1e3), slices: all(1e3), measured: Some("today".to_owned()), ..DeviceCosts::default() };
    let record = chosen(dear);
    assert!(!record.chosen.method.starts_with("single-pass"), "{}", record.chosen.method);
    assert!(record.reasons.iter().any(|reason| reason.contains("measured on today")), "{:?}", record.reasons);
    let plain = chosen(DeviceCosts::default());
    let twice = chosen(DeviceCosts {
        loops: all(2.0),
        passes: all(2.0),
        fused: all(2.0),
        slices: all(2.0),
        builds: 2.0,
        measured: None,
    });
    assert_eq!(twice.chosen.method, plain.chosen.method);
    assert!((twice.chosen.ms - 2.0 * plain.chosen.ms).abs() < 1e-9 * plain.chosen.ms);
}
