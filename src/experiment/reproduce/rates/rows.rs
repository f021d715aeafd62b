//! The rows of the frame rates: the paper's, ours, and the ratios of both among data sets and among renderers.

use super::super::rows::{Finding, judged, sweep};
use super::super::{ReproducedSet, TimedRecord, Variant};
use super::{RateSet, RateTable, Renderer};
use crate::measure::Run;
use crate::measure::fragment_kind::FragmentKind;
use crate::measure::record::Clock;

/// A data set in a viewport by one way of rendering.
#[derive(Clone)]
pub struct RateLine {
    pub set: &'static RateSet,
    /// Side of the viewport, pixels.
    pub size: u32,
    pub renderer: &'static Renderer,
    /// Frames per second in the paper; none where it has none.
    pub theirs: Option<f64>,
    /// Frames per second here, by the wall clock.
    pub ours: Option<Rate>,
    /// To the set that the others are told in, by the same renderer in the same viewport; none where the table has no such set.
    pub to_set: Option<RateRatio>,
    /// To the renderer that the others are told in, of the same set in the same viewport.
    pub to_renderer: RateRatio,
    /// Main and intermediate fragments of a frame here, on average over all directions.
    pub fragments: Option<[f64; 2]>,
}

/// Frames per second to others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RateRatio {
    pub theirs: Option<f64>,
    /// By the wall clock.
    pub ours: Option<f64>,
    /// By the clock that times are compared by on this device.
    pub clock: Option<f64>,
    /// Least and greatest of `ours` over all choices.
    pub sweep: Option<[f64; 2]>,
}

/// Frames per second over all directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rate {
    /// Of all frames together: their number divided by their time.
    pub average: f64,
    pub least: f64,
    pub greatest: f64,
}

impl Rate {
    /// Of frames that took so many milliseconds each; none without any, or where a time is none.
    pub fn of(milliseconds: &[f64]) -> Option<Self> {
        let shortest = milliseconds.iter().copied().reduce(f64::min).filter(|ms| *ms > 0.0)?;
        let longest = milliseconds.iter().copied().reduce(f64::max)?;
        let per_second = |ms: f64| MILLISECONDS / ms;
        let mean = milliseconds.iter().sum::<f64>() / milliseconds.len() as f64;
        Some(Self { average: per_second(mean), least: per_second(longest), greatest: per_second(shortest) })
    }
}

/// In a second.
const MILLISECONDS: f64 = 1000.0;

/// A line for each data set, viewport and renderer of a table, in its order.
pub fn rate_lines(timed: &TimedRecord, table: &'static RateTable) -> Vec<RateLine> {
    let mut lines = Vec::new();
    for set in table.sets {
        for size in 0..table.sizes.len() {
            lines.extend((0..table.renderers.len()).map(|renderer| line(timed, table, set, [renderer, size])));
        }
    }
    lines
}

/// What a data set came to by one way of rendering in one viewport, given by their places in the table.
fn line(
    timed: &TimedRecord,
    table: &'static RateTable,
    set: &'static RateSet,
    [renderer, size]: [usize; 2],
) -> RateLine {
    let theirs = |set: &RateSet, renderer: usize| set.theirs.get(renderer)?.get(size).copied();
    let (renderer_row, pixels) = (&table.renderers[renderer], table.sizes[size]);
    let column = column_of(timed, table, set);
    let main = column.and_then(|column| column.variants.first());
    let ratio = |other: Option<f64>, ours: &dyn Fn(&Variant, Clock) -> Option<f64>| RateRatio {
        theirs: theirs(set, renderer).zip(other).map(|(part, whole)| part / whole),
        ours: main.and_then(|variant| ours(variant, Clock::Wall)),
        clock: main.and_then(|variant| ours(variant, timed.clock?)),
        sweep: column.and_then(|column| sweep(column, |variant| ours(variant, Clock::Wall))),
    };
    RateLine {
        set,
        size: pixels,
        renderer: renderer_row,
        theirs: theirs(set, renderer),
        ours: main.and_then(|variant| rate(variant, renderer_row, pixels, Clock::Wall)),
        to_set: table.told_in().map(|base| {
            ratio(theirs(base, renderer), &|variant, clock| to_set(timed, table, variant, renderer_row, pixels, clock))
        }),
        to_renderer: ratio(theirs(set, table.base), &|variant, clock| {
            to_renderer(table, variant, renderer_row, pixels, clock)
        }),
        fragments: main.and_then(|variant| fragments(variant, renderer_row, pixels)),
    }
}

/// What was timed of a data set of a table.
pub fn column_of<'a>(timed: &'a TimedRecord, table: &RateTable, set: &RateSet) -> Option<&'a ReproducedSet> {
    timed.rates.iter().find(|column| column.name == set.name && column.source == table.source(set))
}

