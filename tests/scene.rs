//! Scene parts: transfer functions, camera, field, built-in volumes.

use depthleap::scene::builtin::{self, Builtin, BuiltinVoxels};
use depthleap::scene::field::NanPolicy;
use depthleap::scene::settings::CameraSettings;
use depthleap::scene::transfer::{Knot, PRESETS, TransferFunction};
use depthleap::scene::volume::{Volume, Voxels};
use depthleap::scene::{Camera, Field};
use glam::DVec3;

fn transfer(points: &[[f64; 2]]) -> TransferFunction {
    let knots = points.iter().map(|&[x, opacity]| Knot { x, color: [x; 3], opacity }).collect();
    TransferFunction::new("test", knots, 1.0).unwrap()
}

#[test]
fn at_a_jump_the_later_point_counts() {
    let tf = transfer(&[[0.0, 0.0], [0.5, 0.2], [0.5, 0.8], [1.0, 1.0]]);
    assert_eq!(tf.evaluate(0.5)[3], 0.8);
    assert!((tf.evaluate(0.5 - 1e-12)[3] - 0.2).abs() < 1e-9);
    assert_eq!(tf.jumps().collect::<Vec<_>>(), [0.5]);
}

#[test]
fn outside_its_points_a_transfer_function_is_clamped() {
    let tf = transfer(&[[0.2, 0.1], [0.8, 0.7]]);
    assert_eq!(
        [tf.evaluate(-5.0)[3], tf.evaluate(0.2)[3], tf.evaluate(0.8)[3], tf.evaluate(9.0)[3]],
        [0.1, 0.1, 0.7, 0.7]
    );
}

#[test]
fn between_points_colour_and_opacity_are_linear() {
    let tf = transfer(&[[0.0, 0.0], [1.0, 0.5]]);
    for i in 0..=100 {
        let x = f64::from(i) / 100.0;
        let expected = [x, x, x, 0.5 * x];
        assert!(tf.evaluate(x).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15));
    }
}

#[test]
fn a_narrow_peak_between_two_values_is_visible() {
    let tf = transfer(&[[0.0, 0.0], [0.5, 0.0], [0.500001, 1.0], [0.500002, 0.0], [1.0, 0.0]]);
    assert!(tf.visible(0.4, 0.6) && tf.visible(0.500001, 0.500001) && tf.visible(0.0, 1.0));
    assert!(!tf.visible(0.0, 0.5) && !tf.visible(0.500002, 1.0) && !tf.visible(-1.0, 0.4));
}

#[test]
fn visible_agrees_with_a_dense_search() {
    let tf =
        transfer(&[[0.1, 0.3], [0.1, 0.0], [0.3, 0.0], [0.4, 0.2], [0.5, 0.0], [0.7, 0.0], [0.7, 0.5], [0.8, 0.0]]);
    for (low, high) in (0..100).flat_map(|a| (a..100).map(move |b| (f64::from(a) / 99.0, f64::from(b) / 99.0))) {
        let found = (0..=200).any(|i| tf.evaluate(low + (high - low) * f64::from(i) / 200.0)[3] > 0.0);
        assert!(!found || tf.visible(low, high), "[{low}, {high}]");
    }
}

#[test]
fn presets_are_as_written_down() {
    let opacity = |name: &str, x| TransferFunction::preset(name, 1.0).unwrap().unwrap().evaluate(x)[3];
    assert_eq!([opacity("ramp", 0.25), opacity("ramp", 0.625), opacity("ramp", 1.0)], [0.0, 0.25, 0.5]);
    assert_eq!([opacity("surface", 0.2999), opacity("surface", 0.3), opacity("surface", 1.0)], [0.0, 0.9, 0.9]);
    assert_eq!([opacity("haze", 0.0), opacity("linear", 0.25)], [0.01, 0.25]);
    assert_eq!(PRESETS.len(), 4);
}

