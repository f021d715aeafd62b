//! Names of projections.

use std::fmt;

use serde::Serialize;

/// The name of a projection, as on the command line, in files and in reports. Which projections there are, and what each of
/// them does, says `crate::projection`, where such names are read, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct ProjectionName(&'static str);

impl ProjectionName {
    /// The name of a row of `crate::projection`.
    pub(crate) const fn new(name: &'static str) -> Self {
        Self(name)
    }

    /// The name as a text.
    pub fn name(self) -> &'static str {
        self.0
    }
}

impl fmt::Display for ProjectionName {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.0)
    }
}
