//! A look at a scene before it is drawn: a coarse grid of rays through the voxels, none of them interpolated.

use glam::DVec3;

use super::coarse::Coarse;
use crate::error::Result;
use crate::feature::rays_may_end;
use crate::math::blend::Blend;
use crate::math::opacity::corrected_opacity;
use crate::math::ray::{ViewRay, cut_interval};
use crate::projection::{self, Ends, Shown};
use crate::scene::gathered::Gathered;
use crate::scene::settings::Alpha;
use crate::scene::view::View;
use crate::scene::{Field, Scene};
use crate::structure::cells::all_interesting;

/// Pixels that a cluster of rays stands for, the most clusters, and the most samples of all rays together: a look has a small part of what
/// a frame has.
const PIXELS_OF_CLUSTER: f64 = 1024.0;
const MOST_CLUSTERS: f64 = 64.0;
const MOST_SAMPLES: f64 = (1 << 19) as f64;

/// Where the rays of a cluster are, in pixels from its first one: at the corners of what a device shades at once.
const CORNERS: [[f64; 2]; 4] = [[0.0, 0.0], [3.0, 0.0], [0.0, 1.0], [3.0, 1.0]];

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
    /// Whether rays may end before they leave the volume, so that it is decided whether they do.
    pub may_end: bool,
    /// Whether there is anything to skip, as planners find it.
    pub any_is_free: bool,
    /// Whether tiles of pixels behind which nothing shows are left out, by methods that do so: not until whoever chooses says so.
    pub leaves_out_tiles: bool,
}

/// Pixels of live tiles for one behind which something shows, about.
const OF_TILES: f64 = 1.3;

/// Whether any ray of a cluster comes to something that shows.
pub fn anything_shows(cluster: &[LookRay]) -> bool {
    cluster.iter().any(|ray| ray.seen.iter().any(|seen| seen.shows))
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
        let mut coarse = Coarse::of(&scene.field, |value| shade.shows(value));
        let region = view.region;
        let pixels = f64::from(region.width) * f64::from(region.height);
        let room = MOST_SAMPLES / (CORNERS.len() as f64 * f64::from(view.longest_samples.max(1)));
        let wanted = (pixels / PIXELS_OF_CLUSTER).min(MOST_CLUSTERS).min(room).max(1.0);
        let side = (pixels / wanted).sqrt().max(1.0);
        let count = |length: u32, most: f64| (f64::from(length) / side).ceil().min(most.ceil()) as u32;
        // Twice as many where the region is not divided evenly, and no more where it is a line.
        let columns = count(region.width, 2.0 * wanted);
        let rows = count(region.height, 2.0 * wanted / f64::from(columns.max(1)));
        let place = |at: u32, of: u32, from: u32, length: u32| {
            f64::from(from) + (f64::from(at) + 0.5) / f64::from(of) * f64::from(length)
        };
        let mut clusters = Vec::new();
        for (row, column) in (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column))) {
            let across = place(column, columns, region.x, region.width);
            let down = place(row, rows, region.y, region.height);
            // In a small picture neighbours are no farther than its last pixels.
            let ends = [region.x + region.width, region.y + region.height].map(|end| f64::from(end) - 0.5);
            let rays = CORNERS.map(|[x, y]| view.rays.through((across + x).min(ends[0]), (down + y).min(ends[1])));
            clusters.push(rays.iter().filter_map(|ray| shade.ray(&coarse, ray, view.rays.near)).collect::<Vec<_>>());
        }
        let met = clusters.iter().flatten().count() as f64 / (CORNERS.len() * clusters.len()).max(1) as f64;
        clusters.retain(|cluster| !cluster.is_empty());
        // A coarse grid of a large volume misses some of what rays have met.
        for seen in clusters.iter().flatten().flat_map(|ray| &ray.seen).filter(|seen| seen.shows) {
            coarse.open_block(seen.voxel);
        }
        Ok(Self {
            pixels: pixels * met,
            longest: view.longest_samples,
            may_end: may_end(scene, &view),
            any_is_free: !scene.settings.method.planner || !all_interesting(scene),
            leaves_out_tiles: false,
            clusters,
            coarse,
        })
    }

    /// Pixels of tiles behind which something shows, estimated.
    pub fn live_pixels(&self) -> f64 {
        let live = self.clusters.iter().filter(|cluster| anything_shows(cluster)).count();
        self.pixels * (OF_TILES * live as f64 / self.clusters.len().max(1) as f64).min(1.0)
    }

    /// All rays.
    pub fn rays(&self) -> impl Iterator<Item = &LookRay> {
        self.clusters.iter().flatten()
    }
}

