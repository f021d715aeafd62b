//! A look at a scene before it is drawn: a coarse grid of rays through the voxels, none of them interpolated.

use glam::DVec3;

use super::coarse::Coarse;
use crate::error::Result;
use crate::math::opacity::corrected_opacity;
use crate::math::ray::{ViewRay, cut_interval};
use crate::projection::{self, Ends, Shown};
use crate::scene::settings::Alpha;
use crate::scene::view::View;
use crate::scene::{Field, Scene};

/// Pixels that a cluster of rays stands for, and the most clusters: a look has a small part of what a frame has.
const PIXELS_OF_CLUSTER: f64 = 1024.0;
const MOST_CLUSTERS: f64 = 64.0;

/// Where the rays of a cluster are, in pixels from its first one: at the corners of what a device shades at once.
const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [3.0, 0.0], [0.0, 1.0], [3.0, 1.0]];

/// Of so large a part of the cells on it is taken that something shows in all of them: only some voxels of each were looked at.
const ALL_OPEN: f64 = 0.99;

/// Parts of the scalar range that opacities are kept for.
const PARTS: usize = 1024;

/// What a look finds.
#[derive(Clone, Debug)]
pub struct Look {
    /// Pixels whose rays meet the volume, estimated.
    pub pixels: f64,
    /// Samples on the longest ray.
    pub longest: u32,
    /// Rays that meet the volume, in clusters of neighbours.
    pub clusters: Vec<Vec<LookRay>>,
    /// Where something shows.
    pub coarse: Coarse,
    /// Whether any ray ends before it leaves the volume.
    pub any_ends: bool,
    /// Whether there is anything to skip.
    pub any_is_free: bool,
}

/// What is on a coarse ray.
#[derive(Clone, Debug)]
pub struct LookRay {
    /// The signs of its direction: bit a is set where it goes down on axis a.
    pub octant: usize,
    /// Voxels of the finest spacing from one sample to the next.
    pub step: f64,
    /// Samples that the ray has in all.
    pub samples: u32,
    /// Those before it is saturated, or meets the surface that ends it.
    pub seen: Vec<Seen>,
}

/// What is at a sample.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Of the coarse grid.
    pub cell: u32,
    pub voxel: [u16; 3],
    /// Whether anything shows there or at a sample beside it.
    pub shows: bool,
}

impl Look {
    /// # Errors
    /// As [`View::new`].
    pub fn of(scene: &Scene) -> Result<Self> {
        let view = View::new(scene)?;
        let shade = Shade::of(scene);
        let coarse = Coarse::of(&scene.field, |value| shade.shows(value));
        let region = view.region;
        let pixels = f64::from(region.width) * f64::from(region.height);
        let wanted = (pixels / PIXELS_OF_CLUSTER).clamp(1.0, MOST_CLUSTERS);
        let side = (pixels / wanted).sqrt().max(1.0);
        let count = |length: u32| (f64::from(length) / side).ceil() as u32;
        let (columns, rows) = (count(region.width), count(region.height));
        let place = |at: u32, of: u32, from: u32, length: u32| {
            f64::from(from) + (f64::from(at) + 0.5) / f64::from(of) * f64::from(length)
        };
        let mut clusters = Vec::new();
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            let across = place(column, columns, region.x, region.width);
            let down = place(row, rows, region.y, region.height);
            let rays = CORNERS.map(|[x, y]| view.rays.through(across + x, down + y));
            clusters.push(rays.iter().filter_map(|ray| shade.ray(&coarse, ray, view.rays.near)).collect::<Vec<_>>());
        }
        let met = clusters.iter().flatten().count() as f64 / (CORNERS.len() * clusters.len()).max(1) as f64;
        clusters.retain(|cluster| !cluster.is_empty());
        let ends = |ray: &LookRay| ray.seen.len() < ray.samples as usize;
        Ok(Self {
            pixels: pixels * met,
            longest: view.longest_samples,
            any_ends: clusters.iter().flatten().any(ends),
            any_is_free: coarse.open_share() < ALL_OPEN,
            clusters,
            coarse,
        })
    }

    /// All rays.
    pub fn rays(&self) -> impl Iterator<Item = &LookRay> {
        self.clusters.iter().flatten()
    }
}

/// What samples show, by their values.
struct Shade<'a> {
    scene: &'a Scene,
    shown: Shown,
    /// Whether values show, and how much of the light they take in a step: of 0 and less, of parts of the scalar range, of 1 and
    /// more.
    parts: Vec<(bool, f64)>,
    /// T, where opacity ends rays.
    ends_above: Option<f64>,
}

