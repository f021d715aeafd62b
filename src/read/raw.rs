//! Bare voxels, x fastest: everything but the bytes is said by the caller.

use std::path::Path;

use super::voxels::{self, Fault};
use crate::error::{Error, Result};
use crate::scene::volume::{Volume, VoxelType};

/// What a raw file does not say itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawLayout {
    /// Voxels along x, y and z.
    pub dims: [usize; 3],
    pub voxel_type: VoxelType,
    /// Distance of voxel centres along x, y and z.
    pub spacing: [f64; 3],
    /// Whether the highest byte of a number comes first.
    pub big_endian: bool,
}

/// # Errors
/// When the file cannot be read or is not exactly as long as `layout` asks for.
pub fn volume(path: &Path, layout: &RawLayout) -> Result<Volume> {
    let (mut file, length) = super::open(path)?;
    let bad = |problem: String, remedy: &str| Err(Error::input(path.display(), problem, remedy));
    let dims = layout.dims;
    let Some((count, bytes)) = extent(dims, layout.voxel_type) else {
        return bad(format!("cannot have the sizes {dims:?}: they overflow"), "correct dims and type");
    };
    let promised = format!("{dims:?} voxels of type {} ask for {bytes}", type_name(layout.voxel_type));
    if length != bytes {
        return bad(format!("holds {length} bytes where {promised}"), "correct dims and type or complete the file");
    }
    match voxels::binary(&mut file, layout.voxel_type, count, layout.big_endian) {
        Ok(voxels) => Volume::new(path.display().to_string(), dims, layout.spacing, voxels),
        Err(Fault::Read(e)) => Err(super::unreadable(path, &e)),
        Err(Fault::Memory) => {
            bad(format!("needs {bytes} bytes of memory, which are not to be had"), "use a smaller volume")
        }
        Err(Fault::Short { bytes: n }) => bad(format!("ends after {n} bytes where {promised}"), "complete the file"),
        Err(Fault::Long) => bad(format!("grew while it was read: {promised}"), "read it when it is complete"),
    }
}

/// Voxels and bytes of such a volume; none where they overflow.
pub(super) fn extent(dims: [usize; 3], voxel_type: VoxelType) -> Option<(usize, u64)> {
    let count = dims.iter().try_fold(1usize, |n, &d| n.checked_mul(d))?;
    let bytes = count.checked_mul(voxel_type.bytes())?;
    Some((count, u64::try_from(bytes).ok()?))
}

/// As on the command line: `u8`.
pub(super) fn type_name(voxel_type: VoxelType) -> String {
    format!("{voxel_type:?}").to_lowercase()
}
