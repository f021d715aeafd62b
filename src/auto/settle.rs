//! What takes the place of what a scene leaves open: its method, numbers of that, and steps that meet an error.

use cpu_time::ThreadTime;

use super::choose::{DeviceFacts, choose_open};
use super::error::meeting;
use super::record::{AutoRecord, Estimate};
use super::tunings::tunings;
use crate::error::{Error, Result};
use crate::feature::tiles;
use crate::method::{self, METHODS, SINGLE_PASS};
use crate::part::rows::Method;
use crate::scene::Scene;
use crate::scene::settings::{LeftOpen, SamplingSettings, Settings, Tiles};

/// Whether settings leave anything to be chosen.
pub fn is_asked(settings: &Settings) -> bool {
    settings.method.name.is_auto() || settings.sampling.error.is_some() || LeftOpen::of(settings).any()
}

/// Puts a method and its settings in place of `auto`, and steps that meet the error that is asked for; other scenes stay as they are. Numbers
/// of methods that are not weighed become those by default.
///
/// # Errors
/// As [`super::choose`], and when no step meets the error.
pub fn settle(scene: &mut Scene, facts: &DeviceFacts) -> Result<Option<AutoRecord>> {
    let asked = scene.settings.sampling.error;
    if asked.is_some() {
        takes_errors(scene)?;
    }
    if !is_asked(&scene.settings) {
        return Ok(None);
    }
    let open = LeftOpen::close(&mut scene.settings);
    let name = scene.settings.method.name;
    let named = method::find(name).filter(|_| !name.is_auto());
    let is_weighed = |method: &Method| method.on_device && method.takes_samples() && !method.goes_through_cells();
    match named {
        // Those of cells differ in little, and none is weighed.
        None if scene.tetrahedra.is_some() => {
            let cells = METHODS.into_iter().find(|method| method.goes_through_cells() && method.loops());
            scene.settings.method.name = cells.map_or_else(Default::default, Method::name);
            return Ok(None);
        }
        // Whoever takes them, steps are those that the importance volume allows, and a loop has nothing between them.
        None if scene.settings.adaptive.importance => {
            scene.settings.method.name = SINGLE_PASS.name();
            return Ok(None);
        }
        Some(method) if scene.settings.adaptive.importance || !is_weighed(method) => return Ok(None),
        // Nothing of it varies.
        Some(method) if asked.is_none() && tunings(method, &scene.settings, open).len() == 1 => return Ok(None),
        _ => {}
    }
    let begin = ThreadTime::now();
    let mut record = match asked {
        None => choose_open(scene, facts, open)?,
        Some(bound) => {
            let (sampling, record) = choose_meeting(scene, facts, open, bound)?;
            scene.settings.sampling = sampling;
            record
        }
    };
    record.named = named.is_some();
    let Estimate { method, samples_per_pass, lookups, cell, .. } = &record.chosen;
    let settings = &mut scene.settings;
    settings.sampling.samples_per_pass = *samples_per_pass;
    (settings.method.lookups, settings.method.cell) = (*lookups, *cell);
    settings.method.name =
        method.parse().map_err(|e: String| Error::usage("--method auto", e, "please report this"))?;
    if record.tiles && method::find(settings.method.name).is_some_and(tiles::are_left_out_by) {
        settings.method.tiles = Tiles::Live;
    }
    record.look_ms = begin.elapsed().as_secs_f64() * MILLISECONDS;
    Ok(Some(record))
}

/// Whether steps can be chosen so that they meet an error.
///
/// # Errors
/// When the scene has no steps, or steps by a tolerance of their own, or is drawn by a method that is not weighed.
fn takes_errors(scene: &Scene) -> Result<()> {
    let refused = |why: &str, remedy: &str| Err(Error::usage("sampling.error (--error)", why, remedy));
    let weighed = |method: &Method| method.on_device && method.takes_samples();
    match () {
        () if scene.tetrahedra.is_some() => refused(
            "chooses steps, and ways through cells have lengths of their own",
            "leave it out: each way is integrated exactly, and --termination 1 ends none early",
        ),
        () if scene.settings.adaptive.importance => refused(
            "chooses steps that are all alike, and adaptive steps have a tolerance of their own",
            "use --tolerance",
        ),
        () if method::find(scene.settings.method.name).is_some_and(|method| !weighed(method)) => refused(
            "chooses by the time that samples take on a device, which this method has none of",
            "name another method, or auto",
        ),
        () => Ok(()),
    }
}

/// The way of sampling that meets an error in the least time, with the method.
fn choose_meeting(
    scene: &Scene,
    facts: &DeviceFacts,
    open: LeftOpen,
    bound: f64,
) -> Result<(SamplingSettings, AutoRecord)> {
    let mut best: Option<(SamplingSettings, AutoRecord)> = None;
    let mut refused = None;
    for (sampling, error) in meeting(scene, bound)? {
        let mut sampled = scene.clone();
        sampled.settings.sampling = sampling.clone();
        // A method may take one classification and not the other.
        let record = match choose_open(&sampled, facts, open) {
            Ok(record) => AutoRecord { error: Some(error), ..record },
            Err(e) => {
                refused = Some(e);
                continue;
            }
        };
        if best.as_ref().is_none_or(|(_, best)| record.chosen.ms < best.chosen.ms) {
            best = Some((sampling, record));
        }
    }
    let none = || Error::usage("sampling.error (--error)", "is met by nothing", "ask for a larger error");
    best.ok_or_else(|| refused.unwrap_or_else(none))
}

/// In a second.
const MILLISECONDS: f64 = 1e3;
