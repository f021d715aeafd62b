//! What draws cover pixels with. The rows stand in [`mod@crate::geometry`].

use std::hash::{Hash, Hasher};
use std::ops::Range;

use ash::vk;

use super::resource::Resource;
use crate::scene::Scene;
use crate::scene::region::Region;
use crate::scene::view::View;

/// Triangles, and the fragments that a rasteriser makes of them.
#[derive(Debug)]
pub struct Geometry {
    pub name: &'static str,
    /// The file of the vertex shader.
    pub vertex: &'static str,
    /// The buffer of corners.
    pub vertices: Resource,
    /// The format of a corner, which is all that the vertex shader reads.
    pub corner: vk::Format,
    /// Which corners of the buffer are drawn in a main pass, three a triangle; of the list of their numbers, where there is one.
    pub range: fn(&Scene, &View, u32) -> Range<u32>,
    /// Where in the buffer the list of the numbers of corners begins, bytes, in a main pass; none where triangles share no corners.
    pub numbers: fn(&Scene, u32) -> Option<u64>,
    /// Rectangles of pixels that alone are drawn in a main pass, without overlap, from the first pixel of the view's region; none where
    /// all are.
    pub parts: fn(&View, u32) -> Option<&[Region]>,
    /// Whether it covers no pixels but those of the volume's box, each once, and its fragments read targets at their own pixel only.
    pub within_box: bool,
    /// Whether those of its triangles alone are drawn whose corners go round to the left in the picture.
    pub front_only: bool,
    /// The fragments of a pixel that is in such a rectangle, in f64.
    pub hits: fn(&Scene, &View, Sample) -> Hits,
}

impl Geometry {
    /// Whether a pixel, column and row of the picture, is drawn in a main pass.
    pub fn draws(&self, view: &View, pass: u32, [column, row]: [u32; 2]) -> bool {
        let within = |parts: &[Region]| {
            let place = [column.wrapping_sub(view.region.x), row.wrapping_sub(view.region.y)];
            parts.iter().any(|part| part.contains(place))
        };
        (self.parts)(view, pass).is_none_or(within)
    }
}

/// Where a pixel is asked for its fragments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Column and row, row 0 on top; asked in its centre.
    pub pixel: [u32; 2],
    /// Steps of the raster that a rasteriser moves corners to, in pixels.
    pub raster: f64,
}

/// Fragments that a geometry makes in a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hits {
    pub fragments: u32,
    /// Whether a rasteriser, which moves corners to its raster, may make another number of them.
    pub undecided: bool,
}

impl PartialEq for Geometry {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Eq for Geometry {}

impl Hash for Geometry {
    fn hash<H: Hasher>(&self, state: &mut H) {
        std::ptr::from_ref(self).hash(state);
    }
}
