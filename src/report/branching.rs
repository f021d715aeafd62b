//! Culling by fixed function against branching in a shader: the fastest ray caster of several passes beside the fastest loop of a
//! single pass [Stegmaier05 §7].

use crate::measure::fragment_kind::FragmentKind;
use crate::measure::record::Run;
use crate::report::comparison::{RunGroup, label};
use crate::report::cost::{extra_fetches, least_cost};

/// The fastest run of each kind of a scene.
struct Rivals {
    passes: String,
    /// Of the time of the device, what goes into anything but main passes; none where it has no timestamps.
    beside_main: Option<f64>,
    one_loop: String,
    /// The loop's time in times of that of the passes.
    ratio: f64,
}

/// Which of the two is faster on this device, in two sentences made from the runs; none where one of them was not timed in any scene.
pub fn branching(groups: &[RunGroup]) -> Option<String> {
    let plain = groups.iter().filter(|group| extra_fetches(group) == least_cost(group, groups));
    let rivals: Vec<Rivals> = plain.filter_map(rivals).collect();
    let device = &groups.first()?.first().device;
    let (least, most) = range(rivals.iter().map(|rivals| rivals.ratio))?;
    let faster = rivals.iter().filter(|rivals| rivals.ratio < 1.0).count();
    let scenes = match (faster, rivals.len()) {
        (0, 1) => "it is slower".to_owned(),
        (1, 1) => "it is faster".to_owned(),
        (0, all) => format!("it is slower in all {all} scenes"),
        (some, all) if some == all => format!("it is faster in all {all} scenes"),
        (some, all) => format!("it is faster in {some} of {all} scenes"),
    };
    let names = |of: fn(&Rivals) -> &String| {
        let mut names: Vec<&str> = rivals.iter().map(|rivals| of(rivals).as_str()).collect();
        names.sort_unstable();
        names.dedup();
        names.join(" or ")
    };
    let (loops, passes) = (names(|rivals| &rivals.one_loop), names(|rivals| &rivals.passes));
    let mut text = format!(
        "On {device}, structures built, the fastest loop of a single pass ({loops}) takes {} times as long as the fastest ray caster \
         of several passes ({passes}): {scenes}.",
        words(least, most, 2)
    );
    if let Some((least, most)) = range(rivals.iter().filter_map(|rivals| rivals.beside_main)) {
        let share = words(100.0 * least, 100.0 * most, 0);
        text.push_str(&format!(
            " Of the latter's time {share} % goes into what a loop does not have: all but main passes."
        ));
    }
    Some(text)
}

/// The rivals of a scene; none where it has no run of `rc-ert`, by whose clock times are compared.
fn rivals(group: &RunGroup) -> Option<Rivals> {
    let clock = group.runs.iter().find_map(|(_, run)| run.saved.as_ref()?.clock)?;
    let timed = |kinds: &'static [FragmentKind]| {
        let of_kind = |run: &&Run| run.fragment_kind().is_some_and(|kind| kinds.contains(&kind));
        let runs = group.runs.iter().map(|(_, run)| *run).filter(|run| !run.is_chosen_freely()).filter(of_kind);
        let timed = runs.filter_map(|run| Some((run, run.milliseconds(clock)?)));
        timed.min_by(|a, b| a.1.total_cmp(&b.1))
    };
    let ((passes, of_passes), (one_loop, of_loop)) =
        (timed(&[FragmentKind::Segment])?, timed(&[FragmentKind::Ray, FragmentKind::Pixel])?);
    let ratio = of_loop / of_passes;
    ratio.is_finite().then(|| Rivals {
        passes: label(passes),
        beside_main: beside_main(passes),
        one_loop: label(one_loop),
        ratio,
    })
}

/// The part of a frame's time on the device that does not go into main passes.
fn beside_main(run: &Run) -> Option<f64> {
    let times = run.gpu_ms.as_ref()?;
    let main = times.groups().find(|(name, _)| *name == "main")?.1.value;
    let total = times.total()?.value;
    (total > 0.0).then(|| (1.0 - main / total).max(0.0))
}

/// The least and the greatest; none of nothing.
fn range(numbers: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    numbers.fold(None, |range, x| {
        range.map_or(Some((x, x)), |(least, most): (f64, f64)| Some((least.min(x), most.max(x))))
    })
}

fn words(least: f64, most: f64, digits: usize) -> String {
    let (least, most) = (format!("{least:.digits$}"), format!("{most:.digits$}"));
    if least == most { least } else { format!("{least} to {most}") }
}
