//! What stays on the device while frames change: uploads and structures of one scene, each as long as what it was made from
//! stays, and pipelines. Runs the steps of a plan that come before its frame.

use std::borrow::Cow;
use std::sync::Arc;

use cpu_time::ProcessTime;

use super::build::{self, Bindable, Job};
use super::following::Following;
use super::object::{self, DeviceObject};
use super::pipelines::Pipelines;
use super::upload;
use crate::error::{Error, Result};
use crate::part::Step;
use crate::part::resource::{Facts, Life, Origin, Resource};
use crate::pass::build::recipe;
use crate::plan::Plan;
use crate::plan::builds::{Asset, Build, Builds, Maker};
use crate::resource;
use crate::scene::Scene;
use crate::scene::view::View;
use crate::structure::Lookup;
use crate::truth::importance::Importance;
use crate::truth::preintegrated::PreintegratedTable;
use crate::vulkan::{Device, Image};

/// Assets of one scene, made when the first plan asks for them.
pub struct Resident {
    device: Arc<Device>,
    kept: Vec<KeptAsset>,
    pub(super) pipelines: Pipelines,
    /// The table of pre-integrated classification that is here, or will be.
    table: Option<Arc<PreintegratedTable>>,
    /// The importance volume of adaptive sampling that is here.
    importance: Option<Arc<Importance>>,
    /// Distances of the host that follow the transfer function.
    following: Following,
}

/// An asset that is there.
struct KeptAsset {
    asset: Asset,
    made: DeviceObject,
    /// What building it took, pipelines not counted: CPU time of the process on a device that is a CPU or where the host
    /// built it, else device time; milliseconds.
    ms: f64,
}

/// A build that is under way.
pub struct Pending {
    pub job: Job,
    asset: Asset,
    made: DeviceObject,
    /// Live as long as the job.
    _passing: Vec<(Resource, DeviceObject)>,
}

impl Resident {
    pub fn new(device: &Arc<Device>) -> Self {
        Self {
            device: device.clone(),
            kept: Vec::new(),
            pipelines: Pipelines::new(device),
            table: None,
            importance: None,
            following: Following::default(),
        }
    }

    /// From now on, distances that the host builds are kept with what it takes to update them, which are those of one look-up at
    /// a time: after [`Resident::forget_transfer`] they cost what the new transfer function changes.
    pub fn follow_transfer(&mut self) {
        self.following.ask();
    }

    /// What a plan's steps mean by a resource.
    pub(super) fn of_plan(&self, plan: &Plan, resource: Resource) -> Option<&DeviceObject> {
        self.kept(plan.asset(resource)).map(|kept| &kept.made)
    }

    fn made(&self, resource: Resource, lookup: Option<Lookup>) -> Option<&DeviceObject> {
        self.kept(Asset::of(resource, lookup, None)).map(|kept| &kept.made)
    }

    fn kept(&self, asset: Asset) -> Option<&KeptAsset> {
        self.kept.iter().find(|kept| kept.asset == asset)
    }

    /// Whether a resource is there that depends on no look-up.
    pub fn has(&self, resource: Resource) -> bool {
        self.made(resource, None).is_some()
    }

    /// The distances of that kind.
    pub fn distance(&self, lookup: &Lookup) -> Option<&Image> {
        self.made(resource::NEAREST_DISTANCE, Some(*lookup)).and_then(DeviceObject::image)
    }

