//! Scenes: settings from a TOML file or from a run's JSON, and everything they name, loaded and checked.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde_json::Value;

use super::{ByteSkip, Choice, RawLayout};
use crate::error::{Error, Result};
use crate::scene::range::RangeEnd;
use crate::scene::settings::{CELLS, CONES, EXTRA_FETCHES, Endian, LOOKUPS, PRECISIONS, Settings, VolumeSettings};
use crate::scene::transfer::REFERENCES;
use crate::scene::{Camera, Field, Scene, TextureUnit, Volume, builtin};

/// The volume of a scene that names none.
const DEFAULT_VOLUME: &str = "shells:64";

/// Steps that are neither below what single precision resolves nor longer than any volume, in voxels.
const STEPS: std::ops::RangeInclusive<f64> = 1e-4..=1e6;
/// The most samples of a pass, and the most passes.
const MAX_COUNT: u32 = 65536;
/// The longest side of an image, in pixels.
const MAX_SIDE: u32 = 65535;

/// The settings in a scene file; its relative paths are made relative to the file at once.
///
/// # Errors
/// When the file cannot be read, is no TOML, or has a wrong key or value; line and nearest known key are named.
pub fn settings(path: &Path) -> Result<Settings> {
    let text = super::text(path)?;
    let mut settings: Settings = toml::from_str(&text).map_err(|e| {
        let line = e
            .span()
            .map(|span| 1 + text.as_bytes()[..span.start.min(text.len())].iter().filter(|b| **b == b'\n').count());
        let (problem, remedy) = super::keys::explain(e.message());
        let place = line.map_or(String::new(), |n| format!(", line {n}"));
        Error::input(format!("{}{place}", path.display()), problem, remedy)
    })?;
    resolve(&mut settings, path);
    Ok(settings)
}

/// Makes paths that are relative to the file the settings stand in relative to the working folder.
fn resolve(settings: &mut Settings, file: &Path) {
    let base = file.parent().unwrap_or(Path::new(""));
    for path in [&mut settings.volume.path, &mut settings.transfer.file].into_iter().flatten() {
        *path = base.join(&*path);
    }
}

/// The settings of a run, from the JSON that `render --json` or `bench` wrote: its `settings`, or those of the
/// only one of its `runs`. `FILE#INDEX` picks among several, counted from 0. Paths are relative to the file.
///
/// # Errors
/// When the file cannot be read, holds no settings or wrong ones, or several runs and none is picked.
pub fn settings_from_json(path: &Path) -> Result<Settings> {
    let (path, index) = picked(path);
    let bad = |problem: String, remedy: String| Err(Error::input(path.display(), problem, remedy));
    let mut root: Value = match serde_json::from_str(&super::text(&path)?) {
        Ok(root) => root,
        Err(e) => return bad(format!("is not JSON ({e})"), "give the file that `render --json` wrote".into()),
    };
    let run = match (root.get_mut("runs").and_then(Value::as_array_mut), index) {
        (None, None) => &mut root,
        (None, Some(i)) => return bad(format!("has no `runs` to pick #{i} from"), format!("leave out #{i}")),
        (Some(runs), None) if runs.len() > 1 => {
            let pick = format!("pick one with {0}#0 to {0}#{1}", path.display(), runs.len() - 1);
            return bad(format!("holds {} runs", runs.len()), pick);
        }
        (Some(runs), index) => {
            let (count, index) = (runs.len(), index.unwrap_or(0));
            match runs.get_mut(index) {
                Some(run) => run,
                None => return bad(format!("holds {count} runs and none numbered {index}"), "pick another".into()),
            }
        }
    };
    let Some(settings) = run.get_mut("settings").map(Value::take) else {
        return bad("holds no `settings`".into(), "give the file that `render --json` or `bench` wrote".into());
    };
    let mut settings: Settings = serde_json::from_value(settings).map_err(|e| {
        let (problem, remedy) = super::keys::explain(&e.to_string());
        Error::input(format!("{}: settings", path.display()), problem, remedy)
    })?;
    resolve(&mut settings, &path);
    Ok(settings)
}

