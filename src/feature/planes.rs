//! Clip planes [Thesis §3.1.2].

use crate::part::rows::{Feature, Hook, Why};
use crate::resource;

/// Planes that the interval of a ray is cut at.
pub const CLIP_PLANES: Feature = Feature {
    with: Some("PLANES"),
    reads: |_| vec![resource::CLIP_PLANES],
    ..Feature::at(Hook::Interval, "clip planes", |context| match context.scene.planes.all() {
        [] => Err(Why::Untold),
        _ if context.scene.clip_planes().is_empty() => Err("none of them cuts anything off the volume".into()),
        _ => Ok(()),
    })
};
