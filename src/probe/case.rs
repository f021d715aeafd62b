//! What is asked of a driver: a mechanism that rejects fragments, a shader that may forbid to do so early, a depth
//! format, and how the stored depths came about.

use ash::vk;
use serde::{Deserialize, Serialize};

use crate::glsl;

/// What rejects fragments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Mechanism {
    /// Depth test, nothing written.
    DepthRead,
    /// Depth test, depths written.
    DepthWrite,
    /// Depth bounds test, depth test off.
    BoundsAlone,
    /// Depth bounds test beside a depth test that passes always, nothing written.
    BoundsRead,
    /// The same, depths written.
    BoundsWrite,
    /// Depth bounds test beside a depth test that every fragment of the rejected half would pass, depths written.
    BoundsCompare,
    /// Stencil test.
    Stencil,
    /// `discard` at the begin of the shader.
    DiscardFirst,
    /// `if (alive) { work } if (!alive) discard;`.
    Alive,
}

/// What a shader does besides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CaseShader {
    Plain,
    Early,
    Discards,
    Buffer,
    Image,
    EarlyBuffer,
    EarlyImage,
    DepthAny,
    DepthLess,
    DepthGreater,
    DepthUnchanged,
    DepthAnyBuffer,
    DepthLessImage,
}

/// Which way the depth test compares: a fragment's depth with the stored one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Compare {
    GreaterOrEqual,
    LessOrEqual,
}

/// How the stored depths came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum History {
    /// Copied into the depth image.
    Copy,
    /// Cleared as the render pass begins.
    Clear,
    /// Drawn, before in the same render pass.
    Draw,
}

/// A line of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Case {
    pub mechanism: Mechanism,
    pub shader: CaseShader,
    pub compare: Compare,
}

impl Mechanism {
    pub const ALL: [Self; 9] = [
        Self::DepthRead,
        Self::DepthWrite,
        Self::BoundsAlone,
        Self::BoundsRead,
        Self::BoundsWrite,
        Self::BoundsCompare,
        Self::Stencil,
        Self::DiscardFirst,
        Self::Alive,
    ];

    pub fn words(self) -> &'static str {
        match self {
            Self::DepthRead => "depth test, read-only",
            Self::DepthWrite => "depth test, writing",
            Self::BoundsAlone => "depth bounds, depth test off",
            Self::BoundsRead => "depth bounds, depth test ALWAYS, read-only",
            Self::BoundsWrite => "depth bounds, depth test ALWAYS, writing",
            Self::BoundsCompare => "depth bounds and depth test, writing",
            Self::Stencil => "stencil test",
            Self::DiscardFirst => "shader: discard first",
            Self::Alive => "shader: work if alive, discard last",
        }
    }

    pub fn bounds(self) -> bool {
        matches!(self, Self::BoundsAlone | Self::BoundsRead | Self::BoundsWrite | Self::BoundsCompare)
    }

    /// The shader looks at a copy of the stored depth.
    pub fn in_shader(self) -> bool {
        matches!(self, Self::DiscardFirst | Self::Alive)
    }

    /// The depth test compares.
    pub fn compares(self) -> bool {
        matches!(self, Self::DepthRead | Self::DepthWrite | Self::BoundsCompare)
    }

    pub fn writes_depth(self) -> bool {
        !matches!(self, Self::DepthRead | Self::BoundsAlone | Self::BoundsRead)
    }
}

impl CaseShader {
    pub const ALL: [Self; 13] = [
        Self::Plain,
        Self::Early,
        Self::Discards,
        Self::Buffer,
        Self::Image,
        Self::EarlyBuffer,
        Self::EarlyImage,
        Self::DepthAny,
        Self::DepthLess,
        Self::DepthGreater,
        Self::DepthUnchanged,
        Self::DepthAnyBuffer,
        Self::DepthLessImage,
    ];

