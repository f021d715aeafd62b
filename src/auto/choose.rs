//! The choice: every method that draws the scene is weighed, the best of them with other settings besides.

use cpu_time::ThreadTime;

use super::cost::{build_ms, frame_ms, ranges_pay, served};
use super::error::meeting;
use super::look::Look;
use super::record::{AutoRecord, Estimate};
use super::work::{Tuning, WayOfWorking, Work};
use crate::error::{Error, Result};
use crate::feature::tiles;
use crate::method::{self, METHODS, SINGLE_PASS};
use crate::part::form::Form;
use crate::part::rows::{Ahead, Method};
use crate::plan;
use crate::scene::Scene;
use crate::scene::settings::{Cull, Mark, MethodSettings, SamplingSettings, Settings, Tiles};

/// What is known of a device when a method is chosen for it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviceFacts {
    /// Of methods that cull there, each by its own form.
    pub methods: Vec<MethodFacts>,
}

/// What is known of a method on a device.
#[derive(Clone, Debug, PartialEq)]
pub struct MethodFacts {
    pub method: &'static str,
    /// Whether its form is not there, or came out wrong in the self-check.
    pub unfit: bool,
    /// What the self-check found of its form, where it was asked.
    pub form: Option<String>,
    /// Why fragments that are culled are shaded all the same, as a probe of the device has found; none where they are not, or it was
    /// not probed.
    pub culls_late: Option<String>,
}

impl DeviceFacts {
    fn of(&self, method: &Method) -> Option<&MethodFacts> {
        self.methods.iter().find(|facts| facts.method == method.name)
    }
}

/// Settings of methods that are weighed where the scene leaves them as they are by default.
const SAMPLES_PER_PASS: [u32; 3] = [8, 16, 32];
/// Of loops that look ahead: samples that a ray takes before it looks again.
const SAMPLES_PER_LOOK: [u32; 3] = [4, 8, 16];
const LOOKUPS: [u32; 2] = [1, 16];
const CELLS: [u32; 3] = [1, 2, 4];

/// The settings that a method is weighed with first, and how many methods are weighed with all of them.
const FIRST: Tuning = Tuning { samples_per_pass: 32, lookups: 16, cell: 1, first: false };
const REFINED: usize = 4;

/// Puts a method and its settings in place of `auto`, and steps that meet the error that is asked for; other scenes stay as they are.
///
/// # Errors
/// As [`choose`], and when no step meets the error.
pub fn settle(scene: &mut Scene, facts: &DeviceFacts) -> Result<Option<AutoRecord>> {
    let asked = scene.settings.sampling.error;
    if asked.is_some() {
        takes_errors(scene)?;
    }
    if !scene.settings.method.name.is_auto() && asked.is_none() {
        return Ok(None);
    }
    if scene.tetrahedra.is_some() {
        // Those of cells differ in little, and none is weighed.
        let cells = METHODS.into_iter().find(|method| method.goes_through_cells() && method.loops());
        scene.settings.method.name = cells.map_or_else(Default::default, Method::name);
        return Ok(None);
    }
    if scene.settings.adaptive.importance {
        // Whoever takes them, steps are those that the importance volume allows, and a loop has nothing between them.
        scene.settings.method.name = SINGLE_PASS.name();
        return Ok(None);
    }
    let begin = ThreadTime::now();
    let mut record = match asked {
        None => choose(scene, facts)?,
        Some(bound) => {
            let (sampling, record) = choose_meeting(scene, facts, bound)?;
            scene.settings.sampling = sampling;
            record
        }
    };
    let Estimate { method, samples_per_pass, lookups, cell, .. } = &record.chosen;
    let settings = &mut scene.settings;
    settings.sampling.samples_per_pass = *samples_per_pass;
    (settings.method.lookups, settings.method.cell) = (*lookups, *cell);
    settings.method.name =
        method.parse().map_err(|e: String| Error::usage("--method auto", e, "please report this"))?;
    if record.tiles && method::find(settings.method.name).is_some_and(tiles::are_left_out_by) {
        settings.method.tiles = Tiles::Live;
    }
    record.look_ms = begin.elapsed().as_secs_f64() * MILLISECONDS;
    Ok(Some(record))
}

