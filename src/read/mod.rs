//! Bytes in, scene parts out: volumes, meshes, transfer functions, scene files.
//!
//! No reader trusts a header: memory is taken for what a file holds, never for what it promises, and a file is
//! right only when it holds what its header says; what follows is told in a warning.
//!
//! **To add a volume format**: one file here, one line in [`FORMATS`], the robustness tests of `tests/read`.

mod backdrop;
pub mod content;
mod effect;
mod environment;
mod exr_header;
mod keys;
pub mod mesh;
pub mod nrrd;
mod orient;
mod packed;
mod pick;
pub mod raw;
pub mod scene;
mod source;
mod tetrahedra;
pub mod transfer;
mod values;
mod voxels;

use std::fs::File;
use std::io::{Read, Seek};
use std::path::Path;

pub use backdrop::backdrop;
pub use effect::effect;
pub use environment::environment;
pub use mesh::mesh;
pub use raw::{ByteSkip, RawLayout};
pub use scene::{says, scene, scene_of, settings, settings_from_json, settings_of};
pub use tetrahedra::tetrahedra;
pub use transfer::transfer;

use self::packed::{Members, Packing};
use self::source::ByteSource;
use crate::error::{Error, Result};
use crate::scene::Volume;
use crate::scene::settings::{Component, Orientation};

/// What is taken of a file that holds more than one scalar volume, and how it is laid into volume space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReadChoice<'a> {
    /// The value that is taken of several values of a voxel.
    pub component: Option<Component>,
    /// The volume that is taken of a sequence, or the slice of a stack.
    pub frame: Option<usize>,
    pub orientation: Orientation,
    /// Values that stand for none.
    pub no_data: &'a [f64],
}

/// A volume format that says its own sizes.
pub struct Format {
    pub name: &'static str,
    /// Usual endings of its files, lower case.
    pub extensions: &'static [&'static str],
    /// How its files begin.
    pub magic: &'static [u8],
    read: fn(&Path, ByteSource, &ReadChoice) -> Result<Volume>,
}

pub static FORMATS: [Format; 1] =
    [Format { name: "NRRD", extensions: &["nrrd", "nhdr"], magic: b"NRRD", read: nrrd::volume }];

/// Sides outside this range (in the file's unit) do not survive the arithmetic of single precision.
const SIDES: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

/// What some editors put in front of UTF-8 text.
const BYTE_ORDER_MARK: &[u8] = &[0xef, 0xbb, 0xbf];

/// The volume in a file that holds one.
///
/// # Errors
/// As [`volume_with`].
pub fn volume(path: &Path, raw: Option<RawLayout>) -> Result<Volume> {
    volume_with(path, raw, &ReadChoice::default())
}

/// The volume in a file: by its first bytes, also where gzip packed it, else by its ending; with `raw`, bare voxels in that
/// layout.
///
/// # Errors
/// When the file cannot be read, is of no known format, does not hold what its header or `raw` says, or not what is
/// chosen of it.
pub fn volume_with(path: &Path, raw: Option<RawLayout>, choice: &ReadChoice) -> Result<Volume> {
    let (mut file, length) = open(path)?;
    let start = start(&mut file).map_err(|e| unreadable(path, &e))?;
    let by_magic = by_magic(&start);
    let packed = by_magic.is_none() && start.starts_with(Packing::Gzip.magic());
    file.rewind().map_err(|e| unreadable(path, &e))?;
    // What cannot be unpacked is not packed.
    let unpacked = packed.then(|| self::start(Members::new(Packing::Gzip, std::io::BufReader::new(&mut file))).ok());
    let in_gzip = unpacked.flatten().and_then(|start| self::by_magic(&start));
    file.rewind().map_err(|e| unreadable(path, &e))?;
    let mut volume = match (by_magic.or(in_gzip), raw) {
        (Some(format), Some(_)) => {
            let problem = format!("is an {} file, which says its own sizes", format.name);
            let remedy = "leave out dims, type, spacing, endian and skip";
            return Err(Error::input(path.display(), problem, remedy));
        }
        (None, Some(layout)) => {
            choice.not_of(path, "raw voxels")?;
            raw::volume(path, &layout)?
        }
        (Some(format), None) => {
            let source =
                if in_gzip.is_some() { ByteSource::packed(file, length) } else { ByteSource::plain(file, length) };
            (format.read)(path, source, choice)?
        }
        (None, None) => match by_extension(path) {
            Some(format) => (format.read)(path, ByteSource::plain(file, length), choice)?,
            None => return Err(unknown(path, length)),
        },
    };
    check_sides(&volume, "give a spacing")?;
    let rounded = voxels::rounded(&volume.voxels);
    if rounded > 0 {
        volume
            .warnings
            .push(format!("{rounded} voxels are integers beyond 2^53, which are rounded to the nearest f64"));
    }
    Ok(volume)
}

