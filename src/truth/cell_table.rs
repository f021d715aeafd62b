//! The table of ways through cells of a mesh: what the transfer function makes of a way by the values at its ends and its length
//! [Röttger, Kraus and Ertl 2000, Weiler03 "Ray Integration"].
//!
//! All three axes have as many nodes, evenly: over the values there are, and from no length to the longest edge of any cell.

use rayon::prelude::*;

use super::exact::Absorber;
use crate::scene::Scene;

/// Premultiplied colour and opacity of ways.
#[derive(Clone, Debug, PartialEq)]
pub struct CellTable {
    pub axes: TableAxes,
    /// `[length][back][front]`.
    pub texels: Vec<[f32; 4]>,
}

/// Where the nodes of a table are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableAxes {
    /// Along each axis.
    pub nodes: usize,
    /// The first and the last value, x.
    pub values: [f64; 2],
    /// The last length, in reference lengths.
    pub longest: f64,
}

impl TableAxes {
    /// Those of a scene that shows a mesh; none of another scene.
    pub fn of(scene: &Scene) -> Option<Self> {
        let mesh = scene.tetrahedra.as_ref()?;
        let longest = mesh.longest_edge / (scene.transfer.reference * scene.field.finest());
        let values = scene.field.extremes().map(f64::from);
        Some(Self { nodes: scene.settings.sampling.table as usize, values, longest })
    }

    /// Nodes in a unit of x; 0 where there is one value alone.
    pub fn per_value(&self) -> f64 {
        let [first, last] = self.values;
        if last > first { (self.nodes - 1) as f64 / (last - first) } else { 0.0 }
    }

    /// Nodes in a reference length.
    pub fn per_length(&self) -> f64 {
        (self.nodes - 1) as f64 / self.longest
    }
}

impl CellTable {
    /// The table of a scene; none where it asks for none.
    pub fn of(scene: &Scene) -> Option<Self> {
        let axes = TableAxes::of(scene).filter(|_| scene.has_cell_table())?;
        let medium = Absorber::new(&scene.transfer);
        let n = axes.nodes;
        let value = |i: usize| {
            let part = i as f64 / (n - 1) as f64;
            axes.values[0] + part * (axes.values[1] - axes.values[0])
        };
        let texel = |i: usize| {
            let lengths = axes.longest * (i / (n * n)) as f64 / (n - 1) as f64;
            medium.ramp(value(i % n), value(i / n % n), lengths).map(|c| c as f32)
        };
        Some(Self { axes, texels: (0..n * n * n).into_par_iter().map(texel).collect() })
    }

    /// Premultiplied colour and opacity of a way of so many reference lengths, between nodes linear in all three.
    pub fn between(&self, front: f64, back: f64, lengths: f64) -> [f64; 4] {
        let axes = &self.axes;
        let last = axes.nodes - 1;
        let value = |x: f64| (x - axes.values[0]) * axes.per_value();
        let places = [value(front), value(back), lengths * axes.per_length()].map(|at| at.clamp(0.0, last as f64));
        let low = places.map(|at| (at as usize).min(last.saturating_sub(1)));
        let mut light = [0.0; 4];
        for corner in 0..8 {
            let (mut weight, mut at) = (1.0, [0; 3]);
            for axis in 0..3 {
                let part = places[axis] - low[axis] as f64;
                let up = corner >> axis & 1;
                weight *= if up == 1 { part } else { 1.0 - part };
                at[axis] = low[axis] + up;
            }
            let texel = self.texels[(at[2] * axes.nodes + at[1]) * axes.nodes + at[0]];
            light.iter_mut().zip(texel).for_each(|(c, of)| *c += weight * f64::from(of));
        }
        light
    }
}
