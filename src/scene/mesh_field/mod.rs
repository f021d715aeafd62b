//! The distance field of a mesh: a volume that holds in each voxel how far its surface is away, and on which side of it the voxel
//! lies.
//!
//! - Values are distances between voxel centres and the nearest point of any triangle, exact but for the rounding to f32, in
//!   voxels: in units of the volume's spacing, which is the same along all axes.
//! - They are above 0 inside and below 0 outside, so that `surface.iso = 0` shows the mesh and its inside counts as full.
//! - Those beyond the band are clamped to it. All faces of the volume hold the far end of the band, outside.
//! - Inside is where the winding number of the mesh is at least 1/2 or at most -1/2 (Jacobson13): the
//!   way its faces are turned makes no difference as long as it is one way, pieces may cut each other, and holes are closed by
//!   what the rest of the mesh covers. Where they are closed a distance changes its sign without being 0.
//! - Triangles without an area have no part in distances.

mod far;
mod fill;
mod lattice;
mod skin;

use rayon::prelude::*;

pub use skin::{Skin, Winding};

use self::lattice::Lattice;
use super::mesh::{Mesh, open_edges};
use super::volume::{Volume, Voxels};
use crate::error::{Error, Result};
use crate::math::bvh::Bounds;
use crate::math::triangle::Triangle;
use glam::DVec3;

pub use lattice::DEFAULT_SIDE;

/// Voxels to each side of the surface in which distances are not clamped, where nothing is said: central differences at the
/// surface read voxels up to three away.
pub const DEFAULT_BAND: f64 = 4.0;

/// The distance field of a mesh.
///
/// `dims`: voxels along x, y and z; without, [`DEFAULT_SIDE`] along the mesh's longest side, and as many along the others as it
/// takes. `band`: voxels to each side of the surface in which distances are not clamped; finite, above 0. The middle of the mesh's
/// box is that of the volume; one side of the box at least leaves no more room than the band and half a voxel to each side of it.
///
/// # Errors
/// When a corner lies nowhere, no triangle has an area, there are too few voxels for the band or more than
/// [`MAX_VOXELS`](super::builtin::MAX_VOXELS), or not enough memory for them.
pub fn volume(mesh: &Mesh, dims: Option<[usize; 3]>, band: f64) -> Result<Volume> {
    let bad = |problem: String, remedy: &str| Err(Error::input(&mesh.name, problem, remedy));
    if let Some(number) = mesh.corners.iter().position(|corner| !corner.iter().all(|x| x.is_finite())) {
        let problem = format!("has vertex number {} at {:?}", number + 1, mesh.corners[number]);
        return bad(problem, "give finite coordinates");
    }
    let corners: Vec<DVec3> = mesh.corners.iter().map(|corner| DVec3::from_array(corner.map(f64::from))).collect();
    let with_area: Vec<[DVec3; 3]> =
        placed(mesh, &corners).filter(|triangle| Triangle::new(*triangle).has_area()).collect();
    if with_area.is_empty() {
        let problem = format!("has no triangle with an area ({} triangles)", mesh.triangles.len());
        return bad(problem, "give a mesh with faces");
    }
    let bounds = Bounds::around(with_area.iter().copied().flatten());
    let lattice = Lattice::around(bounds, dims, band)
        .map_err(|wrong| Error::input(format!("{}: distance field", mesh.name), wrong.problem, wrong.remedy))?;
    let corners: Vec<DVec3> = corners.iter().map(|corner| lattice.to_voxels(*corner)).collect();
    let open = open_edges(&mesh.triangles, &mesh.corners);
    let skin = Skin::new(placed(mesh, &corners).map(Triangle::new).collect(), &open);
    let Ok(voxels) = fill::fill(&skin, lattice.dims, band) else {
        let problem = format!("needs a distance field of {:?} voxels, and there is not enough memory", lattice.dims);
        return bad(problem, "give smaller dims");
    };
    let has_inside = voxels.par_iter().any(|distance| *distance > 0.0);
    let mut volume = Volume::new(&mesh.name, lattice.dims, [lattice.spacing; 3], Voxels::F32(voxels))?;
    volume.notes.push(note(mesh, &lattice, band, mesh.triangles.len() - with_area.len()));
    volume.warnings.clone_from(&mesh.warnings);
    volume.warnings.extend(warning(&mesh.name, has_inside, open.len()));
    Ok(volume)
}

/// The triangles of a mesh whose corners are these.
fn placed(mesh: &Mesh, corners: &[DVec3]) -> impl Iterator<Item = [DVec3; 3]> {
    mesh.triangles.iter().map(|triangle| triangle.map(|corner| corners[corner as usize]))
}

/// What a user may want to know of the field.
fn note(mesh: &Mesh, lattice: &Lattice, band: f64, left_out: usize) -> String {
    let without = match left_out {
        0 => String::new(),
        1 => ", without 1 that has no area".to_owned(),
        n => format!(", without {n} that have no area"),
    };
    let [x, y, z] = lattice.dims;
    format!(
        "distances from the {} triangles of {}{without}, in {x} x {y} x {z} voxels {} apart in the mesh's unit: the values are in \
         voxels, above 0 inside, clamped to {band}",
        mesh.triangles.len(),
        mesh.name,
        lattice.spacing,
    )
}

/// That the inside of a mesh is not what its surface encloses.
fn warning(name: &str, has_inside: bool, open: usize) -> Option<String> {
    let at = match open {
        0 => String::new(),
        1 => " is open at 1 edge and".to_owned(),
        n => format!(" is open at {n} edges and"),
    };
    match (has_inside, open) {
        (true, 0) => None,
        (true, _) => Some(format!(
            "the mesh {name}{at} has an inside all the same, where its winding number is at least 1/2: there distances change their \
             sign without being 0; close it, or turn its faces one way"
        )),
        (false, 0) => Some(format!(
            "the mesh {name} has no inside that holds a voxel's centre: every distance is that of outside, not above 0, and an \
             iso-surface shows it below 0 only; give larger volume.dims, or an iso such as -1"
        )),
        (false, _) => Some(format!(
            "the mesh {name}{at} has no inside (its winding number is nowhere 1/2): every distance is that of outside, not above 0, \
             and an iso-surface shows it below 0 only; close it, turn its faces one way, or give an iso such as -1"
        )),
    }
}
