//! Which defines a shader takes, as its head says:
//!
//! ```text
//! //@takes MARK_COPY | MARK_FRAGDEPTH, [HOLES | PREINTEGRATED], [DENSE]
//! ```
//!
//! Choices are parted by commas. Of a choice exactly one define is given; in brackets, one or none. A define may have a
//! value, which belongs to its name: `DEPTH=depth_any`. Several such lines count as one; a shader without any takes
//! no define. The only other line of this kind is [`UNOPTIMISED`].

use super::compile::UNOPTIMISED;
use super::source::{Broken, Text};

/// One choice: defines that exclude each other.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Alternatives {
    defines: Vec<String>,
    optional: bool,
}

impl Alternatives {
    fn of(text: &str) -> Result<Self, String> {
        let inner = text
            .strip_prefix('[')
            .map(|rest| rest.strip_suffix(']').ok_or_else(|| format!("the bracket of `{text}` is not closed")));
        let optional = inner.is_some();
        let defines: Vec<String> =
            inner.transpose()?.unwrap_or(text).split('|').map(|define| define.trim().to_owned()).collect();
        match defines.iter().find(|define| !is_define(define)) {
            Some(wrong) => Err(format!("`{wrong}` is not a define; write `//@takes A | B, [C], [D=VALUE]`")),
            None => Ok(Self { defines, optional }),
        }
    }

    fn words(&self) -> String {
        let list = self.defines.join(" | ");
        if self.optional { format!("[{list}]") } else { list }
    }
}

/// `NAME` or `NAME=VALUE`.
fn is_define(text: &str) -> bool {
    let word = |part: &str| !part.is_empty() && part.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let (name, value) = text.split_once('=').unwrap_or((text, "1"));
    word(name) && word(value) && !name.starts_with(|c: char| c.is_ascii_digit())
}

/// What the head of a shader says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Takes {
    choices: Vec<Alternatives>,
    /// The first line that says it, counted from 1; the first line of a shader that takes nothing.
    line: usize,
}

impl Takes {
    /// Reads the head of a shader.
    ///
    /// # Errors
    /// A `//@` line that cannot be read, or a define that is there twice, with its place.
    pub fn of(text: &Text) -> Result<Self, Broken> {
        let mut takes = Self { choices: Vec::new(), line: 1 };
        for (index, line) in text.own().lines().enumerate().filter(|(_, line)| *line != UNOPTIMISED) {
            let Some(rest) = line.trim_start().strip_prefix("//@") else { continue };
            let fault = |problem: &str| text.fault(index + 1, problem);
            let Some(list) = rest.strip_prefix("takes ") else {
                return Err(fault(&format!(
                    "`//@{rest}` is not a known line; write `//@takes A | B, [C], [D=VALUE]` or `{UNOPTIMISED}`"
                )));
            };
            if takes.choices.is_empty() {
                takes.line = index + 1;
            }
            for choice in list.split(',') {
                let choice = Alternatives::of(choice.trim()).map_err(|problem| fault(&problem))?;
                for (at, define) in choice.defines.iter().enumerate() {
                    if choice.defines[..at].contains(define) || takes.choice_of(define).is_some() {
                        return Err(fault(&format!("`{define}` is there twice")));
                    }
                }
                takes.choices.push(choice);
            }
        }
        Ok(takes)
    }

    fn choice_of(&self, define: &str) -> Option<&Alternatives> {
        self.choices.iter().find(|choice| choice.defines.iter().any(|one| one == define))
    }

    /// Every define of every choice.
    pub fn defines(&self) -> impl Iterator<Item = &str> {
        self.choices.iter().flat_map(|choice| choice.defines.iter().map(String::as_str))
    }

    /// The first of each choice that needs one, and nothing else.
    pub fn plain(&self) -> Vec<&str> {
        let needed = self.choices.iter().filter(|choice| !choice.optional);
        needed.filter_map(|choice| choice.defines.first().map(String::as_str)).collect()
    }

    /// Whether the shader `text` takes these defines together.
    ///
    /// # Errors
    /// A define it does not know, several of one choice, or a choice that is not made.
    pub fn check(&self, text: &Text, defines: &[&str]) -> Result<(), Broken> {
        let fault = |problem: String| Err(text.fault(self.line, &problem));
        if let Some(unknown) = defines.iter().find(|define| self.choice_of(define).is_none()) {
            let all: Vec<String> = self.choices.iter().map(Alternatives::words).collect();
            let all = if all.is_empty() { "no define at all".to_owned() } else { all.join(", ") };
            return fault(format!("the define `{unknown}` is asked for, and this shader takes {all}"));
        }
        for choice in &self.choices {
            let made: Vec<&str> =
                choice.defines.iter().map(String::as_str).filter(|define| defines.contains(define)).collect();
            if made.len() > 1 {
                return fault(format!("{} are asked for together, and exclude each other", made.join(" and ")));
            }
            if made.is_empty() && !choice.optional {
                return fault(format!("one of {} is needed, and none is asked for", choice.words()));
            }
        }
        Ok(())
    }
}
