//! The folder of the volumes.

use std::path::{Path, PathBuf};

/// Why nothing was done for a part of the work that was not asked for.
pub const LEFT_OUT: &str = "left out: --parts does not name it";

/// Why nothing was done for the frame rates of a paper that was not asked for.
pub const PAPER_LEFT_OUT: &str = "left out: --papers does not name it";

/// The folder of the volumes, as one part of the work sees it.
#[derive(Clone, Copy)]
pub struct DataFolder<'a> {
    /// None where none was given.
    pub folder: Option<&'a Path>,
    /// Why nothing is done for this part; none where it was asked for.
    pub left_out: Option<&'static str>,
}

impl DataFolder<'_> {
    /// The file of a volume, or why there is none.
    pub fn volume(&self, name: &str) -> std::result::Result<PathBuf, String> {
        if let Some(why) = self.left_out {
            return Err(why.to_owned());
        }
        let Some(folder) = self.folder else { return Err(format!("give the folder with {name} as --data")) };
        let path = folder.join(name);
        if path.is_file() { Ok(path) } else { Err(format!("{} is not there", path.display())) }
    }
}
