//! Absorption and emission over a stretch of a ray on which the transfer function is one linear piece.

use std::sync::LazyLock;

use super::cubic::Cubic;
use crate::math::interpolate::mix;
use crate::scene::transfer::{Knot, TransferFunction};

/// Error allowed to a ray, in opacity and in colour.
pub const TOLERANCE: f64 = 1e-10;

/// The least share of the tolerance that a panel is given.
const LEAST_SHARE: f64 = 1e-3;

/// Points of the Gauss-Legendre rule: order 12 in the length of a panel.
const POINTS: usize = 6;

/// A cubic that goes one way over a stretch is nowhere steeper than three times its mean.
const STEEPEST: f64 = 3.0;

/// Halvings after which a panel is taken as it is: its length is then below the rounding of the ray parameter.
const DEEPEST: u32 = 52;

/// Gauss-Legendre nodes and weights on [0, 1], and the collocation matrix that integrates from 0 to each node.
struct Quadrature {
    nodes: [f64; POINTS],
    weights: [f64; POINTS],
    to_node: [[f64; POINTS]; POINTS],
}

static RULE: LazyLock<Quadrature> = LazyLock::new(|| {
    let mut nodes = [0.0; POINTS];
    let mut weights = [0.0; POINTS];
    for i in 0..POINTS {
        // Newton on the Legendre polynomial from Tricomi's guess; the guess is good to three digits.
        let mut x = -(std::f64::consts::PI * (i as f64 + 0.75) / (POINTS as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut previous, mut value) = (1.0, x);
            for n in 2..=POINTS {
                let n = n as f64;
                (previous, value) = (value, ((2.0 * n - 1.0) * x * value - (n - 1.0) * previous) / n);
            }
            slope = POINTS as f64 * (x * value - previous) / (x * x - 1.0);
            x -= value / slope;
        }
        nodes[i] = 0.5 * (1.0 + x);
        weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    // The Lagrange polynomial of node k has degree POINTS - 1, so the rule itself integrates it exactly.
    let lagrange = |k: usize, t: f64| -> f64 {
        (0..POINTS).filter(|&m| m != k).map(|m| (t - nodes[m]) / (nodes[k] - nodes[m])).product()
    };
    let to_node = std::array::from_fn(|j| {
        std::array::from_fn(|k| (0..POINTS).map(|m| nodes[j] * weights[m] * lagrange(k, nodes[j] * nodes[m])).sum())
    });
    Quadrature { nodes, weights, to_node }
});

/// One linear piece of a transfer function, between two knots or beyond them all.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    from: Knot,
    to: Knot,
}

impl Segment {
    /// The piece around `x`; at a knot, the one that starts there, as the later point of a jump counts.
    pub fn around(transfer: &TransferFunction, x: f64) -> Self {
        let knots = transfer.knots();
        let above = knots.partition_point(|k| k.x <= x);
        let from = knots[above.saturating_sub(1)];
        // Beyond the first and the last knot the function is constant.
        let to = if above == 0 { from } else { knots.get(above).copied().unwrap_or(from) };
        Self { from, to }
    }

    /// The function at `x` alone, for a stretch on which the scalar does not change.
    pub fn at(transfer: &TransferFunction, x: f64) -> Self {
        let [r, g, b, opacity] = transfer.evaluate(x);
        let knot = Knot { x, color: [r, g, b], opacity };
        Self { from: knot, to: knot }
    }

    pub fn is_invisible(&self) -> bool {
        self.from.opacity == 0.0 && self.to.opacity == 0.0
    }

    pub fn is_opaque(&self) -> bool {
        self.from.opacity == 1.0 && self.to.opacity == 1.0
    }

    /// Place of `x` in the piece, 0 at `from` and 1 at `to`.
    fn weight(&self, x: f64) -> f64 {
        if self.to.x > self.from.x { ((x - self.from.x) / (self.to.x - self.from.x)).clamp(0.0, 1.0) } else { 0.0 }
    }

    pub fn color(&self, x: f64) -> [f64; 3] {
        let weight = self.weight(x);
        std::array::from_fn(|c| mix(self.from.color[c], self.to.color[c], weight))
    }

    /// Change of the colour over the piece.
    pub fn color_change(&self) -> [f64; 3] {
        std::array::from_fn(|c| self.to.color[c] - self.from.color[c])
    }

    /// A change of x over a panel in parts of the piece. A stretch does not leave its piece; where the piece is so narrow or
    /// values so steep that rounding says it does, numbers would go beyond f64.
    fn part(&self, change: f64) -> f64 {
        let width = self.to.x - self.from.x;
        if width > 0.0 { (change / width).clamp(-STEEPEST, STEEPEST) } else { 0.0 }
    }

