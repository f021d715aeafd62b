//! Which pixels of a picture are rejected.

use serde::{Deserialize, Serialize};

/// A pattern of rejected pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Pattern {
    None,
    All,
    /// The right half.
    Halves,
    /// Every other square of so many pixels a side.
    Checker(u32),
    /// So many in a hundred, anywhere.
    Random(u32),
}

impl Pattern {
    /// Those between none and all.
    pub const MIXED: [Self; 11] = [
        Self::Halves,
        Self::Checker(64),
        Self::Checker(32),
        Self::Checker(16),
        Self::Checker(8),
        Self::Checker(4),
        Self::Checker(2),
        Self::Checker(1),
        Self::Random(10),
        Self::Random(50),
        Self::Random(90),
    ];

    pub fn name(self) -> String {
        match self {
            Self::None => "none".into(),
            Self::All => "all".into(),
            Self::Halves => "halves".into(),
            Self::Checker(side) => format!("{side} px"),
            Self::Random(percent) => format!("{percent} %"),
        }
    }

    /// Side of the squares it rejects, pixels; none for those without.
    pub fn tile(self) -> Option<u32> {
        match self {
            Self::Checker(side) => Some(side),
            _ => None,
        }
    }

    /// Whether the pixel is rejected, in a picture `side` pixels wide.
    pub fn rejects(self, [x, y]: [u32; 2], side: u32) -> bool {
        match self {
            Self::None => false,
            Self::All => true,
            Self::Halves => x >= side / 2,
            Self::Checker(tile) => (x / tile + y / tile) % 2 == 1,
            Self::Random(percent) => hash(y * side + x) % 100 < percent,
        }
    }

    /// One flag a pixel of a square picture, row by row.
    pub fn mask(self, side: u32) -> Vec<bool> {
        (0..side * side).map(|i| self.rejects([i % side, i / side], side)).collect()
    }
}

/// Bits that look random (the finaliser of MurmurHash3).
fn hash(i: u32) -> u32 {
    let mut h = i.wrapping_add(0x9e37_79b9);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}
