//! What frames are made of: the types of steps, resources, methods and features, and the context that their rows are asked in.
//!
//! A pass file makes [`Step`]s; a method puts them in order; [`crate::plan`] asks it; [`crate::frame`] runs the list.

pub mod access;
pub mod form;
pub mod geometry;
pub mod resource;
pub mod rows;
pub mod steps;

use std::sync::Arc;

use ash::vk;

use crate::glsl::{Insert, Shader};
use crate::math::blend::Blend;
use crate::shared::Slice;
use crate::twin::TwinPass;
use access::Access;
use geometry::Geometry;
use resource::Resource;

/// One line of a plan: a pass with everything it needs to run.
#[derive(Clone, Debug)]
pub struct Step {
    /// Shows in plans, captures, validation messages and reports: `main_pass #3`.
    pub name: String,
    /// The row its time and its fragments count for.
    pub group: Group,
    /// The main pass this step is, or decides about.
    pub pass: u32,
    /// The part of each ray it is about: that behind so many layers.
    pub section: u32,
    /// The counting step, by its place among those of the frame, without whose fragments this one has nothing to do.
    pub guard: Option<u32>,
    /// What it reads and writes; layouts, barriers, load and store ops follow from it.
    pub accesses: Arc<Vec<Access>>,
    pub work: Work,
}

impl Step {
    /// A step that draws.
    pub fn drawn(name: String, group: Group, pass: u32, accesses: Vec<Access>, draw: Draw) -> Self {
        Self::new(name, group, pass, accesses, Work::Draw(draw))
    }

    /// A step about whole rays that hangs on no other.
    pub fn new(name: String, group: Group, pass: u32, accesses: Vec<Access>, work: Work) -> Self {
        Self { name, group, pass, section: 0, guard: None, accesses: accesses.into(), work }
    }

    /// The pass without its number: `main_pass`.
    pub fn pass_name(&self) -> &str {
        self.name.split(' ').next().unwrap_or(&self.name)
    }
}

/// What a step's time and fragments count for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Group {
    /// Once a frame, before the first main pass.
    Setup,
    /// Depth layers of polygons, one a step.
    Peel,
    Main,
    Intermediate,
    /// Lights on iso-surfaces, once for all rays.
    Light,
    /// Colours of layers, and of opaque polygons, under what is in front of them.
    Blend,
    /// Marks to the depth buffer.
    Copy,
    /// Counting the rays that are left.
    Alive,
    /// Structures, built before the frame on the compute queue or on the host.
    Structure,
    /// What the host has, before what reads it.
    Upload,
}

impl Group {
    pub const ALL: [Self; 10] = [
        Self::Upload,
        Self::Structure,
        Self::Setup,
        Self::Peel,
        Self::Main,
        Self::Intermediate,
        Self::Light,
        Self::Blend,
        Self::Copy,
        Self::Alive,
    ];

    /// Whether fragments of its steps are counted in every run, so that others may hang on them.
    pub fn counts(self) -> bool {
        matches!(self, Self::Alive | Self::Peel)
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Structure => "structure",
            Self::Setup => "setup",
            Self::Peel => "peel",
            Self::Light => "light",
            Self::Blend => "blend",
            Self::Main => "main",
            Self::Intermediate => "intermediate",
            Self::Copy => "copy",
            Self::Alive => "alive",
            Self::Upload => "upload",
        }
    }
}

#[derive(Clone, Debug)]
pub enum Work {
    Draw(Draw),
    /// Colour image to depth image, by way of a buffer: all of it, or where main pass `of` draws.
    Copy {
        from: Resource,
        by: Resource,
        to: Resource,
        of: Option<u32>,
    },
    /// To transparent black.
    Clear(Resource),
    Dispatch(Dispatch),
    Pixels(PixelDispatch),
    /// Texels of a build, made in a buffer, to the texture that frames read.
    Unpack {
        from: Resource,
        to: Resource,
    },
    /// The host makes the bytes of a resource, and they are uploaded.
    Host(Resource),
}