/// The file and the number behind its `#`, unless a file has that very name.
fn picked(path: &Path) -> (PathBuf, Option<usize>) {
    let split = || {
        let (file, index) = path.to_str()?.rsplit_once('#')?;
        Some((PathBuf::from(file), Some(index.parse().ok()?)))
    };
    if path.exists() { None } else { split() }.unwrap_or_else(|| (path.into(), None))
}

/// Loads what `settings` name and checks every value. Paths are taken as they stand.
///
/// # Errors
/// When a value lies outside its range, settings contradict each other, or a file is wrong.
pub fn scene(settings: &Settings) -> Result<Scene> {
    scene_of(settings, |settings| volume(&settings.volume))
}

/// The same with a volume from elsewhere.
///
/// # Errors
/// As [`scene`].
pub fn scene_of(settings: &Settings, volume: impl FnOnce(&Settings) -> Result<Volume>) -> Result<Scene> {
    check(settings)?;
    let camera = Camera::from(&settings.camera);
    camera.basis()?;
    let transfer = super::transfer(&settings.transfer, Path::new(""))?;
    let volume = volume(settings)?;
    let camera = camera.in_axes_of(volume.turn);
    let field = Field::of(volume, &settings.volume.normalisation())?;
    Ok(Scene { settings: settings.clone(), field: Arc::new(field), transfer, camera, unit: TextureUnit::default() })
}

/// Whether every number of the settings lies in its range, before any file is read.
///
/// # Errors
/// When one does not, by its key and its option.
pub fn check(settings: &Settings) -> Result<()> {
    let sampling = &settings.sampling;
    let check = |good: bool, key: &str, value: String, remedy: String| {
        if good { Ok(()) } else { Err(Error::usage(key, format!("is {value}"), remedy)) }
    };
    check(
        STEPS.contains(&sampling.step),
        "sampling.step (--step)",
        sampling.step.to_string(),
        format!("give a number of voxels from {} to {}", STEPS.start(), STEPS.end()),
    )?;
    check(
        (1..=MAX_COUNT).contains(&sampling.samples_per_pass),
        "sampling.samples_per_pass (--samples-per-pass)",
        sampling.samples_per_pass.to_string(),
        format!("give a number from 1 to {MAX_COUNT}"),
    )?;
    check(
        sampling.passes <= MAX_COUNT,
        "sampling.passes (--passes)",
        sampling.passes.to_string(),
        format!("give a number up to {MAX_COUNT}, or 0 for as many as the view needs"),
    )?;
    check(
        (0.0..=1.0).contains(&sampling.termination),
        "sampling.termination (--termination)",
        sampling.termination.to_string(),
        "give an opacity from 0 to 1 (1 ends no ray early)".into(),
    )?;
    check(
        settings.image.size.iter().all(|n| (1..=MAX_SIDE).contains(n)),
        "image.size (--viewport)",
        format!("{:?}", settings.image.size),
        format!("give width and height from 1 to {MAX_SIDE} pixels"),
    )?;
    check(
        settings.image.background.iter().all(|c| (0.0..=1.0).contains(c)),
        "image.background (--background)",
        format!("{:?}", settings.image.background),
        "give red, green and blue from 0 to 1".into(),
    )?;
    let reference = settings.transfer.reference;
    check(
        REFERENCES.contains(&reference),
        "transfer.reference (--reference)",
        reference.to_string(),
        format!("give a number of voxels from {} to {}", REFERENCES.start(), REFERENCES.end()),
    )?;
    check(
        EXTRA_FETCHES.contains(&settings.sampling.extra_fetches),
        "sampling.extra_fetches (--extra-fetches)",
        settings.sampling.extra_fetches.to_string(),
        format!("give a number from {} to {}", EXTRA_FETCHES.start(), EXTRA_FETCHES.end()),
    )?;
    let method = &settings.method;
    check(
        CELLS.contains(&method.cell),
        "method.cell (--cell)",
        method.cell.to_string(),
        "give 1, 2, 4 or 8 voxels".into(),
    )?;
    check(
        CONES.contains(&method.cone),
        "method.cone (--cone)",
        method.cone.to_string(),
        format!("give a half-angle from {} to {} degrees", CONES.start(), CONES.end()),
    )?;
    check(
        LOOKUPS.contains(&method.lookups),
        "method.lookups (--lookups)",
        method.lookups.to_string(),
        format!("give a number from {} to {}", LOOKUPS.start(), LOOKUPS.end()),
    )?;
    check_volume(&settings.volume)
}

