//! Distances along bundles of rays: from each cell to the first interesting one that a ray of its bundle may meet.
//!
//! `optimal` [Thesis §5.3.1]: the rays of a view, from the eye through any point of the cell. Departure: the thesis takes
//! one direction for the whole view, which misses samples under perspective; here the bound holds for every ray through
//! the cell's box. `cone` [Thesis §5.7]: the rays through any point of the cell whose directions are within an angle of
//! that from the eye to the point, so that the bound still holds when the camera has moved a little
//! ([`LookupView::serves`]).
//!
//! Lengths are in voxels of the finest spacing, from the first voxel's centre. With m the centre of the cell's box, h its
//! half sides and v the direction from the eye to m, all that rays of the bundle reach while the centre's goes the way l
//! lies in the box (m + l v) +- (h + spread l), and in the ball of radius |h| + widening l about m + l v:
//!
//! - `optimal`: everything grows with the distance from the eye, spread = h / |m - eye|, widening = |h| / |m - eye|; a
//!   ray through another point of the box is shorter by (|m - eye| - |h|) / |m - eye| at the most.
//! - `optimal` of an orthographic view: nothing grows and nothing is shorter, since there is one direction.
//! - `cone`: a unit vector within an angle t of another is within 2 sin(t/2) of it, and the directions to two points of the
//!   box differ by less than `WITHIN` |h| / |m - eye|; their sum is spread on every axis, and widening.
//!
//! The way is searched by balls as long as the distance in any direction leaves room for one, else by short steps: the
//! box that a step sweeps is held against the interesting cells, and where one of a cell is among them, the way at which
//! the bundle enters it is found exactly, axis by axis. Nothing is nearer than the distance between the two boxes, so that
//! the bound is never below that of [`super::octants`].
//!
//! Boxes of 4^3 and 2^3 cells are searched first, which ends at the first step that may meet something: what is free for
//! all rays through one is free for those through each of its cells, whose search begins there. (Directions of a cone
//! differ from box to box, so the cones of larger boxes are wider, by `WIDER`.) Border cells reach out to the faces of
//! the volume. In f32, operation by operation as in `glsl/structure/bundle.comp`, its twin.

use rayon::prelude::*;

use super::grid::{DistanceField, FAR, Grid, byte_of};
use super::wide::Wide;
use super::{LookupView, RaysFrom};
use crate::scene::Field;

/// Room for f32, in voxels: coordinates of up to some thousand voxels, rounded a few times.
const MARGIN: f32 = 1.0 / 512.0;

/// Steps along a ray before the search ends where it is.
const STEPS: u32 = 1024;

/// More than any distance that is told apart, in voxels.
const BEYOND: f32 = 257.0;

/// So many voxels, known of the larger box, are not searched for more: a ray that gets there looks again, which costs a
/// fragment of an intermediate pass, and no main pass is run for it in between.
const ENOUGH: u8 = 32;

/// Cells along the side of the largest window whose cells are looked at one by one.
const WINDOW: usize = 5;

/// A direction that changes a coordinate by less than this in a voxel bounds nothing.
const ALONG: f32 = 1e-6;

/// Sides of the boxes that are searched, in cells.
pub const SCALES: [usize; 3] = [4, 2, 1];

/// How far directions to two points of a box may differ, in |h| / |m - eye|: an angle whose sine is x has a chord of at
/// most sqrt(2) x.
const WITHIN: f32 = 1.5;

/// The same for boxes of several cells, with what the next smaller boxes add on their part, where the eye is `AWAY` |h|
/// or more from the box.
const WIDER: f32 = 3.0;
const AWAY: f32 = 3.0;

/// The bundles of all cells of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bundles {
    /// The eye, or the one direction of all rays.
    pub from: [f32; 3],
    /// Whether all rays have one direction.
    pub parallel: bool,
    /// Sides of a cell of the grid.
    pub sides: [f32; 3],
    /// Faces of the volume.
    pub low: [f32; 3],
    pub high: [f32; 3],
    /// 2 sin(t/2) of a cone; 0 for the rays of the view.
    pub spread: f32,
    /// Length of a short step.
    pub step: f32,
}

