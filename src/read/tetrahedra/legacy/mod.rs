//! Legacy files of the Visualization Toolkit: unstructured, structured and rectilinear grids, as text and as bytes.
//!
//! Source: "VTK File Formats" (Kitware), the legacy formats, versions 1.0 to 5.1.

mod words;

use std::path::Path;

use super::arrays::{Array, At};
use super::cells::{CellData, Cells, points_in_rows};
use crate::error::{Error, Result};
use crate::read::values::{Encoding, NumberType, Values};

/// How every legacy file begins.
const MAGIC: &[u8] = b"# vtk DataFile Version ";

/// From this version on offsets of cells stand in an array of their own.
const OFFSETS_FROM: f64 = 5.0;

/// Arrays of a fixed number of values each, by their keywords.
const FIXED: [(&str, usize); 6] =
    [("VECTORS", 3), ("NORMALS", 3), ("TENSORS", 9), ("TENSORS6", 6), ("GLOBAL_IDS", 1), ("PEDIGREE_IDS", 1)];

/// Whether a file begins like one of them.
pub fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// # Errors
/// When the file does not hold what it says, or holds something else than a grid.
pub fn read(path: &Path, bytes: &[u8]) -> Result<CellData> {
    let mut reader = Reader::begin(path, bytes)?;
    while let Some(words) = reader.keywords() {
        reader.section(&words)?;
    }
    reader.finish()
}

struct Reader<'a> {
    path: &'a Path,
    values: Values<'a>,
    version: f64,
    dataset: Option<Dataset>,
    dims: Option<[usize; 3]>,
    /// Coordinates along each axis, of a rectilinear grid.
    axes: [Vec<f64>; 3],
    /// Whether values that follow are those of points or of cells, and of how many.
    of: Option<(At, usize)>,
    data: CellData,
}

#[derive(Clone, Copy, PartialEq)]
enum Dataset {
    Unstructured,
    Structured,
    Rectilinear,
}

impl<'a> Reader<'a> {
    /// Reads the first lines.
    fn begin(path: &'a Path, bytes: &'a [u8]) -> Result<Self> {
        let mut values = Values::new(Encoding::Ascii, bytes, 0);
        let first = values.line().unwrap_or_default();
        let version = first.rsplit(' ').next().and_then(|word| word.parse().ok()).unwrap_or(0.0);
        // The title.
        values.line();
        let kind = values.line().unwrap_or_default();
        values.encoding = match kind.to_ascii_uppercase().as_str() {
            "ASCII" => Encoding::Ascii,
            "BINARY" => Encoding::Big,
            _ => {
                let problem = format!("has `{kind}` in line 3, where ASCII or BINARY stands");
                return Err(Error::input(path.display(), problem, "correct the line"));
            }
        };
        let (dataset, dims, of) = (None, None, None);
        Ok(Self { path, values, version, dataset, dims, axes: Default::default(), of, data: CellData::default() })
    }

