//! Where the voxels of a distance field lie.

use glam::DVec3;

use crate::math::bvh::Bounds;
use crate::scene::builtin::{MAX_SIZE, MAX_VOXELS};
use crate::scene::limits::WrongValue;

/// Voxels along the longest side of a mesh where nothing is said.
pub const DEFAULT_SIDE: usize = 256;

/// What rounding may add to a number of voxels.
const ROUNDING: f64 = 1e-9;

/// Voxel centres around a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    pub dims: [usize; 3],
    /// Distance of voxel centres along each axis, in the mesh's unit.
    pub spacing: f64,
    /// The middle of the mesh's box, and of all voxels, in the mesh's unit.
    middle: DVec3,
}

impl Lattice {
    /// Around a box that is more than a point, with the room to each side that a band of so many voxels takes: the outermost
    /// voxel centres are no nearer to it.
    ///
    /// # Errors
    /// When there are too few voxels along a side, or too many in all.
    pub fn around(bounds: Bounds, dims: Option<[usize; 3]>, band: f64) -> Result<Self, WrongValue> {
        let sides = (bounds.greatest - bounds.least).to_array();
        let longest = sides.into_iter().fold(0.0, f64::max);
        // Between the outermost voxel centres lie one voxel less than there are.
        let room = 2.0 * band + 1.0;
        let dims = dims.unwrap_or_else(|| {
            let voxels = |side: f64| side / longest * (DEFAULT_SIDE as f64 - room) + room;
            sides.map(|side| ((voxels(side) - ROUNDING).ceil() as usize).max(least(band).min(DEFAULT_SIDE)))
        });
        check(dims, band)?;
        let spacing = [0, 1, 2].map(|a| sides[a] / (dims[a] as f64 - room)).into_iter().fold(0.0, f64::max);
        Ok(Self { dims, spacing, middle: 0.5 * (bounds.least + bounds.greatest) })
    }

    /// A point of the mesh where voxel centres have whole coordinates, from 0 on.
    pub fn to_voxels(self, point: DVec3) -> DVec3 {
        (point - self.middle) / self.spacing + 0.5 * DVec3::from_array(self.dims.map(|n| n as f64 - 1.0))
    }
}

/// Voxels along a side at the least: those for the band to both sides, and one.
fn least(band: f64) -> usize {
    (2.0 * band + 1.0).floor() as usize + 1
}

/// Whether a distance field may have these voxels.
fn check(dims: [usize; 3], band: f64) -> Result<(), WrongValue> {
    let problem = format!("is asked for in {} x {} x {} voxels", dims[0], dims[1], dims[2]);
    let count = dims.iter().try_fold(1usize, |n, side| n.checked_mul(*side));
    if dims.iter().any(|side| *side > MAX_SIZE) || count.is_none_or(|count| count > MAX_VOXELS) {
        let remedy = format!("keep volume.dims (--dims) to {MAX_SIZE} along a side and to {MAX_VOXELS} in all");
        return Err(WrongValue { problem, remedy });
    }
    let least = least(band);
    if dims.iter().any(|side| *side < least) {
        let remedy = format!(
            "a band of {band} voxels to both sides of the surface takes volume.dims (--dims) of at least {least} along each side; \
             give more, or a smaller volume.band (--band)"
        );
        return Err(WrongValue { problem, remedy });
    }
    Ok(())
}
