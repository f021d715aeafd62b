//! What a difference of x makes of light: how far the transfer function tells values apart.

use rayon::prelude::*;

use super::code::Code;
use crate::math::opacity::extinction;
use crate::scene::Scene;
use crate::scene::transfer::Knot;

/// Nodes that what the transfer function changes by is added up at, over the values there are.
const NODES: usize = 4096;

/// Values that ranges are told apart by.
const CODES: usize = 256;

/// The greatest opacity of a reference length whose extinction is told apart from others: what is beyond it ends rays within a step.
const DENSEST: f64 = 1.0 - 1e-4;

/// The transfer function over the values that the field has, as far as it changes among them.
pub struct Response {
    low: f64,
    width: f64,
    /// What extinction over a voxel, and colour weighted by it, have changed by from the first node to each.
    changed: Vec<f64>,
}

/// The greatest difference of x that an error allows, among the values of each range.
pub struct Greatest(Vec<Code>);

impl Response {
    pub fn of(scene: &Scene) -> Self {
        let knots = scene.transfer.knots();
        // Beyond its first and its last point a transfer function stays as it is.
        let [low, high] = scene.field.extremes().map(|x| f64::from(x).clamp(knots[0].x, knots[knots.len() - 1].x));
        let width = (high - low).max(f64::MIN_POSITIVE);
        let place = |node: usize| low + width * node as f64 / (NODES - 1) as f64;
        let changed = (1..NODES).scan(0.0, |sum, node| {
            *sum += change(scene, place(node - 1), place(node));
            Some(*sum)
        });
        Self { low, width, changed: [0.0].into_iter().chain(changed).collect() }
    }

    /// What has changed from the least value up to this one.
    fn changed_to(&self, x: f64) -> f64 {
        let place = ((x - self.low) / self.width).clamp(0.0, 1.0) * (NODES - 1) as f64;
        let below = (place as usize).min(NODES - 2);
        let part = place - below as f64;
        (1.0 - part) * self.changed[below] + part * self.changed[below + 1]
    }

    /// Whether anything changes among these values.
    pub fn shows(&self, [low, high]: [f32; 2]) -> bool {
        self.changed_to(high.into()) > self.changed_to(low.into())
    }

    /// A range by the codes of its ends, no smaller than it is.
    pub fn coded(&self, [low, high]: [f32; 2]) -> [u8; 2] {
        // Values of 8 bits lie on codes, but for the rounding of f32.
        const ROUNDING: f64 = 1e-4;
        let code = |x: f32| ((f64::from(x) - self.low) / self.width).clamp(0.0, 1.0) * (CODES - 1) as f64;
        [(code(low) + ROUNDING).floor() as u8, (code(high) - ROUNDING).ceil().max(0.0) as u8]
    }

    /// What is wrong over a voxel where x lies between two values and is taken for another one that is off by up to `by`: of all that
    /// changes within, the part that lies between the two in the mean.
    fn error(&self, [low, high]: [f64; 2], by: f64) -> f64 {
        let (low, high) = (low - by, high + by);
        let changes = self.changed_to(high) - self.changed_to(low);
        changes * (2.0 * by / (high - low)).min(1.0)
    }

    /// The greatest differences of x with which the error over a voxel is no larger than `bound`.
    pub fn greatest(&self, bound: f64) -> Greatest {
        let value = |code: usize| self.low + self.width * code as f64 / (CODES - 1) as f64;
        let of_range = |i: usize| {
            let (low, high) = (i / CODES, i % CODES);
            let allowed = |code: u8| self.error([value(low), value(high)], Code(code).number()) <= bound;
            if high < low || allowed(Code::MOST.0) {
                return Code::MOST;
            }
            let (mut kept, mut beyond) = (Code::NONE.0, Code::MOST.0);
            while beyond - kept > 1 {
                let middle = kept + (beyond - kept) / 2;
                if allowed(middle) { kept = middle } else { beyond = middle }
            }
            Code(kept)
        };
        Greatest((0..CODES * CODES).into_par_iter().map(of_range).collect())
    }
}

impl Greatest {
    /// That of a range of codes.
    pub fn of(&self, [low, high]: [u8; 2]) -> Code {
        self.0[usize::from(low) * CODES + usize::from(high)]
    }
}

/// What extinction over a voxel changes by from one value to another, up and down alike, times the brightest colour there; and what
/// colour does, times the greatest extinction.
fn change(scene: &Scene, from: f64, to: f64) -> f64 {
    let reference = scene.transfer.reference;
    let sigma = |knot: &Knot| extinction(knot.opacity.min(DENSEST)) / reference;
    let at = |x: f64| {
        let [r, g, b, opacity] = scene.transfer.evaluate(x);
        Knot { x, color: [r, g, b], opacity }
    };
    let inside = scene.transfer.knots().iter().filter(|knot| from < knot.x && knot.x <= to).copied();
    let mut before = at(from);
    let mut sum = 0.0;
    for knot in inside.chain([at(to)]) {
        let (a, b) = (sigma(&before), sigma(&knot));
        let color = (0..3).map(|c| (knot.color[c] - before.color[c]).abs()).fold(0.0, f64::max);
        let brightest = before.color.iter().chain(&knot.color).copied().fold(1.0, f64::max);
        sum += brightest * (b - a).abs() + a.max(b) * color;
        before = knot;
    }
    sum
}