fn check_volume(volume: &VolumeSettings) -> Result<()> {
    let upside_down = |range: &[RangeEnd; 2]| match *range {
        [RangeEnd::Value(low), RangeEnd::Value(high)] | [RangeEnd::Percentile(low), RangeEnd::Percentile(high)] => {
            low > high
        }
        _ => false,
    };
    let shown = |range: &[RangeEnd; 2]| format!("is [{}]", range.map(|end| end.to_string()).join(", "));
    if let Some(range) = volume.range.filter(|range| !range.iter().all(|end| end.is_sound()) || upside_down(range)) {
        let remedy = "give two finite numbers or percentages from 0% to 100%, the low one first";
        return Err(Error::usage("volume.range (--range)", shown(&range), remedy));
    }
    if let Some(value) = volume.no_data.iter().find(|value| !value.is_finite()) {
        let remedy = "give finite numbers; NaN and infinities stand for no value anyway";
        return Err(Error::usage("volume.no_data (--no-data)", format!("has {value}"), remedy));
    }
    if !PRECISIONS.contains(&volume.precision) {
        let remedy = format!("give a part of the scalar range from {:e} to {}", PRECISIONS.start(), PRECISIONS.end());
        return Err(Error::usage("volume.precision (--precision)", format!("is {}", volume.precision), remedy));
    }
    Ok(())
}

fn volume(settings: &VolumeSettings) -> Result<Volume> {
    let raw = raw_layout(settings)?;
    let choice = Choice {
        component: settings.component,
        frame: settings.frame,
        orientation: settings.orientation,
        no_data: &settings.no_data,
    };
    match (&settings.path, &settings.builtin) {
        (Some(_), Some(_)) => Err(Error::usage("volume", "has both path and builtin", "keep one of them")),
        (Some(path), None) => super::volume_with(path, raw, &choice),
        (None, _) if raw.is_some() => {
            Err(Error::usage("volume", "has dims and type but no path", "give the path of a raw file, or remove them"))
        }
        (None, name) => {
            let name = name.as_deref().unwrap_or(DEFAULT_VOLUME);
            choice.not_of(name, "built-in voxels")?;
            builtin::volume(name)
        }
    }
}

/// What the settings say of a raw file; none where they say nothing.
fn raw_layout(settings: &VolumeSettings) -> Result<Option<RawLayout>> {
    let VolumeSettings { dims, voxel_type, spacing, endian, skip, .. } = settings;
    let (Some(dims), Some(voxel_type)) = (*dims, *voxel_type) else {
        let some = [dims.is_some(), voxel_type.is_some(), spacing.is_some(), endian.is_some(), skip.is_some()];
        if !some.contains(&true) {
            return Ok(None);
        }
        let missing = if dims.is_none() { "dims" } else { "type" };
        let problem = format!("has some of dims, type, spacing, endian and skip, but not {missing}");
        return Err(Error::usage("volume", problem, format!("add {missing} (raw files), or remove the others")));
    };
    let skip = skip.unwrap_or(0);
    let Some(skip) = ByteSkip::of(skip) else {
        let remedy = "give a number of bytes, or -1 for all that the voxels leave over";
        return Err(Error::usage("volume.skip (--skip)", format!("is {skip}"), remedy));
    };
    let big_endian = *endian == Some(Endian::Big);
    Ok(Some(RawLayout { dims, voxel_type, spacing: spacing.unwrap_or([1.0; 3]), big_endian, skip }))
}
