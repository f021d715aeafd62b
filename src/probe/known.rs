//! Probes that were made before, one for each device and version of its driver, in the program's cache.

use std::path::PathBuf;

use sha2::{Digest, Sha256};

use super::record::{self, DeviceRecord, Probe};
use crate::cache;
use crate::vulkan::DeviceInfo;

/// Where the probe of a device lies, or would lie.
fn path(device: &DeviceRecord) -> Option<PathBuf> {
    let DeviceRecord { name, driver, driver_version, api_version, .. } = device;
    let hash = Sha256::digest([name, driver, driver_version, api_version].map(String::as_str).join("\n"));
    let name: String = hash.iter().map(|byte| format!("{byte:02x}")).collect();
    cache::folder().map(|folder| folder.join("probes").join(format!("{name}.json")))
}

/// Keeps a probe. Whatever is wrong with the cache only means that nobody knows of it later.
pub fn keep(probe: &Probe) {
    let Some(path) = path(&probe.device) else { return };
    let Some(folder) = path.parent() else { return };
    let written = || -> Option<()> {
        std::fs::create_dir_all(folder).ok()?;
        let file = tempfile::NamedTempFile::new_in(folder).ok()?;
        serde_json::to_writer(&file, probe).ok()?;
        file.persist(&path).ok().map(drop)
    };
    let _ = written();
}

/// The probe that was last made of a device with this version of its driver; none where there is none that can be read.
pub fn of(info: &DeviceInfo) -> Option<Probe> {
    let path = path(&DeviceRecord::from(info))?;
    let text = std::fs::read_to_string(&path).ok()?;
    record::read(&text, &path.display().to_string()).ok()
}