    pub fn words(self) -> &'static str {
        match self {
            Self::Plain => "plain",
            Self::Early => "early_fragment_tests",
            Self::Discards => "may discard",
            Self::Buffer => "writes a storage buffer",
            Self::Image => "writes a storage image",
            Self::EarlyBuffer => "early_fragment_tests, storage buffer",
            Self::EarlyImage => "early_fragment_tests, storage image",
            Self::DepthAny => "writes depth",
            Self::DepthLess => "writes depth, depth_less",
            Self::DepthGreater => "writes depth, depth_greater",
            Self::DepthUnchanged => "writes depth, depth_unchanged",
            Self::DepthAnyBuffer => "writes depth and a storage buffer",
            Self::DepthLessImage => "writes depth, depth_less, and a storage image",
        }
    }

    /// What makes it of `glsl/probe/probe.frag`.
    fn defines(self) -> impl Iterator<Item = &'static str> {
        let depth = self.conservative().map(|promise| match promise {
            Conservative::Any => "DEPTH=depth_any",
            Conservative::Less => "DEPTH=depth_less",
            Conservative::Greater => "DEPTH=depth_greater",
            Conservative::Unchanged => "DEPTH=depth_unchanged",
        });
        let (early, discards) = (self.early().then_some("EARLY"), (self == Self::Discards).then_some("DISCARDS"));
        let (buffer, image) = (self.counts().then_some("BUFFER"), self.touches().then_some("IMAGE"));
        [depth, early, discards, buffer, image].into_iter().flatten()
    }

    pub fn early(self) -> bool {
        matches!(self, Self::Early | Self::EarlyBuffer | Self::EarlyImage)
    }

    pub fn counts(self) -> bool {
        matches!(self, Self::Buffer | Self::EarlyBuffer | Self::DepthAnyBuffer)
    }

    pub fn touches(self) -> bool {
        matches!(self, Self::Image | Self::EarlyImage | Self::DepthLessImage)
    }

    pub fn stores(self) -> bool {
        self.counts() || self.touches()
    }

    /// What it may do to the depth the rasteriser gives a fragment; none where it leaves it alone.
    pub fn conservative(self) -> Option<Conservative> {
        match self {
            Self::DepthAny | Self::DepthAnyBuffer => Some(Conservative::Any),
            Self::DepthLess | Self::DepthLessImage => Some(Conservative::Less),
            Self::DepthGreater => Some(Conservative::Greater),
            Self::DepthUnchanged => Some(Conservative::Unchanged),
            _ => None,
        }
    }
}

/// The promise a shader makes about the depths it writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Conservative {
    Any,
    Less,
    Greater,
    Unchanged,
}

impl Compare {
    pub fn op(self) -> vk::CompareOp {
        match self {
            Self::GreaterOrEqual => vk::CompareOp::GREATER_OR_EQUAL,
            Self::LessOrEqual => vk::CompareOp::LESS_OR_EQUAL,
        }
    }

    pub fn words(self) -> &'static str {
        match self {
            Self::GreaterOrEqual => "GREATER_OR_EQUAL",
            Self::LessOrEqual => "LESS_OR_EQUAL",
        }
    }
}

impl History {
    pub const ALL: [Self; 3] = [Self::Copy, Self::Clear, Self::Draw];

    pub fn words(self) -> &'static str {
        match self {
            Self::Copy => "after a copy",
            Self::Clear => "after a clear",
            Self::Draw => "after a draw in the same render pass",
        }
    }
}

impl Case {
    /// Every line: mechanisms with the shaders that make sense with them. Conservative depth is asked for with the
    /// compare it was made for and with the opposite one.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for mechanism in Mechanism::ALL {
            for shader in CaseShader::ALL {
                // A shader with early tests must not discard; further depth qualifiers say nothing new there.
                let makes_sense = !mechanism.in_shader()
                    || matches!(
                        shader,
                        CaseShader::Plain
                            | CaseShader::Buffer
                            | CaseShader::Image
                            | CaseShader::DepthAny
                            | CaseShader::DepthLess
                    );
                if !makes_sense {
                    continue;
                }
                all.push(Self { mechanism, shader, compare: Compare::GreaterOrEqual });
                let directed = matches!(
                    shader.conservative(),
                    Some(Conservative::Less | Conservative::Greater | Conservative::Unchanged)
                );
                if mechanism.compares() && directed && !shader.stores() {
                    all.push(Self { mechanism, shader, compare: Compare::LessOrEqual });
                }
            }
        }
        all
    }

    /// Its fragment shader.
    pub fn fragment(&self) -> glsl::Shader {
        let looks = match self.mechanism {
            Mechanism::DiscardFirst => Some("FIRST"),
            Mechanism::Alive => Some("ALIVE"),
            _ => None,
        };
        glsl::Shader::new("probe/probe.frag", self.shader.defines().chain(looks))
    }

    /// The shader's line in words, the compare named where it matters.
    pub fn shader_words(&self) -> String {
        let words = self.shader.words();
        match self.shader.conservative() {
            Some(_) if self.mechanism.compares() => format!("{words}, compare {}", self.compare.words()),
            _ => words.to_owned(),
        }
    }

    pub fn name(&self) -> String {
        format!("{} x {}", self.mechanism.words(), self.shader_words())
    }
}

/// Depth formats, the one that everything is asked for first.
pub const FORMATS: [vk::Format; 5] = [
    vk::Format::D32_SFLOAT,
    vk::Format::D32_SFLOAT_S8_UINT,
    vk::Format::X8_D24_UNORM_PACK32,
    vk::Format::D24_UNORM_S8_UINT,
    vk::Format::D16_UNORM,
];

pub fn format_name(format: vk::Format) -> &'static str {
    match format {
        vk::Format::D32_SFLOAT => "D32_SFLOAT",
        vk::Format::D32_SFLOAT_S8_UINT => "D32_SFLOAT_S8_UINT",
        vk::Format::X8_D24_UNORM_PACK32 => "X8_D24_UNORM",
        vk::Format::D24_UNORM_S8_UINT => "D24_UNORM_S8_UINT",
        vk::Format::D16_UNORM => "D16_UNORM",
        _ => "another format",
    }
}
