//! The frame rates of the paper against each other, and the comparison of synthetic times with them.

use std::path::{Path, PathBuf};

use depthleap::experiment::reproduce::rates::{
    HEIDRICH, KW03, RATE_TABLES, Rate, RateLine, RateSet, RateTable, STEGMAIER, explained, rate_lines, rate_remarks,
    rate_verdicts,
};
use depthleap::experiment::reproduce::termination::{PUBLISHED_GAIN, gain_lines, gain_verdict};
use depthleap::experiment::reproduce::{
    FORMAT, ReproducedSet, Reproduction, SEMI_TRANSPARENT, TimedRecord, Variant, csv, page, rates_csv, text,
};
use depthleap::measure::notes::triangles_in;
use depthleap::measure::record::{Clock, Run};
use depthleap::measure::timing::Timing;
use depthleap::provenance::Provenance;
use depthleap::read;
use depthleap::report::html::Png;
use depthleap::scene::scenes::STEGMAIER as FIGURES;
use depthleap::scene::settings::Settings;

use crate::runs::run;

/// A run that took so many milliseconds by the wall clock, and a fourth of that by the device's process, with a main fragment
/// for each pixel and half as many intermediate ones where the method has them.
fn timed_by(method: &str, size: u32, turn: f64, termination: f64, ms: f64) -> Run {
    let pixels = u64::from(size * size);
    let intermediate = if method == "rc-ert" { vec![pixels / 2] } else { Vec::new() };
    let mut run = run(method, &[pixels], &intermediate);
    run.host.frame = Some(Timing::once(ms));
    run.host.cpu = Some(Timing::once(0.25 * ms));
    run.gpu_ms = None;
    run.settings.image.size = [size; 2];
    run.settings.camera.eye[0] = turn;
    run.settings.sampling.termination = termination;
    run
}

/// The same of the single pass.
fn timed(size: u32, turn: f64, termination: f64, ms: f64) -> Run {
    timed_by("single-pass", size, turn, termination, ms)
}

fn variant(choice: &str, runs: Vec<Run>) -> Variant {
    Variant { choice: choice.to_owned(), value: format!("<{choice}>"), runs }
}

fn column(table: &RateTable, name: &str, absent: Option<&str>, variants: Vec<Variant>) -> ReproducedSet {
    ReproducedSet {
        name: name.to_owned(),
        source: table.source(table.sets.iter().find(|set| set.name == name).unwrap()),
        file: absent.is_none().then(|| format!("{name}.nrrd")),
        absent: absent.map(str::to_owned),
        picture: absent.is_none().then(|| format!("pictures/{name}.png")),
        variants,
    }
}

/// A volume that takes these milliseconds from two directions at 512 x 512 pixels, four times as many at 1024 x 1024; half as
/// many by slices in the smaller viewport.
fn two_directions(ms: [f64; 2]) -> Vec<Run> {
    let of_size = |(size, factor): (u32, f64)| [0.0, 1.0].map(|turn| (size, turn, factor * ms[turn as usize]));
    let frames = [(512, 1.0), (1024, 4.0)].into_iter().flat_map(of_size);
    let slices = [0.0, 1.0].map(|turn| timed_by("slices-3d", 512, turn, 1.0, 0.5 * ms[turn as usize]));
    frames.map(|(size, turn, ms)| timed(size, turn, 1.0, ms)).chain(slices).collect()
}

/// The aneurism by ray casters: three and two times as fast where rays end early.
fn accelerated() -> Vec<Variant> {
    let runs = |factor: f64| {
        let by = |method, ms| timed_by(method, 512, 0.0, 0.95, ms);
        vec![by("rc", 300.0), by("rc-ert", 300.0 / factor)]
    };
    vec![variant("main", runs(3.0)), variant("view", runs(2.0))]
}

