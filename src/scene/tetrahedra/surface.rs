//! Iso-surfaces within cells [Weiler03 "Isosurface Ray Casting"].

use glam::DVec3;

use super::{CellWay, FacePoint, Tetrahedra};

/// The gradient of x in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellGradient {
    /// Along the gradient or against it, volume space, of any length; 0 in a cell of one value, and in a flat one.
    pub along: DVec3,
    /// The sum of the sizes of the products that `along` is a sum of, over its length: what digits cancel out.
    pub cancels: f64,
}

/// Where a ray meets an iso-surface within a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MetInCell {
    /// The surface, by its number.
    pub level: usize,
    /// The part of the way through the cell in front of it.
    pub share: f64,
    pub at: FacePoint,
}

impl Tetrahedra {
    /// The gradient of x in a cell, which is the same all over it.
    pub fn gradient(&self, cell: u32) -> CellGradient {
        let corners = self.cells[cell as usize];
        let edges = [1, 2, 3].map(|i| self.point(corners[i]) - self.point(corners[0]));
        let values = corners.map(|corner| f64::from(self.values[corner as usize]));
        let parts = [0, 1, 2].map(|i| {
            let (a, b) = (edges[(i + 1) % 3], edges[(i + 2) % 3]);
            let rise = values[i + 1] - values[0];
            (a.cross(b) * rise, a.length() * b.length() * rise.abs())
        });
        let along: DVec3 = parts.iter().map(|(part, _)| *part).sum();
        let sizes: f64 = parts.iter().map(|(_, size)| *size).sum();
        CellGradient { along, cancels: if along == DVec3::ZERO { 0.0 } else { sizes / along.length() } }
    }
}

impl CellWay {
    /// The iso-surfaces of rising values, as x, that a ray meets on this way, in their order: all that it crosses, from below a value to it
    /// or back; where the ray begins the innermost that it begins within.
    pub fn meets(&self, levels: &[f64]) -> Vec<MetInCell> {
        let around = |x: f64| levels.partition_point(|level| *level <= x);
        let (within, to) = (around(self.from.value), around(self.to.value));
        let begins = (self.begins && within > 0).then(|| MetInCell { level: within - 1, share: 0.0, at: self.from });
        let crossed = |level: usize| {
            let share = (levels[level] - self.from.value) / (self.to.value - self.from.value);
            let depth = self.from.depth + share * (self.to.depth - self.from.depth);
            MetInCell { level, share, at: FacePoint { depth, value: levels[level] } }
        };
        begins.into_iter().chain((within..to).map(crossed)).chain((to..within).rev().map(crossed)).collect()
    }
}
