//! How a fragment goes into the pixel it is drawn to: what a blend unit does, in f64.

use super::opacity::composite;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Blend {
    Replace,
    /// Front to back, premultiplied: `dst += (1 - dst.a) * src`.
    Over,
    /// Back to front, premultiplied: `dst = src + (1 - src.a) * dst`.
    InFront,
    /// The greater of both, channel by channel.
    Max,
    /// The lesser of both, channel by channel.
    Min,
    /// The sum of both.
    Add,
}

impl Blend {
    /// The pixel once the fragment was drawn.
    pub fn apply(self, pixel: [f64; 4], fragment: [f64; 4]) -> [f64; 4] {
        let each = |of: fn(f64, f64) -> f64| std::array::from_fn(|c| of(pixel[c], fragment[c]));
        match self {
            Self::Replace => fragment,
            Self::Over => composite(pixel, fragment),
            Self::InFront => composite(fragment, pixel),
            Self::Max => each(f64::max),
            Self::Min => each(f64::min),
            Self::Add => each(|a, b| a + b),
        }
    }
}
