//! The picture of a volume that lies askew: the camera sees its voxels where the file says that they are.

use depthleap::read;
use depthleap::scene::settings::Orientation;
use depthleap::scene::{Camera, Scene, Settings};
use glam::{DMat3, DVec3};

use crate::kit::{counted, file, nrrd, places, sized};

const SIZES: [usize; 3] = [4, 3, 5];
const SPACING: [f64; 3] = [1.0, 2.0, 0.5];

/// The scene of a file whose axes lie along the columns of `axes`, in a folder that may go.
fn scene(axes: DMat3, change: impl FnOnce(&mut Settings)) -> Scene {
    let words = [0, 1, 2].map(|a| (axes.col(a) * SPACING[a]).to_array().map(|part| part.to_string()).join(","));
    let lines = sized(&SIZES, &format!("space directions: {}", words.map(|vector| format!("({vector})")).join(" ")));
    let (_folder, path) = file("a.nrrd", &nrrd(&lines, &counted(&SIZES)));
    let mut settings = Settings::default();
    settings.volume.path = Some(path);
    settings.camera.eye = [0.4, 0.7, 2.1];
    settings.camera.target = [0.1, -0.05, 0.0];
    settings.camera.up = [0.1, 1.0, -0.2];
    change(&mut settings);
    read::scene(&settings).unwrap()
}

/// Right, up and depth of a point as a camera sees it.
fn seen(camera: &Camera, point: DVec3) -> DVec3 {
    let basis = camera.basis().unwrap();
    let from_eye = point - camera.eye;
    DVec3::new(basis.right.dot(from_eye), basis.up.dot(from_eye), basis.forward.dot(from_eye))
}

fn near(a: DVec3, b: DVec3) {
    assert!((a - b).length() < 1e-12, "{a} {b}");
}

/// The rotation by so many degrees about z, written out.
fn about_z(degrees: f64) -> DMat3 {
    let (sin, cos) = f64::to_radians(degrees).sin_cos();
    DMat3::from_cols(DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0), DVec3::Z)
}

#[test]
fn a_tilted_volume_is_seen_as_the_untilted_one_by_a_camera_turned_back() {
    for degrees in [20.0, -35.0, 44.9] {
        let tilted = scene(about_z(degrees), |_| {});
        let back = about_z(-degrees);
        let straight = scene(DMat3::IDENTITY, |settings| {
            let camera = &mut settings.camera;
            for vector in [&mut camera.eye, &mut camera.target, &mut camera.up] {
                *vector = (back * DVec3::from_array(*vector)).to_array();
            }
        });
        assert_eq!(tilted.field.volume.voxels, straight.field.volume.voxels);
        for (a, b) in [
            (tilted.camera.eye, straight.camera.eye),
            (tilted.camera.target, straight.camera.target),
            (tilted.camera.up, straight.camera.up),
        ] {
            near(a, b);
        }
    }
}

/// Each voxel, at its place in the file's space, stands before the camera that the user placed there as it stands, at its
/// place in the volume, before the camera of the scene.
#[test]
fn every_voxel_stands_before_the_camera_where_its_file_puts_it() {
    let order = DMat3::from_cols(DVec3::Y, -DVec3::Z, DVec3::X);
    let tilt = DMat3::from_axis_angle(DVec3::new(2.0, -1.0, 2.0) / 3.0, 0.4);
    let longest = 6.0;
    for axes in [DMat3::IDENTITY, order, tilt, tilt * order, about_z(110.0), about_z(180.0) * tilt] {
        let scene = scene(axes, |_| {});
        let user = Camera::from(&scene.settings.camera);
        let volume = &scene.field.volume;
        for (value, place) in places(volume) {
            let i = value as usize;
            let index = [i % SIZES[0], i / SIZES[0] % SIZES[1], i / (SIZES[0] * SIZES[1])];
            let centred = [0, 1, 2].map(|a| (index[a] as f64 - 0.5 * (SIZES[a] as f64 - 1.0)) * SPACING[a]);
            let in_file = axes * DVec3::from_array(centred) / longest;
            let in_volume = volume.turn.inverse() * place / longest;
            let (by_user, by_scene) = (seen(&user, in_file), seen(&scene.camera, in_volume));
            assert!((by_user - by_scene).length() < 1e-12, "voxel {value}: {by_user} {by_scene}");
        }
    }
}

/// The side of the volume that is longest still measures 1, and a run that is repeated from its settings sees the same.
#[test]
fn the_settings_keep_the_camera_of_the_file_s_space() {
    let first = scene(about_z(30.0), |_| {});
    assert_ne!(first.camera, Camera::from(&first.settings.camera));
    let again = first.clone().seen_by(Camera::from(&first.settings.camera));
    assert_eq!((again.camera, again.settings.camera.eye), (first.camera, [0.4, 0.7, 2.1]));
    let sides = first.field.volume.dims.map(|n| n as f64);
    assert_eq!([0, 1, 2].map(|a| sides[a] * first.field.volume.spacing[a]), [4.0, 6.0, 2.5]);
}

#[test]
fn by_index_the_camera_is_the_users() {
    let by_index = scene(about_z(30.0), |settings| settings.volume.orientation = Orientation::Index);
    assert_eq!(by_index.camera, Camera::from(&by_index.settings.camera));
}
