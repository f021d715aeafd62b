//! Boxes, a rod and a thin wall on the seams of blocks.

use glam::DVec3;

use super::profile::{smoothstep, smoothstep_slope};

struct Block {
    centre: DVec3,
    half: DVec3,
    /// Over this depth inside each face the value rises from 0.
    rise: f64,
    value: f64,
}

/// None overlap. Outlines lie on multiples of 1/4, which are seams of 8^3 blocks in volumes of 64, 128, ... voxels:
/// the first two boxes meet at one, and the wall straddles one with its brightest voxels on both sides.
const BLOCKS: [Block; 5] = [
    block([-0.5, -0.5, -0.25], [0.25, 0.25, 0.5], 0.1, 1.0),
    block([0.0, -0.5, -0.25], [0.25, 0.25, 0.25], 0.1, 0.7),
    block([0.5, 0.5, 0.5], [0.25, 0.25, 0.25], 0.1, 0.85),
    block([0.0, 0.0, 0.0], [0.75, 0.07, 0.75], 0.07, 0.55),
    block([-0.5, 0.5, 0.0], [0.1, 0.1, 0.75], 0.1, 0.65),
];

const fn block(centre: [f64; 3], half: [f64; 3], rise: f64, value: f64) -> Block {
    Block { centre: DVec3::from_array(centre), half: DVec3::from_array(half), rise, value }
}

impl Block {
    /// Depth inside the faces across each axis, 1 where the value has risen in full.
    fn depth(&self, p: DVec3) -> DVec3 {
        (self.half - (p - self.centre).abs()) / self.rise
    }
}

pub fn blocks(p: DVec3) -> f64 {
    BLOCKS.iter().map(|b| b.value * b.depth(p).to_array().map(smoothstep).iter().product::<f64>()).sum()
}

pub fn blocks_gradient(p: DVec3) -> DVec3 {
    let one = |b: &Block| {
        let step = DVec3::from_array(b.depth(p).to_array().map(smoothstep));
        let slope = DVec3::from_array(b.depth(p).to_array().map(smoothstep_slope));
        let inward = -(p - b.centre).signum() / b.rise;
        let others = DVec3::new(step.y * step.z, step.z * step.x, step.x * step.y);
        b.value * inward * slope * others
    };
    BLOCKS.iter().map(one).sum()
}
