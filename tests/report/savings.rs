//! What became of the fragments saved, and how that depends on the cost of a sample.

use depthleap::experiment::bench::{csv, table};
use depthleap::measure::record::{Clock, Ideal, PassTimes, Saved};
use depthleap::measure::saving::save;
use depthleap::measure::{Results, Run, Timing};
use depthleap::report::comparison::groups;
use depthleap::report::cost::{CostRow, Sweep};
use depthleap::report::limit::Limit;
use depthleap::report::plot::cost_svg;
use depthleap::report::{branching, verdict};
use depthleap::scene::settings::Tiles;

use crate::runs::{results, run};

/// A run with those main fragments (and none between), CPU and device times.
fn timed(method: &str, fragments: u64, cpu: f64, gpu: f64) -> Run {
    let mut run = run(method, &[fragments], &[0]);
    (run.cull, run.mark) = (Some("ztest".into()), Some("copy".into()));
    run.host.cpu = Some(Timing::once(cpu));
    run.host.frame = Some(Timing::once(3.0 * cpu));
    if let Some(times) = &mut run.gpu_ms {
        times.0.iter_mut().filter(|(name, _)| name == "total").for_each(|(_, timing)| *timing = Timing::once(gpu));
    }
    run
}

fn saved(mut runs: Vec<Run>, on_cpu: bool) -> Vec<Run> {
    save(&mut runs.iter_mut().collect::<Vec<_>>(), on_cpu);
    runs
}

#[test]
fn savings_are_parts_of_rc_ert() {
    let runs = || vec![timed("nn-omni", 250, 4.0, 9.0), timed("rc-ert", 1000, 10.0, 12.0), timed("cpu", 9, 1.0, 1.0)];
    let found = saved(runs(), true);
    let expected = Saved {
        against: "rc-ert (ztest + copy)".into(),
        fragments: Some(0.75),
        time: Some(0.6),
        clock: Some(Clock::Cpu),
    };
    assert_eq!(found[0].saved, Some(expected.clone()));
    assert!((expected.efficiency().unwrap() - 0.8).abs() < 1e-12);
    assert_eq!((&found[1].saved, &found[2].saved), (&None, &None), "nothing is compared with itself");
    let by_device = saved(runs(), false)[0].saved.clone().unwrap();
    assert_eq!((by_device.time, by_device.clock), (Some(0.25), Some(Clock::Gpu)));
    let mut untimed = runs();
    untimed.iter_mut().for_each(|run| run.gpu_ms = None);
    assert_eq!(saved(untimed.clone(), false)[0].saved.as_ref().unwrap().clock, Some(Clock::Wall));
    untimed.iter_mut().for_each(|run| run.host = Default::default());
    let counted = saved(untimed, true)[0].saved.clone().unwrap();
    assert_eq!((counted.time, counted.efficiency()), (None, None));
    // Without the rule, and with none that has a fragment, there is nothing to compare.
    assert_eq!(saved(vec![timed("nn-omni", 1, 1.0, 1.0)], true)[0].saved, None);
    assert_eq!(saved(vec![timed("nn-omni", 1, 1.0, 1.0), timed("rc-ert", 0, 1.0, 1.0)], true)[0].saved, None);
    // More fragments have no efficiency.
    let more = saved(vec![timed("nn-omni", 2000, 5.0, 1.0), timed("rc-ert", 1000, 10.0, 1.0)], true);
    assert_eq!(more[0].saved.as_ref().unwrap().efficiency(), None);
}

#[test]
fn form_is_compared_with_its_own() {
    let mut runs =
        vec![timed("rc-ert", 1000, 10.0, 1.0), timed("rc-ert", 1000, 20.0, 1.0), timed("nn-omni", 100, 5.0, 1.0)];
    (runs[1].cull, runs[1].mark) = (Some("discard".into()), Some("copy".into()));
    (runs[2].cull, runs[2].mark) = (Some("discard".into()), Some("copy".into()));
    assert_eq!(saved(runs.clone(), true)[2].saved.as_ref().unwrap().time, Some(0.75));
    runs[2].cull = Some("bounds".into());
    assert_eq!(saved(runs, true)[2].saved.as_ref().unwrap().time, Some(0.5), "else with the first");
}

