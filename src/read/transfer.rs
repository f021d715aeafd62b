//! Transfer functions: from a preset, from points in the settings, or from a JSON file
//! `{"points": [[x, r, g, b, a], ...], "reference": 1.0}`.

use std::path::Path;

use crate::error::{Error, Result};
use crate::scene::Field;
use crate::scene::builtin::nearest;
use crate::scene::settings::{ReferenceUnit, TransferSettings};
use crate::scene::transfer::{DEFAULT_PRESET, Knot, PRESETS, REFERENCES, TransferFunction};

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct TransferFile {
    points: Vec<[f64; 5]>,
    reference: Option<f64>,
}

/// The transfer function of `settings`, its reference length as it stands there; a file's path is relative to `base`.
///
/// # Errors
/// When more than one of preset, file and points is given, the preset is unknown, the file cannot be read, or the
/// points are no transfer function.
pub fn transfer(settings: &TransferSettings, base: &Path) -> Result<TransferFunction> {
    match (&settings.preset, &settings.file, &settings.points) {
        (None, None, None) => preset(DEFAULT_PRESET, settings.reference),
        (Some(name), None, None) => preset(name, settings.reference),
        (None, Some(path), None) => file(&base.join(path), settings),
        (None, None, Some(points)) => TransferFunction::new("points", knots(points), settings.reference),
        _ => Err(Error::usage("transfer", "has more than one of preset, file and points", "keep one of them")),
    }
}

fn preset(name: &str, reference: f64) -> Result<TransferFunction> {
    TransferFunction::preset(name, reference).unwrap_or_else(|| {
        let near = nearest(name, PRESETS).map_or(String::new(), |n| format!("did you mean `{n}`? "));
        let remedy = format!("{near}choose one of {}, or give a file", PRESETS.join(", "));
        Err(Error::usage(
            "transfer.preset",
            format!("`{}` is not a built-in transfer function", name.escape_debug()),
            remedy,
        ))
    })
}

/// The same with its reference length in voxels of a volume, from the unit that it was given in.
///
/// # Errors
/// When the volume's voxels make no length of [`REFERENCES`] of it.
pub fn in_voxels(mut transfer: TransferFunction, unit: ReferenceUnit, field: &Field) -> Result<TransferFunction> {
    let voxels = match unit {
        ReferenceUnit::Voxel => return Ok(transfer),
        // The longest side is 1 in volume space.
        ReferenceUnit::Volume => transfer.reference / field.finest(),
    };
    if !REFERENCES.contains(voxels) {
        return Err(Error::usage(
            "transfer.reference (--reference)",
            format!("{} of the volume's longest side is a length of {voxels} voxels", transfer.reference),
            REFERENCES.remedy(),
        ));
    }
    transfer.reference = voxels;
    Ok(transfer)
}

/// A reference length in the file counts, which is one in voxels, unless the settings state another one: then neither is guessed.
fn file(path: &Path, settings: &TransferSettings) -> Result<TransferFunction> {
    let (stated, unit) = (settings.reference, settings.reference_unit);
    let file: TransferFile = serde_json::from_str(&super::text(path)?).map_err(|e| {
        let message = e.to_string();
        let place = format!(" at line {} column {}", e.line(), e.column());
        let (problem, remedy) = super::keys::explain(message.strip_suffix(&place).unwrap_or(&message));
        Error::input(format!("{}, line {}", path.display(), e.line()), problem, remedy)
    })?;
    let default = TransferSettings::default().reference;
    let reference = match file.reference {
        Some(own) if stated != default && stated != own => {
            let problem = format!("has the reference length {own}, the settings {stated}");
            return Err(Error::input(path.display(), problem, "remove one of them"));
        }
        Some(own) if unit != ReferenceUnit::Voxel => {
            let problem = format!("has the reference length {own}, in voxels, the settings one in another unit");
            return Err(Error::input(path.display(), problem, "remove one of them"));
        }
        Some(own) => own,
        None => stated,
    };
    TransferFunction::new(path.display().to_string(), knots(&file.points), reference)
}

fn knots(points: &[[f64; 5]]) -> Vec<Knot> {
    points.iter().map(|&[x, r, g, b, opacity]| Knot { x, color: [r, g, b], opacity }).collect()
}
