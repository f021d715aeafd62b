//! Scene to frame plan: a flat list of steps, and what was left out and why. Needs no device.

pub mod longest;
mod needs;
mod passes;
mod precision;
mod text;
mod view;
mod warnings;

pub use view::{Region, View};
pub use warnings::{notes, warnings};

use std::collections::BTreeSet;

use crate::error::{Error, Result};
use crate::pass::cull::Form;
use crate::pass::resource::Resource;
use crate::pass::{Group, Needs, Step, Work};
use crate::reference::section::most_sections;
use crate::scene::Scene;
use crate::scene::settings::{Accumulate, Alpha, Cull, DepthFormat, Filter, Formats, Last, Mark, MethodName};
use crate::scene::texture::TextureChoice;
use crate::structure::Lookup;

/// The frame of one scene, ready to be run.
#[derive(Clone, Debug)]
pub struct Plan {
    pub view: View,
    /// N, main passes.
    pub passes: u32,
    /// Cull and mark, where the method culls at all.
    pub form: Option<Form>,
    /// The distances that the steps look up, where they do.
    pub distance: Option<Lookup>,
    /// How the volume is kept for the steps; none where none reads it on a device.
    pub texture: Option<TextureChoice>,
    /// A bound of what the texture's error changes of a channel, premultiplied and linear, against exact interpolation.
    pub pixel_error: f64,
    pub steps: Vec<Step>,
    pub left_out: Vec<LeftOut>,
}

impl Plan {
    /// All that steps read, write or go through, each once.
    pub fn resources(&self) -> BTreeSet<Resource> {
        let through = |step: &Step| match step.work {
            Work::Copy { by, .. } => Some(by),
            _ => None,
        };
        let used = self.steps.iter().flat_map(|step| step.accesses.iter().map(|access| access.resource));
        used.chain(self.steps.iter().filter_map(through)).collect()
    }
}

/// Something a frame may have and this one has not.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct LeftOut {
    pub what: String,
    pub why: String,
}

/// Main passes beyond this many are refused: each is recorded, counted and timed by itself.
const MOST_PASSES: u32 = 65_536;

/// Samples of a ray, those beyond its end included; their indices are 32-bit numbers in shaders.
const MOST_SAMPLES: u64 = 1 << 31;

/// What `auto` stands for where nothing is known of the device: cull and mark of the papers.
pub fn papers_form(method: MethodName) -> Option<Form> {
    match method {
        MethodName::Rc => None,
        // KW03's own: the early z-test, and depth written by the shader.
        MethodName::RcErt | MethodName::RcBlock | MethodName::Cpu => {
            Some(Form { cull: Cull::Ztest, mark: Mark::Fragdepth })
        }
        _ => Some(Form { cull: Cull::Bounds, mark: Mark::Fragdepth }),
    }
}

/// The form a scene asks for, `automatic` in place of what it leaves open.
///
/// # Errors
/// When the method has no such form.
pub fn form(scene: &Scene, automatic: Option<Form>) -> Result<Option<Form>> {
    let method = &scene.settings.method;
    let Some(automatic) = automatic else {
        return Ok(None);
    };
    if !method.name.on_device() {
        return Ok(Some(automatic));
    }
    let near_neighbor = method.name.distance().is_some();
    let cull = match method.cull {
        Cull::Auto if method.mark != Mark::Auto && method.mark != Mark::Copy && near_neighbor => Cull::Bounds,
        Cull::Auto => automatic.cull,
        cull => cull,
    };
    let mark = match method.mark {
        // These two always mark by copy [DESIGN 2.3]; the papers' ray casters keep writing depth.
        Mark::Auto if near_neighbor && matches!(cull, Cull::Ztest | Cull::Discard) => Mark::Copy,
        // What is known of a device is known of the float format; what is copied is right in all.
        Mark::Auto if near_neighbor && method.depth != DepthFormat::D32 => Mark::Copy,
        Mark::Auto => automatic.mark,
        mark => mark,
    };
    Form { cull, mark }.check(method.name).map(Some)
}

