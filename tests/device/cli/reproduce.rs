//! `depthleap reproduce`: what it times, and the figures it draws, on volumes of the paper.

use std::path::Path;
use std::sync::Arc;

use depthleap::experiment::Host;
use depthleap::experiment::reproduce::rates::{RATE_TABLES, RateSet, RateTable};
use depthleap::experiment::reproduce::termination::gain_lines;
use depthleap::experiment::reproduce::{CountedSet, Part, ReproduceJob, TimingPlan};
use depthleap::frame::self_check;
use depthleap::measure::picture::Picture;
use depthleap::measure::record::{Clock, Run};
use depthleap::measure::runner::{Effort, Runner};
use depthleap::measure::{Checked, CostSource};
use depthleap::read;
use depthleap::scene::scenes::{PaperFigure, STEGMAIER};
use depthleap::vulkan::Device;

use crate::harness::{Need, Test, data, test};

/// The volumes of these tests. Distances to Lucy's mesh take half a minute to find, and have tests of their own.
const FILES: [&str; 3] = ["buckyball.nrrd", "ct_head.nrrd", "engine.nrrd"];

/// Those that are timed: a volume of one table, and one of both.
const TIMED: [&str; 2] = ["buckyball.nrrd", "engine.nrrd"];

pub fn tests() -> Vec<Test> {
    let tests = [
        test("reproduce times its sets and early ray termination", times),
        test("reproduce draws the figures of the single pass", figures),
    ];
    tests.into_iter().map(|test| FILES.into_iter().fold(test, |test, file| test.needs(Need::Data(file)))).collect()
}

fn checked(device: &Arc<Device>) -> Checked {
    Checked { device: device.clone(), check: self_check(device).unwrap(), early_end: None, costs: CostSource::Fitted }
}

fn times(device: &Arc<Device>) {
    let timing = TimingPlan { papers: None, sizes: Some(vec![16, 24]), directions: 2, repeats: 2, sweep: true };
    let folder = tempfile::tempdir().unwrap();
    for file in TIMED {
        std::os::unix::fs::symlink(data(file), folder.path().join(file)).unwrap();
    }
    let job = ReproduceJob { data: Some(folder.path().to_owned()), parts: vec![Part::Times], quick: false, timing };
    let host = Host { open: &|| Ok(checked(device)), close: &|_| Ok(()), say: &|_| {} };
    let counted = job.run(&host).unwrap();
    assert!(counted.columns.iter().all(|(column, _)| column.variants.is_empty() && column.absent.is_some()));
    assert!(counted.figures.iter().all(|(figure, picture)| figure.absent.is_some() && picture.is_none()));
    assert!(counted.timed.clock.is_some());
    let sets = RATE_TABLES.into_iter().flat_map(|table| table.sets.iter().map(move |set| (table, set)));
    for ((table, set), counted) in sets.zip(&counted.timed.rates) {
        assert_eq!(TIMED.contains(&set.file), counted.0.absent.is_none(), "{}: {:?}", set.name, counted.0.absent);
        assert_eq!((counted.0.name.as_str(), &counted.0.source), (set.name, &table.source(set)));
        was_timed(table, set, counted);
    }
    let lines = gain_lines(&counted.timed.termination, Clock::Wall);
    assert!(lines.len() == 3 && lines.iter().all(|line| line.gains.len() == 2), "{lines:?}");
}

/// A set whose volume is there was timed by each renderer in both viewports from both directions.
fn was_timed(table: &RateTable, set: &RateSet, (column, picture): &CountedSet) {
    let Some(main) = column.variants.first() else { return assert!(column.absent.is_some()) };
    assert_eq!(picture.as_ref().map(|picture| picture.size), Some([16; 2]));
    let (runs, renderers) = (&main.runs, table.renderers.len());
    let name = format!("{} {}", table.paper, set.name);
    assert_eq!(runs.len(), renderers * 2 * 2, "{name}: two viewports from two directions");
    assert!(runs.iter().all(|run| run.milliseconds(Clock::Wall).is_some_and(|ms| ms > 0.0)), "{name}");
    let in_turn = table.renderers.iter().cycle().map(|renderer| renderer.method.name);
    assert!(runs.iter().map(|run| run.method.as_str()).eq(in_turn.take(runs.len())), "{name}");
    let of: Vec<&Run> = runs.iter().step_by(renderers).collect();
    assert_ne!(of[0].settings.camera, of[1].settings.camera, "{name}");
    assert!(of[0].fragments.main > 0 && of[2].fragments.main > of[0].fragments.main, "{name}");
    // Only the bucky ball that is there has other slices than the paper's; the engine is what its table is told in.
    let choices: Vec<&str> = column.variants.iter().map(|variant| variant.choice.as_str()).collect();
    let steps = choices.contains(&"sampling distance");
    assert_eq!(steps, table.base_set.is_some() && set.name != "Head", "{name}: {choices:?}");
    assert!(column.variants[1..].iter().all(|variant| variant.runs.len() == 2 * renderers), "{name}");
}

fn figures(device: &Arc<Device>) {
    let checked = checked(device);
    let rows = STEGMAIER.iter().filter(|row| FILES.contains(&row.file));
    let drawn: Vec<(&str, Picture)> = rows.map(|row| (row.name, picture(&checked, row))).collect();
    for (name, picture) in &drawn {
        let covered = picture.pixels.iter().filter(|pixel| pixel[3] > 0.5).count();
        assert!(covered * 20 > picture.pixels.len(), "{name} shows {covered} pixels");
    }
    for (i, (a, picture)) in drawn.iter().enumerate() {
        for (b, other) in &drawn[..i] {
            assert_ne!(picture.pixels, other.pixels, "{a} and {b} are the same picture");
        }
    }
}

/// A figure in a small viewport.
fn picture(checked: &Checked, row: &PaperFigure) -> Picture {
    let mut settings = read::settings_of(row.name, row.text, &data("")).unwrap();
    settings.image.size = [48; 2];
    assert!(settings.volume.path.as_deref().is_some_and(Path::exists), "{}", row.name);
    let effort = Effort { warmups: 0, repeats: 0, reference: false };
    let mut runner = Runner::new(Some(checked), read::scene(&settings).unwrap(), row.name.to_owned());
    let mut measured = runner.measure(&[settings.method], effort, &|_| {}).unwrap();
    measured.pop().unwrap().picture
}