/// Engine and head of one paper timed, both with one choice made otherwise in the smaller viewport, and the aneurism of the other;
/// the others absent.
fn found() -> Reproduction {
    let other = |ms: [f64; 2]| variant("view", two_directions(ms)[..2].to_vec());
    let pair = |turn: f64, with: f64, without: f64| [timed(512, turn, 0.95, with), timed(512, turn, 1.0, without)];
    let pairs = [pair(0.0, 100.0, 90.0), pair(1.0, 50.0, 75.0), pair(2.0, 40.0, 44.0)].concat();
    let single = &STEGMAIER;
    let timed = TimedRecord {
        clock: Some(Clock::Cpu),
        rates: vec![
            column(single, "Bucky Ball", Some("no ball & nothing else"), vec![]),
            column(single, "Engine", None, vec![variant("main", two_directions([60.0, 40.0])), other([70.0, 50.0])]),
            column(single, "Head", None, vec![variant("main", two_directions([80.0, 120.0])), other([100.0, 60.0])]),
            column(single, "Lucy", Some("no statue"), vec![]),
            column(&KW03, "Head", Some("no other head"), vec![]),
            column(&KW03, "Aneurism", None, accelerated()),
        ],
        termination: column(single, "Engine", None, vec![variant("transfer function", pairs)]),
    };
    let provenance = Provenance {
        version: FORMAT,
        program: "depthleap".to_owned(),
        commit: "none".to_owned(),
        command: "depthleap reproduce".to_owned(),
        date: "2026-01-01T00:00:00Z".to_owned(),
    };
    Reproduction { provenance, columns: Vec::new(), figures: Vec::new(), timed: Some(timed), stated: None }
}

#[test]
fn triangles_of_shells_stand_beside_the_papers() {
    let shells = |triangles: u64| {
        let mut run = timed_by("shells", 512, 0.0, 0.95, 10.0);
        run.notes = vec!["a note of 7 words".to_owned(), format!("11 shells of {triangles} triangles")];
        run
    };
    let swept = vec![variant("main", vec![shells(5000)]), variant("levels", vec![shells(70_000), shells(400)])];
    let told = |variants: Vec<Variant>| {
        let mut timed = found().timed.unwrap();
        timed.rates.push(column(&HEIDRICH, "Hipip 1", None, variants));
        rate_remarks(&timed, &HEIDRICH)
    };
    let main = "Hipip 1: the paper's 11 shells have 44,846 polygons; here 5,000 triangles";
    assert_eq!(told(swept[..1].to_vec()), [main]);
    assert_eq!(told(swept), [format!("{main}, over the sweep 400 to 70,000")]);
    assert_eq!(["1 shell of 8 triangles", "9 cells of 8 triangles"].map(triangles_in), [Some(8), None]);
}

fn line(lines: &[RateLine], name: &str, size: u32, renderer: &str) -> RateLine {
    let of = |line: &&RateLine| (line.set.name, line.size, line.renderer.name) == (name, size, renderer);
    lines.iter().find(of).unwrap().clone()
}

fn near(a: Option<f64>, b: f64) -> bool {
    a.is_some_and(|a| (a - b).abs() < 1e-12)
}

/// Published rates of a set by each renderer that has any.
fn published(set: &RateSet) -> impl Iterator<Item = &'static [f64]> {
    set.theirs.iter().copied().filter(|rates| !rates.is_empty())
}

#[test]
fn published_rates_fall_with_samples_and_pixels() {
    for (table, set) in RATE_TABLES.into_iter().flat_map(|table| table.sets.iter().map(move |set| (table, set))) {
        assert_eq!(set.theirs.len(), table.renderers.len(), "{} {}", table.paper, set.name);
        for rates in published(set) {
            assert_eq!(rates.len(), table.sizes.len(), "{} {}", table.paper, set.name);
            // Four times the pixels take at most four times as long.
            let factors = rates.windows(2).map(|pair| pair[0] / pair[1]);
            assert!(factors.into_iter().all(|factor| factor > 1.0 && factor <= 4.0), "{}: {rates:?}", set.name);
        }
    }
    let slices = |set: &&RateSet| set.dims.into_iter().max().unwrap() * set.dims.into_iter().min().unwrap();
    let mut sets: Vec<&RateSet> = STEGMAIER.sets.iter().collect();
    sets.sort_by_key(slices);
    for renderer in 0..STEGMAIER.renderers.len() {
        let rates: Vec<f64> = sets.iter().filter_map(|set| set.theirs[renderer].first()).copied().collect();
        assert!(rates.len() > 2 && rates.is_sorted_by(|a, b| a > b), "by slices and side: {rates:?}");
    }
    for set in KW03.sets {
        let [slices, plain, early, skipping] = [0, 1, 2, 3].map(|renderer| set.theirs[renderer][0]);
        assert!(slices > plain && early >= plain && skipping > early, "{}", set.name);
    }
}

