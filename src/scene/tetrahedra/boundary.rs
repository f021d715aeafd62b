//! Faces of the boundary: which lie beside each other, and how often rays of a view enter by them.

use glam::DVec3;
use rayon::prelude::*;

use super::seen::Line;
use super::{FACES, NOTHING, Tetrahedra};
use crate::math::ray::ViewRays;
use crate::scene::region::Region;

/// The faces of the boundary beside each: over the edges from each of its corners to the next, in the order of [`FACES`].
pub fn beside(cells: &[[u32; 4]], boundary: &[u32]) -> Vec<[u32; 3]> {
    let corners = |side: u32| FACES[side as usize % 4].map(|corner| cells[side as usize / 4][corner]);
    let mut edges: Vec<([u32; 2], u32, usize)> = Vec::with_capacity(3 * boundary.len());
    for (face, side) in (0u32..).zip(boundary) {
        let corners = corners(*side);
        edges.extend((0..3).map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % 3]);
            ([a.min(b), a.max(b)], face, i)
        }));
    }
    edges.par_sort_unstable();
    let mut beside = vec![[NOTHING; 3]; boundary.len()];
    for shared in edges.chunk_by(|a, b| a.0 == b.0) {
        // Of an edge with more than two faces any other will do: who looks there is off by a part of a pixel.
        for (i, (_, face, place)) in shared.iter().enumerate() {
            let (_, other, _) = shared[(i + 1) % shared.len()];
            beside[*face as usize][*place] = if other == *face { NOTHING } else { other };
        }
    }
    beside
}

/// A mesh of cells as the rays of a view meet it.
#[derive(Clone, Debug, PartialEq)]
pub struct CellsView {
    /// How often a ray enters the mesh at the most, beyond where it begins.
    pub entries: u32,
    /// By pixels of the region, one more than the face of the boundary behind which each ray begins, 0 for none; none where no ray begins
    /// within the mesh.
    pub begins: Option<Vec<u32>>,
    /// Depth of the middle of the mesh.
    pub middle: f64,
    /// Whether mesh data are in storage buffers, since buffers of texels have too few for them.
    pub in_storage: bool,
}

impl CellsView {
    /// As seen by these rays through the pixels of a region; `most_texels`: the most that a buffer has, where that is known.
    pub fn new(mesh: &Tetrahedra, rays: &ViewRays, region: Region, most_texels: Option<u32>) -> Self {
        let half = 0.5 * mesh.extent;
        let depth = rays.to_picture().row(2);
        let nearest = depth.dot(DVec3::select(depth.cmpgt(DVec3::ZERO), -half, half) - rays.origin);
        let begins = (nearest <= rays.near).then(|| begins(mesh, rays, region));
        let begins = begins.filter(|faces| faces.iter().any(|face| *face > 0));
        let in_storage = most_texels.is_some_and(|most| mesh.rows() > most as usize);
        Self { entries: entries(mesh, rays, region), begins, middle: -depth.dot(rays.origin), in_storage }
    }

    /// Layers of faces by which rays enter, that behind which they begin among them.
    pub fn layers(&self) -> u32 {
        self.entries + u32::from(self.begins.is_some())
    }
}

fn pixels(region: Region) -> impl IndexedParallelIterator<Item = [u32; 2]> {
    let width = region.width.max(1) as usize;
    (0..region.pixels() as usize)
        .into_par_iter()
        .map(move |i| [region.x + (i % width) as u32, region.y + (i / width) as u32])
}

/// One more than the face behind which each ray begins.
fn begins(mesh: &Tetrahedra, rays: &ViewRays, region: Region) -> Vec<u32> {
    let of = |[column, row]: [u32; 2]| {
        let ray = rays.of(column, row);
        let line = Line::new(ray.origin, ray.direction);
        let entries = mesh.entries(&line, (ray.origin, ray.direction));
        let in_front = entries.into_iter().filter(|entry| entry.at.depth < rays.near);
        let goes_on = |entry: &super::Entry| mesh.chain(&line, *entry).any(|way| way.to.depth > rays.near);
        in_front.rev().find(goes_on).map_or(0, |entry| mesh.face_number(entry.side) + 1)
    };
    pixels(region).map(of).collect()
}

/// How many faces a ray enters by at the most, beyond where it begins: those whose outline in the picture has the middle of a pixel.
fn entries(mesh: &Tetrahedra, rays: &ViewRays, region: Region) -> u32 {
    let width = region.width as usize;
    let mut counts = vec![0u32; region.pixels() as usize];
    let to_picture = rays.to_picture();
    for side in &mesh.boundary {
        let corners = FACES[*side as usize % 4].map(|corner| mesh.point(mesh.cells[*side as usize / 4][corner]));
        let placed = corners.map(|corner| to_picture * (corner - rays.origin));
        if placed.iter().all(|place| place.z < rays.near) {
            continue;
        }
        // Near the eye, where outlines have no end, every pixel is asked.
        let beyond = rays.parallel() || placed.iter().all(|place| place.z >= rays.near);
        let outline = placed.map(|place| if rays.parallel() { place.truncate() } else { place.truncate() / place.z });
        let range = |axis: usize, first: u32, count: u32| {
            let at = outline.map(|place| place[axis] - f64::from(first));
            let (low, high) = (
                at.iter().copied().fold(f64::INFINITY, f64::min),
                at.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            );
            if beyond {
                ((low - 0.5).max(0.0) as u32, (high + 0.5).clamp(0.0, f64::from(count)) as u32)
            } else {
                (0, count)
            }
        };
        let (columns, rows) = (range(0, region.x, region.width), range(1, region.y, region.height));
        for row in rows.0..rows.1 {
            for column in columns.0..columns.1 {
                let ray = rays.of(region.x + column, region.y + row);
                counts[row as usize * width + column as usize] += u32::from(enters(corners, ray.origin, ray.direction));
            }
        }
    }
    counts.into_iter().max().unwrap_or(0)
}

/// Whether a line enters by a triangle, or passes through its edges.
fn enters(corners: [DVec3; 3], origin: DVec3, direction: DVec3) -> bool {
    let arms = corners.map(|corner| corner - origin);
    (0..3).all(|i| direction.dot(arms[i].cross(arms[(i + 1) % 3])) <= 0.0)
}
