//! NRRD volumes, versions 1 to 5 and before, header attached or detached.
//!
//! ByteSource: "Definition of NRRD File Format" of the Teem library (teem.sourceforge.net/nrrd/format.html).
//! Departures:
//! 1. One scalar volume is taken: of several values a voxel the chosen component, of several volumes the chosen frame.
//!    The origin is not kept.
//! 2. `axis mins` and `axis maxs` without `centers` are those of cells.
//! 3. What follows the data is told in a warning. The format itself is silent about it.
//! 4. A list or pattern of files without SUBDIM is divided evenly along the slowest axis, be it slices or slabs.

mod axes;
mod data;
mod fields;
mod header;
mod names;
mod place;
mod roles;

use std::fs::File;
use std::path::Path;

use self::data::Data;
use self::header::Header;
use self::names::{Names, Several};
use super::source::ByteSource;
use super::{ReadChoice, raw, voxels};
use crate::error::{Error, Result};
use crate::scene::volume::{Volume, Voxels};

/// Files with something behind their data that are named; the others are counted.
const MOST_NAMED: usize = 3;

/// The volume that is chosen of a file.
///
/// # Errors
/// When a file cannot be read, its header is not NRRD or says something this reader does not know, the data are not
/// what the header promises, or the choice does not fit the file.
pub fn volume(path: &Path, mut source: ByteSource, choice: &ReadChoice) -> Result<Volume> {
    let most = source.most;
    let header = header::read(path, &mut source, most)?;
    let roles = roles::of(path, &header.axes, choice)?;
    roles.check(path, &header.axes, choice)?;
    let sizes = header.sizes();
    let Some((count, bytes)) = raw::extent(&sizes, header.voxel_type) else {
        let problem = format!("cannot have the sizes {sizes:?}: they overflow");
        return Err(Error::input(path.display(), problem, "correct the sizes"));
    };
    let place = place::place(path, &header, &roles, choice)?;
    let mut values = voxels::none(header.voxel_type);
    let mut warnings = Vec::new();
    let folder = path.parent().unwrap_or(Path::new(""));
    match &header.names {
        Names::Attached => {
            let data = Data { path, header: &header, source: &mut source, count, bytes };
            let behind = data.append(&mut values)?;
            let behind = behind.or(packed_rest(path, source)?);
            warnings.extend(behind.map(|what| format!("{} holds {what}, which is not read", path.display())));
        }
        Names::One(name) => {
            let header_path = path;
            let path = folder.join(name);
            let (file, length) = data_file(header_path, &path)?;
            let mut source = ByteSource::plain(file, length);
            let behind =
                Data { path: &path, header: &header, source: &mut source, count, bytes }.append(&mut values)?;
            warnings.extend(behind.map(|what| format!("{} holds {what}, which is not read", path.display())));
        }
        Names::Several(several, subdim) => {
            let files = files(path, &header, several, *subdim)?;
            let share = (count / files as usize, bytes / files);
            warnings.extend(joined(path, &header, several, share, &mut values)?);
        }
    }
    let place::DataPlace { picked, spacing, turn, notes, warnings: more } = place;
    let mut volume = Volume::new(path.display().to_string(), picked.dims, spacing, picked.of(values, choice.no_data))?;
    volume.turn = turn;
    volume.notes = notes;
    volume.warnings = [more, warnings].concat();
    Ok(volume)
}

/// Reads the voxels of several files, of each its share: so many voxels, in so many bytes. Gives what has to be told.
fn joined(
    path: &Path,
    header: &Header,
    several: &Several,
    (count, bytes): (usize, u64),
    values: &mut Voxels,
) -> Result<Vec<String>> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let (mut warnings, mut with_more) = (Vec::new(), 0);
    for i in 0..several.count() {
        let Some(name) = several.name(i) else {
            let problem = format!("makes no name of number {i}");
            return Err(Error::input(format!("{}: data file", path.display()), problem, "rename the files"));
        };
        let header_path = path;
        let path = folder.join(name);
        let (file, length) = data_file(header_path, &path)?;
        let mut source = ByteSource::plain(file, length);
        let data = Data { path: &path, header, source: &mut source, count, bytes };
        if let Some(what) = data.append(values)? {
            with_more += 1;
            let named = with_more <= MOST_NAMED;
            warnings.extend(named.then(|| format!("{} holds {what}, which is not read", path.display())));
        }
    }
    let others = with_more.saturating_sub(MOST_NAMED);
    warnings.extend((others > 0).then(|| format!("{others} further files hold bytes behind their data")));
    Ok(warnings)
}

/// Opens a data file that a header names; gives its length too.
fn data_file(header: &Path, path: &Path) -> Result<(File, u64)> {
    super::open(path).map_err(|error| {
        let remedy = format!("{}, or correct `data file` (NAME, LIST, or NAME%03d MIN MAX STEP)", error.remedy);
        Error::input(format!("{}: data file {}", header.display(), error.input), error.problem, remedy)
    })
}

/// What lies behind a file that is packed as a whole.
fn packed_rest(path: &Path, source: ByteSource) -> Result<Option<String>> {
    let behind = source.behind().map_err(|e| super::unreadable(path, &e))?;
    Ok((behind > 0).then(|| format!("{behind} bytes behind what gzip packed")))
}

/// How many files the data lie in.
fn files(path: &Path, header: &Header, several: &Several, subdim: Option<usize>) -> Result<u64> {
    let bad =
        |problem: String, remedy: String| Err(Error::input(format!("{}: data file", path.display()), problem, remedy));
    let (sizes, files) = (header.sizes(), several.count());
    let slowest = sizes[sizes.len() - 1];
    match subdim {
        Some(axes) if axes == 0 || axes > sizes.len() => {
            bad(format!("has files of {axes} axes each"), format!("give a number of axes from 1 to {}", sizes.len()))
        }
        Some(axes) if axes < sizes.len() => {
            let wanted: usize = sizes[axes..].iter().product();
            if files == wanted as u64 {
                return Ok(files);
            }
            bad(
                format!("names {files} files of {axes} axes each, where the sizes ask for {wanted}"),
                "name as many files as the sizes ask for".into(),
            )
        }
        _ if files > 0 && (slowest as u64).is_multiple_of(files) => Ok(files),
        _ => bad(
            format!("names {files} files, which do not share the {slowest} entries of the slowest axis evenly"),
            "name as many files as the slowest axis has entries, or a part of that".into(),
        ),
    }
}
