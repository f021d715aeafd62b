//! Formulas that the passes, the reference and the structures share: rays, boxes and triangles, interpolation, opacity, blending.

pub mod blend;
pub mod bvh;
pub mod edges;
pub mod interpolate;
pub mod opacity;
pub mod polyhedron;
pub mod random;
pub mod ray;
pub mod triangle;
