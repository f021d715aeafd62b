//! What the papers state of passes and fragments in words, and what it is here.

use super::record::StatedRecord;
use super::stated_run::{COUNTED, EVERY_PASS};
use super::{ReproducedSet, Variant};
use crate::measure::Run;
use crate::measure::record::Clock;
use crate::report::number::{milliseconds, thousands};
use crate::report::table::{Column, Table};

/// The title of the table.
pub const STATED_TITLE: &str = "Passes and fragments, as the papers state them in words";

/// The parts of all fragments of slices that KW03 saw contribute to its pictures.
pub const CONTRIBUTING: [f64; 2] = [0.002, 0.04];

/// A row for each statement and each volume that it was held against; none where nothing was run.
pub fn stated_table(stated: &StatedRecord, clock: Option<Clock>) -> Option<Table> {
    let mut table = Table::new(["of", "source", "stated", "here"].map(Column::words).to_vec());
    let mut rows: Vec<[String; 4]> = stated.slices.iter().flat_map(slices_rows).collect();
    rows.extend(propagation_row(&stated.propagation, clock));
    let any = !rows.is_empty();
    rows.into_iter().for_each(|row| table.row(row));
    any.then_some(table)
}

/// How many fragments of slices contribute, for each transfer function.
fn slices_rows(set: &ReproducedSet) -> Vec<[String; 4]> {
    let row = |variant: &Variant| {
        let (part, all) = contributing(variant)?;
        let [least, most] = CONTRIBUTING.map(|part| 100.0 * part);
        Some([
            format!("fragments of slices that contribute: {}, {}", set.name, variant.value),
            set.source.clone(),
            format!("{least} to {most} %"),
            format!("{:.2} % of {}", 100.0 * part, thousands(all)),
        ])
    };
    set.variants.iter().filter_map(row).collect()
}

/// The part of all fragments of slices that bring something before their rays end, and how many there are.
pub fn contributing(variant: &Variant) -> Option<(f64, u64)> {
    let [all, ideal] = &variant.runs[..] else { return None };
    let (all, ideal) = (all.fragments.main, ideal.ideal.as_ref()?.main);
    (all > 0).then(|| (ideal as f64 / all as f64, all))
}

/// What passes cost that no ray takes part in.
fn propagation_row(set: &ReproducedSet, clock: Option<Clock>) -> Option<[String; 4]> {
    let run = |value: &str| set.variants.iter().find(|variant| variant.value == value)?.runs.first();
    let (counted, every) = (run(COUNTED)?, run(EVERY_PASS)?);
    let with_fragments = |run: &Run| run.fragments.main_per_pass.iter().filter(|fragments| **fragments > 0).count();
    let times = clock.and_then(|clock| counted.milliseconds(clock).zip(every.milliseconds(clock)));
    let times = times.map_or_else(String::new, |(counted, every)| {
        let more = 100.0 * (every / counted - 1.0);
        format!("; {} ms, {} ms where every pass runs: {more:+.0} %", milliseconds(counted), milliseconds(every))
    });
    Some([
        format!("passes behind the last ray of the propagation: {}", set.name),
        set.source.clone(),
        "\"overhead of additional rendering passes neglectable\"".to_owned(),
        format!("{} of {} passes have fragments{times}", with_fragments(every), every.passes),
    ])
}
