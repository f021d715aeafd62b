//! Runs what the papers state of passes and fragments in words, without a table.

use super::data::DataFolder;
use super::rates::{KW03, RateSet, TimingPlan, file_of, settings_of};
use super::record::StatedRecord;
use super::{ReproducedSet, Variant};
use crate::error::Result;
use crate::experiment::Host;
use crate::measure::Checked;
use crate::measure::runner::{Effort, Runner};
use crate::method;
use crate::read;
use crate::scene::Scene;
use crate::scene::settings::{MethodName, MethodSettings, Settings};

/// A side of the pictures in which fragments are counted: their shares are about those of larger ones.
const SIDE: u32 = 128;

/// What is chosen in the variants of slices.
const TRANSFER: &str = "transfer function";

/// A transfer function, by its name.
type TransferChoice = (&'static str, fn(&mut Settings));

/// The transfer functions of slices: opaque structures, as in the papers' figures, and soft ones.
const TRANSFERS: [TransferChoice; 2] = [
    ("surface", |settings| settings.transfer.preset = Some("surface".to_owned())),
    ("ramp", |settings| settings.transfer.preset = Some("ramp".to_owned())),
];

/// What is chosen in the variants of the propagation, and its two values.
const COUNTS: &str = "counts of rays";
pub const COUNTED: &str = "read meanwhile";
pub const EVERY_PASS: &str = "none";

/// The mesh of the propagation, and its values.
const MESH: &str = "bluntfin_tet.vtk";
const ARRAY: &str = "density";

/// A device of which frames end early by counts, or none does.
pub struct Devices<'a> {
    pub counted: Option<&'a Checked>,
    pub every_pass: Option<&'a Checked>,
}

/// What is stated, run where volumes are there and there is a device.
///
/// # Errors
/// When a volume cannot be read, or the driver fails.
pub fn run_stated(devices: &Devices, data: DataFolder, plan: &TimingPlan, host: &Host) -> Result<StatedRecord> {
    let volumes = plan.of(&KW03, data);
    let slices =
        KW03.sets.iter().map(|set| slices(devices.every_pass, set, volumes, host)).collect::<Result<Vec<_>>>()?;
    Ok(StatedRecord { slices, propagation: propagation(devices, volumes, plan, host)? })
}

/// The fragments of all slices of a volume, and of those front to back, a pass each, that bring something.
fn slices(checked: Option<&Checked>, set: &RateSet, data: DataFolder, host: &Host) -> Result<ReproducedSet> {
    let mut column = empty(set.name, "KW03 §1.1", file_of(set, data));
    let Some(checked) = checked else { return Ok(column) };
    for (value, change) in TRANSFERS {
        let Some(mut settings) = settings_of(&KW03, set, data, change) else { break };
        (host.say)(&format!("fragments of slices: {}, {value}", set.name));
        settings.image.size = [SIDE; 2];
        // A slice in each pass, so that a fragment is a sample.
        settings.sampling.samples_per_pass = 1;
        let scene = read::scene(&settings)?;
        let runs = measured(checked, scene, &[method::SLICES_3D.name(), method::SLICES_3D_FTB.name()], 0, true)?;
        column.variants.push(Variant { choice: TRANSFER.to_owned(), value: value.to_owned(), runs });
    }
    Ok(column)
}

/// Frames of the propagation that end by counts, and in which every pass runs.
fn propagation(devices: &Devices, data: DataFolder, plan: &TimingPlan, host: &Host) -> Result<ReproducedSet> {
    let file = data.volume(MESH);
    let mut column = empty("Blunt fin", "Weiler03 \"Terminating Rendering\"", file.clone());
    let Ok(path) = file else { return Ok(column) };
    let mut settings = Settings::default();
    (settings.volume.path, settings.volume.array) = (Some(path), Some(ARRAY.to_owned()));
    (settings.transfer.preset, settings.sampling.termination) = (Some("linear".to_owned()), 1.0);
    let scene = read::scene(&settings)?;
    for (value, checked) in [(COUNTED, devices.counted), (EVERY_PASS, devices.every_pass)] {
        let Some(checked) = checked else { break };
        (host.say)(&format!("propagation, counts of rays: {value}"));
        let runs = measured(checked, scene.clone(), &[method::TET_PROPAGATION.name()], plan.repeats, false)?;
        column.variants.push(Variant { choice: COUNTS.to_owned(), value: value.to_owned(), runs });
    }
    Ok(column)
}

fn empty(name: &str, source: &str, file: std::result::Result<std::path::PathBuf, String>) -> ReproducedSet {
    ReproducedSet {
        name: name.to_owned(),
        source: source.to_owned(),
        file: file.as_ref().ok().map(|path| path.display().to_string()),
        absent: file.err(),
        picture: None,
        variants: Vec::new(),
    }
}

fn measured(
    checked: &Checked,
    scene: Scene,
    methods: &[MethodName],
    repeats: usize,
    reference: bool,
) -> Result<Vec<crate::measure::Run>> {
    let base = scene.settings.method.clone();
    let methods: Vec<_> = methods.iter().map(|name| MethodSettings { name: *name, ..base.clone() }).collect();
    let effort = Effort { warmups: usize::from(repeats > 0), repeats, reference };
    let measured = Runner::new(Some(checked), scene, String::new()).measure(&methods, effort, &|_| {})?;
    Ok(measured.into_iter().map(|one| one.run).collect())
}
