//! Empties RES where an intermediate pass reads it before the first main pass has written it.

use crate::part::access::Usage;
use crate::part::{Group, Step, Work};
use crate::resource;

pub fn clear() -> Step {
    Step::new(
        "clear".to_owned(),
        Group::Setup,
        0,
        vec![Usage::CopyTarget.of(resource::ACCUMULATED)],
        Work::Clear(resource::ACCUMULATED),
    )
}