#[test]
fn steps_are_slices_of_the_volume_of_the_paper() {
    for set in RATE_TABLES.into_iter().flat_map(|table| table.sets) {
        let Ok(open) = set.open else { continue };
        let mut settings = Settings::default();
        open(&mut settings, PathBuf::from(set.file));
        let file = settings.volume.path.as_deref().or(settings.volume.mesh.as_deref());
        assert_eq!(file, Some(Path::new(set.file)));
        assert!(settings.check().is_ok() && set.step > 0.0 && set.step <= 1.0, "{}", set.name);
    }
    let set = STEGMAIER.told_in().unwrap();
    let mut engine = Settings::default();
    set.open.unwrap()(&mut engine, PathBuf::from("engine.nrrd"));
    let plane = engine.clips[0].plane.unwrap();
    assert_eq!(plane[..3], [0.0, 0.0, -1.0]);
    // The longest side has 256 voxels, and the file 128 slices about the origin.
    let slices = 256.0 * plane[3] + 64.0;
    assert_eq!(slices, f64::from(set.dims[2]));
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
    let lines = rate_lines(found.timed.as_ref().unwrap(), &STEGMAIER);
    assert_eq!(lines.len(), 4 * 2 * 2, "sets, viewports and renderers");
    let of = |name, size| line(&lines, name, size, "Raycasting");
    let to_engine = |line: &RateLine| line.to_set.unwrap();
    let engine = of("Engine", 512);
    assert_eq!((engine.theirs, to_engine(&engine).theirs, to_engine(&engine).ours), (Some(10.8), Some(1.0), Some(1.0)));
    assert!(near(engine.ours.map(|rate| rate.average), 20.0), "100 ms for two frames");
    let head = to_engine(&of("Head", 512));
    assert!(near(head.ours, 0.5) && near(head.clock, 0.5) && near(head.theirs, 7.2 / 10.8));
    assert!(near(head.sweep.map(|ends| ends[0]), 0.5) && near(head.sweep.map(|ends| ends[1]), 0.75));
    let large = of("Head", 1024);
    assert!(near(large.ours.map(|rate| rate.average), 2.5) && near(to_engine(&large).ours, 0.5));
    assert_eq!(to_engine(&large).sweep, None, "the choice was not timed there");
    let lucy = of("Lucy", 1024);
    assert_eq!((lucy.theirs, lucy.ours, to_engine(&lucy).ours, lucy.fragments), (Some(2.6), None, None, None));
    assert_eq!(line(&lines, "Lucy", 512, "Texture-based").theirs, None, "it could not be loaded");
    let verdicts = rate_verdicts(&STEGMAIER, &lines);
    let verdict = &verdicts[0];
    assert!(verdict.contains("Head 512^2 50.0 % of Engine's frames per second, theirs 66.7 %"), "{verdict}");
    assert!(!verdict.contains("Lucy") && !verdict.contains("Engine 512"), "{verdict}");
}

