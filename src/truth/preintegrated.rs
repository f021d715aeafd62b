//! Pre-integrated classification: a table of what the transfer function makes of all values between those at the two ends
//! of a step, as the value goes evenly from one to the other. Twin of `glsl/shared/preintegrated.glsl`, and where the
//! table comes from.
//!
//! The table's axes have a node at every knot of the transfer function, so that what shows nothing shows nothing in the
//! table either, and its bends are met exactly; beyond its knots they reach to the values there are.

use rayon::prelude::*;

use super::exact::Absorber;
use crate::error::{Error, Result};
use crate::math::interpolate::mix;
use crate::math::opacity::corrected_opacity;
use crate::projection;
use crate::scene::settings::{Alpha, Filter, Offset};
use crate::scene::transfer::Knot;
use crate::scene::{Scene, TransferFunction};

/// Intervals that are shared out among the pieces of a transfer function by their lengths, at least one each.
const INTERVALS: f64 = 448.0;

/// Intervals of what lies beyond the first or the last knot.
const BEYOND: u32 = 32;

/// Knots a transfer function may have: the table is as large as the square of its pieces.
pub const MOST_KNOTS: usize = 512;

/// Nodes along each axis of a scene's table.
pub fn nodes(scene: &Scene) -> usize {
    let pieces = axis(&scene.transfer, scene.field.extremes().map(f64::from));
    pieces.iter().map(|piece| piece.intervals as usize + 1).sum()
}

/// Whether a scene may be classified by a table, where it asks for it.
///
/// # Errors
/// When it shows values and no colours, takes samples in the middle of steps or those of the nearest voxels, has cells without values, or a transfer
/// function of more points than [`MOST_KNOTS`].
pub fn check(scene: &Scene) -> Result<()> {
    let (sampling, knots) = (&scene.settings.sampling, scene.transfer.knots().len());
    let refuse = |problem: String, remedy: &str| {
        Err(Error::usage("sampling.classification (--classification) pre-integrated", problem, remedy))
    };
    match () {
        () if !scene.has_step_table() => Ok(()),
        () if projection::of(&scene.settings).shows_values() => refuse(
            format!(
                "makes colours of values, and the projection {} shows values",
                projection::of(&scene.settings).name
            ),
            "use --projection composite, or --classification post",
        ),
        () if sampling.offset != Offset::Left => {
            refuse("takes values at both ends of a step, not in its middle".into(), "use --offset left")
        }
        () if sampling.filter == Filter::Nearest => refuse(
            "takes a value to go evenly from one sample to the next, and that of the nearest voxel does not".into(),
            "use --filter hardware or exact, or --classification post",
        ),
        () if scene.field.holes.is_some() => refuse(
            "needs values all along a ray, and this volume has cells without".into(),
            "use --nan replace, or --classification post",
        ),
        () if knots > MOST_KNOTS => refuse(
            format!("makes its table for at most {MOST_KNOTS} points, and {} has {knots}", scene.transfer.name),
            "use a transfer function of fewer points, or --classification post",
        ),
        () => Ok(()),
    }
}

/// Premultiplied colour and opacity of a step, by the values at its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct PreintegratedTable {
    pub pieces: Vec<TablePiece>,
    /// Nodes along each axis.
    pub nodes: usize,
    /// `[back][front]`.
    pub texels: Vec<[f32; 4]>,
}

/// A piece of the axes: before the first knot, between two knots, or after the last one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TablePiece {
    /// Where it begins and ends, x.
    pub x: [f64; 2],
    /// Its first node.
    pub first: u32,
    pub intervals: u32,
}

/// A place on an axis at which the table is made.
#[derive(Clone, Copy)]
struct Node {
    x: f64,
    /// Colour and opacity there, as the limit from inside its piece.
    knot: Knot,
}

