//! Empties RES where an intermediate pass reads it before the first main pass has written it.

use crate::part::resource::{Resource, Usage};
use crate::part::{Group, Step, Work};

pub fn clear() -> Step {
    Step {
        name: "clear".to_owned(),
        group: Group::Setup,
        pass: 0,
        accesses: vec![Usage::CopyTarget.of(Resource::Accumulated)].into(),
        work: Work::Clear(Resource::Accumulated),
    }
}
