//! The bundles of rays that distances are made for.

use bytemuck::{Pod, Zeroable};

use crate::structure::bundle::Bundles;

/// `Bundle` of `glsl/structure/bundle.comp`, where its members are explained.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Bundle {
    pub from: [f32; 4],
    pub sides: [f32; 4],
    pub low: [f32; 4],
    pub high: [f32; 4],
    pub spread: f32,
    pub short_step: f32,
}

impl From<&Bundles> for Bundle {
    fn from(of: &Bundles) -> Self {
        let four = |[x, y, z]: [f32; 3]| [x, y, z, 0.0];
        Self {
            from: four(of.from),
            sides: four(of.sides),
            low: four(of.low),
            high: four(of.high),
            spread: of.spread,
            short_step: of.step,
        }
    }
}
