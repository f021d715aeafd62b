//! Shaders as data.

use std::collections::BTreeSet;
use std::fmt;
use std::sync::Arc;

use super::source::Insert;

/// A file of `glsl/` and the defines it is compiled with. Its name, which shows in plans, captures and messages, follows
/// from both: `main_pass.frag:CULL_DISCARD+HOLES`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Shader {
    /// Path from the root: `structure/cell_range.comp`.
    pub file: &'static str,
    /// Those of the file's `//@takes` line ([`super::takes`]).
    pub defines: BTreeSet<&'static str>,
    /// The user's own text that it includes, where it includes one.
    pub insert: Option<Arc<Insert>>,
}

impl Shader {
    pub fn new(file: &'static str, defines: impl IntoIterator<Item = &'static str>) -> Self {
        Self { file, defines: defines.into_iter().collect(), insert: None }
    }
}

impl fmt::Display for Shader {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.file)?;
        let between = std::iter::once(':').chain(std::iter::repeat('+'));
        self.defines.iter().zip(between).try_for_each(|(define, sign)| write!(f, "{sign}{define}"))
    }
}