    fn section(&mut self, words: &[String]) -> Result<()> {
        let keyword = words[0].to_ascii_uppercase();
        if let Some((_, components)) = FIXED.iter().find(|(name, _)| *name == keyword) {
            let number = self.number_type(words, 2)?;
            return self.array(self.named(words, 1)?, *components, number);
        }
        match keyword.as_str() {
            "DATASET" => self.dataset(words),
            "DIMENSIONS" => {
                self.dims = Some([self.count(words, 1)?, self.count(words, 2)?, self.count(words, 3)?]);
                Ok(())
            }
            "POINTS" => {
                let (count, number) = (self.count(words, 1)?, self.number_type(words, 2)?);
                self.data.points = self.numbers(&keyword, count, 3, number)?;
                Ok(())
            }
            "X_COORDINATES" | "Y_COORDINATES" | "Z_COORDINATES" => {
                let axis = usize::from(keyword.as_bytes()[0] - b'X');
                let (count, number) = (self.count(words, 1)?, self.number_type(words, 2)?);
                self.axes[axis] = self.numbers(&keyword, count, 1, number)?;
                Ok(())
            }
            "CELLS" => self.cells(words),
            "CELL_TYPES" => {
                let count = self.count(words, 1)?;
                let found = self.numbers(&keyword, count, 1, NumberType::I32)?;
                if let Cells::Listed { kinds, .. } = &mut self.data.cells {
                    *kinds = found.into_iter().map(|kind| kind as i64).collect();
                }
                Ok(())
            }
            "POINT_DATA" => self.begin_values(At::Points, words),
            "CELL_DATA" => self.begin_values(At::Cells, words),
            "SCALARS" => self.scalars(words),
            "COLOR_SCALARS" => {
                let components = self.count(words, 2)?;
                let number = if self.values.encoding == Encoding::Ascii { NumberType::F32 } else { NumberType::U8 };
                self.array(self.named(words, 1)?, components, number)
            }
            "TEXTURE_COORDINATES" => {
                let (components, number) = (self.count(words, 2)?, self.number_type(words, 3)?);
                self.array(self.named(words, 1)?, components, number)
            }
            "LOOKUP_TABLE" => {
                let count = self.count(words, 2)?;
                let number = if self.values.encoding == Encoding::Ascii { NumberType::F32 } else { NumberType::U8 };
                self.numbers(&keyword, count, 4, number).map(drop)
            }
            "FIELD" => self.field(words),
            "METADATA" => {
                while self.values.line().is_some_and(|line| !line.is_empty()) {}
                Ok(())
            }
            _ => {
                let line = self.values.line_number() - 1;
                self.bad(format!(
                    "has `{}` in line {line} or behind it, where a keyword stands",
                    words[0].escape_debug()
                ))
            }
        }
    }

    fn dataset(&mut self, words: &[String]) -> Result<()> {
        let kind = words.get(1).map(|word| word.to_ascii_uppercase()).unwrap_or_default();
        self.dataset = Some(match kind.as_str() {
            "UNSTRUCTURED_GRID" => Dataset::Unstructured,
            "STRUCTURED_GRID" => Dataset::Structured,
            "RECTILINEAR_GRID" => Dataset::Rectilinear,
            _ => {
                let problem = format!("holds a dataset of the kind `{}`", kind.escape_debug());
                let remedy = "give one of UNSTRUCTURED_GRID, STRUCTURED_GRID or RECTILINEAR_GRID; voxels as NRRD";
                return Err(Error::input(self.path.display(), problem, remedy));
            }
        });
        Ok(())
    }

    fn cells(&mut self, words: &[String]) -> Result<()> {
        let (first, second) = (self.count(words, 1)?, self.count(words, 2)?);
        let (ends, corners) = match self.version >= OFFSETS_FROM {
            true => self.cells_by_offsets(first, second)?,
            false => self.cells_by_counts(first, second)?,
        };
        self.data.cells = Cells::Listed { kinds: Vec::new(), ends, corners };
        Ok(())
    }

    /// Each cell as the number of its corners and their numbers.
    fn cells_by_counts(&mut self, count: usize, all: usize) -> Result<(Vec<usize>, Vec<u32>)> {
        let numbers = self.numbers("CELLS", all, 1, NumberType::I32)?;
        let (mut ends, mut corners) = (Vec::new(), Vec::new());
        let mut rest = numbers.as_slice();
        for cell in 0..count {
            let of_cell = rest.split_first().and_then(|(n, rest)| rest.split_at_checked(self.whole(*n).ok()? as usize));
            let Some((of_cell, behind)) = of_cell else {
                return self
                    .bad(format!("has {all} numbers under CELLS, which are over in the cell {cell} of {count}"));
            };
            for corner in of_cell {
                corners.push(self.whole(*corner)?);
            }
            ends.push(corners.len());
            rest = behind;
        }
        Ok((ends, corners))
    }

    /// Where the corners of each cell begin and the last one's end, then the corners.
    fn cells_by_offsets(&mut self, count: usize, all: usize) -> Result<(Vec<usize>, Vec<u32>)> {
        let mut list = |name: &str, count: usize| {
            let words = self.keywords().unwrap_or_default();
            if words.first().map(|word| word.to_ascii_uppercase()).as_deref() != Some(name) {
                return self.bad(format!("lacks {name} under CELLS"));
            }
            let number = self.number_type(&words, 1)?;
            let numbers = self.numbers(name, count, 1, number)?;
            numbers.into_iter().map(|number| self.whole(number)).collect::<Result<Vec<u32>>>()
        };
        let offsets = list("OFFSETS", count)?;
        let corners = list("CONNECTIVITY", all)?;
        let rising = offsets.windows(2).all(|pair| pair[0] <= pair[1]);
        let ends: Vec<usize> = offsets.iter().skip(1).map(|offset| *offset as usize).collect();
        if !rising || offsets.first().is_some_and(|first| *first != 0) || ends.last().is_some_and(|last| *last > all) {
            return self.bad(format!("has OFFSETS that do not rise from 0 to {all}"));
        }
        Ok((ends, corners))
    }

