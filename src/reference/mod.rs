//! (skeleton)

pub mod exact;
