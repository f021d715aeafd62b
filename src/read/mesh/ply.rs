//! Meshes of the polygon file format of Stanford, as text and as bytes of either order.
//!
//! Source: Greg Turk, "The PLY Polygon File Format" (1994). Of the elements `vertex` and `face` are read, whatever
//! else their rows hold; the other elements are stepped over.

mod header;

use std::path::Path;

use self::header::{Element, Property};
use super::parts::Parts;
use crate::error::{Error, Result};
use crate::read::values::{Fault, Values};
use crate::scene::mesh::Mesh;

const AXES: [&str; 3] = ["x", "y", "z"];

/// The two names that are in use for the corners of a face.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

/// What a column is for.
#[derive(Clone, Copy, PartialEq)]
enum Role {
    Coordinate(usize),
    Corners,
    None,
}

/// Whether a file begins like PLY.
pub fn recognises(bytes: &[u8]) -> bool {
    bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r")
}

/// # Errors
/// When the header is wrong, or the file does not hold what it promises.
pub fn read(path: &Path, bytes: &[u8]) -> Result<Mesh> {
    let (header, data) = header::read(path, bytes)?;
    let mut values = Values::new(header.encoding, data, header.lines);
    let mut parts = Parts::new(path);
    let holds = |element: &Element, wanted: Role| element.properties.iter().any(|p| role(&element.name, p) == wanted);
    let has_places = |element: &Element| (0..AXES.len()).all(|axis| holds(element, Role::Coordinate(axis)));
    let has_corners = |element: &Element| holds(element, Role::Corners);
    if !header.elements.iter().any(has_places) || !header.elements.iter().any(has_corners) {
        let names: Vec<_> = header.elements.iter().map(|e| e.name.as_str()).collect();
        let remedy = "give `vertex` with x, y and z, and `face` with a list vertex_indices";
        return Err(Error::input(path.display(), format!("has the elements [{}]", names.join(", ")), remedy));
    }
    for element in &header.elements {
        let least = element.least_bytes(header.encoding);
        let asked = u128::from(least) * u128::from(element.count);
        let held = values.left();
        // The last number of a text needs no space behind it; of bytes that are short by one, the rows tell.
        if asked > held as u128 + 1 {
            let Element { name, count, .. } = element;
            let problem = format!(
                "promises {count} rows of element {name} of at least {least} bytes, {asked} in all, where {held} bytes are left"
            );
            return Err(Error::input(path.display(), problem, "correct the header, or complete the file"));
        }
        rows(path, element, &mut values, &mut parts)?;
    }
    let left = values.left();
    parts.warn_of_rest(left);
    parts.finish()
}

fn role(element: &str, property: &Property) -> Role {
    match (element, property.length) {
        ("vertex", None) => AXES.iter().position(|axis| *axis == property.name).map_or(Role::None, Role::Coordinate),
        ("face", Some(_)) if CORNERS.contains(&property.name.as_str()) => Role::Corners,
        _ => Role::None,
    }
}

/// Reads the rows of an element; keeps what is of a mesh.
fn rows(path: &Path, element: &Element, values: &mut Values, parts: &mut Parts) -> Result<()> {
    // Rows without columns are nothing, however many there are.
    let count = if element.properties.is_empty() { 0 } else { element.count };
    let roles: Vec<_> = element.properties.iter().map(|property| role(&element.name, property)).collect();
    let (mut entries, mut corners) = (Vec::new(), Vec::new());
    for row in 1..=count {
        let mut place = [0.0; 3];
        for (property, role) in element.properties.iter().zip(&roles) {
            let column = Column { path, element, property, row };
            entries.clear();
            column.read(values, &mut entries)?;
            match *role {
                Role::Coordinate(axis) => place[axis] = entries[0],
                Role::Corners => {
                    corners.clear();
                    for &entry in &entries {
                        corners.push(column.whole(entry)?);
                    }
                    parts.polygon(&corners);
                }
                Role::None => {}
            }
        }
        values.end_row().map_err(|fault| Column { path, element, property: &element.properties[0], row }.bad(fault))?;
        if element.name == "vertex" {
            parts.corner(place)?;
        }
    }
    Ok(())
}

/// An entry of the table, as messages name it.
struct Column<'a> {
    path: &'a Path,
    element: &'a Element,
    property: &'a Property,
    row: u64,
}

impl Column<'_> {
    /// Appends the numbers of the entry: those of its list, or the one that it is.
    fn read(&self, values: &mut Values, entries: &mut Vec<f64>) -> Result<()> {
        let mut next = |number| values.next(number).map_err(|fault| self.bad(fault));
        let count = match self.property.length {
            Some(length) => self.whole(next(length)?)?,
            None => 1,
        };
        for _ in 0..count {
            entries.push(next(self.property.number)?);
        }
        Ok(())
    }

    /// A number of the entry as a length or an index.
    fn whole(&self, value: f64) -> Result<u32> {
        let whole = value as u32;
        if f64::from(whole) == value {
            return Ok(whole);
        }
        let problem = format!("has {value} in {}, where a count or an index stands", self.name());
        Err(Error::input(self.path.display(), problem, "give whole numbers from 0"))
    }

    fn bad(&self, fault: Fault) -> Error {
        let problem = match fault {
            Fault::End => format!("ends in {}, of {} rows", self.name(), self.element.count),
            Fault::Word { line, word } => format!("has `{word}` in line {line}, in {}", self.name()),
        };
        let remedy = "complete the file, or correct its header";
        Error::input(self.path.display(), problem, remedy)
    }

    fn name(&self) -> String {
        format!("row {} of element {} ({})", self.row, self.element.name, self.property.name)
    }
}