/// Frames per second to those of the set that the others are told in, with the same choice; none where that was not timed.
pub fn to_set(
    timed: &TimedRecord,
    table: &RateTable,
    variant: &Variant,
    renderer: &Renderer,
    size: u32,
    clock: Clock,
) -> Option<f64> {
    let average = |variant| rate(variant, renderer, size, clock).map(|rate| rate.average);
    let base = &column_of(timed, table, table.told_in()?)?.variants;
    let same = base.iter().find(|other| (&other.choice, &other.value) == (&variant.choice, &variant.value));
    Some(average(variant)? / average(same?)?)
}

/// Frames per second to those of the renderer that the others are told in; none where that was not timed.
pub fn to_renderer(table: &RateTable, variant: &Variant, renderer: &Renderer, size: u32, clock: Clock) -> Option<f64> {
    let average = |renderer| rate(variant, renderer, size, clock).map(|rate| rate.average);
    Some(average(renderer)? / average(table.base_renderer())?)
}

/// The runs of a variant by one way of rendering in one viewport.
fn runs<'a>(variant: &'a Variant, renderer: &'a Renderer, size: u32) -> impl Iterator<Item = &'a Run> {
    let is_its_own = |run: &&Run| {
        let mut settings = run.settings.clone();
        (renderer.adapt)(&mut settings);
        settings == run.settings
    };
    let of_size = move |run: &&Run| run.method == renderer.method.name && run.settings.image.size == [size; 2];
    variant.runs.iter().filter(of_size).filter(is_its_own)
}

/// Frames per second of a variant by one way of rendering in one viewport; none where it was not timed.
pub fn rate(variant: &Variant, renderer: &Renderer, size: u32, clock: Clock) -> Option<Rate> {
    let times: Option<Vec<f64>> = runs(variant, renderer, size).map(|run| run.milliseconds(clock)).collect();
    Rate::of(&times?)
}

/// Main and intermediate fragments of a frame, on average; none where none was run.
fn fragments(variant: &Variant, renderer: &Renderer, size: u32) -> Option<[f64; 2]> {
    let counts = || runs(variant, renderer, size).map(|run| &run.fragments);
    let frames = counts().count() as f64;
    let mean = |sum: u64| sum as f64 / frames;
    (frames > 0.0).then(|| {
        [mean(counts().map(|counts| counts.main).sum()), mean(counts().map(|counts| counts.intermediate).sum())]
    })
}

/// What the ratios of a table come to, a sentence or two for each renderer and for the renderers among each other.
pub fn rate_verdicts(table: &RateTable, lines: &[RateLine]) -> Vec<String> {
    let finding = |line: &RateLine, ratio: RateRatio, name: String| {
        Some(Finding { name, theirs: ratio.theirs?, ours: ratio.ours?, sweep: ratio.sweep })
            .filter(|_| line.ours.is_some())
    };
    let named = |line: &RateLine| format!("{} {}^2", line.set.name, line.size);
    let mut verdicts = Vec::new();
    if let Some(base) = table.told_in() {
        for renderer in table.renderers {
            let of = lines.iter().filter(|line| line.renderer.name == renderer.name && line.set.name != base.name);
            let findings = of.filter_map(|line| finding(line, line.to_set?, named(line)));
            let found = judged(findings, &format!("{}'s frames per second", base.name));
            verdicts.extend(found.map(|found| format!("{} by {}: {found}", renderer.name, renderer.method.name)));
        }
    }
    let base = table.base_renderer();
    let others = lines.iter().filter(|line| line.renderer.name != base.name);
    let findings =
        others.filter_map(|line| finding(line, line.to_renderer, format!("{} by {}", named(line), line.renderer.name)));
    verdicts.extend(judged(findings, &format!("{}'s frames per second", base.name)));
    verdicts
}

/// Where the ratios of renderers come from: what each draws of the fragments of the one that the others are told in.
pub fn explained(table: &RateTable, lines: &[RateLine]) -> Vec<String> {
    let base = table.base_renderer();
    let sentence = |line: &RateLine| {
        let same = |other: &&RateLine| {
            (other.set.name, other.size, other.renderer.name) == (line.set.name, line.size, base.name)
        };
        let ([main, intermediate], [whole, _]) = (line.fragments?, lines.iter().find(same)?.fragments?);
        let kind_of = |renderer: &Renderer| FragmentKind::of(renderer.method.name);
        let (kind, base_kind) = (kind_of(line.renderer)?, kind_of(base)?);
        // A share of what is of another kind would say nothing.
        let drawn = match kind == base_kind {
            true => format!("{:.1} % of {}'s main fragments", 100.0 * main / whole, base.name),
            false => format!("{:.2} {} for each of {}'s {}", main / whole, kind.noun(), base.name, base_kind.noun()),
        };
        let added = match intermediate > 0.0 {
            true => format!(" and {:.2} intermediate ones for each of its own", intermediate / main),
            false => String::new(),
        };
        let (name, rate) = (line.renderer.name, line.to_renderer.clock?);
        Some(format!(
            "{} {}^2, {name}: {drawn}{added}, in {:.1} % of {}'s time",
            line.set.name,
            line.size,
            100.0 / rate,
            base.name,
        ))
    };
    lines.iter().filter(|line| line.renderer.name != base.name).filter_map(sentence).collect()
}
