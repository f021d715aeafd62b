//! Empties RES where an intermediate pass reads it before the first main pass has written it.

use crate::part::access::Usage;
use crate::part::{Group, Step, Work};
use crate::resource;

pub fn clear() -> Step {
    Step {
        name: "clear".to_owned(),
        group: Group::Setup,
        pass: 0,
        accesses: vec![Usage::CopyTarget.of(resource::ACCUMULATED)].into(),
        work: Work::Clear(resource::ACCUMULATED),
    }
}
