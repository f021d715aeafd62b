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
    pub fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    pub fn size(self) -> [u32; 2] {
        [self.width, self.height]
    }

    pub fn columns(self) -> std::ops::Range<u32> {
        self.x..self.x + self.width
    }

    pub fn rows(self) -> std::ops::Range<u32> {
        self.y..self.y + self.height
    }
}
