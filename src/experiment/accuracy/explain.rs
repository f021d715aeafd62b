//! The order that theory gives, and why an error may fall faster, slower or not at all.

use crate::method;
use crate::projection::{self, Ends};
use crate::scene::Scene;
use crate::scene::settings::{
    Accumulate, Alpha, Filter, GradientTexture, Gradients, Last, MethodName, Offset, Refine, VolumeTexture,
};

/// Whether nothing shows on the six faces of the volume: no opacity, or, where values are shown, x is 0.
fn vanishes_at_faces(scene: &Scene) -> bool {
    let (field, dims) = (&scene.field, scene.field.dims());
    let values = projection::of(&scene.settings).shows_values();
    let visible = |x: usize, y: usize, z: usize| {
        let value = f64::from(field.values[(z * dims[1] + y) * dims[0] + x]);
        if values { value != 0.0 } else { scene.transfer.visible(value, value) }
    };
    let last = dims.map(|n| n - 1);
    let face = |a: usize, b: usize, at: &dyn Fn(usize, usize) -> [usize; 3]| {
        (0..dims[a]).all(|i| {
            (0..dims[b]).all(|j| {
                let [x, y, z] = at(i, j);
                !visible(x, y, z)
            })
        })
    };
    [0, last[0]].into_iter().all(|x| face(1, 2, &|y, z| [x, y, z]))
        && [0, last[1]].into_iter().all(|y| face(0, 2, &|x, z| [x, y, z]))
        && [0, last[2]].into_iter().all(|z| face(0, 1, &|x, y| [x, y, z]))
}

/// The order of the sum in the step, of a smooth scene and a ray that is not ended early.
pub fn expected_order(scene: &Scene) -> Option<f64> {
    // A picture is off where rays meet another surface, not by how far they are from the right one.
    if scene.surface.is_some() {
        return None;
    }
    let sampling = &scene.settings.sampling;
    let projection = projection::of(&scene.settings);
    if projection.shows_values() {
        return projection.order_of_values(&scene.settings, vanishes_at_faces(scene));
    }
    let jumps = scene.transfer.jumps().next().is_some();
    if sampling.alpha == Alpha::Paper || jumps && !sampling.preintegrates() {
        return None;
    }
    let vanishes = vanishes_at_faces(scene);
    Some(match (sampling.offset, sampling.last) {
        // The value itself is of the second order between samples, and what is made of it is exact.
        _ if sampling.preintegrates() && (vanishes || sampling.last == Last::Partial) => 2.0,
        // Both ends weigh nothing, so that it is the trapezoid rule.
        _ if vanishes => 2.0,
        (Offset::Left, _) => 1.0,
        (Offset::Midpoint, Last::Partial) => 2.0,
        // What the last sample stands for beyond the face, or what is left out before it, is an error of the first order.
        (Offset::Midpoint, Last::Full | Last::None) => 1.0,
    })
}

/// Where the normals of a surface come from, and what that does to their error.
fn gradients(scene: &Scene) -> &'static str {
    let shading = &scene.settings.shading;
    match (shading.gradients, shading.format) {
        (Gradients::OnTheFly, _) => {
            "normals are differences over two voxels, and those of the exact picture the gradient of the interpolant: that does not \
             fall with the step"
        }
        (Gradients::Precomputed, GradientTexture::Rgba8) => {
            "normals are interpolated between gradients at voxels, which are kept in 8 bits, and those of the exact picture are the \
             gradient of the interpolant: that does not fall with the step"
        }
        (Gradients::Precomputed, GradientTexture::Rgba16f | GradientTexture::Rgba32f) => {
            "normals are interpolated between gradients at voxels, and those of the exact picture are the gradient of the interpolant: \
             that does not fall with the step"
        }
    }
}

