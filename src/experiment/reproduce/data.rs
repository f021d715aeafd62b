//! The folder of the volumes.

use std::path::{Path, PathBuf};

/// The file of a volume in the folder of all, or why there is none.
pub fn volume(folder: Option<&Path>, name: &str) -> std::result::Result<PathBuf, String> {
    let Some(folder) = folder else { return Err(format!("give the folder with {name} as --data")) };
    let path = folder.join(name);
    if path.is_file() { Ok(path) } else { Err(format!("{} is not there", path.display())) }
}
