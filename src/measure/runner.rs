//! Runs the methods of one scene on a device and fills a [`Run`] for each: counts and times from separate frames,
//! after warm-ups, the methods' repeats interleaved so that a busy machine troubles all of them alike.

use std::collections::{BTreeMap, btree_map};
use std::sync::Arc;

use super::checked::{Checked, no_device, refuse_missing};
use super::chosen::Settled;
use super::error::compare;
use super::fragment_kind::FragmentKind;
use super::frame_times::{gpu_times, host_times, pass_times};
use super::law::law_of_skipping;
use super::limits;
use super::measured::Measured;
use super::notes::{parts_between_layers, polygons_of_shells, with_effect};
use super::picture::Picture;
use super::record::{CountsRecord, EffectRecord, FORMAT, Ideal, LeftOutRecord, Run, TextureRecord};
use super::saving;
use super::timing::Timing;
use super::view::view_in_words;
use super::warnings::warnings;
use crate::auto::AutoRecord;
use crate::error::Result;
use crate::frame::{self, CpuFrame, FrameRun, GpuFrame, Measure, Resident, Structures, Verdict, cpu, plan_on};
use crate::method;
use crate::plan::{self, Plan};
use crate::resource;
use crate::scene::Scene;
use crate::scene::settings::{MethodSettings, Settings};
use crate::scene::texture::TextureChoice;
use crate::truth::importance::Importance;

/// How often frames are run.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Frames run and thrown away: the first draw with a new pipeline takes many times as long.
    pub warmups: usize,
    /// Frames timed; 0 measures no times.
    pub repeats: usize,
    /// Compare with the f64 twin.
    pub reference: bool,
}

/// One scene on one device; what its methods share is made once.
pub struct Runner<'a> {
    /// None for the method `cpu` alone, which needs no device.
    pub(crate) checked: Option<&'a Checked>,
    pub(crate) scene: Scene,
    pub(crate) name: String,
    pub(crate) resident: Option<Resident>,
    /// The twin's frames, by the method that skips nothing and by M.
    references: BTreeMap<(&'static str, u32), CpuFrame>,
    /// The importance volume of adaptive steps, where no device has one.
    importance: Option<Arc<Importance>>,
    settled: Settled,
}

/// A scene with its plan, and what was chosen for it.
struct Planned {
    scene: Scene,
    plan: Plan,
    auto: Option<AutoRecord>,
}

/// A frame under measurement.
pub(super) struct Entry {
    planned: Planned,
    frame: Option<GpuFrame>,
    counts: FrameRun,
    picture: Picture,
    plain: Vec<FrameRun>,
    timed: Vec<FrameRun>,
}

impl Entry {
    /// Runs the frame for its times of the host, and once more for those of the device.
    pub(super) fn time(&mut self) -> Result<()> {
        if let Some(frame) = &mut self.frame {
            self.plain.push(frame.run(Measure::Nothing)?);
            self.timed.push(frame.run(Measure::Times)?);
        }
        Ok(())
    }
}

impl<'a> Runner<'a> {
    pub fn new(checked: Option<&'a Checked>, mut scene: Scene, name: String) -> Self {
        scene.unit = checked.map_or(scene.unit, |checked| checked.check.unit);
        let resident = checked.map(|c| Resident::new(&c.device));
        let (references, importance, settled) = Default::default();
        Self { checked, scene, name, resident, references, importance, settled }
    }

