//! The voxels of a distance field, in cubes that are halved where the surface is near: only there each voxel asks for its own
//! distance and its own winding number.

use std::collections::TryReserveError;

use glam::DVec3;
use rayon::prelude::*;

use super::skin::{Skin, Winding};

/// Voxels along a side of the cubes that are shared out among the cores; a power of two.
const CUBE: usize = 16;

/// What winding numbers may be off by, seen from far away, before a cube is taken to lie on one side.
const MARGIN: f64 = 0.1;

/// The winding number that parts inside from outside, of either sign.
const HALF: f64 = 0.5;

/// The signed distance of every voxel, x fastest; clamped to `band`.
///
/// # Errors
/// When there is not enough memory.
pub fn fill(skin: &Skin, dims: [usize; 3], band: f64) -> Result<Vec<f32>, TryReserveError> {
    let [nx, ny, nz] = dims;
    let mut voxels = Vec::new();
    voxels.try_reserve_exact(nx * ny * nz)?;
    voxels.resize(nx * ny * nz, 0.0);
    let (across, along) = (nx.div_ceil(CUBE), ny.div_ceil(CUBE));
    let filler = Filler { skin, dims, band };
    voxels.par_chunks_mut(nx * ny * CUBE).enumerate().for_each(|(slab, voxels)| {
        let cube = |i: usize| filler.cube([i % across * CUBE, i / across * CUBE, slab * CUBE]);
        let cubes: Vec<Vec<f32>> = (0..across * along).into_par_iter().map(cube).collect();
        for (i, row) in voxels.chunks_mut(nx).enumerate() {
            let (y, z) = (i % ny, i / ny);
            for (x, piece) in row.chunks_mut(CUBE).enumerate() {
                let from = place([0, y % CUBE, z]);
                piece.copy_from_slice(&cubes[y / CUBE * across + x][from..from + piece.len()]);
            }
        }
    });
    Ok(voxels)
}

/// The place of a voxel in its cube.
fn place([x, y, z]: [usize; 3]) -> usize {
    (z * CUBE + y) * CUBE + x
}

struct Filler<'a> {
    skin: &'a Skin,
    dims: [usize; 3],
    band: f64,
}

/// A part of a cube: voxels from one on, as many along each side.
#[derive(Clone, Copy)]
struct Part {
    first: [usize; 3],
    side: usize,
}

/// What is known of a part from the larger one that it is of.
#[derive(Clone, Copy, Default)]
struct Known {
    inside: Option<bool>,
    /// The place of a triangle that is not far away.
    near: Option<usize>,
}

impl Filler<'_> {
    /// The voxels of a cube from `first` on; 0 where the volume has none.
    fn cube(&self, first: [usize; 3]) -> Vec<f32> {
        let mut cube = vec![0.0; CUBE * CUBE * CUBE];
        self.part(Part { first, side: CUBE }, Known::default(), &mut cube);
        cube
    }

    fn part(&self, part: Part, known: Known, cube: &mut [f32]) {
        let Part { first, side } = part;
        if (0..3).any(|a| first[a] >= self.dims[a]) {
            return;
        }
        let to_middle = 0.5 * (side - 1) as f64;
        let middle = DVec3::from_array(first.map(|i| i as f64 + to_middle));
        // To the centres of its outermost voxels.
        let radius = 3f64.sqrt() * to_middle;
        // Beyond this no voxel of the part is in the band.
        let reach = self.band + radius;
        let found = self.skin.nearest(middle, reach, known.near);
        let distance = found.map_or(reach, |(_, distance)| distance);
        let inside = known.inside.or_else(|| self.side_of(middle, radius, distance));
        match (inside, found) {
            (Some(inside), None) => self.put(part, signed(self.band, inside), cube),
            (Some(inside), _) if side == 1 => self.put(part, signed(distance, inside), cube),
            (inside, found) => {
                let half = side / 2;
                let known = Known { inside, near: found.map(|(place, _)| place).or(known.near) };
                for child in 0..8 {
                    let first = [0, 1, 2].map(|a| first[a] + (child >> a & 1) * half);
                    self.part(Part { first, side: half }, known, cube);
                }
            }
        }
    }

    /// Whether all within a radius lie inside, where all are on one side. `distance`: that of the surface from the middle, or one
    /// that it is beyond.
    fn side_of(&self, middle: DVec3, radius: f64, distance: f64) -> Option<bool> {
        if radius > 0.0 && distance <= radius {
            return None;
        }
        let Winding { number, change } = self.skin.winding(middle, radius, distance);
        let from_half = number.abs() - HALF;
        (radius == 0.0 || from_half.abs() > change + MARGIN).then_some(from_half >= 0.0)
    }

    /// Gives all voxels of a part a value.
    fn put(&self, Part { first, side }: Part, value: f32, cube: &mut [f32]) {
        let [x, y, z] = first.map(|i| i % CUBE);
        for z in z..z + side {
            for y in y..y + side {
                let from = place([x, y, z]);
                cube[from..from + side].fill(value);
            }
        }
    }
}

/// A distance with its sign; 0 has none.
fn signed(distance: f64, inside: bool) -> f32 {
    (if inside { distance } else { 0.0 - distance }) as f32
}
