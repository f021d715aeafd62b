//! What a clip volume leaves of a ray: cut at the roots of the cubics in the clip volume's cells, and at the faces of its box.

use glam::DVec3;

use super::{ExactIntegrator, VoxelRay};
use crate::math::opacity::composite;
use crate::scene::ClipVolume;

/// A part of a ray, in volume units from its begin, and whether it is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayPart {
    pub from: f64,
    pub to: f64,
    pub kept: bool,
}

impl ExactIntegrator<'_> {
    /// The parts of `entry + t * direction`, t from 0 to `length`, one behind the other: those that are kept, and those between.
    /// Lengths are in volume units, `direction` has length 1.
    pub fn kept_parts(&self, entry: DVec3, direction: DVec3, length: f64) -> Vec<RayPart> {
        let Some(clip) = self.clip else { return vec![RayPart { from: 0.0, to: length, kept: true }] };
        let extent = self.field.extent();
        let origin = clip.voxel(entry / extent + 0.5);
        let direction = DVec3::from_array(clip.rows.map(|row| row.truncate().dot(direction / extent)));
        let line = VoxelRay { origin, direction };
        let [enter, leave] = within_box(clip, &line, length);
        let mut parts: Vec<RayPart> = Vec::new();
        let mut add = |from: f64, to: f64, inside: bool| {
            let kept = inside == clip.keeps_inside;
            match parts.last_mut() {
                _ if from >= to => {}
                Some(before) if before.kept == kept => before.to = to,
                _ => parts.push(RayPart { from, to, kept }),
            }
        };
        add(0.0, enter, false);
        let of_clip = ExactIntegrator::new(&clip.field, self.medium.transfer);
        let mut pieces = Vec::new();
        for pair in of_clip.plane_cuts(&line, length).windows(2) {
            let (a, b) = (pair[0].max(enter), pair[1].min(leave));
            let Some(cell) = (a < b).then(|| of_clip.cell(&line, a, b)).flatten() else { continue };
            let cubic = cell.cubic();
            pieces.clear();
            cubic.cut(&[clip.level], &mut pieces);
            for piece in pieces.windows(2) {
                // Between cuts the level is not crossed.
                let inside = cubic.at(0.5 * (piece[0] + piece[1])) >= clip.level;
                add(a + piece[0] * (b - a), a + piece[1] * (b - a), inside);
            }
        }
        add(leave, length, false);
        parts
    }

    /// Premultiplied RGBA of the kept parts of a ray, each under those in front of it.
    pub(super) fn clipped_ray(&self, entry: DVec3, direction: DVec3, length: f64) -> [f64; 4] {
        let parts = self.kept_parts(entry, direction, length);
        parts.into_iter().filter(|part| part.kept).fold([0.0; 4], |pixel, part| {
            composite(pixel, self.whole_ray(entry + part.from * direction, direction, part.to - part.from))
        })
    }
}

/// From where to where a line lies in the clip volume's box, of 0 to `length`; twice `length` where it misses that.
fn within_box(clip: &ClipVolume, line: &VoxelRay, length: f64) -> [f64; 2] {
    let [low, high] = clip.faces(0.0);
    let (mut enter, mut leave) = (0.0f64, length);
    for axis in 0..3 {
        let (origin, direction) = (line.origin[axis], line.direction[axis]);
        if direction == 0.0 {
            if !(low[axis]..=high[axis]).contains(&origin) {
                return [length; 2];
            }
            continue;
        }
        let [a, b] = [low[axis], high[axis]].map(|face| (face - origin) / direction);
        (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
    }
    if enter < leave { [enter, leave] } else { [length; 2] }
}