#[test]
fn points_that_are_no_transfer_function_are_refused() {
    let knot = |x, opacity, red| Knot { x, color: [red, 0.0, 0.0], opacity };
    let good = || vec![knot(0.0, 0.0, 0.0), knot(1.0, 1.0, 1.0)];
    TransferFunction::new("t", good(), 1.0).unwrap();
    for bad in [
        vec![],
        vec![knot(1.0, 0.0, 0.0), knot(0.0, 0.0, 0.0)],
        vec![knot(0.0, 1.1, 0.0)],
        vec![knot(0.0, f64::NAN, 0.0)],
        vec![knot(f64::NAN, 0.0, 0.0)],
        vec![knot(0.0, 0.0, -1.0)],
    ] {
        TransferFunction::new("t", bad, 1.0).unwrap_err();
    }
    for reference in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        TransferFunction::new("t", good(), reference).unwrap_err();
    }
}

#[test]
fn the_default_camera_sees_the_front_face_428_pixels_wide() {
    let rays = Camera::from(&CameraSettings::default()).rays([500, 500]).unwrap();
    let hits = (0..500).filter(|&column| {
        let direction = rays.of(column, 250).direction;
        let at_front = rays.origin + direction * (rays.origin.z - 0.5);
        at_front.x.abs() <= 0.5
    });
    assert_eq!(hits.count(), 428);
}

#[test]
fn row_0_is_on_top_and_column_0_on_the_left() {
    let rays = Camera::from(&CameraSettings::default()).rays([10, 10]).unwrap();
    let corner = rays.of(0, 0).direction;
    assert!(corner.x < 0.0 && corner.y > 0.0 && (corner.z + 1.0).abs() < 1e-15);
}

#[test]
fn orthographic_rays_lie_side_by_side() {
    let camera = Camera { height: Some(1.5), ..Camera::orbit(0.0, 0.0, 2.0, 45.0) };
    let rays = camera.rays([40, 30]).unwrap();
    for (column, row, x, y) in
        [(0, 0, -0.975, 0.725), (39, 0, 0.975, 0.725), (0, 29, -0.975, -0.725), (20, 15, 0.025, -0.025)]
    {
        let ray = rays.of(column, row);
        assert!((ray.direction - DVec3::NEG_Z).length() < 1e-15);
        assert!((ray.origin - DVec3::new(x, y, 2.0)).length() < 1e-15, "{ray:?}");
        // What leads to a place leads back to it.
        let place = rays.to_picture() * (ray.at(0.7) - rays.origin);
        let expected = DVec3::new(f64::from(column) + 0.5, f64::from(row) + 0.5, 0.7);
        assert!((place - expected).length() < 1e-12, "{place}");
    }
    for height in [0.0, -1.0, 1e9, f64::NAN] {
        Camera { height: Some(height), ..camera }.basis().unwrap_err();
    }
}

#[test]
fn a_camera_without_a_view_is_refused() {
    let good = Camera::orbit(30.0, 20.0, 2.0, 45.0);
    good.basis().unwrap();
    Camera { target: good.eye, ..good }.basis().unwrap_err();
    Camera { up: good.eye, ..good }.basis().unwrap_err();
    Camera { eye: DVec3::NAN, ..good }.basis().unwrap_err();
    for fov_y in [0.0, 180.0, -1.0, f64::NAN] {
        Camera { fov_y, ..good }.basis().unwrap_err();
    }
}

fn field(values: &[f32], policy: NanPolicy) -> depthleap::Result<Field> {
    let volume = Volume::new("test", [values.len(), 1, 1], [1.0; 3], Voxels::F32(values.to_vec())).unwrap();
    Field::new(volume, Some([0.0, 2.0]), policy)
}

#[test]
fn nan_and_infinities_follow_the_policy() {
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.0, 2.0];
    assert_eq!(field(&odd, NanPolicy::Replace).unwrap().values, [0.0, 1.0, 0.0, 0.5, 1.0]);
    assert_eq!(field(&odd, NanPolicy::Hole).unwrap().holes.unwrap(), [true, true, true, false]);
    assert!(field(&odd, NanPolicy::Error).unwrap_err().to_string().contains("3 voxels"));
    assert!(field(&[0.0, 1.0], NanPolicy::Hole).unwrap().holes.is_none());
}

