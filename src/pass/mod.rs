//! Passes, each said once: what it reads, what it draws into, its shaders and constants, its f64 twin.
//!
//! Files here do not import each other; what they share is a formula or a named resource.

pub mod alive;
pub mod backdrop;
pub mod block_skip;
pub mod build;
pub mod clear;
pub mod clip_begin;
pub mod clip_winding;
pub mod constants;
pub mod cull;
pub mod direction;
pub mod entry;
pub mod fused;
pub mod layer;
pub mod lighting;
pub mod main_pass;
pub mod mark_copy;
pub mod near_neighbor;
pub mod peel;
mod polygons;
pub mod rays;
pub mod shells;
pub mod single_pass;
pub mod slices;
pub mod start;
pub mod termination;
pub mod tetrahedra;
