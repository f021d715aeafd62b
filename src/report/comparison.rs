//! Runs of one scene side by side, measured against `rc-block`: the rows that every table shows.

use std::fmt::Write;

use super::limit::Limit;
use super::number::{milliseconds, percent, thousands};
use super::table::{Cell, Column, Table};
use crate::measure::fragment_kind::FragmentKind;
use crate::measure::record::{Clock, CountsRecord, Run, Saved};
use crate::measure::saving;
use crate::measure::timing::Timing;
use crate::scene::settings::{PartialSegments, SamplingSettings};

/// The method the others are measured against: the best the papers had before near-neighbor skipping [KW03 §2.3].
pub const BASELINE: &str = "rc-block";

/// The method whose saving the report states first [Thesis §5.3].
pub const CLAIMED: &str = "nn-omni";

/// Runs that differ in nothing but the method.
#[derive(Clone, Debug)]
pub struct RunGroup<'a> {
    /// Each with its place in the results.
    pub runs: Vec<(usize, &'a Run)>,
}

/// Groups in the order of their first runs.
pub fn groups(runs: &[Run]) -> Vec<RunGroup<'_>> {
    let mut groups: Vec<RunGroup> = Vec::new();
    for (i, run) in runs.iter().enumerate() {
        match groups.iter_mut().find(|g| comparable(g.first(), run)) {
            Some(group) => group.runs.push((i, run)),
            None => groups.push(RunGroup { runs: vec![(i, run)] }),
        }
    }
    groups
}

/// Whether two runs have the same scene, device and settings; the method may be another.
pub fn comparable(a: &Run, b: &Run) -> bool {
    let (s, t) = (&a.settings, &b.settings);
    (&a.scene, &a.view, &a.device, &a.driver) == (&b.scene, &b.view, &b.device, &b.driver)
        && (&s.volume, &s.transfer, &s.camera, &s.image, &s.projection, sampling_asked(a))
            == (&t.volume, &t.transfer, &t.camera, &t.image, &t.projection, sampling_asked(b))
        && (&s.meshes, &s.clips, s.layers.most) == (&t.meshes, &t.clips, t.layers.most)
        && (&s.surface, &s.lights, &s.shading) == (&t.surface, &t.lights, &t.shading)
        && (&s.environment, &s.effects, &a.effect) == (&t.environment, &t.effects, &b.effect)
}

/// Sampling as it was asked for, where `auto` has chosen another M.
fn sampling_asked(run: &Run) -> SamplingSettings {
    let sampling = run.settings.sampling.clone();
    let asked = run.auto.as_ref().map_or(sampling.samples_per_pass, |auto| auto.samples_per_pass);
    SamplingSettings { samples_per_pass: asked, ..sampling }
}

/// The method with the switches that change its counts.
pub fn label(run: &Run) -> String {
    let mut label = run.method.clone();
    if run.is_chosen_freely() {
        label = format!("auto: {label}");
    }
    if run.auto.as_ref().is_some_and(|auto| auto.samples_per_pass != run.settings.sampling.samples_per_pass) {
        let _ = write!(label, " (M = {})", run.settings.sampling.samples_per_pass);
    }
    if run.method == BASELINE && run.settings.method.block_first {
        label.push_str(" (block first)");
    }
    if run.marks_sections() && !run.settings.method.exit_lookahead {
        label.push_str(" (no lookahead)");
    }
    if run.looks_up_distances() && run.settings.method.cell != 1 {
        let _ = write!(label, " (cell {})", run.settings.method.cell);
    }
    if run.marks_sections() && run.settings.method.lookups != 1 {
        let _ = write!(label, " ({} lookups)", run.settings.method.lookups);
    }
    if run.draws_live_tiles() {
        label.push_str(" (live tiles)");
    }
    // Methods that cull nothing draw nothing apart.
    let apart = run.settings.layers.partial == PartialSegments::Apart && run.cull.is_some();
    if apart && !run.fragments.per_layer.is_empty() {
        label.push_str(" (partial segments apart)");
    }
    label
}

/// The same with cull and mark, where the method culls.
pub fn label_with_form(run: &Run) -> String {
    run.form().map_or_else(|| label(run), |form| format!("{}, {form}", label(run)))
}

