//! The emission-absorption integral along a ray, to near the limits of f64: the truth that every sampled picture
//! approaches as its step goes to 0. And what a ray meets of the field itself, for projections of values: the extrema and the
//! integral of the interpolant, cell by cell in closed form.
//!
//! C = integral of c(s) sigma(s) exp(-tau(s)) ds and opacity 1 - exp(-tau(L)), with
//! sigma = -ln(1 - alpha) / reference length.
//!
//! It shares no sampling with the renderers and their twins. The ray is cut where the interpolant or the transfer
//! function has a corner: at every plane of voxel centres, and inside a cell, where the scalar is a cubic of the ray
//! parameter, at that cubic's turns and wherever it crosses a knot. A jump or a peak narrower than a cell is
//! therefore met exactly. Between cuts everything is smooth:
//!
//! - constant scalar: closed form;
//! - else Gauss-Legendre panels, halved until a panel and its two halves agree.
//!
//! Error control: a panel's halves are taken when they change it by at most [`TOLERANCE`] times its share of the
//! ray, weighted by the transmittance in front of it, so the accepted changes of a ray add up to at most
//! [`TOLERANCE`]. The error of the halves is far below that change (the rule is of order 12). Shares below
//! `LEAST_SHARE` count as that much, since rounding would not let less be reached and since the short panels
//! beside a pole of sigma have errors in proportion to their length; those are few. Colours are held to the same,
//! relative to the brightest colour of the transfer function where that is above 1.
//!
//! Opacity 1: where it holds on a positive length, the ray ends there in that colour. Where it is reached at single
//! points, sigma has a logarithmic pole, which is integrable: the ray goes on behind it.

mod cells;
mod clip_volume;
mod crossings;
mod cubic;
mod first;
mod light_path;
mod met;
mod panel;
mod surfaces;

pub use clip_volume::RayPart;
pub use crossings::Crossing;
pub use first::FirstPlace;
pub use panel::TOLERANCE;

use glam::DVec3;
use rayon::prelude::*;

use self::cubic::Cubic;
use self::panel::{Medium, Segment};
use crate::math::interpolate::nearest;
use crate::math::opacity::composite;
use crate::math::polyhedron::HalfSpace;
use crate::math::ray::{ViewRays, cut_interval};
use crate::projection::{self, COMPOSITE, Projection};
use crate::scene::mesh::DividedRay;
use crate::scene::settings::Filter;
use crate::scene::{ClipVolume, Field, Polygons, Scene, Tetrahedra, TransferFunction};

/// Transmittance (times the brightest colour) behind which nothing changes a result of order 1 in f64.
const BLACK: f64 = 1e-17;

/// Integrates rays through one field, under one transfer function or as another projection has it.
pub struct ExactIntegrator<'a> {
    field: &'a Field,
    medium: Absorber<'a>,
    projection: &'static Projection,
    /// Polygons that rays meet, and how many transparent ones show.
    polygons: Option<(&'a Polygons, u32)>,
    /// Half spaces that keep what is in them.
    planes: &'a [HalfSpace],
    /// Another volume, by whose values rays are clipped.
    clip: Option<&'a ClipVolume>,
    /// Every point has the value of the nearest voxel, so that the ray is cut at their faces.
    nearest: bool,
    /// The scene, where its surfaces are drawn.
    surfaces: Option<&'a Scene>,
    /// The mesh that rays go through in place of voxels.
    mesh: Option<&'a Tetrahedra>,
}

/// A transfer function as a medium that light passes through.
pub struct Absorber<'a> {
    transfer: &'a TransferFunction,
    /// Values of x at which the transfer function bends or jumps, rising.
    levels: Vec<f64>,
    /// The largest colour component, at least 1.
    brightest: f64,
}

/// A ray in voxel centre coordinates: `origin + t * direction` counts voxels from the first centre (0) on, and t is
/// in volume units.
struct VoxelRay {
    origin: DVec3,
    direction: DVec3,
}

/// The way of a line through a cell; see [`Cubic::of_cell`].
struct CellPart {
    corners: [f64; 8],
    start: [f64; 3],
    rise: [f64; 3],
    /// Axes along which the field does not change, beyond the outermost voxel centres.
    clamped: [bool; 3],
}

