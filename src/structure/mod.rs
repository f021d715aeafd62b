//! (skeleton)

pub mod blocks;
pub mod cells;
pub mod distance;