impl<'a> RunGroup<'a> {
    /// A group has at least one run.
    pub fn first(&self) -> &'a Run {
        self.runs[0].1
    }

    /// What the heading says below the scene's name.
    pub fn subtitle(&self) -> String {
        let run = self.first();
        let (image, sampling) = (&run.settings.image, sampling_asked(run));
        let adaptive = &run.settings.adaptive;
        let steps = match adaptive.importance {
            true => format!("adaptive steps for an error of {}", adaptive.tolerance),
            false => format!("step {}", sampling.step),
        };
        let mut text = format!(
            "{} x {} pixels, {steps}, M = {}, T = {}",
            image.size[0], image.size[1], sampling.samples_per_pass, sampling.termination
        );
        if sampling.extra_fetches > 0 {
            let _ = write!(text, ", {} extra fetches a sample", sampling.extra_fetches);
        }
        if let Some(effect) = &run.effect {
            let _ = write!(text, ", effect {}", effect.words());
        }
        if !run.view.is_empty() {
            text = format!("{}; {text}", run.view);
        }
        text
    }

    /// The `rc-block` run in the papers' order where there is one, else one that tests first.
    pub fn baseline(&self) -> Option<&'a Run> {
        self.pick(BASELINE, |run| !run.settings.method.block_first)
    }

    /// The `nn-omni` run whose saving is claimed, with exit lookahead where there is one.
    pub fn claimed(&self) -> Option<&'a Run> {
        self.pick(CLAIMED, |run| run.settings.method.exit_lookahead)
    }

    fn pick(&self, method: &str, preferred: impl Fn(&Run) -> bool) -> Option<&'a Run> {
        let all = || self.runs.iter().map(|(_, run)| *run).filter(|run| run.method == method);
        all().find(|run| !run.is_chosen_freely() && preferred(run)).or_else(|| all().next())
    }

    /// Lower bounds of the main fragments, each once; more than one where methods differ in what they may skip.
    fn ideals(&self) -> Vec<u64> {
        let mut ideals: Vec<u64> = self.runs.iter().filter_map(|(_, run)| run.ideal).map(|i| i.main).collect();
        ideals.sort_unstable();
        ideals.dedup();
        ideals
    }
}

/// The columns: the two lines of a heading, and whether numbers stand below.
const COLUMNS: [(&str, &str, bool); 15] = [
    ("", "method", false),
    ("", "cull + mark", false),
    ("main", "passes", true),
    ("main", "fragments", true),
    ("% of", BASELINE, true),
    ("intermediate", "fragments", true),
    ("% of", BASELINE, true),
    ("shader", "invocations", true),
    ("GPU", "ms", true),
    ("CPU", "ms", true),
    ("build", "ms", true),
    ("fragments", "saved %", true),
    ("time", "saved %", true),
    ("culling", "efficiency", true),
    ("largest", "error", true),
];

/// Places of times among the columns.
const GPU_TIME: usize = 8;
const CPU_TIME: usize = 9;

/// The comparison of one group.
pub fn table(group: &RunGroup) -> Table {
    let head =
        |(upper, lower, right): (&str, &str, bool)| Column { head: vec![upper.to_owned(), lower.to_owned()], right };
    let mut sheet = Sheet(Table::new(COLUMNS.map(head).to_vec()));
    sheet.fill(group);
    sheet.0
}

/// A comparison that is being written.
struct Sheet(Table);

impl Sheet {
    fn fill(&mut self, group: &RunGroup) {
        let baseline = group.baseline();
        for (_, run) in &group.runs {
            let row = self.row(run, baseline);
            self.0.row(row);
        }
        for ideal in group.ideals() {
            let mut row: [Cell; 15] = std::array::from_fn(|_| Cell::default());
            row[0] = self.noted("ideal", "lower bound: the segments that hold a contributing sample; no method".into());
            row[3] = value(thousands(ideal));
            row[4] = self.share(ideal, baseline.map(|b| b.fragments.main));
            let labelled: Vec<(String, &Run)> = group.runs.iter().map(|(_, run)| (label(run), *run)).collect();
            if let Some(limit) = Limit::of(&labelled, ideal) {
                let column = if limit.clock == Clock::Gpu { GPU_TIME } else { CPU_TIME };
                row[column] = self.noted(&milliseconds(limit.ms), limit.words());
            }
            self.0.row(row);
        }
    }