#[test]
fn verdict_is_made_from_the_runs() {
    let of = |cpu: f64, fragments: u64| {
        let runs = saved(vec![timed("rc-ert", 1000, 10.0, 1.0), timed("nn-omni", fragments, cpu, 1.0)], true);
        verdict(&groups(&runs))
    };
    assert_eq!(
        of(4.0, 250),
        "On llvmpipe, fragments saved become time saved: nn-omni saves 75 % of the fragments of rc-ert and 60 % of its \
         time, a culling efficiency of 0.80."
    );
    assert!(of(11.0, 250).contains("fragments saved do not become time saved"), "{}", of(11.0, 250));
    assert!(of(11.0, 250).contains("-10 % of its time"));
    // Where there is nothing to skip nothing was shown.
    assert!(of(9.0, 1000).contains("saves no fragments of rc-ert in any scene"), "{}", of(9.0, 1000));
    assert!(verdict(&[]).contains("no runs"));
    let runs = saved(vec![timed("rc-ert", 1000, 10.0, 1.0)], true);
    assert!(verdict(&groups(&runs)).contains("no run of near-neighbor skipping was timed"));
    // Two scenes, one of which does not pay.
    let mut runs = saved(vec![timed("rc-ert", 1000, 10.0, 1.0), timed("nn-omni", 250, 4.0, 1.0)], true);
    let mut other = saved(vec![timed("rc-ert", 1000, 10.0, 1.0), timed("nn-optimal", 500, 10.5, 1.0)], true);
    other.iter_mut().for_each(|run| run.scene = "other".into());
    runs.extend(other);
    let words = verdict(&groups(&runs));
    assert!(words.contains("in 1 of 2 scenes: nn-omni or nn-optimal saves 50 to 75 %"), "{words}");
}

/// A loop's fragments are rays, which are not compared with segments; its time is compared with the fastest of the others.
#[test]
fn loops_are_compared_by_their_time() {
    let runs = |of_loop: f64| {
        let timed = vec![
            timed("rc-ert", 1000, 10.0, 12.0),
            timed("nn-omni", 250, 4.0, 8.0),
            timed("single-pass", 90, 9.0, 1.0),
            timed("single-pass-omni", 90, of_loop, 1.0),
            timed("cpu", 9, 0.5, 0.5),
        ];
        saved(timed, true)
    };
    let found = runs(3.0);
    let of_loop = found[3].saved.as_ref().unwrap();
    assert_eq!((of_loop.fragments, of_loop.efficiency()), (None, None));
    assert!((of_loop.time.unwrap() - 0.7).abs() < 1e-12);
    assert_eq!(
        branching(&groups(&found)).unwrap(),
        "On llvmpipe, structures built, the fastest loop of a single pass (single-pass-omni) takes 0.75 times as long as the fastest \
         ray caster of several passes (nn-omni): it is faster. Of the latter's time 50 % goes into what a loop does not have: all but \
         main passes."
    );
    assert!(branching(&groups(&runs(5.0))).unwrap().contains("1.25 times as long"));
    assert!(branching(&groups(&runs(5.0))).unwrap().contains("it is slower."));
    // Two scenes.
    let mut both = runs(3.0);
    both.extend(runs(5.0).into_iter().map(|mut run| {
        run.scene = "other".into();
        run
    }));
    let words = branching(&groups(&both)).unwrap();
    assert!(words.contains("0.75 to 1.25 times as long") && words.contains("faster in 1 of 2 scenes"), "{words}");
    // Without a loop there is nothing to say.
    assert_eq!(branching(&groups(&found[..2])), None);
    assert_eq!(branching(&[]), None);
}

/// Runs with 0, 1 and 4 extra fetches; times of `nn-omni` by cost in times of `rc-ert`.
fn swept(times: [f64; 3]) -> Vec<Run> {
    let runs = [0, 1, 4].into_iter().zip(times).flat_map(|(extra, time)| {
        let mut runs = saved(vec![timed("rc-ert", 1000, 10.0, 1.0), timed("nn-omni", 250, 10.0 * time, 1.0)], true);
        runs.iter_mut().for_each(|run| run.settings.sampling.extra_fetches = extra);
        runs
    });
    runs.collect()
}

#[test]
fn sweep_says_where_skipping_starts_to_pay() {
    let sweep = |times| {
        let runs = swept(times);
        let groups = groups(&runs);
        Sweep::of(&groups[0], &groups).unwrap()
    };
    let found = sweep([1.5, 0.75, 0.5]);
    assert_eq!((found.costs.clone(), found.rows.len()), (vec![0, 1, 4], 1));
    let close = |row: &CostRow, expected: [f64; 3]| {
        row.times.iter().zip(expected).all(|(time, expected)| (time.unwrap() - expected).abs() < 1e-12)
    };
    assert!(close(&found.rows[0], [1.5, 0.75, 0.5]), "{found:?}");
    assert_eq!(found.pays_from(&found.rows[0]), Some(1));
    assert!(found.words(&found.rows[0]).contains("from 1 extra"));
    // Once faster is not faster from there on.
    let found = sweep([0.9, 1.1, 0.5]);
    assert_eq!(found.pays_from(&found.rows[0]), Some(4));
    let never = sweep([1.2, 1.1, 1.0]);
    assert_eq!(never.pays_from(&never.rows[0]), None);
    assert!(never.words(&never.rows[0]).contains("does not pay up to 4"));
    let always = sweep([0.9, 0.8, 0.7]);
    assert!(always.words(&always.rows[0]).contains("at any cost"));
    assert!(cost_svg(&always).unwrap().contains("extra fetches a sample"));
    // One cost is no sweep.
    let runs = &swept([1.0; 3])[..2];
    assert_eq!(Sweep::of(&groups(runs)[0], &groups(runs)), None);
}

