//! The header of an NRRD file: what its fields say of the data.

use std::io::BufRead;
use std::path::{Path, PathBuf};

use super::axes::{self, Axis};
use super::fields::{Fields, Lines};
use super::names::{Names, Several};
use crate::error::{Error, Result};
use crate::read::packed::Packing;
use crate::read::raw::ByteSkip;
use crate::scene::file_name;
use crate::scene::volume::VoxelType;

/// What a header says of its data.
pub struct Header {
    /// The fastest first.
    pub axes: Vec<Axis>,
    /// The name of the space the axes lie in, lower case.
    pub space: Option<String>,
    pub voxel_type: VoxelType,
    pub big_endian: bool,
    pub encoding: Encoding,
    /// Lines of a data file before its data.
    pub line_skip: u64,
    /// Bytes of a data file before its data.
    pub byte_skip: ByteSkip,
    /// The files that hold the data, relative to the header.
    pub names: Names,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    Raw,
    Packed(Packing),
    Ascii,
    Hex,
}

impl Encoding {
    pub fn name(self) -> &'static str {
        match self {
            Self::Raw => "raw",
            Self::Packed(packing) => packing.name(),
            Self::Ascii => "ascii",
            Self::Hex => "hex",
        }
    }
}

const ENCODINGS: [(Encoding, &[&str]); 5] = [
    (Encoding::Raw, &["raw"]),
    (Encoding::Packed(Packing::Gzip), &["gzip", "gz"]),
    (Encoding::Packed(Packing::Bzip2), &["bzip2", "bz2"]),
    (Encoding::Ascii, &["ascii", "text", "txt"]),
    (Encoding::Hex, &["hex"]),
];

/// How a file begins, by version; the first is that of files from before there were versions.
const MAGICS: [&str; 6] = ["NRRD00.01", "NRRD0001", "NRRD0002", "NRRD0003", "NRRD0004", "NRRD0005"];
/// The first line is no longer.
const LONGEST_MAGIC: u64 = 32;

/// A line is kept while it is read, and a packed file may hold very long ones.
const LONGEST_LINE: u64 = 1 << 26;
/// A name takes many times the memory of its line.
const MOST_FILES: usize = 1 << 20;
/// Names of a LIST are no longer, all together.
const LONGEST_LIST: usize = 64 << 20;

const TYPES: [(VoxelType, &[&str]); 10] = [
    (VoxelType::I8, &["signed char", "int8", "int8_t"]),
    (VoxelType::U8, &["uchar", "unsigned char", "uint8", "uint8_t"]),
    (VoxelType::I16, &["short", "short int", "signed short", "signed short int", "int16", "int16_t"]),
    (VoxelType::U16, &["ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"]),
    (VoxelType::I32, &["int", "signed int", "int32", "int32_t"]),
    (VoxelType::U32, &["uint", "unsigned int", "uint32", "uint32_t"]),
    (
        VoxelType::I64,
        &["longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"],
    ),
    (VoxelType::U64, &["ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"]),
    (VoxelType::F32, &["float"]),
    (VoxelType::F64, &["double"]),
];

/// Reads the header at the start of `stream`, a file of at most `most` bytes.
pub fn read(path: &Path, stream: &mut impl BufRead, most: u64) -> Result<Header> {
    let mut lines = Lines::new(path, stream, most);
    let first = lines.next(LONGEST_MAGIC)?.unwrap_or_default();
    let magic = first.strip_prefix(crate::read::BYTE_ORDER_MARK).unwrap_or(&first).trim_ascii_end();
    if !MAGICS.iter().any(|known| known.as_bytes() == magic) {
        let start: String = String::from_utf8_lossy(magic).chars().take(16).collect();
        return Err(Error::input(
            path.display(),
            format!("begins with {start:?}"),
            "give an NRRD file of version 1 to 5, which begins with NRRD0001 to NRRD0005, or NRRD00.01",
        ));
    }
    let mut fields = Fields::new(path);
    let mut names = Names::Attached;
    let (mut ended, mut listed) = (false, 0);
    while let Some(line) = lines.next(LONGEST_LINE)? {
        if line.len() as u64 > LONGEST_LINE {
            let problem = format!("has a line of more than {LONGEST_LINE} bytes");
            return fields.bad("header", &problem, "give an NRRD file");
        }
        if line.trim_ascii().is_empty() {
            ended = true;
            break;
        }
        if let Names::Several(Several::List(list), _) = &mut names {
            listed += line.len();
            if list.len() == MOST_FILES || listed > LONGEST_LIST {
                let problem = format!("lists more than {MOST_FILES} files or {LONGEST_LIST} bytes");
                return fields.bad("data file", &problem, "join some of the files");
            }
            let name = file_name::name(line.trim_ascii().to_vec());
            list.push(PathBuf::from(name.or_else(|e| fields.bad("data file", &e, "rename the file"))?));
        } else if let Some(value) = fields.add(&line)? {
            names = Names::of(value).or_else(|(problem, remedy)| fields.bad("data file", problem, remedy))?;
        }
    }
    let header = Header::of(&fields, names)?;
    if !ended && header.names == Names::Attached {
        return fields.bad("header", "is not ended by an empty line", "complete the file, or name its `data file`");
    }
    Ok(header)
}

impl Header {
    fn of(fields: &Fields, names: Names) -> Result<Self> {
        let voxel_type = voxel_type(fields)?;
        let encoding = encoding(fields)?;
        let axes = axes::read(fields)?;
        let big_endian = match fields.get("endian").map(str::to_lowercase).as_deref() {
            Some("little") => false,
            Some("big") => true,
            None if voxel_type.bytes() == 1 || encoding == Encoding::Ascii => false,
            None => return fields.bad("endian", "is missing", "write `endian: little` or `endian: big`"),
            Some(other) => return fields.bad("endian", &format!("is `{other}`"), "write `little` or `big`"),
        };
        let line_skip = fields.get("line skip").map_or(Ok(0), |n| fields.number("line skip", n))?;
        let skip: i64 = fields.get("byte skip").map_or(Ok(0), |n| fields.number("byte skip", n))?;
        let Some(byte_skip) = ByteSkip::of(skip) else {
            return fields.bad("byte skip", &format!("is `{skip}`"), "write a number of bytes, or -1 for the rest");
        };
        let space = fields.get("space").map(str::to_lowercase);
        Ok(Self { axes, space, voxel_type, big_endian, encoding, line_skip, byte_skip, names })
    }

    /// Along each axis, the fastest first.
    pub fn sizes(&self) -> Vec<usize> {
        self.axes.iter().map(|axis| axis.size).collect()
    }
}

fn voxel_type(fields: &Fields) -> Result<VoxelType> {
    let given = fields.required("type")?;
    let words = given.to_lowercase().split_whitespace().collect::<Vec<_>>().join(" ");
    let found = TYPES.iter().find(|(_, names)| names.contains(&words.as_str()));
    found.map_or_else(
        || fields.bad("type", &format!("is `{given}`"), "convert it to integers of 8 to 64 bits, float or double"),
        |(voxel_type, _)| Ok(*voxel_type),
    )
}

fn encoding(fields: &Fields) -> Result<Encoding> {
    let given = fields.required("encoding")?;
    let lower = given.to_lowercase();
    let found = ENCODINGS.iter().find(|(_, names)| names.contains(&lower.as_str()));
    found.map_or_else(
        || {
            let known = ENCODINGS.map(|(encoding, _)| encoding.name()).join(", ");
            fields.bad("encoding", &format!("is `{given}`, which is unknown"), &format!("convert it to one of {known}"))
        },
        |(encoding, _)| Ok(*encoding),
    )
}
