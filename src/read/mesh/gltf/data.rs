//! The numbers of a glTF document: in the file itself, in its text, or in files beside it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::json::{Accessor, Document};
use crate::error::{Error, Result};

/// Types of numbers, as glTF numbers them.
const U8: u32 = 5121;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

/// What the numbers are read from.
pub struct Data<'a> {
    path: &'a Path,
    document: &'a Document,
    /// The bytes behind the text of a binary file.
    attached: Option<&'a [u8]>,
    /// Bytes of the file and of those beside it that were read.
    pub held: usize,
    /// What was asked for so far, by its uri.
    named: BTreeMap<&'a str, Vec<u8>>,
}

impl<'a> Data<'a> {
    pub fn new(path: &'a Path, document: &'a Document, attached: Option<&'a [u8]>, held: usize) -> Self {
        Self { path, document, attached, held, named: BTreeMap::new() }
    }

    /// An error of the document.
    pub fn bad(&self, problem: impl Into<String>, remedy: &str) -> Error {
        Error::input(self.path.display(), problem.into(), remedy)
    }

    /// An entry of a list of the document.
    ///
    /// # Errors
    /// When the list is shorter.
    pub fn entry<T>(&self, list: &'a [T], name: &str, index: usize) -> Result<&'a T> {
        list.get(index).ok_or_else(|| {
            self.bad(format!("asks for {name}[{index}], where there are {}", list.len()), "correct the index")
        })
    }

    /// Places in space.
    pub fn places(&mut self, index: usize) -> Result<Vec<[f64; 3]>> {
        let accessor = self.entry(&self.document.accessors, "accessors", index)?;
        if accessor.component_type != F32 || accessor.shape != "VEC3" {
            return Err(self.wrong(accessor, index, "VEC3 of 5126 (three floats)"));
        }
        let number = |bytes: &[u8], axis: usize| {
            let bytes = &bytes[axis * size_of::<f32>()..][..size_of::<f32>()];
            f64::from(f32::from_le_bytes(bytes.try_into().unwrap_or_default()))
        };
        self.items(accessor, index, 3 * size_of::<f32>(), |bytes| [0, 1, 2].map(|axis| number(bytes, axis)))
    }

    /// Places among corners.
    pub fn indices(&mut self, index: usize) -> Result<Vec<u32>> {
        let accessor = self.entry(&self.document.accessors, "accessors", index)?;
        let bytes = match (accessor.component_type, accessor.shape.as_str()) {
            (U8, "SCALAR") => size_of::<u8>(),
            (U16, "SCALAR") => size_of::<u16>(),
            (U32, "SCALAR") => size_of::<u32>(),
            _ => return Err(self.wrong(accessor, index, "SCALAR of 5121, 5123 or 5125 (integers from 0)")),
        };
        self.items(accessor, index, bytes, |bytes| bytes.iter().rev().fold(0, |n, b| n << 8 | u32::from(*b)))
    }

    fn wrong(&self, accessor: &Accessor, index: usize, wanted: &str) -> Error {
        let Accessor { shape, component_type, .. } = accessor;
        self.bad(format!("has {shape:?} of {component_type} in accessors[{index}]"), &format!("give {wanted}"))
    }

    /// The entries of an accessor, of so many bytes each.
    fn items<T>(
        &mut self,
        accessor: &Accessor,
        index: usize,
        bytes: usize,
        item: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>> {
        let (Some(view_index), None) = (accessor.buffer_view, &accessor.sparse) else {
            let problem = format!("has accessors[{index}] sparse or without a buffer view, which is not read");
            return Err(self.bad(problem, "write its entries one after the other"));
        };
        let view = self.entry(&self.document.buffer_views, "bufferViews", view_index)?;
        let stride = view.byte_stride.filter(|stride| *stride > 0).unwrap_or(bytes);
        if stride < bytes {
            let problem = format!("has a byteStride of {stride} in bufferViews[{view_index}]");
            return Err(self.bad(problem, &format!("give at least the {bytes} bytes of an entry")));
        }
        let asked = match accessor.count.checked_sub(1) {
            Some(before) => before as u128 * stride as u128 + bytes as u128,
            None => 0,
        };
        let asked = accessor.byte_offset as u128 + asked;
        if asked > view.byte_length as u128 {
            let (count, held) = (accessor.count, view.byte_length);
            let problem = format!(
                "promises {count} entries in accessors[{index}], {asked} bytes, where bufferViews[{view_index}] has {held}"
            );
            return Err(self.bad(problem, "correct the lengths, or complete the file"));
        }
        let buffer = self.buffer(view.buffer)?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let Some(held) = end.and_then(|end| buffer.get(view.byte_offset..end)) else {
            let (length, offset, held) = (view.byte_length, view.byte_offset, buffer.len());
            let problem = format!(
                "promises {length} bytes from {offset} on in bufferViews[{view_index}], where its buffer holds {held}"
            );
            return Err(self.bad(problem, "correct the lengths, or complete the file"));
        };
        let held = held.get(accessor.byte_offset..).unwrap_or_default();
        Ok(held.chunks(stride).take(accessor.count).map(|chunk| item(&chunk[..bytes])).collect())
    }

    /// The bytes of a buffer.
    fn buffer(&mut self, index: usize) -> Result<&[u8]> {
        let buffer = self.entry(&self.document.buffers, "buffers", index)?;
        let bytes = match (buffer.uri.as_deref(), self.attached) {
            (None, Some(attached)) if index == 0 => attached,
            (None, _) => return Err(self.bad(format!("has no bytes of buffers[{index}]"), "give it a uri")),
            (Some(uri), _) => {
                if !self.named.contains_key(uri) {
                    let bytes = match uri.strip_prefix("data:") {
                        Some(data) => self.decoded(index, data)?,
                        None => self.beside(index, uri)?,
                    };
                    self.held += bytes.len();
                    self.named.insert(uri, bytes);
                }
                &self.named[uri]
            }
        };
        if bytes.len() < buffer.byte_length {
            let (asked, held) = (buffer.byte_length, bytes.len());
            let problem = format!("promises {asked} bytes in buffers[{index}], which holds {held}");
            return Err(self.bad(problem, "correct the length, or complete the data"));
        }
        Ok(bytes)
    }

    /// The bytes in a text of the document.
    fn decoded(&self, index: usize, data: &str) -> Result<Vec<u8>> {
        let Some((_, data)) = data.split_once(";base64,") else {
            return Err(self.bad(format!("has a data: uri without `;base64,` in buffers[{index}]"), "write base64"));
        };
        STANDARD.decode(data).map_err(|e| {
            self.bad(format!("has in buffers[{index}] what is not base64 ({e})"), "correct or complete the text")
        })
    }

    /// The bytes of a file beside the document.
    fn beside(&self, index: usize, uri: &str) -> Result<Vec<u8>> {
        let name = unescaped(uri).filter(|name| !name.contains("://")).ok_or_else(|| {
            self.bad(format!("has the uri {uri:?} in buffers[{index}]"), "name a file beside this one")
        })?;
        let path: PathBuf = self.path.parent().unwrap_or(Path::new("")).join(name);
        crate::read::bytes(&path).map_err(|error| {
            let input = format!("{}: buffers[{index}] {}", self.path.display(), error.input);
            Error::input(input, error.problem, error.remedy)
        })
    }
}

/// A name in which bytes may be written as `%20`.
fn unescaped(uri: &str) -> Option<String> {
    let (mut bytes, mut rest) = (Vec::new(), uri.as_bytes());
    while let [first, behind @ ..] = rest {
        let digits = behind.get(..2).filter(|_| *first == b'%');
        let byte = digits.and_then(|digits| u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok());
        bytes.push(byte.unwrap_or(*first));
        rest = if byte.is_some() { &behind[2..] } else { behind };
    }
    String::from_utf8(bytes).ok()
}