impl Bundles {
    pub fn new(grid: &Grid, field: &Field, view: &LookupView) -> Self {
        let spacing = grid.sides / grid.cell as f64;
        let dims = glam::DVec3::from_array(field.dims().map(|n| n as f64));
        let single = |v: glam::DVec3| v.as_vec3().to_array();
        let (from, parallel) = match view.from {
            RaysFrom::Eye(eye) => (eye_in_voxels(grid, field, eye), false),
            // Voxels of the finest spacing are as long on all axes.
            RaysFrom::Along(direction) => (direction, true),
        };
        Self {
            from: single(from),
            parallel,
            sides: single(grid.sides),
            low: single(-0.5 * spacing),
            high: single((dims - 0.5) * spacing),
            spread: view.half_angle.map_or(0.0, |t| 2.0 * (0.5 * t).sin()) as f32,
            step: grid.cell as f32,
        }
    }
}

/// A point of volume space in voxels of the finest spacing, from the first voxel's centre.
fn eye_in_voxels(grid: &Grid, field: &Field, point: glam::DVec3) -> glam::DVec3 {
    let dims = glam::DVec3::from_array(field.dims().map(|n| n as f64));
    ((point / field.extent() + 0.5) * dims - 0.5) * (grid.sides / grid.cell as f64)
}

/// Distances of all cells along their bundles. `omni` are those in any direction, `interesting` has one flag a cell.
pub fn along(omni: &DistanceField, interesting: &[bool], bundles: &Bundles) -> DistanceField {
    let one = Wide::of(&omni.grid, interesting);
    let two = one.widened(1);
    let four = two.widened(2);
    let mut found: Option<Level> = None;
    for scale in SCALES {
        let boxes = omni.grid.cells.map(|n| n.div_ceil(scale));
        let search = Search { bundles, omni, one: &one, two: &two, four: &four, scale, boxes, larger: found.as_ref() };
        let mut bytes = vec![0; boxes.iter().product()];
        bytes.par_chunks_mut(boxes[0]).enumerate().for_each(|(row, line)| {
            for (x, byte) in line.iter_mut().enumerate() {
                *byte = search.byte([x, row % boxes[1], row / boxes[1]]);
            }
        });
        found = Some(Level { boxes, bytes });
    }
    DistanceField { grid: omni.grid, octants: 1, bytes: found.map(|level| level.bytes).unwrap_or_default() }
}

/// What was found for boxes of one size. Those of several cells are not said to be interesting.
struct Level {
    boxes: [usize; 3],
    bytes: Vec<u8>,
}

struct Search<'a> {
    bundles: &'a Bundles,
    omni: &'a DistanceField,
    /// Interesting cells, and any among 2^3 and 4^3 from each on.
    one: &'a Wide,
    two: &'a Wide,
    four: &'a Wide,
    /// Side of a box in cells, and how many there are.
    scale: usize,
    boxes: [usize; 3],
    /// The boxes twice as large.
    larger: Option<&'a Level>,
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// A box and its bundle.
#[derive(Clone, Copy)]
struct Rays {
    middle: [f32; 3],
    half: [f32; 3],
    direction: [f32; 3],
    spreads: [f32; 3],
}

