//! Structures that tell where a volume holds nothing to see.

pub mod blocks;
pub mod cells;
pub mod distance;
