//! How a volume lies: orders and mirrorings of its axes, rotations, shear, and spaces that are left-handed.

use depthleap::read::ReadChoice;
use depthleap::scene::volume::Volume;
use glam::{DMat3, DQuat, DVec3};

use crate::kit::{by_index, bytes, chosen, counted, places, says, volume};

const SIZES: [usize; 3] = [2, 3, 4];
const SPACING: [f64; 3] = [1.5, 0.75, 2.0];

/// `space directions` along the columns of `axes`, as far apart as [`SPACING`].
fn directions(axes: DMat3) -> String {
    let words = [0, 1, 2].map(|a| {
        let [x, y, z] = (axes.col(a) * SPACING[a]).to_array();
        format!("({x},{y},{z})")
    });
    format!("space: left-posterior-superior\nspace directions: {}", words.join(" "))
}

/// Where the file's voxels lie by its own words: index a of a voxel goes along column a of `axes`.
fn said(axes: DMat3) -> Vec<DVec3> {
    let centre = |a: usize| 0.5 * (SIZES[a] as f64 - 1.0);
    let place = |i: usize| {
        let index = [i % SIZES[0], i / SIZES[0] % SIZES[1], i / (SIZES[0] * SIZES[1])];
        axes * DVec3::from_array([0, 1, 2].map(|a| (index[a] as f64 - centre(a)) * SPACING[a]))
    };
    (0..SIZES.iter().product()).map(place).collect()
}

/// Every voxel lies where the file says, rounding aside.
fn lies(volume: &Volume, axes: DMat3) {
    for ((value, place), said) in places(volume).into_iter().zip(said(axes)) {
        assert!((place - said).length() < 1e-12, "voxel {value}: {place} {said}");
    }
}

/// The 48 orders and mirrorings of three axes: column a is the signed unit vector along which axis a goes.
fn signed_permutations() -> Vec<DMat3> {
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let matrix = |order: [usize; 3], signs: usize| {
        let column = |a: usize| DVec3::AXES[order[a]] * if signs >> a & 1 == 1 { -1.0 } else { 1.0 };
        DMat3::from_cols(column(0), column(1), column(2))
    };
    orders.into_iter().flat_map(|order| (0..8).map(move |signs| matrix(order, signs))).collect()
}

/// The voxels in the order that `axes`, a signed permutation, puts them into.
fn permuted(axes: DMat3) -> (Vec<usize>, Vec<u8>) {
    let axis_along = |row: usize| (0..3).find(|a| axes.col(*a)[row] != 0.0).unwrap();
    let from = [0, 1, 2].map(axis_along);
    let dims = from.map(|a| SIZES[a]);
    let voxel = |i: usize| {
        let at = [i % dims[0], i / dims[0] % dims[1], i / (dims[0] * dims[1])];
        let mut index = [0; 3];
        for row in 0..3 {
            let a = from[row];
            index[a] = if axes.col(a)[row] < 0.0 { SIZES[a] - 1 - at[row] } else { at[row] };
        }
        (index[0] + SIZES[0] * (index[1] + SIZES[1] * index[2])) as u8
    };
    (dims.to_vec(), (0..24).map(voxel).collect())
}

#[test]
fn every_order_and_mirroring_of_the_axes_is_exact() {
    for axes in signed_permutations() {
        let lines = directions(axes);
        let read = volume(&SIZES, &lines);
        let (dims, voxels) = permuted(axes);
        assert_eq!((read.dims.to_vec(), bytes(&read)), (dims, &voxels[..]), "{lines}");
        assert_eq!((read.turn, read.warnings.len()), (DQuat::IDENTITY, 0), "{lines}");
        // As exact as the numbers 1.5, 0.75 and 2 are.
        for ((_, place), said) in places(&read).into_iter().zip(said(axes)) {
            assert_eq!(place, said);
        }
        let moved = axes != DMat3::IDENTITY;
        assert_eq!(says(&read.notes, &["as `space directions` say (orientation = file)"]), moved, "{:?}", read.notes);
    }
}