/// Light gathered so far, premultiplied, and what is left to pass.
struct Light {
    color: [f64; 3],
    transmittance: f64,
}

impl<'a> ExactIntegrator<'a> {
    pub fn new(field: &'a Field, transfer: &'a TransferFunction) -> Self {
        let medium = Absorber::new(transfer);
        Self {
            field,
            medium,
            projection: &COMPOSITE,
            polygons: None,
            planes: &[],
            clip: None,
            nearest: false,
            surfaces: None,
            mesh: None,
        }
    }

    /// Of a scene, by its projection: its field between voxels is what its filter makes of it.
    pub fn of(scene: &'a Scene) -> Self {
        let nearest = scene.settings.sampling.filter == Filter::Nearest;
        let projection = projection::of(&scene.settings);
        let polygons =
            Some((&*scene.polygons, scene.settings.layers.most)).filter(|(polygons, _)| !polygons.is_empty());
        let planes = scene.clip_planes();
        let surfaces = scene.surface.is_some().then_some(scene);
        let clip = scene.cutting_volume();
        let mesh = scene.tetrahedra.as_deref();
        Self { nearest, projection, polygons, planes, clip, surfaces, mesh, ..Self::new(&scene.field, &scene.transfer) }
    }

    /// Premultiplied RGBA of `entry + t * direction` for t from 0 to `length`, in volume space and volume units;
    /// `direction` has length 1. The field goes on outside the volume as it is on its faces. Transparent black for
    /// a `length` that is not positive.
    pub fn ray(&self, entry: DVec3, direction: DVec3, length: f64) -> [f64; 4] {
        match &self.projection.values {
            Some(values) => self.values(values, entry, direction, length),
            None if self.clip.is_some() => self.clipped_ray(entry, direction, length),
            None => self.whole_ray(entry, direction, length),
        }
    }

    /// Premultiplied RGBA of a ray of which all is kept, where colours are shown.
    fn whole_ray(&self, entry: DVec3, direction: DVec3, length: f64) -> [f64; 4] {
        match self.surfaces {
            None => self.colors(&self.line(entry, direction), length),
            Some(scene) if scene.sees_through_surfaces() => self.transparent_surfaces(scene, entry, direction, length),
            Some(scene) => self.surface(scene, entry, direction, length),
        }
    }

    fn line(&self, entry: DVec3, direction: DVec3) -> VoxelRay {
        let voxel = self.field.voxel();
        VoxelRay { origin: (entry + 0.5 * self.field.extent()) / voxel - 0.5, direction: direction / voxel }
    }

    /// Premultiplied RGBA of what the transfer function makes of a line from 0 to `length`.
    fn colors(&self, line: &VoxelRay, length: f64) -> [f64; 4] {
        let mut light = Light { color: [0.0; 3], transmittance: 1.0 };
        for (a, b) in self.plane_cuts(line, length).windows(2).map(|pair| (pair[0], pair[1])).filter(|(a, b)| a < b) {
            if light.transmittance * self.medium.brightest < BLACK {
                break;
            }
            if let Some(cell) = self.cell(line, a, b) {
                self.part(&cell, (a, b), length, &mut light);
            }
        }
        light.rgba()
    }

    /// The same of a ray from `from` to `to` of its length.
    fn colors_between(&self, entry: DVec3, direction: DVec3, [from, to]: [f64; 2]) -> [f64; 4] {
        self.colors(&self.line(entry + from * direction, direction), to - from)
    }

    /// A picture of `size` = [width, height], row 0 on top: every ray from where it enters the volume's box to
    /// where it leaves it, without early termination.
    pub fn picture(&self, rays: &ViewRays, size: [u32; 2]) -> Vec<[f64; 4]> {
        let half = 0.5 * self.field.extent();
        (0..size[1])
            .into_par_iter()
            .flat_map_iter(|row| {
                (0..size[0]).map(move |column| {
                    let ray = rays.of(column, row);
                    if let Some(mesh) = self.mesh {
                        return self.through_cells(mesh, &ray, rays.near);
                    }
                    // Along a view's ray the parameter is depth; lengths are longer by the direction's own.
                    let stretch = ray.direction.length();
                    let between = |enter: f64, leave: f64| {
                        self.ray(ray.at(enter), ray.direction / stretch, (leave - enter) * stretch)
                    };
                    let whole = cut_interval(&ray, half, rays.near, self.planes);
                    match self.polygons {
                        None => whole.map_or([0.0; 4], |(enter, leave)| between(enter, leave)),
                        Some((polygons, most)) => {
                            divided_by(&polygons.divided(rays, [column, row], most), whole.unwrap_or_default(), between)
                        }
                    }
                })
            })
            .collect()
    }

