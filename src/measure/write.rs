//! Files that are there completely or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use crate::error::{Error, Result};

/// Makes `folder` and what is missing above it.
///
/// # Errors
/// When it cannot be made, or a file has its name.
pub fn create_folder(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder).map_err(|e| {
        let remedy = if folder.is_file() {
            "a file has this name: choose another folder"
        } else {
            "choose a folder you may write to"
        };
        Error::output(folder.display(), format!("cannot be made a folder ({e})"), remedy)
    })
}

/// Writes `bytes` to a temporary file beside `path` and renames it, so that no reader ever sees half of it. A missing
/// folder is made. What is no regular file (`/dev/null`, a pipe) is written to as it is.
///
/// # Errors
/// When the folder or the file cannot be written.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    // Through a symbolic link: the file it names is replaced, the link stays.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    if target.is_dir() {
        return Err(Error::output(path.display(), "is a folder", "give the name of a file"));
    }
    let failed = |e: io::Error| Error::output(path.display(), format!("cannot be written ({e})"), remedy(e.kind()));
    if target.exists() && !target.is_file() {
        return fs::OpenOptions::new().write(true).open(&target).and_then(|mut f| f.write_all(bytes)).map_err(failed);
    }
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    create_folder(folder)?;
    let mut file = new_temporary(folder).map_err(failed)?;
    file.write_all(bytes).map_err(failed)?;
    file.persist(&target).map_err(|e| failed(e.error))?;
    Ok(())
}

/// Writes to standard output, all of it at once.
///
/// # Errors
/// When standard output is closed or full.
pub fn write_standard_output(bytes: &[u8]) -> Result<()> {
    let mut out = io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).map_err(|e| {
        Error::output("standard output", format!("cannot be written ({e})"), "keep the reading end open or use a file")
    })
}

fn new_temporary(folder: &Path) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".depthleap-");
    // Temporary files are private by default; a result has the rights of any new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder)
}

fn remedy(kind: io::ErrorKind) -> &'static str {
    match kind {
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "choose a folder you may write to, or change its permissions"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "free some space or choose another disk",
        _ => "choose another place for it",
    }
}
