//! One row a run, everything flat: the record for spreadsheets and data frames. An empty field is a `null` of the
//! results file. The columns, in this order:
//!
//! 1. Words and counts: `scene`, `view`, `method`, `cull`, `mark`, `passes`, `fragments_main`,
//!    `fragments_intermediate`, `invocations_main`, `invocations_intermediate`, `ideal_main`.
//! 2. Times in milliseconds, each as `X_ms` (the median), `X_ms_min`, `X_ms_max`, `X_ms_mad`, `X_ms_n`, for X =
//!    `gpu_total`, `frame`, `cpu`, `record`, `build`.
//! 3. `saved_fragments`, `saved_time` (parts of what `rc-ert` takes), `culling_efficiency` (the one by the other),
//!    `structure_bytes`, `memory_bytes` (the sum of all resources), `error_max` (`inf` where infinite), `error_rmse`,
//!    `error_psnr` (decibel), `error_undecided`, `error_reference`, `device`, `driver`.
//! 4. The document: `program`, `commit`, `command`, `date`, `version`.
//! 5. Lists in one field: `fragments_main_per_pass`, `fragments_intermediate_per_pass`,
//!    `invocations_main_per_pass`, `invocations_intermediate_per_pass`, `gpu_main_ms_per_pass`,
//!    `gpu_intermediate_ms_per_pass` (numbers with a space between, one more than `passes` where `layers.partial` is
//!    `apart`), `memory` (`NAME=BYTES`), `self_check`
//!    (`FORM=VERDICT`), `left_out` (`WHAT: WHY`), `plan`, `notes`, `warnings` (with `; ` between). How the volume was kept:
//!    `texture`, `texture_x_error`, `texture_pixel_error` (`inf` where there is no bound).
//! 6. Times of the groups of passes, `gpu_GROUP_ms` and so on as in 2, one set for each group that a run of the
//!    file has.
//! 7. The settings, `settings.SECTION.KEY`, one for each key that a run of the file has; arrays as JSON.

use std::collections::BTreeSet;
use std::fmt::Display;

use crate::error::{Error, Result};
use crate::measure::record::{CountsRecord, Results, Run, Saved};
use crate::measure::timing::Timing;
use crate::report::table::{Column, Table};

/// CsvFields of a row by column name, in the order of the columns.
type CsvFields = Vec<(String, String)>;

/// The whole file, heading first.
///
/// # Errors
/// When a row cannot be written, which only a fault of this program explains.
pub fn csv(results: &Results) -> Result<String> {
    let fixed: Vec<CsvFields> = results.runs.iter().map(|run| fixed_fields(results, run)).collect();
    let groups: Vec<CsvFields> = results.runs.iter().map(group_fields).collect();
    let settings: Vec<CsvFields> = results.runs.iter().map(settings_fields).collect::<Result<_>>()?;

    let group_columns = in_order_of_appearance(&groups);
    let settings_columns: BTreeSet<&str> = settings.iter().flatten().map(|(name, _)| name.as_str()).collect();
    let Some(first) = fixed.first() else {
        return Ok(String::new());
    };
    let heading = first.iter().map(|(name, _)| name.as_str()).chain(group_columns.iter().copied());
    let mut table = Table::new(heading.chain(settings_columns.iter().copied()).map(Column::words).collect());
    for ((fixed, groups), settings) in fixed.iter().zip(&groups).zip(&settings) {
        let row = fixed.iter().map(|(_, value)| value.as_str());
        let row = row.chain(group_columns.iter().map(|column| field(groups, column)));
        table.row(row.chain(settings_columns.iter().map(|column| field(settings, column))));
    }
    table.csv()
}

fn in_order_of_appearance(rows: &[CsvFields]) -> Vec<&str> {
    let mut columns: Vec<&str> = Vec::new();
    for (name, _) in rows.iter().flatten() {
        if !columns.contains(&name.as_str()) {
            columns.push(name);
        }
    }
    columns
}

fn field<'a>(row: &'a CsvFields, column: &str) -> &'a str {
    row.iter().find(|(name, _)| name == column).map_or("", |(_, value)| value)
}

