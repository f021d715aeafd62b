//! Depths as a format keeps them.

use ash::vk;

/// How a format keeps a depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    Float,
    /// A whole number of that many bits.
    Unorm(u32),
}

/// The least normal f32: smaller ones a device may take for 0.
pub const LEAST_NORMAL: f32 = f32::MIN_POSITIVE;

impl Precision {
    pub fn of(format: vk::Format) -> Self {
        match format {
            vk::Format::D16_UNORM => Self::Unorm(16),
            vk::Format::X8_D24_UNORM_PACK32 | vk::Format::D24_UNORM_S8_UINT => Self::Unorm(24),
            _ => Self::Float,
        }
    }

    fn most(bits: u32) -> f64 {
        ((1u64 << bits) - 1) as f64
    }

    /// The nearest depth that the format can keep.
    pub fn nearest(self, depth: f32) -> f32 {
        match self {
            Self::Float => depth,
            Self::Unorm(bits) => (self.code(depth) as f64 / Self::most(bits)) as f32,
        }
    }

    /// The number kept for the nearest depth: bits of a float, or the whole number. Both rise with the depth.
    pub fn code(self, depth: f32) -> u32 {
        match self {
            Self::Float => depth.to_bits(),
            Self::Unorm(bits) => (f64::from(depth) * Self::most(bits)).round() as u32,
        }
    }

    pub fn decode(self, code: u32) -> f32 {
        match self {
            Self::Float => f32::from_bits(code),
            Self::Unorm(bits) => (f64::from(code) / Self::most(bits)) as f32,
        }
    }

    /// The depth `by` steps of the format from the one nearest to `depth`, within [0, 1].
    pub fn beside(self, depth: f32, by: i32) -> f32 {
        let most = self.code(1.0);
        self.decode(self.code(depth).saturating_add_signed(by).min(most))
    }

    /// Texels as a buffer holds them.
    pub fn bytes(self, depths: &[f32]) -> Vec<u8> {
        match self {
            Self::Unorm(16) => depths.iter().flat_map(|d| (self.code(*d) as u16).to_le_bytes()).collect(),
            _ => depths.iter().flat_map(|d| self.code(*d).to_le_bytes()).collect(),
        }
    }

    /// And back to codes; what a format of 24 bits has above them does not count.
    pub fn codes(self, bytes: &[u8]) -> Vec<u32> {
        match self {
            Self::Unorm(16) => bytes.chunks_exact(2).map(|b| u16::from_le_bytes([b[0], b[1]]).into()).collect(),
            _ => {
                let mask = if self == Self::Float { u32::MAX } else { 0x00ff_ffff };
                bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) & mask).collect()
            }
        }
    }
}
