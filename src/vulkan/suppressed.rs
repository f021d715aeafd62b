//! The one list of validation messages that are not collected.

/// Message id and the reason why it is no fault of ours, with a link where there is one.
pub const SUPPRESSED: &[(&str, &str)] = &[];
