//! Meshes of Wavefront OBJ: its vertices and faces, all groups together.
//!
//! Source: "Object Files (.obj)" of the Advanced Visualizer's manual, appendix B1. Departures: curves and free-form
//! surfaces are not read, and neither are points and lines; a warning counts them. Materials and normals say nothing
//! of where triangles are.

use std::path::Path;

use super::parts::Parts;
use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// What a file may say first, besides comments.
const BEGINNINGS: [&str; 8] = ["v", "vn", "vt", "o", "g", "s", "mtllib", "usemtl"];

/// Shapes that are not read.
const OTHER_SHAPES: [&str; 5] = ["p", "l", "curv", "curv2", "surf"];

/// Whether the first statement is one of OBJ, and a line gives a vertex.
pub fn recognises(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|b| *b == b'\n').map(<[u8]>::trim_ascii);
    let first = lines.find(|line| !line.is_empty() && !line.starts_with(b"#")).unwrap_or_default();
    let keyword = first.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    let is_vertex = |line: &[u8]| line.starts_with(b"v ");
    BEGINNINGS.iter().any(|word| word.as_bytes() == keyword) && (is_vertex(first) || lines.any(is_vertex))
}

/// # Errors
/// When a vertex lies nowhere, or a face has a corner that is not there.
pub fn read(path: &Path, bytes: &[u8]) -> Result<Mesh> {
    let text = String::from_utf8_lossy(bytes.strip_prefix(crate::read::BYTE_ORDER_MARK).unwrap_or(bytes));
    // A face may come before its vertices.
    let vertices = statements(&text).filter(|(_, line)| line.split_whitespace().next() == Some("v")).count();
    let (mut parts, mut corners, mut others) = (Parts::new(path), Vec::new(), 0);
    for (number, line) in statements(&text) {
        let mut words = line.split_whitespace();
        let place = Place { path, line: number };
        match words.next().unwrap_or_default() {
            "v" => {
                let mut coordinate = || place.coordinate(words.next());
                let corner = [coordinate()?, coordinate()?, coordinate()?];
                parts.corner(corner)?;
            }
            "f" => {
                corners.clear();
                for word in words {
                    corners.push(place.corner(word, parts.corners(), vertices)?);
                }
                if corners.len() < 3 {
                    let problem = format!("has a face of {} corners", corners.len());
                    return Err(place.bad(&problem, "give a face at least three"));
                }
                parts.polygon(&corners);
            }
            other => others += usize::from(OTHER_SHAPES.contains(&other)),
        }
    }
    if others > 0 {
        parts.warn(format!("holds points, lines, curves or surfaces in {others} lines, which are not read"));
    }
    parts.finish()
}

/// The statements with the numbers of the lines where they begin: lines that end in a backslash go on.
fn statements(text: &str) -> impl Iterator<Item = (usize, String)> {
    let mut lines = text.lines().zip(1..);
    std::iter::from_fn(move || {
        let (line, number) = lines.next()?;
        let mut whole = line.to_owned();
        while whole.ends_with('\\') {
            whole.pop();
            whole.push(' ');
            whole.push_str(lines.next().unwrap_or_default().0);
        }
        Some((number, whole))
    })
}

/// A line, as messages name it.
struct Place<'a> {
    path: &'a Path,
    line: usize,
}

impl Place<'_> {
    fn coordinate(&self, word: Option<&str>) -> Result<f64> {
        let Some(word) = word else {
            return Err(self.bad("has a vertex of fewer than three coordinates", "give x, y and z"));
        };
        word.parse().map_err(|_| self.bad(&format!("has the coordinate `{word}`"), "give a number"))
    }

    /// The place of a corner, counted from 1 or back from the last vertex so far, among the vertices of the file.
    fn corner(&self, word: &str, so_far: usize, vertices: usize) -> Result<u32> {
        let number = word.split('/').next().unwrap_or_default();
        let index = match number.parse::<i64>() {
            Ok(number @ 1..) => usize::try_from(number - 1).ok(),
            Ok(back @ ..0) => usize::try_from(back.unsigned_abs()).ok().and_then(|back| so_far.checked_sub(back)),
            Ok(0) | Err(_) => None,
        };
        index.filter(|index| *index < vertices).and_then(|index| u32::try_from(index).ok()).ok_or_else(|| {
            let problem =
                format!("has the corner `{word}`, where there are {vertices} vertices, {so_far} of them before");
            self.bad(&problem, "count from 1, or back from -1")
        })
    }

    fn bad(&self, problem: &str, remedy: &str) -> Error {
        Error::input(self.path.display(), format!("{problem} in line {}", self.line), remedy)
    }
}
