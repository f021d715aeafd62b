//! Data packed by gzip or bzip2: the members of a stream one after another, and what lies behind the last of them.

use std::io::{self, BufRead, Read};

use bzip2::bufread::BzDecoder;
use flate2::bufread::GzDecoder;

/// How data are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packing {
    Gzip,
    Bzip2,
}

impl Packing {
    pub fn name(self) -> &'static str {
        match self {
            Self::Gzip => "gzip",
            Self::Bzip2 => "bzip2",
        }
    }

    /// How a member begins.
    pub fn magic(self) -> &'static [u8] {
        match self {
            Self::Gzip => &[0x1f, 0x8b],
            Self::Bzip2 => b"BZh",
        }
    }

    /// The most bytes that one packed byte can stand for. DEFLATE writes at most 258 bytes for two bits. A block of bzip2
    /// holds at most 900 000 bytes, each run of 4 of which stands for 259, in no fewer than 32 bytes.
    pub fn ratio(self) -> u64 {
        match self {
            Self::Gzip => 1032,
            Self::Bzip2 => 900_000 / 5 * 259 / 32,
        }
    }
}

/// A stream whose bytes are counted as they are taken.
pub struct Counted<R> {
    inner: R,
    pub taken: u64,
}

impl<R> Counted<R> {
    pub fn new(inner: R) -> Self {
        Self { inner, taken: 0 }
    }
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.inner.read(buffer)?;
        self.taken += read as u64;
        Ok(read)
    }
}

impl<R: BufRead> BufRead for Counted<R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.inner.fill_buf()
    }

    fn consume(&mut self, amount: usize) {
        self.taken += amount as u64;
        self.inner.consume(amount);
    }
}

enum Member<R> {
    Gzip(GzDecoder<Counted<R>>),
    Bzip2(BzDecoder<Counted<R>>),
    /// Behind the last one.
    None(Counted<R>),
    /// Never seen from outside: what stands here while a member is exchanged.
    Changing,
}

/// Unpacks the members of a stream one after another. What follows a member and is not another one is no fault: it is
/// the padding that tapes and downloads leave, and is counted.
pub struct Members<R> {
    packing: Packing,
    member: Member<R>,
    /// Packed bytes up to the end of the last whole member.
    ended: u64,
    /// Whether the member at hand has given a byte, or is the first.
    sound: bool,
}

impl<R: BufRead> Members<R> {
    pub fn new(packing: Packing, stream: R) -> Self {
        let stream = Counted::new(stream);
        Self { packing, member: begun(packing, stream), ended: 0, sound: true }
    }

    /// Packed bytes behind the last member, once all are read: counted up to `most` where it is not known how many are
    /// `left` in all.
    pub fn behind(self, left: Option<u64>, most: u64) -> io::Result<u64> {
        let Member::None(stream) = self.member else { return Ok(0) };
        match left {
            Some(left) => Ok(left.saturating_sub(self.ended)),
            None => {
                let taken = stream.taken - self.ended;
                Ok(taken + count(stream, most)?)
            }
        }
    }

    /// Goes on to the next member; none follows where the next byte begins none.
    fn next(&mut self) -> io::Result<()> {
        let mut stream = match std::mem::replace(&mut self.member, Member::Changing) {
            Member::Gzip(decoder) => decoder.into_inner(),
            Member::Bzip2(decoder) => decoder.into_inner(),
            Member::None(stream) => stream,
            Member::Changing => return Ok(()),
        };
        self.ended = stream.taken;
        let another = stream.fill_buf()?.first() == self.packing.magic().first();
        self.sound = false;
        self.member = if another { begun(self.packing, stream) } else { Member::None(stream) };
        Ok(())
    }

    /// What seemed to be another member is none.
    fn give_up(&mut self) {
        self.member = match std::mem::replace(&mut self.member, Member::Changing) {
            Member::Gzip(decoder) => Member::None(decoder.into_inner()),
            Member::Bzip2(decoder) => Member::None(decoder.into_inner()),
            none => none,
        };
    }
}

fn begun<R: BufRead>(packing: Packing, stream: Counted<R>) -> Member<R> {
    match packing {
        Packing::Gzip => Member::Gzip(GzDecoder::new(stream)),
        Packing::Bzip2 => Member::Bzip2(BzDecoder::new(stream)),
    }
}

impl<R: BufRead> Read for Members<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if buffer.is_empty() {
            return Ok(0);
        }
        loop {
            let read = match &mut self.member {
                Member::Gzip(decoder) => decoder.read(buffer),
                Member::Bzip2(decoder) => decoder.read(buffer),
                Member::None(_) | Member::Changing => return Ok(0),
            };
            match read {
                Ok(0) => self.next()?,
                Ok(n) => {
                    self.sound = true;
                    return Ok(n);
                }
                Err(e) if self.sound || e.kind() == io::ErrorKind::Interrupted => return Err(e),
                Err(_) => self.give_up(),
            }
        }
    }
}

/// Bytes a stream still holds, at most `most` of them.
pub fn count(stream: impl Read, most: u64) -> io::Result<u64> {
    io::copy(&mut stream.take(most), &mut io::sink())
}
