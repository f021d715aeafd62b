//! What the last sample of a ray stands for.

use crate::part::rows::{Feature, Hook};
use crate::scene::settings::Last;

/// The last sample stands for what is left of the ray.
pub const LAST_SAMPLE: Feature = Feature {
    constants: |context| {
        let none = context.scene.last() == Last::None;
        vec![("LAST_PARTIAL", u32::from(context.has(&LAST_SAMPLE))), ("LAST_NONE", u32::from(none))]
    },
    ..Feature::at(Hook::Ray, "length of the last sample", |context| match context.scene.last() {
        Last::Partial => Ok(()),
        Last::Full => Err("every sample stands for a whole step".into()),
        Last::None => Err("a ray ends before a step that would leave the volume".into()),
    })
};