/// Whether rays of a view may end, as planners decide it of those of ray casters.
fn may_end(scene: &Scene, view: &View) -> bool {
    let adds = !scene.polygons.transparent().is_empty() || scene.effect.is_some();
    let gathered = || Gathered::of(scene, view, 1);
    !scene.settings.method.planner || rays_may_end(scene, scene.surface.is_some(), adds, gathered)
}

/// A part of the scalar range.
struct Part {
    /// Whether its values show; none where some do and others do not.
    shows: Option<bool>,
    /// How much of the light a sample of them takes.
    opacity: f64,
}

/// What samples show, by their values.
struct Shade<'a> {
    scene: &'a Scene,
    shown: Shown,
    /// Parts of the scalar range.
    parts: Vec<Part>,
    /// T, where opacity ends rays.
    ends_above: Option<f64>,
    /// The value that ends rays which have come to it.
    reached: Option<f32>,
}

impl<'a> Shade<'a> {
    fn of(scene: &'a Scene) -> Self {
        let shown = Shown::in_x(scene);
        let sampling = &scene.settings.sampling;
        let inner = (0..PARTS).map(|part| {
            let [low, middle, high] = [0.0, 0.5, 1.0].map(|more| (part as f64 + more) / PARTS as f64);
            let all = [low, middle, high].iter().all(|x| shown.anywhere(*x, *x));
            let shows = if all || !shown.anywhere(low, high) { Some(all) } else { None };
            Part { shows, opacity: opacity(scene, middle) }
        });
        let projection = projection::of(&scene.settings);
        let opaque = projection.ends == Ends::Opaque && scene.surface.is_none();
        let [least, greatest] = scene.field.extremes();
        let end = if projection.blend == Blend::Min { least } else { greatest };
        let reached = (projection.ends == Ends::Reached).then_some(end);
        Self { scene, parts: inner.collect(), ends_above: opaque.then_some(sampling.termination), reached, shown }
    }

    fn at(&self, value: f32) -> (bool, f64) {
        let x = f64::from(value);
        let asked = || self.shown.anywhere(x, x);
        match self.parts.get((value.max(0.0) * PARTS as f32) as usize) {
            Some(part) if value >= 0.0 => (part.shows.unwrap_or_else(asked), part.opacity),
            // Beyond the scalar range.
            _ => (asked(), opacity(self.scene, x)),
        }
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
                    let opaque = self.ends_above.is_some_and(|threshold| 1.0 - through > threshold);
                    (shows, opaque || self.reached == Some(value))
                }
                Some(_) => {
                    let met = self.meets(before, value);
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

    /// Whether a surface, or what shows of the volume with it, is between two values; a ray that begins on it, without a value before,
    /// meets it there where surfaces end rays.
    fn meets(&self, before: Option<f32>, value: f32) -> bool {
        let surface = self.scene.surface.as_ref();
        let crossed = surface.iter().flat_map(|surface| &surface.levels).any(|level| {
            let on = |value: f32| (level.values[0]..=level.values[1]).contains(&f64::from(value));
            let begins = before.is_none() && on(value) && self.scene.ends_at_surfaces();
            begins || before.is_some_and(|before| on(before) != on(value)) || on(value) && level.values[1].is_finite()
        });
        crossed || self.shown.visible.is_some() && self.shows(value)
    }
}

/// How much of the light a sample of a value takes.
fn opacity(scene: &Scene, x: f64) -> f64 {
    let (sampling, transfer) = (&scene.settings.sampling, &scene.transfer);
    match sampling.alpha {
        Alpha::Exponential => corrected_opacity(transfer.evaluate(x)[3], sampling.step / transfer.reference),
        Alpha::Paper => transfer.evaluate(x)[3],
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
