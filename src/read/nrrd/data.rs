//! The data of an NRRD file: what follows a header, or the whole of another file.

use std::io::{self, BufRead, BufReader, ErrorKind, Read};
use std::path::Path;

use super::header::{Encoding, Header};
use crate::error::{Error, Result};
use crate::read::packed::{self, Members, Packing};
use crate::read::raw::{self, ByteSkip};
use crate::read::source::{ByteSource, MOST_COUNTED};
use crate::read::voxels::{self, Fault, TextFault};
use crate::scene::volume::Voxels;

/// The data of one file: a stream that stands behind the header.
pub struct Data<'a> {
    /// The file the data lies in.
    pub path: &'a Path,
    pub header: &'a Header,
    pub source: &'a mut ByteSource,
    /// Voxels the file holds.
    pub count: usize,
    /// Bytes of these voxels, unpacked.
    pub bytes: u64,
}

/// Bytes that a number takes as text: more are read of a stream of unknown length for nothing.
const TEXT_OF_NUMBER: u64 = 64;
const HEX_DIGITS_OF_BYTE: u64 = 2;

impl Data<'_> {
    /// Reads the voxels of this file behind those of others; gives in words what follows them, if anything does.
    pub fn append(mut self, voxels: &mut Voxels) -> Result<Option<String>> {
        self.skip_lines()?;
        if self.header.byte_skip == ByteSkip::ToTail && self.header.encoding != Encoding::Raw {
            let problem = format!("has `byte skip: -1` with {}", self.header.encoding.name());
            return self.bad(problem, "use it with `encoding: raw` only");
        }
        match self.header.encoding {
            Encoding::Raw => self.raw(voxels),
            Encoding::Packed(packing) => self.packed(voxels, packing),
            Encoding::Ascii => self.ascii(voxels),
            Encoding::Hex => self.hex(voxels),
        }
    }

    fn raw(mut self, voxels: &mut Voxels) -> Result<Option<String>> {
        match (self.header.byte_skip, self.source.left()) {
            (ByteSkip::Bytes(skip), _) => self.skip_bytes(skip)?,
            (ByteSkip::ToTail, Some(left)) => self.skip_bytes(left.saturating_sub(self.bytes))?,
            (ByteSkip::ToTail, None) => {
                let problem = "has `byte skip: -1` in a packed file".to_owned();
                return self.bad(problem, "unpack the file, or say how many bytes are skipped");
            }
        }
        if let Some(left) = self.source.left().filter(|left| *left < self.bytes) {
            let problem = format!("holds {left} bytes of data where {} ask for {}", self.promise(), self.bytes);
            return self.bad(problem, "correct the header or complete the data");
        }
        voxels::binary(self.source, voxels, self.count, self.header.big_endian).or_else(|fault| self.fault(fault))?;
        let behind = self.source.rest().or_else(|e| self.fault(Fault::Read(e)))?;
        Ok(counted(behind, "behind its data"))
    }

    /// `line skip` counts lines of the file, `byte skip` bytes of what it unpacks to.
    fn packed(self, voxels: &mut Voxels, packing: Packing) -> Result<Option<String>> {
        let ByteSkip::Bytes(skip) = self.header.byte_skip else { return Ok(None) };
        let held = self.source.left().unwrap_or(self.source.most);
        let name = packing.name();
        if self.bytes.saturating_add(skip) > held.saturating_mul(packing.ratio()) {
            let problem = format!(
                "holds {held} bytes of {name} data, which cannot give the {} that {} ask for",
                self.bytes,
                self.promise()
            );
            return self.bad(problem, "correct the header or complete the data");
        }
        let left = self.source.left();
        let mut members = Members::new(packing, &mut *self.source);
        let read = packed::count(&mut members, skip)
            .map_err(Fault::Read)
            .and_then(|_| voxels::binary(&mut members, voxels, self.count, self.header.big_endian))
            .and_then(|()| packed::count(&mut members, MOST_COUNTED).map_err(Fault::Read));
        let unpacked = read.and_then(|unpacked| match unpacked {
            MOST_COUNTED => Ok((unpacked, 0)),
            _ => members.behind(left, MOST_COUNTED).map(|behind| (unpacked, behind)).map_err(Fault::Read),
        });
        let (unpacked, behind) = unpacked.or_else(|fault| self.fault(fault))?;
        let parts =
            [counted(unpacked, "behind its data, unpacked"), counted(behind, &format!("behind its {name} stream"))];
        let parts: Vec<_> = parts.into_iter().flatten().collect();
        Ok((!parts.is_empty()).then(|| parts.join(" and ")))
    }

    fn ascii(mut self, voxels: &mut Voxels) -> Result<Option<String>> {
        self.skip_stated()?;
        let most = (self.count as u64).saturating_mul(TEXT_OF_NUMBER).saturating_add(MOST_COUNTED);
        let most = self.source.left().unwrap_or(most);
        let mut text = Vec::new();
        let read = self.source.by_ref().take(most).read_to_end(&mut text);
        read.map_err(|e| crate::read::unreadable(self.path, &e))?;
        match voxels::text(&String::from_utf8_lossy(&text), voxels, self.count) {
            Ok(more) => Ok((more > 0).then(|| format!("{more} more numbers than its data has"))),
            Err(TextFault::Memory) => self.fault(Fault::Memory),
            Err(TextFault::Count(found)) => self.bad(
                format!("holds {found} numbers where {} ask for {}", self.promise(), self.count),
                "correct the header or complete the data",
            ),
            Err(TextFault::Number(i, word)) => self.bad(
                format!(
                    "has `{word}` for number {i}, which is not a number of type {}",
                    raw::type_name(self.header.voxel_type)
                ),
                "correct it or the type",
            ),
        }
    }

    fn hex(mut self, voxels: &mut Voxels) -> Result<Option<String>> {
        self.skip_stated()?;
        let mut digits = Hex { stream: &mut *self.source, at: 0 };
        let read = voxels::binary(&mut digits, voxels, self.count, self.header.big_endian);
        let read = read.and_then(|()| digits.rest().map_err(Fault::Read));
        let behind = read.or_else(|fault| self.fault(fault))?;
        Ok(counted(behind, "behind its data"))
    }

    fn skip_lines(&mut self) -> Result<()> {
        for line in 0..self.header.line_skip {
            let skipped = self.source.skip_until(b'\n').map_err(|e| crate::read::unreadable(self.path, &e))?;
            if skipped == 0 {
                let problem = format!("has {line} lines of the {} to be skipped", self.header.line_skip);
                return self.bad(problem, "correct `line skip`");
            }
        }
        Ok(())
    }

    fn skip_stated(&mut self) -> Result<()> {
        match self.header.byte_skip {
            ByteSkip::Bytes(skip) => self.skip_bytes(skip),
            ByteSkip::ToTail => Ok(()),
        }
    }

    fn skip_bytes(&mut self, skip: u64) -> Result<()> {
        let skipped = self.source.skip(skip).map_err(|e| crate::read::unreadable(self.path, &e))?;
        if skipped < skip {
            let problem = format!("has {skipped} bytes of the {skip} to be skipped");
            return self.bad(problem, "correct `byte skip`");
        }
        Ok(())
    }

    fn fault<T>(&self, fault: Fault) -> Result<T> {
        let name = self.header.encoding.name();
        let (problem, remedy) = match fault {
            Fault::Short { bytes: n } => (format!("ends after {n} bytes of data"), "complete the data"),
            Fault::Memory => ("needs more memory than is available".to_owned(), "use a smaller volume"),
            Fault::Read(e) if e.kind() == ErrorKind::UnexpectedEof => {
                (format!("ends within its {name} data"), "complete the data")
            }
            Fault::Read(e) => (format!("holds {name} data that cannot be read ({e})"), "make or fetch the file again"),
        };
        self.bad(format!("{problem}, where {} ask for {} bytes", self.promise(), self.bytes), remedy)
    }

    /// `sizes 64 64 64 of type u8`
    fn promise(&self) -> String {
        let sizes: Vec<String> = self.header.axes.iter().map(|axis| axis.size.to_string()).collect();
        let share =
            if self.header.axes.iter().map(|a| a.size).product::<usize>() == self.count { "" } else { "its share of " };
        format!("{share}sizes {} of type {}", sizes.join(" "), raw::type_name(self.header.voxel_type))
    }

    fn bad<T>(&self, problem: String, remedy: &str) -> Result<T> {
        Err(Error::input(self.path.display(), problem, remedy))
    }
}

