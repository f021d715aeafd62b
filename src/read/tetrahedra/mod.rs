//! Meshes of cells: files of the Visualization Toolkit, whose linear cells are cut into tetrahedra.
//!
//! **To add a format**: one file here that makes [`CellData`] of it, one line in [`FORMATS`], the robustness tests of `tests/read`.

mod arrays;
mod cells;
mod legacy;
mod vtu;
mod vtu_values;

use std::path::Path;

use self::cells::CellData;
use crate::error::Result;
use crate::scene::settings::Component;
use crate::scene::tetrahedra::Grid;

/// A format of meshes of cells.
struct CellFormat {
    /// Whether a file that begins with these bytes is one.
    recognises: fn(&[u8]) -> bool,
    read: fn(&Path, &[u8]) -> Result<CellData>,
}

static FORMATS: [CellFormat; 2] = [
    CellFormat { recognises: legacy::recognises, read: legacy::read },
    CellFormat { recognises: vtu::recognises, read: vtu::read },
];

/// Bytes by which a format is recognised.
const START: usize = 256;

/// The mesh of cells in a file; none where the file is something else. Of several arrays of values `array` is taken, and of those that
/// have several for each point `component`.
///
/// # Errors
/// When the file cannot be read, does not hold what it says, has no such array, or cells that cannot be cut.
pub fn tetrahedra(path: &Path, array: Option<&str>, component: Option<Component>) -> Result<Option<Grid>> {
    use std::io::Read;
    let (mut file, _) = super::open(path)?;
    let mut start = Vec::new();
    let read = file.by_ref().take(START as u64).read_to_end(&mut start);
    read.map_err(|e| super::unreadable(path, &e))?;
    let Some(format) = FORMATS.iter().find(|format| (format.recognises)(&start)) else { return Ok(None) };
    let data = (format.read)(path, &super::bytes(path)?)?;
    data.grid(path, array, component).map(Some)
}