impl Search<'_> {
    fn byte(&self, at: [usize; 3]) -> u8 {
        if self.scale == 1 && self.one.at(at) { byte_of(true, 0) } else { byte_of(false, self.free(at)) }
    }

    /// Voxels that are free along every ray of the box.
    fn free(&self, at: [usize; 3]) -> u8 {
        let Bundles { from, parallel, low, high, spread, step, .. } = *self.bundles;
        let scale = self.scale;
        let known = self.larger.map_or(0, |level| {
            let [x, y, z] = at.map(|i| i / 2);
            level.bytes[(z * level.boxes[1] + y) * level.boxes[0] + x].saturating_sub(1)
        });
        let least = if scale == 1 { known.max(self.omni_at(at)) } else { known };
        if known >= ENOUGH {
            return least;
        }
        let (begin, end) = self.faces(at, scale, self.boxes);
        let middle: [f32; 3] = std::array::from_fn(|a| 0.5 * (begin[a] + end[a]));
        let half: [f32; 3] = std::array::from_fn(|a| 0.5 * (end[a] - begin[a]));
        let way: [f32; 3] = std::array::from_fn(|a| middle[a] - from[a]);
        let away = if parallel { f32::INFINITY } else { dot(way, way).sqrt() };
        let radius = dot(half, half).sqrt();
        // Seen from within, rays go anywhere.
        if away <= if scale == 1 { radius + 1.0 } else { AWAY * radius } {
            return least;
        }
        let direction = if parallel { from } else { way.map(|w| w / away) };
        let cone = spread > 0.0;
        let wider = spread + if scale == 1 { WITHIN } else { WIDER } * (radius / away);
        let spreads = half.map(|h| if cone { wider } else { h / away });
        let widening = if cone { wider } else { radius / away };
        let shortened = if cone || parallel { 1.0 } else { (away - radius) / away };
        let lengthened = if cone || parallel { 1.0 } else { (away + radius) / away };
        let short = step * scale as f32;
        let rays = Rays { middle, half, direction, spreads };
        let mut free = f32::from(known) / lengthened;
        let mut nearest = BEYOND;
        let mut steps = 0;
        while free * shortened < nearest {
            let (here, side) = rays.place(free);
            // Rays that have left do not come back.
            if (0..3).any(|a| here[a] + side[a] < low[a] || here[a] - side[a] > high[a]) {
                break;
            }
            steps += 1;
            if steps > STEPS {
                nearest = free * shortened;
                break;
            }
            let cell: [usize; 3] = std::array::from_fn(|a| self.cell_of(here[a], a));
            let room = f32::from(self.omni_at(cell)) - (radius + widening * free) - MARGIN;
            if room > short {
                free += room / (1.0 + widening);
                continue;
            }
            let (there, side_there) = rays.place(free + short);
            let mut first = [0; 3];
            let mut last = [0; 3];
            for a in 0..3 {
                first[a] = self.cell_of((here[a] - side[a]).min(there[a] - side_there[a]) - MARGIN, a);
                last[a] = self.cell_of((here[a] + side[a]).max(there[a] + side_there[a]) + MARGIN, a);
            }
            if self.meets(first, last) {
                if scale > 1 || (0..3).any(|a| last[a] - first[a] >= WINDOW) {
                    nearest = free * shortened;
                    break;
                }
                nearest = self.nearest_of(at, &rays, [first, last], free, shortened).min(nearest);
            }
            free += short;
        }
        let whole = (nearest - MARGIN).floor().clamp(0.0, f32::from(FAR)) as u8;
        whole.max(least)
    }

    /// Free in any direction.
    fn omni_at(&self, cell: [usize; 3]) -> u8 {
        self.omni.bytes[self.omni.grid.index(cell)].saturating_sub(1)
    }

    /// How far the rays of cell `at` go before they meet the first of the interesting cells of a window.
    fn nearest_of(&self, at: [usize; 3], rays: &Rays, window: [[usize; 3]; 2], free: f32, shortened: f32) -> f32 {
        let sides = self.bundles.sides;
        let [first, last] = window;
        let mut nearest = BEYOND;
        for z in first[2]..=last[2] {
            for y in first[1]..=last[1] {
                let mut bits = self.one.from([first[0], y, z], last[0] - first[0] + 1);
                while bits != 0 {
                    let cell = [first[0] + bits.trailing_zeros() as usize, y, z];
                    bits &= bits - 1;
                    if rays.behind(at, cell) {
                        continue;
                    }
                    let gap: [f32; 3] =
                        std::array::from_fn(|a| at[a].abs_diff(cell[a]).saturating_sub(1) as f32 * sides[a]);
                    let (begin, end) = self.faces(cell, 1, self.omni.grid.cells);
                    let enters = rays.enter(begin, end, free);
                    nearest = nearest.min(dot(gap, gap).sqrt().max(enters * shortened));
                }
            }
        }
        nearest
    }

    /// Faces of a box of `scale`^3 cells; those at the border are the volume's.
    fn faces(&self, at: [usize; 3], scale: usize, boxes: [usize; 3]) -> ([f32; 3], [f32; 3]) {
        let Bundles { sides, low, high, .. } = self.bundles;
        let begin = |a: usize| if at[a] == 0 { low[a] } else { (at[a] * scale) as f32 * sides[a] };
        let end = |a: usize| if at[a] + 1 == boxes[a] { high[a] } else { ((at[a] + 1) * scale) as f32 * sides[a] };
        (std::array::from_fn(begin), std::array::from_fn(end))
    }

    fn cell_of(&self, coordinate: f32, axis: usize) -> usize {
        let last = (self.omni.grid.cells[axis] - 1) as f32;
        (coordinate / self.bundles.sides[axis]).floor().clamp(0.0, last) as usize
    }

    /// Whether a cell from `first` to `last` is interesting; a window of more than 8 cells counts as one that is.
    fn meets(&self, first: [usize; 3], last: [usize; 3]) -> bool {
        let widest = (0..3).map(|a| last[a] - first[a]).max().unwrap_or(0);
        let (wide, covers) = match widest {
            0..4 => (self.two, 2),
            4..8 => (self.four, 4),
            _ => return true,
        };
        // Two overlapping lookups on an axis where one does not cover the window.
        let ends = |a: usize| [first[a], (last[a] + 1).saturating_sub(covers).max(first[a])];
        let once = |[a, b]: [usize; 2]| if a == b { 1 } else { 2 };
        let (xs, ys, zs) = (ends(0), ends(1), ends(2));
        zs[..once(zs)]
            .iter()
            .any(|&z| ys[..once(ys)].iter().any(|&y| xs[..once(xs)].iter().any(|&x| wide.at([x, y, z]))))
    }
}

