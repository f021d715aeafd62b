//! Scene to frame plan: a flat list of steps, and what was left out and why. Needs no device.

pub mod builds;
mod left_out;
mod limits;
mod precision;
mod text;
mod warnings;

pub use left_out::LeftOut;
pub use warnings::{notes, warnings};

use crate::error::Result;
use crate::feature::{self, DISTANCES, SINGLE_RAYS};
use crate::method;
use crate::part::form::Form;
use crate::part::resource::{Facts, Resource};
use crate::part::rows::{Context, Method, Traversal};
use crate::part::steps::Steps;
use crate::part::{Step, Work};
use crate::resource;
use crate::scene::Scene;
use crate::scene::gathered::Gathered;
use crate::scene::settings::{Builder, Cull, DepthFormat, LeftOpen, Mark};
use crate::scene::texture::TextureChoice;
use crate::scene::view::View;
use crate::structure::Lookup;
use builds::{Asset, Build, Builds};
use left_out::{left_out, whole_diagonal};

/// The frame of one scene, ready to be run.
#[derive(Clone, Debug)]
pub struct Plan {
    pub view: View,
    pub method: &'static Method,
    /// N, main passes.
    pub passes: u32,
    /// Cull and mark, where the method culls at all.
    pub form: Option<Form>,
    /// The distances that the steps look up, where they do.
    pub distance: Option<Lookup>,
    /// How the volume is kept for the steps of the frame; none where none of them reads it on a device.
    pub texture: Option<TextureChoice>,
    /// How far off places on a ray may be, in texture coordinates; 0 where rays are found in double-floats, or in f64.
    pub rays_off: f64,
    /// A bound of what the texture's error changes of a channel, premultiplied and linear, against exact interpolation, where a ray
    /// takes as many samples: one that ends within rounding of a sample may have it or not.
    pub pixel_error: f64,
    /// Uploads and builds, then the frame itself.
    pub steps: Vec<Step>,
    /// Which steps make what, in order; those that follow are the frame.
    pub builds: Vec<Build>,
    pub left_out: Vec<LeftOut>,
}

/// What a plan is made for, besides its scene.
#[derive(Clone, Copy, Debug, Default)]
pub struct Choice {
    /// Cull and mark, where the method culls at all.
    pub form: Option<Form>,
    /// Whether the host builds what it has a form for; it does where the scene asks for that.
    pub on_host: bool,
    /// The distances looked up, where they are not those of the method.
    pub lookup: Option<Lookup>,
    /// The most texels that a buffer has, where the device is known.
    pub most_texels: Option<u32>,
}

impl Plan {
    /// The steps of the frame, without what is there before.
    pub fn frame(&self) -> &[Step] {
        &self.steps[self.builds.last().map_or(0, |build| build.steps.end)..]
    }

    /// The asset that a step means by a resource.
    pub fn asset(&self, resource: Resource) -> Asset {
        // Those of shells alone depend on more than the distances that are looked up.
        let of_shells = self.builds.iter().filter(|build| build.asset.level.is_some());
        let built = of_shells.map(|build| build.asset).find(|asset| asset.resource == resource);
        built.unwrap_or_else(|| Asset::of(resource, self.distance, None))
    }

    /// What sizes and contents of the plan's resources follow from.
    pub fn facts<'a>(&'a self, scene: &'a Scene) -> Facts<'a> {
        Facts { scene, view: &self.view, passes: self.passes, lookup: self.distance, table: None, importance: None }
    }

    /// All that steps read, write or go through, each once, in the order of lists.
    pub fn resources(&self) -> Vec<Resource> {
        self.resources_of(&self.steps)
    }

    /// All that some of the plan's steps read, write or go through, each once, in the order of lists.
    pub fn resources_of(&self, steps: &[Step]) -> Vec<Resource> {
        let through = |step: &Step| match step.work {
            Work::Copy { by, .. } => Some(by),
            _ => None,
        };
        let used = steps.iter().flat_map(|step| step.accesses.iter().map(|access| access.resource));
        let mut found: Vec<Resource> = used.chain(steps.iter().filter_map(through)).collect();
        found.sort_by_key(|resource| resource::order(*resource));
        found.dedup();
        found
    }
}

/// The form a scene asks for, `automatic` in place of what it leaves open.
///
/// # Errors
/// When the method has no such form.
pub fn form(scene: &Scene, automatic: Option<Form>) -> Result<Option<Form>> {
    let method = &scene.settings.method;
    let row = method::of(method.name)?;
    let Some(automatic) = automatic else {
        return Ok(None);
    };
    if !row.on_device {
        return Ok(Some(automatic));
    }
    let near_neighbor = row.marks_sections();
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
    row.check(Form { cull, mark }).map(Some)
}

/// Whether the method of a scene draws it, and what it asks for goes together.
///
/// # Errors
/// When it does not, with what to do.
pub fn check(scene: &Scene) -> Result<()> {
    LeftOpen::refuse(&scene.settings)?;
    let method = method::of(scene.settings.method.name)?;
    (method.takes)(scene)?;
    crate::truth::preintegrated::check(scene)?;
    feature::shells::check(scene, method)?;
    feature::layers::check(scene, method)?;
    feature::surface::check(scene)?;
    feature::lights::check(scene)?;
    feature::light_paths::check(scene)?;
    feature::clip_volume::check(scene)?;
    feature::environment::check(scene)?;
    feature::effect::check(scene)?;
    feature::refraction::check(scene)?;
    feature::backdrop::check(scene)?;
    feature::tiles::check(scene, method)?;
    feature::gradients::check(scene)
}

