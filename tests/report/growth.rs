//! Time against the segments that show something.

use depthleap::experiment::bench;
use depthleap::measure::record::{Clock, Ideal, Saved};
use depthleap::measure::{Results, Run, Timing};
use depthleap::report::comparison::groups;
use depthleap::report::growth::{Growth, Line};
use depthleap::report::plot::growth_svg;

use crate::runs::{results, run};

/// Runs of a scene with so many segments that show something, by two methods whose CPU time is a line in them, and one whose is not.
fn scene(name: &str, segments: u64) -> Vec<Run> {
    let timed = |method: &str, ms: f64| {
        let mut run = run(method, &[segments], &[0]);
        run.scene = name.to_owned();
        run.settings.volume.builtin = Some(name.to_owned());
        run.ideal = Some(Ideal { main: segments });
        run.host.cpu = Some(Timing::once(ms));
        run.saved =
            Some(Saved { against: "rc-ert".to_owned(), fragments: None, time: Some(0.5), clock: Some(Clock::Cpu) });
        run
    };
    let many = segments as f64;
    vec![timed("nn-omni", 2.0 + 3e-5 * many), timed("rc", 1.0 + 1e-4 * many), timed("rc-block", 1e-10 * many * many)]
}

fn runs() -> Vec<Run> {
    [("jets:64", 10_000), ("jets:256", 640_000), ("jets:128", 80_000), ("jets:512", 5_120_000)]
        .into_iter()
        .flat_map(|(name, segments)| scene(name, segments))
        .collect()
}

#[test]
fn a_line_is_found_where_there_is_one() {
    let runs = runs();
    let growth = Growth::all(&groups(&runs));
    let [growth] = &growth[..] else { panic!("{growth:?}") };
    assert_eq!(growth.clock, Clock::Cpu);
    let names: Vec<&str> = growth.scenes.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["jets:64", "jets:128", "jets:256", "jets:512"]);
    let line = |i: usize| growth.rows[i].line;
    assert!((line(0).base - 2.0).abs() < 1e-9 && (line(0).each - 3e-5).abs() < 1e-14, "{:?}", line(0));
    assert!((line(1).base - 1.0).abs() < 1e-9 && (line(1).each - 1e-4).abs() < 1e-14, "{:?}", line(1));
    assert!((line(0).explained - 1.0).abs() < 1e-12 && line(2).explained < 0.99, "{:?}", line(2));
    let table = growth.table().text(&Default::default());
    assert!(table.contains("ns a segment") && table.contains("30.0") && table.contains("100.0"), "{table}");
}

#[test]
fn each_built_in_volume_has_lines_of_its_own() {
    let sizes = [("64", 10_000), ("128", 80_000), ("256", 640_000)];
    let of = |object: &str| sizes.map(|(size, segments)| scene(&format!("{object}:{size}"), segments)).concat();
    let runs: Vec<Run> = [of("jets"), of("blocks"), scene("shells:64", 10), scene("shells:128", 20)].concat();
    let found: Vec<_> =
        Growth::all(&groups(&runs)).into_iter().map(|growth| (growth.object, growth.scenes.len())).collect();
    assert_eq!(found, [(Some("jets".to_owned()), 3), (Some("blocks".to_owned()), 3)], "of shells there are two");
}

#[test]
fn least_squares_of_three_points() {
    let line = Line::through(&[[0.0, 1.0], [1.0, 1.0], [2.0, 4.0]]);
    // By hand: slope 3/2, mean 2 at 1; it explains 4.5 of 6.
    assert!(
        (line.each - 1.5).abs() < 1e-12 && (line.base - 0.5).abs() < 1e-12 && (line.explained - 0.75).abs() < 1e-12
    );
    let flat = Line::through(&[[0.0, 2.0], [1.0, 2.0], [5.0, 2.0]]);
    assert_eq!((flat.base, flat.each, flat.explained), (2.0, 0.0, 1.0));
}

#[test]
fn scenes_that_differ_in_more_than_their_volume_have_no_line() {
    let mut runs = runs();
    runs[0..6].iter_mut().for_each(|run| run.settings.sampling.step = 0.5);
    assert_eq!(Growth::all(&groups(&runs)), [], "two and two scenes");
    assert_eq!(Growth::all(&groups(&scene("jets:64", 10))), []);
}

#[test]
fn the_report_draws_it() {
    let runs = runs();
    let growth = Growth::all(&groups(&runs));
    let svg = growth_svg(&growth[0]).unwrap();
    assert!(svg.contains("segments that show something") && svg.contains("CPU time of a frame"));
    let page = |runs: Vec<Run>| {
        let results = Results { runs, pictures: Vec::new(), ..results() };
        bench::page(&results, None, &|_| unreachable!("no pictures were kept")).unwrap()
    };
    let (with, without) = (page(runs), page(scene("jets:64", 10)));
    let title = "Time against what shows";
    assert!(with.contains(title) && !without.contains(title));
}
