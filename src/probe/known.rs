//! Probes that were made before, one for each device and version of its driver, in the program's cache.

use std::path::PathBuf;

use super::record::{self, DeviceRecord, Probe};
use crate::cache;
use crate::vulkan::DeviceInfo;

/// Where the probe of a device lies, or would lie.
fn path(device: &DeviceRecord) -> Option<PathBuf> {
    let DeviceRecord { name, driver, driver_version, api_version, .. } = device;
    cache::file("probes", &[name, driver, driver_version, api_version].map(String::as_bytes))
}

/// Keeps a probe.
pub fn keep(probe: &Probe) {
    if let Some(path) = path(&probe.device) {
        cache::keep(&path, probe);
    }
}

/// The probe that was last made of a device with this version of its driver; none where there is none that can be read.
pub fn of(info: &DeviceInfo) -> Option<Probe> {
    let path = path(&DeviceRecord::from(info))?;
    let text = std::fs::read_to_string(&path).ok()?;
    record::read(&text, &path.display().to_string()).ok()
}
