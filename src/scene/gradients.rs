//! How gradients and values stand in one texture [Stegmaier05 §4]: which numbers a volume's voxels become there, and what a reader
//! makes of them again.

use super::Scene;
use super::settings::{GradientTexture, Gradients, Shows};
use super::texture::{Coding, TexelFormat, TextureChoice, TextureMap};

/// What rounding to a code of 8 bits takes from a number from 0 to 1 at the most: half a code, and what [`TIE`] adds.
const HALF_A_CODE: f64 = (0.5 + TIE as f64) / 255.0;

/// What half precision takes from numbers up to 1.
const HALF_PRECISION: f64 = 1.0 / (1 << 12) as f64;

/// Differences of whole numbers often lie in the middle between two codes of 8 bits: by so much more, all of them become the
/// greater code on every device, whatever it rounds.
pub const TIE: f32 = 1e-3;

/// Of 8 bits the code that stands for 0, and how many codes there are to each side of it.
pub const ZERO_CODE: f32 = 128.0;
pub const CODES: f32 = 127.0;

/// Gradients in 8 bits that are shorter than this, in codes, are none: rounding makes them of zeros, and interpolation makes none so
/// short of others but within a 512th of the way to the next voxel.
pub const NO_GRADIENT: f64 = 1.0 / 512.0;

/// How voxels become texels of gradients. A component is the difference of two voxels' numbers over the way between them, in
/// parts of the largest there may be, so that it lies from -1 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GradientCoding {
    pub texture: GradientTexture,
    /// Whether voxels are codes, which are whole numbers.
    pub whole: bool,
    /// What a value of the volume's texture is multiplied with to become a voxel's number.
    pub scale: f32,
    /// What a difference of numbers a voxel apart is multiplied with, by axis.
    pub factors: [f32; 3],
    /// The value beside the gradient is the first times a voxel's number and the second.
    pub beside: [f32; 2],
    /// The value of the volume's texture is the first times the value beside the gradient and the second.
    pub back: [f32; 2],
    /// x is the first times the value beside the gradient and the second.
    pub to_x: [f64; 2],
    /// How far the value beside the gradient may be from the volume's, as a value of the volume's texture.
    pub slack: f64,
}

impl GradientCoding {
    /// The coding of a scene's volume, as its texture keeps it, in the format that the scene asks for.
    pub fn of(scene: &Scene) -> Self {
        let (field, texture) = (&scene.field, scene.settings.shading.format);
        let choice = TextureChoice::of(scene);
        let map = TextureMap::of(field, choice.kept);
        let whole = choice.format != TexelFormat::R32f;
        let [low, high] = field.extremes().map(|x| map.value(x.into()));
        let steepest = field.contrast() * map.scale.abs();
        let scale = match choice.format {
            TexelFormat::R8 => f64::from(u8::MAX),
            TexelFormat::R16 => f64::from(u16::MAX),
            // A power of two, so that nothing is lost, which brings differences near to 1.
            TexelFormat::R32f if steepest > 0.0 => 2f64.powi(-(steepest.log2().floor().clamp(-120.0, 126.0) as i32)),
            TexelFormat::R32f => 1.0,
        };
        let per_axis = |axis: usize| match steepest > 0.0 {
            true => (field.finest() / field.voxel()[axis] / (steepest * scale)) as f32,
            false => 0.0,
        };
        // What lies from 0 to 1 stays as it is.
        let spread = !whole && texture != GradientTexture::Rgba32f;
        let span = if high > low { high - low } else { 1.0 };
        let [times, plus] = if spread { [1.0 / span, -low / span] } else { [1.0, 0.0] };
        let number = |value: f64| value.clamp(f32::MIN.into(), f32::MAX.into()) as f32;
        let lost = match texture {
            // Single precision has no number for what a code stands for.
            _ if spread && span > f32::MAX.into() => f64::INFINITY,
            GradientTexture::Rgba8 if matches!(choice.kept, Coding::Widened) || choice.format == TexelFormat::R8 => 0.0,
            GradientTexture::Rgba8 => HALF_A_CODE,
            GradientTexture::Rgba16f => HALF_PRECISION,
            GradientTexture::Rgba32f => 0.0,
        };
        let back = if spread { [number(span), number(low)] } else { [1.0, 0.0] };
        let [first, second] = back.map(f64::from);
        Self {
            texture,
            whole,
            scale: number(scale),
            factors: std::array::from_fn(per_axis),
            beside: [number(times / scale), number(plus)],
            back,
            to_x: [first / map.scale, (second - map.offset) / map.scale],
            slack: lost / times,
        }
    }
}

impl Scene {
    /// Whether a frame of the scene reads gradients: of surfaces for their colours and normals, of samples where they are lit.
    pub fn reads_gradients(&self) -> bool {
        let shown = self.settings.surface.shows != Shows::Position;
        if self.surface.is_some() { shown } else { !self.lights.is_empty() }
    }

    /// Whether a frame of the scene reads gradients, and from a texture.
    pub fn has_gradient_texture(&self) -> bool {
        self.reads_gradients() && self.settings.shading.gradients == Gradients::Precomputed
    }

    /// Whether samples take their values from where their gradients are.
    pub fn samples_gradient_texture(&self) -> bool {
        self.surface.is_none() && self.has_gradient_texture()
    }

    /// A bound of the error of an interpolated x that samples take from beside their gradients; 0 where they take none there.
    pub fn error_beside(&self) -> f64 {
        if !self.samples_gradient_texture() {
            return 0.0;
        }
        let coding = GradientCoding::of(self);
        let codes = coding.texture == GradientTexture::Rgba8;
        self.value_slack() + self.error_beside_gradients(codes, coding.to_x[0].abs())
    }

    /// How far a value that a sample takes may be from that of the volume between voxels, as x.
    pub fn value_slack(&self) -> f64 {
        if !self.samples_gradient_texture() {
            return 0.0;
        }
        let map = TextureMap::of(&self.field, TextureChoice::of(self).kept);
        GradientCoding::of(self).slack / map.scale.abs()
    }
}
