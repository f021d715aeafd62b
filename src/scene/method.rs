//! The render methods, what near-neighbor skipping measures along, and how fragments are culled and marked.

use serde::{Deserialize, Serialize};

/// The render methods.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum MethodName {
    /// Ray casting without acceleration [KW03 §2.1].
    Rc,
    /// Ray casting with early ray termination by early z [KW03 §2.1].
    RcErt,
    /// And with skipping of empty 8^3 blocks [KW03 §2.3].
    RcBlock,
    /// Near-neighbor skipping, distance in any direction [Thesis §5.3].
    NnOmni,
    /// Distance within the octant of the fragment's ray [Thesis §5.3.1].
    NnDirectional,
    /// Distance along the rays of this view [Thesis §5.3.1].
    NnOptimal,
    /// Distance within a cone around this view's rays, good for cameras nearby [Thesis §5.7].
    NnCone,
    /// `nn-omni`, intermediate passes after the first merged into the main passes [Thesis §5.7].
    #[serde(rename = "nn-omni+fused")]
    #[value(name = "nn-omni+fused")]
    NnOmniFused,
    #[serde(rename = "nn-directional+fused")]
    #[value(name = "nn-directional+fused")]
    NnDirectionalFused,
    #[serde(rename = "nn-optimal+fused")]
    #[value(name = "nn-optimal+fused")]
    NnOptimalFused,
    #[serde(rename = "nn-cone+fused")]
    #[value(name = "nn-cone+fused")]
    NnConeFused,
    /// The f64 reference: the same sum, on the CPU.
    Cpu,
}

/// What near-neighbor skipping measures its distances along [Thesis §5.3.1, §5.7].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Distance {
    /// Any direction.
    Omni,
    /// The directions of an octant.
    Directional,
    /// The rays of one view.
    Optimal,
    /// Directions near the rays of one view.
    Cone,
}

impl Distance {
    pub fn name(self) -> &'static str {
        match self {
            Self::Omni => "omni",
            Self::Directional => "directional",
            Self::Optimal => "optimal",
            Self::Cone => "cone",
        }
    }
}

impl MethodName {
    pub const ALL: [Self; 12] = [
        Self::Rc,
        Self::RcErt,
        Self::RcBlock,
        Self::NnOmni,
        Self::NnDirectional,
        Self::NnOptimal,
        Self::NnCone,
        Self::NnOmniFused,
        Self::NnDirectionalFused,
        Self::NnOptimalFused,
        Self::NnConeFused,
        Self::Cpu,
    ];

    /// As on the command line, in files and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rc => "rc",
            Self::RcErt => "rc-ert",
            Self::RcBlock => "rc-block",
            Self::NnOmni => "nn-omni",
            Self::NnDirectional => "nn-directional",
            Self::NnOptimal => "nn-optimal",
            Self::NnCone => "nn-cone",
            Self::NnOmniFused => "nn-omni+fused",
            Self::NnDirectionalFused => "nn-directional+fused",
            Self::NnOptimalFused => "nn-optimal+fused",
            Self::NnConeFused => "nn-cone+fused",
            Self::Cpu => "cpu",
        }
    }

    /// The distances a method of near-neighbor skipping reads; none for the others.
    pub fn distance(self) -> Option<Distance> {
        match self {
            Self::Rc | Self::RcErt | Self::RcBlock | Self::Cpu => None,
            Self::NnOmni | Self::NnOmniFused => Some(Distance::Omni),
            Self::NnDirectional | Self::NnDirectionalFused => Some(Distance::Directional),
            Self::NnOptimal | Self::NnOptimalFused => Some(Distance::Optimal),
            Self::NnCone | Self::NnConeFused => Some(Distance::Cone),
        }
    }

    /// Whether main passes decide where the ray goes on, so that intermediate passes after the first are not needed.
    pub fn fused(self) -> bool {
        matches!(self, Self::NnOmniFused | Self::NnDirectionalFused | Self::NnOptimalFused | Self::NnConeFused)
    }
}

/// How fragments are kept from running.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum Cull {
    /// What works on the device, checked there.
    #[default]
    Auto,
    /// The device's depth bounds test.
    Bounds,
    /// An early, read-only depth test against the box drawn at the depth of the bound.
    Ztest,
    /// The shader looks and discards.
    Discard,
}

/// The depth buffer's format: how finely marks are told apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum DepthFormat {
    /// D32_SFLOAT, which every device has.
    #[default]
    D32,
    /// X8_D24_UNORM.
    D24,
    /// D16_UNORM, which every device has.
    D16,
}

impl DepthFormat {
    pub fn name(self) -> &'static str {
        match self {
            Self::D32 => "d32",
            Self::D24 => "d24",
            Self::D16 => "d16",
        }
    }

    /// Bits of its codes; 0 for a float.
    pub fn bits(self) -> u32 {
        match self {
            Self::D32 => 0,
            Self::D24 => 24,
            Self::D16 => 16,
        }
    }

    /// The largest difference between depths of sections that it may not tell apart.
    pub fn resolution(self) -> f64 {
        match self {
            // Half a unit in the last place below 0.5.
            Self::D32 => 0.5f64.powi(26),
            _ => 1.0 / f64::from((1u32 << self.bits()) - 1),
        }
    }
}

/// How the intermediate pass stores its decision.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "kebab-case")]
pub enum Mark {
    /// What works on the device, checked there.
    #[default]
    Auto,
    /// `gl_FragDepth` with conservative depth.
    Fragdepth,
    /// `gl_FragDepth` as the thesis had it.
    FragdepthAny,
    /// A colour attachment, copied into the depth buffer.
    Copy,
}