    /// Measures the scene by each of `methods`. `progress` hears what is being done.
    ///
    /// # Errors
    /// When a method has no such form, the device lacks what it needs, or the driver fails.
    pub fn measure(
        &mut self,
        methods: &[MethodSettings],
        effort: Effort,
        progress: &dyn Fn(&str),
    ) -> Result<Vec<Measured>> {
        let mut entries = Vec::with_capacity(methods.len());
        for method in methods {
            progress(&format!("{}: {}", self.name, method.name.name()));
            entries.push(self.prepare(method, effort)?);
        }
        for repeat in 0..effort.repeats {
            progress(&format!("{}: timing {} of {}", self.name, repeat + 1, effort.repeats));
            entries.iter_mut().try_for_each(Entry::time)?;
        }
        if effort.reference {
            progress(&format!("{}: f64 reference", self.name));
        }
        let mut measured: Vec<Measured> =
            entries.into_iter().map(|entry| self.finish(entry, effort)).collect::<Result<_>>()?;
        law_of_skipping(&mut measured);
        let on_cpu = self.checked.is_some_and(|checked| checked.device.info.is_cpu());
        saving::save(&mut measured.iter_mut().map(|one| &mut one.run).collect::<Vec<_>>(), on_cpu);
        Ok(measured)
    }

    /// Changes settings that leave volume, transfer function and view as they are: of sampling, what surfaces show, and the format
    /// colours are summed up in.
    pub fn vary(&mut self, change: impl FnOnce(&mut Settings)) {
        let kept = |scene: &Scene| (TextureChoice::of(scene), scene.value_slack());
        let before = kept(&self.scene);
        change(&mut self.scene.settings);
        self.references.clear();
        self.importance = None;
        // What is on the device was made for how values are kept there.
        let same = before == kept(&self.scene);
        self.resident.iter_mut().for_each(if same { Resident::forget_table } else { Resident::forget_scene });
    }

    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Whether every one of `methods` can be run, before any is.
    ///
    /// # Errors
    /// As [`Runner::measure`], but for what only running shows.
    pub fn check(&self, methods: &[MethodSettings]) -> Result<()> {
        methods.iter().try_for_each(|method| self.plan(method).map(drop))
    }

    fn plan(&self, method: &MethodSettings) -> Result<Planned> {
        let mut scene = self.scene.clone();
        scene.settings.method = method.clone();
        let auto = self.settled.settle(&mut scene, self.checked)?;
        let name = scene.settings.method.name;
        let row = method::of(name)?;
        let plan = if !row.on_device {
            plan::plan(&scene, row.papers)?
        } else {
            let checked = self.checked.ok_or_else(no_device)?;
            let form = plan::form(&scene, checked.check.automatic(name))?;
            refuse_missing(checked, form)?;
            let plan = plan_on(&checked.device, &scene, form, None)?;
            limits::check_device(&checked.device.info, &scene, &plan)?;
            plan
        };
        limits::check_host(&scene, &plan)?;
        Ok(Planned { scene, plan, auto })
    }

    pub(super) fn prepare(&mut self, method: &MethodSettings, effort: Effort) -> Result<Entry> {
        let planned = self.plan(method)?;
        let Planned { scene, plan, .. } = &planned;
        if !plan.method.on_device {
            let importance = self.importance(scene);
            return prepare_cpu(planned, importance);
        }
        let (Some(checked), Some(resident)) = (self.checked, self.resident.as_mut()) else { return Err(no_device()) };
        resident.prepare(scene, plan)?;
        let mut frame = GpuFrame::new(&checked.device, scene, plan, resident, checked.early_end)?;
        for _ in 0..effort.warmups {
            frame.run(Measure::Nothing)?;
        }
        let statistics = checked.check.statistics.is_none();
        let counts = frame.run(Measure::Counts { statistics })?;
        let picture = Picture::new(scene.settings.image.size, frame.picture()?)?;
        Ok(Entry { planned, frame: Some(frame), counts, picture, plain: vec![], timed: vec![] })
    }

    /// The importance volume of a scene with adaptive steps: the device's, or one that is made here once.
    fn importance(&mut self, scene: &Scene) -> Option<Arc<Importance>> {
        if !scene.settings.adaptive.importance {
            return None;
        }
        if let Some(there) = self.resident.as_ref().and_then(Resident::importance) {
            return Some(there);
        }
        if self.importance.is_none() {
            self.importance = Importance::of(scene).map(Arc::new);
        }
        self.importance.clone()
    }

