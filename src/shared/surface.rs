//! What shaders know of iso-surfaces and of lights.

use bytemuck::{Pod, Zeroable};

use crate::projection::surface_values;
use crate::scene::light::{Light, LightPlace};
use crate::scene::texture::{TextureChoice, TextureMap};
use crate::scene::{Scene, Surface};

/// `SurfaceLevel` of `glsl/shared/surface.glsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct SurfaceLevel {
    /// Linear, not lit, and its opacity.
    pub color: [f32; 4],
    /// The values that are on the surface, from the one to the other, in units of the volume texture.
    pub from: f32,
    pub to: f32,
    pub padding: [u32; 2],
}

/// The surfaces of a scene, by rising values.
pub fn surface_levels(scene: &Scene, surface: &Surface) -> Vec<SurfaceLevel> {
    let map = TextureMap::of(&scene.field, TextureChoice::of(scene).kept);
    let values = surface_values(scene, map);
    let level = |([from, to], ([r, g, b], opacity)): ([f64; 2], ([f64; 3], f64))| SurfaceLevel {
        color: [r, g, b, opacity].map(|c| c as f32),
        from: from as f32,
        to: to as f32,
        padding: [0; 2],
    };
    values.into_iter().zip(surface.levels.iter().map(|level| (level.color, level.opacity))).map(level).collect()
}

/// Lights as the shader's buffer has them (`glsl/shared/phong.glsl`): four rows each, two where all are white.
pub fn light_rows(lights: &[Light], white: bool) -> Vec<[f32; 4]> {
    let of = |light: &Light| {
        let (place, w) = match light.place {
            LightPlace::Direction(way) => (way, 0.0),
            LightPlace::Position(point) => (point, 1.0),
        };
        let row = |[x, y, z]: [f64; 3], w: f64| [x, y, z, w].map(|c| c as f32);
        let (ambient, shininess) = (light.ambient, light.shininess);
        let place = row(place.to_array(), w);
        match white {
            true => vec![place, row([ambient[0], light.diffuse[0], light.specular[0]], shininess)],
            false => vec![place, row(ambient, shininess), row(light.diffuse, 0.0), row(light.specular, 0.0)],
        }
    };
    lights.iter().flat_map(of).collect()
}
