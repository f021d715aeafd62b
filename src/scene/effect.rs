//! Effects: GLSL of the user's that samples and surfaces go through, as text. What it may use stands in
//! `glsl/shared/effect.glsl`.

use std::fmt::Write;

use sha2::{Digest, Sha256};

use crate::error::{Error, Result, shown};

/// Bytes of an effect at the most; compilers take longer for larger ones than anyone waits.
pub const MOST_BYTES: usize = 1 << 20;

/// Characters of a hash that tables and sentences show.
const SHORT: usize = 12;

/// What an effect declares in GLSL.
pub const SIGNATURE: &str = "vec4 effect(Sample here)";

/// Words of GLSL that an effect may not have, each with the reason.
const REFUSED: [(&str, &str); 7] = [
    ("layout", "an effect has no bindings, constants or outputs of its own"),
    ("uniform", "an effect has no bindings of its own"),
    ("buffer", "an effect has no bindings of its own"),
    ("shared", "rays know nothing of each other"),
    ("discard", "it would leave a pixel as it was, and return opacity 0 leaves out a sample"),
    ("gl_FragDepth", "depths decide which rays go on"),
    ("main", "the program has it; define `vec4 effect(Sample here)`"),
];

/// A user's effect.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Effect {
    /// The file as messages show it.
    pub name: String,
    pub text: String,
    /// SHA-256 of the text, in hexadecimal digits.
    pub hash: String,
    /// What may make its picture mislead.
    pub warnings: Vec<String>,
}

impl Effect {
    /// The effect in the text of a file.
    ///
    /// # Errors
    /// When the text is empty, too long, or has something that no effect may have, with its line.
    pub fn new(name: &str, text: &str) -> Result<Self> {
        let name = shown(&name.replace('\n', "\\n"));
        if text.len() > MOST_BYTES {
            let remedy = format!("give an effect of up to {MOST_BYTES} bytes");
            return Err(Error::input(&name, format!("has {} bytes", text.len()), remedy));
        }
        let code = without_comments(text);
        if code.trim().is_empty() {
            return Err(Error::input(&name, "holds no code", format!("define `{SIGNATURE}`")));
        }
        for (number, line) in code.lines().enumerate() {
            if let Some((problem, remedy)) = refused(line) {
                return Err(Error::input(format!("{name}:{}", number + 1), problem, remedy));
            }
        }
        let mut hash = String::new();
        for byte in Sha256::digest(text.as_bytes()) {
            // Writing to a String cannot fail.
            let _ = write!(hash, "{byte:02x}");
        }
        Ok(Self { name, text: text.to_owned(), hash, warnings: Vec::new() })
    }

    /// The file without its folder, and the begin of its hash: `tint.glsl (SHA-256 0123456789ab)`.
    pub fn words(&self) -> String {
        words(self.file(), &self.hash)
    }

    /// The file without its folder.
    pub fn file(&self) -> &str {
        self.name.rsplit(['/', std::path::MAIN_SEPARATOR]).next().unwrap_or(&self.name)
    }

    /// Notes what the text hashed to when a run was made that is to be repeated.
    pub fn was(&mut self, hash: &str) {
        if !hash.eq_ignore_ascii_case(&self.hash) {
            self.warnings.push(format!(
                "the effect {} is another one than that of the settings, whose text had the SHA-256 {}: the picture may differ",
                self.words(),
                short(hash)
            ));
        }
    }
}

/// An effect in words, by its file without a folder and its hash.
pub fn words(file: &str, hash: &str) -> String {
    format!("{file} (SHA-256 {})", short(hash))
}

fn short(hash: &str) -> String {
    hash.chars().take(SHORT).collect()
}

/// What a line of code has that no effect may have: problem and remedy.
fn refused(line: &str) -> Option<(String, String)> {
    if line.contains('\0') {
        return Some(("holds a zero byte".to_owned(), "give a text file".to_owned()));
    }
    if let Some(directive) = line.trim_start().strip_prefix('#') {
        let word = directive.split_whitespace().next().unwrap_or_default();
        if ["include", "version", "extension", "line"].iter().any(|one| word.starts_with(one)) {
            let problem = format!("has `#{word}`, and an effect is one file without it");
            let remedy =
                "leave it out; version, extensions and what glsl/shared/effect.glsl declares are there already";
            return Some((problem, remedy.to_owned()));
        }
    }
    let mut words = line.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    let (word, why) = words.find_map(|word| REFUSED.into_iter().find(|(one, _)| *one == word))?;
    Some((format!("has `{word}`: {why}"), "leave it out".to_owned()))
}

/// The text with blanks in place of comments, line by line as it was.
fn without_comments(text: &str) -> String {
    let mut code = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find("//").into_iter().chain(rest.find("/*")).min() {
        code.push_str(&rest[..at]);
        let comment = &rest[at..];
        let end = match comment.starts_with("//") {
            true => comment.find('\n').unwrap_or(comment.len()),
            false => comment.get(2..).and_then(|inside| inside.find("*/")).map_or(comment.len(), |end| end + 4),
        };
        code.push(' ');
        code.extend(comment[..end].chars().filter(|c| *c == '\n'));
        rest = &comment[end..];
    }
    code + rest
}