#[test]
fn sweep_is_shown_once_with_its_scene() {
    let runs = swept([1.5, 0.75, 0.5]);
    let text = table(&runs);
    assert_eq!(text.matches("cull + mark").count(), 1, "one table of a scene:\n{text}");
    for part in ["Time by the cost of a sample", "1.50", "0.75", "pays from 1 extra fetches", "efficiency", "75.0"] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let rows = csv(&Results { runs, ..results() }).unwrap();
    for column in ["saved_fragments", "saved_time", "culling_efficiency", "settings.sampling.extra_fetches"] {
        assert!(rows.lines().next().unwrap().contains(column), "{column}");
    }
}

/// A run of `passes` with those fragments and times, GPU milliseconds in all.
fn by_passes(method: &str, main: &[u64], ms: &[f64], total: f64) -> Run {
    let mut run = run(method, main, &vec![0; main.len()]);
    // No bound is told of what skips nothing and ends no rays.
    run.ideal = (method != "rc").then_some(Ideal { main: 80 });
    run.passes = main.len() as u32;
    run.gpu_ms_per_pass = Some(PassTimes { main: ms.to_vec(), intermediate: Vec::new() });
    if let Some(times) = &mut run.gpu_ms {
        times.0.iter_mut().filter(|(name, _)| name == "total").for_each(|(_, timing)| *timing = Timing::once(total));
    }
    run
}

#[test]
fn limit_is_what_shows_at_the_cost_of_all_and_empty_passes() {
    let all = by_passes("rc", &[100, 100, 100, 100], &[6.0, 6.0, 6.0, 6.0], 24.0);
    let omni = by_passes("nn-omni", &[40, 0, 0, 60], &[3.0, 1.0, 1.0, 3.0], 16.0);
    let labelled = [("rc".to_owned(), &all), ("nn-omni".to_owned(), &omni)];
    // An empty pass takes 1 ms, so that 400 segments take 20 ms; 80 of them 4 ms, and the passes 4 ms.
    let limit = Limit::of(&labelled, 80).expect("a limit");
    assert_eq!((limit.pass_ms, limit.any_is_empty, limit.clock), (1.0, true, Clock::Gpu));
    assert!((limit.segment_ms - 0.05).abs() < 1e-12 && (limit.ms - 8.0).abs() < 1e-12, "{limit:?}");
    assert_eq!(limit.distances, [("rc".to_owned(), 3.0), ("nn-omni".to_owned(), 2.0)]);
    assert!(
        limit.words().contains("80 segments at 50000 ns") && limit.words().contains("nn-omni 2.00"),
        "{}",
        limit.words()
    );
    // Other segments are of other length.
    let mut other = omni.clone();
    other.settings.sampling.samples_per_pass = 32;
    assert_eq!(Limit::of(&[("rc".to_owned(), &all), ("other".to_owned(), &other)], 80), None);
    // Without an empty pass it is the shortest that counts.
    let full = by_passes("rc-ert", &[90, 90, 90, 90], &[6.0, 6.0, 6.0, 5.0], 23.0);
    let limit = Limit::of(&[("rc".to_owned(), &all), ("rc-ert".to_owned(), &full)], 80).expect("a limit");
    assert_eq!((limit.distances.len(), limit.any_is_empty, limit.pass_ms), (2, false, 5.0));
    // Nor is one that was not run, since no ray was left, or one in live tiles.
    let ended = by_passes("rc-ert", &[90, 90, 90, 0], &[6.0, 6.0, 5.0, 0.1], 17.1);
    let mut in_tiles = by_passes("nn-omni", &[40, 0, 0, 60], &[3.0, 0.1, 0.1, 3.0], 6.2);
    in_tiles.settings.method.tiles = Tiles::Live;
    let runs = [("rc".to_owned(), &all), ("rc-ert".to_owned(), &ended), ("nn-omni".to_owned(), &in_tiles)];
    let limit = Limit::of(&runs, 80).expect("a limit");
    assert_eq!((limit.distances.len(), limit.any_is_empty, limit.pass_ms), (3, false, 5.0));
    assert_eq!(Limit::of(&[("nn-omni".to_owned(), &omni)], 80), None);
    assert_eq!(Limit::of(&labelled, 81), None, "of another length of segments");
    // By the process' clock, of which passes have their part.
    let by_cpu = |mut run: Run| {
        run.host.cpu = Some(Timing::once(2.0 * run.milliseconds(Clock::Gpu).unwrap()));
        run.saved = Some(Saved { against: "rc-ert".into(), fragments: None, time: None, clock: Some(Clock::Cpu) });
        run
    };
    let [all, omni] = [all, omni].map(by_cpu);
    let limit = Limit::of(&[("rc".to_owned(), &all), ("nn-omni".to_owned(), &omni)], 80).expect("a limit");
    assert_eq!((limit.clock, limit.pass_ms), (Clock::Cpu, 2.0));
    assert!((limit.ms - 16.0).abs() < 1e-12, "{limit:?}");
}
