//! What a ray meets of the field: its extrema and its integral, in closed form.

use glam::DVec3;

use super::ExactIntegrator;
use super::cubic::Cubic;
use crate::projection::{Met, OfValues};
use crate::scene::Field;

/// A ray on its way.
pub struct Meeting {
    met: Met,
    /// The least and the greatest value of the whole field.
    all: [f64; 2],
}

impl Meeting {
    pub fn new(field: &Field) -> Self {
        let met = Met { least: f64::INFINITY, greatest: f64::NEG_INFINITY, integral: 0.0, lengths: 0.0 };
        Self { met, all: field.extremes().map(f64::from) }
    }

    /// Goes on for so many reference `lengths`, on which `x` gives the scalar for s from 0 to 1; none in a hole.
    pub fn add(&mut self, x: Option<Cubic>, lengths: f64) {
        self.met.lengths += lengths;
        let Some(x) = x else { return };
        let [least, greatest] = x.extremes();
        self.met.least = self.met.least.min(least);
        self.met.greatest = self.met.greatest.max(greatest);
        self.met.integral += x.mean() * lengths;
    }

    /// The whole ray; none of one without length. A ray that meets holes alone has nothing below the greatest value of the
    /// field and nothing above the least one.
    pub fn whole(mut self) -> Option<Met> {
        if self.met.least > self.met.greatest {
            [self.met.greatest, self.met.least] = self.all;
        }
        (self.met.lengths > 0.0).then_some(self.met)
    }
}

impl ExactIntegrator<'_> {
    /// The grey that a projection of values gives a ray; transparent black where it has no length. What is clipped counts as a hole.
    pub(super) fn values(&self, values: &OfValues, entry: DVec3, direction: DVec3, length: f64) -> [f64; 4] {
        let line = self.line(entry, direction);
        let cuts = self.plane_cuts(&line, length);
        let lengths = |way: f64| way / (self.medium.transfer.reference * self.field.finest());
        let mut meeting = Meeting::new(self.field);
        for part in self.kept_parts(entry, direction, length) {
            let between = cuts.windows(2).map(|pair| (pair[0].max(part.from), pair[1].min(part.to)));
            for (a, b) in between.filter(|(a, b)| a < b) {
                let cell = part.kept.then(|| self.cell(&line, a, b)).flatten();
                meeting.add(cell.map(|cell| cell.cubic()), lengths(b - a));
            }
        }
        let Some(met) = meeting.whole() else { return [0.0; 4] };
        let value = (values.exact)(&met);
        [value, value, value, 1.0]
    }
}
