//! The frame rates of the paper against each other, and the comparison of synthetic times with them.

use std::path::{Path, PathBuf};

use depthleap::experiment::reproduce::rates::{RATE_BASE, RATE_SETS, RATE_SIZES, RENDERERS, RateSet};
use depthleap::experiment::reproduce::termination::{PUBLISHED_GAIN, gain_lines, gain_verdict};
use depthleap::experiment::reproduce::{
    FORMAT, Rate, RateLine, ReproducedSet, Reproduction, SEMI_TRANSPARENT, TimedRecord, Variant, csv, page, rate_lines,
    rate_verdict, rates_csv, text,
};
use depthleap::measure::record::{Clock, Run};
use depthleap::measure::timing::Timing;
use depthleap::provenance::Provenance;
use depthleap::read;
use depthleap::report::html::Png;
use depthleap::scene::scenes::STEGMAIER;
use depthleap::scene::settings::Settings;

use crate::runs::run;

/// A run of the single pass that took so many milliseconds by the wall clock, and a fourth of that by the device's process.
fn timed(size: u32, turn: f64, termination: f64, ms: f64) -> Run {
    let mut run = run("single-pass", &[], &[]);
    run.host.frame = Some(Timing::once(ms));
    run.host.cpu = Some(Timing::once(0.25 * ms));
    run.gpu_ms = None;
    run.settings.image.size = [size; 2];
    run.settings.camera.eye[0] = turn;
    run.settings.sampling.termination = termination;
    run
}

fn variant(choice: &str, runs: Vec<Run>) -> Variant {
    Variant { choice: choice.to_owned(), value: format!("<{choice}>"), runs }
}

fn column(name: &str, absent: Option<&str>, variants: Vec<Variant>) -> ReproducedSet {
    ReproducedSet {
        name: name.to_owned(),
        source: "Stegmaier05".to_owned(),
        file: absent.is_none().then(|| format!("{name}.nrrd")),
        absent: absent.map(str::to_owned),
        picture: absent.is_none().then(|| format!("pictures/{name}.png")),
        variants,
    }
}

/// A volume that takes these milliseconds from two directions at 512 x 512 pixels, four times as many at 1024 x 1024.
fn two_directions(ms: [f64; 2]) -> Vec<Run> {
    let of_size = |(size, factor): (u32, f64)| [0.0, 1.0].map(|turn| (size, turn, factor * ms[turn as usize]));
    let frames = [(512, 1.0), (1024, 4.0)].into_iter().flat_map(of_size);
    frames.map(|(size, turn, ms)| timed(size, turn, 1.0, ms)).collect()
}

/// Engine and head timed, both with one choice made otherwise in the smaller viewport; the others absent.
fn found() -> Reproduction {
    let other = |ms: [f64; 2]| variant("view", two_directions(ms)[..2].to_vec());
    let pair = |turn: f64, with: f64, without: f64| [timed(512, turn, 0.95, with), timed(512, turn, 1.0, without)];
    let pairs = [pair(0.0, 100.0, 90.0), pair(1.0, 50.0, 75.0), pair(2.0, 40.0, 44.0)].concat();
    let timed = TimedRecord {
        clock: Some(Clock::Cpu),
        rates: vec![
            column("Bucky Ball", Some("no ball & nothing else"), vec![]),
            column("Engine", None, vec![variant("main", two_directions([60.0, 40.0])), other([70.0, 50.0])]),
            column("Head", None, vec![variant("main", two_directions([80.0, 120.0])), other([100.0, 60.0])]),
            column("Lucy", Some("no statue"), vec![]),
        ],
        termination: column("Engine", None, vec![variant("transfer function", pairs)]),
    };
    let provenance = Provenance {
        version: FORMAT,
        program: "depthleap".to_owned(),
        commit: "none".to_owned(),
        command: "depthleap reproduce".to_owned(),
        date: "2026-01-01T00:00:00Z".to_owned(),
    };
    Reproduction { provenance, columns: Vec::new(), figures: Vec::new(), timed: Some(timed) }
}

fn line(lines: &[RateLine], name: &str, size: u32) -> RateLine {
    lines.iter().find(|line| line.set.name == name && line.size == size).unwrap().clone()
}

fn near(a: Option<f64>, b: f64) -> bool {
    a.is_some_and(|a| (a - b).abs() < 1e-12)
}

