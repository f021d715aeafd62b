//! Which device to use.

use super::failure::no_device;
use super::info::DeviceInfo;
use crate::error::{Error, Result};

/// The device to use and why. `wanted` is an index, where it is a whole number, or a part of one device's name, in any case;
/// without it a discrete GPU goes before an integrated, a virtual and a software one, and the first of a kind before the
/// rest.
///
/// # Errors
/// No device, none that can be used, none that matches, or several whose name does: the message lists what is there and
/// why each is out.
pub fn pick(devices: &[DeviceInfo], wanted: Option<&str>) -> Result<(DeviceInfo, String)> {
    let best = |candidates: &[&DeviceInfo]| -> Option<DeviceInfo> {
        let usable = candidates.iter().filter(|device| device.unusable.is_none());
        usable.min_by_key(|device| (device.kind, device.index)).map(|device| (*device).clone())
    };
    if devices.is_empty() {
        return Err(no_device());
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
    let usable = |device: &DeviceInfo, reason: String| match &device.unusable {
        None => Ok((device.clone(), reason)),
        Some(_) => Err(none(devices, &input, "that device cannot be used")),
    };
    let part = wanted.trim().to_lowercase();
    if !part.is_empty() && part.chars().all(|c| c.is_ascii_digit()) {
        // A number with more digits than an index can have is none of a device.
        let index = part.parse::<usize>().ok();
        return match devices.iter().find(|device| Some(device.index) == index) {
            Some(device) => usable(device, format!("index {} was asked for", device.index)),
            None => Err(none(devices, &input, "no device has that index")),
        };
    }
    let whole: Vec<_> = all.iter().filter(|device| device.name.to_lowercase() == part).collect();
    let contains: Vec<_> = all.iter().filter(|device| device.name.to_lowercase().contains(&part)).collect();
    match (whole.as_slice(), contains.as_slice()) {
        ([device], _) => usable(device, "that is its name".to_owned()),
        (_, []) => Err(none(devices, &input, "no device has that name")),
        _ if part.is_empty() => Err(none(devices, &input, "no device has that name")),
        (_, [device]) => usable(device, format!("its name contains {wanted:?}")),
        (_, several) => Err(none(devices, &input, &format!("{} devices have that in their name", several.len()))),
    }
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
        true => "choose another by its index, or by a part of its name that no other has",
        false => "install a Vulkan 1.3 driver (Debian: mesa-vulkan-drivers has one that runs on the CPU)",
    };
    Error::device(input, format!("{problem}; there are: {}", list.join(", ")), remedy)
}
