//! The scalar along a ray inside one cell: a product of three linear weights, so a cubic of the ray parameter.

/// c0 + c1 s + c2 s^2 + c3 s^3 for s in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic(pub [f64; 4]);

impl Cubic {
    /// The interpolant of eight `corners` (x fastest) along the line whose weight on axis a, from the cell's low
    /// side (0) to its high side (1), is `start[a] + s * rise[a]`. Equal corners give an exactly constant cubic.
    pub fn of_cell(corners: [f64; 8], start: [f64; 3], rise: [f64; 3]) -> Self {
        // From corner values to the coefficients of 1, u, v, uv, w, uw, vw, uvw: a difference along each axis.
        let mut k = corners;
        for bit in [1, 2, 4] {
            for corner in (0..8).filter(|corner| corner & bit != 0) {
                k[corner] -= k[corner ^ bit];
            }
        }
        // Then each weight is put in as a polynomial of s, one axis at a time.
        let mut folded = k.map(|k| [k, 0.0, 0.0, 0.0]);
        for axis in 0..3 {
            for pair in 0..4 >> axis {
                let (plain, scaled) = (folded[2 * pair], folded[2 * pair + 1]);
                folded[pair] = std::array::from_fn(|power| {
                    let below = if power > 0 { scaled[power - 1] } else { 0.0 };
                    plain[power] + scaled[power] * start[axis] + below * rise[axis]
                });
            }
        }
        Self(folded[0])
    }

    pub fn at(&self, s: f64) -> f64 {
        let [c0, c1, c2, c3] = self.0;
        ((c3 * s + c2) * s + c1) * s + c0
    }

    pub fn slope(&self, s: f64) -> f64 {
        let [_, c1, c2, c3] = self.0;
        (3.0 * c3 * s + 2.0 * c2) * s + c1
    }

    /// The least and the greatest value.
    pub fn extremes(&self) -> [f64; 2] {
        let wider = |[low, high]: [f64; 2], value: f64| [low.min(value), high.max(value)];
        let ends = wider([self.at(0.0); 2], self.at(1.0));
        self.turns().into_iter().flatten().map(|turn| self.at(turn)).fold(ends, wider)
    }

    /// The mean value.
    pub fn mean(&self) -> f64 {
        let [c0, c1, c2, c3] = self.0;
        c0 + c1 / 2.0 + c2 / 3.0 + c3 / 4.0
    }

    pub fn is_constant(&self) -> bool {
        self.0[1..] == [0.0; 3]
    }

    /// Appends to `cuts`, in rising order, 0, the parameters in (0, 1) at which the cubic turns or crosses one of
    /// the rising `levels`, and 1.
    pub fn cut(&self, levels: &[f64], cuts: &mut Vec<f64>) {
        cuts.push(0.0);
        let mut from = 0.0;
        for to in self.turns().into_iter().flatten().chain([1.0]) {
            // Monotone between `from` and `to`: each level strictly between the end values is crossed once.
            let (a, b) = (self.at(from), self.at(to));
            let first = levels.partition_point(|&level| level <= a.min(b));
            let end = levels.partition_point(|&level| level < a.max(b)).max(first);
            let crossed = &levels[first..end];
            if a < b {
                cuts.extend(crossed.iter().map(|&level| self.crossing(level, from, to)));
            } else {
                cuts.extend(crossed.iter().rev().map(|&level| self.crossing(level, from, to)));
            }
            cuts.push(to);
            from = to;
        }
    }

    /// Roots of the derivative in (0, 1), rising.
    fn turns(&self) -> [Option<f64>; 2] {
        let [_, c, half_b, third_a] = self.0;
        let (a, b) = (3.0 * third_a, 2.0 * half_b);
        let discriminant = b * b - 4.0 * a * c;
        if discriminant < 0.0 {
            return [None; 2];
        }
        // The form without cancellation; a quotient 0 / 0 or x / 0 falls out of (0, 1) below.
        let q = -0.5 * (b + discriminant.sqrt().copysign(b));
        let (r, s) = (q / a, c / q);
        let inside = |t: f64| (t > 0.0 && t < 1.0).then_some(t);
        match (inside(r), inside(s)) {
            (Some(r), Some(s)) if r > s => [Some(s), Some(r)],
            found => [found.0, found.1],
        }
    }

    /// Where the cubic, monotone on [low, high], takes the value `level`: Newton's steps while they stay inside
    /// the shrinking bracket, bisection where they do not.
    fn crossing(&self, level: f64, mut low: f64, mut high: f64) -> f64 {
        let rising = self.at(high) > self.at(low);
        let mut s = 0.5 * (low + high);
        // Bisection alone needs 53 halvings for full precision; Newton at a multiple root is no slower.
        for _ in 0..128 {
            let miss = self.at(s) - level;
            if miss == 0.0 {
                break;
            }
            if (miss > 0.0) == rising {
                high = s;
            } else {
                low = s;
            }
            let newton = s - miss / self.slope(s);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - s).abs() <= f64::EPSILON * s {
                break;
            }
            s = next;
        }
        s
    }
}
