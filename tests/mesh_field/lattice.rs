//! Where the voxels lie, how many there are, and what is refused.

use depthleap::scene::Volume;
use depthleap::scene::builtin::{MAX_SIZE, MAX_VOXELS};
use depthleap::scene::mesh::{Mesh, shape};
use depthleap::scene::mesh_field::{self, DEFAULT_SIDE};

use super::{BAND, soup};

/// A box with these sides.
fn cuboid(sides: [f32; 3]) -> Mesh {
    let cube = shape("box").unwrap();
    let corners = cube.corners.iter().map(|c| [0, 1, 2].map(|a| c[a] * sides[a] + 3.0)).collect();
    Mesh { corners, ..cube }
}

/// The values on the six faces of a volume.
fn on_faces(volume: &Volume) -> Vec<f64> {
    let [nx, ny, nz] = volume.dims;
    let at_end = |i: usize, n: usize| i == 0 || i == n - 1;
    let on_face = |i: &usize| at_end(i % nx, nx) || at_end(i / nx % ny, ny) || at_end(i / (nx * ny), nz);
    (0..volume.voxels.len()).filter(on_face).map(|i| volume.voxels.get(i)).collect()
}

#[test]
fn the_band_and_no_more_is_left_to_each_side_of_the_longest_extent() {
    for (sides, dims, band) in [
        ([1.0, 1.0, 1.0], [32; 3], 4.0),
        ([2.0, 1.0, 0.5], [40, 40, 20], 4.0),
        ([1.0, 1.0, 3.0], [20, 24, 60], 2.5),
        ([1.0, 0.25, 1.0], [64, 30, 64], 10.0),
    ] {
        let volume = mesh_field::volume(&cuboid(sides), Some(dims), band).unwrap();
        assert_eq!(volume.dims, dims);
        let fitting = |a: usize| f64::from(sides[a]) / (dims[a] as f64 - 2.0 * band - 1.0);
        let spacing = fitting(0).max(fitting(1)).max(fitting(2));
        assert!(volume.spacing.iter().all(|s| (s / spacing - 1.0).abs() < 1e-6), "{:?} {spacing}", volume.spacing);
        assert!(on_faces(&volume).iter().all(|value| *value == -band), "{sides:?}: the faces are not all outside");
        let greatest = (0..volume.voxels.len()).map(|i| volume.voxels.get(i)).fold(0.0, f64::max);
        assert!(greatest > 0.0 && greatest <= band);
    }
}

#[test]
fn without_dims_the_longest_side_has_its_voxels_and_the_others_what_they_take() {
    let room = 2.0 * BAND + 1.0;
    for sides in [[0.1, 0.05, 1.0], [1.0, 0.031, 0.1], [0.2, 3.0, 0.0001]] {
        let volume = mesh_field::volume(&cuboid(sides), None, BAND).unwrap();
        let longest = sides.into_iter().fold(0.0f32, f32::max);
        let spacing = f64::from(longest) / (DEFAULT_SIDE as f64 - room);
        for a in 0..3 {
            let takes = f64::from(sides[a]) / spacing + room;
            let (n, least) = (volume.dims[a] as f64, room + 1.0);
            assert!(n >= takes - 1e-3 && n < (takes + 1.001).max(least + 0.5), "{sides:?}: {:?}", volume.dims);
        }
        assert_eq!(volume.dims.into_iter().max(), Some(DEFAULT_SIDE));
        assert!((volume.spacing[0] / spacing - 1.0).abs() < 1e-5);
    }
}

#[test]
fn the_note_says_what_the_values_are() {
    let volume = mesh_field::volume(&shape("box").unwrap(), Some([24, 25, 26]), 3.0).unwrap();
    let [note] = &volume.notes[..] else { panic!("{:?}", volume.notes) };
    for part in ["12 triangles of builtin:box", "24 x 25 x 26 voxels", "above 0 inside", "clamped to 3", "in voxels"] {
        assert!(note.contains(part), "no `{part}` in {note}");
    }
}

#[test]
fn what_cannot_be_is_refused_with_what_to_do() {
    let cube = shape("box").unwrap();
    let refused = |mesh: &Mesh, dims: Option<[usize; 3]>, band: f64, parts: &[&str]| {
        let error = mesh_field::volume(mesh, dims, band).unwrap_err().to_string();
        for part in parts.iter().chain([&mesh.name.as_str()]) {
            assert!(error.contains(part), "no `{part}` in {error}");
        }
    };
    let most = MAX_SIZE.to_string();
    refused(&cube, Some([MAX_SIZE + 1, 10, 10]), BAND, &["volume.dims", "2049 x 10 x 10", &most]);
    refused(&cube, Some([MAX_SIZE; 3]), BAND, &["volume.dims", &MAX_VOXELS.to_string()]);
    refused(&cube, Some([usize::MAX; 3]), BAND, &["volume.dims", "keep"]);
    refused(&cube, Some([64, 9, 64]), BAND, &["64 x 9 x 64", "at least 10", "volume.band"]);
    refused(&cube, Some([0, 0, 0]), BAND, &["0 x 0 x 0", "at least 10"]);
    refused(&cube, None, 200.0, &["a band of 200", "at least 402"]);
    let line = soup(&[[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], [[5.0; 3]; 3]]);
    refused(&line, None, BAND, &["no triangle with an area (2 triangles)", "give a mesh with faces"]);
    refused(&Mesh { name: "empty.stl".to_owned(), ..Mesh::default() }, None, BAND, &["no triangle with an area"]);
    for wrong in [f32::NAN, f32::INFINITY] {
        let mesh = soup(&[[[0.0; 3], [1.0, 0.0, 0.0], [0.0, wrong, 0.0]]]);
        refused(&mesh, None, BAND, &["vertex number 3", "finite"]);
    }
    // The least there may be.
    assert_eq!(mesh_field::volume(&cube, Some([10; 3]), BAND).unwrap().dims, [10; 3]);
}