    /// The distances as the device has them, a byte a cell and octant; none where they were not built.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn read_distances(&self, lookup: &Lookup) -> Result<Option<Vec<u8>>> {
        self.distance(lookup).map(|image| upload::read_sampled(&self.device, image)).transpose()
    }

    /// The gradients of the scene's volume as the device has them, texels x fastest; none where they were not built.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn read_gradients(&self, scene: &Scene) -> Result<Option<Vec<u8>>> {
        let image = self.made(resource::gradients(scene), None).and_then(DeviceObject::image);
        image.map(|image| upload::read_sampled(&self.device, image)).transpose()
    }

    /// The vertices and triangles of a shell as the device has them, by its number in the plan's scene; none where they are not there.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn read_shell(&self, plan: &Plan, number: u16) -> Result<Option<Vec<u8>>> {
        let made = self.of_plan(plan, resource::SHELL_POLYGONS.at(number)).and_then(DeviceObject::buffer);
        made.map(|buffer| upload::read_buffer(&self.device, buffer)).transpose()
    }

    /// The table of pre-integrated classification, where the scene asks for one: the one that is here, or a new one.
    pub fn table(&mut self, scene: &Scene) -> Option<Arc<PreintegratedTable>> {
        let asked = scene.has_step_table();
        asked.then(|| self.table.get_or_insert_with(|| Arc::new(PreintegratedTable::new(scene))).clone())
    }

    /// The importance volume of the scene that was prepared last, where it has adaptive steps.
    pub fn importance(&self) -> Option<Arc<Importance>> {
        self.importance.clone()
    }

    /// Forgets the tables of classification and the importance volume: the next plan's scene may have other steps.
    pub fn forget_table(&mut self) {
        (self.table, self.importance) = (None, None);
        self.kept.retain(|kept| {
            ![resource::PREINTEGRATED, resource::AXIS, resource::TET_TABLE, resource::IMPORTANCE]
                .contains(&kept.asset.resource)
        });
    }

    /// Forgets what depends on the transfer function: the next plan's scene may have another one.
    pub fn forget_transfer(&mut self) {
        (self.table, self.importance) = (None, None);
        self.kept.retain(|kept| matches!(kept.asset.resource.of.life, Life::Volume | Life::Shell));
    }

    /// Forgets the scene; pipelines stay, which the next one may draw with too.
    pub fn forget_scene(&mut self) {
        (self.table, self.importance) = (None, None);
        self.following.forget();
        self.kept.clear();
    }

    /// Forgets shells that the scene has no more; those that are left out for now stay.
    fn keep_shells(&mut self, scene: &Scene) {
        let has = |level: f64| scene.shells.as_ref().is_some_and(|shells| shells.has(level));
        self.kept.retain(|kept| kept.asset.level.is_none_or(has));
    }

    /// Forgets what was made for other views than these.
    pub fn keep_views(&mut self, views: &[Lookup]) {
        let of_no_view = |lookup: &Lookup| lookup.view.is_none();
        self.kept.retain(|kept| kept.asset.lookup.is_none_or(|lookup| of_no_view(&lookup) || views.contains(&lookup)));
    }

    /// Bytes of each resource that the plan's frame reads.
    pub fn bytes(&self, plan: &Plan) -> Vec<(Resource, u64)> {
        let read = crate::plan::builds::reads(plan.frame());
        read.into_iter().filter_map(|r| Some((r, self.of_plan(plan, r)?.bytes()))).collect()
    }

    /// Milliseconds that building what the plan looks up took, and the part of it that every new view takes; none where
    /// it builds nothing.
    pub fn build_ms(&self, plan: &Plan) -> Option<[f64; 2]> {
        let built = plan.builds.iter().filter(|build| build.maker != Maker::Upload);
        let times: Vec<(Asset, f64)> =
            built.filter_map(|build| self.kept(build.asset).map(|kept| (build.asset, kept.ms))).collect();
        let of_view = |asset: &Asset| asset.lookup.is_some_and(|lookup| lookup.view.is_some());
        let total = |of: &dyn Fn(&Asset) -> bool| {
            times.iter().filter(|(asset, _)| of(asset)).fold(0.0, |sum, (_, ms)| sum + ms)
        };
        (!times.is_empty()).then(|| [total(&|_| true), total(&of_view)])
    }

    /// Runs the steps of the plan that come before its frame; those are passed over whose assets are there.
    ///
    /// # Errors
    /// When the volume is larger than the device allows or cannot be filtered there, buffers are beyond its limits, or
    /// memory is short.
    pub fn prepare(&mut self, scene: &Scene, plan: &Plan) -> Result<()> {
        self.pipelines.prepare(&plan.steps)?;
        self.keep_shells(scene);
        plan.builds.iter().filter(|build| !build.of_frame()).try_for_each(|build| {
            let facts = Facts { lookup: build.asset.lookup.or(plan.distance), ..plan.facts(scene) };
            self.run(&facts, build, &plan.steps[build.steps.clone()])
        })
    }

    /// Makes an asset, where it is not there.
    fn run(&mut self, facts: &Facts, build: &Build, steps: &[Step]) -> Result<()> {
        if self.kept(build.asset).is_some() {
            return Ok(());
        }
        let asset = build.asset;
        let (made, ms) = match build.maker {
            Maker::Upload | Maker::Host => self.upload(facts, asset.resource, steps)?,
            Maker::Compute => {
                let mut pending = self.record(facts, asset, steps)?;
                let ms = timed(&self.device, &mut pending.job)?;
                (self.taken(pending)?, ms)
            }
        };
        self.kept.push(KeptAsset { asset, made, ms });
        Ok(())
    }

    /// What the host makes, on the device, and the milliseconds that making it took.
    fn upload(&mut self, facts: &Facts, resource: Resource, steps: &[Step]) -> Result<(DeviceObject, f64)> {
        steps.iter().for_each(|step| self.device.trace(&step.name));
        let table = self.table(facts.scene);
        let begin = ProcessTime::now();
        if resource == resource::IMPORTANCE {
            self.importance = Importance::of(facts.scene).map(Arc::new);
        }
        let facts = Facts { table: table.as_deref(), importance: self.importance.as_deref(), ..*facts };
        let lookup = facts.lookup.filter(|_| resource == resource::NEAREST_DISTANCE);
        let following = lookup.and_then(|lookup| self.following.distances(facts.scene, &lookup));
        let recipe = recipe(resource).and_then(|recipe| recipe.host);
        let bytes: Cow<[u8]> = match (&resource.of.origin, following, recipe) {
            (_, Some(bytes), _) => bytes.into(),
            (Origin::Host(bytes), ..) => bytes(&facts),
            (.., Some(build)) => build(&facts, resource.index).into(),
            _ => {
                let problem = format!("nobody makes {}", resource.name());
                return Err(Error::device(&self.device.info.name, problem, "please report this"));
            }
        };
        let ms = begin.elapsed().as_secs_f64() * 1e3;
        Ok((object::filled(&self.device, resource, &facts, &bytes)?, ms))
    }

    /// Records the compute steps of an asset.
    fn record(&mut self, facts: &Facts, asset: Asset, steps: &[Step]) -> Result<Pending> {
        let made = object::empty(&self.device, asset.resource, facts)?;
        let mut passing: Vec<(Resource, DeviceObject)> = Vec::new();
        for resource in steps.iter().flat_map(|step| step.accesses.iter()).map(|access| access.resource) {
            let there = passing.iter().any(|(of, _)| *of == resource);
            if matches!(resource.of.origin, Origin::Passing) && !there {
                passing.push((resource, object::empty(&self.device, resource, facts)?));
            }
        }
        let kept = &self.kept;
        let given = |resource: Resource| -> Option<Bindable> {
            let of = Asset::of(resource, facts.lookup, facts.scene.shells.as_deref());
            let passing = passing.iter().find(|(of, _)| *of == resource).map(|(_, made)| made);
            let before = || kept.iter().find(|kept| kept.asset == of).map(|kept| &kept.made);
            let found = if of == asset { Some(&made) } else { passing.or_else(before) };
            found.map(|made| made.given(resource))
        };
        let job = Job::new(&self.device, asset.resource.name(), steps, &mut self.pipelines, &given)?;
        Ok(Pending { job, asset, made, _passing: passing })
    }

    /// What a finished job made, for frames to read.
    fn taken(&self, pending: Pending) -> Result<DeviceObject> {
        if let (Some(image), Some(last)) = (pending.made.image(), pending.job.last()) {
            build::acquire(&self.device, image, last)?;
        }
        Ok(pending.made)
    }

    /// Begins to build distances on the device, which serve views to come; what they are made from is built first. See
    /// [`super::Background`].
    ///
    /// # Errors
    /// As [`Resident::prepare`].
    pub fn begin(&mut self, scene: &Scene, lookup: &Lookup) -> Result<Option<Pending>> {
        let view = View::new(scene)?;
        let of = |lookup| Facts { scene, view: &view, passes: 0, lookup, table: None, importance: None };
        let facts = of(Some(*lookup));
        let builds = Builds::of_distances(&facts, false);
        self.pipelines.prepare(&builds.steps)?;
        let Some((last, before)) = builds.list.split_last() else { return Ok(None) };
        for build in before {
            self.run(&of(build.asset.lookup.or(facts.lookup)), build, &builds.steps[build.steps.clone()])?;
        }
        self.record(&facts, last.asset, &builds.steps[last.steps.clone()]).map(Some)
    }

    /// Takes over what was begun and has ended; `ms` is what it took.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn finish(&mut self, pending: Pending, ms: f64) -> Result<()> {
        let asset = pending.asset;
        let made = self.taken(pending)?;
        self.kept.push(KeptAsset { asset, made, ms });
        Ok(())
    }
}

/// Runs a job; milliseconds of CPU time of the process on a device that is a CPU, else of the device.
fn timed(device: &Device, job: &mut Job) -> Result<f64> {
    let begin = ProcessTime::now();
    job.run(&[])?;
    let cpu = begin.elapsed().as_secs_f64() * 1e3;
    Ok(if device.info.is_cpu() { cpu } else { job.device_ms()?.unwrap_or(cpu) })
}