fn counted(bytes: u64, what: &str) -> Option<String> {
    let more = if bytes == MOST_COUNTED { "at least " } else { "" };
    let bytes = if bytes == 1 { "1 byte".to_owned() } else { format!("{more}{bytes} bytes") };
    (bytes != "0 bytes").then(|| format!("{bytes} {what}"))
}

/// The bytes that pairs of hexadecimal digits stand for; white space may stand anywhere.
struct Hex<'a> {
    stream: &'a mut ByteSource,
    /// Digits read.
    at: u64,
}

impl Hex<'_> {
    fn digit(&mut self) -> io::Result<Option<u8>> {
        loop {
            let Some(&byte) = self.stream.fill_buf()?.first() else { return Ok(None) };
            self.stream.consume(1);
            if byte.is_ascii_whitespace() {
                continue;
            }
            self.at += 1;
            let Some(digit) = char::from(byte).to_digit(16) else {
                let what = format!("`{}`, number {}, is not a hexadecimal digit", byte.escape_ascii(), self.at - 1);
                return Err(io::Error::new(ErrorKind::InvalidData, what));
            };
            return Ok(Some(digit as u8));
        }
    }

    /// Bytes behind those that were read, whether they are digits or not.
    fn rest(self) -> io::Result<u64> {
        let mut found = 0u64;
        for byte in BufReader::new(self.stream).bytes().take(MOST_COUNTED as usize) {
            found += u64::from(!byte?.is_ascii_whitespace());
        }
        Ok(found.div_ceil(HEX_DIGITS_OF_BYTE))
    }
}

impl Read for Hex<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        for (i, byte) in buffer.iter_mut().enumerate() {
            match (self.digit()?, self.digit()?) {
                (Some(high), Some(low)) => *byte = high << 4 | low,
                // A digit without its twin is no byte.
                _ => return Ok(i),
            }
        }
        Ok(buffer.len())
    }
}
