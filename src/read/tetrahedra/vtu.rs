//! XML files of the Visualization Toolkit: unstructured (VTU), structured (VTS) and rectilinear grids (VTR), of which values stand in the
//! text, as base64 in the text, or behind it, packed by zlib or not.
//!
//! Source: "VTK File Formats" (Kitware), the XML formats, versions 0.1 to 2.x.

use std::path::Path;

use roxmltree::{Document, Node};

use super::arrays::{Array, At};
use super::cells::{CellData, Cells, points_in_rows};
use super::vtu_values::Blocks;
use crate::error::{Error, Result};

/// What stands in front of values behind the text.
const APPENDED: &[u8] = b"<AppendedData";

/// The most elements within each other; files of VTK have six.
const DEEPEST: usize = 64;

/// Whether a file begins like one of them.
pub fn recognises(bytes: &[u8]) -> bool {
    let text = String::from_utf8_lossy(bytes);
    text.contains("<VTKFile")
}

/// # Errors
/// When the file does not hold what it says, or holds something else than a grid.
pub fn read(path: &Path, bytes: &[u8]) -> Result<CellData> {
    let bad = |problem: String| Error::input(path.display(), problem, "correct the file, or write it anew with VTK");
    let at = bytes.windows(APPENDED.len()).position(|window| window == APPENDED);
    let (text, appended) = bytes.split_at(at.unwrap_or(bytes.len()));
    let mut text =
        std::str::from_utf8(text).map_err(|e| bad(format!("is not UTF-8 text (byte {})", e.valid_up_to())))?.to_owned();
    if at.is_some() {
        text.push_str("</VTKFile>");
    }
    if nesting(text.as_bytes()) > DEEPEST {
        return Err(bad(format!("has elements within each other, more than {DEEPEST} deep")));
    }
    let document = Document::parse(&text).map_err(|e| bad(format!("is not XML ({e})")))?;
    let root = document.root_element();
    let kind = root.attribute("type").unwrap_or_default();
    let Some(grid) = root.children().find(|node| node.is_element() && node.has_tag_name(kind)) else {
        return Err(bad(format!("holds no `{}`, which it says it does", kind.escape_debug())));
    };
    let blocks = Blocks::new(path, root, appended)?;
    let reader = Reader { path, blocks, bad: &bad };
    let pieces: Vec<Node> = elements(grid, "Piece").collect();
    match kind {
        "UnstructuredGrid" => reader.unstructured(&pieces),
        "StructuredGrid" | "RectilinearGrid" => match pieces[..] {
            [piece] => reader.structured(piece, kind == "RectilinearGrid"),
            _ => Err(bad(format!("has {} pieces, and a grid in rows is read of one", pieces.len()))),
        },
        _ => {
            let problem = format!("holds a dataset of the kind `{}`", kind.escape_debug());
            let remedy = "give one of UnstructuredGrid, StructuredGrid or RectilinearGrid; voxels as NRRD";
            Err(Error::input(path.display(), problem, remedy))
        }
    }
}

/// How deep elements stand within each other: the parser goes down into each, for which there is no end of room.
fn nesting(text: &[u8]) -> usize {
    let (mut depth, mut deepest, mut at) = (0usize, 0, 0);
    while let Some(begin) = text[at..].iter().position(|b| *b == b'<').map(|offset| at + offset) {
        // To the end of the tag, which does not stand within quotes.
        let (mut quote, mut end) = (None, begin + 1);
        while let Some(byte) = text.get(end) {
            match (quote, byte) {
                (None, b'"' | b'\'') => quote = Some(*byte),
                (Some(open), byte) if open == *byte => quote = None,
                (None, b'>') => break,
                _ => {}
            }
            end += 1;
        }
        let closed = text.get(end.wrapping_sub(1)) == Some(&b'/');
        match text.get(begin + 1) {
            Some(b'/') => depth = depth.saturating_sub(1),
            Some(b'!' | b'?') | None => {}
            Some(_) => {
                deepest = deepest.max(depth + 1);
                depth += usize::from(!closed);
            }
        }
        at = (begin + 1).max(if quote.is_some() { begin + 1 } else { end.min(text.len()) });
    }
    deepest
}

