//! Scenes: settings from a TOML file or from a run's JSON, and everything they name, loaded and checked.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DMat4, DQuat};
use serde_json::Value;

use super::content::{content, field_of};
use crate::error::{Error, Result};
use crate::math::polyhedron::HalfSpace;
use crate::scene::mesh::{Keep, Mesh, shape};
use crate::scene::settings::{ClipSettings, Placed, Settings, ShellMode};
use crate::scene::{
    Camera, ClipPlanes, ClipVolume, Content, Field, Polygons, Scene, Shells, Surface, TextureUnit, TransferFunction,
    builtin,
};

/// The settings in a scene file; its relative paths are made relative to the file at once.
///
/// # Errors
/// When the file cannot be read, is not TOML, or has a wrong key or value; line and nearest known key are named.
pub fn settings(path: &Path) -> Result<Settings> {
    settings_of(&path.display().to_string(), &super::text(path)?, folder_of(path))
}

/// The settings in the text of a scene file that is called `name` and stands in `folder`.
///
/// # Errors
/// As [`settings`], but for reading.
pub fn settings_of(name: &str, text: &str, folder: &Path) -> Result<Settings> {
    let mut settings: Settings = toml::from_str(text).map_err(|e| {
        let line = e
            .span()
            .map(|span| 1 + text.as_bytes()[..span.start.min(text.len())].iter().filter(|b| **b == b'\n').count());
        let (problem, remedy) = super::keys::explain(e.message());
        let place = line.map_or(String::new(), |n| format!(", line {n}"));
        Error::input(format!("{name}{place}"), problem, remedy)
    })?;
    resolve(&mut settings, folder);
    Ok(settings)
}

/// Whether the text of a scene file says a key of a section; a text that is not TOML says none.
pub fn says(text: &str, section: &str, key: &str) -> bool {
    let table: Option<toml::Table> = toml::from_str(text).ok();
    table.is_some_and(|table| table.get(section).is_some_and(|section| section.get(key).is_some()))
}

fn folder_of(file: &Path) -> &Path {
    file.parent().unwrap_or(Path::new(""))
}

/// Makes paths that are relative to the folder the settings stand in relative to the working folder.
fn resolve(settings: &mut Settings, folder: &Path) {
    for path in settings.paths() {
        *path = folder.join(&*path);
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
    resolve(&mut settings, folder_of(&path));
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
    scene_of(settings, |settings| content(&settings.volume))
}

/// The same with a volume or a mesh from elsewhere.
///
/// # Errors
/// As [`scene`].
pub fn scene_of<C: Into<Content>>(settings: &Settings, content: impl FnOnce(&Settings) -> Result<C>) -> Result<Scene> {
    settings.check()?;
    let camera = Camera::from(&settings.camera);
    camera.basis()?;
    let transfer = super::transfer(&settings.transfer, Path::new(""))?;
    let effect = super::effect(&settings.effects)?.map(Arc::new);
    let (field, tetrahedra) = field_of(content(settings)?.into(), &settings.volume)?;
    let transfer = super::transfer::in_voxels(transfer, settings.transfer.reference_unit, &field)?;
    let turn = field.volume.turn;
    let camera = camera.in_axes_of(turn);
    let polygons = Arc::new(polygons(settings, turn)?);
    let environment = super::environment(&settings.environment, &polygons, turn)?.map(Arc::new);
    let backdrop = super::backdrop(&settings.effects)?.map(Arc::new);
    let back = turn.inverse();
    let in_axes = |plane: HalfSpace| HalfSpace { normal: back * plane.normal, ..plane };
    let planes = settings.clips.iter().filter_map(ClipSettings::half_space).map(in_axes);
    let planes = ClipPlanes::new(planes, 0.5 * field.extent());
    let clip_volume = clip_volume(settings, &field)?.map(Arc::new);
    let shells = Shells::new(&settings.shells, &field, None)?.map(Arc::new);
    let surface = match shells.as_deref() {
        Some(shells) if shells.mode == ShellMode::Surface => Some(outermost(settings, shells, &field, &transfer)?),
        _ => Surface::of(settings, &field, &transfer),
    };
    let lights = settings.lights.iter().map(|light| light.light().turned(back)).collect();
    let (mut settings, field) = (settings.clone(), Arc::new(field));
    settings.effects.hash = effect.as_ref().map(|effect| effect.hash.clone());
    let unit = TextureUnit::default();
    Ok(Scene {
        settings,
        field,
        tetrahedra: tetrahedra.map(Arc::new),
        transfer,
        camera,
        polygons,
        planes,
        clip_volume,
        surface,
        shells,
        lights,
        environment,
        backdrop,
        effect,
        unit,
    })
}

/// The outermost shell as an iso-surface.
fn outermost(settings: &Settings, shells: &Shells, field: &Field, transfer: &TransferFunction) -> Result<Surface> {
    let refused = |input: &str, problem: &str, remedy: &str| Err(Error::usage(input, problem, remedy));
    if settings.surface.is_asked() {
        return refused(
            "shells.mode (--shells surface)",
            "shows the outermost shell, and [surface] (--iso) asks for other surfaces",
            "leave one of them out",
        );
    }
    let mut settings = settings.clone();
    settings.surface.iso = shells.outermost();
    match Surface::of(&settings, field, transfer) {
        Some(surface) => Ok(surface),
        None => refused("shells.disabled (--shell-disabled)", "leaves all shells out", "give fewer numbers"),
    }
}

/// The meshes in their places, in the axes of a volume that `turn` leads from to volume space.
fn polygons(settings: &Settings, turn: DQuat) -> Result<Polygons> {
    let mut polygons = Polygons::default();
    let placed = |placed: Placed| -> Result<(Mesh, DMat4)> {
        let mesh = match (placed.path, placed.builtin) {
            (Some(path), _) => super::mesh(path)?,
            (None, name) => shape(name.as_deref().unwrap_or_default())?,
        };
        let place = DMat4::from_quat(turn.inverse()) * placed.place(mesh.bounds());
        Ok((mesh, place))
    };
    for settings in &settings.meshes {
        let (mesh, place) = placed(settings.placed())?;
        polygons.add(&mesh, place, settings.material())?;
    }
    for settings in settings.clips.iter().filter(|clip| clip.is_mesh()) {
        let (mesh, place) = placed(settings.placed())?;
        polygons.add_clip(&mesh, place, settings.keep)?;
    }
    Ok(polygons.ready())
}

/// The volume in its place whose values clip `field`.
fn clip_volume(settings: &Settings, field: &Field) -> Result<Option<ClipVolume>> {
    let Some((clip, (placed, iso))) = settings.clips.iter().find_map(|clip| Some((clip, clip.volume()?))) else {
        return Ok(None);
    };
    let volume = match placed.path {
        Some(path) => super::volume(path, None)?,
        None => builtin::volume(placed.builtin.as_deref().unwrap_or_default())?,
    };
    let (keeps_inside, turn) = (clip.keep == Keep::Inside, field.volume.turn);
    ClipVolume::new(volume, iso, keeps_inside, &placed, field.extent(), turn).map(Some)
}