#[test]
fn published_rates_fall_with_samples_and_pixels() {
    for half in 0..RENDERERS.len() {
        let of = |set: &RateSet, size: usize| set.theirs[half][size];
        for set in &RATE_SETS {
            // Four times the pixels take at most four times as long.
            let factor = of(set, 0) / of(set, 1);
            assert!(factor > 1.0 && factor <= 4.0, "{}: {factor}", set.name);
        }
        let slices = |set: &RateSet| set.dims.into_iter().max().unwrap() * set.dims.into_iter().min().unwrap();
        let mut sets = RATE_SETS.to_vec();
        sets.sort_by_key(slices);
        assert!(sets.is_sorted_by(|a, b| of(a, 0) > of(b, 0)), "by slices and side at {}", RATE_SIZES[0]);
    }
}

#[test]
fn steps_are_slices_of_the_volume_of_the_paper() {
    for set in &RATE_SETS {
        let Ok(open) = set.open else { continue };
        let mut settings = Settings::default();
        open(&mut settings, PathBuf::from(set.file));
        let file = settings.volume.path.as_deref().or(settings.volume.mesh.as_deref());
        assert_eq!(file, Some(Path::new(set.file)));
        assert!(settings.check().is_ok() && set.step > 0.0 && set.step <= 1.0, "{}", set.name);
    }
    let mut engine = Settings::default();
    RATE_SETS[RATE_BASE].open.unwrap()(&mut engine, PathBuf::from("engine.nrrd"));
    let plane = engine.clips[0].plane.unwrap();
    assert_eq!(plane[..3], [0.0, 0.0, -1.0]);
    // The longest side has 256 voxels, and the file 128 slices about the origin.
    let slices = 256.0 * plane[3] + 64.0;
    assert_eq!(slices, f64::from(RATE_SETS[RATE_BASE].dims[2]));
    assert_eq!(256.0 * engine.camera.target[2], 0.5 * slices - 64.0, "the view is centred on what is left");
}

#[test]
fn frames_of_a_turn_are_divided_by_their_time() {
    let rate = Rate::of(&[100.0, 50.0]).unwrap();
    assert!(near(Some(rate.average), 2.0 / 0.15) && (rate.least, rate.greatest) == (10.0, 20.0));
    assert_eq!((Rate::of(&[]), Rate::of(&[0.0, 1.0])), (None, None));
}

#[test]
fn rates_have_both_sides_and_ratios_among_the_sets() {
    let found = found();
    let lines = rate_lines(found.timed.as_ref().unwrap());
    assert_eq!(lines.len(), RATE_SETS.len() * RATE_SIZES.len());
    let engine = line(&lines, "Engine", 512).cells[0].clone();
    assert_eq!((engine.theirs, engine.their_ratio, engine.our_ratio), (10.8, 1.0, Some(1.0)));
    assert!(near(engine.ours.map(|rate| rate.average), 20.0), "100 ms for two frames");
    let head = line(&lines, "Head", 512).cells[0].clone();
    assert!(near(head.our_ratio, 0.5) && near(head.clock_ratio, 0.5) && near(Some(head.their_ratio), 7.2 / 10.8));
    assert!(near(head.sweep.map(|ends| ends[0]), 0.5) && near(head.sweep.map(|ends| ends[1]), 0.75));
    let large = line(&lines, "Head", 1024).cells[0].clone();
    assert!(near(large.ours.map(|rate| rate.average), 2.5) && near(large.our_ratio, 0.5));
    assert_eq!(large.sweep, None, "the choice was not timed there");
    let lucy = line(&lines, "Lucy", 1024).cells[0].clone();
    assert_eq!((lucy.theirs, lucy.ours, lucy.our_ratio, lucy.sweep), (2.6, None, None, None));
    let verdict = rate_verdict(&lines, 0).unwrap();
    assert!(verdict.contains("Head 512^2 50.0 % of Engine's frames per second, theirs 66.7 %"), "{verdict}");
    assert!(!verdict.contains("Lucy") && !verdict.contains("Engine 512"), "{verdict}");
}

