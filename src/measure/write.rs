//! Files that are there completely or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::{Error, Result};

/// Whether a file of that name can be written, found out before work is done for nothing. Leaves nothing behind.
///
/// # Errors
/// As [`write_atomically`].
pub fn check_file(path: &Path) -> Result<()> {
    let target = target(path)?;
    if is_special(&target) { Ok(()) } else { temporary(path, &target).map(drop) }
}

/// Whether `folder` is one that can be written to, or can be made. Leaves nothing behind.
///
/// # Errors
/// As [`create_folder`], or when nothing can be written into it.
pub fn check_folder(folder: &Path) -> Result<()> {
    let absolute = std::path::absolute(folder).map_err(|e| no_folder(folder, &e))?;
    let existing = absolute.ancestors().find(|a| a.exists()).unwrap_or(Path::new("/"));
    let probe = if existing.is_dir() { new_temporary(existing) } else { Err(io::ErrorKind::NotADirectory.into()) };
    probe.map(drop).map_err(|e| no_folder(folder, &e))
}

/// Makes `folder` and what is missing above it.
///
/// # Errors
/// When it cannot be made, or a file has its name.
pub fn create_folder(folder: &Path) -> Result<()> {
    fs::create_dir_all(folder).map_err(|e| no_folder(folder, &e))
}

fn no_folder(folder: &Path, e: &io::Error) -> Error {
    let remedy = match folder.is_file() {
        true => "a file has this name: choose another folder",
        false => "choose a folder you may write to",
    };
    Error::output(folder.display(), format!("cannot be a folder for results ({})", reason(e)), remedy)
}

/// Writes `bytes` to a temporary file beside `path` and renames it, so that no reader ever sees half of it. What is
/// no regular file (`/dev/null`, a pipe) is written to as it is.
///
/// # Errors
/// When there is no such folder or the file cannot be written.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    let target = target(path)?;
    let failed = |e: io::Error| unwritable(path, &e);
    if is_special(&target) {
        return fs::OpenOptions::new().write(true).open(&target).and_then(|mut f| f.write_all(bytes)).map_err(failed);
    }
    let mut file = temporary(path, &target)?;
    file.write_all(bytes).map_err(failed)?;
    file.persist(&target).map_err(|e| failed(e.error))?;
    Ok(())
}

/// The file that `path` names. Through a symbolic link: the file it names is replaced, the link stays.
fn target(path: &Path) -> Result<PathBuf> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    if target.is_dir() {
        return Err(Error::output(path.display(), "is a folder", "give the name of a file"));
    }
    Ok(target)
}

fn is_special(target: &Path) -> bool {
    target.exists() && !target.is_file()
}

/// A temporary file beside `target`.
fn temporary(path: &Path, target: &Path) -> Result<tempfile::NamedTempFile> {
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    if !folder.is_dir() {
        let problem = format!("there is no folder {}", folder.display());
        return Err(Error::output(path.display(), problem, "make it, or choose another folder"));
    }
    new_temporary(folder).map_err(|e| unwritable(path, &e))
}

fn unwritable(path: &Path, e: &io::Error) -> Error {
    Error::output(path.display(), format!("cannot be written ({})", reason(e)), remedy(e.kind()))
}

/// What the system says, without the name of a temporary file, which nobody knows.
fn reason(e: &io::Error) -> String {
    e.to_string().split(" at path ").next().unwrap_or_default().to_owned()
}

/// Whether `path` stands for standard output: `-`, or `-.png` and the like where the ending tells the format.
pub fn is_standard_output(path: &Path) -> bool {
    let alone = path.parent() == Some(Path::new(""));
    alone && path.file_stem().is_some_and(|stem| stem == "-")
}

/// Writes to standard output, all of it at once. A reader that has left (`| head`) has what it wanted.
///
/// # Errors
/// When standard output is closed or full.
pub fn write_standard_output(bytes: &[u8]) -> Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(e) if e.kind() != io::ErrorKind::BrokenPipe => {
            Err(Error::output("standard output", format!("cannot be written ({e})"), "write to a file instead"))
        }
        _ => Ok(()),
    }
}

/// `value` as indented JSON, to a file or, for `-`, to standard output.
///
/// # Errors
/// When it cannot be written.
pub fn write_json(path: &Path, value: &impl Serialize) -> Result<()> {
    let mut json = serde_json::to_vec_pretty(value).map_err(|e| {
        let problem = format!("cannot be written as JSON ({e})");
        Error::output(path.display(), problem, "check paths for names that are not UTF-8")
    })?;
    json.push(b'\n');
    if is_standard_output(path) { write_standard_output(&json) } else { write_atomically(path, &json) }
}

/// Writes for the user to read. There is nobody left to tell where that fails.
pub fn write_standard_error(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
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