impl Work {
    /// What it draws.
    pub fn geometry(&self) -> Option<&'static Geometry> {
        match self {
            Self::Draw(draw) => Some(draw.geometry),
            _ => None,
        }
    }

    /// The vertex shader, where it draws.
    pub fn vertex(&self) -> Option<Shader> {
        match self {
            Self::Draw(draw) => Some(draw.vertex()),
            _ => None,
        }
    }

    /// What is compiled for it; none where nothing is drawn or computed, or the vertex shader does.
    pub fn shader(&self) -> Option<&Arc<Shader>> {
        match self {
            Self::Draw(draw) => draw.shader.as_ref(),
            Self::Dispatch(dispatch) => Some(&dispatch.shader),
            Self::Pixels(pixels) => Some(&pixels.shader),
            Self::Copy { .. } | Self::Clear(_) | Self::Unpack { .. } | Self::Host(_) => None,
        }
    }

    /// The specialization constants of its shader, by name.
    pub fn constants(&self) -> &[Constant] {
        match self {
            Self::Draw(draw) => &draw.constants,
            Self::Dispatch(dispatch) => &dispatch.constants,
            Self::Pixels(pixels) => &pixels.constants,
            Self::Copy { .. } | Self::Clear(_) | Self::Unpack { .. } | Self::Host(_) => &[],
        }
    }
}

/// A specialization constant: its name and its value, a number of any type as its 32 bits.
pub type Constant = (&'static str, u32);

/// A compute step of a structure's build, run in slices.
#[derive(Clone, Debug)]
pub struct Dispatch {
    pub shader: Arc<Shader>,
    /// Specialization constants, by name.
    pub constants: Vec<Constant>,
    /// What is bound, by the names in the shader.
    pub bound: Vec<(&'static str, Resource)>,
    /// All of it: `first` is 0, `end` the number of invocations.
    pub slice: Slice,
    /// Cells an invocation goes through: what a slice costs.
    pub cells: u32,
}

/// A compute shader that runs for every pixel of the targets, an invocation a pixel.
#[derive(Clone, Debug)]
pub struct PixelDispatch {
    pub shader: Arc<Shader>,
    /// Specialization constants, by name.
    pub constants: Arc<Vec<Constant>>,
    /// The same in f64.
    pub twin: TwinPass,
}

/// Sides of a work group of [`PixelDispatch`], in pixels.
pub const TILE: u32 = 8;

/// Drawing a geometry.
#[derive(Clone, Debug)]
pub struct Draw {
    pub geometry: &'static Geometry,
    /// The buffer of its corners, of several that the geometry has.
    pub vertices: Resource,
    /// The depths that 0 and 1 are taken to; where they are one, all of it is drawn there, to the bit.
    pub depths: [f32; 2],
    /// The least stored depth with which a fragment takes part, where the step is culled.
    pub least: f32,
    /// The greatest stored depth with which a fragment takes part, where the step is culled.
    pub bound: f32,
    pub test: DepthTest,
    /// A define of the vertex shader's, if any.
    pub vertex_define: Option<&'static str>,
    /// The fragment shader; none where only the count matters.
    pub shader: Option<Arc<Shader>>,
    /// Specialization constants, by name.
    pub constants: Arc<Vec<Constant>>,
    /// How its colour goes into what is there.
    pub blend: Blend,
    /// Whether it gives every pixel that it covers a colour of its own.
    pub fills: bool,
    /// The same in f64; none where a pixel is not changed.
    pub twin: Option<TwinPass>,
}

/// The depth tests of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct DepthTest {
    /// None: the step has no depth attachment.
    pub compare: Option<vk::CompareOp>,
    pub write: bool,
    /// Depth bounds test [0, bound].
    pub bounds: bool,
}

impl DepthTest {
    pub const NONE: Self = Self { compare: None, write: false, bounds: false };
}

impl Draw {
    /// A step that draws `geometry` with the fragment shader in `file` and no depth.
    pub fn plain(geometry: &'static Geometry, file: &'static str, twin: TwinPass) -> Self {
        Self {
            geometry,
            vertices: geometry.vertices,
            depths: [1.0; 2],
            least: 0.0,
            bound: 1.0,
            test: DepthTest::NONE,
            vertex_define: None,
            shader: Some(Arc::new(Shader::new(file, []))),
            constants: Arc::default(),
            blend: Blend::Replace,
            fills: false,
            twin: Some(twin),
        }
    }

    /// Adds defines to the shader's.
    pub fn define(&mut self, defines: impl IntoIterator<Item = &'static str>) {
        if let Some(shader) = &mut self.shader {
            Arc::make_mut(shader).defines.extend(defines);
        }
    }

    /// The vertex shader.
    pub fn vertex(&self) -> Shader {
        Shader::new(self.geometry.vertex, self.vertex_define)
    }

    /// Gives the shader a text of the user's that it includes.
    pub fn insert(&mut self, insert: Option<Arc<Insert>>) {
        if let Some(shader) = &mut self.shader {
            Arc::make_mut(shader).insert = insert;
        }
    }

    /// Adds specialization constants.
    pub fn specialize(&mut self, constants: impl IntoIterator<Item = Constant>) {
        Arc::make_mut(&mut self.constants).extend(constants);
    }
}