    /// 0, the parameters at which the line meets a plane of voxel centres (and of faces between voxels, where these
    /// matter), and `length`, rising.
    fn plane_cuts(&self, line: &VoxelRay, length: f64) -> Vec<f64> {
        let mut cuts = Vec::new();
        if !(length > 0.0 && length.is_finite()) {
            return cuts;
        }
        cuts.extend([0.0, length]);
        for axis in 0..3 {
            let (origin, direction) = (line.origin[axis], line.direction[axis]);
            let last = (self.field.dims()[axis] - 1) as f64;
            if direction == 0.0 || last == 0.0 {
                continue;
            }
            let end = origin + direction * length;
            let first = origin.min(end).ceil().clamp(0.0, last) as usize;
            let past = origin.max(end).floor().clamp(0.0, last) as usize;
            let planes = (first..=past).map(|plane| plane as f64);
            // One face more on each side of the centres that the line passes.
            let faces = (first.max(1) - 1..=past).filter(|_| self.nearest).map(|plane| plane as f64 + 0.5);
            let meets = planes.chain(faces).map(|plane| (plane - origin) / direction);
            cuts.extend(meets.filter(|t| *t > 0.0 && *t < length));
        }
        cuts.sort_unstable_by(f64::total_cmp);
        cuts
    }

    /// The field on the part [a, b] of the line, which lies inside one cell or beyond the outermost voxel centres; none in
    /// a hole.
    fn cell(&self, line: &VoxelRay, a: f64, b: f64) -> Option<CellPart> {
        let dims = self.field.dims();
        let middle = line.origin + 0.5 * (a + b) * line.direction;
        let mut low = [0; 3];
        let (mut start, mut rise, mut clamped) = ([0.0; 3], [0.0; 3], [true; 3]);
        for axis in 0..3 {
            let last = dims[axis] - 1;
            let below = middle[axis].floor();
            low[axis] = below.clamp(0.0, last as f64) as usize;
            // Beyond the outermost centres the field is clamped: it doesn't change along this axis.
            if below >= 0.0 && low[axis] < last {
                clamped[axis] = false;
                // Within the cell, whatever rounding says of a very flat one.
                start[axis] = (line.origin[axis] + a * line.direction[axis] - below).clamp(0.0, 1.0);
                rise[axis] = ((b - a) * line.direction[axis]).clamp(-start[axis], 1.0 - start[axis]);
            }
        }
        if let Some(holes) = &self.field.holes {
            let cells = self.field.cells();
            let [x, y, z] = std::array::from_fn(|axis| low[axis].min(cells[axis] - 1));
            if holes[(z * cells[1] + y) * cells[0] + x] {
                return None;
            }
        }
        if self.nearest {
            let value = nearest(&self.field.values, dims, middle + 0.5);
            return Some(CellPart { corners: [value; 8], start: [0.0; 3], rise: [0.0; 3], clamped: [true; 3] });
        }
        let corners: [f64; 8] = std::array::from_fn(|corner| {
            let at = |axis: usize| (low[axis] + (corner >> axis & 1)).min(dims[axis] - 1);
            f64::from(self.field.values[(at(2) * dims[1] + at(1)) * dims[0] + at(0)])
        });
        Some(CellPart { corners, start, rise, clamped })
    }

    /// Adds the part [a, b] of the line, which runs through that part of a cell.
    fn part(&self, cell: &CellPart, (a, b): (f64, f64), length: f64, light: &mut Light) {
        let least = cell.corners.iter().copied().fold(f64::INFINITY, f64::min);
        let most = cell.corners.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if self.medium.transfer.visible(least, most) {
            let lengths = (b - a) / (self.medium.transfer.reference * self.field.finest());
            self.medium.add(&cell.cubic(), lengths, (b - a) / length, light);
        }
    }
}

