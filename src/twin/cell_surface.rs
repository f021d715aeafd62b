//! Twin of `glsl/shared/cell_surface.glsl`: iso-surfaces within the cells of a mesh [Weiler03 "Isosurface Ray Casting"].

use super::lighting::LOOSE;
use super::tetrahedra::{VALUE_ROUNDING, beside_edge};
use super::{Pixel, Twin};
use crate::math::blend::Blend;
use crate::scene::light::LitPoint;
use crate::scene::tetrahedra::{CellWay, FacePoint, MetInCell};

/// A level that is no further from x at a face of a cell, single precision may have within the cell or beyond that face, where the gradient
/// is another one.
const BESIDE_FACE: f64 = 1e-5;

/// What f32 takes from a component of a gradient, for each part of what cancels out.
const PRODUCT_ROUNDING: f64 = 4.0 * f32::EPSILON as f64;

impl Twin<'_> {
    /// Joins the surfaces that a ray meets on its way through a cell, and what is between them.
    pub(super) fn through_surfaces(&self, pixel: &mut Pixel, way: &CellWay) {
        let levels: Vec<f64> =
            self.scene.surface.iter().flat_map(|surface| &surface.levels).map(|level| level.values[0]).collect();
        let ends = [way.from.value, way.to.value];
        let beside = |level: &f64| ends.iter().any(|value| (value - level).abs() < BESIDE_FACE);
        pixel.undecided |= pixel.accumulated[3] < 1.0 && levels.iter().any(beside);
        let mut from = way.from;
        let all = way.meets(&levels);
        pixel.undecided |= !all.is_empty() && self.may_miss(pixel, way.cell);
        for met in all {
            self.put_volume(pixel, from, met.at);
            self.put_met(pixel, way, &met);
            from = met.at;
        }
        self.put_volume(pixel, from, way.to);
    }

    /// Whether single precision may see the ray go through a cell beside this one, whose gradient is another.
    fn may_miss(&self, pixel: &Pixel, cell: u32) -> bool {
        let sides = 4 * cell..4 * cell + 4;
        self.mesh_and_line(pixel)
            .is_some_and(|(mesh, line)| sides.into_iter().any(|side| beside_edge(mesh, &line, side)))
    }

    /// Joins the volume between two places, where it shows.
    fn put_volume(&self, pixel: &mut Pixel, from: FacePoint, to: FacePoint) {
        if self.scene.surfaces_in_volume() {
            let light = self.cell_light(pixel, from, to);
            pixel.accumulated = Blend::Over.apply(pixel.accumulated, light);
        }
    }

    /// Joins what shows of a surface in a cell.
    fn put_met(&self, pixel: &mut Pixel, way: &CellWay, met: &MetInCell) {
        let (Some(mesh), Some(surface)) = (self.scene.tetrahedra.as_deref(), &self.scene.surface) else { return };
        let (level, gradient) = (surface.levels[met.level], mesh.gradient(way.cell));
        let ray = self.rays.of(pixel.column, pixel.row);
        let view = -ray.direction.normalize_or_zero();
        let point = LitPoint { place: ray.at(met.at.depth), normal: gradient.along, view };
        let shaded = self.shaded_point(&point, PRODUCT_ROUNDING * gradient.cancels, level.color, self.lights);
        let part = level.opacity * (1.0 - pixel.accumulated[3]);
        // What of the volume counts as in front of it.
        let moved = VALUE_ROUNDING / (way.to.value - way.from.value).abs().max(VALUE_ROUNDING);
        let moved =
            if self.scene.surfaces_in_volume() { moved * self.cell_light(pixel, way.from, way.to)[3] } else { 0.0 };
        pixel.rounding += part * (shaded.rounding + moved);
        pixel.undecided |= part > 0.0 && (shaded.turns || shaded.rounding > LOOSE);
        let [r, g, b] = shaded.color.map(|c| c * level.opacity);
        pixel.accumulated = Blend::Over.apply(pixel.accumulated, [r, g, b, level.opacity]);
    }
}