#[test]
fn gains_are_of_pairs_from_one_direction() {
    let found = found();
    let lines = gain_lines(&found.timed.as_ref().unwrap().termination, Clock::Wall);
    let rule = [90.0 / 100.0 - 1.0, 75.0 / 50.0 - 1.0, 44.0 / 40.0 - 1.0];
    assert!(lines.len() == 1 && lines[0].gains.iter().zip(rule).all(|(gain, rule)| near(Some(*gain), rule)));
    let of = &lines[0].statistics;
    assert!(near(Some(of.min), rule[0]) && near(Some(of.median), rule[2]) && near(Some(of.max), rule[1]));
    let verdict = gain_verdict(&lines).unwrap();
    assert_eq!(
        verdict,
        "The paper measured -20.0 to +60.0 %; here, <transfer function>, -10.0 to +50.0 %, all of them within that range."
    );
    let far = column("Engine", None, vec![variant("a", vec![timed(512, 0.0, 0.95, 1.0), timed(512, 0.0, 1.0, 3.0)])]);
    let far = gain_lines(&far, Clock::Wall);
    assert!(far[0].statistics.max > PUBLISHED_GAIN[1] && gain_verdict(&far).unwrap().contains("not all of them"));
    let alone = column("Engine", None, vec![variant("a", vec![timed(512, 0.0, 0.95, 1.0)])]);
    assert_eq!((gain_lines(&alone, Clock::Wall), gain_verdict(&[])), (vec![], None), "nothing to hold it against");
}

#[test]
fn text_and_page_show_what_was_timed_and_name_what_is_absent() {
    let found = found();
    let text = text(&found);
    for part in
        ["Frame rates", "Head, 1024^2", "10.8", "Early ray termination", "+50.0", "all of them within that range"]
    {
        assert!(text.contains(part), "no {part} in {text}");
    }
    assert!(text.contains("Lucy: no statue (Stegmaier05, Table 1: 256 x 256 x 512 voxels"), "{text}");
    assert!(text.contains("Raycasting 7.0 at 512^2, 2.6 at 1024^2") && !text.contains("Lucy, 512^2"), "{text}");
    assert!(text.contains("What Stegmaier05 leaves open") && text.contains("view: <view>"), "{text}");
    let page = page(&found, &|_| Ok(Png { bytes: vec![1], size: [2, 1] }));
    assert!(page.contains("no ball &amp; nothing else") && !page.contains("<view>"), "text is escaped");
    assert!(page.contains("<h2>Frame rates") && page.contains("<h2>Early ray") && page.matches("<img").count() == 2);
}

#[test]
fn csv_has_the_rates_of_the_paper_and_ours_by_each_clock() {
    let text = rates_csv(&found()).unwrap();
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let heads: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let rows: Vec<Vec<String>> = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    let of = |row: &[String], head: &str| row[heads.iter().position(|name| name == head).unwrap()].clone();
    let rows_of = |set: &str| rows.iter().filter(|row| of(row, "set") == set && of(row, "size") == "512").count();
    // The paper's; of engine and head two clocks with two choices.
    assert_eq!(["Bucky Ball", "Engine", "Head", "Lucy"].map(rows_of), [1, 5, 5, 1]);
    let head = rows.iter().find(|row| of(row, "set") == "Head" && of(row, "clock") == "cpu").unwrap();
    assert_eq!([of(head, "fps"), of(head, "ratio"), of(head, "paper_fps")], ["40.000000", "0.500000", ""]);
    assert!(rows.iter().any(|row| of(row, "paper_fps") == "7.000000" && of(row, "paper_ratio") == "0.648148"));
}

#[test]
fn json_comes_back_and_older_results_have_no_times() {
    let found = found();
    let json = serde_json::to_value(&found).unwrap();
    assert_eq!(serde_json::from_value::<Reproduction>(json.clone()).unwrap(), found);
    let mut old = json;
    old.as_object_mut().unwrap().remove("timed");
    let old: Reproduction = serde_json::from_value(old).unwrap();
    assert!(old.timed.is_none() && !text(&old).contains("Stegmaier05") && csv(&old).is_ok());
    assert_eq!(rates_csv(&old).unwrap().lines().count(), 1, "the heading alone");
}

#[test]
fn early_termination_is_timed_with_the_transfer_function_of_the_figure() {
    let figure = STEGMAIER.iter().find(|figure| figure.name == "stegmaier-5-volume").unwrap();
    let settings = read::settings_of(figure.name, figure.text, Path::new("")).unwrap();
    assert_eq!(settings.transfer.points.as_deref(), Some(&SEMI_TRANSPARENT[..]));
}