/// Whether steps can be chosen so that they meet an error.
///
/// # Errors
/// When the scene has no steps, or steps by a tolerance of their own, or is drawn by a method that is not weighed.
fn takes_errors(scene: &Scene) -> Result<()> {
    let refused = |why: &str, remedy: &str| Err(Error::usage("sampling.error (--error)", why, remedy));
    let weighed = |method: &Method| method.on_device && method.takes_samples();
    match () {
        () if scene.tetrahedra.is_some() => refused(
            "chooses steps, and ways through cells have lengths of their own",
            "leave it out: each way is integrated exactly, and --termination 1 ends none early",
        ),
        () if scene.settings.adaptive.importance => refused(
            "chooses steps that are all alike, and adaptive steps have a tolerance of their own",
            "use --tolerance",
        ),
        () if method::find(scene.settings.method.name).is_some_and(|method| !weighed(method)) => refused(
            "chooses by the time that samples take on a device, which this method has none of",
            "name another method, or auto",
        ),
        () => Ok(()),
    }
}

/// The way of sampling that meets an error in the least time, with the method.
fn choose_meeting(scene: &Scene, facts: &DeviceFacts, bound: f64) -> Result<(SamplingSettings, AutoRecord)> {
    let mut best: Option<(SamplingSettings, AutoRecord)> = None;
    let mut refused = None;
    for (sampling, error) in meeting(scene, bound)? {
        let mut sampled = scene.clone();
        sampled.settings.sampling = sampling.clone();
        // A method may take one classification and not the other.
        let record = match choose(&sampled, facts) {
            Ok(record) => AutoRecord { error: Some(error), named: !scene.settings.method.name.is_auto(), ..record },
            Err(e) => {
                refused = Some(e);
                continue;
            }
        };
        if best.as_ref().is_none_or(|(_, best)| record.chosen.ms < best.chosen.ms) {
            best = Some((sampling, record));
        }
    }
    let none = || Error::usage("sampling.error (--error)", "is met by nothing", "ask for a larger error");
    best.ok_or_else(|| refused.unwrap_or_else(none))
}

/// In a second.
const MILLISECONDS: f64 = 1e3;

/// The method that draws `scene` in the least time, with its part of what is built for it.
///
/// # Errors
/// When no method draws the scene, with the reason of the last one, or the camera is not one.
pub fn choose(scene: &Scene, facts: &DeviceFacts) -> Result<AutoRecord> {
    let mut look = Look::of(scene)?;
    look.leaves_out_tiles = leaves_out_tiles(scene, &look);
    let mut refused = None;
    let mut weighed: Vec<Estimate> = Vec::new();
    let mut scales = Scales { scene, look: &look, facts, known: Vec::new() };
    let asked = &scene.settings.method;
    let of_passes = |method: &Method| scene.settings.sampling.passes == 0 || takes_passes(method);
    // Shells have a picture of their own.
    let named = |method: &Method| asked.name.is_auto() || method.name() == asked.name;
    let asked_for = |method: &&'static Method| {
        named(method)
            && method.on_device
            && method.takes_samples()
            && culls_as_asked(method, asked)
            && of_passes(method)
    };
    let (unfit, fit): (Vec<_>, Vec<_>) =
        METHODS.into_iter().filter(asked_for).partition(|method| facts.of(method).is_some_and(|facts| facts.unfit));
    // Where nothing else is left, the device says what it lacks.
    for method in if fit.is_empty() { unfit } else { fit } {
        match draws(method, scene) {
            Ok(()) => weighed.push(scales.weigh(method, first(method, &scene.settings))),
            Err(e) => refused = Some(e),
        }
    }
    by_time(&mut weighed);
    for estimate in weighed.iter_mut().take(REFINED) {
        let Some(method) = METHODS.into_iter().find(|method| method.name == estimate.method) else { continue };
        let others = tunings(method, &scene.settings).into_iter().map(|tuning| scales.weigh(method, tuning));
        let best = others.min_by(|a, b| a.ms.total_cmp(&b.ms));
        *estimate = best.filter(|best| best.ms < estimate.ms).unwrap_or_else(|| estimate.clone());
    }
    by_time(&mut weighed);
    let none = || {
        Error::usage(
            format!("--method {}", asked.name),
            "leaves no method of the device that draws this scene",
            "name another one",
        )
    };
    let chosen = weighed.first().cloned().ok_or_else(|| refused.unwrap_or_else(none))?;
    let method = &scene.settings.method;
    Ok(AutoRecord {
        samples_per_pass: scene.settings.sampling.samples_per_pass,
        frames: method.frames,
        moving: method.moving,
        look_ms: 0.0,
        reasons: reasons(&look, facts, &chosen),
        tiles: look.leaves_out_tiles,
        named: false,
        error: None,
        chosen,
        runner_up: weighed.get(1).cloned(),
        weighed,
    })
}

