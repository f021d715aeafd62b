//! The header of a PLY file: how its numbers are written, and which elements follow.

use std::path::Path;

use crate::error::{Error, Result};
use crate::read::values::{Encoding, NumberType};

pub struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Lines of the header.
    pub lines: usize,
}

/// A table of the file.
pub struct Element {
    pub name: String,
    /// Rows that the header promises.
    pub count: u64,
    pub properties: Vec<Property>,
}

/// A column of a table.
pub struct Property {
    pub name: String,
    pub number: NumberType,
    /// The type of the length, where an entry is a list.
    pub length: Option<NumberType>,
}

impl Element {
    /// The fewest bytes that a row takes: its lists are empty, its texts a digit and a space each.
    pub fn least_bytes(&self, encoding: Encoding) -> u64 {
        let bytes = |property: &Property| match encoding {
            Encoding::Ascii => "0 ".len(),
            Encoding::Little | Encoding::Big => property.length.unwrap_or(property.number).bytes(),
        };
        self.properties.iter().map(|property| bytes(property) as u64).sum()
    }
}

/// The header, and the bytes behind it.
///
/// # Errors
/// When it has no end, or a line that says nothing known.
pub fn read<'a>(path: &Path, bytes: &'a [u8]) -> Result<(Header, &'a [u8])> {
    let bad = |problem: String, remedy: &str| Error::input(path.display(), problem, remedy);
    let behind = bytes.strip_prefix(b"ply").ok_or_else(|| {
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min("ply".len())]);
        bad(format!("begins with {start:?}, not with `ply`"), "give a PLY file")
    })?;
    let end: &[u8] = match behind {
        [b'\r', b'\n', ..] => b"\r\n",
        [b'\r', ..] => b"\r",
        _ => b"\n",
    };
    let (mut rest, mut encoding, mut elements) = (bytes, None, Vec::<Element>::new());
    for number in 1.. {
        let Some(length) = rest.windows(end.len()).position(|window| window == end) else { break };
        let line = String::from_utf8_lossy(&rest[..length]);
        rest = &rest[length + end.len()..];
        let words: Vec<_> = line.split_whitespace().collect();
        let unknown = || {
            let remedy = "write `format`, `element NAME COUNT`, `property TYPE NAME` or `end_header`";
            bad(format!("has `{}` in line {number} of its header", words.join(" ")), remedy)
        };
        match (words.as_slice(), elements.last_mut()) {
            (["ply"], _) if number == 1 => {}
            ([] | ["comment" | "obj_info", ..], _) => {}
            (["format", name, _version], _) => encoding = Some(Encoding::of(name).ok_or_else(unknown)?),
            (["element", name, count], _) => {
                let count = count.parse().map_err(|_| unknown())?;
                elements.push(Element { name: (*name).to_owned(), count, properties: Vec::new() });
            }
            (["property", "list", length, number, name], Some(element)) => {
                let length = Some(NumberType::of(length).ok_or_else(unknown)?);
                let number = NumberType::of(number).ok_or_else(unknown)?;
                element.properties.push(Property { name: (*name).to_owned(), number, length });
            }
            (["property", number, name], Some(element)) => {
                let number = NumberType::of(number).ok_or_else(unknown)?;
                element.properties.push(Property { name: (*name).to_owned(), number, length: None });
            }
            (["end_header"], _) => {
                let missing = || bad("has no `format` in its header".into(), "say `format ascii 1.0` or what it is");
                return Ok((Header { encoding: encoding.ok_or_else(missing)?, elements, lines: number }, rest));
            }
            _ => return Err(unknown()),
        }
    }
    Err(bad(format!("ends after {} bytes without `end_header`", bytes.len()), "complete the file"))
}
