//! Runs cases on a device, and keeps what comes of it.

use std::path::Path;
use std::time::Instant;

use super::{CaseRecord, FORMAT, OnDevice, Stability, StabilityCase, judge};
use crate::error::Result;
use crate::experiment::Host;
use crate::measure::write::{create_folder, write_json};
use crate::provenance::Provenance;
use crate::scene::settings::MethodName;

/// Every one of `methods` on every one of `cases`.
///
/// # Errors
/// When there is no device, or nothing to hold a case against; what is wrong with a picture is an outcome.
pub fn run(cases: &[StabilityCase], methods: &[MethodName], host: &Host) -> Result<Stability> {
    let checked = (host.open)()?;
    let provenance = Provenance::now(FORMAT);
    let mut records = Vec::with_capacity(cases.len());
    let mut integrator = OnDevice::new(&checked);
    for (i, case) in cases.iter().enumerate() {
        (host.say)(&format!("{} of {}: {}", i + 1, cases.len(), case.name));
        let begin = Instant::now();
        let outcomes = judge(case, methods, &mut integrator)?;
        records.push(CaseRecord::new(case, outcomes, begin.elapsed().as_secs_f64() * 1e3));
    }
    drop(integrator);
    let info = checked.device.info.clone();
    (host.close)(checked)?;
    let driver = format!("{} {}", info.driver_name, info.driver_info);
    Ok(Stability { provenance, device: info.name, driver, cases: records })
}

/// Keeps what was found in `folder`.
///
/// # Errors
/// When the file cannot be written.
pub fn keep(folder: &Path, found: &Stability) -> Result<()> {
    create_folder(folder)?;
    write_json(&folder.join("stability.json"), found)
}
