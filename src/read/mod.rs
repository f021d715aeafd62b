//! Bytes in, scene parts out: volumes, transfer functions, scene files.
//!
//! No reader trusts a header: memory is taken for what a file holds, never for what it promises, and a file is
//! right only when it ends where its header says.
//!
//! **To add a volume format**: one file here, one line in [`FORMATS`], the robustness tests of `tests/read.rs`.

mod keys;
pub mod nrrd;
pub mod raw;
pub mod scene;
pub mod transfer;
mod voxels;

use std::fs::File;
use std::io::Read;
use std::path::Path;

pub use raw::RawLayout;
pub use scene::{check, scene, scene_of, settings, settings_from_json};
pub use transfer::transfer;

use crate::error::{Error, Result};
use crate::scene::Volume;

/// A volume format that says its own sizes.
pub struct Format {
    pub name: &'static str,
    /// Usual endings of its files, lower case.
    pub extensions: &'static [&'static str],
    /// How its files begin.
    pub magic: &'static [u8],
    read: fn(&Path) -> Result<Volume>,
}

pub const FORMATS: [Format; 1] =
    [Format { name: "NRRD", extensions: &["nrrd", "nhdr"], magic: b"NRRD", read: nrrd::volume }];

/// Sides outside this range (in the file's unit) do not survive the arithmetic of single precision.
const SIDES: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

/// The volume in a file: by its first bytes, else by its ending; with `raw`, bare voxels in that layout.
///
/// # Errors
/// When the file cannot be read, is of no known format, or does not hold what its header or `raw` says.
pub fn volume(path: &Path, raw: Option<RawLayout>) -> Result<Volume> {
    let (mut file, length) = open(path)?;
    let longest = FORMATS.iter().map(|f| f.magic.len()).max().unwrap_or(0) as u64;
    let mut start = Vec::new();
    file.by_ref().take(longest).read_to_end(&mut start).map_err(|e| unreadable(path, &e))?;
    let by_magic = FORMATS.iter().find(|f| start.starts_with(f.magic));
    let by_extension = || {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        FORMATS.iter().find(|f| f.extensions.contains(&extension.as_str()))
    };
    let volume = match (by_magic, raw) {
        (Some(format), Some(_)) => {
            let problem = format!("is a {} file, which says its own sizes", format.name);
            return Err(Error::input(path.display(), problem, "leave out dims, type and spacing"));
        }
        (None, Some(layout)) => raw::volume(path, &layout)?,
        (Some(format), None) => (format.read)(path)?,
        (None, None) => match by_extension() {
            Some(format) => (format.read)(path)?,
            None => {
                let known: Vec<_> =
                    FORMATS.iter().map(|f| format!("{} (.{})", f.name, f.extensions.join(", ."))).collect();
                let remedy = format!(
                    "give a file of {}, or dims and type for raw voxels; scene files end in .toml",
                    known.join(", ")
                );
                let problem = format!("is of no known volume format ({length} bytes)");
                return Err(Error::input(path.display(), problem, remedy));
            }
        },
    };
    let sides = [0, 1, 2].map(|a| volume.dims[a] as f64 * volume.spacing[a]);
    if !sides.iter().all(|s| SIDES.contains(s)) {
        let remedy = format!("give a spacing that keeps them from {:e} to {:e}", SIDES.start(), SIDES.end());
        return Err(Error::input(path.display(), format!("has the sides {sides:?}"), remedy));
    }
    Ok(volume)
}

/// A regular file and its length in bytes. A pipe or device is refused: its length is not known beforehand.
fn open(path: &Path) -> Result<(File, u64)> {
    let meta = std::fs::metadata(path).map_err(|e| unreadable(path, &e))?;
    if !meta.is_file() {
        return Err(Error::input(path.display(), "is not a regular file", "give the path of a file"));
    }
    Ok((File::open(path).map_err(|e| unreadable(path, &e))?, meta.len()))
}

/// The text of a regular file.
fn text(path: &Path) -> Result<String> {
    let (mut file, _) = open(path)?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|e| unreadable(path, &e))?;
    String::from_utf8(bytes).map_err(|e| {
        let problem = format!("is not UTF-8 text (byte {})", e.utf8_error().valid_up_to());
        Error::input(path.display(), problem, "give a text file")
    })
}

fn unreadable(path: &Path, error: &std::io::Error) -> Error {
    Error::input(path.display(), format!("cannot be read ({error})"), "check the path and its permissions")
}