#[test]
fn the_range_is_the_types_for_bytes_and_the_values_for_others() {
    let range = |voxels| {
        Field::new(Volume::new("t", [2, 1, 1], [1.0; 3], voxels).unwrap(), None, NanPolicy::Replace).unwrap().range
    };
    assert_eq!(range(Voxels::U8(vec![3, 9])), [0.0, 255.0]);
    assert_eq!(range(Voxels::U16(vec![3, 9])), [3.0, 9.0]);
    assert_eq!(range(Voxels::I16(vec![-3, 9])), [-3.0, 9.0]);
    assert_eq!(range(Voxels::F32(vec![-3.0, f32::NAN])), [-3.0, -3.0]);
}

#[test]
fn the_longest_side_is_one_and_spacing_counts() {
    let volume = Volume::new("t", [4, 2, 1], [1.0, 4.0, 2.0], Voxels::U8(vec![0; 8])).unwrap();
    let field = Field::new(volume, None, NanPolicy::Replace).unwrap();
    assert_eq!(field.extent(), DVec3::new(0.5, 1.0, 0.25));
    assert_eq!((field.voxel(), field.finest()), (DVec3::new(0.125, 0.5, 0.25), 0.125));
    assert_eq!(field.cells(), [3, 1, 1]);
}

/// Points inside (-1, 1)^3, on no grid.
fn points() -> impl Iterator<Item = DVec3> {
    // Fractional parts of multiples of the powers of the plastic number fill the cube evenly.
    (1..20_000)
        .map(|i| DVec3::new(0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9) * f64::from(i))
        .map(|p| p.fract() * 1.98 - 0.99)
}

#[test]
fn builtin_gradients_are_the_derivatives_of_their_values() {
    const H: f64 = 1e-5;
    for builtin in builtin::ALL {
        let mut steepest = 0.0f64;
        for p in points() {
            let difference = [DVec3::X, DVec3::Y, DVec3::Z]
                .map(|axis| (builtin.value(p + H * axis) - builtin.value(p - H * axis)) / (2.0 * H));
            // Central differences err by H^2 / 6 times the third derivative, below 1e6 for the thinnest profile.
            let error = (builtin.gradient(p) - DVec3::from_array(difference)).length();
            assert!(error < 1e-4, "{} at {p}: {error}", builtin.name);
            steepest = steepest.max(builtin.gradient(p).length());
        }
        assert!(steepest > 0.4 || builtin.name == "constant", "{} is flat", builtin.name);
    }
}

#[test]
fn builtin_values_lie_from_0_to_1() {
    for builtin in builtin::ALL {
        assert!(points().all(|p| (0.0..=1.0).contains(&builtin.value(p))), "{}", builtin.name);
    }
}

#[test]
fn builtin_voxels_are_the_values_at_their_centres() {
    for Builtin { name, .. } in builtin::ALL {
        let volume = builtin::volume(&format!("{name}:9x5x7")).unwrap();
        assert_eq!((volume.dims, volume.name.as_str()), ([9, 5, 7], format!("builtin:{name}:9x5x7").as_str()));
        let builtin = builtin::find(name).unwrap();
        for (x, y, z) in [(0, 0, 0), (8, 4, 6), (3, 2, 5)] {
            let p =
                2.0 * (DVec3::new(f64::from(x), f64::from(y), f64::from(z)) + 0.5) / DVec3::new(9.0, 5.0, 7.0) - 1.0;
            let index = ((z * 5 + y) * 9 + x) as usize;
            match &volume.voxels {
                Voxels::U8(v) => {
                    assert!((f64::from(v[index]) - 255.0 * builtin.value(p)).abs() <= 0.5 + 1e-9, "{name}")
                }
                voxels => assert!((voxels.get(index) - builtin.value(p)).abs() < 1e-7, "{name}"),
            }
        }
    }
}