#[test]
fn orientation_by_index_leaves_every_voxel_where_it_is_stored() {
    for axes in signed_permutations() {
        let read = chosen(&SIZES, &directions(axes), &by_index()).unwrap();
        assert_eq!((read.dims, read.spacing, bytes(&read)), (SIZES, SPACING, &counted(&SIZES)[..]));
        let (moved, mirrored) = (axes != DMat3::IDENTITY, axes.determinant() < 0.0);
        assert_eq!((read.turn, read.warnings.len()), (DQuat::IDENTITY, usize::from(mirrored)));
        assert_eq!(says(&read.notes, &["along its own axes (orientation = index)"]), moved);
        assert_eq!(says(&read.warnings, &["the picture shows the volume mirrored"]), mirrored, "{:?}", read.warnings);
    }
}

/// A rotation by less than 45 degrees leaves the voxels in their order, and is the turn.
#[test]
fn a_tilt_is_the_turn_and_moves_no_voxel() {
    for (axis, degrees) in [
        (DVec3::X, 30.0),
        (DVec3::Y, -20.0),
        (DVec3::Z, 44.0),
        (DVec3::new(1.0, 2.0, -2.0) / 3.0, 10.0),
        (DVec3::new(2.0, -1.0, 2.0) / 3.0, 0.01),
    ] {
        let turn = DQuat::from_axis_angle(axis, f64::to_radians(degrees));
        let axes = DMat3::from_quat(turn);
        let read = volume(&SIZES, &directions(axes));
        assert_eq!((read.dims, bytes(&read)), (SIZES, &counted(&SIZES)[..]));
        assert!(read.turn.dot(turn).abs() > 1.0 - 1e-14, "{} {turn}", read.turn);
        let shown = format!("turned by {:.3} degrees", f64::abs(degrees));
        assert!(says(&read.notes, &[&shown]), "{:?}", read.notes);
        lies(&read, axes);
        let index = chosen(&SIZES, &directions(axes), &by_index()).unwrap();
        assert_eq!((index.turn, bytes(&index)), (DQuat::IDENTITY, &counted(&SIZES)[..]));
    }
}

/// A rotation is what is left once the axes are put into the nearest order.
#[test]
fn a_rotation_on_top_of_any_order_is_the_turn() {
    let turn = DQuat::from_axis_angle(DVec3::new(2.0, 2.0, 1.0) / 3.0, 17f64.to_radians());
    for order in signed_permutations() {
        let axes = DMat3::from_quat(turn) * order;
        let read = volume(&SIZES, &directions(axes));
        let (dims, voxels) = permuted(order);
        assert_eq!((read.dims.to_vec(), bytes(&read)), (dims, &voxels[..]));
        assert!(read.turn.dot(turn).abs() > 1.0 - 1e-14, "{} {turn}", read.turn);
        assert_eq!(read.warnings, [""; 0]);
        lies(&read, axes);
    }
}

/// Whatever the rotation is, every voxel lies where the file says; also where two orders are equally near.
#[test]
fn every_rotation_lies_as_the_file_says() {
    for step in 0..72 {
        for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE.normalize(), DVec3::new(0.6, 0.0, -0.8)] {
            let axes = DMat3::from_axis_angle(axis, f64::to_radians(5.0 * f64::from(step)));
            for mirror in [1.0, -1.0] {
                let axes = axes * DMat3::from_diagonal(DVec3::new(mirror, 1.0, 1.0));
                lies(&volume(&SIZES, &directions(axes)), axes);
            }
        }
    }
}

/// Four digits, as some writers give them, are as good as a rotation.
#[test]
fn rounded_directions_are_no_shear() {
    let lines = "space directions: (0.7071,0.7071,0) (-0.7071,0.7071,0) (0,0,1)";
    let read = volume(&SIZES, lines);
    assert_eq!(read.warnings, [""; 0]);
    assert!(says(&read.notes, &["turned by 45.000 degrees"]), "{:?}", read.notes);
    let nearly = volume(&SIZES, "space directions: (1,1e-8,0) (-1e-8,1,0) (0,0,1)");
    assert_eq!((nearly.turn, nearly.notes.len()), (DQuat::IDENTITY, 0));
}

