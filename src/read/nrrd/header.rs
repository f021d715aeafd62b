//! The header of an NRRD file: lines `field: description`, `key:=value` and `# comment` up to an empty line, or
//! to the end of a detached header.

use std::collections::BTreeMap;
use std::io::{BufRead, Read};
use std::path::{Path, PathBuf};

use crate::error::{Error, Result};
use crate::scene::builtin::nearest;
use crate::scene::volume::VoxelType;

/// What a header says of its data.
pub struct Header {
    pub dims: [usize; 3],
    pub spacing: [f64; 3],
    pub voxel_type: VoxelType,
    pub big_endian: bool,
    pub encoding: Encoding,
    /// Lines of the data file before the data.
    pub line_skip: u64,
    pub byte_skip: ByteSkip,
    /// Of a detached header, relative to it.
    pub data_file: Option<PathBuf>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    Raw,
    Gzip,
    Ascii,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum ByteSkip {
    Bytes(u64),
    /// `-1`: as many as it takes for the data to be the last bytes of the file.
    ToTail,
}

/// A header that is longer is no header.
const LONGEST: u64 = 1 << 20;

/// Fields of the format, their one-word spellings brought to this one by [`SPELLINGS`].
const FIELDS: [&str; 30] = [
    "axis maxs",
    "axis mins",
    "block size",
    "byte skip",
    "centers",
    "content",
    "data file",
    "dimension",
    "encoding",
    "endian",
    "kinds",
    "labels",
    "line skip",
    "max",
    "measurement frame",
    "min",
    "number",
    "old max",
    "old min",
    "sample units",
    "sizes",
    "space",
    "space dimension",
    "space directions",
    "space origin",
    "space units",
    "spacings",
    "thicknesses",
    "type",
    "units",
];

const SPELLINGS: [(&str, &str); 10] = [
    ("axismaxs", "axis maxs"),
    ("axismins", "axis mins"),
    ("blocksize", "block size"),
    ("byteskip", "byte skip"),
    ("centerings", "centers"),
    ("datafile", "data file"),
    ("lineskip", "line skip"),
    ("oldmax", "old max"),
    ("oldmin", "old min"),
    ("sampleunits", "sample units"),
];

const TYPES: [(VoxelType, &[&str]); 8] = [
    (VoxelType::I8, &["signed char", "int8", "int8_t"]),
    (VoxelType::U8, &["uchar", "unsigned char", "uint8", "uint8_t"]),
    (VoxelType::I16, &["short", "short int", "signed short", "signed short int", "int16", "int16_t"]),
    (VoxelType::U16, &["ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"]),
    (VoxelType::I32, &["int", "signed int", "int32", "int32_t"]),
    (VoxelType::U32, &["uint", "unsigned int", "uint32", "uint32_t"]),
    (VoxelType::F32, &["float"]),
    (VoxelType::F64, &["double"]),
];

/// Reads the header at the start of `stream`; also gives its length in bytes.
pub fn read(path: &Path, stream: &mut impl BufRead) -> Result<(Header, u64)> {
    let mut lines = Lines { path, stream, bytes: 0 };
    let magic = lines.next()?.unwrap_or_default();
    if !["NRRD0001", "NRRD0002", "NRRD0003", "NRRD0004", "NRRD0005"].contains(&magic.as_str()) {
        let start: String = magic.chars().take(16).collect();
        return Err(Error::input(
            path.display(),
            format!("begins with {start:?}"),
            "give an NRRD file of version 1 to 5, which begins with NRRD0001 to NRRD0005",
        ));
    }
    let mut fields = Fields { path, values: BTreeMap::new() };
    let mut ended = false;
    while let Some(line) = lines.next()? {
        if line.is_empty() {
            ended = true;
            break;
        }
        fields.add(&line)?;
    }
    let header = fields.header()?;
    if !ended && header.data_file.is_none() {
        return fields.bad("header", "is not ended by an empty line", "complete the file, or name its `data file`");
    }
    Ok((header, lines.bytes))
}

/// The header's lines without their ends.
struct Lines<'a, R> {
    path: &'a Path,
    stream: &'a mut R,
    /// Bytes read so far.
    bytes: u64,
}

impl<R: BufRead> Lines<'_, R> {
    /// The next line; none at the end of the file.
    fn next(&mut self) -> Result<Option<String>> {
        let mut line = Vec::new();
        let room = LONGEST - self.bytes;
        let read = self.stream.by_ref().take(room).read_until(b'\n', &mut line);
        self.bytes += read.map_err(|e| crate::read::unreadable(self.path, &e))? as u64;
        if self.bytes >= LONGEST {
            let problem = format!("has a header of more than {LONGEST} bytes");
            return Err(Error::input(self.path.display(), problem, "give an NRRD file"));
        }
        if line.is_empty() {
            return Ok(None);
        }
        let text = String::from_utf8_lossy(&line);
        Ok(Some(text.trim_end_matches(['\n', '\r']).to_string()))
    }
}

