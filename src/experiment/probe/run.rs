//! Probes a device, and keeps what comes of it.

use std::path::Path;
use std::sync::Arc;

use crate::error::Result;
use crate::measure::write::{create_folder, write_json};
use crate::probe::Probe;
use crate::probe::record::{DeviceRecord, FORMAT};
use crate::probe::run::{Findings, probe};
use crate::provenance::Provenance;
use crate::vulkan::Device;

/// # Errors
/// What the driver reports.
pub fn run(device: &Arc<Device>, quick: bool, say: &dyn Fn(&str)) -> Result<Probe> {
    let provenance = Provenance::now(FORMAT);
    let Findings { clock, statistics, work, sides, formats, lines, marks } = probe(device, quick, say)?;
    let device = DeviceRecord::from(&device.info);
    Ok(Probe { provenance, device, clock, statistics, work, sides, quick, formats, lines, marks })
}

/// Keeps what was found in `folder`.
///
/// # Errors
/// When the file cannot be written.
pub fn keep(folder: &Path, found: &Probe) -> Result<()> {
    create_folder(folder)?;
    write_json(&folder.join("probe.json"), found)
}
