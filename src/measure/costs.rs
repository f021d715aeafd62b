//! What work costs on a device, for `auto`: a few frames of a small built-in volume by each way of working, timed once for each device,
//! version of its driver and build of the shaders, and kept in the program's cache.

use std::path::PathBuf;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::checked::{Checked, CostSource, refuse_missing};
use super::facts::facts;
use crate::auto::{self, DeviceCosts, TimedFrame, Tuning, build_ms, timed};
use crate::cache;
use crate::error::Result;
use crate::frame::{GpuFrame, Measure, Resident, plan_on};
use crate::glsl;
use crate::method;
use crate::part::rows::Method;
use crate::plan;
use crate::provenance::Provenance;
use crate::scene::builtin;
use crate::scene::field::{Field, NanPolicy};
use crate::scene::settings::{MethodSettings, Settings};
use crate::scene::{Scene, TextureUnit, TransferFunction};
use crate::vulkan::DeviceInfo;

/// The version of what is kept.
const FORMAT: u32 = 1;

/// The volume that is drawn: objects of several sizes far from each other.
const VOLUME: &str = "jets:96";

/// Frames run for a time, the least of which counts: whatever else a machine does makes them longer. The first of a new pipeline is none.
const REPEATS: usize = 3;

/// Milliseconds of a frame that is run no further: on a device that slow the measuring is to end, too.
const LONG: f64 = 150.0;

/// A frame that is timed.
struct CostFrame {
    method: &'static Method,
    tf: &'static str,
    /// M, look-ups in a segment, and voxels along a side of a cell.
    tuning: [u32; 3],
    step: f64,
    /// Pixels of a side.
    side: u32,
}

const fn frame(method: &'static Method, tf: &'static str, tuning: [u32; 3], step: f64, side: u32) -> CostFrame {
    CostFrame { method, tf, tuning, step, side }
}

/// Pixels of a side of most frames, and of those that hardly have any.
const SIDE: u32 = 224;
const SMALL: u32 = 96;

/// Frames that differ in how much of each kind of work they have: samples in haze, which nothing shortens, and longer steps, which leave
/// pixels; small ones, which leave passes; and those that leap.
const FRAMES: [CostFrame; 24] = [
    frame(&method::SINGLE_PASS, "haze", [8, 1, 1], 1.0, SIDE),
    frame(&method::SINGLE_PASS, "haze", [8, 1, 1], 8.0, SIDE),
    frame(&method::SINGLE_PASS, "haze", [8, 1, 1], 1.0, SMALL),
    frame(&method::SINGLE_PASS_OMNI, "ramp", [4, 1, 1], 1.0, SIDE),
    frame(&method::SINGLE_PASS_OMNI, "ramp", [16, 1, 2], 1.0, SIDE),
    frame(&method::SINGLE_PASS_DIRECTIONAL, "surface", [8, 1, 2], 0.5, SIDE),
    frame(&method::RC, "haze", [8, 1, 1], 1.0, SIDE),
    frame(&method::RC, "haze", [64, 1, 1], 1.0, SIDE),
    frame(&method::RC, "haze", [4, 1, 1], 1.0, SMALL),
    frame(&method::RC_ERT, "ramp", [16, 1, 1], 1.0, SIDE),
    frame(&method::NN_OMNI, "ramp", [8, 1, 1], 1.0, SIDE),
    frame(&method::NN_OMNI, "ramp", [32, 16, 1], 1.0, SIDE),
    frame(&method::NN_DIRECTIONAL, "surface", [8, 4, 2], 0.5, SIDE),
    frame(&method::NN_OMNI_FUSED, "ramp", [8, 1, 1], 1.0, SIDE),
    frame(&method::NN_OMNI_FUSED, "ramp", [32, 16, 1], 1.0, SIDE),
    frame(&method::NN_OMNI_FUSED, "ramp", [4, 1, 1], 1.0, SMALL),
    frame(&method::NN_DIRECTIONAL_FUSED, "surface", [8, 4, 2], 0.5, SIDE),
    frame(&method::NN_OMNI_FUSED, "linear", [16, 1, 1], 0.5, SIDE),
    frame(&method::SLICES_3D, "haze", [8, 1, 1], 1.0, SIDE),
    frame(&method::SLICES_3D, "haze", [8, 1, 1], 8.0, SIDE),
    frame(&method::SLICES_3D, "haze", [8, 1, 1], 1.0, SMALL),
    frame(&method::SLICES_3D_FTB, "ramp", [8, 1, 1], 1.0, SIDE),
    frame(&method::SLICES_3D_OMNI, "ramp", [8, 1, 1], 1.0, SIDE),
    frame(&method::SLICES_3D_OMNI, "ramp", [32, 16, 1], 1.0, SIDE),
];

/// What is kept of a device.
#[derive(Serialize, Deserialize)]
struct Kept {
    #[serde(flatten)]
    provenance: Provenance,
    device: String,
    costs: DeviceCosts,
    frames: Vec<TimedFrame>,
}