fn elements<'a, 'd>(node: Node<'a, 'd>, name: &'static str) -> impl Iterator<Item = Node<'a, 'd>> {
    node.children().filter(move |child| child.has_tag_name(name))
}

struct Reader<'a> {
    path: &'a Path,
    blocks: Blocks<'a>,
    bad: &'a dyn Fn(String) -> Error,
}

impl Reader<'_> {
    /// The arrays of an element.
    fn arrays<'a, 'd>(&self, piece: Node<'a, 'd>, name: &'static str) -> Vec<Node<'a, 'd>> {
        elements(piece, name).flat_map(|element| elements(element, "DataArray")).collect()
    }

    fn number(&self, node: Node, name: &str) -> Result<usize> {
        let word = node.attribute(name).unwrap_or("nothing");
        word.trim()
            .parse()
            .map_err(|_| (self.bad)(format!("has {} as {name}, where a number of things stands", word.escape_debug())))
    }

    /// The numbers of an array that has so many things.
    fn values(&self, array: Node, count: usize) -> Result<(usize, Vec<f64>)> {
        let components =
            array.attribute("NumberOfComponents").map_or(Ok(1), |_| self.number(array, "NumberOfComponents"))?;
        let Some(all) = count.checked_mul(components).filter(|_| components > 0) else {
            let name = array.attribute("Name").unwrap_or("Points").escape_debug();
            return Err((self.bad)(format!("has {count} times {components} numbers in the array `{name}`")));
        };
        let values = self.blocks.values(array, Some(all))?;
        if values.len() != all {
            let name = array.attribute("Name").unwrap_or("Points").escape_debug();
            return Err((self.bad)(format!(
                "has {} numbers in the array `{name}` for {count} times {components}",
                values.len()
            )));
        }
        Ok((components, values))
    }

    /// The numbers of an array with one for each of so many things.
    fn singles(&self, array: Node, count: usize) -> Result<Vec<f64>> {
        match self.values(array, count)? {
            (1, values) => Ok(values),
            (components, _) => {
                let name = array.attribute("Name").unwrap_or_default().escape_debug();
                Err((self.bad)(format!("has {components} numbers each in the array `{name}`, where one stands")))
            }
        }
    }

    fn points(&self, piece: Node, count: usize) -> Result<Vec<f64>> {
        let [array] = self.arrays(piece, "Points")[..] else {
            return Err((self.bad)("has no one array of Points".to_owned()));
        };
        match self.values(array, count)? {
            (3, values) => Ok(values),
            (components, _) => Err((self.bad)(format!("has points of {components} coordinates"))),
        }
    }

    /// Adds the values at points or at cells of a piece; pieces have the same arrays.
    fn add_values(&self, data: &mut CellData, piece: Node, at: At, count: usize) -> Result<()> {
        let element = if at == At::Points { "PointData" } else { "CellData" };
        for array in self.arrays(piece, element) {
            let name = array.attribute("Name").unwrap_or("values").to_owned();
            if array.attribute("type") == Some("String") {
                continue;
            }
            let (components, values) = self.values(array, count)?;
            match data
                .arrays
                .iter_mut()
                .find(|other| other.name == name && other.at == at && other.components == components)
            {
                Some(other) => other.values.extend(values),
                None => data.arrays.push(Array { name, at, components, values }),
            }
        }
        Ok(())
    }

    fn unstructured(&self, pieces: &[Node]) -> Result<CellData> {
        let mut data = CellData::default();
        let (mut kinds, mut ends, mut corners) = (Vec::new(), Vec::new(), Vec::new());
        for piece in pieces {
            let (points, cells) = (self.number(*piece, "NumberOfPoints")?, self.number(*piece, "NumberOfCells")?);
            let (first, before) = (data.points.len() / 3, corners.len());
            data.points.extend(self.points(*piece, points)?);
            let arrays = self.arrays(*piece, "Cells");
            let named = |name: &str| {
                let found = arrays.iter().find(|array| array.attribute("Name") == Some(name));
                found.copied().ok_or_else(|| (self.bad)(format!("has Cells without {name}")))
            };
            let offsets = self.singles(named("offsets")?, cells)?;
            let types = self.singles(named("types")?, cells)?;
            let list = self.blocks.values(named("connectivity")?, None)?;
            let offsets = offsets.into_iter().map(|offset| self.whole(offset)).collect::<Result<Vec<u32>>>()?;
            let rising = offsets.windows(2).all(|pair| pair[0] <= pair[1]);
            if !rising || offsets.last().map_or(0, |last| *last as usize) != list.len() {
                return Err((self.bad)(format!("has offsets of cells that do not rise to {}", list.len())));
            }
            for corner in list {
                let corner = self.whole(corner)?;
                // One beyond those of its piece is one beyond those of all.
                corners.push(if corner as usize >= points { u32::MAX } else { corner + first as u32 });
            }
            ends.extend(offsets.into_iter().map(|offset| before + offset as usize));
            kinds.extend(types.into_iter().map(|kind| kind as i64));
            self.add_values(&mut data, *piece, At::Points, points)?;
            self.add_values(&mut data, *piece, At::Cells, cells)?;
            let all = |at: At| if at == At::Points { data.points.len() / 3 } else { ends.len() };
            let short = data.arrays.iter().find(|array| array.values.len() != all(array.at) * array.components);
            if let Some(array) = short {
                return Err((self.bad)(format!(
                    "has the array `{}` in some pieces and not in others",
                    array.name.escape_debug()
                )));
            }
        }
        data.cells = Cells::Listed { kinds, ends, corners };
        Ok(data)
    }

    fn structured(&self, piece: Node, rectilinear: bool) -> Result<CellData> {
        let extent = piece.attribute("Extent").unwrap_or_default();
        let ends: Vec<i64> = extent.split_ascii_whitespace().filter_map(|word| word.parse().ok()).collect();
        let dims: Option<Vec<usize>> = match ends.len() {
            6 => {
                ends.chunks(2).map(|pair| usize::try_from(pair[1].checked_sub(pair[0])?.checked_add(1)?).ok()).collect()
            }
            _ => None,
        };
        let Some([x, y, z]) = dims.and_then(|dims| <[usize; 3]>::try_from(dims).ok()) else {
            return Err((self.bad)(format!("has the Extent `{}`", extent.escape_debug())));
        };
        let count = points_in_rows([x, y, z]).map_err(|what| (self.bad)(format!("has the Extent {extent}, {what}")))?;
        let mut data = CellData { cells: Cells::Structured([x, y, z]), ..CellData::default() };
        self.add_values(&mut data, piece, At::Points, count)?;
        self.add_values(&mut data, piece, At::Cells, (x - 1) * (y - 1) * (z - 1))?;
        if !rectilinear {
            data.points = self.points(piece, count)?;
            return Ok(data);
        }
        let axes = self.arrays(piece, "Coordinates");
        let [a, b, c] = axes[..] else { return Err((self.bad)(format!("has {} arrays of Coordinates", axes.len()))) };
        let (a, b, c) = (self.singles(a, x)?, self.singles(b, y)?, self.singles(c, z)?);
        if data.points.try_reserve_exact(3 * count).is_err() {
            return Err((self.bad)(format!("has {count} points, for which there is not enough memory")));
        }
        for c in &c {
            for b in &b {
                data.points.extend(a.iter().flat_map(|a| [*a, *b, *c]));
            }
        }
        Ok(data)
    }

    fn whole(&self, number: f64) -> Result<u32> {
        let whole = number as u32;
        match f64::from(whole) == number {
            true => Ok(whole),
            false => Err(Error::input(
                self.path.display(),
                format!("has {number} where a point or a number of points stands"),
                "correct the file",
            )),
        }
    }
}