/// Whether methods that leave out tiles of pixels behind which nothing shows do so: where that is asked for, or left open and pays.
fn leaves_out_tiles(scene: &Scene, look: &Look) -> bool {
    let method = &scene.settings.method;
    let leaping = &method::SINGLE_PASS_OMNI;
    let ms = |leaves_out_tiles: bool| {
        let (look, tuning) = (Look { leaves_out_tiles, ..look.clone() }, first(leaping, &scene.settings));
        frame_ms(leaping, tuning, &Work::of(leaping, tuning, &look), scene)
    };
    let pays = || ranges_pay(ms(false) - ms(true), scene.field.values.len() as f64, method.frames);
    let asked = match method.tiles {
        Tiles::Auto => method.name.is_auto() && pays(),
        tiles => tiles == Tiles::Live,
    };
    asked && tiles::serve(scene).is_ok()
}

/// Whether a method has passes that can be forced, and M samples in each.
fn takes_passes(method: &Method) -> bool {
    !method.loops() && !method.back_to_front()
}

/// Whether a method has the cull and mark that settings ask for; one that culls nothing has none.
fn culls_as_asked(method: &Method, asked: &MethodSettings) -> bool {
    let as_asked = |form: &Form| {
        (asked.cull == Cull::Auto || form.cull == asked.cull) && (asked.mark == Mark::Auto || form.mark == asked.mark)
    };
    (asked.cull, asked.mark) == (Cull::Auto, Mark::Auto) || (method.forms)().iter().any(as_asked)
}

/// Whether a method draws the scene.
fn draws(method: &Method, scene: &Scene) -> Result<()> {
    let mut scene = scene.clone();
    scene.settings.method.name = method.name();
    plan::check(&scene)
}

fn by_time(weighed: &mut [Estimate]) {
    weighed.sort_by(|a, b| a.ms.total_cmp(&b.ms));
}

/// What methods are weighed with.
struct Scales<'a> {
    scene: &'a Scene,
    look: &'a Look,
    facts: &'a DeviceFacts,
    /// Many methods do the same work.
    known: Vec<(WayOfWorking, Tuning, Work)>,
}

impl Scales<'_> {
    fn work(&mut self, method: &Method, tuning: Tuning) -> Work {
        let way = WayOfWorking::of(method);
        if let Some((.., work)) = self.known.iter().find(|(known, of, _)| (*known, *of) == (way, tuning)) {
            return *work;
        }
        let work = Work::of(method, tuning, self.look);
        self.known.push((way, tuning, work));
        work
    }

    /// What a method would take.
    fn weigh(&mut self, method: &'static Method, tuning: Tuning) -> Estimate {
        let mut work = self.work(method, tuning);
        if self.facts.of(method).is_some_and(|facts| facts.culls_late.is_some()) {
            let all = if method.stack().is_some() { &method::SLICES_3D } else { &method::RC };
            work = work.with_late_culling(&self.work(all, tuning));
        }
        let looks_ahead = method.looks_ahead() && self.look.any_is_free;
        let build_ms = if looks_ahead { build_ms(method, tuning, self.scene) } else { 0.0 };
        let frame_ms = frame_ms(method, tuning, &work, self.scene);
        let settings = &self.scene.settings.method;
        let served = served(method, settings.frames, settings.moving);
        Estimate {
            method: method.name.to_owned(),
            samples_per_pass: tuning.samples_per_pass,
            lookups: tuning.lookups,
            cell: tuning.cell,
            frame_ms,
            build_ms,
            ms: frame_ms + build_ms / f64::from(served),
            work,
        }
    }
}

