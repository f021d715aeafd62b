//! The texture of gradients, with values beside them [Stegmaier05 §4]. Depends on the volume alone.

use super::{dispatch, unpack};
use crate::glsl::Shader;
use crate::part::{Step, Work};
use crate::resource;
use crate::scene::Scene;
use crate::scene::gradients::GradientCoding;
use crate::scene::settings::{GradientOperator, GradientTexture};
use crate::shared::Slice;

/// Voxels that an invocation looks at.
const CENTRAL_VOXELS: usize = 7;
const SOBEL_VOXELS: usize = 27;

/// The steps that make the gradients of a scene's volume.
pub fn gradients(scene: &Scene) -> Vec<Step> {
    let (shading, coding) = (&scene.settings.shading, GradientCoding::of(scene));
    let format = match shading.format {
        GradientTexture::Rgba8 => "RGBA8",
        GradientTexture::Rgba16f => "RGBA16F",
        GradientTexture::Rgba32f => "RGBA32F",
    };
    let sobel = shading.gradient == GradientOperator::Sobel;
    let mut shader = Shader::new("structure/gradients.comp", [format]);
    shader.defines.extend(sobel.then_some("SOBEL"));
    let [cells_x, cells_y, cells_z] = scene.field.dims().map(|n| n as u32);
    let slice = Slice { end: scene.field.values.len() as u32, cells_x, cells_y, cells_z, ..Slice::default() };
    let mut step = dispatch(
        "gradients".to_owned(),
        shader,
        &[("volume", resource::VOLUME)],
        &[("gradient_texels", resource::GRADIENT_TEXELS)],
        slice,
        if sobel { SOBEL_VOXELS } else { CENTRAL_VOXELS },
    );
    if let Work::Dispatch(dispatch) = &mut step.work {
        let [x, y, z] = coding.factors.map(f32::to_bits);
        dispatch.constants = vec![
            ("WHOLE", u32::from(coding.whole)),
            ("SCALE", coding.scale.to_bits()),
            ("FACTOR_X", x),
            ("FACTOR_Y", y),
            ("FACTOR_Z", z),
            ("BESIDE_TIMES", coding.beside[0].to_bits()),
            ("BESIDE_PLUS", coding.beside[1].to_bits()),
        ];
    }
    vec![step, unpack(resource::GRADIENT_TEXELS, resource::gradients(scene))]
}