/// What holds for every way of sampling of a scene.
pub fn remarks_on_all(scene: &Scene) -> Vec<String> {
    let segments = || {
        format!(
            "Segments of main passes are kept about as long as {} samples of one voxel, so that all steps have about as many passes.",
            scene.settings.sampling.samples_per_pass
        )
    };
    // Cells have lengths of their own.
    let mut remarks: Vec<String> = scene.tetrahedra.is_none().then(segments).into_iter().collect();
    let surface = match (&scene.surface, scene.polygons.show()) {
        _ if scene.tetrahedra.is_some() => None,
        (None, _) => None,
        (Some(_), false) => Some(
            "Places, normals and colours are root mean squares over the pixels in which a ray meets the sheet of the surface that the exact \
             ray meets, at most a step from there; pixels in which it meets another one, or one of the two rays meets none, are missed.",
        ),
        (Some(_), true) => Some(
            "Places and normals of the surface are not measured, since the colours of polygons would be blended with them.",
        ),
    };
    remarks.extend(surface.map(str::to_owned));
    remarks
}

/// The explanations that apply to a scene as a method renders it. `opaque`: the exact picture has opacities above T.
pub fn remarks(scene: &Scene, method: MethodName, opaque: bool) -> Vec<String> {
    let (settings, sampling) = (&scene.settings, &scene.settings.sampling);
    let mut remarks = Vec::new();
    let mut say = |applies: bool, words: &str| {
        if applies {
            remarks.push(words.to_owned());
        }
    };
    if scene.surface.is_some() && scene.tetrahedra.is_none() {
        say(
            true,
            "a surface whose values lie between two samples alone is not seen, and the ray meets the next one: such pixels are off by a \
             whole colour, and they are fewer the smaller the step is",
        );
        say(
            scene.settings.surface.refine == Refine::Linear,
            "places between two samples are of the second order in the step within a cell, and of the first where a step goes through \
             a face between cells, which fewer do the shorter they are: root mean squares then fall with an order from 1.5 to 2",
        );
        say(true, gradients(scene));
        return remarks;
    }
    let row = projection::of(&scene.settings);
    if let Some(values) = &row.values {
        say(true, values.remark);
    }
    let colors = !row.shows_values();
    let vanishes = vanishes_at_faces(scene) && colors;
    say(
        colors && sampling.alpha == Alpha::Paper,
        "opacities are taken as they stand, so that the sum grows with the number of samples and has no limit",
    );
    say(
        vanishes && !sampling.preintegrates() && sampling.offset == Offset::Left && sampling.alpha != Alpha::Paper,
        "nothing shows at the faces, where both ends of a ray are: the left sum is the trapezoid rule there, of order 2",
    );
    say(
        sampling.preintegrates(),
        "what lies between the entries of the pre-integrated table is interpolated, an error that does not fall with the step",
    );
    say(
        colors
            && !vanishes
            && (sampling.offset == Offset::Midpoint || sampling.preintegrates())
            && sampling.last == Last::Full,
        "the volume is filled up to its faces, and the last sample stands for a whole step: order 1 instead of 2",
    );
    say(
        colors && !vanishes && sampling.last == Last::None,
        "what is left of a ray behind its last whole step is left out [Stegmaier05 §5]: an error of the first order",
    );
    say(
        colors && scene.transfer.jumps().next().is_some() && !sampling.preintegrates(),
        "the transfer function jumps: where a ray crosses the jump the error is of the first order in the step, and as large as \
         the jump where it only touches it",
    );
    say(
        row.ends == Ends::Opaque
            && method::find(method).is_some_and(|row| row.ends_rays)
            && sampling.termination < 1.0
            && opaque,
        &format!("rays end at an opacity of {}: what lies behind is missing, whatever the step", sampling.termination),
    );
    say(
        sampling.filter == Filter::Hardware,
        "the texture unit interpolates with few fractional bits on many devices, an error that does not fall with the step",
    );
    say(
        settings.volume.texture == VolumeTexture::R16,
        "values are kept in 16 bits, which changes those of wider types a little",
    );
    say(
        settings.image.accumulate != Accumulate::Rgba32f,
        "colours are summed up in fewer bits than f32, once a pass: an error that does not fall with the step",
    );
    remarks
}