/// A ray that enters and leaves the volume's box at these depths, with its surfaces: `between` gives what lies between two
/// depths, premultiplied.
fn divided_by(ray: &DividedRay, (enter, leave): (f64, f64), between: impl Fn(f64, f64) -> [f64; 4]) -> [f64; 4] {
    let mut pixel = [0.0; 4];
    let mut from = ray.begin.map_or(enter, |begin| begin.clamp(enter, leave.max(enter)));
    let mut kept = ray.kept;
    for surface in &ray.surfaces {
        let to = surface.depth.clamp(from, leave.max(from));
        if kept {
            pixel = composite(pixel, between(from, to));
        }
        pixel = composite(pixel, surface.color);
        (from, kept) = (to, surface.kept);
    }
    if kept { composite(pixel, between(from, leave)) } else { pixel }
}

impl CellPart {
    fn cubic(&self) -> Cubic {
        Cubic::of_cell(self.corners, self.start, self.rise)
    }

    /// The gradient of the interpolant at `s` of the way through the cell, over a voxel along each axis; 0 along an axis on which the
    /// way lies beyond the outermost centres.
    fn gradient(&self, s: f64) -> DVec3 {
        let weight: [f64; 3] = std::array::from_fn(|axis| self.start[axis] + s * self.rise[axis]);
        DVec3::from_array(std::array::from_fn(|axis| {
            if self.clamped[axis] {
                return 0.0;
            }
            (0..8)
                .map(|corner: usize| {
                    let share = |other: usize| match (corner >> other & 1, other == axis) {
                        (1, true) => 1.0,
                        (_, true) => -1.0,
                        (1, false) => weight[other],
                        (_, false) => 1.0 - weight[other],
                    };
                    self.corners[corner] * share(0) * share(1) * share(2)
                })
                .sum()
        }))
    }
}

impl<'a> Absorber<'a> {
    pub fn new(transfer: &'a TransferFunction) -> Self {
        let mut levels: Vec<f64> = transfer.knots().iter().map(|k| k.x).collect();
        levels.dedup();
        let brightest = transfer.knots().iter().flat_map(|k| k.color).fold(1.0, f64::max);
        Self { transfer, levels, brightest }
    }

    /// Premultiplied RGBA of a way of so many reference `lengths` on which x goes evenly from `front` to `back`.
    pub fn ramp(&self, front: f64, back: f64, lengths: f64) -> [f64; 4] {
        let mut light = Light { color: [0.0; 3], transmittance: 1.0 };
        self.add(&Cubic([front, back - front, 0.0, 0.0]), lengths, 1.0, &mut light);
        light.rgba()
    }

    /// Adds a part of a ray of so many reference `lengths`, a `share` of the whole ray, of which `x` gives the scalar for
    /// s from 0 to 1.
    fn add(&self, x: &Cubic, lengths: f64, share: f64, light: &mut Light) {
        let mut cuts = Vec::new();
        x.cut(&self.levels, &mut cuts);
        for (a, b) in cuts.windows(2).map(|c| (c[0], c[1])).filter(|(a, b)| a < b) {
            let middle = x.at(0.5 * (a + b));
            let segment = match x.is_constant() {
                true => Segment::at(self.transfer, middle),
                false => Segment::around(self.transfer, middle),
            };
            if segment.is_invisible() {
                continue;
            }
            let begin = segment.color(x.at(a));
            if segment.is_opaque() {
                light.add(begin, 1.0, [0.0; 3], 0.0);
                return;
            }
            let change = segment.color_change();
            let medium = Medium {
                x,
                segment: &segment,
                scale: lengths,
                share,
                steepest: change.iter().fold(0.0, |most: f64, c| most.max(c.abs())) / self.brightest,
            };
            let stretch = medium.stretch(a, b, light.transmittance);
            light.add(begin, stretch.opacity(), change, stretch.rise);
        }
    }
}

impl Light {
    fn rgba(&self) -> [f64; 4] {
        let [r, g, b] = self.color;
        [r, g, b, 1.0 - self.transmittance]
    }

    /// A stretch that begins in the colour `begin`, behind all that came before.
    fn add(&mut self, begin: [f64; 3], opacity: f64, change: [f64; 3], rise: f64) {
        for (c, color) in self.color.iter_mut().enumerate() {
            *color += self.transmittance * (begin[c] * opacity + change[c] * rise);
        }
        self.transmittance *= 1.0 - opacity;
    }
}
