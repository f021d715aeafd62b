//! Names of render methods, what near-neighbor skipping measures along, and how fragments are culled and marked.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The name of a render method, as on the command line, in files and in reports. Which methods there are, and what each of
/// them does, says `crate::method`, where such names are read, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct MethodName(&'static str);

impl MethodName {
    /// The name of a row of `crate::method`.
    pub(crate) const fn new(name: &'static str) -> Self {
        Self(name)
    }

    /// What is not a method: one is to be chosen for the scene.
    pub const AUTO: Self = Self("auto");

    /// The name as a text.
    pub const fn name(self) -> &'static str {
        self.0
    }

    /// Whether a method is to be chosen for the scene.
    pub fn is_auto(self) -> bool {
        self == Self::AUTO
    }
}

impl Default for MethodName {
    fn default() -> Self {
        Self::AUTO
    }
}

impl fmt::Display for MethodName {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.0)
    }
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
