//! Triangles of glTF 2.0, as text and as bytes: those of the default scene, in its axes.
//!
//! Source: the glTF 2.0 specification of Khronos, sections 3.5 to 3.7 and 4.4. Departures: a document without a
//! default scene shows its first; poses of skins and targets are not taken; sparse accessors are refused.

mod container;
mod data;
mod json;

use std::path::Path;

use glam::{DMat4, DVec3};

use self::container::Container;
use self::data::Data;
use self::json::{Document, Primitive};
use super::parts::Parts;
use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// Entries that copies of a mesh may add to what the files hold: a short file can ask for any number of copies.
const COPIES: usize = 1 << 24;

/// Beginnings of extensions that change nothing of where triangles are.
const HARMLESS: [&str; 5] = ["KHR_materials_", "KHR_texture_", "EXT_texture_", "KHR_lights_", "KHR_animation_"];

/// Whether a file begins like binary glTF, or is an object of JSON that speaks of an asset.
pub fn recognises(bytes: &[u8]) -> bool {
    let key = b"\"asset\"";
    bytes.starts_with(container::MAGIC)
        || unmarked(bytes).trim_ascii_start().starts_with(b"{") && bytes.windows(key.len()).any(|part| part == key)
}

/// # Errors
/// When the document is wrong, asks for what is not read, or its numbers are not there.
pub fn read(path: &Path, bytes: &[u8]) -> Result<Mesh> {
    let Container { text, attached, rest } = if bytes.starts_with(container::MAGIC) {
        container::open(path, bytes)?
    } else {
        Container { text: bytes, attached: None, rest: 0 }
    };
    let document: Document = serde_json::from_slice(unmarked(text)).map_err(|e| {
        Error::input(path.display(), format!("is not a glTF document ({e})"), "correct or complete the file")
    })?;
    if !document.asset.version.starts_with("2.") {
        let problem = format!("is of version {:?} of glTF", document.asset.version);
        return Err(Error::input(path.display(), problem, "convert it to version 2.0"));
    }
    let harmless = |name: &str| HARMLESS.iter().any(|begin| name.starts_with(begin));
    if let Some(name) = document.extensions_required.iter().find(|name| !harmless(name)) {
        let problem = format!("asks for the extension {name:?}, which is not known");
        return Err(Error::input(path.display(), problem, "write it without that extension"));
    }
    let mut scene = Scene {
        data: Data::new(path, &document, attached, bytes.len()),
        parts: Parts::new(path),
        used: 0,
        others: 0,
        posed: 0,
    };
    scene.read(&document)?;
    scene.parts.warn_of_rest(rest);
    scene.parts.finish()
}

fn unmarked(text: &[u8]) -> &[u8] {
    text.strip_prefix(crate::read::BYTE_ORDER_MARK).unwrap_or(text)
}

/// A scene that is being read.
struct Scene<'a> {
    data: Data<'a>,
    parts: Parts<'a>,
    /// Primitives, corners and places of corners so far, over all copies.
    used: usize,
    /// Primitives that are not triangles.
    others: usize,
    /// Primitives whose pose is not taken.
    posed: usize,
}

impl<'a> Scene<'a> {
    /// Reads the meshes of all nodes, each in its place.
    fn read(&mut self, document: &'a Document) -> Result<()> {
        let roots = &self.data.entry(&document.scenes, "scenes", document.scene.unwrap_or(0))?.nodes;
        let mut met = vec![false; document.nodes.len()];
        let mut open: Vec<_> = roots.iter().rev().map(|root| (*root, DMat4::IDENTITY)).collect();
        while let Some((index, parent)) = open.pop() {
            let node = self.data.entry(&document.nodes, "nodes", index)?;
            // Otherwise a circle of nodes would have no end.
            if std::mem::replace(&mut met[index], true) {
                let problem = format!("has nodes[{index}] in two places of its scene");
                return Err(self.data.bad(problem, "give each node one parent"));
            }
            let transform = parent * node.transform();
            open.extend(node.children.iter().rev().map(|child| (*child, transform)));
            let Some(mesh) = node.mesh else { continue };
            for primitive in &self.data.entry(&document.meshes, "meshes", mesh)?.primitives {
                self.posed += usize::from(node.skin.is_some() || !primitive.targets.is_empty());
                self.primitive(primitive, &transform)?;
            }
        }
        if self.others > 0 {
            self.parts.warn(format!("holds {} primitives of points or lines, which are not read", self.others));
        }
        if self.posed > 0 {
            self.parts.warn(format!("holds {} primitives with skins or targets, read without them", self.posed));
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, transform: &DMat4) -> Result<()> {
        self.take(1)?;
        if ![json::TRIANGLES, json::STRIP, json::FAN].contains(&primitive.mode) {
            self.others += 1;
            return Ok(());
        }
        let Some(position) = primitive.attributes.position else {
            return Err(self.data.bad("has a primitive without POSITION", "give its triangles places"));
        };
        let places = self.data.places(position)?;
        self.take(places.len())?;
        let corners = match primitive.indices {
            Some(indices) => self.data.indices(indices)?,
            None => (0..places.len() as u32).collect(),
        };
        self.take(corners.len())?;
        if let Some(corner) = corners.iter().find(|corner| **corner as usize >= places.len()) {
            let problem = format!("has the index {corner} in a primitive of {} vertices", places.len());
            return Err(self.data.bad(problem, "correct the indices"));
        }
        if primitive.mode == json::TRIANGLES && !corners.len().is_multiple_of(3) {
            let problem = format!("has a primitive of {} corners, which make no whole triangles", corners.len());
            return Err(self.data.bad(problem, "give three corners a triangle"));
        }
        let first = self.parts.corners() as u32;
        for place in places {
            let place = DVec3::from_array(place);
            // What lies nowhere is named as the file has it.
            let place = if place.is_finite() { transform.transform_point3(place) } else { place };
            self.parts.corner(place.to_array())?;
        }
        // A mirrored triangle would show its back.
        let mirrored = transform.determinant() < 0.0;
        for [a, b, c] in triangles(primitive.mode, &corners) {
            let [b, c] = if mirrored { [c, b] } else { [b, c] };
            self.parts.polygon(&[a, b, c].map(|corner| first + corner));
        }
        Ok(())
    }

    /// Counts what is about to be added.
    fn take(&mut self, count: usize) -> Result<()> {
        self.used = self.used.saturating_add(count);
        let most = self.data.held.saturating_add(COPIES);
        if self.used > most {
            let problem = format!("asks for {} entries or more over all copies of its meshes", self.used);
            return Err(self.data.bad(problem, &format!("give a scene of at most {most}")));
        }
        Ok(())
    }
}

/// The triangles of a primitive, all with the same side to the front.
fn triangles(mode: u32, corners: &[u32]) -> Vec<[u32; 3]> {
    let triples = corners.windows(3).map(|triple| [triple[0], triple[1], triple[2]]);
    match mode {
        json::STRIP => {
            let turned = |(i, [a, b, c]): (usize, [u32; 3])| if i % 2 == 0 { [a, b, c] } else { [a, c, b] };
            triples.enumerate().map(turned).collect()
        }
        json::FAN => corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]).collect(),
        _ => corners.chunks_exact(3).map(|triple| [triple[0], triple[1], triple[2]]).collect(),
    }
}
