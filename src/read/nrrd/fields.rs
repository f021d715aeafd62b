//! The lines of an NRRD header: `field: description`, `key:=value` and `# comment`.

use std::collections::BTreeMap;
use std::io::{BufRead, Read};
use std::path::Path;

use crate::error::{Error, Result};
use crate::scene::builtin::nearest;

/// No header is longer than its file, nor than this: sequences keep a few lines for each of thousands of frames. Lines that
/// say nothing of the data are forgotten as they are read.
const LONGEST: u64 = 1 << 30;

/// Fields of the format, their one-word spellings brought to this one by [`SPELLINGS`].
const FIELDS: [&str; 30] = [
    "axis maxs",
    "axis mins",
    "block size",
    "byte skip",
    "centers",
    "content",
    DATA_FILE,
    "dimension",
    "encoding",
    "endian",
    "kinds",
    "labels",
    "line skip",
    "max",
    "measurement frame",
    "min",
    "number",
    "old max",
    "old min",
    "sample units",
    "sizes",
    "space",
    "space dimension",
    "space directions",
    "space origin",
    "space units",
    "spacings",
    "thicknesses",
    "type",
    "units",
];

/// Fields that say something of the data and where they lie.
const READ: [&str; 14] = [
    "axis maxs",
    "axis mins",
    "byte skip",
    "centers",
    "dimension",
    "encoding",
    "endian",
    "kinds",
    "line skip",
    "sizes",
    "space",
    "space directions",
    "spacings",
    "type",
];

const SPELLINGS: [(&str, &str); 10] = [
    ("axismaxs", "axis maxs"),
    ("axismins", "axis mins"),
    ("blocksize", "block size"),
    ("byteskip", "byte skip"),
    ("centerings", "centers"),
    ("datafile", DATA_FILE),
    ("lineskip", "line skip"),
    ("oldmax", "old max"),
    ("oldmin", "old min"),
    ("sampleunits", "sample units"),
];

const DATA_FILE: &str = "data file";

/// Characters of a wrong line or value that an error shows.
const LONGEST_SHOWN: usize = 60;

/// A header's lines without their ends, as bytes: a file name need not be UTF-8.
pub struct Lines<'a, R> {
    path: &'a Path,
    stream: &'a mut R,
    /// Bytes that may still be read.
    room: u64,
}

impl<'a, R: BufRead> Lines<'a, R> {
    /// Of a file of at most `most` bytes.
    pub fn new(path: &'a Path, stream: &'a mut R, most: u64) -> Self {
        // One more than a header may have shows that it has more.
        Self { path, stream, room: most.min(LONGEST).saturating_add(1) }
    }

    /// The next line, or as much of it as `longest` allows; none at the end of the file.
    pub fn next(&mut self, longest: u64) -> Result<Option<Vec<u8>>> {
        let mut line = Vec::new();
        let room = self.room.min(longest.saturating_add(1));
        let read = self.stream.by_ref().take(room).read_until(b'\n', &mut line);
        self.room -= read.map_err(|e| crate::read::unreadable(self.path, &e))? as u64;
        if self.room == 0 {
            let problem = format!("has a header of more than {LONGEST} bytes");
            return Err(Error::input(self.path.display(), problem, "give an NRRD file"));
        }
        if line.is_empty() {
            return Ok(None);
        }
        while line.last().is_some_and(|end| b"\r\n".contains(end)) {
            line.pop();
        }
        Ok(Some(line))
    }
}

/// The header's fields by name.
pub struct Fields<'a> {
    path: &'a Path,
    values: BTreeMap<&'static str, String>,
}

impl<'a> Fields<'a> {
    pub fn new(path: &'a Path) -> Self {
        Self { path, values: BTreeMap::new() }
    }

    /// Takes a line; gives the value of `data file`, which is bytes, not text.
    pub fn add<'l>(&mut self, line: &'l [u8]) -> Result<Option<&'l [u8]>> {
        if line.starts_with(b"#") {
            return Ok(None);
        }
        let colon = find(line, b": ").or(line.strip_suffix(b":").map(<[u8]>::len));
        let field = colon.map(|at| (&line[..at], line[at + 1..].trim_ascii()));
        let Some((known, value)) = field.and_then(|(field, value)| Some((known(field)?, value))) else {
            // The key of a key/value line may hold anything, so a line is one wherever it names no field.
            return if find(line, b":=").is_some() {
                Ok(None)
            } else {
                self.unknown(line, field.map(|(field, _)| field))
            };
        };
        // What is not asked for may be long.
        let kept = if READ.contains(&known) { String::from_utf8_lossy(value).into_owned() } else { String::new() };
        if self.values.insert(known, kept).is_some() {
            return self.bad(known, "is given twice", "remove one of them");
        }
        Ok((known == DATA_FILE).then_some(value))
    }

    fn unknown<T>(&self, line: &[u8], field: Option<&[u8]>) -> Result<T> {
        let Some(field) = field else {
            let remedy = "write `field: value`, `key:=value` or `# comment`";
            return self.bad(&shown(line), "is not a line of an NRRD header", remedy);
        };
        let field = shown(field);
        let near = nearest(&lower(field.as_bytes()), FIELDS);
        let remedy = near.map_or("remove it".to_string(), |n| format!("did you mean `{n}`?"));
        self.bad(&field, "is not a field of NRRD", &remedy)
    }

    pub fn get(&self, field: &str) -> Option<&str> {
        self.values.get(field).map(String::as_str)
    }

    pub fn required(&self, field: &str) -> Result<&str> {
        match self.get(field) {
            Some(value) => Ok(value),
            None => self.bad(field, "is missing", "complete the header"),
        }
    }

    pub fn number<T: std::str::FromStr>(&self, field: &str, text: &str) -> Result<T> {
        text.parse().or_else(|_| {
            let text = shown(text.as_bytes());
            self.bad(field, &format!("has `{text}`, which is not a number it can have"), "correct it")
        })
    }

    pub fn bad<T>(&self, field: &str, problem: &str, remedy: &str) -> Result<T> {
        Err(Error::input(format!("{}: {field}", self.path.display()), problem, remedy))
    }
}

/// The field of this name.
fn known(field: &[u8]) -> Option<&'static str> {
    let lower = lower(field);
    let name = SPELLINGS.iter().find(|(spelling, _)| *spelling == lower).map_or(lower.as_str(), |(_, name)| name);
    FIELDS.into_iter().find(|known| *known == name)
}

fn lower(field: &[u8]) -> String {
    String::from_utf8_lossy(field.trim_ascii()).to_lowercase()
}

fn shown(text: &[u8]) -> String {
    String::from_utf8_lossy(text).chars().take(LONGEST_SHOWN).collect()
}

fn find(line: &[u8], mark: &[u8]) -> Option<usize> {
    line.windows(mark.len()).position(|part| part == mark)
}
