//! Where the program keeps what it need not find again.

use std::path::{Path, PathBuf};

use serde::Serialize;
use sha2::{Digest, Sha256};

/// `depthleap` below `$XDG_CACHE_HOME`, else below `~/.cache`; none where there is no home either.
pub fn folder() -> Option<PathBuf> {
    // A path that is not absolute has to be ignored [XDG Base Directory Specification 0.8].
    let set = std::env::var_os("XDG_CACHE_HOME").map(PathBuf::from).filter(|path| path.is_absolute());
    let root = set.or_else(|| std::env::home_dir().map(|home| home.join(".cache")));
    root.map(|root| root.join("depthleap"))
}

/// Where in a folder of the cache lies what hangs on all of `parts`, or would lie.
pub fn file(of: &str, parts: &[&[u8]]) -> Option<PathBuf> {
    let mut hash = Sha256::new();
    for part in parts {
        // With its length, so that no two lists look alike.
        hash.update((part.len() as u64).to_le_bytes());
        hash.update(part);
    }
    let name: String = hash.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    folder().map(|folder| folder.join(of).join(format!("{name}.json")))
}

/// Keeps a record as JSON, whole or not at all. Whatever is wrong with the cache only means that nobody knows of it later.
pub fn keep(path: &Path, record: &impl Serialize) {
    let Some(folder) = path.parent() else { return };
    let written = || -> Option<()> {
        std::fs::create_dir_all(folder).ok()?;
        // Under a name of its own first: others may read and write here at the same time.
        let file = tempfile::NamedTempFile::new_in(folder).ok()?;
        serde_json::to_writer(&file, record).ok()?;
        file.persist(path).ok().map(drop)
    };
    let _ = written();
}
