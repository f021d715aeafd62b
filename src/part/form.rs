//! The two choices of near-neighbor skipping: how fragments are culled and how they are marked.

use crate::scene::settings::{Cull, Mark};

/// Cull and mark of a method, with `auto` resolved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Form {
    pub cull: Cull,
    pub mark: Mark,
}

impl Form {
    /// As it stands in tables: `bounds+fragdepth`.
    pub fn name(self) -> String {
        format!("{}+{}", self.cull_name(), self.mark_name())
    }

    pub fn cull_name(self) -> &'static str {
        match self.cull {
            Cull::Auto => "auto",
            Cull::Bounds => "bounds",
            Cull::Ztest => "ztest",
            Cull::Discard => "discard",
        }
    }

    pub fn mark_name(self) -> &'static str {
        match self.mark {
            Mark::Auto => "auto",
            Mark::Fragdepth => "fragdepth",
            Mark::FragdepthAny => "fragdepth-any",
            Mark::Copy => "copy",
        }
    }
}
