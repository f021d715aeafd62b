//! Numbers above 0 in a byte, by their logarithm: all that lengths of steps, which are doubled, ask for.

/// A quarter of an octave each. What is less than the least number, 0 among it, counts as that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Code(pub u8);

/// Codes of an octave.
const OCTAVE: f64 = 4.0;

/// The code of 1: the least number is 2^-50, and the greatest some 2^13.
const ONE: i32 = 201;

impl Code {
    /// That of no number, below all others.
    pub const NONE: Self = Self(0);

    /// The greatest.
    pub const MOST: Self = Self(u8::MAX);

    /// The least code whose number is not below `number`.
    pub fn up(number: f64) -> Self {
        if number > 0.0 { Self::clamped((number.log2() * OCTAVE).ceil() as i32 + ONE) } else { Self(1) }
    }

    fn clamped(code: i32) -> Self {
        Self(code.clamp(1, u8::MAX.into()) as u8)
    }

    /// Its number.
    pub fn number(self) -> f64 {
        2f64.powf(f64::from(i32::from(self.0) - ONE) / OCTAVE)
    }

    /// The product.
    pub fn times(self, other: Self) -> Self {
        Self::clamped(i32::from(self.0) + i32::from(other.0) - ONE)
    }
}
