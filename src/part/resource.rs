//! Every image and buffer as a row: what it holds, how long it lives, how large it is and who makes it. The rows stand in
//! [`mod@crate::resource`].

use std::borrow::Cow;
use std::fmt;
use std::hash::{Hash, Hasher};

use ash::vk;

use crate::scene::Scene;
use crate::scene::settings::Formats;
use crate::scene::view::View;
use crate::structure::Lookup;
use crate::truth::importance::Importance;
use crate::truth::preintegrated::PreintegratedTable;
use crate::vulkan::{ImageShape, texel_bytes};

/// An image or a buffer of a frame, or of a build.
#[derive(Clone, Copy)]
pub struct Resource {
    pub of: &'static ResourceInfo,
    /// Which of several of a kind: of ranges, the side of their cells; 0 where there is one.
    pub index: u16,
}

/// What is known of a resource.
pub struct ResourceInfo {
    /// The name in GLSL, in validation messages, captures, plans and reports.
    pub name: &'static str,
    /// What a texel or an element is, with its unit and its space.
    pub holds: &'static str,
    pub kind: ResourceKind,
    pub life: Life,
    pub origin: Origin,
}

impl ResourceInfo {
    /// A buffer that a build needs meanwhile; it is gone with the build, whatever that depends on.
    pub const fn passing(name: &'static str, holds: &'static str, bytes: Bytes) -> Self {
        Self { name, holds, kind: ResourceKind::Storage(bytes), life: Life::Volume, origin: Origin::Passing }
    }

    /// What the host has anew for every frame.
    pub const fn of_frame(
        name: &'static str,
        holds: &'static str,
        kind: ResourceKind,
        bytes: for<'a> fn(&Facts<'a>) -> Cow<'a, [u8]>,
    ) -> Self {
        Self { name, holds, kind, life: Life::Frame, origin: Origin::Host(bytes) }
    }
}

/// Bytes of a buffer, by the [`Facts`] and the index of the resource.
pub type Bytes = fn(&Facts, u16) -> u64;

/// What a resource is on a device.
pub enum ResourceKind {
    Vertices(Bytes),
    /// Vertices that triangles share, and behind them the numbers of three for each triangle.
    Polygons(Bytes),
    Uniform(Bytes),
    Storage(Bytes),
    /// Texels of a format in a row, which shaders read by their numbers; a storage buffer where the view of a mesh says so.
    Texels(vk::Format, Bytes),
    /// Copies go through it.
    Staging(Bytes),
    /// An image that shaders read.
    Texture(Texture),
    /// An image that frames draw into, as large as what the box may cover.
    Target(fn(Formats) -> vk::Format),
}

/// An image that shaders read.
pub struct Texture {
    pub format: fn(&Facts) -> vk::Format,
    /// Texels along x, y and z.
    pub extent: fn(&Facts) -> [usize; 3],
    pub shape: ImageShape,
    /// Whether the texture unit interpolates it, where the scene asks for that.
    pub filtered: bool,
    /// Whether compute and graphics queue read it alike.
    pub shared: fn(&Facts) -> bool,
}

/// How long a resource stays as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Life {
    /// As long as the volume.
    Volume,
    /// As long as the volume, and the shell whose number is the index.
    Shell,
    /// As long as volume and transfer function.
    Transfer,
    /// As long as these and the view; where it was made for all views, as [`Life::Transfer`].
    View,
    /// As long as a frame with its settings.
    Frame,
}

/// Who makes a resource.
pub enum Origin {
    /// Frames, each time they run.
    Drawn,
    /// The host, whose bytes are uploaded.
    Host(for<'a> fn(&Facts<'a>) -> Cow<'a, [u8]>),
    /// A build: compute shaders, or the host where it has a form of them.
    Built,
    /// A build, which needs it meanwhile only.
    Passing,
}

/// What sizes and contents of resources follow from.
#[derive(Clone, Copy)]
pub struct Facts<'a> {
    pub scene: &'a Scene,
    pub view: &'a View,
    /// N, main passes.
    pub passes: u32,
    /// The distances that are looked up, or that others are made from.
    pub lookup: Option<Lookup>,
    /// Of pre-integrated classification, where contents are asked.
    pub table: Option<&'a PreintegratedTable>,
    /// Of adaptive sampling, where contents are asked.
    pub importance: Option<&'a Importance>,
}

impl Resource {
    /// The one resource of a kind.
    pub const fn new(of: &'static ResourceInfo) -> Self {
        Self { of, index: 0 }
    }

    /// That of several which has the index.
    pub const fn at(self, index: u16) -> Self {
        Self { of: self.of, index }
    }

    pub fn name(self) -> &'static str {
        self.of.name
    }

    /// The name, of images that frames draw into with their index.
    pub fn label(self) -> String {
        if self.is_target() { format!("{self:?}") } else { self.numbered() }
    }

    /// The name, of what belongs to one of several shells with its number.
    pub fn numbered(self) -> String {
        match self.of.life {
            Life::Shell => format!("{} #{}", self.of.name, self.index),
            _ => self.of.name.to_owned(),
        }
    }

    /// Whether every frame writes it anew, at the size of the picture.
    pub fn is_target(self) -> bool {
        matches!(self.of.kind, ResourceKind::Target(_))
    }

    /// The format of a target; undefined for what is none.
    pub fn format(self, formats: Formats) -> vk::Format {
        match self.of.kind {
            ResourceKind::Target(format) => format(formats),
            _ => vk::Format::UNDEFINED,
        }
    }

    /// Bytes on a device.
    pub fn bytes(self, facts: &Facts) -> u64 {
        match &self.of.kind {
            ResourceKind::Vertices(bytes)
            | ResourceKind::Polygons(bytes)
            | ResourceKind::Uniform(bytes)
            | ResourceKind::Storage(bytes)
            | ResourceKind::Texels(_, bytes)
            | ResourceKind::Staging(bytes) => bytes(facts, self.index),
            ResourceKind::Texture(texture) => {
                let texels: usize = (texture.extent)(facts).iter().product();
                texels as u64 * texel_bytes((texture.format)(facts)).unwrap_or(0)
            }
            ResourceKind::Target(format) => {
                let texel = texel_bytes(format(facts.scene.settings.formats())).unwrap_or(0);
                facts.view.region.pixels() * texel
            }
        }
    }
}

impl PartialEq for Resource {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.of, other.of) && self.index == other.index
    }
}

impl Eq for Resource {}

impl Hash for Resource {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (std::ptr::from_ref(self.of), self.index).hash(state);
    }
}

impl fmt::Debug for Resource {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.index {
            0 => f.write_str(self.of.name),
            index => write!(f, "{}[{index}]", self.of.name),
        }
    }
}