impl Rays {
    /// Centre and half sides of what the bundle reaches after the way `free`.
    fn place(&self, free: f32) -> ([f32; 3], [f32; 3]) {
        let centre = std::array::from_fn(|a| self.middle[a] + free * self.direction[a]);
        let side = std::array::from_fn(|a| self.half[a] + free * self.spreads[a]);
        (centre, side)
    }

    /// Whether a cell lies where no ray of the bundle from cell `at` goes, on some axis, though the boxes may touch.
    fn behind(&self, at: [usize; 3], cell: [usize; 3]) -> bool {
        (0..3).any(|a| {
            let (slow, fast) = (self.direction[a] - self.spreads[a], self.direction[a] + self.spreads[a]);
            cell[a] < at[a] && slow > ALONG || cell[a] > at[a] && fast < -ALONG
        })
    }

    /// The way, `free` or more, after which the bundle reaches into a box; [`BEYOND`] where it passes by. On each axis
    /// |middle + way direction - its middle| <= half + way spread + its half side, two inequalities linear in the way.
    fn enter(&self, begin: [f32; 3], end: [f32; 3], free: f32) -> f32 {
        let (mut enter, mut leave) = (free, BEYOND);
        for a in 0..3 {
            let apart = 0.5 * (begin[a] + end[a]) - self.middle[a];
            let reach = self.half[a] + 0.5 * (end[a] - begin[a]) + MARGIN;
            let (slow, fast) = (self.direction[a] - self.spreads[a], self.direction[a] + self.spreads[a]);
            // way slow <= apart + reach and way fast >= apart - reach.
            let (most, least) = ((apart + reach) / slow, (apart - reach) / fast);
            if slow > ALONG {
                leave = leave.min(most);
            } else if slow < -ALONG {
                enter = enter.max(most);
            }
            if fast > ALONG {
                enter = enter.max(least);
            } else if fast < -ALONG {
                leave = leave.min(least);
            }
        }
        if enter <= leave { enter } else { BEYOND }
    }
}

impl LookupView {
    /// Whether distances made for this view hold for every ray of another one.
    ///
    /// For the rays of the view alone that is its own eye. For a cone: a ray from the moved eye e' through a point p has the
    /// direction p - e', which differs from p - e by |e' - e|; so the angle between them is at most
    /// asin(|e' - e| / |p - e|), and no point is nearer than the volume's box. The rays of orthographic views have one direction each, and
    /// those of the other kind are not served.
    pub fn serves(&self, grid: &Grid, field: &Field, from: RaysFrom) -> bool {
        let Some(half_angle) = self.half_angle.filter(|_| self.from != from) else { return self.from == from };
        // The sine of the angle is rounded to f32 in what the structure was made with.
        let rounding = 1.0 - 16.0 * f64::from(f32::EPSILON);
        let [made_for, moved] = match [self.from, from] {
            [RaysFrom::Eye(made_for), RaysFrom::Eye(moved)] => {
                [made_for, moved].map(|eye| eye_in_voxels(grid, field, eye))
            }
            [RaysFrom::Along(a), RaysFrom::Along(b)] => {
                return a.distance(b) < 2.0 * (0.5 * half_angle).sin() * rounding;
            }
            _ => return false,
        };
        let spacing = grid.sides / grid.cell as f64;
        let dims = glam::DVec3::from_array(field.dims().map(|n| n as f64));
        let nearest = made_for.clamp(-0.5 * spacing, (dims - 0.5) * spacing).distance(made_for);
        made_for.distance(moved) < nearest * half_angle.sin() * rounding
    }
}
