//! Where results come from: the program and the command that made them, said alike in every file of results.

use std::time::SystemTime;

use serde::{Deserialize, Serialize};

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

/// The words the program was started with, quoted where a shell would read them otherwise.
fn command_line() -> String {
    let quoted = |word: String| {
        let plain = !word.is_empty() && word.chars().all(|c| c.is_alphanumeric() || "-_./,:=+".contains(c));
        if plain { word } else { format!("'{word}'") }
    };
    let words = std::env::args_os().skip(1).map(|word| quoted(word.to_string_lossy().into_owned()));
    std::iter::once("depthleap".to_owned()).chain(words).collect::<Vec<_>>().join(" ")
}
