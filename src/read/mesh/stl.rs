//! Triangles of stereolithography, as text and as bytes.
//!
//! Source: "The StL Format" (fabbers.com/tech/STL_Format). The normals are not read: they follow from the corners, and
//! many files have them wrong.

use std::path::Path;

use super::parts::Parts;
use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// Bytes that say nothing.
const HEAD: usize = 80;

/// Bytes in front of the triangles: the head and their number.
const FRONT: usize = HEAD + size_of::<u32>();

/// Bytes of a normal or a corner.
const PLACE: usize = 3 * size_of::<f32>();

/// Bytes of a triangle: its normal, its corners and two bytes of no meaning.
const TRIANGLE: usize = 4 * PLACE + size_of::<u16>();

/// Whether a file is as long as its number of triangles asks for, or begins and goes on like a text of triangles.
pub fn recognises(bytes: &[u8]) -> bool {
    promised(bytes).is_some_and(|count| count > 0 && asked(count) == bytes.len() as u64) || is_text(bytes)
}

/// # Errors
/// When the file does not hold what it promises.
pub fn read(path: &Path, bytes: &[u8]) -> Result<Mesh> {
    let is_bytes = promised(bytes).is_some_and(|count| asked(count) == bytes.len() as u64);
    // A text that ends early may have no facet yet.
    if !is_bytes && (is_text(bytes) || bytes.starts_with(b"solid") && !bytes.contains(&0)) {
        return Text { path, bytes, at: 0, line: 1 }.read();
    }
    binary(path, bytes)
}

/// The number of triangles, where it is one of bytes.
fn promised(bytes: &[u8]) -> Option<u32> {
    bytes.get(HEAD..FRONT)?.try_into().ok().map(u32::from_le_bytes)
}

/// Bytes of a file of so many triangles.
fn asked(count: u32) -> u64 {
    FRONT as u64 + u64::from(count) * TRIANGLE as u64
}

fn is_text(bytes: &[u8]) -> bool {
    let bytes = bytes.trim_ascii_start();
    let begins = bytes.get(.."solid".len()).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    begins && bytes.windows("facet".len()).any(|word| word.eq_ignore_ascii_case(b"facet"))
}

fn binary(path: &Path, bytes: &[u8]) -> Result<Mesh> {
    let held = bytes.len();
    let Some(count) = promised(bytes) else {
        let problem = format!("holds {held} bytes, where STL begins with {FRONT}");
        return Err(Error::input(path.display(), problem, "complete the file"));
    };
    let asked = asked(count);
    if asked > held as u64 {
        let problem = format!("promises {count} triangles, {asked} bytes, where it holds {held}");
        return Err(Error::input(path.display(), problem, "complete the file"));
    }
    let mut parts = Parts::new(path);
    let (triangles, rest) = bytes[FRONT..].split_at(count as usize * TRIANGLE);
    for triangle in triangles.chunks_exact(TRIANGLE) {
        let first = parts.corners() as u32;
        for corner in triangle[PLACE..].chunks_exact(PLACE) {
            let (numbers, _) = corner.as_chunks();
            parts.corner([0, 1, 2].map(|axis| f64::from(f32::from_le_bytes(numbers[axis]))))?;
        }
        parts.polygon(&[first, first + 1, first + 2]);
    }
    parts.warn_of_rest(rest.len());
    parts.finish()
}

/// The words of a text that are still to be read.
struct Text<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl Text<'_> {
    /// Reads one solid after the other.
    fn read(mut self) -> Result<Mesh> {
        let mut parts = Parts::new(self.path);
        self.expect("solid")?;
        self.end_line();
        loop {
            match self.word().to_ascii_lowercase().as_str() {
                "facet" => self.facet(&mut parts)?,
                "endsolid" => {
                    self.end_line();
                    let (at, line) = (self.at, self.line);
                    if !self.word().eq_ignore_ascii_case("solid") {
                        (self.at, self.line) = (at, line);
                        break;
                    }
                    self.end_line();
                }
                other => return Err(self.bad(other, "facet or endsolid")),
            }
        }
        parts.warn_of_rest(self.bytes[self.at..].trim_ascii().len());
        parts.finish()
    }

    /// Reads what follows the word `facet`.
    fn facet(&mut self, parts: &mut Parts) -> Result<()> {
        self.expect("normal")?;
        for _axis in 0..3 {
            // It may be no number at all.
            self.word();
        }
        self.expect("outer")?;
        self.expect("loop")?;
        let mut corners = Vec::new();
        loop {
            match self.word().to_ascii_lowercase().as_str() {
                "vertex" => {
                    let place = [self.number()?, self.number()?, self.number()?];
                    corners.push(parts.corners() as u32);
                    parts.corner(place)?;
                }
                "endloop" => break,
                other => return Err(self.bad(other, "vertex or endloop")),
            }
        }
        parts.polygon(&corners);
        self.expect("endfacet")
    }

    fn expect(&mut self, wanted: &str) -> Result<()> {
        let word = self.word();
        if word.eq_ignore_ascii_case(wanted) { Ok(()) } else { Err(self.bad(&word, wanted)) }
    }

    fn number(&mut self) -> Result<f64> {
        let word = self.word();
        word.parse().map_err(|_| self.bad(&word, "a coordinate"))
    }

    fn bad(&self, word: &str, wanted: &str) -> Error {
        let problem = if word.is_empty() {
            format!("ends in line {}, where {wanted} is asked for", self.line)
        } else {
            format!("has `{word}` in line {}, where {wanted} is asked for", self.line)
        };
        Error::input(self.path.display(), problem, "complete or correct the file")
    }

    /// The next word; nothing at the end.
    fn word(&mut self) -> String {
        let rest = &self.bytes[self.at..];
        let begin = rest.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(rest.len());
        let (space, rest) = rest.split_at(begin);
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.line += space.iter().filter(|b| **b == b'\n').count();
        self.at += begin + length;
        String::from_utf8_lossy(&rest[..length]).into_owned()
    }

    /// Leaves out what stands in this line.
    fn end_line(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
    }
}
