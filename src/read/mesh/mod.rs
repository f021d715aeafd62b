//! Meshes: triangles of files.
//!
//! **To add a mesh format**: one file here, one line in [`MESH_FORMATS`], the robustness tests of `tests/read`.

mod gltf;
mod obj;
mod parts;
mod ply;
mod stl;

use std::path::Path;

use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// A format of meshes.
pub struct MeshFormat {
    pub name: &'static str,
    /// Usual endings of its files, lower case.
    pub extensions: &'static [&'static str],
    /// Whether a file of these bytes is one.
    recognises: fn(&[u8]) -> bool,
    read: fn(&Path, &[u8]) -> Result<Mesh>,
}

/// In the order in which they are tried.
pub static MESH_FORMATS: [MeshFormat; 4] = [
    MeshFormat { name: "PLY", extensions: &["ply"], recognises: ply::recognises, read: ply::read },
    MeshFormat { name: "glTF", extensions: &["gltf", "glb"], recognises: gltf::recognises, read: gltf::read },
    MeshFormat { name: "STL", extensions: &["stl"], recognises: stl::recognises, read: stl::read },
    MeshFormat { name: "OBJ", extensions: &["obj"], recognises: obj::recognises, read: obj::read },
];

/// The mesh in a file: by its bytes, else by its ending.
///
/// # Errors
/// When the file cannot be read, is of no known format, or does not hold what it says.
pub fn mesh(path: &Path) -> Result<Mesh> {
    let bytes = super::bytes(path)?;
    let by_content = MESH_FORMATS.iter().find(|format| (format.recognises)(&bytes));
    match by_content.or_else(|| by_extension(path)) {
        Some(format) => (format.read)(path, &bytes),
        None => {
            let named = |format: &MeshFormat| format!("{} (.{})", format.name, format.extensions.join(", ."));
            let known: Vec<_> = MESH_FORMATS.iter().map(named).collect();
            let problem = format!("is of no known mesh format ({} bytes)", bytes.len());
            Err(Error::input(path.display(), problem, format!("give a file of {}", known.join(", "))))
        }
    }
}

/// The format of meshes that a file's ending stands for.
pub fn by_extension(path: &Path) -> Option<&'static MeshFormat> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    MESH_FORMATS.iter().find(|format| format.extensions.contains(&extension.as_str()))
}
