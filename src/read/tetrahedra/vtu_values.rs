//! The numbers of an array of an XML file of VTK: as text, or as bytes in base64 or bare, packed by zlib or not.

use std::io::Read;
use std::path::Path;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use roxmltree::Node;

use crate::error::{Error, Result};
use crate::read::packed::Packing;
use crate::read::values::{Encoding, NumberType, Values};
use crate::scene::tetrahedra::MOST_CELLS;

/// Corners of all cells at the most: hexahedra have eight.
const MOST_CORNERS: usize = 8 * MOST_CELLS;

/// How the bytes of a file are to be taken.
pub struct Blocks<'a> {
    path: &'a Path,
    encoding: Encoding,
    /// Of the sizes in front of bytes.
    header: NumberType,
    packed: bool,
    /// What stands behind the text from its mark on, and whether that is base64.
    appended: Option<(&'a [u8], bool)>,
}

impl<'a> Blocks<'a> {
    /// As the root of a file says; `appended`: what stands behind the text.
    ///
    /// # Errors
    /// When bytes are packed in a way that is not read.
    pub fn new(path: &'a Path, root: Node, appended: &'a [u8]) -> Result<Self> {
        let packed = match root.attribute("compressor") {
            None => false,
            Some("vtkZLibDataCompressor") => true,
            Some(other) => {
                let problem = format!("is packed by `{}`", other.escape_debug());
                return Err(Error::input(path.display(), problem, "write it with zlib, or without packing"));
            }
        };
        let tag = appended.iter().position(|b| *b == b'>').map(|end| appended.split_at(end + 1));
        let appended = tag.map(|(tag, rest)| {
            let mark = rest.iter().position(|b| *b == b'_').map_or(rest.len(), |at| at + 1);
            (&rest[mark..], String::from_utf8_lossy(tag).contains("base64"))
        });
        let encoding = if root.attribute("byte_order") == Some("BigEndian") { Encoding::Big } else { Encoding::Little };
        let header = if root.attribute("header_type") == Some("UInt64") { NumberType::U64 } else { NumberType::U32 };
        Ok(Self { path, encoding, header, packed, appended })
    }

    fn bad<T>(&self, array: Node, problem: impl std::fmt::Display) -> Result<T> {
        let name = array.attribute("Name").unwrap_or("Points").escape_debug().to_string();
        let problem = format!("has an array `{name}` {problem}");
        Err(Error::input(self.path.display(), problem, "correct the file, or write it anew with VTK"))
    }

    /// All numbers of an array, which are so many, where that is known.
    ///
    /// # Errors
    /// When its type or form is none, its bytes are not what they say, or more than can be.
    pub fn values(&self, array: Node, count: Option<usize>) -> Result<Vec<f64>> {
        let word = array.attribute("type").unwrap_or_default();
        let number = match word {
            "Int8" => NumberType::I8,
            "UInt8" => NumberType::U8,
            "Int16" => NumberType::I16,
            "UInt16" => NumberType::U16,
            "Int32" => NumberType::I32,
            "UInt32" => NumberType::U32,
            "Int64" => NumberType::I64,
            "UInt64" => NumberType::U64,
            "Float32" => NumberType::F32,
            "Float64" => NumberType::F64,
            _ => return self.bad(array, format!("of the type `{}`", word.escape_debug())),
        };
        let text = array.text().unwrap_or_default().trim();
        let most = count.unwrap_or(MOST_CORNERS).saturating_mul(number.bytes());
        let bytes = match array.attribute("format").unwrap_or("ascii") {
            "ascii" => {
                let words = text.split_ascii_whitespace().take(count.unwrap_or(MOST_CORNERS).saturating_add(1));
                let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
                return numbers.map_or_else(|| self.bad(array, "with a word that is not a number"), Ok);
            }
            "binary" => self.encoded(array, text.as_bytes(), most)?,
            "appended" => {
                let offset = array.attribute("offset").and_then(|word| word.parse::<usize>().ok());
                let Some(((data, base64), offset)) = self.appended.zip(offset) else {
                    return self.bad(array, "behind the text, where there is none, or without an offset");
                };
                let Some(data) = data.get(offset..) else {
                    return self.bad(array, format!("from byte {offset} on behind the text, which has {}", data.len()));
                };
                if base64 { self.encoded(array, data, most)? } else { self.bare(array, data, most)? }
            }
            other => return self.bad(array, format!("in the form `{}`", other.escape_debug())),
        };
        if bytes.len() > most {
            return self.bad(array, format!("of {} bytes, and at most {most} are asked for", bytes.len()));
        }
        let mut values = Values::new(self.encoding, &bytes, 0);
        let count = bytes.len() / number.bytes();
        let mut numbers = Vec::new();
        if numbers.try_reserve_exact(count).is_err() {
            return self.bad(array, format!("of {count} numbers, for which there is not enough memory"));
        }
        while let Ok(value) = values.next(number) {
            numbers.push(value);
        }
        Ok(numbers)
    }