fn fixed_fields(results: &Results, run: &Run) -> CsvFields {
    let mut row = CsvFields::new();
    let mut put = |name: &str, value: String| row.push((name.to_string(), value));
    put("scene", run.scene.clone());
    put("view", run.view.clone());
    put("method", run.method.clone());
    put("cull", or_empty(run.cull.as_ref()));
    put("mark", or_empty(run.mark.as_ref()));
    put("passes", run.passes.to_string());
    put("fragments_main", run.fragments.main.to_string());
    put("fragments_intermediate", run.fragments.intermediate.to_string());
    put("invocations_main", or_empty(run.invocations.as_ref().map(|c| c.main)));
    put("invocations_intermediate", or_empty(run.invocations.as_ref().map(|c| c.intermediate)));
    put("ideal_main", or_empty(run.ideal.map(|i| i.main)));

    let total = run.gpu_ms.as_ref().and_then(|times| times.total());
    let host = &run.host;
    let times = [
        ("gpu_total", total),
        ("frame", host.frame.as_ref()),
        ("cpu", host.cpu.as_ref()),
        ("record", host.record.as_ref()),
        ("build", host.build.as_ref()),
    ];
    row.extend(times.iter().flat_map(|(name, timing)| time_fields(name, *timing)));

    let mut put = |name: &str, value: String| row.push((name.to_string(), value));
    let error = run.error.as_ref();
    let saved = run.saved.as_ref();
    put("saved_fragments", or_empty(saved.and_then(|s| s.fragments)));
    put("saved_time", or_empty(saved.and_then(|s| s.time)));
    put("culling_efficiency", or_empty(saved.and_then(Saved::efficiency)));
    put("structure_bytes", run.bytes.to_string());
    put("memory_bytes", run.memory.values().fold(0_u64, |sum, b| sum.saturating_add(*b)).to_string());
    put("error_max", or_empty(error.map(|e| e.max)));
    put("error_rmse", or_empty(error.map(|e| e.rmse)));
    put("error_psnr", or_empty(error.and_then(|e| e.psnr)));
    put("error_undecided", or_empty(error.map(|e| e.undecided)));
    put("error_reference", or_empty(error.map(|e| &e.reference)));
    put("device", run.device.clone());
    put("driver", run.driver.clone());
    put("program", results.provenance.program.clone());
    put("commit", results.provenance.commit.clone());
    put("command", results.provenance.command.clone());
    put("date", results.provenance.date.clone());
    put("version", run.version.to_string());

    let per_pass =
        |counts: Option<&CountsRecord>, of: fn(&CountsRecord) -> &Vec<u64>| or_empty(counts.map(|c| join(of(c), " ")));
    let (fragments, invocations) = (Some(&run.fragments), run.invocations.as_ref());
    let pass_times = run.gpu_ms_per_pass.as_ref();
    put("fragments_main_per_pass", per_pass(fragments, |c| &c.main_per_pass));
    put("fragments_intermediate_per_pass", per_pass(fragments, |c| &c.intermediate_per_pass));
    put("invocations_main_per_pass", per_pass(invocations, |c| &c.main_per_pass));
    put("invocations_intermediate_per_pass", per_pass(invocations, |c| &c.intermediate_per_pass));
    put("gpu_main_ms_per_pass", or_empty(pass_times.map(|t| join(&t.main, " "))));
    put("gpu_intermediate_ms_per_pass", or_empty(pass_times.map(|t| join(&t.intermediate, " "))));
    put("memory", join(run.memory.iter().map(|(name, bytes)| format!("{name}={bytes}")), "; "));
    put("self_check", join(run.self_check.iter().map(|(form, verdict)| format!("{form}={verdict}")), "; "));
    put("left_out", join(run.left_out.iter().map(|l| format!("{}: {}", l.what, l.why)), "; "));
    put("plan", join(&run.plan, "; "));
    put("notes", join(&run.notes, "; "));
    put("warnings", join(&run.warnings, "; "));
    let texture = run.texture.as_ref();
    put("texture", or_empty(texture.map(|texture| &texture.format)));
    put("texture_x_error", or_empty(texture.map(|texture| texture.x_error)));
    put("texture_pixel_error", or_empty(texture.map(|texture| texture.pixel_error)));
    row
}

fn group_fields(run: &Run) -> CsvFields {
    let groups = run.gpu_ms.iter().flat_map(|times| times.groups());
    groups.flat_map(|(name, timing)| time_fields(&format!("gpu_{name}"), Some(timing))).collect()
}

fn time_fields(name: &str, timing: Option<&Timing>) -> CsvFields {
    let stats = timing.and_then(|t| t.stats);
    vec![
        (format!("{name}_ms"), or_empty(timing.map(|t| t.value))),
        (format!("{name}_ms_min"), or_empty(stats.map(|s| s.min))),
        (format!("{name}_ms_max"), or_empty(stats.map(|s| s.max))),
        (format!("{name}_ms_mad"), or_empty(stats.map(|s| s.mad))),
        (format!("{name}_ms_n"), or_empty(stats.map(|s| s.n))),
    ]
}

fn settings_fields(run: &Run) -> Result<CsvFields> {
    let value = serde_json::to_value(&run.settings).map_err(|e| {
        Error::output("settings", format!("cannot be written ({e})"), "check paths for names that are not UTF-8")
    })?;
    let mut row = CsvFields::new();
    flatten("settings", &value, &mut row);
    Ok(row)
}

fn flatten(name: &str, value: &serde_json::Value, row: &mut CsvFields) {
    match value {
        serde_json::Value::Object(map) => {
            for (key, value) in map {
                flatten(&format!("{name}.{key}"), value, row);
            }
        }
        serde_json::Value::Null => row.push((name.to_string(), String::new())),
        serde_json::Value::String(text) => row.push((name.to_string(), text.clone())),
        other => row.push((name.to_string(), other.to_string())),
    }
}

fn or_empty(value: Option<impl Display>) -> String {
    value.map(|v| v.to_string()).unwrap_or_default()
}

fn join(items: impl IntoIterator<Item = impl Display>, between: &str) -> String {
    items.into_iter().map(|item| item.to_string()).collect::<Vec<_>>().join(between)
}
