//! NRRD volumes, versions 1 to 5, header attached or detached.
//!
//! Source: "Definition of NRRD File Format" of the Teem library (teem.sourceforge.net/nrrd/format.html).
//! Departures:
//! 1. One scalar volume: three axes, or four of which the first has one entry. Axis order is kept, orientation
//!    and origin are not; spacing is what remains of `space directions`.
//! 2. Encodings raw, gzip and ascii; one data file.
//! 3. Data must end where the sizes say. The format itself is silent about what follows.

mod header;

use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::path::Path;

use flate2::bufread::MultiGzDecoder;

use self::header::{ByteSkip, Encoding, Header};
use super::raw;
use super::voxels::{self, Fault, TextFault};
use crate::error::{Error, Result};
use crate::scene::volume::{Volume, Voxels};

/// DEFLATE writes at most 258 bytes for two bits, so a byte of a gzip file stands for at most about 1032.
const GZIP_RATIO: u64 = 1032;

/// # Errors
/// When a file cannot be read, its header is not NRRD or says something this reader does not know, or the data
/// is not what the header promises.
pub fn volume(path: &Path) -> Result<Volume> {
    let (file, length) = super::open(path)?;
    let mut stream = BufReader::new(file);
    let (header, header_bytes) = header::read(path, &mut stream)?;
    let voxels = match &header.data_file {
        None => Data { path, header: &header, left: length.saturating_sub(header_bytes), stream }.voxels(),
        Some(name) => {
            let data = path.parent().unwrap_or(Path::new("")).join(name);
            let (file, length) = super::open(&data)?;
            Data { path: &data, header: &header, left: length, stream: BufReader::new(file) }.voxels()
        }
    }?;
    Volume::new(path.display().to_string(), header.dims, header.spacing, voxels)
}

/// The data of a volume: a stream that stands behind the header.
struct Data<'a> {
    /// The file the data lies in.
    path: &'a Path,
    header: &'a Header,
    /// Bytes of the file that are left.
    left: u64,
    stream: BufReader<File>,
}

impl Data<'_> {
    fn voxels(mut self) -> Result<Voxels> {
        let header = self.header;
        let Some((count, bytes)) = raw::extent(header.dims, header.voxel_type) else {
            return self.bad(format!("cannot have the sizes {:?}: they overflow", header.dims), "correct the sizes");
        };
        self.skip_lines()?;
        match header.encoding {
            Encoding::Raw => self.raw(count, bytes),
            Encoding::Gzip => self.gzip(count, bytes),
            Encoding::Ascii => self.ascii(count),
        }
    }

    fn raw(mut self, count: usize, bytes: u64) -> Result<Voxels> {
        match self.header.byte_skip {
            ByteSkip::Bytes(skip) => self.skip_bytes(skip)?,
            // The data are the last bytes, whatever comes before them.
            ByteSkip::ToTail if self.left >= bytes => self.skip_bytes(self.left - bytes)?,
            ByteSkip::ToTail => {}
        }
        if self.left != bytes {
            return self.bad(
                format!("holds {} bytes of data where {} ask for {bytes}", self.left, self.promise()),
                "correct the header or complete the data",
            );
        }
        let decoded = voxels::binary(&mut self.stream, self.header.voxel_type, count, self.header.big_endian);
        decoded.or_else(|fault| self.fault(fault, bytes))
    }

    /// `line skip` counts lines of the file, `byte skip` bytes of what it decompresses to.
    fn gzip(mut self, count: usize, bytes: u64) -> Result<Voxels> {
        let ByteSkip::Bytes(skip) = self.header.byte_skip else {
            return self.bad("has `byte skip: -1` with gzip".into(), "use it with `encoding: raw` only");
        };
        let most = self.left.saturating_mul(GZIP_RATIO);
        if bytes.saturating_add(skip) > most {
            return self.bad(
                format!(
                    "holds {} bytes of gzip data, which cannot give the {bytes} that {} ask for",
                    self.left,
                    self.promise()
                ),
                "correct the header or complete the data",
            );
        }
        let mut decoder = MultiGzDecoder::new(&mut self.stream);
        let decoded = std::io::copy(&mut decoder.by_ref().take(skip), &mut std::io::sink())
            .map_err(Fault::Read)
            .and_then(|_| voxels::binary(&mut decoder, self.header.voxel_type, count, self.header.big_endian));
        decoded.or_else(|fault| self.fault(fault, bytes))
    }

    fn ascii(mut self, count: usize) -> Result<Voxels> {
        let ByteSkip::Bytes(skip) = self.header.byte_skip else {
            return self.bad("has `byte skip: -1` with ascii".into(), "use it with `encoding: raw` only");
        };
        self.skip_bytes(skip)?;
        let mut text = String::new();
        if let Err(e) = self.stream.by_ref().take(self.left).read_to_string(&mut text) {
            return Err(super::unreadable(self.path, &e));
        }
        match voxels::text(&text, self.header.voxel_type, count) {
            Ok(voxels) => Ok(voxels),
            Err(TextFault::Memory) => self.fault(Fault::Memory, count as u64),
            Err(TextFault::Count(found)) => self.bad(
                format!("holds {found} numbers where {} ask for {count}", self.promise()),
                "correct the header or complete the data",
            ),
            Err(TextFault::Number(i, word)) => self.bad(
                format!("has `{word}` for number {i}, which is no {}", raw::type_name(self.header.voxel_type)),
                "correct it or the type",
            ),
        }
    }

    fn skip_lines(&mut self) -> Result<()> {
        for line in 0..self.header.line_skip {
            let skipped = self.stream.skip_until(b'\n').map_err(|e| super::unreadable(self.path, &e))?;
            if skipped == 0 {
                let problem = format!("has {line} lines of the {} to be skipped", self.header.line_skip);
                return self.bad(problem, "correct `line skip`");
            }
            self.left = self.left.saturating_sub(skipped as u64);
        }
        Ok(())
    }

    fn skip_bytes(&mut self, skip: u64) -> Result<()> {
        if skip > self.left {
            let problem = format!("has {} bytes of the {skip} to be skipped", self.left);
            return self.bad(problem, "correct `byte skip`");
        }
        let here = self.stream.stream_position().and_then(|at| self.stream.seek(SeekFrom::Start(at + skip)));
        here.map_err(|e| super::unreadable(self.path, &e))?;
        self.left -= skip;
        Ok(())
    }

    fn fault<T>(&self, fault: Fault, bytes: u64) -> Result<T> {
        let (problem, remedy) = match fault {
            Fault::Short { bytes: n } => (format!("ends after {n} bytes of data"), "complete the data"),
            Fault::Long => ("goes on after the last voxel".to_string(), "correct the header or cut the data"),
            Fault::Memory => (format!("needs more memory than is to be had ({bytes} bytes)"), "use a smaller volume"),
            Fault::Read(e) if e.kind() == ErrorKind::UnexpectedEof => {
                ("ends within its gzip data".to_string(), "complete the data")
            }
            Fault::Read(e) => (format!("holds data that cannot be read ({e})"), "make or fetch the file again"),
        };
        self.bad(format!("{problem}, where {} ask for {bytes} bytes", self.promise()), remedy)
    }

    /// `sizes 64 64 64 of type u8`
    fn promise(&self) -> String {
        let [x, y, z] = self.header.dims;
        format!("sizes {x} {y} {z} of type {}", raw::type_name(self.header.voxel_type))
    }

    fn bad<T>(&self, problem: String, remedy: &str) -> Result<T> {
        Err(Error::input(self.path.display(), problem, remedy))
    }
}
