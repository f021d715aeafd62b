//! The named resources of a frame and how a step uses them. A resource's name is its name in GLSL, in
//! validation messages, captures, plans and reports.

use ash::vk;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Resource {
    /// The box's triangles.
    Box,
    /// The view and the sampling, a uniform buffer.
    Frame,
    /// ENTRY [KW03 §2.1].
    Entry,
    /// DIR [KW03 §2.1].
    Direction,
    /// RES [KW03 §2.1].
    Accumulated,
    /// The depth buffer.
    Stored,
    /// Decisions of an intermediate pass on their way to the depth buffer.
    Marks,
    /// Between a colour and a depth image a copy needs a buffer.
    MarksBuffer,
    Volume,
    /// Cells that stay transparent.
    Holes,
    /// Pieces of the transfer function; of one without colours.
    Transfer,
    GreyTransfer,
    /// The table of pre-integrated classification, and its axes.
    Preintegrated,
    Axis,
    /// Distance to the nearest interesting cell.
    NearestDistance,
    /// Minimum and maximum of every cell of a grid, or every block [KW03 §2.3].
    CellRange,
    /// CT [KW03 §2.3].
    BlockTable,
    /// Where the transfer function shows anything.
    Support,
    /// A bit for each cell: whether it is interesting.
    Interesting,
    /// Any interesting cell among 2^3, or 4^3, from each cell on.
    Wide2,
    Wide4,
    /// Squared distances on their way through the axes.
    Squares,
    SquaresAfter,
    /// Distances on their way to the texture.
    DistanceBytes,
    /// Distances for boxes of 2^3 and 4^3 cells, from which those of cells go on.
    Boxes2,
    Boxes4,
    /// The distances in any direction, where others are made from them.
    OmniDistance,
    /// The bundles of rays that distances are made for, a uniform buffer.
    Bundle,
}

impl Resource {
    pub fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Frame => "frame",
            Self::Entry => "entry",
            Self::Direction => "direction",
            Self::Accumulated => "accumulated",
            Self::Stored => "stored",
            Self::Marks => "marks",
            Self::MarksBuffer => "marks_buffer",
            Self::Volume => "volume",
            Self::Holes => "holes",
            Self::Transfer | Self::GreyTransfer => "transfer",
            Self::Preintegrated => "preintegrated",
            Self::Axis => "axis",
            Self::NearestDistance => "nearest_distance",
            Self::CellRange => "cell_range",
            Self::BlockTable => "block_table",
            Self::Support => "support",
            Self::Interesting => "interesting",
            Self::Wide2 => "wide_2",
            Self::Wide4 => "wide_4",
            Self::Squares => "squares",
            Self::SquaresAfter => "squares_after",
            Self::DistanceBytes => "distance_bytes",
            Self::Boxes2 => "boxes_2",
            Self::Boxes4 => "boxes_4",
            Self::OmniDistance => "omni_distance",
            Self::Bundle => "bundle",
        }
    }

    /// Whether every frame writes it anew, at the size of the picture.
    pub fn is_target(self) -> bool {
        matches!(self, Self::Entry | Self::Direction | Self::Accumulated | Self::Stored | Self::Marks)
    }

    pub fn is_depth(self) -> bool {
        self == Self::Stored
    }
}

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
    /// Read by the fragment shader.
    Sampled,
    Vertices,
    CopySource,
    CopyTarget,
    /// Read and written by a compute shader.
    ComputeRead,
    ComputeWrite,
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
        matches!(self, Self::Color | Self::ColorInput | Self::DepthWrite | Self::CopyTarget | Self::ComputeWrite)
    }

    /// Whether what was there before counts for what the step does.
    pub fn reads(self) -> bool {
        !self.writes() || self == Self::ColorInput
    }

    /// Whether it is as an attachment of a render pass.
    pub fn is_attachment(self) -> bool {
        matches!(self, Self::Color | Self::ColorInput | Self::ColorKept | Self::DepthWrite | Self::DepthTest)
    }

    /// The layout an image has meanwhile.
    pub fn layout(self) -> vk::ImageLayout {
        match self {
            Self::Color | Self::ColorKept => vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL,
            Self::ColorInput => vk::ImageLayout::GENERAL,
            Self::DepthWrite => vk::ImageLayout::DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
            Self::DepthTest => vk::ImageLayout::DEPTH_STENCIL_READ_ONLY_OPTIMAL,
            Self::CopySource => vk::ImageLayout::TRANSFER_SRC_OPTIMAL,
            Self::CopyTarget => vk::ImageLayout::TRANSFER_DST_OPTIMAL,
            Self::Sampled | Self::Vertices | Self::ComputeRead | Self::ComputeWrite => {
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
            Self::DepthWrite => (depth_tests, A::DEPTH_STENCIL_ATTACHMENT_READ | A::DEPTH_STENCIL_ATTACHMENT_WRITE),
            Self::DepthTest => (depth_tests, A::DEPTH_STENCIL_ATTACHMENT_READ),
            Self::Sampled => (S::FRAGMENT_SHADER, A::SHADER_READ),
            Self::Vertices => (S::VERTEX_ATTRIBUTE_INPUT, A::VERTEX_ATTRIBUTE_READ),
            Self::CopySource => (S::COPY, A::TRANSFER_READ),
            Self::CopyTarget => (S::COPY | S::CLEAR, A::TRANSFER_WRITE),
            Self::ComputeRead => (S::COMPUTE_SHADER, A::SHADER_READ),
            Self::ComputeWrite => (S::COMPUTE_SHADER, A::SHADER_WRITE),
        }
    }
}
