//! What a scene shows: the volume or the mesh of cells that its settings name, and its values.

use std::path::Path;

use super::{ByteSkip, RawLayout, ReadChoice};
use crate::error::{Error, Result};
use crate::scene::field::{Hull, Missing, NanPolicy};
use crate::scene::mesh_field::{self, DEFAULT_BAND};
use crate::scene::settings::{Endian, RAW_SKIP, RAW_SPACING, VolumeSettings};
use crate::scene::volume::VoxelType;
use crate::scene::{Content, Field, Tetrahedra, Volume, builtin, tetrahedra};

/// The values of what is shown, and the mesh whose they are.
pub(super) fn field_of(content: Content, settings: &VolumeSettings) -> Result<(Field, Option<Tetrahedra>)> {
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
        NanPolicy::Error => {
            let bad = grid.values.iter().filter(|value| missing.is(**value)).count();
            if bad > 0 {
                let problem = format!("holds {bad} points whose values are NaN, infinite or no data");
                let remedy = "repair them or choose nan = \"replace\" or \"hole\"";
                return Err(Error::input(&grid.name, problem, remedy));
            }
            grid
        }
        NanPolicy::Replace => grid,
    };
    let grid = grid.cleaned()?;
    let field = Field::of(grid.as_volume()?, &how)?;
    let mesh = Tetrahedra::new(&grid, &field.values)?;
    let hull = Hull { extent: mesh.extent, unit: mesh.unit };
    Ok((field.within(hull), Some(mesh)))
}

/// The volume or the mesh that settings name.
///
/// # Errors
/// When they name several, or it cannot be read.
pub fn content(settings: &VolumeSettings) -> Result<Content> {
    let mesh = match (&settings.path, &settings.builtin) {
        _ if settings.mesh.is_some() => None,
        (Some(path), None) => super::tetrahedra(path, settings.array.as_deref(), settings.component).transpose(),
        (None, Some(name)) => tetrahedra::builtin::mesh(name),
        _ => None,
    };
    match mesh {
        Some(grid) => {
            let grid = grid?;
            of_mesh(settings)?;
            Ok(Content::Cells(grid))
        }
        None => volume(settings).map(Content::Voxels),
    }
}

/// Whether settings ask for nothing that a mesh of cells has no use for.
fn of_mesh(settings: &VolumeSettings) -> Result<()> {
    let VolumeSettings { path, component, frame, dims, voxel_type, spacing, endian, skip, band, array, .. } = settings;
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