#[test]
fn a_sheared_volume_is_drawn_along_its_own_axes_with_a_warning() {
    for (lines, told) in [
        ("space directions: (1,0,0) (0,1,0) (0,0.6,0.8)", "axes 1 and 2 meet at 53.1 degrees"),
        ("space directions: (1,0,0) (-0.5,0.5,0) (0,0,1)", "axes 0 and 1 meet at 135.0 degrees"),
        ("space directions: (-1,0,0) (0,-1,0) (1,0,1)", "axes 0 and 2 meet at 135.0 degrees"),
        ("space directions: (1,0,0) (1,0,0) (0,0,1)", "axes 0 and 1 meet at 0.0 degrees"),
    ] {
        for choice in [ReadChoice::default(), by_index()] {
            let read = chosen(&SIZES, lines, &choice).unwrap();
            assert_eq!((read.dims, bytes(&read), read.turn), (SIZES, &counted(&SIZES)[..], DQuat::IDENTITY));
            assert!(says(&read.warnings, &["sheared", told, "along its own axes"]), "{:?}", read.warnings);
        }
    }
    let lengths = volume(&SIZES, "space directions: (1,0,0) (0,1,0) (0,0.6,0.8)").spacing;
    assert_eq!(lengths, [1.0; 3]);
}

#[test]
fn a_left_handed_space_is_told_of() {
    for (space, left_handed) in [
        ("left-anterior-superior", true),
        ("LAS", true),
        ("3D-left-handed", true),
        ("left-anterior-superior-time", true),
        ("right-anterior-superior", false),
        ("RAS", false),
        ("LPS", false),
        ("scanner-xyz", false),
        ("3D-right-handed", false),
    ] {
        let lines = format!("space: {space}\nspace directions: (1,0,0) (0,1,0) (0,0,1)");
        let told = volume(&SIZES, &lines).warnings;
        assert_eq!(says(&told, &["mirrored", space.to_lowercase().as_str()]), left_handed, "{space}: {told:?}");
    }
}

/// A volume is shown mirrored where the axes it is drawn along have another hand than those of the world.
#[test]
fn handedness_is_that_of_what_is_drawn() {
    let straight = "space directions: (1,0,0) (0,1,0) (0,0,1)";
    let over = "space directions: (-1,0,0) (0,1,0) (0,0,1)";
    let sheared = "space directions: (-1,0,0) (0,1,0) (0,0.6,0.8)";
    for (space, lines, by_file, own) in [
        ("RAS", straight, false, false),
        ("RAS", over, false, true),
        ("RAS", sheared, true, true),
        ("LAS", straight, true, true),
        ("LAS", over, true, false),
        ("LAS", sheared, false, false),
    ] {
        for (choice, mirrored) in [(ReadChoice::default(), by_file), (by_index(), own)] {
            let read = chosen(&SIZES, &format!("space: {space}\n{lines}"), &choice).unwrap();
            assert_eq!(says(&read.warnings, &["mirrored"]), mirrored, "{space}, {lines}: {:?}", read.warnings);
        }
    }
}

/// What a time axis says of directions is none of a stack's.
#[test]
fn a_stack_over_time_stands_square_to_its_pictures() {
    for time in ["(0,0,0)", "(0,0,inf)", "none"] {
        let lines = format!("kinds: domain domain time\nspace directions: (2,0,0) (0,2,0) {time}");
        let read = volume(&SIZES, &lines);
        assert_eq!((read.turn, read.spacing, read.dims), (DQuat::IDENTITY, [2.0; 3], SIZES), "{time}");
    }
}

/// Components and frames are picked from a volume that is turned over as well.
#[test]
fn a_component_of_a_mirrored_volume_is_where_it_belongs() {
    use depthleap::scene::settings::Component::Number;
    let lines = "kinds: vector domain domain domain\nspace directions: none (0,1,0) (-1,0,0) (0,0,1)";
    let choice = ReadChoice { component: Some(Number(1)), ..ReadChoice::default() };
    let read = chosen(&[2, 2, 3, 4], lines, &choice).unwrap();
    let axes = DMat3::from_cols(DVec3::Y, -DVec3::X, DVec3::Z);
    let (dims, voxels) = permuted(axes);
    let expected: Vec<u8> = voxels.iter().map(|v| 2 * v + 1).collect();
    assert_eq!((read.dims.to_vec(), bytes(&read)), (dims, &expected[..]));
}

/// A picture lies square to the plane that it spans.
#[test]
fn a_picture_is_turned_as_its_plane_is() {
    let read = volume(&[2, 3], "space directions: (0,1,0) (0,0,1)");
    assert_eq!((read.dims, bytes(&read), read.turn), ([1, 2, 3], &counted(&[2, 3])[..], DQuat::IDENTITY));
}
