//! Empties RES where an intermediate pass reads it before the first main pass has written it.

use crate::feature::surface::gathered;
use crate::part::access::Usage;
use crate::part::rows::Context;
use crate::part::{Group, Step, Work};

pub fn clear(context: &Context) -> Step {
    Step::new(
        "clear".to_owned(),
        Group::Setup,
        0,
        vec![Usage::CopyTarget.of(gathered(context))],
        Work::Clear(gathered(context)),
    )
}
