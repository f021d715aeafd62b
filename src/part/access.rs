//! How a step uses a resource: layouts, barriers, load and store operations follow from it alone.

use ash::vk;

use super::resource::Resource;

/// What a step does with a resource.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Usage {
    /// Drawn into; what was there stays where nothing is drawn.
    Color,
    /// Drawn into, and a fragment reads what its own pixel held before.
    ColorInput,
    /// Attached like a colour that is drawn into, and left as it is.
    ColorKept,
    DepthWrite,
    DepthTest,
    /// A depth buffer that is cleared, tested and written, and that nobody needs afterwards.
    DepthAnew,
    /// Read by the fragment shader.
    Sampled,
    /// Read by the vertex shader.
    Placing,
    Vertices,
    CopySource,
    CopyTarget,
    /// Read and written by a compute shader.
    ComputeRead,
    ComputeWrite,
    /// An image that a compute shader writes, every texel of it.
    ImageWrite,
    /// An image that a compute shader writes and whose texels it read before.
    ImageUpdate,
    /// Filled by the host, through a copy where it is an image.
    Upload,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Access {
    pub resource: Resource,
    pub usage: Usage,
}

impl Usage {
    /// `resource` used like this.
    pub fn of(self, resource: Resource) -> Access {
        Access { resource, usage: self }
    }

    pub fn writes(self) -> bool {
        matches!(
            self,
            Self::Color
                | Self::ColorInput
                | Self::DepthWrite
                | Self::DepthAnew
                | Self::CopyTarget
                | Self::ComputeWrite
                | Self::ImageWrite
                | Self::ImageUpdate
                | Self::Upload
        )
    }

    /// Whether what was there before counts for what the step does.
    pub fn reads(self) -> bool {
        !self.writes() || matches!(self, Self::ColorInput | Self::ImageUpdate)
    }

    /// Whether a compute shader reads or writes it texel by texel, as an image and not through a sampler.
    pub fn is_storage_image(self) -> bool {
        matches!(self, Self::ImageWrite | Self::ImageUpdate)
    }

    /// Whether it is as an attachment of a render pass.
    pub fn is_attachment(self) -> bool {
        matches!(self, Self::Color | Self::ColorInput | Self::ColorKept) || self.is_depth()
    }

    /// Whether it is as the depth attachment.
    pub fn is_depth(self) -> bool {
        matches!(self, Self::DepthWrite | Self::DepthTest | Self::DepthAnew)
    }

    /// The layout an image has meanwhile.
    pub fn layout(self) -> vk::ImageLayout {
        match self {
            Self::Color | Self::ColorKept => vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
            Self::ColorInput | Self::ImageWrite | Self::ImageUpdate => vk::ImageLayout::GENERAL,
            Self::DepthWrite | Self::DepthAnew => vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            Self::DepthTest => vk::ImageLayout::DEPTH_STENCIL_READ_ONLY_OPTIMAL,
            Self::CopySource => vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            Self::CopyTarget => vk::ImageLayout::TRANSFER_DST_OPTIMAL,
            Self::Sampled | Self::Placing | Self::Vertices | Self::ComputeRead | Self::ComputeWrite | Self::Upload => {
                vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL
            }
        }
    }

    /// Where in the pipeline it happens, and how memory is touched there.
    pub fn scope(self) -> (vk::PipelineStageFlags2, vk::AccessFlags2) {
        use vk::{AccessFlags2 as A, PipelineStageFlags2 as S};
        let depth_tests = S::EARLY_FRAGMENT_TESTS | S::LATE_FRAGMENT_TESTS;
        match self {
            Self::Color => (S::COLOR_ATTACHMENT_OUTPUT, A::COLOR_ATTACHMENT_READ | A::COLOR_ATTACHMENT_WRITE),
            Self::ColorKept => (S::COLOR_ATTACHMENT_OUTPUT, A::COLOR_ATTACHMENT_READ),
            Self::ColorInput => (
                S::COLOR_ATTACHMENT_OUTPUT | S::FRAGMENT_SHADER,
                A::COLOR_ATTACHMENT_READ | A::COLOR_ATTACHMENT_WRITE | A::INPUT_ATTACHMENT_READ,
            ),
            Self::DepthWrite | Self::DepthAnew => {
                (depth_tests, A::DEPTH_STENCIL_ATTACHMENT_READ | A::DEPTH_STENCIL_ATTACHMENT_WRITE)
            }
            Self::DepthTest => (depth_tests, A::DEPTH_STENCIL_ATTACHMENT_READ),
            Self::Sampled => (S::FRAGMENT_SHADER, A::SHADER_READ),
            Self::Placing => (S::VERTEX_SHADER, A::SHADER_READ),
            Self::Vertices => (S::VERTEX_ATTRIBUTE_INPUT, A::VERTEX_ATTRIBUTE_READ),
            Self::CopySource => (S::COPY, A::TRANSFER_READ),
            Self::CopyTarget => (S::COPY | S::CLEAR, A::TRANSFER_WRITE),
            Self::ComputeRead => (S::COMPUTE_SHADER, A::SHADER_READ),
            Self::ComputeWrite | Self::ImageWrite => (S::COMPUTE_SHADER, A::SHADER_WRITE),
            Self::ImageUpdate => (S::COMPUTE_SHADER, A::SHADER_READ | A::SHADER_WRITE),
            Self::Upload => (S::HOST | S::COPY, A::HOST_WRITE | A::TRANSFER_WRITE),
        }
    }
}
