//! What scenes of the matrix are made of: meshes, clip geometry, lights, surfaces.

use depthleap::method;
use depthleap::part::form::Form;
use depthleap::part::rows::Method;
use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{
    ClipSettings, GradientOperator, GradientTexture, Gradients, LightSettings, MeshSettings, Refraction,
    ShadingSettings, SurfaceLevel,
};
use depthleap::scene::{Camera, Scene};

pub fn index(points: &[[f64; 2]]) -> Option<Refraction> {
    Some(Refraction { points: points.to_vec() })
}

/// Opacity that comes and goes at once, so that a value that is off shows.
pub const JUMPS: [[f64; 5]; 5] = [
    [0.25, 0.2, 0.4, 1.0, 0.0],
    [0.25, 0.2, 0.4, 1.0, 0.2],
    [0.6, 0.9, 0.4, 0.1, 0.3],
    [0.6, 0.9, 0.4, 0.1, 0.0],
    [0.9, 0.9, 0.9, 0.1, 0.4],
];

pub fn gradients(gradient: GradientOperator, texture: GradientTexture) -> ShadingSettings {
    ShadingSettings { gradients: Gradients::Precomputed, gradient, format: texture }
}

/// A red light from afar with a highlight, and a blue one near the volume.
pub fn two_lights() -> Vec<LightSettings> {
    vec![
        LightSettings {
            direction: Some([-3.0, 2.0, 1.0]),
            color: [1.0, 0.3, 0.2],
            specular: 0.8,
            ..Default::default()
        },
        LightSettings { position: Some([0.7, -0.9, 0.8]), color: [0.2, 0.3, 1.0], ..Default::default() },
    ]
}

/// An iso-surface with a colour of its own.
pub fn level(iso: f64, color: [f64; 3]) -> SurfaceLevel {
    SurfaceLevel { iso, color: Some(color), ..SurfaceLevel::default() }
}

/// An iso-surface that lets something through.
pub fn sheet(iso: f64, color: [f64; 3], opacity: f64) -> SurfaceLevel {
    SurfaceLevel { iso, color: Some(color), opacity }
}

/// A box along no axis; backs have another colour.
pub fn cuboid(side: f64, opacity: f64) -> MeshSettings {
    MeshSettings {
        builtin: Some("box".to_owned()),
        color: [0.9, 0.4, 0.2],
        back: Some([0.1, 0.6, 0.3]),
        opacity,
        scale: side,
        rotate: [20.0, 33.0, 10.0],
        ..MeshSettings::default()
    }
}

/// One that reaches out of the volume.
pub fn across(opacity: f64) -> MeshSettings {
    MeshSettings { translate: [-0.35, 0.12, 0.31], color: [0.2, 0.3, 0.9], ..cuboid(0.6, opacity) }
}

/// Clip geometry, in the place of [`cuboid`].
pub fn clip(side: f64, keep: Keep) -> ClipSettings {
    let MeshSettings { builtin, rotate, .. } = cuboid(side, 0.0);
    ClipSettings { builtin, keep, scale: side, rotate, ..ClipSettings::default() }
}

/// A ball about a corner of the volume, by a clip volume of another size that lies across.
pub fn clip_volume(keep: Keep) -> ClipSettings {
    ClipSettings {
        builtin: Some("gaussian:13x19x16".to_owned()),
        iso: Some(0.1),
        keep,
        scale: 1.3,
        rotate: [20.0, 33.0, 10.0],
        translate: [0.05, 0.25, 0.3],
        ..ClipSettings::default()
    }
}

pub fn plane(plane: [f64; 4]) -> ClipSettings {
    ClipSettings { plane: Some(plane), ..ClipSettings::default() }
}

/// A value that few voxels of the volume have.
pub const NO_DATA: f64 = 127.0;

/// The scene as its camera sees it, and from within.
pub fn views(scene: &Scene) -> [(&'static str, Scene); 2] {
    let within =
        Camera { eye: [0.11, 0.07, -0.13].into(), target: [-0.3, 0.2, 0.4].into(), ..(&scene.settings.camera).into() };
    [("from outside", scene.clone()), ("from within", scene.clone().seen_by(within))]
}

/// The scene by a method.
pub fn by(scene: &Scene, method: &Method) -> Scene {
    let mut scene = scene.clone();
    scene.settings.method.name = method.name();
    scene
}

/// The methods that draw the scene.
pub fn methods(scene: &Scene) -> impl Iterator<Item = &'static Method> {
    method::METHODS.into_iter().filter(|method| depthleap::plan::check(&by(scene, method)).is_ok())
}

/// Every form of a method; none stands for culling nothing.
pub fn forms(method: &Method) -> Vec<Option<Form>> {
    let forms = (method.forms)();
    if forms.is_empty() { vec![None] } else { forms.into_iter().map(Some).collect() }
}