/// Plans the frame of a scene in the given form, for a device of which nothing is known.
///
/// # Errors
/// As [`plan_for`].
pub fn plan(scene: &Scene, form: Option<Form>) -> Result<Plan> {
    plan_for(scene, Choice { form, ..Choice::default() })
}

/// Plans the frame of a scene.
///
/// # Errors
/// When the camera is not one, the view needs more main passes than can be, or the scene cannot be classified as it asks
/// for.
pub fn plan_for(scene: &Scene, choice: Choice) -> Result<Plan> {
    check(scene)?;
    let method = method::of(scene.settings.method.name)?;
    let view = View::new(scene)?;
    let view = match method.stack() {
        Some(stack) => {
            let slices = if method.back_to_front() { None } else { Some(scene.settings.sampling.samples_per_pass) };
            view.sliced(scene, stack, slices)?
        }
        None if method.goes_through_cells() => view.through_cells(scene, choice.most_texels),
        None => view,
    };
    if let Some(shells) = scene.shells.as_ref().filter(|_| method.traversal == Traversal::Shells) {
        shells.count(&scene.field)?;
    }
    let passes = passes(scene, &view, method);
    limits::check(scene, &view, method, passes)?;
    let view = match feature::tiles::only_live(scene, method) {
        true => feature::tiles::draw_live(scene, method, view, passes),
        false => view,
    };
    let context = Context::new(scene, &view, method, choice.form, passes);
    let (frame, left_out) = match passes {
        0 if scene.backdrop.is_none() && !scene.polygons.show() || view.region.pixels() == 0 => {
            let why = match method.traversal == Traversal::Shells && view.region.pixels() > 0 {
                true => "no shell has polygons",
                false => "no ray of this view meets the volume",
            };
            (Vec::new(), vec![LeftOut::new("every pass", why)])
        }
        _ => (frame(&context), left_out(&context)),
    };
    let looks_up = passes > 0 && context.has(&DISTANCES);
    let distance = choice.lookup.or_else(|| context.lookup()).filter(|_| looks_up);
    let facts = Facts { scene, view: &view, passes, lookup: distance, table: None, importance: None };
    // The twins of a method without a device read no resources but each other's.
    let on_host = choice.on_host || scene.settings.method.build == Builder::Host;
    let Builds { steps: before, list: builds } = match method.on_device {
        true => Builds::of(&facts, on_host, &builds::reads(&frame)),
        false => Builds::default(),
    };
    // The frame's list has room for them.
    let mut steps = frame;
    steps.splice(0..0, before);
    let reads_volume = method.takes_samples() || scene.surface.is_some() && !method.goes_through_cells();
    let rays_off = if method.on_device && context.has(&SINGLE_RAYS) { view.single_rays(scene).error } else { 0.0 };
    let texture = (method.on_device && passes > 0 && reads_volume).then(|| {
        let volume = TextureChoice::of(scene);
        TextureChoice { error: volume.error.max(scene.error_beside()) + scene.error_of_places(rays_off), ..volume }
    });
    let error = texture.map_or(0.0, |texture| texture.error);
    let ends = feature::may_end(&context);
    let pixel_error = precision::pixel_error(scene, error, &Gathered::of(scene, &view, passes), ends);
    Ok(Plan {
        view,
        method,
        passes,
        form: choice.form,
        distance,
        texture,
        rays_off,
        pixel_error,
        steps,
        builds,
        left_out,
    })
}

/// N: main passes of a view.
fn passes(scene: &Scene, view: &View, method: &Method) -> u32 {
    if let Some(cells) = &view.cells {
        let meets = cells.layers() > 0 && view.region.pixels() > 0;
        if method.loops() || !meets {
            return u32::from(meets);
        }
    }
    if method.loops() {
        return u32::from(view.longest_samples > 0);
    }
    if method.traversal == Traversal::Shells {
        let shells =
            scene.shells.as_ref().filter(|shells| view.region.pixels() > 0 && shells.triangles(&scene.field) > 0);
        return shells.map_or(0, |shells| shells.drawn().len() as u32);
    }
    let sampling = &scene.settings.sampling;
    if let Some(mesh) = scene.tetrahedra.as_ref().filter(|_| method.goes_through_cells()) {
        let ahead = mesh.most_cells(&view.rays);
        // Rays that begin within the mesh come to where they do through cells behind the eye.
        let within = view.cells.as_ref().is_some_and(|cells| cells.begins.is_some());
        let needed = if within { (2 * ahead).min(mesh.cells.len() as u32) } else { ahead };
        return if sampling.passes > 0 && needed > 0 { sampling.passes } else { needed };
    }
    if let Some(slices) = &view.slices {
        if view.region.pixels() == 0 {
            return 0;
        }
        let needed = slices.count.div_ceil(slices.of_pass.unwrap_or(slices.count).max(1));
        let forced = sampling.passes > 0 && needed > 0 && slices.of_pass.is_some();
        return if forced { sampling.passes } else { needed };
    }
    let samples = match view.longest_samples {
        longest if scene.settings.method.planner || longest == 0 => longest,
        _ => whole_diagonal(scene),
    };
    let needed = samples.div_ceil(sampling.samples_per_pass);
    // Forced passes do not run for nothing either.
    if sampling.passes > 0 && needed > 0 { sampling.passes } else { needed }
}

/// The method's steps.
fn frame(context: &Context) -> Vec<Step> {
    let mut steps = Steps::default();
    (context.method.steps)(context, &mut steps);
    steps.into_list()
}
