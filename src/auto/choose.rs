//! The choice: every method that draws the scene is weighed, the best of them with other settings besides.

use super::cost::{build_ms, frame_ms, frame_parts, ranges_pay, served};
use super::device_costs::{DeviceCosts, TimedFrame};
use super::look::Look;
use super::record::{AutoRecord, Estimate};
use super::tunings::{Tuning, first, takes_passes, tunings};
use super::work::{WayOfWorking, Work};
use crate::error::{Error, Result};
use crate::feature::tiles;
use crate::method::{self, METHODS};
use crate::part::form::Form;
use crate::part::rows::Method;
use crate::plan;
use crate::scene::Scene;
use crate::scene::settings::{Cull, LeftOpen, Mark, MethodSettings, Tiles};

/// What is known of a device when a method is chosen for it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviceFacts {
    /// Of methods that cull there, each by its own form.
    pub methods: Vec<MethodFacts>,
    pub costs: DeviceCosts,
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

/// How many methods are weighed with all their settings.
const REFINED: usize = 4;

/// The method that draws `scene` in the least time, with its part of what is built for it.
///
/// # Errors
/// When no method draws the scene, with the reason of the last one, or the camera is not one.
pub fn choose(scene: &Scene, facts: &DeviceFacts) -> Result<AutoRecord> {
    let mut scene = scene.clone();
    let open = LeftOpen::close(&mut scene.settings);
    choose_open(&scene, facts, open)
}

/// Chooses as [`choose`] does, for a scene whose numbers were left open and have been closed.
pub(super) fn choose_open(scene: &Scene, facts: &DeviceFacts, open: LeftOpen) -> Result<AutoRecord> {
    let mut look = Look::of(scene)?;
    look.leaves_out_tiles = leaves_out_tiles(scene, &look, facts, open);
    let mut refused = None;
    let mut weighed: Vec<Estimate> = Vec::new();
    let mut scales = Scales { scene, look: &look, facts, known: Vec::new() };
    let asked = &scene.settings.method;
    // Of a method that is named, planners say what it does not take.
    let is_named = !asked.name.is_auto();
    let of_passes = |method: &Method| is_named || scene.settings.sampling.passes == 0 || takes_passes(method);
    // Shells have a picture of their own.
    let named = |method: &Method| asked.name.is_auto() || method.name() == asked.name;
    let asked_for = |method: &&'static Method| {
        named(method)
            && method.on_device
            && method.takes_samples()
            && (is_named || culls_as_asked(method, asked))
            && of_passes(method)
    };
    let (unfit, fit): (Vec<_>, Vec<_>) =
        METHODS.into_iter().filter(asked_for).partition(|method| facts.of(method).is_some_and(|facts| facts.unfit));
    // Where nothing else is left, the device says what it lacks.
    for method in if fit.is_empty() { unfit } else { fit } {
        match draws(method, scene) {
            Ok(()) => weighed.push(scales.weigh(method, first(method, &scene.settings, open))),
            Err(e) => refused = Some(e),
        }
    }
    by_time(&mut weighed);
    for estimate in weighed.iter_mut().take(REFINED) {
        let Some(method) = METHODS.into_iter().find(|method| method.name == estimate.method) else { continue };
        let others = tunings(method, &scene.settings, open).into_iter().map(|tuning| scales.weigh(method, tuning));
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
fn leaves_out_tiles(scene: &Scene, look: &Look, facts: &DeviceFacts, open: LeftOpen) -> bool {
    let method = &scene.settings.method;
    let leaping = &method::SINGLE_PASS_OMNI;
    let ms = |leaves_out_tiles: bool| {
        let (look, tuning) = (Look { leaves_out_tiles, ..look.clone() }, first(leaping, &scene.settings, open));
        frame_ms(leaping, tuning, &Work::of(leaping, tuning, &look), scene, &facts.costs)
    };
    let pays = || ranges_pay(ms(false) - ms(true), scene.field.values.len() as f64, method.frames);
    let asked = match method.tiles {
        Tiles::Auto => method.name.is_auto() && pays(),
        tiles => tiles == Tiles::Live,
    };
    asked && tiles::serve(scene).is_ok()
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

    /// What a method would do on the device.
    fn work_there(&mut self, method: &Method, tuning: Tuning) -> Work {
        let work = self.work(method, tuning);
        if self.facts.of(method).is_none_or(|facts| facts.culls_late.is_none()) {
            return work;
        }
        let all = if method.stack().is_some() { &method::SLICES_3D } else { &method::RC };
        work.with_late_culling(&self.work(all, tuning))
    }

    /// What a method would take.
    fn weigh(&mut self, method: &'static Method, tuning: Tuning) -> Estimate {
        let work = self.work_there(method, tuning);
        let looks_ahead = method.looks_ahead() && self.look.any_is_free;
        let build_ms = if looks_ahead { build_ms(method, tuning, self.scene, &self.facts.costs) } else { 0.0 };
        let frame_ms = frame_ms(method, tuning, &work, self.scene, &self.facts.costs);
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

/// A frame of `scene` by its method that took so many milliseconds, with what it is made of.
///
/// # Errors
/// As [`Look::of`], and when the method is none.
pub fn timed(scene: &Scene, facts: &DeviceFacts, ms: f64) -> Result<TimedFrame> {
    let (look, method) = (Look::of(scene)?, method::of(scene.settings.method.name)?);
    let tuning = Tuning::of(&scene.settings);
    let work = Scales { scene, look: &look, facts, known: Vec::new() }.work_there(method, tuning);
    Ok(TimedFrame { method: method.name.to_owned(), parts: frame_parts(method, tuning, &work, scene), ms })
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
    reasons.push(facts.costs.words());
    let late: Vec<&MethodFacts> = facts.methods.iter().filter(|facts| facts.culls_late.is_some()).collect();
    let of_chosen = late.iter().find(|facts| facts.method == chosen.method);
    let one = of_chosen.or(late.first()).and_then(|facts| Some((facts.method, facts.culls_late.as_ref()?)));
    reasons.extend(one.map(|(method, why)| format!("{method}'s culled fragments are shaded all the same: {why}")));
    reasons
}
