//! How the time of a frame grows with what it has to draw: the same methods, settings and view on several volumes, against the segments
//! that show something.

use super::comparison::{RunGroup, comparable, label_with_form};
use super::number::thousands;
use super::table::{Column, Table};
use crate::measure::record::{Clock, Run};

/// Scenes that tell a line from a bend.
const LEAST_SCENES: usize = 3;

const NANOSECONDS: f64 = 1e6;

/// Times of the methods that were run on all of the scenes.
#[derive(Clone, Debug, PartialEq)]
pub struct Growth {
    /// The built-in volume that all of them show, in several sizes; none of files.
    pub object: Option<String>,
    pub clock: Clock,
    /// Each with the segments that show something, rising.
    pub scenes: Vec<(String, u64)>,
    pub rows: Vec<GrowthRow>,
}

/// One method.
#[derive(Clone, Debug, PartialEq)]
pub struct GrowthRow {
    pub label: String,
    /// Milliseconds of a frame of each scene.
    pub times: Vec<f64>,
    pub line: Line,
}

/// The line of least squares: milliseconds of a frame with nothing to show, of each further segment, and the part of the
/// variance of times that it explains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    pub base: f64,
    pub each: f64,
    pub explained: f64,
}

impl Line {
    /// Of points that are not all above one another.
    pub fn through(points: &[[f64; 2]]) -> Self {
        let count = points.len() as f64;
        let mean = [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / count);
        let sum =
            |a: usize, b: usize| points.iter().map(|point| (point[a] - mean[a]) * (point[b] - mean[b])).sum::<f64>();
        let each = sum(0, 1) / sum(0, 0);
        let explained = if sum(1, 1) > 0.0 { each * sum(0, 1) / sum(1, 1) } else { 1.0 };
        Self { base: mean[1] - each * mean[0], each, explained }
    }
}

/// The built-in volume of a run without its size.
fn object(run: &Run) -> Option<&str> {
    run.settings.volume.builtin.as_deref()?.split(':').next()
}

/// Whether two runs differ in method and volume only, and built-in volumes in nothing but their sizes.
fn alike_but_for_volume(a: &Run, b: &Run) -> bool {
    let free = |run: &Run| {
        let mut run = run.clone();
        run.scene.clear();
        run.settings.volume = Default::default();
        run
    };
    object(a) == object(b) && comparable(&free(a), &free(b))
}

fn ideal(group: &RunGroup) -> Option<u64> {
    group.runs.iter().find_map(|(_, run)| run.ideal).map(|ideal| ideal.main)
}

impl Growth {
    /// Of all scenes of the groups that differ in their volumes only, of built-in ones in their sizes; none of fewer than three.
    pub fn all(groups: &[RunGroup]) -> Vec<Self> {
        let mut sets: Vec<Vec<&RunGroup>> = Vec::new();
        for group in groups.iter().filter(|group| ideal(group).is_some()) {
            match sets.iter_mut().find(|set| alike_but_for_volume(set[0].first(), group.first())) {
                Some(set) => set.push(group),
                None => sets.push(vec![group]),
            }
        }
        sets.into_iter().filter_map(Self::of).collect()
    }

    fn of(mut groups: Vec<&RunGroup>) -> Option<Self> {
        groups.sort_by_key(|group| ideal(group));
        let alike = groups.first().map(|group| ideal(group)) == groups.last().map(|group| ideal(group));
        if groups.len() < LEAST_SCENES || alike {
            return None;
        }
        let runs = || groups.iter().flat_map(|group| group.runs.iter().map(|(_, run)| *run));
        let clock = runs().find_map(|run| run.saved.as_ref()?.clock).unwrap_or(Clock::Gpu);
        let scenes: Vec<(String, u64)> =
            groups.iter().filter_map(|group| Some((group.first().scene.clone(), ideal(group)?))).collect();
        let time = |group: &&RunGroup, wanted: &str| {
            let found = group.runs.iter().map(|(_, run)| *run).find(|run| label_with_form(run) == wanted)?;
            found.milliseconds(clock)
        };
        let row = |(_, run): &(usize, &Run)| {
            let label = label_with_form(run);
            let times: Option<Vec<f64>> = groups.iter().map(|group| time(group, &label)).collect();
            let times = times?;
            let points: Vec<[f64; 2]> =
                scenes.iter().zip(&times).map(|((_, segments), time)| [*segments as f64, *time]).collect();
            Some(GrowthRow { label, line: Line::through(&points), times })
        };
        let rows: Vec<GrowthRow> =
            groups[0].runs.iter().filter(|(_, run)| run.method != "cpu").filter_map(row).collect();
        let object = object(groups[0].first()).map(str::to_owned);
        (!rows.is_empty()).then_some(Self { object, clock, scenes, rows })
    }

    /// A method, its line, and its times by the segments that show something.
    pub fn table(&self) -> Table {
        let scenes = self.scenes.iter().map(|(_, segments)| Column::numbers(thousands(*segments)));
        let line = ["frame alone ms", "ns a segment", "explained %"].map(Column::numbers);
        let columns = [Column::words("segments that show something")].into_iter().chain(scenes).chain(line);
        let mut table = Table::new(columns.collect());
        for row in &self.rows {
            let times = row.times.iter().map(|time| format!("{time:.2}"));
            let Line { base, each, explained } = row.line;
            let line =
                [format!("{base:.2}"), format!("{:.1}", each * NANOSECONDS), format!("{:.1}", 100.0 * explained)];
            table.row(std::iter::once(row.label.clone()).chain(times).chain(line));
        }
        table
    }
}
