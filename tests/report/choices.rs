//! How far what `auto` chose was from the best of what was run beside it.

use depthleap::auto::AutoRecord;
use depthleap::measure::record::{Clock, Saved};
use depthleap::measure::saving::save;
use depthleap::measure::{Run, Timing};
use depthleap::report::choice::{choice_line, choices};
use depthleap::report::comparison::{groups, label};

use crate::runs::run;

/// A run that took so many milliseconds of CPU time, and so many to build what it looks up.
fn timed(method: &str, cpu: f64, build: Option<f64>) -> Run {
    let mut run = run(method, &[100], &[0]);
    run.host.cpu = Some(Timing::once(cpu));
    run.host.build = build.map(Timing::once);
    run
}

/// The same, chosen by `auto` for so many frames, after a look of 6 ms.
fn chosen(of: Run, frames: u32) -> Run {
    let samples_per_pass = of.settings.sampling.samples_per_pass;
    Run { auto: Some(AutoRecord { samples_per_pass, frames, look_ms: 6.0, ..AutoRecord::default() }), ..of }
}

#[test]
fn what_is_built_and_the_look_count_by_the_frames_they_serve() {
    let runs =
        [chosen(timed("nn-omni", 10.0, Some(60.0)), 3), timed("rc", 40.0, None), timed("nn-omni", 20.0, Some(30.0))];
    let line = choice_line(&groups(&runs)[0]).expect("a line");
    // 10 + 60 / 3 + 6 / 3 beside 20 + 30 / 3.
    assert_eq!((line.ms, line.best_ms), (32.0, 30.0));
    assert_eq!((line.chosen.as_str(), line.best.as_str()), ("nn-omni", "nn-omni"));
    let sentence = choices(&groups(&runs)).unwrap();
    assert!(sentence.contains("1.07 times") && sentence.contains("1 scene"), "{sentence}");
    assert_eq!(choices(&groups(&runs[..1])), None, "nothing beside it");
    assert_eq!(choices(&groups(&runs[1..])), None, "nothing was chosen");
}

#[test]
fn a_device_that_is_no_cpu_is_judged_by_its_own_time() {
    let on_device = |of: Run, ms: f64| {
        let mut run = of;
        let times = run.gpu_ms.as_mut().unwrap();
        times.0.iter_mut().filter(|(name, _)| name == "total").for_each(|(_, timing)| *timing = Timing::once(ms));
        run
    };
    let mut runs = vec![
        on_device(chosen(timed("rc-ert", 1.0, None), 1), 5.0),
        on_device(timed("rc-ert", 1.0, None), 4.0),
        on_device(timed("single-pass", 9.0, None), 2.0),
    ];
    save(&mut runs.iter_mut().collect::<Vec<_>>(), false);
    assert!(matches!(runs[2].saved, Some(Saved { clock: Some(Clock::Gpu), .. })));
    let line = choice_line(&groups(&runs)[0]).expect("a line");
    assert_eq!((line.ms, line.best_ms, line.best.as_str()), (11.0, 2.0, "single-pass"));
}

#[test]
fn a_chosen_run_is_no_rule_and_its_cell_is_told() {
    let mut first = chosen(timed("rc-ert", 10.0, None), 1);
    first.settings.sampling.samples_per_pass = 32;
    let mut runs = vec![first, timed("rc-ert", 20.0, None), timed("nn-omni", 5.0, None)];
    save(&mut runs.iter_mut().collect::<Vec<_>>(), true);
    assert_eq!(runs[2].saved.as_ref().unwrap().time, Some(0.75), "against the one that nobody chose");
    assert!(groups(&runs)[0].subtitle().contains("M = 8"), "the one that was asked for");
    let mut coarse = timed("single-pass-omni", 5.0, None);
    coarse.settings.method.cell = 2;
    assert_eq!(label(&coarse), "single-pass-omni (cell 2)");
}