#[test]
fn sparse_builtins_are_mostly_empty_but_not_all_and_0_at_the_faces() {
    let sparse = builtin::ALL.iter().filter(|row| row.stored == BuiltinVoxels::U8);
    for name in sparse.map(|row| row.name) {
        for size in [64, 128] {
            let field =
                Field::new(builtin::volume(&format!("{name}:{size}")).unwrap(), None, NanPolicy::Replace).unwrap();
            let filled = field.cells_where(|corner| field.values[corner] > 0.0);
            let share = filled.iter().filter(|f| **f).count() as f64 / filled.len() as f64;
            assert!((0.01..=0.4).contains(&share), "{name}:{size}: {share} of the cells are filled");
            println!("{name}:{size}: {:.1} % of the cells are empty", 100.0 * (1.0 - share));
            let last = size - 1;
            let at_face =
                |i: usize| [i % size, i / size % size, i / (size * size)].iter().any(|c| *c == 0 || *c == last);
            assert!((0..field.values.len()).all(|i| !at_face(i) || field.values[i] == 0.0), "{name}");
            assert!(field.values.iter().any(|v| *v > 0.9), "{name} is bright somewhere");
        }
    }
}

#[test]
fn the_wall_of_blocks_straddles_a_seam() {
    let volume = builtin::volume("blocks:64").unwrap();
    let Voxels::U8(v) = &volume.voxels else { panic!("blocks is u8") };
    let column: Vec<u8> = (29..35).map(|y| v[(32 * 64 + y) * 64 + 32]).collect();
    assert!(column[0] == 0 && column[5] == 0 && column[2] > 64 && column[2] == column[3], "{column:?}");
}

#[test]
fn an_unknown_builtin_names_the_nearest() {
    let message = builtin::volume("shels:64").unwrap_err().to_string();
    assert!(message.contains("did you mean `shells`?"), "{message}");
}

#[test]
fn builtin_sizes_out_of_range_are_refused() {
    assert_eq!(builtin::volume("linear").unwrap().dims, [64; 3]);
    assert_eq!(builtin::volume("builtin:linear:2048x1x1").unwrap().dims, [2048, 1, 1]);
    for size in ["0", "2049", "-1", "x", "", "1x2", "1x2x3x4", "2048", "1025x1024x1024", "99999999999999999999"] {
        builtin::volume(&format!("linear:{size}")).unwrap_err();
    }
}

#[test]
fn engine_has_a_casting_with_bores_and_steel_around_them() {
    let at = |x, y, z| builtin::find("engine").unwrap().value(DVec3::new(x, y, z));
    let is = |density: f64, value: f64| (density - value).abs() < 1e-12;
    assert!(is(0.45, at(0.0, 0.3, 0.0)) && is(1.0, at(0.36, 0.3, 0.27)), "casting, and the liner in it");
    assert_eq!([at(0.36, 0.3, 0.0), at(0.0, -0.42, 0.0), at(0.0, 0.7, 0.0)], [0.0; 3], "bore, tunnel, outside");
    assert!(is(1.0, at(-0.62, 0.2, 0.3)), "a bolt");
}

#[test]
fn head_has_skin_skull_and_brain_with_ventricles() {
    let at = |x, y, z| builtin::find("head").unwrap().value(DVec3::new(x, y, z));
    let along_y = |part: f64| at(0.0, 0.84 * part, 0.0);
    assert_eq!([along_y(1.0), along_y(0.88), along_y(0.71)], [0.0; 3], "outside, below the skin, below the skull");
    assert_eq!(along_y(0.8), 1.0, "skull");
    assert!((0.3..0.4).contains(&along_y(0.96)), "skin: {}", along_y(0.96));
    assert!((0.38..=0.55).contains(&along_y(0.5)), "brain: {}", along_y(0.5));
    assert_eq!(at(0.12, 0.08, 0.0), 0.0, "a ventricle");
    assert!(at(0.0, -0.08, 0.84) > 0.1, "the nose stands out of the face");
}
