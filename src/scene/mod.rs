//! What is to be seen, with no word about how: volume, transfer function, camera, sampling, method.

pub mod builtin;
pub mod camera;
pub mod field;
pub(crate) mod file_name;
mod fixed;
pub mod method;
pub mod settings;
pub mod transfer;
pub mod volume;
mod volume_choice;

use std::sync::Arc;

pub use camera::Camera;
pub use field::Field;
pub use settings::Settings;
pub use transfer::TransferFunction;
pub use volume::Volume;

/// Everything a frame depends on. `settings` alone repeats it.
#[derive(Clone, Debug)]
pub struct Scene {
    pub settings: Settings,
    pub field: Arc<Field>,
    pub transfer: TransferFunction,
    pub camera: Camera,
}
