//! `[shading]`: where the gradients come from that lights are reflected by.

use serde::{Deserialize, Serialize};

use super::section::section;

section! {
    /// Gradients of lit samples and surfaces.
    #[serde(expecting = "the section [shading]")]
    #[command(next_help_heading = "Surface")]
    ShadingSettings, ShadingOptions, "shading";

    /// Where gradients come from
    #[arg(long, value_name = "WHERE")]
    gradients: Gradients = Gradients::OnTheFly;

    /// How precomputed gradients are estimated; on the fly they are central differences
    #[arg(long, value_name = "OPERATOR")]
    gradient: GradientOperator = GradientOperator::Central;

    /// Format of the texture that precomputed gradients are kept in, with the value beside them
    #[arg(long = "gradient-texture", value_name = "FORMAT")]
    format as "texture": GradientTexture = GradientTexture::Rgba16f;
}

/// Where gradients come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Gradients {
    /// Central differences in the shader, a voxel of the axis to each side of the sample.
    #[default]
    OnTheFly,
    /// A texture of gradients at voxel centres, built before frames and interpolated [Stegmaier05 §4].
    Precomputed,
}

/// How the gradient at a voxel's centre is estimated from voxels around it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum GradientOperator {
    /// The two neighbours along each axis.
    #[default]
    Central,
    /// All 3x3x3 voxels, weighted 1, 2, 1 across each axis [Stegmaier05 §4].
    Sobel,
}

/// The formats of gradients and the value beside them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum GradientTexture {
    /// 8 bits each, as in the paper.
    Rgba8,
    /// Half precision.
    #[default]
    Rgba16f,
    /// Single precision.
    Rgba32f,
}

impl GradientTexture {
    /// Bytes of a texel.
    pub fn bytes(self) -> usize {
        match self {
            Self::Rgba8 => 4,
            Self::Rgba16f => 8,
            Self::Rgba32f => 16,
        }
    }

    /// The name in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rgba8 => "rgba8",
            Self::Rgba16f => "rgba16f",
            Self::Rgba32f => "rgba32f",
        }
    }
}