/// The header's fields by name.
struct Fields<'a> {
    path: &'a Path,
    values: BTreeMap<&'static str, String>,
}

impl Fields<'_> {
    fn add(&mut self, line: &str) -> Result<()> {
        if line.starts_with('#') {
            return Ok(());
        }
        // The first of the two marks counts: a value may hold the other.
        let colon = line.find(": ").or(line.strip_suffix(':').map(str::len));
        let (field, value) = match (line.find(":="), colon) {
            (Some(key), field) if field.is_none_or(|f| key < f) => return Ok(()),
            (_, Some(at)) => (&line[..at], line[at + 1..].trim()),
            _ => {
                let shown: String = line.chars().take(60).collect();
                return self.bad(
                    &shown,
                    "is no line of an NRRD header",
                    "write `field: value`, `key:=value` or `# comment`",
                );
            }
        };
        let lower = field.trim().to_lowercase();
        let name = SPELLINGS.iter().find(|(spelling, _)| *spelling == lower).map_or(lower.as_str(), |(_, name)| name);
        let Some(known) = FIELDS.iter().find(|f| **f == name) else {
            let near = nearest(name, FIELDS).map_or("remove it".to_string(), |n| format!("did you mean `{n}`?"));
            return self.bad(field, "is no field of NRRD", &near);
        };
        if self.values.insert(known, value.to_string()).is_some() {
            return self.bad(known, "is given twice", "remove one of them");
        }
        Ok(())
    }

    fn header(&self) -> Result<Header> {
        let voxel_type = self.voxel_type()?;
        let encoding = self.encoding()?;
        let axes = self.axes()?;
        let big_endian = match self.values.get("endian").map(|e| e.to_lowercase()).as_deref() {
            Some("little") => false,
            Some("big") => true,
            None if voxel_type.bytes() == 1 || encoding == Encoding::Ascii => false,
            None => return self.bad("endian", "is missing", "write `endian: little` or `endian: big`"),
            Some(other) => return self.bad("endian", &format!("is `{other}`"), "write `little` or `big`"),
        };
        let line_skip = match self.values.get("line skip") {
            Some(n) => self.number("line skip", n)?,
            None => 0,
        };
        let byte_skip = match self.values.get("byte skip").map(String::as_str) {
            Some("-1") => ByteSkip::ToTail,
            Some(n) => ByteSkip::Bytes(self.number("byte skip", n)?),
            None => ByteSkip::Bytes(0),
        };
        Ok(Header {
            dims: self.sizes(axes)?,
            spacing: self.spacing(axes)?,
            voxel_type,
            big_endian,
            encoding,
            line_skip,
            byte_skip,
            data_file: self.data_file()?,
        })
    }

    fn voxel_type(&self) -> Result<VoxelType> {
        let given = self.required("type")?;
        let words = given.to_lowercase().split_whitespace().collect::<Vec<_>>().join(" ");
        let found = TYPES.iter().find(|(_, names)| names.contains(&words.as_str()));
        found.map(|(voxel_type, _)| *voxel_type).map_or_else(
            || self.bad("type", &format!("is `{given}`"), "convert it to 8, 16 or 32 bit integers, float or double"),
            Ok,
        )
    }

    fn encoding(&self) -> Result<Encoding> {
        let given = self.required("encoding")?;
        match given.to_lowercase().as_str() {
            "raw" => Ok(Encoding::Raw),
            "gzip" | "gz" => Ok(Encoding::Gzip),
            "ascii" | "text" | "txt" => Ok(Encoding::Ascii),
            _ => self.bad("encoding", &format!("is `{given}`"), "convert it to one of raw, gzip, ascii"),
        }
    }

    /// Axes in the file: 3, or 4 with one to be left out in front.
    fn axes(&self) -> Result<usize> {
        match self.required("dimension")? {
            "3" => Ok(3),
            "4" => Ok(4),
            other => self.bad(
                "dimension",
                &format!("is `{other}`"),
                "give a volume of 3 axes, or 4 with one entry along the first",
            ),
        }
    }

    fn sizes(&self, axes: usize) -> Result<[usize; 3]> {
        let text = self.required("sizes")?;
        let sizes = text.split_whitespace().map(|n| self.number("sizes", n)).collect::<Result<Vec<_>>>()?;
        let [leading @ .., x, y, z] = sizes.as_slice() else {
            return self.bad("sizes", &format!("are `{text}`"), &format!("give {axes} sizes"));
        };
        if sizes.len() != axes || leading.iter().any(|n| *n != 1) {
            let remedy = format!("give {axes} sizes, of four the first 1 (one value a voxel)");
            return self.bad("sizes", &format!("are `{text}`"), &remedy);
        }
        let side = |n: &u64| usize::try_from(*n).ok().filter(|n| *n > 0);
        match (side(x), side(y), side(z)) {
            (Some(x), Some(y), Some(z)) => Ok([x, y, z]),
            _ => self.bad("sizes", &format!("are `{text}`"), "give sizes of at least 1"),
        }
    }

    /// The length of an axis' space direction, else its spacing, else 1.
    fn spacing(&self, axes: usize) -> Result<[f64; 3]> {
        let directions = self.per_axis("space directions", axes, |s| self.directions(s))?;
        let spacings = self.per_axis("spacings", axes, |s| {
            s.split_whitespace()
                .map(|n| self.number::<f64>("spacings", n).map(|n| (!n.is_nan()).then_some(n)))
                .collect()
        })?;
        let mut spacing = [1.0; 3];
        for (axis, chosen) in spacing.iter_mut().enumerate() {
            let at = axis + axes - 3;
            match directions[at].or(spacings[at]) {
                Some(s) if s.is_finite() && s > 0.0 => *chosen = s,
                None => {}
                Some(s) => {
                    return self.bad(
                        "spacing",
                        &format!("along axis {at} is {s}"),
                        "give finite, positive spacings, or nan",
                    );
                }
            }
        }
        Ok(spacing)
    }

    /// One entry an axis; none for each where the field is absent.
    fn per_axis(
        &self,
        field: &str,
        axes: usize,
        entries: impl Fn(&str) -> Result<Vec<Option<f64>>>,
    ) -> Result<Vec<Option<f64>>> {
        let Some(text) = self.values.get(field) else {
            return Ok(vec![None; axes]);
        };
        let entries = entries(text)?;
        if entries.len() != axes {
            let problem = format!("has {} entries where there are {axes} axes", entries.len());
            return self.bad(field, &problem, "give one an axis");
        }
        Ok(entries)
    }

    /// Lengths of `(x,y,z)` vectors; `none` for an axis that lies in no space.
    fn directions(&self, text: &str) -> Result<Vec<Option<f64>>> {
        let mut lengths = Vec::new();
        let mut rest = text.trim_start();
        while !rest.is_empty() {
            if let Some(after) = rest.strip_prefix("none") {
                lengths.push(None);
                rest = after.trim_start();
                continue;
            }
            let Some((vector, after)) = rest.strip_prefix('(').and_then(|r| r.split_once(')')) else {
                return self.bad("space directions", &format!("are `{text}`"), "write (x,y,z) or none for each axis");
            };
            let parts = vector.split(',').map(|n| self.number::<f64>("space directions", n.trim()));
            let length = parts.collect::<Result<Vec<_>>>()?.into_iter().fold(0.0, f64::hypot);
            lengths.push(Some(length));
            rest = after.trim_start();
        }
        Ok(lengths)
    }

    fn data_file(&self) -> Result<Option<PathBuf>> {
        let Some(name) = self.values.get("data file") else { return Ok(None) };
        let words: Vec<_> = name.split_whitespace().collect();
        let pattern = words.len() >= 4 && words[0].contains('%') && words[1..].iter().all(|w| w.parse::<i64>().is_ok());
        let list = words.first().is_some_and(|w| *w == "LIST" || w.starts_with("SKIPLIST"));
        if list || pattern {
            return self.bad("data file", &format!("names several files (`{name}`)"), "join them into one");
        }
        if name.is_empty() {
            return self.bad("data file", "is empty", "name the file that holds the data");
        }
        Ok(Some(name.into()))
    }

    fn required(&self, field: &str) -> Result<&str> {
        match self.values.get(field) {
            Some(value) => Ok(value),
            None => self.bad(field, "is missing", "complete the header"),
        }
    }

    fn number<T: std::str::FromStr>(&self, field: &str, text: &str) -> Result<T> {
        text.parse().or_else(|_| {
            let shown: String = text.chars().take(40).collect();
            self.bad(field, &format!("has `{shown}`, which is no number it can have"), "correct it")
        })
    }

    fn bad<T>(&self, field: &str, problem: &str, remedy: &str) -> Result<T> {
        Err(Error::input(format!("{}: {field}", self.path.display()), problem, remedy))
    }
}
