//! What is to be seen, and by which method: volume, transfer function, camera, sampling, settings. Knows no Vulkan.

pub mod along_rays;
pub mod backdrop;
pub mod builtin;
pub mod camera;
pub mod clip_volume;
pub mod effect;
mod effects;
pub mod environment;
pub mod field;
pub(crate) mod file_name;
mod fixed;
mod frustum;
pub mod gathered;
pub mod gradients;
pub mod light;
pub mod limits;
pub mod longest;
pub mod mesh;
pub mod mesh_field;
pub mod method;
pub mod planes;
pub mod projection;
pub mod range;
pub mod refraction;
pub mod region;
pub mod scenes;
pub mod settings;
pub mod shells;
pub mod single_rays;
mod sky;
pub mod slice_polygons;
pub mod slices;
pub mod surface;
pub mod tetrahedra;
pub mod texture;
pub mod tile_set;
pub mod tiles;
pub mod transfer;
pub mod view;
pub mod volume;
mod volume_choice;

use std::sync::Arc;

pub use backdrop::Backdrop;
pub use camera::Camera;
pub use clip_volume::ClipVolume;
pub use effect::Effect;
pub use environment::Environment;
pub use field::Field;
pub use light::Light;
pub use mesh::Polygons;
pub use planes::ClipPlanes;
pub use refraction::RefractiveIndex;
pub use region::Region;
pub use settings::Settings;
pub use shells::Shells;
pub use surface::Surface;
pub use tetrahedra::Tetrahedra;
pub use texture::TextureUnit;
pub use transfer::TransferFunction;
pub use volume::Volume;

/// What a scene shows.
#[derive(Clone, Debug)]
pub enum Content {
    Voxels(Volume),
    Cells(tetrahedra::Grid),
}

impl From<Volume> for Content {
    fn from(volume: Volume) -> Self {
        Self::Voxels(volume)
    }
}

/// Everything a frame depends on. `settings` alone repeats it.
#[derive(Clone, Debug)]
pub struct Scene {
    pub settings: Settings,
    pub field: Arc<Field>,
    /// The mesh whose values the field holds, where it is one of tetrahedra and has no voxels.
    pub tetrahedra: Option<Arc<Tetrahedra>>,
    pub transfer: TransferFunction,
    pub camera: Camera,
    /// Polygons in and around the volume.
    pub polygons: Arc<Polygons>,
    /// Planes that the volume is cut at.
    pub planes: ClipPlanes,
    /// Another volume, by whose values this one is clipped.
    pub clip_volume: Option<Arc<ClipVolume>>,
    /// Iso-surfaces that are drawn in place of the volume's colours.
    pub surface: Option<Surface>,
    /// Nested iso-surfaces as polygons.
    pub shells: Option<Arc<Shells>>,
    /// Lights that are given, in the volume's axes.
    pub lights: Vec<Light>,
    /// What the iso-surfaces reflect.
    pub environment: Option<Arc<Environment>>,
    /// What is behind the volume.
    pub backdrop: Option<Arc<Backdrop>>,
    /// What the user's own GLSL makes of samples and surfaces.
    pub effect: Option<Arc<Effect>>,
    /// What is known of the texture unit that interpolates, where the scene asks for one.
    pub unit: TextureUnit,
}

impl Scene {
    /// A volume under a transfer function, seen by the camera of `settings`, with nothing else in the scene.
    pub fn of_volume(settings: Settings, field: Arc<Field>, transfer: TransferFunction) -> Self {
        let camera = Camera::from(&settings.camera).in_axes_of(field.volume.turn);
        let (polygons, unit) = (Arc::default(), TextureUnit::default());
        Self {
            settings,
            field,
            tetrahedra: None,
            transfer,
            camera,
            polygons,
            planes: ClipPlanes::default(),
            clip_volume: None,
            surface: None,
            shells: None,
            lights: Vec::new(),
            environment: None,
            backdrop: None,
            effect: None,
            unit,
        }
    }

    /// Whether ways through cells are looked up in a table.
    pub fn has_cell_table(&self) -> bool {
        self.tetrahedra.is_some() && self.settings.sampling.preintegrates()
    }

    /// Whether steps of samples are.
    pub fn has_step_table(&self) -> bool {
        self.tetrahedra.is_none() && self.settings.sampling.preintegrates()
    }

    /// The same scene, seen by a camera that is given in volume space.
    pub fn seen_by(mut self, camera: Camera) -> Self {
        let settings = &mut self.settings.camera;
        (settings.eye, settings.target, settings.up) =
            (camera.eye.to_array(), camera.target.to_array(), camera.up.to_array());
        (settings.fov_y, settings.height) = (camera.fov_y, camera.height);
        self.camera = camera.in_axes_of(self.field.volume.turn);
        self
    }
}