    /// Extinction per reference length, `-ln(1 - alpha)`.
    pub fn extinction(&self, x: f64) -> f64 {
        let weight = self.weight(x);
        let alpha = mix(self.from.opacity, self.to.opacity, weight);
        if alpha < 0.5 {
            -(-alpha).ln_1p()
        } else {
            // The transparency interpolated by itself keeps its digits where it goes to 0. It is 0 only at a point,
            // where the logarithm is integrable; the least positive value keeps a node that hits it finite.
            let clear = (1.0 - self.from.opacity) * (1.0 - weight) + (1.0 - self.to.opacity) * weight;
            -clear.max(f64::MIN_POSITIVE).ln()
        }
    }
}

/// What a stretch does to light: enough to composite stretches, and to colour them afterwards.
#[derive(Clone, Copy, Debug, Default)]
pub struct StretchEffect {
    /// Optical depth.
    pub tau: f64,
    /// integral of w(s) sigma(s) exp(-tau(s)) ds, with w the part of the piece that x has gone since the begin: times the
    /// colour's change over the piece, what its change along the stretch adds to `color(begin) * opacity`.
    pub rise: f64,
}

impl StretchEffect {
    pub fn opacity(&self) -> f64 {
        -(-self.tau).exp_m1()
    }

    /// This stretch in front of `behind`, which begins where x is `higher` by so much of the piece.
    fn over(&self, behind: &Self, higher: f64) -> Self {
        let rise = self.rise + (-self.tau).exp() * (higher * behind.opacity() + behind.rise);
        Self { tau: self.tau + behind.tau, rise }
    }
}

/// The medium of one stretch: x over the ray parameter, one piece of the transfer function, and the tolerance.
pub struct Medium<'a> {
    pub x: &'a Cubic,
    pub segment: &'a Segment,
    /// Reference lengths per unit of the parameter.
    pub scale: f64,
    /// Shares of the whole ray per unit of the parameter.
    pub share: f64,
    /// Largest change of colour: brings an error of `rise` to one of colour.
    pub steepest: f64,
}

impl Medium<'_> {
    /// The stretch [a, b] behind a medium of the given `transmittance`.
    pub fn stretch(&self, a: f64, b: f64, transmittance: f64) -> StretchEffect {
        if self.x.is_constant() {
            return StretchEffect { tau: self.segment.extinction(self.x.at(a)) * self.scale * (b - a), rise: 0.0 };
        }
        self.halved(a, b, self.panel(a, b), transmittance, DEEPEST)
    }

    /// Compares a panel with its two halves and goes on into them until both say the same. Halving towards a
    /// logarithmic pole of sigma halves its error each time, so that too ends soon.
    fn halved(&self, a: f64, b: f64, whole: StretchEffect, transmittance: f64, left: u32) -> StretchEffect {
        let middle = 0.5 * (a + b);
        let (mut front, mut back) = (self.panel(a, middle), self.panel(middle, b));
        let higher = self.segment.weight(self.x.at(middle)) - self.segment.weight(self.x.at(a));
        let both = front.over(&back, higher);
        let change = (both.opacity() - whole.opacity()).abs().max(self.steepest * (both.rise - whole.rise).abs());
        let allowed = TOLERANCE * (self.share * (b - a)).max(LEAST_SHARE);
        if left == 0 || transmittance * change <= allowed {
            return both;
        }
        front = self.halved(a, middle, front, transmittance, left - 1);
        back = self.halved(middle, b, back, transmittance * (-front.tau).exp(), left - 1);
        front.over(&back, higher)
    }

    /// One application of the rule. By parts, `rise` is integral of w'(s) (exp(-tau(s)) - exp(-tau(end))) ds,
    /// which stays bounded where sigma does not.
    fn panel(&self, a: f64, b: f64) -> StretchEffect {
        let rule = &*RULE;
        let length = b - a;
        let place = rule.nodes.map(|node| a + length * node);
        let sigma = place.map(|s| self.segment.extinction(self.x.at(s)) * self.scale * length);
        let dot = |weights: &[f64; POINTS]| weights.iter().zip(sigma).map(|(w, s)| w * s).sum::<f64>();
        let tau = dot(&rule.weights);
        let end = (-tau).exp();
        let rise: f64 = (0..POINTS)
            .map(|j| {
                let gone = self.segment.part(length * self.x.slope(place[j]));
                // The polynomial through steep sigma may leave what the way to a node can be.
                let to_node = dot(&rule.to_node[j]).clamp(0.0, tau);
                rule.weights[j] * gone * ((-to_node).exp() - end)
            })
            .sum();
        // Light of the stretch has a colour of the piece, however steep sigma is.
        let (begin, opacity) = (self.segment.weight(self.x.at(a)), 1.0 - end);
        StretchEffect { tau, rise: rise.clamp(-begin * opacity, (1.0 - begin) * opacity) }
    }
}
