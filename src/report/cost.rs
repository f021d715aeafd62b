//! How what a method saves depends on the cost of a sample: the same scene with ever more extra fetches.

use super::comparison::{RunGroup, comparable, label_with_form};
use super::table::{Column, Table};
use crate::measure::record::Run;
use crate::measure::saving::AGAINST;

/// Time of each method by extra fetches, in times of `rc-ert` with as many.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// Extra fetches a sample, rising from 0.
    pub costs: Vec<u32>,
    pub rows: Vec<CostRow>,
}

/// One method.
#[derive(Clone, Debug, PartialEq)]
pub struct CostRow {
    pub label: String,
    /// Parts of the time of `rc-ert`, one for each cost; none where it was not timed.
    pub times: Vec<Option<f64>>,
}

/// How many extra fetches a group's samples have.
pub fn extra_fetches(group: &RunGroup) -> u32 {
    group.first().settings.sampling.extra_fetches
}

/// Whether two runs differ in cost and method only.
fn alike_but_for_cost(a: &Run, b: &Run) -> bool {
    let free = |run: &Run| {
        let mut run = run.clone();
        run.settings.sampling.extra_fetches = 0;
        run
    };
    comparable(&free(a), &free(b))
}

/// The fewest extra fetches that the scene of `group` was run with.
pub fn least_cost(group: &RunGroup, groups: &[RunGroup]) -> u32 {
    let same = groups.iter().filter(|other| alike_but_for_cost(other.first(), group.first()));
    same.map(extra_fetches).min().unwrap_or_default()
}

impl Sweep {
    /// Of the scene of `base`, among all groups; none where it was run with one cost only.
    pub fn of(base: &RunGroup, groups: &[RunGroup]) -> Option<Self> {
        let alike = |group: &&RunGroup| alike_but_for_cost(group.first(), base.first());
        let mut same: Vec<&RunGroup> = groups.iter().filter(alike).collect();
        same.sort_by_key(|group| extra_fetches(group));
        if same.len() < 2 {
            return None;
        }
        let time = |group: &&RunGroup, wanted: &str| {
            let found = group.runs.iter().find(|(_, run)| label_with_form(run) == wanted)?;
            Some(1.0 - found.1.saved.as_ref()?.time?)
        };
        let runs = base.runs.iter().map(|(_, run)| *run).filter(|run| run.method != AGAINST && run.method != "cpu");
        let rows = runs.map(|run| {
            let label = label_with_form(run);
            CostRow { times: same.iter().map(|group| time(group, &label)).collect(), label }
        });
        Some(Self { costs: same.iter().map(|group| extra_fetches(group)).collect(), rows: rows.collect() })
    }

    /// The fewest extra fetches from which on a method is faster than `rc-ert`.
    pub fn pays_from(&self, row: &CostRow) -> Option<u32> {
        let faster = |time: &Option<f64>| time.is_some_and(|time| time < 1.0);
        let slower = row.times.iter().rposition(|time| !faster(time));
        self.costs.get(slower.map_or(0, |last| last + 1)).copied()
    }

    /// `pays from 4 extra fetches a sample on`.
    pub fn words(&self, row: &CostRow) -> String {
        match self.pays_from(row) {
            Some(0) => "pays at any cost of a sample".to_owned(),
            Some(from) => format!("pays from {from} extra fetches a sample on"),
            None => format!("does not pay up to {} extra fetches a sample", self.costs.last().unwrap_or(&0)),
        }
    }

    /// A method, its times by cost, and where it starts to pay.
    pub fn table(&self) -> Table {
        let costs = self.costs.iter().map(|cost| Column::numbers(cost.to_string()));
        let columns = [Column::words("extra fetches")].into_iter().chain(costs).chain([Column::words("")]);
        let mut table = Table::new(columns.collect());
        let cell = |time: &Option<f64>| time.map_or("-".to_owned(), |time| format!("{time:.2}"));
        for row in &self.rows {
            let times = row.times.iter().map(cell);
            table.row(std::iter::once(row.label.clone()).chain(times).chain([self.words(row)]));
        }
        table
    }
}
