//! `[camera]`: where the volume is looked at from.

use super::parse::numbers;
use super::section::section;
use crate::scene::camera::{Camera, FIELDS_OF_VIEW, PICTURE_HEIGHTS};
use crate::scene::fixed;
use crate::scene::limits::{Allowed, Limits};

/// From here the front face of a cube covers 428 of 500 pixels, as in the thesis.
const DISTANCE: f64 = 1.91;

const COORDINATES: Limits = Limits::new(Allowed::Finite, "three finite numbers");

section! {
    /// The camera; the default looks along -z at the whole volume.
    #[serde(expecting = "the section [camera]")]
    #[command(next_help_heading = "View")]
    CameraSettings, CameraOptions, "camera";

    /// Eye in volume space: the longest side of the volume is 1, its centre 0,0,0
    #[serde(deserialize_with = "fixed::list")]
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true)]
    eye: [f64; 3] = [0.0, 0.0, DISTANCE], within COORDINATES;

    /// Point looked at, in volume space
    #[serde(deserialize_with = "fixed::list")]
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true)]
    target: [f64; 3] = [0.0; 3], within COORDINATES;

    /// Direction that is up in the picture
    #[serde(deserialize_with = "fixed::list")]
    #[arg(long, value_name = "X,Y,Z", value_parser = numbers::<3>, allow_hyphen_values = true)]
    up: [f64; 3] = [0.0, 1.0, 0.0], within COORDINATES;

    /// Vertical field of view in degrees
    #[arg(long = "fov", value_name = "DEGREES", allow_negative_numbers = true)]
    fov_y: f64 = 45.0, within FIELDS_OF_VIEW;

    /// Height of the picture in volume space: an orthographic camera, which has no field of view
    #[arg(long = "ortho-height", value_name = "LENGTH", allow_negative_numbers = true, conflicts_with = "fov_y")]
    height?: f64, within PICTURE_HEIGHTS;

    options {
        /// Eye on a sphere about 0,0,0 instead of --eye: turned from +z towards +x [default: 0]
        #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, conflicts_with = "eye")]
        pub azimuth: Option<f64>,
        /// Eye on a sphere about 0,0,0 instead of --eye: lifted towards +y [default: 0]
        #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, conflicts_with = "eye")]
        pub elevation: Option<f64>,
        /// Eye on a sphere about 0,0,0 instead of --eye: its distance from there, in longest sides of the volume
        #[arg(
            long, value_name = "SIDES", allow_negative_numbers = true, conflicts_with = "eye",
            help = help_of_distance()
        )]
        pub distance: Option<f64>,
    }
}

fn help_of_distance() -> String {
    format!(
        "Eye on a sphere about 0,0,0 instead of --eye: its distance from there, in longest sides of the volume \
         [default: {DISTANCE}]"
    )
}

impl CameraOptions {
    fn apply_others(&self, settings: &mut CameraSettings) {
        // A field of view is one of a camera in perspective, whatever the scene file has.
        if self.fov_y.is_some() {
            settings.height = None;
        }
        if self.azimuth.is_some() || self.elevation.is_some() || self.distance.is_some() {
            let [azimuth, elevation] = [self.azimuth, self.elevation].map(Option::unwrap_or_default);
            let orbit = Camera::orbit(azimuth, elevation, self.distance.unwrap_or(DISTANCE), settings.fov_y);
            settings.eye = orbit.eye.to_array();
        }
    }
}

impl From<&CameraSettings> for Camera {
    fn from(s: &CameraSettings) -> Self {
        Self { eye: s.eye.into(), target: s.target.into(), up: s.up.into(), fov_y: s.fov_y, height: s.height }
    }
}
