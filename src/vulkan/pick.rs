//! Which device to use.

use super::info::DeviceInfo;
use crate::error::{Error, Result};

/// The device to use and why. `wanted` is an index or a part of the name, in any case; without it a discrete GPU
/// goes before an integrated, a virtual and a software one, and the first of a kind before the rest.
///
/// # Errors
/// No device, none that can be used, or none that matches: the message lists what is there and why each is out.
pub fn pick(devices: &[DeviceInfo], wanted: Option<&str>) -> Result<(DeviceInfo, String)> {
    let best = |candidates: &[&DeviceInfo]| -> Option<DeviceInfo> {
        let usable = candidates.iter().filter(|device| device.unusable.is_none());
        usable.min_by_key(|device| (device.kind, device.index)).map(|device| (*device).clone())
    };
    if devices.is_empty() {
        return Err(Error::device(
            "Vulkan",
            "no device found",
            "install a driver (Debian: mesa-vulkan-drivers has one that runs on the CPU)",
        ));
    }
    let all: Vec<_> = devices.iter().collect();
    let Some(wanted) = wanted else {
        let device = best(&all).ok_or_else(|| none(devices, "Vulkan", "no usable device"))?;
        let count = devices.iter().filter(|device| device.unusable.is_none()).count();
        let reason = match count {
            1 => "the only usable device".to_string(),
            _ => format!("the first {:?} device of {count} usable ones", device.kind).to_lowercase(),
        };
        return Ok((device, reason));
    };
    let input = format!("device {wanted:?}");
    let by_index = wanted.trim().parse::<usize>().ok().and_then(|index| devices.iter().find(|one| one.index == index));
    if let Some(device) = by_index {
        return match &device.unusable {
            None => Ok((device.clone(), format!("index {} was asked for", device.index))),
            Some(_) => Err(none(devices, &input, "that device cannot be used")),
        };
    }
    let part = wanted.trim().to_lowercase();
    let named: Vec<_> = all.into_iter().filter(|device| device.name.to_lowercase().contains(&part)).collect();
    if part.is_empty() || named.is_empty() {
        return Err(none(devices, &input, "no device has that index or name"));
    }
    let device = best(&named).ok_or_else(|| none(devices, &input, "that device cannot be used"))?;
    let reason = match named.len() {
        1 => format!("its name contains {wanted:?}"),
        count => format!("the best of {count} devices whose name contains {wanted:?}"),
    };
    Ok((device, reason))
}

fn none(devices: &[DeviceInfo], input: &str, problem: &str) -> Error {
    let list: Vec<_> = devices
        .iter()
        .map(|device| match &device.unusable {
            None => format!("{} {}", device.index, device.name),
            Some(reason) => format!("{} {} (unusable: {reason})", device.index, device.name),
        })
        .collect();
    let remedy = match devices.iter().any(|device| device.unusable.is_none()) {
        true => "choose another by its index or a part of its name",
        false => "install a Vulkan 1.3 driver (Debian: mesa-vulkan-drivers has one that runs on the CPU)",
    };
    Error::device(input, format!("{problem}; there are: {}", list.join(", ")), remedy)
}
