//! Errors of iso-surfaces: where rays meet them, which normals they have there, and which colours.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::{Point, SurfaceError, SurfaceOrders, fit};
use crate::error::{Error, Result};
use crate::measure::picture::Picture;
use crate::scene::Scene;
use crate::scene::settings::{Accumulate, Refine, Settings, Shows};
use crate::truth::exact::ExactIntegrator;

/// A place that is off by a whole step is still on the sheet that was sought, whatever f32 makes of it.
const SLACK: f64 = 1e-3;

/// Pictures of what each ray meets of a surface: opacity 1 where it meets it, else 0.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePictures<'a> {
    /// Places in volume space.
    pub places: &'a Picture,
    /// Normals in volume space, of length 1; 0 where there are none.
    pub normals: &'a Picture,
    pub colors: &'a Picture,
}

/// What rays meet of the exact surface.
pub struct ExactSurface {
    pub places: Picture,
    pub normals: Picture,
}

impl ExactSurface {
    /// None of a scene without a surface, of one with polygons, whose colours no place and no normal can be blended with, and of a mesh of
    /// cells, in which rays meet surfaces where the exact ones do.
    ///
    /// # Errors
    /// When no ray meets the surface, so that there is nothing to hold against it.
    pub fn of(scene: &Scene) -> Result<Option<Self>> {
        if scene.surface.is_none() || scene.polygons.show() || scene.tetrahedra.is_some() {
            return Ok(None);
        }
        let shown = |shows: Shows| {
            let mut scene = scene.clone();
            shows_only(&mut scene.settings, shows);
            exact(&scene)
        };
        let (places, normals) = (shown(Shows::Position)?, shown(Shows::Normal)?);
        if places.pixels.iter().all(|pixel| pixel[3] == 0.0) {
            let [least, most] = scene.field.value_extremes().unwrap_or(scene.field.range);
            return Err(Error::usage(
                "surface (--iso)",
                "is met by no ray of this view, and there is nothing to hold against it",
                format!(
                    "give a value that the volume has in view (all of its values run from {least} to {most}), or another view"
                ),
            ));
        }
        Ok(Some(Self { places, normals }))
    }
}

/// Changes settings so that a picture shows places or normals, whatever colours are summed up in.
pub fn shows_only(settings: &mut Settings, shows: Shows) {
    (settings.surface.shows, settings.image.accumulate) = (shows, Accumulate::Rgba32f);
}

/// The exact picture of a scene, without early termination.
///
/// # Errors
/// When the camera is not one.
pub fn exact(scene: &Scene) -> Result<Picture> {
    let size = scene.settings.image.size;
    let rays = scene.camera.rays(size)?;
    let pixels = ExactIntegrator::of(scene).picture(&rays, size);
    Picture::new(size, pixels.into_iter().map(|pixel| pixel.map(|c| c as f32)).collect())
}

/// How far what was found is from the truth, of pictures of one size; `step` in volume units.
pub fn surface_error(found: SurfacePictures, truth: SurfacePictures, step: f64) -> SurfaceError {
    let (mut pixels, mut missed) = (0, 0);
    let (mut places, mut normals, mut colors) = (Mean::default(), Mean::default(), Mean::default());
    let pairs = |of: fn(SurfacePictures) -> &[[f32; 4]]| of(found).iter().zip(of(truth));
    let all = pairs(|pictures| &pictures.places.pixels)
        .zip(pairs(|pictures| &pictures.normals.pixels))
        .zip(pairs(|pictures| &pictures.colors.pixels));
    for ((place, normal), color) in all {
        let met = [place.0[3], place.1[3]].map(|opacity| opacity > 0.0);
        if met == [false; 2] {
            continue;
        }
        pixels += 1;
        let apart = (vector(place.0) - vector(place.1)).length();
        // One that is no number is missed too.
        if met != [true; 2] || apart.is_nan() || apart > step * (1.0 + SLACK) {
            missed += 1;
            continue;
        }
        places.add(apart * apart);
        if let Some(angle) = angle(vector(normal.0), vector(normal.1)) {
            normals.add(angle * angle);
        }
        colors.add((vector(color.0) - vector(color.1)).length_squared() / 3.0);
    }
    SurfaceError { position: places.root(), normal: normals.root(), color: colors.root(), missed, pixels }
}

/// A mean of squares.
#[derive(Clone, Copy, Default)]
struct Mean {
    sum: f64,
    count: u64,
}

impl Mean {
    fn add(&mut self, square: f64) {
        self.sum += square;
        self.count += 1;
    }

    /// Its root; none of no squares at all.
    fn root(self) -> Option<f64> {
        let root = (self.sum / self.count as f64).sqrt();
        root.is_finite().then_some(root)
    }
}

fn vector(pixel: &[f32; 4]) -> DVec3 {
    let [x, y, z, _] = pixel.map(f64::from);
    DVec3::new(x, y, z)
}

/// The angle between the lines along two normals, in radians: a surface that is seen from the side may be turned either way. None
/// where there is no true normal; a right angle where that alone is there.
fn angle(found: DVec3, truth: DVec3) -> Option<f64> {
    match [found, truth].map(|normal| normal == DVec3::ZERO) {
        [_, true] => None,
        [true, false] => Some(FRAC_PI_2),
        [false, false] => Some(found.cross(truth).length().atan2(found.dot(truth).abs())),
    }
}

/// The orders of a scene's errors in the step; none where no picture has any.
pub fn surface_orders(scene: &Scene, points: &[Point]) -> Option<SurfaceOrders> {
    let errors = |of: fn(&SurfaceError) -> Option<f64>| {
        let known = |point: &Point| Some((point.step, of(point.surface.as_ref()?)?));
        fit(&points.iter().filter_map(known).collect::<Vec<_>>())
    };
    points.iter().any(|point| point.surface.is_some()).then(|| SurfaceOrders {
        position: errors(|error| error.position),
        normal: errors(|error| error.normal),
        color: errors(|error| error.color),
        expected_position: match scene.settings.surface.refine {
            Refine::None => Some(1.0),
            // Of the second order within a cell. Where a step goes through a face between cells the interpolant has a corner, and the
            // place is off by the first order; such steps are a share of all that falls with the step, so that root mean squares fall with
            // an order from 1.5 on, which a remark says.
            Refine::Linear => Some(2.0),
            Refine::Exact => None,
        },
    })
}
