//! A scene as its camera sees it: the box, cut by clip planes, as triangles, the pixels it covers, the longest ray.

use std::sync::{Arc, OnceLock};

use glam::DVec3;

use super::Scene;
use super::frustum::Frustum;
use super::longest::longest_ray;
use super::region::Region;
use super::single_rays::SingleRays;
use super::slice_polygons::SlicePolygons;
use super::slices::{SliceSurface, Slices, Stack};
use super::tetrahedra::{CellsView, Tetrahedra};
use super::tiles::{InPasses, Tiles};
use crate::error::{Error, Result};
use crate::math::polyhedron::{HalfSpace, Polyhedron};
use crate::math::ray::ViewRays;

/// A scene as seen by its camera.
#[derive(Clone, Debug)]
pub struct View {
    pub size: [u32; 2],
    pub rays: ViewRays,
    /// Clip coordinates x, y, w of the corners of triangles, three each: front faces, then back faces, caps among them.
    pub front: Vec<[f32; 3]>,
    pub back: Vec<[f32; 3]>,
    /// The pixels the box may cover; none where it is out of view.
    pub region: Region,
    /// Samples on the ray that has most, a step from each other.
    pub longest_samples: u32,
    /// What slice renderers draw; none for others.
    pub slices: Option<Arc<Slices>>,
    /// What rays meet of a mesh of cells; none for methods that do not go through them.
    pub cells: Option<Arc<CellsView>>,
    /// Tiles of pixels whose rays may come to something that shows; none where all are drawn.
    pub tiles: Option<Arc<Tiles>>,
    /// Cut when they are first asked for: of many slices that takes longer than all else of a plan.
    slice_polygons: Arc<OnceLock<SlicePolygons>>,
}

impl View {
    /// # Errors
    /// When the camera is not one (see [`super::Camera::basis`]), or single precision has no numbers for the view.
    pub fn new(scene: &Scene) -> Result<Self> {
        let size = scene.settings.image.size;
        let frustum = Frustum::new(scene)?;
        let rays = frustum.rays;
        let enters = |plane: &HalfSpace| frustum.enters(plane);
        let cut = |solid: Polyhedron, plane: &HalfSpace| solid.clipped(*plane, Some(enters(plane)));
        let half = 0.5 * scene.field.extent();
        let solid = scene.clip_planes().iter().fold(Polyhedron::cuboid(half, enters), cut);
        let solid = solid.clipped(frustum.near(), Some(true));
        let solid = frustum.sides().into_iter().fold(solid, |solid, side| solid.clipped(side, None));
        let project = |front: bool| -> Vec<[f32; 3]> {
            solid.triangles(front).into_iter().map(|place| frustum.corner(place)).collect()
        };
        let (front, back) = (project(true), project(false));
        representable(scene, &rays, [&front, &back])?;
        let whole = Region { x: 0, y: 0, width: size[0], height: size[1] };
        let region = match covered(&front, size).with(covered_by_polygons(scene, &rays, size)) {
            // What is behind the volume shows everywhere; without the planner targets are as large as the picture.
            _ if scene.backdrop.is_some() => whole,
            Region { width: 1.., .. } if !scene.settings.method.planner => whole,
            region => region,
        };
        let longest_samples = longest_samples(scene, &rays, region);
        let (slices, cells, tiles, slice_polygons) = (None, None, None, Arc::default());
        Ok(Self { size, rays, front, back, region, longest_samples, slices, cells, tiles, slice_polygons })
    }

    /// The axis of the stack of 2D textures that slices are taken from; none where they are taken from the volume, or there are none.
    pub fn stack_axis(&self) -> Option<usize> {
        match self.slices.as_ref()?.surface {
            SliceSurface::Axis(axis) => Some(axis),
            SliceSurface::Depth | SliceSurface::Distance => None,
        }
    }

    /// The same with slices, drawn front to back in passes of so many of them, or back to front.
    ///
    /// # Errors
    /// As [`View::new`].
    pub fn sliced(self, scene: &Scene, stack: Stack, of_pass: Option<u32>) -> Result<Self> {
        let slices = Some(Arc::new(Slices::new(scene, stack, of_pass)?));
        Ok(Self { slices, slice_polygons: Arc::default(), ..self })
    }

    /// The same of rays that go through the cells of the scene's mesh; `most_texels`: see [`CellsView::new`].
    pub fn through_cells(self, scene: &Scene, most_texels: Option<u32>) -> Self {
        let of = |mesh: &Arc<Tetrahedra>| Arc::new(CellsView::new(mesh, &self.rays, self.region, most_texels));
        Self { cells: scene.tetrahedra.as_ref().map(of), ..self }
    }