    /// Sizes in front of bytes, which there have to be.
    fn sizes(&self, array: Node, bytes: &[u8], count: usize) -> Result<Vec<usize>> {
        let mut values = Values::new(self.encoding, bytes, 0);
        let size = |_| values.next(self.header).ok().map(|size| size as usize);
        let sizes: Option<Vec<usize>> = (0..count).map(size).collect();
        sizes.map_or_else(|| self.bad(array, "that ends in its sizes"), Ok)
    }

    /// Bytes behind their sizes, at most so many.
    fn bare(&self, array: Node, data: &[u8], most: usize) -> Result<Vec<u8>> {
        let each = self.header.bytes();
        if !self.packed {
            let [size] = self.sizes(array, data, 1)?[..] else { return self.bad(array, "without a size") };
            return match data.get(each..).and_then(|data| data.get(..size)) {
                Some(data) => Ok(data.to_vec()),
                None => self.bad(array, format!("of {size} bytes, where {} are left", data.len().saturating_sub(each))),
            };
        }
        let blocks = self.sizes(array, data, 1)?[0];
        let header = self.header_length(array, blocks, data.len())?;
        let sizes = self.sizes(array, data, header / each)?;
        self.unpacked(array, &sizes, &data[header..], most)
    }

    /// The same in base64: of packed bytes the sizes have an end of their own.
    fn encoded(&self, array: Node, text: &[u8], most: usize) -> Result<Vec<u8>> {
        let end = text.iter().position(|b| !(b.is_ascii_alphanumeric() || b"+/=".contains(b))).unwrap_or(text.len());
        let text = &text[..end];
        let each = self.header.bytes();
        let decoded = |text: &[u8]| match STANDARD.decode(text) {
            Ok(bytes) => Ok(bytes),
            Err(e) => self.bad(array, format!("that is not base64 ({e})")),
        };
        let in_text = |bytes: usize| bytes.div_ceil(3).saturating_mul(4);
        let Some(first) = text.get(..in_text(each)) else { return self.bad(array, "that ends in its sizes") };
        // Behind the size may follow data.
        let first = self.sizes(array, &lenient(first), 1)?[0];
        if !self.packed {
            let Some(text) = each.checked_add(first).and_then(|bytes| text.get(..in_text(bytes))) else {
                return self.bad(array, format!("of {first} bytes, where there are {} in base64", text.len()));
            };
            return self.bare(array, &decoded(text)?, most);
        }
        let header = self.header_length(array, first, text.len())?;
        let Some((sizes, data)) = text.split_at_checked(in_text(header)) else {
            return self.bad(array, "that ends in its sizes");
        };
        let sizes = self.sizes(array, &decoded(sizes)?, header / each)?;
        let all = sizes.iter().skip(3).try_fold(0usize, |sum, size| sum.checked_add(*size));
        let Some(data) = all.and_then(|all| data.get(..in_text(all))) else {
            return self.bad(array, "whose packed parts are longer than what is left");
        };
        self.unpacked(array, &sizes, &decoded(data)?, most)
    }

    /// Bytes of the sizes in front of so many parts.
    fn header_length(&self, array: Node, parts: usize, left: usize) -> Result<usize> {
        match parts
            .checked_add(3)
            .and_then(|sizes| sizes.checked_mul(self.header.bytes()))
            .filter(|bytes| *bytes <= left)
        {
            Some(bytes) => Ok(bytes),
            None => self.bad(array, format!("of {parts} packed parts, where {left} bytes are left")),
        }
    }

    /// Unpacks parts behind their sizes: how many, how long each is, how long the last one is where it is shorter, then packed lengths.
    fn unpacked(&self, array: Node, sizes: &[usize], mut data: &[u8], most: usize) -> Result<Vec<u8>> {
        let [_, whole, last, packed @ ..] = sizes else { return self.bad(array, "without sizes") };
        let mut bytes = Vec::new();
        for (i, length) in packed.iter().enumerate() {
            let Some((part, rest)) = data.split_at_checked(*length) else {
                return self.bad(array, "whose packed parts are longer than what is left");
            };
            let asked = if i + 1 == packed.len() && *last > 0 { *last } else { *whole };
            if asked as u64 > (*length as u64).saturating_mul(Packing::Gzip.ratio()) {
                return self.bad(array, format!("whose part {i} of {length} bytes promises {asked}"));
            }
            let before = bytes.len();
            if before.saturating_add(asked) > most {
                return self.bad(array, format!("that unpacks to more than the {most} bytes that are asked for"));
            }
            let unpacked = flate2::read::ZlibDecoder::new(part).take(asked as u64 + 1).read_to_end(&mut bytes);
            if unpacked.is_err() || bytes.len() - before != asked {
                return self.bad(array, format!("whose part {i} does not unpack to {asked} bytes"));
            }
            data = rest;
        }
        Ok(bytes)
    }
}

/// Bytes of base64, whose padding says that nothing follows or is not there.
fn lenient(text: &[u8]) -> Vec<u8> {
    let padded = text.iter().map(|b| if *b == b'=' { b'A' } else { *b }).collect::<Vec<_>>();
    STANDARD.decode(padded).unwrap_or_default()
}