    /// The twin's frame for a method: those with the same samples share it.
    fn reference(&mut self, scene: &Scene, passes: u32) -> Result<&CpuFrame> {
        let method = method::of(scene.settings.method.name)?;
        let bits = self.checked.map_or(cpu::SUB_PIXEL_BITS, |c| c.device.info.sub_pixel_bits);
        let importance = self.importance(scene);
        match self.references.entry((method.unskipped().name, scene.settings.sampling.samples_per_pass)) {
            btree_map::Entry::Occupied(made) => Ok(made.into_mut()),
            btree_map::Entry::Vacant(place) => {
                let mut scene = scene.clone();
                scene.settings.sampling.passes = passes;
                let rule = method.unskipped();
                scene.settings.method.name = rule.name();
                let plan = plan::plan(&scene, rule.papers)?;
                let table = self.resident.as_mut().and_then(|resident| resident.table(&scene));
                let structures = Structures { table, importance, ..Structures::default() };
                Ok(place.insert(cpu::run(&scene, &plan, &structures, bits)))
            }
        }
    }

    pub(super) fn finish(&mut self, entry: Entry, effort: Effort) -> Result<Measured> {
        let Planned { scene, plan, auto } = &entry.planned;
        let size = scene.settings.image.size;
        let (mut error, mut ideal, mut reference) = (None, None, None);
        // The twin has no GLSL.
        if effort.reference && plan.passes > 0 && scene.effect.is_none() {
            let frame = self.reference(scene, plan.passes)?;
            let twin = single(frame, size)?;
            let compared = compare(&entry.picture, &twin, Some(&frame.undecided))?;
            error = Some(compared.record("the same sum in f64 (`cpu`)"));
            let counted = plan.method.ends_rays && !plan.method.loops();
            ideal = counted.then_some(Ideal { main: frame.ideal });
            reference = Some(twin);
        }
        let on_cpu = entry.frame.is_none();
        let info = self.checked.map(|c| &c.device.info).filter(|_| !on_cpu);
        let device = info.map_or_else(|| "none (f64 on the CPU)".to_owned(), |i| i.name.clone());
        let driver = info.map_or_else(String::new, |i| format!("{} {}", i.driver_name, i.driver_info));
        let form = plan.form.filter(|_| !on_cpu);
        let memory = self.memory(&entry);
        let importance = self.importance(scene);
        let counted =
            |counts: frame::Counts| CountsRecord::of(counts.main, counts.intermediate).with_layers(&counts.layers);
        let run = Run {
            version: FORMAT,
            scene: self.name.clone(),
            view: view_in_words(scene),
            method: plan.method.name.to_owned(),
            cull: form.map(|f| f.cull_name().to_owned()),
            mark: form.map(|f| f.mark_name().to_owned()),
            passes: plan.passes,
            fragments: counted(entry.counts.fragments.clone().unwrap_or_default()),
            invocations: entry.counts.invocations.clone().map(counted),
            gpu_ms: gpu_times(&entry.timed),
            gpu_ms_per_pass: pass_times(&entry.timed, plan.passes),
            host: host_times(&entry.plain, self.build_ms(plan)),
            bytes: self.structure_bytes(plan),
            memory,
            ideal,
            error,
            device,
            driver,
            self_check: self.checked.filter(|_| !on_cpu).map(|c| c.check.words()).unwrap_or_default(),
            left_out: plan
                .left_out
                .iter()
                .map(|l| LeftOutRecord { what: l.what.clone(), why: l.why.clone() })
                .collect(),
            plan: plan.lines(),
            notes: self.notes(&entry),
            warnings: warnings(scene, plan, &entry.picture, importance.as_deref()),
            texture: TextureRecord::of(plan),
            orbit: None,
            effect: scene.effect.as_deref().map(EffectRecord::of),
            saved: None,
            auto: auto.clone(),
            settings: scene.settings.clone(),
        };
        let verdict = self.checked.zip(form).and_then(|(c, form)| c.check.forms.get(&form));
        let trusted = !matches!(verdict, Some(Verdict::Wrong(_)));
        let method = plan.method;
        Ok(Measured {
            method,
            run,
            picture: entry.picture,
            reference,
            trusted,
            differing: None,
            differing_frames: None,
        })
    }