impl<'a> Shade<'a> {
    fn of(scene: &'a Scene) -> Self {
        let shown = Shown::in_x(scene);
        let (sampling, transfer) = (&scene.settings.sampling, &scene.transfer);
        let opacity = |x: f64| match sampling.alpha {
            Alpha::Exponential => corrected_opacity(transfer.evaluate(x)[3], sampling.step / transfer.reference),
            Alpha::Paper => transfer.evaluate(x)[3],
        };
        let of = |x: f64| (shown.anywhere(x, x), opacity(x));
        let inner = (0..PARTS).map(|part| of((part as f64 + 0.5) / PARTS as f64));
        let parts = std::iter::once(of(0.0)).chain(inner).chain([of(1.0)]).collect();
        let opaque = projection::of(&scene.settings).ends == Ends::Opaque && scene.surface.is_none();
        Self { scene, parts, ends_above: opaque.then_some(sampling.termination), shown }
    }

    fn at(&self, value: f32) -> (bool, f64) {
        let place = if value > 0.0 { 1 + (value * PARTS as f32) as usize } else { 0 };
        self.parts[place.min(PARTS + 1)]
    }

    fn shows(&self, value: f32) -> bool {
        self.at(value).0
    }

    /// A ray until it is saturated; none where it misses the volume.
    fn ray(&self, coarse: &Coarse, ray: &ViewRay, near: f64) -> Option<LookRay> {
        let field = &self.scene.field;
        let (enter, leave) = cut_interval(ray, 0.5 * field.extent(), near, self.scene.clip_planes())?;
        let step = self.scene.settings.sampling.step * field.finest();
        let length = ray.direction.length();
        let samples = self.scene.samples_on((leave - enter) * length / step);
        let mut place = Place::new(field, ray.at(enter), ray.direction * (step / length));
        let (mut through, mut before) = (1.0, None);
        let mut seen = Vec::new();
        for _ in 0..samples {
            let voxel = place.voxel();
            let value = field.values[voxel.1];
            let (shows, ends) = match self.scene.surface {
                None => {
                    let (shows, opacity) = self.at(value);
                    through *= 1.0 - opacity;
                    (shows, self.ends_above.is_some_and(|threshold| 1.0 - through > threshold))
                }
                Some(_) => {
                    let met = self.meets(before.unwrap_or(value), value);
                    (met, met && self.scene.ends_at_surfaces())
                }
            };
            before = Some(value);
            let at = voxel.0.map(|n| u16::try_from(n).unwrap_or(u16::MAX));
            seen.push(Seen { cell: coarse.cell_of(voxel.0), voxel: at, shows });
            if ends {
                break;
            }
            place.advance();
        }
        beside_too(&mut seen);
        let octant = (0..3).map(|axis| usize::from(ray.direction[axis] < 0.0) << axis).sum();
        Some(LookRay { octant, step: self.scene.settings.sampling.step, samples, seen })
    }

    /// Whether a surface, or what shows of the volume with it, is between two values.
    fn meets(&self, before: f32, value: f32) -> bool {
        let surface = self.scene.surface.as_ref();
        let crossed = surface.iter().flat_map(|surface| &surface.levels).any(|level| {
            let on = |value: f32| (level.values[0]..=level.values[1]).contains(&f64::from(value));
            on(before) != on(value) || on(value) && level.values[1].is_finite()
        });
        crossed || self.shown.visible.is_some() && self.shows(value)
    }
}

/// What shows is interpolated with the voxels beside it.
fn beside_too(seen: &mut [Seen]) {
    let shows: Vec<bool> = seen.iter().map(|seen| seen.shows).collect();
    for (i, seen) in seen.iter_mut().enumerate() {
        seen.shows |= i > 0 && shows[i - 1] || shows.get(i + 1).copied().unwrap_or(false);
    }
}

/// A place that goes along a ray, in voxels.
struct Place {
    at: DVec3,
    by: DVec3,
    dims: [usize; 3],
}

impl Place {
    fn new(field: &Field, from: DVec3, by: DVec3) -> Self {
        let dims = field.dims();
        let voxels = DVec3::from_array(dims.map(|n| n as f64)) / field.extent();
        Self { at: (from + 0.5 * field.extent()) * voxels, by: by * voxels, dims }
    }

    /// The voxel, and its place among all.
    fn voxel(&self) -> ([usize; 3], usize) {
        let voxel: [usize; 3] = std::array::from_fn(|axis| (self.at[axis].max(0.0) as usize).min(self.dims[axis] - 1));
        (voxel, (voxel[2] * self.dims[1] + voxel[1]) * self.dims[0] + voxel[0])
    }

    fn advance(&mut self) {
        self.at += self.by;
    }
}
