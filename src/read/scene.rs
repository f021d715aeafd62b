//! Scenes: settings from a TOML file or from a run's JSON, and everything they name, loaded and checked.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DMat4, DQuat};
use serde_json::Value;

use super::{ByteSkip, RawLayout, ReadChoice};
use crate::error::{Error, Result};
use crate::math::polyhedron::HalfSpace;
use crate::scene::field::{Hull, Missing, NanPolicy};
use crate::scene::mesh::{Keep, Mesh, shape};
use crate::scene::mesh_field::{self, DEFAULT_BAND};
use crate::scene::settings::{
    ClipSettings, Endian, Placed, RAW_SKIP, RAW_SPACING, Settings, ShellMode, VolumeSettings,
};
use crate::scene::volume::VoxelType;
use crate::scene::{
    Camera, ClipPlanes, ClipVolume, Content, Field, Polygons, Scene, Shells, Surface, Tetrahedra, TextureUnit,
    TransferFunction, Volume, builtin, tetrahedra,
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

/// The values of what is shown, and the mesh whose they are.
fn field_of(content: Content, settings: &VolumeSettings) -> Result<(Field, Option<Tetrahedra>)> {
    let how = settings.normalisation();
    let grid = match content {
        Content::Voxels(volume) => return Ok((Field::of(volume, &how)?, None)),
        Content::Cells(grid) => grid,
    };
    // What has no value is known by its voxel type and by what stands for none.
    let missing = Missing { voxel_type: VoxelType::F64, no_data: how.no_data };
    let grid = match how.nan {
        NanPolicy::Hole => {
            let is_missing: Vec<bool> = grid.values.iter().map(|value| missing.is(*value)).collect();
            grid.without(|point| is_missing[point])
        }
        NanPolicy::Replace | NanPolicy::Error => grid,
    };
    let grid = grid.cleaned()?;
    let field = Field::of(grid.as_volume()?, &how)?;
    let mesh = Tetrahedra::new(&grid, &field.values)?;
    let hull = Hull { extent: mesh.extent, unit: mesh.unit };
    Ok((field.within(hull), Some(mesh)))
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

/// The volume or the mesh that settings name.
///
/// # Errors
/// When they name several, or it cannot be read.
pub fn content(settings: &VolumeSettings) -> Result<Content> {
    let mesh = match (&settings.path, &settings.builtin) {
        (Some(path), None) => super::tetrahedra(path, settings.array.as_deref(), settings.component).transpose(),
        (None, Some(name)) => tetrahedra::builtin::mesh(name),
        _ => None,
    };
    match mesh {
        Some(grid) => {
            of_mesh(settings)?;
            Ok(Content::Cells(grid?))
        }
        None => volume(settings).map(Content::Voxels),
    }
}

/// Whether settings ask for nothing that a mesh of cells has no use for.
fn of_mesh(settings: &VolumeSettings) -> Result<()> {
    let VolumeSettings { path, component, frame, dims, voxel_type, spacing, endian, skip, band, mesh, array, .. } =
        settings;
    let asked = [
        ("component", component.is_some() && path.is_none()),
        ("array", array.is_some() && path.is_none()),
        ("frame", frame.is_some()),
        ("dims", dims.is_some()),
        ("type", voxel_type.is_some()),
        ("spacing", spacing.is_some()),
        ("endian", endian.is_some()),
        ("skip", skip.is_some()),
        ("band", band.is_some()),
        ("mesh", mesh.is_some()),
    ];
    match asked.into_iter().find(|(_, asked)| *asked) {
        Some((key, _)) => Err(Error::usage(
            format!("volume.{key} (--{key})"),
            "is given for a mesh of cells, which has no use for it",
            "leave it out",
        )),
        None => Ok(()),
    }
}

/// The volume that settings name.
///
/// # Errors
/// When they name several, or it cannot be read.
pub fn volume(settings: &VolumeSettings) -> Result<Volume> {
    if settings.array.is_some() {
        return Err(Error::usage(
            "volume.array (--array)",
            "is given for a volume of voxels, and names values of a mesh of cells",
            "leave it out, or give a file of VTK",
        ));
    }
    let VolumeSettings { path, builtin, mesh, .. } = settings;
    let sources = [("path", path.is_some()), ("builtin", builtin.is_some()), ("mesh", mesh.is_some())];
    let given: Vec<&str> = sources.into_iter().filter_map(|(key, given)| given.then_some(key)).collect();
    match given[..] {
        [one, other] => return Err(Error::usage("volume", format!("has both {one} and {other}"), "keep one of them")),
        [_, _, _] => return Err(Error::usage("volume", "has path, builtin and mesh", "keep one of them")),
        _ => {}
    }
    let choice = ReadChoice {
        component: settings.component,
        frame: settings.frame,
        orientation: settings.orientation,
        no_data: &settings.no_data,
    };
    if let Some(mesh) = mesh {
        return distances(mesh, settings, &choice);
    }
    if settings.band.is_some() {
        return Err(Error::usage(
            "volume.band (--band)",
            "is given without a mesh",
            "give volume.mesh, whose distance field it is of, or leave it out",
        ));
    }
    let raw = raw_layout(settings)?;
    match (path, builtin) {
        (Some(path), _) => super::volume_with(path, raw, &choice),
        (None, _) if raw.is_some() => {
            Err(Error::usage("volume", "has dims and type but no path", "give the path of a raw file, or remove them"))
        }
        (None, name) => {
            let name = name.as_deref().unwrap_or(builtin::DEFAULT);
            choice.not_of(name, "built-in voxels")?;
            builtin::volume(name)
        }
    }
}

/// The distance field of the mesh in a file.
fn distances(path: &Path, settings: &VolumeSettings, choice: &ReadChoice) -> Result<Volume> {
    let VolumeSettings { dims, voxel_type, spacing, endian, skip, .. } = settings;
    let of_raw = [
        ("type", voxel_type.is_some()),
        ("spacing", spacing.is_some()),
        ("endian", endian.is_some()),
        ("skip", skip.is_some()),
    ];
    if let Some((key, _)) = of_raw.into_iter().find(|(_, given)| *given) {
        return Err(Error::usage(
            format!("volume.{key} (--{key})"),
            "is given for a mesh's distance field, and is of raw files",
            "leave it out: of a mesh's field dims and band can be chosen",
        ));
    }
    choice.not_of(path, "distances from a mesh")?;
    let volume = mesh_field::volume(&super::mesh(path)?, *dims, settings.band.unwrap_or(DEFAULT_BAND))?;
    super::check_sides(&volume, "scale the mesh to a size")?;
    Ok(volume)
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
    // The settings were checked: -1 is their only negative number.
    let skip = u64::try_from(skip.unwrap_or(RAW_SKIP)).map_or(ByteSkip::ToTail, ByteSkip::Bytes);
    let big_endian = endian.unwrap_or_default() == Endian::Big;
    Ok(Some(RawLayout { dims, voxel_type, spacing: spacing.unwrap_or(RAW_SPACING), big_endian, skip }))
}