impl PreintegratedTable {
    /// The table for the scene's transfer function and step; see [`check`].
    pub fn new(scene: &Scene) -> Self {
        let (transfer, sampling) = (&scene.transfer, &scene.settings.sampling);
        let pieces = axis(transfer, scene.field.extremes().map(f64::from));
        let nodes: Vec<Node> = pieces.iter().enumerate().flat_map(|(i, piece)| nodes_of(transfer, i, piece)).collect();
        let lengths = match sampling.alpha {
            Alpha::Exponential => sampling.step / transfer.reference,
            Alpha::Paper => 1.0,
        };
        let medium = Absorber::new(transfer);
        let texel = |front: &Node, back: &Node| -> [f32; 4] {
            let rgba = if front.x == back.x {
                let alpha = corrected_opacity(back.knot.opacity, lengths);
                let [r, g, b] = back.knot.color.map(|c| c * alpha);
                [r, g, b, alpha]
            } else {
                medium.ramp(front.x, back.x, lengths)
            };
            rgba.map(|c| c as f32)
        };
        let texels = nodes.par_iter().flat_map_iter(|back| nodes.iter().map(move |front| texel(front, back))).collect();
        Self { pieces, nodes: nodes.len(), texels }
    }

    pub fn bytes(&self) -> u64 {
        size_of_val(self.texels.as_slice()) as u64
    }

    /// Place of the value `x` on the axes, in nodes.
    pub fn node(&self, x: f64) -> f64 {
        let above = self.pieces.partition_point(|piece| piece.x[0] <= x);
        let piece = &self.pieces[above.saturating_sub(1)];
        let length = piece.x[1] - piece.x[0];
        let weight = if length > 0.0 { ((x - piece.x[0]) / length).clamp(0.0, 1.0) } else { 0.0 };
        f64::from(piece.first) + weight * f64::from(piece.intervals)
    }

    /// Premultiplied colour of a whole step whose values go from that of node `front` to that of node `back`.
    pub fn between(&self, front: f64, back: f64) -> [f64; 4] {
        let last = self.nodes - 1;
        let (x, y) = ((front as usize).min(last), (back as usize).min(last));
        let (wx, wy) = (front - x as f64, back - y as f64);
        let at = |x: usize, y: usize, c: usize| f64::from(self.texels[y.min(last) * self.nodes + x.min(last)][c]);
        std::array::from_fn(|c| {
            let along = |y: usize| mix(at(x, y, c), at(x + 1, y, c), wx);
            mix(along(y), along(y + 1), wy)
        })
    }
}

/// The same for a part of a step, in steps: its opacity exactly, its colour as if it were one all along.
pub fn part_of(whole: [f64; 4], steps: f64, alpha: Alpha) -> [f64; 4] {
    if steps == 1.0 || whole[3] <= 0.0 {
        return whole;
    }
    let part = match alpha {
        Alpha::Exponential => corrected_opacity(whole[3], steps),
        Alpha::Paper => whole[3] * steps,
    };
    let [r, g, b] = [0, 1, 2].map(|c| whole[c] * part / whole[3]);
    [r, g, b, part]
}

/// Pieces of the axes for values from `low` to `high`.
fn axis(transfer: &TransferFunction, [low, high]: [f64; 2]) -> Vec<TablePiece> {
    let knots = transfer.knots();
    let (begin, end) = (knots[0].x, knots[knots.len() - 1].x);
    let inner = knots.windows(2).map(|pair| [pair[0].x, pair[1].x]);
    let all = std::iter::once([low.min(begin), begin]).chain(inner).chain([[end, high.max(end)]]);
    let mut first = 0;
    all.enumerate()
        .map(|(i, x)| {
            let share = INTERVALS * (x[1] - x[0]) / (end - begin);
            let intervals = match i {
                _ if x[0] == x[1] => 1,
                0 => BEYOND,
                i if i == knots.len() => BEYOND,
                _ => share.ceil() as u32,
            };
            let piece = TablePiece { x, first, intervals };
            first += intervals + 1;
            piece
        })
        .collect()
}

fn nodes_of(transfer: &TransferFunction, index: usize, piece: &TablePiece) -> impl Iterator<Item = Node> {
    let knots = transfer.knots();
    let (from, to) = (knots[index.saturating_sub(1)], knots[index.min(knots.len() - 1)]);
    let TablePiece { x, intervals, .. } = *piece;
    (0..=intervals).map(move |i| {
        let weight = f64::from(i) / f64::from(intervals);
        // The ends to the bit.
        let x = if i == intervals { x[1] } else { mix(x[0], x[1], weight) };
        let color = std::array::from_fn(|c| mix(from.color[c], to.color[c], weight));
        Node { x, knot: Knot { x, color, opacity: mix(from.opacity, to.opacity, weight) } }
    })
}
