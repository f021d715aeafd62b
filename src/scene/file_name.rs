//! File names in settings: text where a name is UTF-8, else the list of its bytes, so that no name is lost.

use std::ffi::OsString;
use std::path::PathBuf;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Deserialize)]
#[serde(untagged, expecting = "expected the name of a file, as text or as a list of bytes")]
enum FileName {
    Text(PathBuf),
    Bytes(Vec<u8>),
}

/// Writes the name.
pub fn serialize<S: Serializer>(path: &Option<PathBuf>, to: S) -> Result<S::Ok, S::Error> {
    let Some(path) = path else { return to.serialize_none() };
    match (path.to_str(), bytes(path)) {
        (None, Some(bytes)) => bytes.serialize(to),
        _ => path.serialize(to),
    }
}

/// Reads what [`serialize`] wrote.
pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<PathBuf>, D::Error> {
    match Option::<FileName>::deserialize(from)? {
        None => Ok(None),
        Some(FileName::Text(path)) => Ok(Some(path)),
        Some(FileName::Bytes(bytes)) => name(bytes).map(|name| Some(name.into())).map_err(D::Error::custom),
    }
}

#[cfg(unix)]
fn bytes(path: &std::path::Path) -> Option<&[u8]> {
    Some(std::os::unix::ffi::OsStrExt::as_bytes(path.as_os_str()))
}

#[cfg(not(unix))]
fn bytes(_: &std::path::Path) -> Option<&[u8]> {
    None
}

/// The name that these bytes are.
///
/// # Errors
/// When they are no name on this system.
#[cfg(unix)]
pub fn name(bytes: Vec<u8>) -> Result<OsString, String> {
    Ok(std::os::unix::ffi::OsStringExt::from_vec(bytes))
}

/// The name that these bytes are.
///
/// # Errors
/// When they are no name on this system.
#[cfg(not(unix))]
pub fn name(bytes: Vec<u8>) -> Result<OsString, String> {
    String::from_utf8(bytes).map(OsString::from).map_err(|e| format!("a file name that is not UTF-8: {e}"))
}