    fn row(&mut self, run: &Run, baseline: Option<&Run>) -> [Cell; 15] {
        [
            value(label(run)),
            match run.form() {
                Some(forms) => value(forms),
                None => self.absent("this method has no choice of cull and mark"),
            },
            value(thousands(u64::from(run.passes))),
            value(thousands(run.fragments.main)),
            self.part_of(run, baseline, |counts| counts.main),
            value(thousands(run.fragments.intermediate)),
            self.part_of(run, baseline, |counts| counts.intermediate),
            match &run.invocations {
                Some(counts) => value(thousands(counts.main.saturating_add(counts.intermediate))),
                None => self.absent("no count of shader invocations that can be believed on this device"),
            },
            self.time(run.gpu_ms.as_ref().and_then(|t| t.total()), "no device timestamps for this run"),
            self.time(run.host.cpu.as_ref(), "CPU time was not measured"),
            self.time(run.host.build.as_ref(), "this method builds no structure"),
            self.saved(run, |saved| Some(100.0 * saved.fragments?), 1),
            self.saved(run, |saved| Some(100.0 * saved.time?), 1),
            self.saved(run, |saved| saved.efficiency(), 2),
            self.error(run),
        ]
    }

    fn saved(&mut self, run: &Run, of: impl Fn(&Saved) -> Option<f64>, digits: usize) -> Cell {
        if run.method == saving::AGAINST {
            return self.absent("the others are compared with this one");
        }
        let Some(saved) = &run.saved else { return self.absent("no rc-ert run of this scene on the device") };
        match of(saved) {
            Some(number) => {
                let clock = saved.clock.map_or("", Clock::words);
                self.noted(&format!("{number:.digits$}"), format!("against {}; {clock}", saved.against))
            }
            None => {
                let apart = run.fragment_kind().and_then(FragmentKind::apart);
                self.absent(
                    apart.filter(|_| saved.fragments.is_none()).unwrap_or("not timed, or no fragment was saved"),
                )
            }
        }
    }

    /// A run's fragments as a part of the baseline's.
    fn part_of(&mut self, run: &Run, baseline: Option<&Run>, of: fn(&CountsRecord) -> u64) -> Cell {
        match run.fragment_kind().and_then(FragmentKind::apart) {
            Some(apart) => self.absent(apart),
            None => self.share(of(&run.fragments), baseline.map(|baseline| of(&baseline.fragments))),
        }
    }

    fn share(&mut self, part: u64, whole: Option<u64>) -> Cell {
        match whole.map(|whole| percent(part, whole)) {
            Some(Some(percent)) => value(format!("{percent:.1}")),
            Some(None) => self.absent(&format!("{BASELINE} has none to compare with")),
            None => self.absent(&format!("no {BASELINE} run of this scene")),
        }
    }

    fn time(&mut self, timing: Option<&Timing>, why: &str) -> Cell {
        match timing {
            Some(t) => {
                let spread = t.stats.filter(|s| s.n > 1).map(|s| milliseconds(s.mad));
                Cell { spread, ..value(milliseconds(t.value)) }
            }
            None => self.absent(why),
        }
    }

    fn error(&mut self, run: &Run) -> Cell {
        match &run.error {
            None => self.absent("not compared with a reference"),
            Some(error) => {
                let text = if error.max == 0.0 { "0".to_string() } else { format!("{:.1e}", error.max) };
                match error.undecided {
                    0 => value(text),
                    n => {
                        let pixels = if n == 1 { "1 pixel".to_owned() } else { format!("{} pixels", thousands(n)) };
                        let verb = if n == 1 { "is" } else { "are" };
                        let note = "in which f32 cannot decide what a sample meets";
                        self.noted(&text, format!("{pixels} {note} {verb} left out of the maximum"))
                    }
                }
            }
        }
    }

    fn absent(&mut self, why: &str) -> Cell {
        self.noted("-", why.to_string())
    }

    fn noted(&mut self, text: &str, note: String) -> Cell {
        let place = self.0.notes.iter().position(|n| *n == note).unwrap_or_else(|| {
            self.0.notes.push(note);
            self.0.notes.len() - 1
        });
        Cell { note: Some(place), ..value(text.to_string()) }
    }
}

fn value(text: String) -> Cell {
    Cell::from(text)
}
