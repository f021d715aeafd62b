//! Where directions lie in a picture, against closed forms.

use depthleap::scene::Environment;
use depthleap::scene::environment::Picture;
use depthleap::scene::settings::Mapping;
use glam::{DQuat, DVec3};

use crate::apart;

/// A picture of which each texel tells its place, around the volume as it stands.
pub fn told(size: [usize; 2], mapping: Mapping) -> Environment {
    let texels = (0..size[0] * size[1]).map(|i| [(i % size[0]) as f32, (i / size[0]) as f32, 1.0]).collect();
    let picture = Picture { size, texels };
    Environment { picture, mapping, reflectivity: 0.5, turn: DQuat::IDENTITY, warnings: Vec::new() }
}

/// Directions on no grid, all around.
fn directions() -> impl Iterator<Item = DVec3> {
    let spread = DVec3::new(0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9);
    (1..4000).map(move |i| (spread * f64::from(i)).fract() * 2.0 - 1.0).filter_map(DVec3::try_normalize)
}

#[test]
fn axes_have_their_places_in_a_latlong_picture() {
    let environment = told([8, 4], Mapping::Latlong);
    for (direction, place) in [
        (DVec3::NEG_Z, [3.5, 1.5]),
        (DVec3::X, [5.5, 1.5]),
        (DVec3::NEG_X, [1.5, 1.5]),
        (DVec3::Y, [3.5, -0.5]),
        (DVec3::NEG_Y, [3.5, 3.5]),
        (DVec3::new(1.0, 0.0, -1.0).normalize(), [4.5, 1.5]),
        (DVec3::new(0.0, 1.0, -1.0).normalize(), [3.5, 0.5]),
    ] {
        assert!(apart(environment.place(direction), place) < 1e-12, "{direction}: {:?}", environment.place(direction));
    }
    // On top of the picture the first row, across that between its columns 3 and 4.
    assert!(apart(environment.color(DVec3::Y), [3.5, 0.0, 1.0]) < 1e-12);
    assert!(apart(environment.color(DVec3::NEG_Y), [3.5, 3.0, 1.0]) < 1e-12);
    assert!(apart(environment.color(DVec3::new(1.0, 0.0, -1.0).normalize()), [4.5, 1.5, 1.0]) < 1e-12);
}

#[test]
fn latlong_picture_is_closed_around_the_seam() {
    let environment = told([8, 4], Mapping::Latlong);
    let beside = |x: f64| environment.color(DVec3::new(x, 0.0, 1.0).normalize());
    // Between the last column and the first one.
    for x in [-1e-9, 0.0, 1e-9] {
        assert!(apart(beside(x), [3.5, 1.5, 1.0]) < 1e-6, "{x}: {:?}", beside(x));
    }
    // A quarter of a texel to each side.
    let step = (std::f64::consts::TAU / 32.0).tan();
    assert!(apart(beside(step), [0.75 * 7.0, 1.5, 1.0]) < 1e-9 && apart(beside(-step), [0.25 * 7.0, 1.5, 1.0]) < 1e-9);
}

#[test]
fn mirror_ball_shows_each_direction_where_its_normal_is() {
    let environment = told([16, 10], Mapping::Sphere);
    for direction in directions() {
        // Seen from +z, the normal is half way between there and what is reflected.
        let normal = (direction + DVec3::Z).normalize();
        let place = [8.0 + 8.0 * normal.x - 0.5, 5.0 - 5.0 * normal.y - 0.5];
        assert!(apart(environment.place(direction), place) < 1e-9, "{direction}");
        let back = environment.reflected(normal, DVec3::Z).unwrap();
        assert!(back.distance(direction) < 1e-12, "{direction}: {back}");
    }
    assert!(apart(environment.color(DVec3::Z), [7.5, 4.5, 1.0]) < 1e-12);
    // The rim, beyond the last texel.
    assert!(environment.color(DVec3::NEG_Z).iter().all(|c| c.is_finite()));
}

/// `angle_of` of `glsl/shared/environment.glsl`, line by line, in f32.
fn angle_of(y: f32, x: f32) -> f32 {
    const PI: f32 = std::f32::consts::PI;
    let (least, most) = (x.abs().min(y.abs()), x.abs().max(y.abs()));
    if most == 0.0 {
        return 0.0;
    }
    let slope = least / most;
    let steep = slope > 0.414_213_57;
    let t = if steep { (slope - 1.0) / (slope + 1.0) } else { slope };
    let s = t * t;
    let higher = ((0.080_537_446 * s - 0.138_776_85) * s + 0.199_777_11) * s - 0.333_329_5;
    let angle = (higher * s).mul_add(t, t) + if steep { 0.25 * PI } else { 0.0 };
    let angle = if y.abs() > x.abs() { 0.5 * PI - angle } else { angle };
    let angle = if x < 0.0 { PI - angle } else { angle };
    if y < 0.0 { -angle } else { angle }
}

#[test]
fn angles_of_shaders_are_good_to_some_units_in_the_last_place() {
    for way in directions().chain([DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y]) {
        let [x, y, _] = way.as_vec3().to_array();
        let error = f64::from(angle_of(y, x)) - f64::from(y).atan2(f64::from(x));
        assert!(error.abs() < 4e-7, "{y}, {x}: {error:e}");
    }
    assert_eq!(angle_of(0.0, 0.0), 0.0);
}
