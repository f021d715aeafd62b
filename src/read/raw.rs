//! Bare voxels, x fastest: everything but the bytes is said by the caller.

use std::io::{Seek, SeekFrom};
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
    /// Bytes in front of the voxels.
    pub skip: ByteSkip,
}

/// Bytes in front of data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ByteSkip {
    Bytes(u64),
    /// As many as it takes for the data to be the last bytes of the file.
    ToTail,
}

impl ByteSkip {
    /// How files and options write it: -1 is [`ByteSkip::ToTail`]; none for other negative numbers.
    pub fn of(bytes: i64) -> Option<Self> {
        if bytes == -1 { Some(Self::ToTail) } else { u64::try_from(bytes).ok().map(Self::Bytes) }
    }
}

/// # Errors
/// When the file cannot be read, is shorter than `layout` asks for, or is longer and nothing is said of where in it the
/// voxels lie.
pub fn volume(path: &Path, layout: &RawLayout) -> Result<Volume> {
    let (mut file, length) = super::open(path)?;
    let bad = |problem: String, remedy: &str| Err(Error::input(path.display(), problem, remedy));
    let dims = layout.dims;
    let Some((count, bytes)) = extent(&dims, layout.voxel_type) else {
        return bad(format!("cannot have the sizes {dims:?}: they overflow"), "correct dims and type");
    };
    let promised = format!("{dims:?} voxels of type {} ask for {bytes}", type_name(layout.voxel_type));
    let (skip, behind) = match layout.skip {
        ByteSkip::Bytes(0) => (0, String::new()),
        ByteSkip::Bytes(skip) => (skip, format!(" behind the {skip} that are skipped")),
        ByteSkip::ToTail => (length.saturating_sub(bytes), String::new()),
    };
    let held = length.saturating_sub(skip);
    // Whoever says where the voxels begin knows that the file is not theirs alone.
    let more = held.saturating_sub(bytes);
    if held < bytes || more > 0 && layout.skip == ByteSkip::Bytes(0) {
        let remedy = if held < bytes {
            "correct dims, type and skip, or complete the file"
        } else {
            "correct dims and type, or say how many bytes lie in front of the voxels with --skip BYTES (-1: the rest)"
        };
        return bad(format!("holds {held} bytes{behind} where {promised}"), remedy);
    }
    file.seek(SeekFrom::Start(skip)).map_err(|e| super::unreadable(path, &e))?;
    let mut voxels = voxels::none(layout.voxel_type);
    match voxels::binary(&mut file, &mut voxels, count, layout.big_endian) {
        Ok(()) => {
            let mut volume = Volume::new(path.display().to_string(), dims, layout.spacing, voxels)?;
            let bytes = if more == 1 { "byte" } else { "bytes" };
            let warning = || format!("{} holds {more} {bytes} behind its voxels, which is not read", path.display());
            volume.warnings.extend((more > 0).then(warning));
            Ok(volume)
        }
        Err(Fault::Read(e)) => Err(super::unreadable(path, &e)),
        Err(Fault::Memory) => {
            bad(format!("needs {bytes} bytes of memory, which are not available"), "use a smaller volume")
        }
        Err(Fault::Short { bytes: n }) => bad(format!("ends after {n} bytes where {promised}"), "complete the file"),
    }
}

/// Voxels and bytes of such a volume; none where they overflow, or are more than memory could ever hold.
pub(super) fn extent(sizes: &[usize], voxel_type: VoxelType) -> Option<(usize, u64)> {
    let count = sizes.iter().try_fold(1usize, |n, &d| n.checked_mul(d))?;
    let bytes = count.checked_mul(voxel_type.bytes())?;
    isize::try_from(bytes).ok().map(|_| (count, bytes as u64))
}

/// As on the command line: `u8`.
pub(super) fn type_name(voxel_type: VoxelType) -> String {
    format!("{voxel_type:?}").to_lowercase()
}
