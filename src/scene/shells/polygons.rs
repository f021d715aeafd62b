//! The polygons of a shell.

use rayon::prelude::*;

use super::crossings::Crossings;
use super::lattice::{Faces, too_little_memory};
use crate::error::Result;
use crate::scene::Field;
use crate::scene::mesh::Mesh;

/// The surface of a level, in x, as a mesh in the volume's own axes, about its middle, whose longest side is 1. Triangles go round
/// against the clock as seen from below the level. There are none where all values are below the level nor, where shells are open at the
/// faces, where none is.
///
/// # Errors
/// When there are more polygons than 32 bits count, or there is not enough memory for them.
pub fn polygons(field: &Field, level: f32, faces: Faces) -> Result<Mesh> {
    let name = format!("shell of {} at x = {level}", field.volume.name);
    let mut mesh = Mesh { name, corners: Vec::new(), triangles: Vec::new(), warnings: Vec::new() };
    if !crosses(field, level, faces) {
        return Ok(mesh);
    }
    let crossings = Crossings::new(field, level, faces)?;
    make_room(&mut mesh, field, crossings.count)?;
    let slabs = crossings.slabs();
    let (mut vertices, mut triangles) = (&mut mesh.corners[..], &mut mesh.triangles[..]);
    let mut parts = Vec::with_capacity(slabs.len());
    for (z, pair) in slabs.windows(2).enumerate() {
        let [here, further] = [pair[0], pair[1]];
        let (vertices_here, triangles_here);
        (vertices_here, vertices) = vertices.split_at_mut(further[0] - here[0]);
        (triangles_here, triangles) = triangles.split_at_mut(further[1] - here[1]);
        parts.push((z, (vertices_here, triangles_here)));
    }
    parts.into_par_iter().for_each(|(z, (vertices, triangles))| {
        let (mut vertices, mut triangles) = (vertices.iter_mut(), triangles.iter_mut());
        for word in crossings.words_of(z) {
            crossings.each_vertex(word, |node, axis| {
                if let Some(vertex) = vertices.next() {
                    *vertex = place(&crossings, field, level, node, axis);
                }
            });
            crossings.each_triangle(word, |numbers| {
                if let Some(triangle) = triangles.next() {
                    *triangle = numbers;
                }
            });
        }
    });
    Ok(mesh)
}

/// Whether a shell may have polygons.
pub(super) fn crosses(field: &Field, level: f32, faces: Faces) -> bool {
    let [low, high] = field.extremes();
    (low < level || faces == Faces::Closed) && level <= high
}

/// Takes the memory for so many vertices and triangles.
fn make_room(mesh: &mut Mesh, field: &Field, [vertices, triangles]: [u32; 2]) -> Result<()> {
    let room = mesh.corners.try_reserve_exact(vertices as usize);
    room.and(mesh.triangles.try_reserve_exact(triangles as usize)).map_err(|_| too_little_memory(field))?;
    mesh.corners.resize(vertices as usize, [0.0; 3]);
    mesh.triangles.resize(triangles as usize, [0; 3]);
    Ok(())
}

/// Where a level crosses the edge of a node along an axis.
fn place(crossings: &Crossings, field: &Field, level: f32, node: [usize; 3], axis: usize) -> [f32; 3] {
    let lattice = &crossings.lattice;
    let mut further = node;
    further[axis] += 1;
    let [from, to] = [node, further].map(|node| (f64::from(lattice.value(field, node)), lattice.position(field, node)));
    if from.1 == to.1 {
        // Between a node on a face and the one outside.
        return from.1.as_vec3().to_array();
    }
    // The values are on both sides of the level, so that they differ.
    let part = (f64::from(level) - from.0) / (to.0 - from.0);
    from.1.lerp(to.1, part).as_vec3().to_array()
}
