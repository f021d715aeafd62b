//! Distance fields of meshes: distances and sides held against closed forms and against all triangles one by one.

mod distances;
mod lattice;
#[path = "../random/mod.rs"]
mod random;
mod scenes;
mod sides;
mod winding;

use depthleap::math::triangle::Triangle;
use depthleap::scene::Volume;
use depthleap::scene::mesh::Mesh;
use depthleap::scene::mesh_field;
use glam::DVec3;
use random::Random;

const BAND: f64 = 4.0;

/// The field of a mesh in so many voxels, each with its centre in the mesh's own space.
fn field(mesh: &Mesh, dims: [usize; 3]) -> (Volume, Vec<(DVec3, f64)>) {
    let volume = mesh_field::volume(mesh, Some(dims), BAND).unwrap();
    let [least, greatest] = mesh.bounds();
    let (middle, spacing) = (0.5 * (least + greatest), volume.spacing[0]);
    let [nx, ny, nz] = volume.dims;
    let voxel = |i: usize| {
        let at = [i % nx, i / nx % ny, i / (nx * ny)].map(|i| i as f64);
        let from_middle = DVec3::from_array(at) - 0.5 * (DVec3::new(nx as f64, ny as f64, nz as f64) - 1.0);
        (middle + spacing * from_middle, volume.voxels.get(i))
    };
    let voxels = (0..volume.voxels.len()).map(voxel).collect();
    (volume, voxels)
}

/// A mesh of triangles with their own corners each.
fn soup(triangles: &[[[f32; 3]; 3]]) -> Mesh {
    let number = |i: usize| [3 * i, 3 * i + 1, 3 * i + 2].map(|corner| corner as u32);
    Mesh {
        name: "soup.ply".to_owned(),
        corners: triangles.as_flattened().to_vec(),
        triangles: (0..triangles.len()).map(number).collect(),
        warnings: Vec::new(),
    }
}

fn random_point(random: &mut Random) -> DVec3 {
    DVec3::new(random.next(), random.next(), random.next())
}

/// Triangles of all sizes and shapes within a unit cube.
fn random_soup(random: &mut Random, count: usize) -> Mesh {
    let mut triangle = || {
        let (middle, size) = (random_point(random), random.next() * random.next());
        [0, 1, 2].map(|_| (middle + size * (random_point(random) - 0.5)).as_vec3().to_array())
    };
    let triangles: Vec<_> = (0..count).map(|_| triangle()).collect();
    soup(&triangles)
}

/// Both as one mesh.
fn together(one: &Mesh, other: &Mesh) -> Mesh {
    let mut mesh = one.clone();
    let first = one.corners.len() as u32;
    mesh.corners.extend(&other.corners);
    mesh.triangles.extend(other.triangles.iter().map(|triangle| triangle.map(|corner| corner + first)));
    mesh
}

fn moved(mesh: &Mesh, by: [f32; 3]) -> Mesh {
    let corners = mesh.corners.iter().map(|c| [c[0] + by[0], c[1] + by[1], c[2] + by[2]]).collect();
    Mesh { corners, ..mesh.clone() }
}

fn turned_over(mesh: &Mesh) -> Mesh {
    Mesh { triangles: mesh.triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect(), ..mesh.clone() }
}

/// The triangles in the mesh's own space.
fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let corner = |i: u32| DVec3::from_array(mesh.corners[i as usize].map(f64::from));
    mesh.triangles.iter().map(|triangle| Triangle::new(triangle.map(corner))).collect()
}

/// The winding number by all triangles: each covers as much of a unit sphere as its three angles there are more than pi.
fn winding_of_all(triangles: &[Triangle], point: DVec3) -> f64 {
    let cover = |triangle: &Triangle| {
        let [a, b, c] = triangle.corners.map(|corner| (corner - point).normalize());
        let angle = |at: DVec3, one: DVec3, other: DVec3| {
            let (one, other) = (at.cross(one), at.cross(other));
            one.cross(other).length().atan2(one.dot(other))
        };
        let excess = angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - std::f64::consts::PI;
        excess.abs() * a.dot(b.cross(c)).signum() / (4.0 * std::f64::consts::PI)
    };
    triangles.iter().map(cover).sum()
}
