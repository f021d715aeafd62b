//! Reasons that several features give.

use crate::part::rows::Context;
use crate::projection::Ends;

/// Why there is nothing to skip.
pub const DENSE: &str =
    "every cell is interesting, so that there is nothing to skip: slices or a single pass would do as well";

/// Why a method that decides after a main pass decides nothing.
pub const ONLY_PASS: &str = "there is nothing to decide after the only main pass";

/// Why no ray ends early.
pub fn never_ends(context: &Context) -> String {
    if let Ends::Never(why) = context.projection().ends {
        return why.to_owned();
    }
    if context.scene.ends_at_surfaces() {
        return "rays go on behind a surface where T is 1".to_owned();
    }
    format!("no ray of this view comes to an opacity above {}", context.scene.settings.sampling.termination)
}