/// Where what is known of a device by the program's own shaders lies, or would lie.
fn path(info: &DeviceInfo) -> Option<PathBuf> {
    let DeviceInfo { name, driver_name, driver_info, driver_version, api_version, .. } = info;
    let device = [name, driver_name, driver_info, driver_version, api_version].map(|part| part.as_bytes());
    let made_by = [glsl::COMPILER, include_bytes!("costs.rs")];
    let parts: Vec<&[u8]> = device.into_iter().chain(made_by).chain(auto::MODEL.map(str::as_bytes)).collect();
    cache::file("costs", &parts)
}

/// What is known of a device from frames that were timed there before; none where there are none.
pub fn known(info: &DeviceInfo) -> Option<DeviceCosts> {
    let text = std::fs::read(path(info)?).ok()?;
    let kept: Kept = serde_json::from_slice(&text).ok()?;
    (kept.provenance.version == FORMAT).then_some(kept.costs)
}

/// What work costs on a device: as it is known, or measured now.
///
/// # Errors
/// What the driver reports.
pub fn of(checked: &Checked) -> Result<DeviceCosts> {
    let info = &checked.device.info;
    let known = match checked.costs {
        CostSource::Fitted => Some(DeviceCosts::default()),
        CostSource::Measured => known(info),
        CostSource::Again => None,
    };
    match known {
        Some(known) => Ok(known),
        // A shader that is being changed is not what its device is judged by.
        None if !glsl::is_built_in() => Ok(DeviceCosts::default()),
        None => measure(checked),
    }
}

/// Times frames, and keeps what comes of them.
fn measure(checked: &Checked) -> Result<DeviceCosts> {
    let mut rig = CostRig::new(checked)?;
    let mut frames = Vec::new();
    for frame in &FRAMES {
        frames.extend(rig.time(frame)?);
    }
    let provenance = Provenance::now(FORMAT);
    let costs = DeviceCosts::fit(provenance.date.clone(), &frames, rig.builds);
    let info = &checked.device.info;
    let kept = Kept { provenance, device: info.name.clone(), costs, frames };
    if let Some(path) = path(info) {
        cache::keep(&path, &kept);
    }
    Ok(kept.costs)
}

/// Draws what is timed.
struct CostRig<'a> {
    checked: &'a Checked,
    resident: Resident,
    /// The transfer function of the frame before.
    tf: Option<&'static str>,
    field: Arc<Field>,
    /// What building takes, as a multiple of the constants, by the first structure.
    builds: Option<f64>,
}

impl<'a> CostRig<'a> {
    fn new(checked: &'a Checked) -> Result<Self> {
        let field = Arc::new(Field::new(builtin::volume(VOLUME)?, None, NanPolicy::Replace)?);
        Ok(Self { checked, resident: Resident::new(&checked.device), tf: None, field, builds: None })
    }

    /// A frame with what it took; none where the device does not draw it.
    fn time(&mut self, frame: &CostFrame) -> Result<Option<TimedFrame>> {
        let scene = frame.scene(self.field.clone(), self.checked.check.unit)?;
        let Checked { device, check, early_end, .. } = self.checked;
        let form = plan::form(&scene, check.automatic(frame.method.name()))?;
        if refuse_missing(self.checked, form).is_err() {
            return Ok(None);
        }
        let plan = plan_on(device, &scene, form, None)?;
        if self.tf.replace(frame.tf).is_some_and(|before| before != frame.tf) {
            self.resident.forget_transfer();
        }
        self.resident.prepare(&scene, &plan)?;
        let estimate = build_ms(frame.method, Tuning::of(&scene.settings), &scene, &DeviceCosts::default());
        let built = self.resident.build_ms(&plan).filter(|_| estimate > 0.0);
        self.builds = self.builds.or(built.map(|[ms, _]| ms / estimate));
        let mut run = GpuFrame::new(device, &scene, &plan, &mut self.resident, *early_end)?;
        run.run(Measure::Nothing)?;
        let mut least = f64::INFINITY;
        for repeat in 0..REPEATS {
            if repeat == 0 || least < LONG {
                least = least.min(taken(&mut run, device.info.is_cpu())?);
            }
        }
        timed(&scene, &facts(&scene, self.checked), least).map(Some)
    }
}

/// Runs a frame for its milliseconds, as reports compare them: device time, or on a CPU that of the process.
///
/// # Errors
/// What the driver reports.
pub fn taken(frame: &mut GpuFrame, on_cpu: bool) -> Result<f64> {
    if on_cpu {
        return Ok(frame.run(Measure::Nothing)?.cpu_ms);
    }
    let run = frame.run(Measure::Times)?;
    Ok(run.gpu_total_ms.unwrap_or(run.frame_ms))
}

impl CostFrame {
    fn scene(&self, field: Arc<Field>, unit: TextureUnit) -> Result<Scene> {
        let mut settings = Settings::default();
        let [m, lookups, cell] = self.tuning;
        settings.image.size = [self.side; 2];
        (settings.sampling.step, settings.sampling.samples_per_pass) = (self.step, m);
        settings.method = MethodSettings { name: self.method.name(), lookups, cell, ..settings.method };
        let transfer =
            TransferFunction::preset(self.tf, 1.0).unwrap_or_else(|| TransferFunction::new("none", vec![], 1.0))?;
        Ok(Scene { unit, ..Scene::of_volume(settings, field, transfer) })
    }
}