    fn begin_values(&mut self, at: At, words: &[String]) -> Result<()> {
        self.of = Some((at, self.count(words, 1)?));
        Ok(())
    }

    fn scalars(&mut self, words: &[String]) -> Result<()> {
        let (name, number) = (self.named(words, 1)?, self.number_type(words, 2)?);
        let components = if words.len() > 3 { self.count(words, 3)? } else { 1 };
        // The name of a table stands in the next line, where there is one.
        let before = self.values.clone();
        let is_table = self.keywords().is_some_and(|words| words[0].eq_ignore_ascii_case("LOOKUP_TABLE"));
        if !is_table {
            self.values = before;
        }
        self.array(name, components, number)
    }

    fn field(&mut self, words: &[String]) -> Result<()> {
        for _ in 0..self.count(words, 2)? {
            let words = loop {
                let Some(words) = self.keywords() else { return self.bad("ends in a FIELD") };
                if words[0] != "METADATA" {
                    break words;
                }
                while self.values.line().is_some_and(|line| !line.is_empty()) {}
            };
            let (components, count) = (self.count(&words, 1)?, self.count(&words, 2)?);
            if words.get(3).is_some_and(|kind| kind == "string") {
                return self.bad(format!("has texts in the array `{}`", words[0].escape_debug()));
            }
            let number = self.number_type(&words, 3)?;
            match self.of {
                Some((_, of)) if of == count => self.array(self.named(&words, 0)?, components, number)?,
                // Of the file as a whole.
                _ => drop(self.numbers(&words[0], count, components, number)?),
            }
        }
        Ok(())
    }

    fn array(&mut self, name: String, components: usize, number: NumberType) -> Result<()> {
        let Some((at, count)) = self.of else {
            return self.bad(format!("has the array `{name}` before POINT_DATA or CELL_DATA"));
        };
        if components == 0 {
            return self.bad(format!("has the array `{name}` of no values each"));
        }
        let values = self.numbers(&name, count, components, number)?;
        self.data.arrays.push(Array { name, at, components, values });
        Ok(())
    }

    fn finish(mut self) -> Result<CellData> {
        let Some(dataset) = self.dataset else { return self.bad("holds no DATASET") };
        if dataset == Dataset::Unstructured {
            let Cells::Listed { kinds, ends, .. } = &self.data.cells else { return self.bad("has no cells") };
            if kinds.len() != ends.len() {
                return self.bad(format!("has {} CELLS and {} CELL_TYPES", ends.len(), kinds.len()));
            }
            return Ok(self.data);
        }
        if dataset == Dataset::Rectilinear {
            self.dims = Some(self.axes.each_ref().map(Vec::len));
        }
        let Some(dims) = self.dims else { return self.bad("has no DIMENSIONS") };
        let asked = match points_in_rows(dims) {
            Ok(asked) => asked,
            Err(what) => return self.bad(format!("has the DIMENSIONS {dims:?}, {what}")),
        };
        if dataset == Dataset::Rectilinear {
            let [x, y, z] = std::mem::take(&mut self.axes);
            let mut points = Vec::new();
            if points.try_reserve_exact(3 * asked).is_err() {
                return self.bad(format!("has {dims:?} points, for which there is not enough memory"));
            }
            for c in &z {
                for b in &y {
                    points.extend(x.iter().flat_map(|a| [*a, *b, *c]));
                }
            }
            self.data.points = points;
        }
        let points = self.data.points.len() / 3;
        if asked != points {
            return self.bad(format!("has the DIMENSIONS {dims:?} and {points} points"));
        }
        self.data.cells = Cells::Structured(dims);
        Ok(self.data)
    }
}