    fn notes(&self, entry: &Entry) -> Vec<String> {
        let mut notes = plan::notes(&entry.planned.scene);
        notes.extend(entry.planned.auto.iter().flat_map(AutoRecord::sentences));
        if let Some(check) = self.checked.map(|c| &c.check).filter(|_| entry.frame.is_some()) {
            if let Some(why) = &check.statistics {
                notes.push(format!("shader invocations are not given: {why}"));
            }
            if let Some(form) = entry.planned.plan.form
                && let Some(Verdict::Wrong(what)) = check.forms.get(&form)
            {
                notes.push(format!("the self-check of {} failed on this device: {what}", form.name()));
            }
        }
        let robust = self.checked.is_some_and(|checked| checked.device.used.robust);
        notes.extend(entry.planned.scene.effect.as_deref().map(|effect| with_effect(effect, robust)));
        notes.extend(parts_between_layers(&entry.counts));
        notes.extend(FragmentKind::of(entry.planned.plan.method.name).and_then(FragmentKind::words).map(str::to_owned));
        notes.extend(polygons_of_shells(&entry.planned.scene, &entry.planned.plan));
        if entry.planned.plan.method.skips_blocks() {
            let first = entry.planned.scene.settings.method.block_first;
            let order = if first { "before each main pass, the first too" } else { "after each main pass (KW03)" };
            notes.push(format!("blocks are tested {order}"));
        }
        notes
    }

    /// Time to build what the plan looks up.
    fn build_ms(&self, plan: &Plan) -> Option<Timing> {
        let built = self.resident.as_ref().and_then(|resident| resident.build_ms(plan));
        built.map(|[ms, _]| Timing::once(ms))
    }

    fn structure_bytes(&self, plan: &Plan) -> u64 {
        let structures =
            [resource::NEAREST_DISTANCE, resource::block_ranges(), resource::BLOCK_TABLE, resource::IMPORTANCE];
        let there = self.resident.iter().flat_map(|resident| resident.bytes(plan));
        there.filter(|(r, _)| structures.contains(r)).map(|(_, b)| b).sum()
    }

    fn memory(&self, entry: &Entry) -> BTreeMap<String, u64> {
        let there = self.resident.iter().flat_map(|resident| resident.bytes(&entry.planned.plan));
        let shared = there.filter(|_| entry.frame.is_some());
        let own = entry.frame.iter().flat_map(GpuFrame::bytes);
        let mut memory = BTreeMap::new();
        // Several of a kind are one line.
        shared.chain(own).for_each(|(r, bytes)| *memory.entry(r.name().to_owned()).or_default() += bytes);
        memory
    }
}

fn prepare_cpu(planned: Planned, importance: Option<Arc<Importance>>) -> Result<Entry> {
    let Planned { scene, plan, .. } = &planned;
    let structures = Structures { importance, ..Structures::default() };
    let begin = (std::time::Instant::now(), cpu_time::ProcessTime::now());
    let frame = cpu::run(scene, plan, &structures, cpu::SUB_PIXEL_BITS);
    let run = FrameRun {
        frame_ms: begin.0.elapsed().as_secs_f64() * 1e3,
        cpu_ms: begin.1.elapsed().as_secs_f64() * 1e3,
        fragments: Some(frame.counts.clone()),
        ..FrameRun::default()
    };
    let picture = single(&frame, scene.settings.image.size)?;
    Ok(Entry { planned, frame: None, plain: vec![run.clone()], counts: run, picture, timed: vec![] })
}

/// A twin's frame in f32.
fn single(frame: &CpuFrame, size: [u32; 2]) -> Result<Picture> {
    Picture::new(size, frame.pixels.iter().map(|p| p.map(|c| c as f32)).collect())
}
