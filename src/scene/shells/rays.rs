//! Where rays meet the polygons of a shell.

use glam::DVec3;

use super::depth::ShellDepth;
use super::levels::Shell;
use crate::math::edges::{WithinEdges, within_edges};
use crate::math::ray::{Lens, ViewRay, ViewRays};
use crate::scene::Field;

/// Where a ray meets a triangle of a shell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShellCrossing {
    /// The triangle's number.
    pub triangle: u32,
    /// Depth in front of the eye, the ray's own parameter.
    pub depth: f64,
    /// The depth buffer's, from 0 at the far end to 1 at the near end.
    pub stored: f64,
    /// How far a rasteriser may see `stored` elsewhere, which moves corners to its raster.
    pub spread: f64,
    /// Whether the ray goes into the shell there.
    pub enters: bool,
}

impl ShellCrossing {
    /// How far its depth may be off, by how far that of the depth buffer may be.
    pub fn moved(&self, depths: &ShellDepth) -> f64 {
        match depths.lens {
            Lens::Perspective => self.spread * self.depth.powi(2) * (1.0 / depths.nearest - 1.0 / depths.far),
            Lens::Orthographic => self.spread * (depths.far - depths.nearest),
        }
    }
}

/// The crossings of a pixel's ray with a shell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShellCrossings {
    /// In the order of triangles, which is that of drawing.
    pub list: Vec<ShellCrossing>,
    /// Whether a rasteriser may find others.
    pub undecided: bool,
}

/// What f32 takes from a depth of the depth buffer.
const STORED_ROUNDING: f64 = 4e-7;

impl Shell {
    /// Where the ray through a pixel's centre meets the shell, beyond the near plane. `raster`: steps of the raster that a rasteriser moves
    /// corners to, in pixels.
    pub fn crossings(
        &self,
        field: &Field,
        rays: &ViewRays,
        pixel: [u32; 2],
        depth: &ShellDepth,
        raster: f64,
    ) -> ShellCrossings {
        let ray = rays.of(pixel[0], pixel[1]);
        let pixel_width = rays.right.length() + rays.down.length();
        let wide = match rays.lens {
            Lens::Perspective => pixel_width * depth.far,
            Lens::Orthographic => pixel_width,
        };
        let mut met = self.hierarchy(field).met(ray.origin, ray.direction, raster * wide);
        met.sort_unstable();
        let mut found = ShellCrossings::default();
        let mut unsure: Vec<(ShellCrossing, [bool; 3])> = Vec::new();
        for number in met {
            let arms = self.triangle(field, number as usize).map(|corner| corner - ray.origin);
            let Some((crossing, within)) = crossing(rays, &ray, number, arms, depth, raster) else { continue };
            // A fragment there may lie on either side of the near plane.
            let cut = (crossing.stored - 1.0).abs() <= crossing.spread
                || (crossing.depth - rays.near).abs() <= STORED_ROUNDING;
            found.undecided |= cut && depth.nearest <= rays.near;
            unsure.extend(within.is_unsure().then_some((crossing, within.unsure)));
            found.list.extend(within.here.then_some(crossing));
        }
        // Where two triangles that are seen from one side share an edge, one of them is met there whatever the rasteriser does.
        let corners = |crossing: &ShellCrossing| self.polygons(field).triangles[crossing.triangle as usize];
        let is_outline = |one: &ShellCrossing, edge: usize| {
            let triangle = corners(one);
            let ends = [triangle[edge], triangle[(edge + 1) % 3]];
            let shares = |other: &ShellCrossing| ends.iter().all(|end| corners(other).contains(end));
            !unsure
                .iter()
                .any(|(other, _)| one.triangle != other.triangle && one.enters == other.enters && shares(other))
        };
        found.undecided |= unsure.iter().any(|(one, edges)| (0..3).any(|edge| edges[edge] && is_outline(one, edge)));
        found
    }
}

/// Where the ray through a pixel's centre meets a triangle with these corners, beyond the near plane.
pub fn crossing_of(
    rays: &ViewRays,
    pixel: [u32; 2],
    number: u32,
    corners: [[f32; 3]; 3],
    depths: &ShellDepth,
    raster: f64,
) -> Option<ShellCrossing> {
    let ray = rays.of(pixel[0], pixel[1]);
    let arms = corners.map(|corner| DVec3::from_array(corner.map(f64::from)) - ray.origin);
    crossing(rays, &ray, number, arms, depths, raster).map(|(crossing, _)| crossing)
}

/// Where a ray meets the plane of a triangle with these corners, as arms from where the ray comes from, and whether inside of its edges.
fn crossing(
    rays: &ViewRays,
    ray: &ViewRay,
    number: u32,
    arms: [DVec3; 3],
    depths: &ShellDepth,
    raster: f64,
) -> Option<(ShellCrossing, WithinEdges)> {
    let normal = (arms[1] - arms[0]).cross(arms[2] - arms[0]);
    let (height, slope) = (normal.dot(arms[0]), normal.dot(ray.direction));
    let enters = slope < 0.0;
    if slope == 0.0 {
        return None;
    }
    let within = within_edges(rays, ray, arms, enters, raster)?;
    let to_depth = rays.to_picture().row(2);
    let corners = arms.map(|arm| to_depth.dot(arm));
    let [least, greatest] = [f64::min, f64::max].map(|of| corners.into_iter().reduce(of).unwrap_or_default());
    // Rounding may take it out of a triangle that is seen nearly from the side.
    let depth = (height / slope).clamp(least, greatest);
    if depth.is_nan() || depth < rays.near {
        return None;
    }
    let stored = depths.stored(depth);
    // What a pixel to the right, or down, adds to `stored`, and the most that there is between the corners.
    let steep = |across: DVec3| match rays.lens {
        Lens::Perspective => normal.dot(across) / height * depths.stored_of_inverse(),
        Lens::Orthographic => normal.dot(across) / slope * depths.stored_of_depth(),
    };
    let moved = raster * (steep(rays.right).abs() + steep(rays.down).abs());
    let apart = depths.stored(least.max(rays.near)) - depths.stored(greatest);
    let spread = moved.min(apart.abs()) + STORED_ROUNDING;
    Some((ShellCrossing { triangle: number, depth, stored, spread, enters }, within))
}
