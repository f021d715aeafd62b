//! Where the program keeps what it need not find again.

use std::path::PathBuf;

/// `depthleap` below `$XDG_CACHE_HOME`, else below `~/.cache`; none where there is no home either.
pub fn folder() -> Option<PathBuf> {
    // A path that is not absolute has to be ignored [XDG Base Directory Specification 0.8].
    let set = std::env::var_os("XDG_CACHE_HOME").map(PathBuf::from).filter(|path| path.is_absolute());
    let root = set.or_else(|| std::env::home_dir().map(|home| home.join(".cache")));
    root.map(|root| root.join("depthleap"))
}