/// Whether the sides of a volume are of a length that arithmetic survives; `remedy` has them so.
///
/// # Errors
/// When one is not.
fn check_sides(volume: &Volume, remedy: &str) -> Result<()> {
    let sides = [0, 1, 2].map(|a| volume.dims[a] as f64 * volume.spacing[a]);
    if sides.iter().all(|s| SIDES.contains(s)) {
        return Ok(());
    }
    let remedy = format!("{remedy} that keeps them from {:e} to {:e}", SIDES.start(), SIDES.end());
    Err(Error::input(&volume.name, format!("has the sides {sides:?}"), remedy))
}

impl ReadChoice<'_> {
    /// Whether what is chosen is there in what holds one scalar volume: the first component of the first frame.
    ///
    /// # Errors
    /// When another component or frame is chosen.
    fn not_of(&self, name: impl AsRef<Path>, what: &str) -> Result<()> {
        let component = self.component.filter(|c| *c != Component::Number(0)).map(|c| ("component", c.to_string()));
        let frame = self.frame.filter(|n| *n != 0).map(|n| ("frame", n.to_string()));
        let Some((key, value)) = component.or(frame) else { return Ok(()) };
        let input = format!("{}: volume.{key} (--{key})", name.as_ref().display());
        Err(Error::input(input, format!("is {value}, and {what} are one volume of one value a voxel"), "leave it out"))
    }
}

/// The first bytes, as many as any format begins with, without a byte order mark.
fn start(stream: impl Read) -> std::io::Result<Vec<u8>> {
    let longest = FORMATS.iter().map(|f| f.magic.len()).max().unwrap_or(0) + BYTE_ORDER_MARK.len();
    let mut start = Vec::new();
    stream.take(longest as u64).read_to_end(&mut start)?;
    if start.starts_with(BYTE_ORDER_MARK) {
        start.drain(..BYTE_ORDER_MARK.len());
    }
    Ok(start)
}

fn by_magic(start: &[u8]) -> Option<&'static Format> {
    FORMATS.iter().find(|f| start.starts_with(f.magic))
}

fn by_extension(path: &Path) -> Option<&'static Format> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    FORMATS.iter().find(|f| f.extensions.contains(&extension.as_str()))
}

fn unknown(path: &Path, length: u64) -> Error {
    let known: Vec<_> = FORMATS.iter().map(|f| format!("{} (.{})", f.name, f.extensions.join(", ."))).collect();
    let is_mesh = mesh::by_extension(path).is_some();
    let remedy = match is_mesh {
        true => "give a mesh as volume.mesh in a scene file, for its distance field, or as path of a table [[mesh]]"
            .to_owned(),
        false => {
            format!(
                "give a file of {}, VTK (.vtk, .vtu, .vts, .vtr) for a mesh of cells, or dims and type for raw voxels; scene files end in .toml",
                known.join(", ")
            )
        }
    };
    Error::input(path.display(), format!("is of no known volume format ({length} bytes)"), remedy)
}

/// A regular file and its length in bytes. A pipe or device is refused: its length is not known beforehand.
fn open(path: &Path) -> Result<(File, u64)> {
    let meta = std::fs::metadata(path).map_err(|e| unreadable(path, &e))?;
    if !meta.is_file() {
        return Err(Error::input(path.display(), "is not a regular file", "give the path of a file"));
    }
    Ok((File::open(path).map_err(|e| unreadable(path, &e))?, meta.len()))
}

/// The bytes of a regular file.
///
/// # Errors
/// When it cannot be read.
fn bytes(path: &Path) -> Result<Vec<u8>> {
    let (mut file, _) = open(path)?;
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|e| unreadable(path, &e))?;
    Ok(bytes)
}

/// The text of a regular file.
///
/// # Errors
/// When it cannot be read or is not UTF-8.
pub fn text(path: &Path) -> Result<String> {
    let bytes = bytes(path)?;
    String::from_utf8(bytes).map_err(|e| {
        let problem = format!("is not UTF-8 text (byte {})", e.utf8_error().valid_up_to());
        Error::input(path.display(), problem, "give a text file")
    })
}

fn unreadable(path: &Path, error: &std::io::Error) -> Error {
    Error::input(path.display(), format!("cannot be read ({error})"), "check the path and its permissions")
}