/// Plans the frame of a scene in the given form.
///
/// # Errors
/// When the camera is not one, the view needs more main passes than can be, or the scene cannot be classified as it asks
/// for.
pub fn plan(scene: &Scene, form: Option<Form>) -> Result<Plan> {
    crate::reference::preintegrated::check(scene)?;
    let view = View::new(scene)?;
    let sampling = &scene.settings.sampling;
    let planner = scene.settings.method.planner;
    let samples = match view.longest_samples {
        longest if planner || longest == 0 => longest,
        _ => whole_diagonal(scene),
    };
    let needed = samples.div_ceil(sampling.samples_per_pass);
    // Forced passes do not run for nothing either.
    let passes = if sampling.passes > 0 && needed > 0 { sampling.passes } else { needed };
    check_passes(scene, passes)?;
    let mut left_out = Vec::new();
    let mut leave = |what: &str, why: String| left_out.push(LeftOut { what: what.to_owned(), why });
    let needs = needs::needs(scene, view.longest_samples, passes);
    let steps = if passes == 0 {
        leave("every pass", "no ray of this view meets the volume".to_owned());
        Vec::new()
    } else {
        passes::steps(scene, needs, passes, form)
    };
    if passes > 0 {
        leave_out(scene, needs, form, &steps, &mut leave);
    }
    let [width, height] = view.size;
    if passes > 0 && view.region.size() != view.size {
        let Region { width: w, height: h, .. } = view.region;
        leave("pixels of targets", format!("the box covers {w} x {h} of {width} x {height}"));
    }
    if planner && sampling.passes == 0 && passes > 0 {
        let diagonal = whole_diagonal(scene).div_ceil(sampling.samples_per_pass);
        if diagonal > passes {
            let last = diagonal - 1;
            leave(
                &if passes == last { format!("main pass {last}") } else { format!("main passes {passes} to {last}") },
                format!("the longest ray of this view has {} samples", view.longest_samples),
            );
        }
    }
    let distance = Lookup::of(scene).filter(|_| passes > 0 && needs.skips);
    let on_device = scene.settings.method.name.on_device();
    let texture = (on_device && passes > 0).then(|| TextureChoice::of(scene));
    let error = texture.map_or(0.0, |texture| texture.error);
    let pixel_error = precision::pixel_error(scene, error, view.longest_samples, passes, needs.ends);
    Ok(Plan { view, passes, form, distance, texture, pixel_error, steps, left_out })
}

/// Whether a frame of so many main passes can be run.
///
/// # Errors
/// When it cannot, with what to change.
fn check_passes(scene: &Scene, passes: u32) -> Result<()> {
    let sampling = &scene.settings.sampling;
    if passes > MOST_PASSES {
        return Err(Error::usage(
            format!("--step {} --samples-per-pass {}", sampling.step, sampling.samples_per_pass),
            format!("this view needs {passes} main passes, and at most {MOST_PASSES} are possible"),
            "take longer steps or more samples a pass",
        ));
    }
    let depth = scene.settings.method.depth;
    let told_apart = most_sections(depth);
    if scene.settings.method.name.distance().is_some() && passes > told_apart {
        return Err(Error::usage(
            format!("method.depth (--depth-format) {}", depth.name()),
            format!("tells at most {told_apart} main passes apart, and this frame has {passes}"),
            "use --depth-format d32, longer steps or more samples a pass",
        ));
    }
    let samples = u64::from(passes) * u64::from(sampling.samples_per_pass);
    if samples > MOST_SAMPLES {
        return Err(Error::usage(
            format!("--passes {passes} --samples-per-pass {}", sampling.samples_per_pass),
            format!("this is {samples} samples a ray, and at most {MOST_SAMPLES} are possible"),
            "take fewer passes or fewer samples a pass",
        ));
    }
    Ok(())
}

/// Samples on the diagonal of the volume, the longest ray of any view.
fn whole_diagonal(scene: &Scene) -> u32 {
    let step = scene.settings.sampling.step * scene.field.finest();
    (scene.field.extent().length() / step).ceil() as u32
}

