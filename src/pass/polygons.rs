//! What every draw of polygons reads.

use crate::part::access::{Access, Usage};
use crate::resource;

/// Corners, their places in the picture, planes and materials.
pub fn reads() -> Vec<Access> {
    vec![
        Usage::Vertices.of(resource::POLYGON_CORNERS),
        Usage::Sampled.of(resource::FRAME),
        Usage::Sampled.of(resource::PLACEMENT),
        Usage::Sampled.of(resource::TRIANGLES),
        Usage::Sampled.of(resource::MATERIALS),
    ]
}
