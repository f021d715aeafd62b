//! Twin of `glsl/tet_*.frag`: rays from cell to cell of a mesh, in f64.

use super::{DEAD, Effect, Pixel, Twin};
use crate::projection::SampleWeight;
use crate::scene::Tetrahedra;
use crate::scene::tetrahedra::seen::{Line, area};
use crate::scene::tetrahedra::{CellWay, Entry, FacePoint, NOTHING};

/// Single precision may see a ray on the other side of an edge that it passes at this distance, volume space: then it may go through
/// another number of cells, whose light together is the same.
const BESIDE_EDGE: f64 = 2e-6;

/// Where a way is more opaque than this, its end may be next to an opacity of 1, at which the light falls to nothing within what single
/// precision takes from a value.
const NEARLY_OPAQUE: f64 = 0.5;

/// What single precision takes from a value, in x.
pub(super) const VALUE_ROUNDING: f64 = 1.0 / (1 << 22) as f64;

/// A ray on its way through cells: the side by which it enters one, and where.
pub type CellState = (u32, FacePoint);

/// The layer that the part of the ray lies behind which is drawn.
fn behind(pixel: &Pixel) -> u32 {
    pixel.section.saturating_sub(1)
}

/// Finds the face of a layer by which the ray enters.
pub fn enter(twin: &Twin, pixel: &mut Pixel, layer: u32) -> Effect {
    let found = twin.cell_entry(pixel, layer);
    if found.is_some() { Effect::Silent } else { Effect::Discarded }
}

/// The whole way from the face of a layer to the next face of the boundary.
pub fn single_pass(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let Some((mesh, line)) = twin.mesh_and_line(pixel) else { return Effect::Silent };
    let Some(entry) = twin.cell_entry(pixel, behind(pixel)) else { return Effect::Silent };
    twin.begin_in_mesh(pixel);
    let mut effect = Effect::Silent;
    for way in mesh.chain(&line, entry) {
        if twin.saturated(pixel) {
            break;
        }
        let before = pixel.accumulated;
        twin.through(pixel, way);
        if pixel.accumulated != before {
            effect = Effect::Contributed;
        }
    }
    effect
}

/// Begins behind the face of a layer.
pub fn start(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let entry = twin.cell_entry(pixel, behind(pixel));
    pixel.cell = entry.map(|entry| (entry.side, entry.at));
    if entry.is_some() {
        twin.begin_in_mesh(pixel);
    }
    Effect::Silent
}

/// Marks the pixel dead whose ray has left the mesh, or needs no more.
pub fn update(twin: &Twin, pixel: &mut Pixel, _: u32) -> Effect {
    let saturated = twin.saturated(pixel);
    pixel.stored = if pixel.cell.is_none() || saturated { DEAD } else { 0.0 };
    Effect::Silent
}

/// Goes through the current cell.
pub fn propagate(twin: &Twin, pixel: &mut Pixel, pass: u32) -> Effect {
    let Some(((mesh, line), (side, from))) = twin.mesh_and_line(pixel).zip(pixel.cell) else { return Effect::Silent };
    let Some((leaves, to)) = mesh.leave(&line, side) else { return Effect::Silent };
    pixel.undecided |= beside_edge(mesh, &line, leaves);
    let before = pixel.accumulated;
    twin.through(pixel, CellWay { cell: side / 4, from, to, begins: pass == 0 });
    let next = mesh.across[leaves as usize / 4][leaves as usize % 4];
    pixel.cell = (next != NOTHING).then_some((next, to));
    if pixel.accumulated == before { Effect::Silent } else { Effect::Contributed }
}

/// Whether a line passes an edge of a face so near that single precision may see it on the other side.
pub(super) fn beside_edge(mesh: &Tetrahedra, line: &Line, side: u32) -> bool {
    let corners = mesh.face(line, side);
    (0..3).any(|i| {
        let (a, b) = (&corners[i], &corners[(i + 1) % 3]);
        let length = (a.place[0] - b.place[0]).hypot(a.place[1] - b.place[1]);
        area(a, b).abs() <= BESIDE_EDGE * length
    })
}

