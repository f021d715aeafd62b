//! Runs a plan in f64 through the twins of its passes, pixel by pixel, without a device.

use rayon::prelude::*;

use super::structures::Structures;
use crate::part::geometry::{Geometry, Hits, Sample};
use crate::part::{Draw, Group, Work};
use crate::plan::Plan;
use crate::projection;
use crate::scene::Scene;
use crate::twin::{Effect, Pixel, Twin};

/// What a frame leaves when it runs in f64.
#[derive(Clone, Debug)]
pub struct CpuFrame {
    /// Premultiplied RGBA, row 0 on top.
    pub pixels: Vec<[f64; 4]>,
    /// Pixels that f32 cannot decide (see [`Pixel::undecided`]), or the rasteriser.
    pub undecided: Vec<bool>,
    /// How many of them lie so near to the outline of the box that a rasteriser, which moves corners to its raster,
    /// may cover them or not.
    pub outline: u64,
    pub counts: Counts,
    /// Rays that were not dead, each time they were counted.
    pub rays_left: Vec<u64>,
    /// Main fragments that took a sample of non-zero opacity: no skipping can run fewer and keep the picture.
    pub ideal: u64,
}

/// Fragments of each main pass and of the intermediate pass before it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    pub main: Vec<u64>,
    pub intermediate: Vec<u64>,
}

impl Counts {
    pub fn new(passes: u32) -> Self {
        Self { main: vec![0; passes as usize], intermediate: vec![0; passes as usize] }
    }

    /// The list a step of `group` counts for.
    pub fn of(&mut self, group: Group) -> Option<&mut Vec<u64>> {
        match group {
            Group::Main => Some(&mut self.main),
            Group::Intermediate => Some(&mut self.intermediate),
            _ => None,
        }
    }

    fn add(&mut self, other: &Self) {
        add(&mut self.main, &other.main);
        add(&mut self.intermediate, &other.intermediate);
    }
}

fn add(mine: &mut [u64], theirs: &[u64]) {
    mine.iter_mut().zip(theirs).for_each(|(a, b)| *a += b);
}

/// The raster of most rasterisers, as [`crate::vulkan::DeviceInfo::sub_pixel_bits`] has it.
pub const SUB_PIXEL_BITS: u32 = 8;

/// Runs the plan as a device whose rasteriser has a raster of 2^-`sub_pixel_bits` pixels would.
pub fn run(scene: &Scene, plan: &Plan, structures: &Structures, sub_pixel_bits: u32) -> CpuFrame {
    let height = plan.view.size[1];
    let table = structures.table(scene);
    let projection = projection::of(&scene.settings);
    let twin = Twin {
        scene,
        rays: plan.view.rays,
        passes: plan.passes,
        distance: plan.distance.and_then(|lookup| structures.distance(&lookup)).map(|d| &d.value),
        blocks: structures.blocks.as_ref().map(|b| &b.value),
        table: table.as_deref(),
        projection,
        levels: projection.levels_in_x(scene),
    };
    let raster = 0.5f64.powi(sub_pixel_bits as i32);
    let rows: Vec<CpuFrame> = (0..height).into_par_iter().map(|row| run_row(&twin, plan, row, raster)).collect();
    let mut frame = CpuFrame::empty(plan);
    for row in rows {
        frame.pixels.extend(row.pixels);
        frame.undecided.extend(row.undecided);
        frame.outline += row.outline;
        frame.counts.add(&row.counts);
        add(&mut frame.rays_left, &row.rays_left);
        frame.ideal += row.ideal;
    }
    frame.end_early(plan);
    frame
}

impl CpuFrame {
    fn empty(plan: &Plan) -> Self {
        let counted = plan.steps.iter().filter(|s| s.group == Group::Alive).count();
        Self {
            pixels: Vec::new(),
            undecided: Vec::new(),
            outline: 0,
            counts: Counts::new(plan.passes),
            rays_left: vec![0; counted],
            ideal: 0,
        }
    }

    /// Takes away the counts of steps that are not run since no ray was left.
    fn end_early(&mut self, plan: &Plan) {
        let counted = plan.steps.iter().enumerate().filter(|(_, s)| s.group == Group::Alive);
        let Some(((end, _), _)) = counted.zip(&self.rays_left).find(|(_, left)| **left == 0) else { return };
        for step in &plan.steps[end..] {
            if let Some(list) = self.counts.of(step.group) {
                list[step.pass as usize] = 0;
            }
        }
    }
}

fn run_row(twin: &Twin, plan: &Plan, row: u32, raster: f64) -> CpuFrame {
    let mut frame = CpuFrame::empty(plan);
    for column in 0..plan.view.size[0] {
        let mut pixel = Pixel { column, row, ..Pixel::default() };
        let mut hits = Coverage::default();
        let mut counted = 0;
        for step in plan.frame() {
            let Work::Draw(draw) = &step.work else { continue };
            let fragments = hits.of(draw.geometry, twin, Sample { pixel: [column, row], raster }).fragments;
            let runs = fragments > 0 && takes_part(draw, &pixel);
            if step.group == Group::Alive {
                frame.rays_left[counted] += u64::from(runs);
                counted += 1;
            }
            let Some(pass) = draw.twin.filter(|_| runs) else { continue };
            let effect = pass(twin, &mut pixel, step.pass);
            if let Some(list) = frame.counts.of(step.group) {
                list[step.pass as usize] += 1;
            }
            frame.ideal += u64::from(effect == Effect::Contributed);
        }
        let on_outline = hits.undecided();
        frame.pixels.push(pixel.accumulated);
        frame.undecided.push(pixel.undecided || on_outline);
        frame.outline += u64::from(on_outline);
    }
    frame
}

/// Whether the fragment passes the step's tests. One rule for every form: stored <= bound.
fn takes_part(draw: &Draw, pixel: &Pixel) -> bool {
    pixel.stored <= f64::from(draw.bound)
}

/// What geometries make of one pixel, each asked once.
#[derive(Default)]
struct Coverage(Vec<(&'static Geometry, Hits)>);

impl Coverage {
    fn of(&mut self, geometry: &'static Geometry, twin: &Twin, sample: Sample) -> Hits {
        if let Some((_, known)) = self.0.iter().find(|(of, _)| *of == geometry) {
            return *known;
        }
        let hits = (geometry.hits)(twin.scene, &twin.rays, sample);
        self.0.push((geometry, hits));
        hits
    }

    fn undecided(&self) -> bool {
        self.0.iter().any(|(_, hits)| hits.undecided)
    }
}
