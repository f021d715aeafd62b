//! Where results come from: the program and the command that made them, said alike in every file of results.

use std::time::SystemTime;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};

/// The head of a results file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Provenance {
    /// The version of the file's format.
    pub version: u32,
    /// Name and version of the program.
    pub program: String,
    pub commit: String,
    /// The command line as it can be given to a shell again.
    pub command: String,
    /// When it was begun: UTC, RFC 3339.
    pub date: String,
}

impl Provenance {
    /// Of this run of the program, for a file of such a format.
    pub fn now(version: u32) -> Self {
        Self {
            version,
            program: format!("depthleap {}", env!("CARGO_PKG_VERSION")),
            commit: env!("DEPTHLEAP_COMMIT").to_owned(),
            command: command_line(),
            date: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        }
    }

    /// Program and commit in words.
    pub fn made_by(&self) -> String {
        format!("{}, commit {}", self.program, self.commit)
    }
}

/// What a reader of JSON takes, in words.
#[derive(Clone, Copy, Debug)]
pub struct DocumentFormat {
    /// `a results file`.
    pub what: &'static str,
    /// The version of its format.
    pub version: u32,
    /// What to give instead, and instead of one of another version.
    pub remedies: [&'static str; 2],
}

/// Reads JSON that has `version` among its keys; `name` is the file, for the error.
///
/// # Errors
/// When the text is not JSON, the format is of another version, or a key is missing or of another type.
pub fn read<T: DeserializeOwned>(name: &str, text: &str, expected: &DocumentFormat) -> Result<T> {
    #[derive(Deserialize)]
    struct Head {
        version: u32,
    }
    let [instead, other_version] = expected.remedies;
    let wrong = |e: serde_json::Error| Error::input(name, format!("is not {} ({e})", expected.what), instead);
    let head: Head = serde_json::from_str(text).map_err(wrong)?;
    if head.version != expected.version {
        let problem = format!("has the format version {}, this program reads {}", head.version, expected.version);
        return Err(Error::input(name, problem, other_version));
    }
    serde_json::from_str(text).map_err(wrong)
}

/// The words the program was started with, quoted where a shell would read them otherwise.
fn command_line() -> String {
    let quoted = |word: String| {
        let plain = !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "-_./,:=+".contains(c));
        if plain { word } else { format!("'{word}'") }
    };
    let words = std::env::args_os().skip(1).map(|word| quoted(word.to_string_lossy().into_owned()));
    std::iter::once("depthleap".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}
