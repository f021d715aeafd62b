//! The files that hold the data of a detached header: one, a list, or names made from a pattern and numbers.

use std::path::PathBuf;

use crate::scene::file_name;

/// What `data file` names.
#[derive(Clone, Debug, PartialEq)]
pub enum Names {
    /// The file of the header itself.
    Attached,
    One(PathBuf),
    /// Files that are joined along the slowest axis, each with data of so many axes where that is said.
    Several(Several, Option<usize>),
}

#[derive(Clone, Debug, PartialEq)]
pub enum Several {
    List(Vec<PathBuf>),
    NumberedNames(NumberedNames),
}

/// Names made by printf from the numbers first, first + step, ... up to last.
#[derive(Clone, Debug, PartialEq)]
pub struct NumberedNames {
    before: Vec<u8>,
    after: Vec<u8>,
    /// Filled with 0 where it is, else with spaces.
    zeros: bool,
    width: usize,
    first: i64,
    last: i64,
    step: i64,
}

/// The widest number of a pattern; names are no longer anyway.
const WIDEST: usize = 255;

/// Why a value of `data file` is wrong, and what to do.
pub type Wrong = (&'static str, &'static str);

/// How a list is announced.
const LIST: &[u8] = b"LIST";

impl Names {
    /// What a value of the field says; a list is empty yet: its names follow, one a line.
    ///
    /// # Errors
    /// When it names nothing, or its numbers make no sense.
    pub fn of(value: &[u8]) -> Result<Self, Wrong> {
        let words: Vec<&[u8]> = value.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).collect();
        let number = |word: &[u8]| std::str::from_utf8(word).ok()?.parse::<i64>().ok();
        match words.as_slice() {
            [] => return Err(("is empty", "name the file that holds the data")),
            [list] if *list == LIST => return Ok(Self::Several(Several::List(Vec::new()), None)),
            [list, subdim] if *list == LIST => {
                let subdim = number(subdim).and_then(|n| usize::try_from(n).ok());
                let subdim = subdim.ok_or(("has a LIST with a wrong number of axes", "write `LIST` or `LIST 2`"))?;
                return Ok(Self::Several(Several::List(Vec::new()), Some(subdim)));
            }
            [list, ..] if list.starts_with(b"SKIPLIST") => {
                return Err(("is a SKIPLIST, which is not read", "write a LIST, with `byte skip` for all files alike"));
            }
            _ => {}
        }
        let numbers: Vec<i64> = words.iter().rev().map_while(|word| number(word)).take(4).collect();
        // A name that begins the line is no number of it, and may hold spaces itself.
        for count in [4, 3] {
            let (Some([rest @ .., step, last, first]), true) = (numbers.get(..count), words.len() > count) else {
                continue;
            };
            let name = without_last_words(value, count);
            let Some(pattern) = NumberedNames::of(name, [*first, *last, *step]) else { continue };
            let subdim = match rest.first().map(|n| usize::try_from(*n)) {
                Some(Err(_)) => return Err(("has a negative number of axes", "write `NAME MIN MAX STEP SUBDIM`")),
                subdim => subdim.and_then(Result::ok),
            };
            if *step == 0 || (*last < *first) != (*step < 0) && first != last {
                return Err((
                    "has numbers that make no name",
                    "write NAME%03d MIN MAX STEP, with a step from MIN to MAX",
                ));
            }
            return Ok(Self::Several(Several::NumberedNames(pattern), subdim));
        }
        let name = file_name::name(value.to_vec());
        name.map(|name| Self::One(name.into())).map_err(|_| ("is not a name on this system", "rename the file"))
    }
}

fn without_last_words(mut value: &[u8], count: usize) -> &[u8] {
    for _ in 0..count {
        value = value.trim_ascii_end();
        let word = value.iter().rev().take_while(|b| !b.is_ascii_whitespace()).count();
        value = &value[..value.len() - word];
    }
    value.trim_ascii()
}

impl NumberedNames {
    /// None where the name has no place for a number.
    fn of(name: &[u8], [first, last, step]: [i64; 3]) -> Option<Self> {
        let mut pattern = Self { before: Vec::new(), after: Vec::new(), zeros: false, width: 0, first, last, step };
        let mut found = false;
        let mut rest = name;
        while let [byte, tail @ ..] = rest {
            rest = tail;
            if *byte == b'%' && tail.first() == Some(&b'%') {
                rest = &tail[1..];
            } else if *byte == b'%' {
                if found {
                    return None;
                }
                let digits = tail.iter().take_while(|b| b.is_ascii_digit()).count();
                let width = std::str::from_utf8(&tail[..digits]).ok()?;
                pattern.zeros = width.starts_with('0');
                pattern.width = if width.is_empty() { 0 } else { width.parse().ok().filter(|w| *w <= WIDEST)? };
                rest = match &tail[digits..] {
                    [b'd' | b'i' | b'u', rest @ ..] => rest,
                    _ => return None,
                };
                found = true;
                continue;
            }
            let side = if found { &mut pattern.after } else { &mut pattern.before };
            side.push(*byte);
        }
        found.then_some(pattern)
    }

    fn name(&self, n: i128) -> Vec<u8> {
        let width = self.width;
        let number = if self.zeros { format!("{n:0width$}") } else { format!("{n:width$}") };
        [&self.before, number.as_bytes(), &self.after].concat()
    }
}

impl Several {
    pub fn count(&self) -> u64 {
        match self {
            Self::List(names) => names.len() as u64,
            Self::NumberedNames(p) => (p.last.abs_diff(p.first) / p.step.unsigned_abs()).saturating_add(1),
        }
    }

    /// The name of number `i`, made when it is asked for: a header may promise very many. None where it is no name on this
    /// system.
    pub fn name(&self, i: u64) -> Option<PathBuf> {
        match self {
            Self::List(names) => names.get(usize::try_from(i).ok()?).cloned(),
            Self::NumberedNames(p) => {
                // Between the ends, and yet i * step may be beyond them.
                let n = i128::from(p.first) + i128::from(i) * i128::from(p.step);
                file_name::name(p.name(n)).ok().map(PathBuf::from)
            }
        }
    }
}