#[test]
fn renderers_are_told_in_one_of_them_and_explained_by_fragments() {
    let found = found();
    let timed = found.timed.as_ref().unwrap();
    let slices = line(&rate_lines(timed, &STEGMAIER), "Head", 512, "Texture-based").to_renderer;
    assert!(near(slices.ours, 2.0) && near(slices.theirs, 16.6 / 7.2) && slices.sweep.is_none());
    let lines = rate_lines(timed, &KW03);
    let early = line(&lines, "Aneurism", 512, "RC-a");
    assert!(early.to_set.is_none() && near(early.to_renderer.ours, 3.0) && near(early.to_renderer.theirs, 8.9 / 4.8));
    assert!(near(early.to_renderer.sweep.map(|ends| ends[0]), 2.0), "{:?}", early.to_renderer.sweep);
    let pixels = f64::from(512 * 512);
    assert_eq!(early.fragments, Some([pixels, 0.5 * pixels]));
    // The head of one paper is not that of the other.
    assert_eq!(line(&lines, "Head", 512, "RC").ours, None);
    let found_of = |table: &'static RateTable| explained(table, &rate_lines(timed, table));
    let rule = "Aneurism 512^2, RC-a: 100.0 % of RC's main fragments and 0.50 intermediate ones for each of its own, in 33.3 % of \
                RC's time";
    assert_eq!(found_of(&KW03), [rule]);
    // Samples are no part of rays.
    let slices = found_of(&STEGMAIER);
    assert!(slices[0].contains("1.00 samples for each of Raycasting's rays"), "{slices:?}");
    let verdicts = rate_verdicts(&KW03, &lines);
    assert!(verdicts.len() == 1 && verdicts[0].contains("Aneurism 512^2 by RC-a 300.0 %"), "{verdicts:?}");
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
    let far = column(
        &STEGMAIER,
        "Engine",
        None,
        vec![variant("a", vec![timed(512, 0.0, 0.95, 1.0), timed(512, 0.0, 1.0, 3.0)])],
    );
    let far = gain_lines(&far, Clock::Wall);
    assert!(far[0].statistics.max > PUBLISHED_GAIN[1] && gain_verdict(&far).unwrap().contains("not all of them"));
    let alone = column(&STEGMAIER, "Engine", None, vec![variant("a", vec![timed(512, 0.0, 0.95, 1.0)])]);
    assert_eq!((gain_lines(&alone, Clock::Wall), gain_verdict(&[])), (vec![], None), "nothing to hold it against");
}

#[test]
fn text_and_page_show_what_was_timed_and_name_what_is_absent() {
    let found = found();
    let text = text(&found);
    for part in [
        "Frame rates",
        "Head, 1024^2, Raycasting",
        "10.8",
        "Early ray termination",
        "+50.0",
        "all of them within that range",
    ] {
        assert!(text.contains(part), "no {part} in {text}");
    }
    assert!(text.contains("Lucy: no statue (Stegmaier05, Table 1: 256 x 256 x 512 voxels"), "{text}");
    assert!(text.contains("Raycasting 7.0 at 512^2, 2.6 at 1024^2") && !text.contains("Lucy, 512^2"), "{text}");
    assert!(text.contains("What KW03 leaves open") && text.contains("a fragment is a sample"), "{text}");
    assert!(text.contains("What Stegmaier05 leaves open") && text.contains("view: <view>"), "{text}");
    let page = page(&found, &|_| Ok(Png { bytes: vec![1], size: [2, 1] }));
    assert!(page.contains("no ball &amp; nothing else") && !page.contains("<view>"), "text is escaped");
    assert!(page.contains("<h2>Frame rates") && page.contains("<h2>Early ray") && page.matches("<img").count() == 3);
}

#[test]
fn csv_has_the_rates_of_the_paper_and_ours_by_each_clock() {
    let text = rates_csv(&found()).unwrap();
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    let heads: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let rows: Vec<Vec<String>> = reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    let of = |row: &[String], head: &str| row[heads.iter().position(|name| name == head).unwrap()].clone();
    let rows_of = |set: &str| {
        let single = |row: &&Vec<String>| of(row, "method") == "single-pass" && of(row, "size") == "512";
        rows.iter().filter(single).filter(|row| of(row, "set") == set).count()
    };
    // The paper's; of engine and head two clocks with two choices.
    assert_eq!(["Bucky Ball", "Engine", "Head", "Lucy"].map(rows_of), [1, 5, 5, 1]);
    let early = rows.iter().find(|row| of(row, "method") == "rc-ert" && of(row, "clock") == "wall").unwrap();
    assert_eq!([of(early, "set"), of(early, "ratio"), of(early, "ratio_renderers")], ["Aneurism", "", "3.000000"]);
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
    let figure = FIGURES.iter().find(|figure| figure.name == "stegmaier-5-volume").unwrap();
    let settings = read::settings_of(figure.name, figure.text, Path::new("")).unwrap();
    assert_eq!(settings.transfer.points.as_deref(), Some(&SEMI_TRANSPARENT[..]));
}
