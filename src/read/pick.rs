//! One scalar volume out of all the values of a file: a frame, a component, axes in another order.

use rayon::prelude::*;

use crate::scene::field::Missing;
use crate::scene::settings::Component;
use crate::scene::volume::Voxels;

/// Where the voxels of a volume lie among the values of a file: at `first` + i * `steps`[0] + j * `steps`[1] + ...
#[derive(Clone, Debug, PartialEq)]
pub struct Picked {
    pub first: isize,
    /// Values from a voxel to the next along x, y and z; negative along an axis that is mirrored.
    pub steps: [isize; 3],
    pub dims: [usize; 3],
    /// What is made of the values of one voxel; none where it has one.
    pub combined: Option<Combined>,
}

/// Several values of a voxel made one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Combined {
    /// [`Component::Luminance`] or [`Component::Magnitude`].
    pub by: Component,
    pub count: usize,
    /// Values from one component to the next.
    pub step: isize,
}

/// Red, green and blue of ITU-R Rec. 709 in its luminance.
pub const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];

impl Picked {
    /// The volume's voxels. Picking keeps their type; combined ones are f32, or f64 where single precision does not
    /// hold every value of the type.
    ///
    /// A combined value is NaN where any of its parts is, or stands for `no_data`.
    pub fn of(&self, values: Voxels, no_data: &[f64]) -> Voxels {
        let [x, y, z] = self.dims;
        if self.combined.is_none() && self.in_order() && values.len() == x * y * z {
            return values;
        }
        if let Some(combined) = self.combined {
            let missing = Missing { voxel_type: values.voxel_type(), no_data };
            let one = |at: usize| combined.value(&values, at, &missing);
            if let Voxels::U8(_) | Voxels::I8(_) | Voxels::U16(_) | Voxels::I16(_) | Voxels::F32(_) = values {
                let singles = self.each(|at| one(at) as f32);
                // The length of a vector may be beyond f32 where its parts are not.
                if !singles.iter().any(|value| value.is_infinite()) {
                    return Voxels::F32(singles);
                }
            }
            return Voxels::F64(self.each(one));
        }
        match &values {
            Voxels::U8(v) => Voxels::U8(self.each(|at| v[at])),
            Voxels::I8(v) => Voxels::I8(self.each(|at| v[at])),
            Voxels::U16(v) => Voxels::U16(self.each(|at| v[at])),
            Voxels::I16(v) => Voxels::I16(self.each(|at| v[at])),
            Voxels::U32(v) => Voxels::U32(self.each(|at| v[at])),
            Voxels::I32(v) => Voxels::I32(self.each(|at| v[at])),
            Voxels::U64(v) => Voxels::U64(self.each(|at| v[at])),
            Voxels::I64(v) => Voxels::I64(self.each(|at| v[at])),
            Voxels::F32(v) => Voxels::F32(self.each(|at| v[at])),
            Voxels::F64(v) => Voxels::F64(self.each(|at| v[at])),
        }
    }

    /// Whether the voxels are the values as they stand.
    fn in_order(&self) -> bool {
        let [x, y, z] = self.dims;
        let plain = [1, x, x * y];
        // The step along an axis of one voxel is never taken.
        let steps_plainly = |a: usize| self.dims[a] == 1 || usize::try_from(self.steps[a]) == Ok(plain[a]);
        self.first == 0 && z > 0 && (0..3).all(steps_plainly)
    }

    fn each<T: Send>(&self, value: impl Fn(usize) -> T + Sync) -> Vec<T> {
        let [x, y, z] = self.dims;
        let at = |i: usize| {
            let index = [i % x, i / x % y, i / (x * y)];
            let place = (0..3).fold(self.first, |place, a| place + index[a] as isize * self.steps[a]);
            value(place as usize)
        };
        (0..x * y * z).into_par_iter().map(at).collect()
    }
}

impl Combined {
    fn value(&self, values: &Voxels, at: usize, missing: &Missing) -> f64 {
        let part = |n: usize| {
            let value = values.get((at as isize + n as isize * self.step) as usize);
            if value.is_finite() && missing.is(value) { f64::NAN } else { value }
        };
        match self.by {
            Component::Number(n) => part(n),
            Component::Luminance => (0..3).map(|n| LUMINANCE[n] * part(n)).sum(),
            // By hypot: squares of what f64 holds may overflow, their root need not. It takes an infinite part for more
            // than NaN.
            Component::Magnitude if (0..self.count).any(|n| part(n).is_nan()) => f64::NAN,
            Component::Magnitude => (0..self.count).map(part).fold(0.0, f64::hypot),
        }
    }
}
