//! What a binary glTF file is made of: a text, and the bytes that it speaks of.

use std::path::Path;

use crate::error::{Error, Result};

pub const MAGIC: &[u8] = b"glTF";

/// The one version that is read.
const VERSION: u32 = 2;

/// Bytes of the magic, the version and the length.
const HEAD: usize = 12;

/// Bytes of a chunk's length and type.
const CHUNK_HEAD: usize = 8;

const TEXT: &[u8] = b"JSON";
const BYTES: &[u8] = b"BIN\0";

/// The chunks of a file.
pub struct Container<'a> {
    pub text: &'a [u8],
    pub attached: Option<&'a [u8]>,
    /// Bytes behind what the file says is its end.
    pub rest: usize,
}

/// # Errors
/// When the file is shorter than it says, of another version, or does not begin with a text.
pub fn open<'a>(path: &Path, bytes: &'a [u8]) -> Result<Container<'a>> {
    let bad = |problem: String, remedy: &str| Error::input(path.display(), problem, remedy);
    let short = || bad(format!("ends after {} bytes, in the head of glTF", bytes.len()), "complete the file");
    let number = |bytes: &[u8], at: usize| {
        let bytes = bytes.get(at..)?.first_chunk()?;
        Some(u32::from_le_bytes(*bytes))
    };
    let version = number(bytes, MAGIC.len()).ok_or_else(short)?;
    let length = number(bytes, HEAD - size_of::<u32>()).ok_or_else(short)? as usize;
    if version != VERSION {
        return Err(bad(format!("is of version {version} of binary glTF"), "convert it to version 2"));
    }
    let Some((whole, rest)) = bytes.split_at_checked(length) else {
        return Err(bad(format!("promises {length} bytes, where it holds {}", bytes.len()), "complete the file"));
    };
    let (mut text, mut attached) = (None, None);
    let mut chunks = whole.get(HEAD..).unwrap_or_default();
    while !chunks.is_empty() {
        let (head, behind) = chunks.split_at_checked(CHUNK_HEAD).ok_or_else(short)?;
        let length = number(head, 0).ok_or_else(short)? as usize;
        let Some((chunk, next)) = behind.split_at_checked(length) else {
            let problem = format!("promises a chunk of {length} bytes, where {} are left", behind.len());
            return Err(bad(problem, "complete the file"));
        };
        let slot = match &head[CHUNK_HEAD - TEXT.len()..] {
            TEXT => Some(&mut text),
            BYTES => Some(&mut attached),
            _ => None,
        };
        if let Some(slot) = slot {
            slot.get_or_insert(chunk);
        }
        chunks = next;
    }
    let text = text.ok_or_else(|| bad("has no chunk of JSON".into(), "give a binary glTF file"))?;
    Ok(Container { text, attached, rest: rest.len() })
}
