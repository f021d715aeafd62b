//! `depthleap info`: devices, features, queues, and which forms of culling work.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Serialize;

use super::output;
use crate::auto::{DeviceCosts, Factors};
use crate::error::Result;
use crate::frame::{SelfCheck, self_check};
use crate::measure::costs;
use crate::measure::record::FORMAT;
use crate::measure::write::{is_standard_output, write_json, write_standard_output};
use crate::method;
use crate::scene::texture::{FilterError, TexelFormat};
use crate::vulkan::{Device, DeviceInfo, Instance, pick};

/// Devices, features, queues, and which --cull works
///
/// Runs the self-check on every device that can be used: a small scene in each form of culling and marking, counts and
/// picture held against the rule.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap info
  depthleap info --device nvidia
  depthleap info --json - | jq '.devices[].auto'")]
pub struct InfoCommand {
    /// Only this device, by its index (a whole number) or a part of its name that no other has
    #[arg(long, value_name = "INDEX|NAME")]
    device: Option<String>,
    /// Write it as JSON too; for - to standard output, instead of the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

#[derive(Serialize)]
struct InfoJson<'a> {
    version: u32,
    devices: Vec<DeviceJson<'a>>,
}

#[derive(Serialize)]
struct DeviceJson<'a> {
    #[serde(flatten)]
    info: &'a DeviceInfo,
    self_check: Option<std::collections::BTreeMap<String, String>>,
    statistics: Option<String>,
    auto: Option<String>,
    /// What work costs there, as multiples of the constants; null where no frame was timed yet.
    costs: Option<DeviceCosts>,
}

impl InfoCommand {
    pub fn run(&self) -> Result<()> {
        let outputs: Vec<&Path> = self.json.iter().map(PathBuf::as_path).collect();
        output::check(&outputs)?;
        let instance = Instance::new(false)?;
        let devices = instance.devices()?;
        let (chosen, reason) = pick(&devices, self.device.as_deref())?;
        let mut text = String::new();
        let mut list = Vec::new();
        for info in &devices {
            if self.device.is_some() && info.index != chosen.index {
                continue;
            }
            let check = match &info.unusable {
                Some(_) => None,
                None => Some(self_check(&Device::new(&instance, info, false)?)?),
            };
            let costs = costs::known(info);
            describe(&mut text, info, check.as_ref());
            describe_costs(&mut text, costs.as_ref());
            if info.index == chosen.index {
                let _ = writeln!(text, "  taken by default: {reason}");
            }
            list.push(DeviceJson {
                info,
                self_check: check.as_ref().map(SelfCheck::words),
                statistics: check.as_ref().and_then(|c| c.statistics.clone()),
                auto: check.and_then(|c| c.automatic(method::NN_OMNI.name())).map(|f| f.name()),
                costs,
            });
        }
        if let Some(file) = &self.json {
            write_json(file, &InfoJson { version: FORMAT, devices: list })?;
            if is_standard_output(file) {
                return Ok(());
            }
        }
        write_standard_output(text.as_bytes())
    }
}

fn describe(text: &mut String, info: &DeviceInfo, check: Option<&SelfCheck>) {
    let yes = |has: bool| if has { "yes" } else { "no" };
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{}: {} ({:?}), Vulkan {}", info.index, info.name, info.kind, info.api_version);
    let _ = writeln!(text, "  driver: {} {}", info.driver_name, info.driver_info);
    if let Some(why) = &info.unusable {
        let _ = writeln!(text, "  cannot be used: {why}");
        return;
    }
    let _ = writeln!(
        text,
        "  depth bounds test: {}; precise occlusion counts: {}; conditional rendering: {}",
        yes(info.depth_bounds),
        yes(info.occlusion_precise),
        yes(info.conditional_rendering)
    );
    let timestamps = match info.timestamp_valid_bits {
        0 => "none".to_owned(),
        bits => format!("{bits} bits of {} ns", info.timestamp_period),
    };
    let _ = writeln!(text, "  timestamps: {timestamps}; largest volume {0}^3", info.max_image_3d);
    for (i, family) in info.queue_families.iter().enumerate() {
        let _ = writeln!(text, "  queue family {i}: {} x {:?}", family.count, family.flags);
    }
    let Some(check) = check else { return };
    let invocations = check.statistics.as_deref().map_or("believed".to_owned(), |why| format!("not believed, {why}"));
    let _ = writeln!(text, "  counts of shader invocations: {invocations}");
    for (form, verdict) in check.words() {
        let _ = writeln!(text, "  {form:<22} {verdict}");
    }
    if let Some(form) = check.automatic(method::NN_OMNI.name()) {
        let _ = writeln!(text, "  --cull auto: {}", form.name());
    }
    for format in TexelFormat::ALL {
        let name = format.name();
        let _ = match check.unit.errors[format as usize] {
            Some(FilterError { rounding, weight }) => {
                writeln!(text, "  interpolates {name:<4} within {rounding:.1e} + {weight:.1e} x contrast")
            }
            None => writeln!(text, "  cannot interpolate {name}"),
        };
    }
}

/// What `auto` takes work to cost on a device that it has timed frames on.
fn describe_costs(text: &mut String, costs: Option<&DeviceCosts>) {
    let Some(costs) = costs else { return };
    let _ = writeln!(text, "  {}; as multiples of lavapipe 22.3's:", costs.words());
    let ways = [("loops", costs.loops), ("passes", costs.passes), ("fused", costs.fused), ("slices", costs.slices)];
    for (way, Factors { passes, fragments, samples, lookups }) in ways {
        let _ = writeln!(
            text,
            "  {way:<8} passes {passes:.2}, fragments {fragments:.2}, samples {samples:.2}, look-ups {lookups:.2}"
        );
    }
    let _ = writeln!(text, "  structures {:.2}", costs.builds);
}
