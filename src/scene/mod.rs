//! What is to be seen, with no word about how: volume, transfer function, camera, sampling, method.

pub mod builtin;
pub mod camera;
pub mod field;
mod fixed;
pub mod method;
pub mod range;
pub mod settings;
pub mod texture;
pub mod transfer;
pub mod volume;

use std::sync::Arc;

pub use camera::Camera;
pub use field::Field;
pub use settings::Settings;
pub use texture::TextureUnit;
pub use transfer::TransferFunction;
pub use volume::Volume;

/// Everything a frame depends on. `settings` alone repeats it.
#[derive(Clone, Debug)]
pub struct Scene {
    pub settings: Settings,
    pub field: Arc<Field>,
    pub transfer: TransferFunction,
    pub camera: Camera,
    /// What is known of the texture unit that interpolates, where the scene asks for one.
    pub unit: TextureUnit,
}