impl Twin<'_> {
    pub(super) fn mesh_and_line(&self, pixel: &Pixel) -> Option<(&Tetrahedra, Line)> {
        let ray = self.rays.of(pixel.column, pixel.row);
        Some((self.scene.tetrahedra.as_deref()?, Line::new(ray.origin, ray.direction)))
    }

    /// The face of a layer by which the ray enters: of the layer 0 where rays begin within the mesh, that behind which this one does.
    fn cell_entry(&self, pixel: &mut Pixel, layer: u32) -> Option<Entry> {
        let mesh = self.scene.tetrahedra.as_deref()?;
        let begins = self.cells.and_then(|cells| cells.begins.as_ref());
        if pixel.entries.is_none() {
            let ray = self.rays.of(pixel.column, pixel.row);
            let line = Line::new(ray.origin, ray.direction);
            let all = mesh.entries(&line, (ray.origin, ray.direction));
            let near = self.rays.near;
            let goes_on = |entry: &&Entry| mesh.chain(&line, **entry).any(|way| way.to.depth > near);
            let begin = all.iter().filter(|entry| entry.at.depth < near).rev().find(goes_on).copied();
            let ahead = all.iter().filter(|entry| entry.at.depth >= near).map(|entry| Some(*entry));
            pixel.entries = Some(begins.map(|_| begin).into_iter().chain(ahead).collect());
        }
        pixel.entries.as_ref()?.get(layer as usize).copied().flatten()
    }

    /// What a ray of values begins with where it enters the mesh first.
    fn begin_in_mesh(&self, pixel: &mut Pixel) {
        if self.projection.shows_values() && pixel.accumulated[3] == 0.0 {
            let [value, ..] = self.no_sample();
            pixel.accumulated = [value, value, value, 1.0];
        }
    }

    /// Joins what a way through a cell brings.
    fn through(&self, pixel: &mut Pixel, way: CellWay) {
        let Some(way) = way.behind(self.rays.near) else { return };
        if self.scene.surface.is_some() {
            return self.through_surfaces(pixel, &way);
        }
        pixel.accumulated = self.projection.blend.apply(pixel.accumulated, self.cell_light(pixel, way.from, way.to));
    }

    /// What the way between two places within a cell brings.
    pub(super) fn cell_light(&self, pixel: &mut Pixel, from: FacePoint, to: FacePoint) -> [f64; 4] {
        let ray = self.rays.of(pixel.column, pixel.row);
        let lengths = (to.depth - from.depth).max(0.0) * ray.direction.length()
            / (self.scene.transfer.reference * self.scene.field.finest());
        match (&self.projection.values, self.cell_table) {
            (None, Some(table)) => table.between(from.value, to.value, lengths),
            (None, None) => {
                let ramp = |by: f64| {
                    self.medium.map_or([0.0; 4], |medium| medium.ramp(from.value - by, to.value - by, lengths))
                };
                let light = ramp(0.0);
                if light[3] > NEARLY_OPAQUE {
                    let off = (light[3] - ramp(VALUE_ROUNDING)[3]).abs();
                    pixel.rounding += (1.0 - pixel.accumulated[3]) * off;
                }
                light
            }
            (Some(values), _) => {
                let weight = SampleWeight { steps: lengths, all: 1.0, lengths: 1.0 };
                let part = |x: f64| self.projection.grey((values.part)(x, &self.levels, &weight));
                match self.projection.blend {
                    // Of a sum the mean counts, of an extreme that of both ends.
                    crate::math::blend::Blend::Add => part(0.5 * (from.value + to.value)),
                    blend => blend.apply(part(from.value), part(to.value)),
                }
            }
        }
    }
}
