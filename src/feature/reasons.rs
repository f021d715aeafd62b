//! Reasons that several features give.

use crate::part::rows::Context;

/// Why there is nothing to skip.
pub const DENSE: &str =
    "every cell is interesting, so that there is nothing to skip: slices or a single pass would do as well";

/// Why a method that decides after a main pass decides nothing.
pub const ONLY_PASS: &str = "there is nothing to decide after the only main pass";

/// Why no ray ends early.
pub fn never_ends(context: &Context) -> String {
    format!("no ray of this view comes to an opacity above {}", context.scene.settings.sampling.termination)
}
