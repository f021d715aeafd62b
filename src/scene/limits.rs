//! The numbers a setting may have, and how help and errors tell them.

use std::fmt;

/// Numbers that are allowed, with the words that ask for one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    pub allowed: Allowed,
    /// What is to be given, as in "a number of voxels {}"; the limits in words take the place of `{}`.
    what: &'static str,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Allowed {
    /// From the one to the other, both included.
    FromTo(f64, f64),
    /// Between the two, both left out.
    Between(f64, f64),
    /// This number, and every larger one.
    AtLeast(f64),
    /// One of these.
    OneOf(&'static [u32]),
    /// Neither NaN nor an infinity.
    Finite,
}

/// What is wrong with a value, and what to do, for [`crate::Error`].
#[derive(Clone, Debug, PartialEq)]
pub struct WrongValue {
    pub problem: String,
    pub remedy: String,
}

/// Numbers below this are told as `1e-9`.
const SMALL: f64 = 1e-6;

/// Numbers from this on are told as `1e30`.
const LARGE: f64 = 1e15;

/// The largest colour of surfaces and of what they reflect: sums of what lights make of it stay far below the largest numbers of
/// single precision.
pub const BRIGHTEST: f64 = 1e6;

impl Limits {
    pub const fn new(allowed: Allowed, what: &'static str) -> Self {
        Self { allowed, what }
    }

    /// From `low` to `high`, both included.
    pub const fn from_to(low: f64, high: f64, what: &'static str) -> Self {
        Self::new(Allowed::FromTo(low, high), what)
    }

    pub fn contains(&self, number: f64) -> bool {
        match self.allowed {
            Allowed::FromTo(low, high) => low <= number && number <= high,
            Allowed::Between(low, high) => low < number && number < high,
            Allowed::AtLeast(low) => low <= number,
            Allowed::OneOf(all) => all.iter().any(|one| f64::from(*one) == number),
            Allowed::Finite => number.is_finite(),
        }
    }

    /// What to do about a number outside: "give a number of voxels from 1 to 8".
    pub fn remedy(&self) -> String {
        format!("give {}", self.what.replace("{}", &self.allowed.to_string()))
    }

    /// What is wrong with `value`, if anything is.
    pub fn wrong(&self, value: &impl Numbers) -> Option<WrongValue> {
        let problem = value.problem(&|number| self.contains(number))?;
        Some(WrongValue { problem, remedy: self.remedy() })
    }
}

/// In words that follow "a number": `from 1 to 8`, `above 0 and below 180`.
impl fmt::Display for Allowed {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let told = |number: f64| {
            let small = number != 0.0 && number.abs() < SMALL;
            if small || number.abs() >= LARGE { format!("{number:e}") } else { number.to_string() }
        };
        match *self {
            Self::FromTo(low, high) => write!(f, "from {} to {}", told(low), told(high)),
            Self::Between(low, high) => write!(f, "above {} and below {}", told(low), told(high)),
            Self::AtLeast(low) => write!(f, "at least {}", told(low)),
            Self::OneOf(all) => {
                let all: Vec<String> = all.iter().map(u32::to_string).collect();
                match all.split_last() {
                    Some((last, [])) => f.write_str(last),
                    Some((last, others)) => write!(f, "{} or {last}", others.join(", ")),
                    None => Ok(()),
                }
            }
            Self::Finite => f.write_str("that is finite"),
        }
    }
}

/// A value of a setting that is a number, or made of numbers.
pub trait Numbers {
    /// What is wrong where not every number is `good`: `is 0`.
    fn problem(&self, good: &dyn Fn(f64) -> bool) -> Option<String>;
}

macro_rules! a_number {
    ($($type:ty, $number:ident => $as_f64:expr;)*) => {$(
        impl Numbers for $type {
            fn problem(&self, good: &dyn Fn(f64) -> bool) -> Option<String> {
                let $number = *self;
                (!good($as_f64)).then(|| format!("is {self}"))
            }
        }
    )*};
}

a_number! {
    f64, n => n;
    u32, n => f64::from(n);
    // Rounding beyond 2^53 crosses no limit that is a small whole number.
    i64, n => n as f64;
}

impl<T: Numbers + fmt::Debug, const N: usize> Numbers for [T; N] {
    fn problem(&self, good: &dyn Fn(f64) -> bool) -> Option<String> {
        self.iter().any(|number| number.problem(good).is_some()).then(|| format!("is {self:?}"))
    }
}

/// A list may be long: the first number that is wrong is told.
impl Numbers for Vec<f64> {
    fn problem(&self, good: &dyn Fn(f64) -> bool) -> Option<String> {
        self.iter().find(|number| !good(**number)).map(|number| format!("has {number}"))
    }
}

impl<T: Numbers> Numbers for Option<T> {
    fn problem(&self, good: &dyn Fn(f64) -> bool) -> Option<String> {
        self.as_ref()?.problem(good)
    }
}
