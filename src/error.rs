//! The one error type: which input, what is wrong with it, and what to do.

/// The longest line of a message that is shown, in characters as they are shown: lists of devices and keys stay whole, a kilobyte of
/// somebody's file does not.
const LONGEST_LINE: usize = 1000;

/// The most lines of a message that are shown: those of a compiler.
const MOST_LINES: usize = 40;

/// Text for a terminal: characters that steer one are escaped, and what is too long ends in an ellipsis.
pub fn shown(text: &str) -> String {
    let line = |line: &str| {
        let (mut out, mut length) = (String::new(), 0);
        for c in line.chars() {
            length += if steers(c) { c.escape_default().len() } else { 1 };
            if length > LONGEST_LINE {
                out.push('\u{2026}');
                break;
            }
            if steers(c) { out.extend(c.escape_default()) } else { out.push(c) }
        }
        out
    };
    let mut lines: Vec<String> = text.split('\n').take(MOST_LINES).map(line).collect();
    if text.split('\n').nth(MOST_LINES).is_some() {
        lines.push('\u{2026}'.to_string());
    }
    lines.join("\n")
}

/// Whether a character does something else than show: controls, and those that turn the direction of writing or break a
/// line.
fn steers(c: char) -> bool {
    let turns = matches!(c, '\u{200e}' | '\u{200f}' | '\u{61c}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || turns || matches!(c, '\u{2028}' | '\u{2029}')
}

/// What kind of thing failed; decides the exit code of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// An option or a combination of options that makes no sense (exit code 2).
    Usage,
    /// A file or a value in it (exit code 3).
    Input,
    /// A device or a feature that is missing (exit code 4).
    Device,
    /// A check that did not hold: validation messages, a wrong picture (exit code 5).
    Check,
    /// A result that could not be written (exit code 6).
    Output,
}

/// An error as the user reads it: `input: problem; remedy`.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{input}: {problem}; {remedy}")]
pub struct Error {
    pub kind: ErrorKind,
    /// The file, option, key or device at fault, named as the user knows it.
    pub input: String,
    /// What is wrong with it, with the offending value.
    pub problem: String,
    /// What to do about it, as an instruction.
    pub remedy: String,
}

pub type Result<T, E = Error> = std::result::Result<T, E>;

impl Error {
    pub fn usage(input: impl ToString, problem: impl ToString, remedy: impl ToString) -> Self {
        Self::new(ErrorKind::Usage, input, problem, remedy)
    }

    pub fn input(input: impl ToString, problem: impl ToString, remedy: impl ToString) -> Self {
        Self::new(ErrorKind::Input, input, problem, remedy)
    }

    pub fn device(input: impl ToString, problem: impl ToString, remedy: impl ToString) -> Self {
        Self::new(ErrorKind::Device, input, problem, remedy)
    }

    pub fn check(input: impl ToString, problem: impl ToString, remedy: impl ToString) -> Self {
        Self::new(ErrorKind::Check, input, problem, remedy)
    }

    pub fn output(input: impl ToString, problem: impl ToString, remedy: impl ToString) -> Self {
        Self::new(ErrorKind::Output, input, problem, remedy)
    }

    fn new(kind: ErrorKind, input: impl ToString, problem: impl ToString, remedy: impl ToString) -> Self {
        // Only a problem, told by a compiler, has lines: in a name a line's end is a character as any other.
        let [input, remedy] = [input.to_string(), remedy.to_string()].map(|text| shown(&text.replace('\n', "\\n")));
        Self { kind, input, problem: shown(&problem.to_string()), remedy }
    }

    pub fn exit_code(&self) -> u8 {
        match self.kind {
            ErrorKind::Usage => 2,
            ErrorKind::Input => 3,
            ErrorKind::Device => 4,
            ErrorKind::Check => 5,
            ErrorKind::Output => 6,
        }
    }
}
