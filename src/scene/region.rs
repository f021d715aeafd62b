//! Rectangles of pixels.

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Region {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

impl Region {
    /// The least rectangle around this one and another.
    pub fn with(self, other: Self) -> Self {
        match (self.pixels(), other.pixels()) {
            (0, _) => other,
            (_, 0) => self,
            _ => {
                let (x, y) = (self.x.min(other.x), self.y.min(other.y));
                let right = self.columns().end.max(other.columns().end);
                let bottom = self.rows().end.max(other.rows().end);
                Self { x, y, width: right - x, height: bottom - y }
            }
        }
    }

    pub fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    pub fn size(self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Whether a pixel, column and row, is in it.
    pub fn contains(self, [column, row]: [u32; 2]) -> bool {
        self.columns().contains(&column) && self.rows().contains(&row)
    }

    pub fn columns(self) -> std::ops::Range<u32> {
        self.x..self.x + self.width
    }

    pub fn rows(self) -> std::ops::Range<u32> {
        self.y..self.y + self.height
    }
}
