//! Where in a volume anything may show: boxes of cells, as large as they are known without a structure.

use glam::DVec3;

use super::cells::{Support, widened};
use super::ranges::ranges;
use crate::projection::Shown;
use crate::scene::texture::TextureChoice;
use crate::scene::{Field, Scene};

/// Blocks along the longest side of a volume.
const BLOCKS: usize = 32;

/// Boxes, each by two corners in volume space, that hold all that shows; without `hidden` none of blocks that have such beside each of their
/// faces, since nothing is seen of them from anywhere that is not seen of those.
pub fn boxes(scene: &Scene, hidden: bool) -> Vec<[DVec3; 2]> {
    let field = &*scene.field;
    let side = side(field);
    let support = Support::of(&Shown::in_x(scene));
    // What a texture unit makes of a value is no farther from it.
    let error = TextureChoice::of(scene).error as f32;
    let blocks = field.cells().map(|cells| cells.div_ceil(side));
    let shows = |&[low, high]: &[f32; 2]| {
        // A background of 0 is kept as it is.
        let error = if low == 0.0 && high == 0.0 { 0.0 } else { error };
        let [low, high] = widened(low - error, high + error);
        support.meets(low, high)
    };
    let open: Vec<bool> = field.block_ranges(|field| ranges(field, side).1).iter().map(shows).collect();
    let strides = [1, blocks[0], blocks[0] * blocks[1]];
    let place = |i: usize| [0, 1, 2].map(|axis| i / strides[axis] % blocks[axis]);
    let surrounded = |i: usize| {
        let at = place(i);
        (0..3).all(|axis| {
            let inside = at[axis] > 0 && at[axis] + 1 < blocks[axis];
            inside && open[i - strides[axis]] && open[i + strides[axis]]
        })
    };
    let corners = |i: usize| {
        let at = place(i);
        let corner =
            |end: usize| DVec3::from_array([0, 1, 2].map(|axis| coordinate(field, axis, (at[axis] + end) * side)));
        [corner(0), corner(1)].map(|corner| corner * field.extent())
    };
    (0..open.len()).filter(|i| open[*i] && (hidden || !surrounded(*i))).map(corners).collect()
}

fn side(field: &Field) -> usize {
    field.cells().into_iter().max().unwrap_or(1).div_ceil(BLOCKS)
}

/// Where a cell begins along an axis, in sides of the volume from its middle; border cells reach to the faces.
fn coordinate(field: &Field, axis: usize, cell: usize) -> f64 {
    let voxels = field.dims()[axis] as f64;
    match cell {
        0 => -0.5,
        cell if cell >= field.cells()[axis] => 0.5,
        cell => (cell as f64 + 0.5) / voxels - 0.5,
    }
}