    /// The same of which only tiles are drawn that any of the boxes may be seen in, each given by two corners in volume space; `passes`: see
    /// [`Tiles::around`].
    pub fn in_tiles(self, boxes: impl Iterator<Item = [DVec3; 2]>, passes: Option<&InPasses>) -> Self {
        Self { tiles: Some(Arc::new(Tiles::around(&self.rays, self.region, boxes, passes))), ..self }
    }

    /// The rays of the whole picture, as single floats find them: the same, whatever part of it is drawn.
    pub fn single_rays(&self, scene: &Scene) -> SingleRays {
        SingleRays::new(&self.rays, scene.field.extent(), self.size)
    }

    /// What shows of the slices of the scene that this is a view of; nothing where there are none.
    pub fn slice_polygons(&self, scene: &Scene) -> &SlicePolygons {
        let cut = || self.slices.as_ref().and_then(|slices| SlicePolygons::new(scene, slices).ok());
        self.slice_polygons.get_or_init(|| cut().unwrap_or_default())
    }
}

/// The shortest side that a volume may have, in its longest: its inverse is a number of single precision.
const SHORTEST_SIDE: f64 = 1e-30;

/// Whether single precision, in which devices have them, has numbers for the view and the volume's proportions.
fn representable(scene: &Scene, rays: &ViewRays, corners: [&[[f32; 3]]; 2]) -> Result<()> {
    let extent = scene.field.extent();
    let inverse_step = 1.0 / (scene.settings.step() * scene.field.finest());
    if extent.min_element() < SHORTEST_SIDE || !(inverse_step as f32).is_finite() {
        return Err(Error::input(
            &scene.field.volume.name,
            format!("has a side of {:e} of the longest, in steps of {}", extent.min_element(), scene.settings.step()),
            "give spacings that differ less, or longer steps (--step, --shortest): single precision has no number for its inverse",
        ));
    }
    let has = |v: DVec3| v.to_array().into_iter().all(|c| (c as f32).is_finite());
    let sound = [rays.origin, rays.base, rays.right, rays.down].into_iter().all(has);
    if sound && corners.into_iter().flatten().flatten().all(|c| c.is_finite()) {
        return Ok(());
    }
    let camera = &scene.settings.camera;
    let (seen, remedy) = match camera.height {
        None => {
            (format!("a field of view of {} degrees", camera.fov_y), "a field of view farther from 0 and 180 degrees")
        }
        Some(height) => (format!("a picture {height} high"), "a higher picture (--ortho-height)"),
    };
    Err(Error::usage(
        "camera (--eye, --target, --fov)",
        format!("eye {:?} with {seen} puts corners of the volume beyond single precision", camera.eye),
        format!("move the eye nearer to the volume, or choose {remedy}"),
    ))
}

/// The pixels that polygons may cover: those of the box around them.
fn covered_by_polygons(scene: &Scene, rays: &ViewRays, size: [u32; 2]) -> Region {
    let Some(bounds) = scene.polygons.bounds() else { return Region::default() };
    let corner = |i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { bounds.least[axis] } else { bounds.greatest[axis] };
        DVec3::new(pick(0), pick(1), pick(2)) - rays.origin
    };
    let corners: [DVec3; 8] = std::array::from_fn(corner);
    let pixels = rays.to_picture();
    let placed = corners.map(|arm| pixels * arm);
    if !rays.parallel() && placed.iter().any(|p| p.z < rays.near) {
        // Some of it is beside the eye or behind it, and may show anywhere.
        return Region { x: 0, y: 0, width: size[0], height: size[1] };
    }
    let clip = |p: DVec3| {
        let w = if rays.parallel() { 1.0 } else { p.z };
        let at = |axis: usize| 2.0 * p[axis] / f64::from(size[axis]) - w;
        [at(0), at(1), w].map(|c| c as f32)
    };
    covered(&placed.map(clip), size)
}

/// The pixels that triangles may cover, one pixel more on each side.
fn covered(clip: &[[f32; 3]], size: [u32; 2]) -> Region {
    let range = |axis: usize| -> Option<(u32, u32)> {
        let pixels = f64::from(size[axis]);
        let at = |c: &[f32; 3]| (0.5 * f64::from(c[axis]) / f64::from(c[2]) + 0.5) * pixels;
        let low = clip.iter().map(at).fold(f64::INFINITY, f64::min);
        let high = clip.iter().map(at).fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = ((low.floor() - 1.0).max(0.0), (high.ceil() + 1.0).min(pixels));
        (low < high).then_some((low as u32, high as u32))
    };
    match (range(0), range(1)) {
        (Some((x0, x1)), Some((y0, y1))) => Region { x: x0, y: y0, width: x1 - x0, height: y1 - y0 },
        _ => Region::default(),
    }
}

fn longest_samples(scene: &Scene, rays: &ViewRays, region: Region) -> u32 {
    let longest = longest_ray(rays, 0.5 * scene.field.extent(), scene.clip_planes(), region);
    scene.samples_on(longest / (scene.settings.step() * scene.field.finest()))
}