fn leave_out(scene: &Scene, needs: Needs, form: Option<Form>, steps: &[Step], leave: &mut impl FnMut(&str, String)) {
    let (method, sampling) = (&scene.settings.method, &scene.settings.sampling);
    let uses = |r: Resource| steps.iter().any(|s| s.accesses.iter().any(|a| a.resource == r));
    let name = method.name.name();
    let never_ends = format!("no ray of this view comes to an opacity above {}", sampling.termination);
    const DENSE: &str =
        "every cell is interesting, so that there is nothing to skip: slices or a single pass would do as well";
    let looks_ahead = method.name.looks_ahead();
    if form.is_none() {
        leave("intermediate passes and the depth buffer", format!("{name} culls no fragments"));
    } else if !uses(Resource::Stored) {
        let why = if looks_ahead { format!("{never_ends}, and {DENSE}") } else { never_ends.clone() };
        leave("intermediate passes and the depth buffer", why);
    } else if !uses(Resource::Marks) {
        leave("marks image and copies to depth", "the intermediate pass writes depth itself".to_owned());
    }
    if method.name.fused() {
        leave("intermediate passes after the first", "main passes decide where rays go on".to_owned());
    }
    if !uses(Resource::NearestDistance) {
        let why = match (method.name.distance(), method.name.skips_blocks()) {
            (Some(_), _) => DENSE.to_owned(),
            (None, true) => format!("{name} skips by blocks"),
            (None, false) => format!("{name} does not look ahead"),
        };
        leave("distance structure", why);
    }
    if !uses(Resource::CellRange) {
        let blocks = method.name.skips_blocks();
        let why = if blocks { DENSE.to_owned() } else { format!("{name} does not look at blocks") };
        leave("block ranges and their table", why);
    }
    if form.is_some() && !needs.ends {
        leave("early ends of rays", never_ends);
    }
    if !needs.colors && !uses(Resource::Preintegrated) {
        leave("colours of the transfer function", "red, green and blue are alike everywhere".to_owned());
    }
    if scene.field.holes.is_none() {
        leave("hole mask", "every voxel is a number, or is replaced by one".to_owned());
    }
    if sampling.alpha == Alpha::Paper {
        leave("opacity correction", "alpha = \"paper\" takes opacities as they stand".to_owned());
    } else if sampling.last == Last::Full && sampling.spans() {
        leave("opacity correction", "the pre-integrated table is made for the step".to_owned());
    } else if sampling.last == Last::Full && sampling.step == scene.transfer.reference {
        leave("opacity correction", "the step is the reference length".to_owned());
    }
    if !sampling.spans() {
        leave("pre-integrated table", "samples are classified by their own value".to_owned());
    }
    if sampling.last == Last::Full {
        leave("length of the last sample", "every sample stands for a whole step".to_owned());
    }
    match sampling.filter {
        Filter::Hardware => leave("interpolation in the shader", "the texture unit interpolates".to_owned()),
        Filter::Nearest => leave("interpolation", "a sample has the value of the nearest voxel".to_owned()),
        Filter::Exact => {}
    }
    leave_out_counting(form, steps, leave);
}

/// Why rays that are left are not counted, where they are not.
fn leave_out_counting(form: Option<Form>, steps: &[Step], leave: &mut impl FnMut(&str, String)) {
    if form.is_none() || steps.iter().any(|step| step.group == Group::Alive) {
        return;
    }
    let marked = steps.iter().any(|step| step.accesses.iter().any(|access| access.resource == Resource::Stored));
    let few = format!("there are no more than {} main passes", passes::BATCH);
    leave("counting of rays", if marked { few } else { "no ray is marked".to_owned() });
}

/// Bytes a pixel of a target takes.
pub fn bytes_per_pixel(resource: Resource, formats: Formats) -> u64 {
    match resource {
        Resource::Entry | Resource::Direction => 16,
        Resource::Accumulated => match formats.accumulate {
            Accumulate::Rgba32f => 16,
            Accumulate::Rgba16f => 8,
            Accumulate::Rgba8 => 4,
        },
        Resource::Stored | Resource::Marks | Resource::MarksBuffer => match formats.depth {
            DepthFormat::D32 | DepthFormat::D24 => 4,
            DepthFormat::D16 => 2,
        },
        _ => 0,
    }
}
