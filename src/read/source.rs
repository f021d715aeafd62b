//! A file as a stream of bytes: as it stands, or unpacked where the whole of it is packed by gzip.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};

use super::packed::{self, Members, Packing};

/// Bytes behind the data of a stream of unknown length are counted up to this many: it may unpack to very many.
pub const MOST_COUNTED: u64 = 64 << 20;

enum Stream {
    Plain(BufReader<File>),
    Packed(Box<BufReader<Members<BufReader<File>>>>),
}

/// A file that is read from its begin to its end.
pub struct ByteSource {
    stream: Stream,
    /// Bytes that are left; none where the file is packed and nobody knows.
    left: Option<u64>,
    /// Bytes that the whole of it can hold at the most.
    pub most: u64,
    /// Bytes of the packed file.
    length: u64,
}

impl ByteSource {
    pub fn plain(file: File, length: u64) -> Self {
        Self { stream: Stream::Plain(BufReader::new(file)), left: Some(length), most: length, length }
    }

    pub fn packed(file: File, length: u64) -> Self {
        let members = Members::new(Packing::Gzip, BufReader::new(file));
        let most = length.saturating_mul(Packing::Gzip.ratio());
        Self { stream: Stream::Packed(Box::new(BufReader::new(members))), left: None, most, length }
    }

    pub fn left(&self) -> Option<u64> {
        self.left
    }

    /// Passes over so many bytes; gives how many there were.
    pub fn skip(&mut self, bytes: u64) -> io::Result<u64> {
        if let (Stream::Plain(stream), Some(left)) = (&mut self.stream, &mut self.left) {
            let skipped = bytes.min(*left);
            let here = stream.stream_position()?;
            stream.seek(SeekFrom::Start(here + skipped))?;
            *left -= skipped;
            return Ok(skipped);
        }
        packed::count(self, bytes)
    }

    /// Bytes that are left, counted up to [`MOST_COUNTED`] where that is not known.
    pub fn rest(&mut self) -> io::Result<u64> {
        self.left.map_or_else(|| packed::count(&mut *self, MOST_COUNTED), Ok)
    }

    /// Bytes of a packed file behind what is packed, once all of that was read.
    pub fn behind(self) -> io::Result<u64> {
        match self.stream {
            Stream::Plain(_) => Ok(0),
            Stream::Packed(stream) => (*stream).into_inner().behind(Some(self.length), MOST_COUNTED),
        }
    }
}

impl Read for ByteSource {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = match &mut self.stream {
            Stream::Plain(stream) => stream.read(buffer),
            Stream::Packed(stream) => stream.read(buffer),
        }?;
        self.left = self.left.map(|left| left.saturating_sub(read as u64));
        Ok(read)
    }
}

impl BufRead for ByteSource {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        match &mut self.stream {
            Stream::Plain(stream) => stream.fill_buf(),
            Stream::Packed(stream) => stream.fill_buf(),
        }
    }

    fn consume(&mut self, amount: usize) {
        self.left = self.left.map(|left| left.saturating_sub(amount as u64));
        match &mut self.stream {
            Stream::Plain(stream) => stream.consume(amount),
            Stream::Packed(stream) => stream.consume(amount),
        }
    }
}
