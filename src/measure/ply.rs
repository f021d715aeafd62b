//! Polygons as a PLY file (Turk 1994), binary, least significant byte first.

use glam::{DQuat, DVec3};

use crate::error::{Error, Result};
use crate::scene::mesh::Mesh;

/// Bytes of a vertex, x, y, z and value, and of a triangle, the number of its corners and these.
const VERTEX: usize = 3 * size_of::<f32>() + size_of::<f64>();
const TRIANGLE: usize = 1 + 3 * size_of::<i32>();

/// Shells with their levels, in the volume's own unit, one behind the other in one file; each vertex has the level as its `value`.
/// `turn` leads from their axes, which are the volume's own, to volume space.
///
/// # Errors
/// When there are more vertices than the format's numbers tell apart, or there is not enough memory for the file.
pub fn ply(shells: &[(f64, Mesh)], turn: DQuat) -> Result<Vec<u8>> {
    let sum = |of: fn(&Mesh) -> usize| shells.iter().map(|(_, shell)| of(shell)).sum::<usize>();
    let (vertices, triangles) = (sum(|shell| shell.corners.len()), sum(|shell| shell.triangles.len()));
    let refused = |problem: String| Error::output("the PLY file", problem, "write fewer levels at once");
    if i32::try_from(vertices).is_err() {
        return Err(refused(format!("would have {vertices} vertices, more than its numbers tell apart")));
    }
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment volume space: the longest side of the volume is 1, its middle is 0\n\
         element vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\nproperty double value\n\
         element face {triangles}\nproperty list uchar int vertex_indices\nend_header\n"
    );
    let mut bytes = Vec::new();
    let all = header.len() + VERTEX * vertices + TRIANGLE * triangles;
    bytes.try_reserve_exact(all).map_err(|_| refused(format!("has {all} bytes, and there is not enough memory")))?;
    bytes.extend_from_slice(header.as_bytes());
    for (level, shell) in shells {
        for corner in &shell.corners {
            let place = (turn * DVec3::from_array(corner.map(f64::from))).as_vec3();
            place.to_array().iter().for_each(|number| bytes.extend_from_slice(&number.to_le_bytes()));
            bytes.extend_from_slice(&level.to_le_bytes());
        }
    }
    let mut before = 0;
    for (_, shell) in shells {
        for triangle in &shell.triangles {
            bytes.push(3);
            triangle.iter().for_each(|vertex| bytes.extend_from_slice(&(before + vertex).to_le_bytes()));
        }
        before += shell.corners.len() as u32;
    }
    Ok(bytes)
}
