//! Numbers that look drawn and are the same in every run (SplitMix64, Steele, Lea and Flood 2014).

use glam::DVec3;

/// Where the row of numbers is, which begins with any seed.
pub struct Random(pub u64);

impl Random {
    /// 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number from 0 to below `end`.
    pub fn below(&mut self, end: u32) -> u32 {
        (((self.bits() >> 32) * u64::from(end)) >> 32) as u32
    }

    /// From 0 to 1, in steps that f32 has.
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1u64 << 24) as f32
    }

    /// From 0 to 1, in steps that f64 has.
    pub fn part(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A unit vector, each as likely as any other.
    pub fn direction(&mut self) -> DVec3 {
        let z = 2.0 * self.part() - 1.0;
        let around = std::f64::consts::TAU * self.part();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * around.cos(), radius * around.sin(), z)
    }
}