/// The settings that a method is weighed with first: of each one that may be chosen, that of [`FIRST`].
fn first(method: &Method, settings: &Settings) -> Tuning {
    let (asked, all) = (asked(settings), tunings(method, settings));
    let pick =
        |of: fn(&Tuning) -> u32| if all.iter().any(|one| of(one) == of(&FIRST)) { of(&FIRST) } else { of(&asked) };
    Tuning {
        samples_per_pass: pick(|one| one.samples_per_pass),
        lookups: pick(|one| one.lookups),
        cell: pick(|one| one.cell),
        first: asked.first,
    }
}

/// The settings of a scene.
fn asked(settings: &Settings) -> Tuning {
    Tuning {
        samples_per_pass: settings.sampling.samples_per_pass,
        lookups: settings.method.lookups,
        cell: settings.method.cell,
        first: settings.method.block_first,
    }
}

/// The settings that a method is weighed with. What the scene has otherwise than by default stays as it is.
fn tunings(method: &Method, settings: &Settings) -> Vec<Tuning> {
    let (asked, default) = (asked(settings), asked(&Settings::default()));
    let pick = |changes: bool, asked: u32, default: u32, all: &[u32]| match changes && asked == default {
        true => all.to_vec(),
        false => vec![asked],
    };
    // Where passes are forced, M says how far they go.
    let in_passes = takes_passes(method) && settings.sampling.passes == 0;
    let in_looks = method.loops() && method.looks_ahead();
    let of_method = if in_looks { &SAMPLES_PER_LOOK } else { &SAMPLES_PER_PASS };
    let ms = pick(in_passes || in_looks, asked.samples_per_pass, default.samples_per_pass, of_method);
    let lookups = pick(method.marks_sections(), asked.lookups, default.lookups, &LOOKUPS);
    let distances = matches!(method.ahead, Ahead::Distances(_));
    let cells = pick(distances, asked.cell, default.cell, &CELLS);
    let mut all = Vec::new();
    for &samples_per_pass in &ms {
        for &lookups in &lookups {
            // A ray needs some samples to get out of a cell in which something shows: looks before that find nothing new.
            let often = |cell: u32| in_looks && ms.len() > 1 && samples_per_pass < 2 * cell;
            let cells = cells.iter().filter(|cell| !often(**cell));
            all.extend(cells.map(|&cell| Tuning { samples_per_pass, lookups, cell, ..asked }));
        }
    }
    all
}

/// What was found, in sentences.
fn reasons(look: &Look, facts: &DeviceFacts, chosen: &Estimate) -> Vec<String> {
    let rays = look.rays().count();
    let mean =
        |of: &dyn Fn(&super::LookRay) -> usize| look.rays().map(|ray| of(ray) as f64).sum::<f64>() / rays.max(1) as f64;
    let samples = mean(&|ray| ray.samples as usize);
    let (end, shown) = (mean(&|ray| ray.seen.len()), mean(&|ray| ray.seen.iter().filter(|seen| seen.shows).count()));
    let mut reasons = vec![
        format!("{:.1} % of the cells of a coarse grid have something that shows", 100.0 * look.coarse.open_share()),
        format!(
            "of {rays} rays each has {samples:.0} samples on average, {end:.0} before it ends, {shown:.0} of which show something",
        ),
    ];
    let near_neighbor = METHODS.into_iter().filter(|method| method.marks_sections());
    reasons.extend(near_neighbor.filter_map(|method| facts.of(method)?.form.clone()).next());
    let unfit = facts.methods.iter().filter(|facts| facts.unfit).count();
    let lacking = || format!("{unfit} methods are left out, whose way to cull this device lacks or gets wrong");
    reasons.extend((unfit > 0).then(lacking));
    let late: Vec<&MethodFacts> = facts.methods.iter().filter(|facts| facts.culls_late.is_some()).collect();
    let of_chosen = late.iter().find(|facts| facts.method == chosen.method);
    let one = of_chosen.or(late.first()).and_then(|facts| Some((facts.method, facts.culls_late.as_ref()?)));
    reasons.extend(one.map(|(method, why)| format!("{method}'s culled fragments are shaded all the same: {why}")));
    reasons
}
