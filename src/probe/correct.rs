//! Whether a driver does a case right: colour, stored depth, count and stores against the rule, with depths on, just
//! below and just above every edge.

use ash::vk;
use serde::{Deserialize, Serialize};

use super::case::{Case, Compare, History, Mechanism, format_name};
use super::depth::{LEAST_NORMAL, Precision};
use super::rig::{Input, Left, Rig};
use super::rule::{Fragment, Setup, tolerance};
use crate::error::Result;

/// What differs from the rule in one draw.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CaseFault {
    /// `colour`, `depth`, `count`, `storage image` or `storage buffer`.
    pub what: String,
    pub format: String,
    pub history: History,
    /// Depth bounds, or 0 and the bound the shader looks at.
    pub bounds: [f32; 2],
    /// Depth of the fragment as rasterised.
    pub drawn: f32,
    /// Of the first pixel that differs; none where only a sum does.
    pub stored: Option<f32>,
    /// What the shader writes there, where it writes a depth.
    pub written: Option<f32>,
    pub expected: f64,
    pub got: f64,
    /// Pixels that differ, of how many.
    pub pixels: [u32; 2],
}

impl CaseFault {
    /// A line that can be pasted into a bug report.
    pub fn line(&self, case: &Case) -> String {
        let [differing, of] = self.pixels;
        let mut line = format!(
            "{}, {}, {}: {} wrong in {differing} of {of}",
            case.name(),
            self.format,
            self.history.words(),
            self.what
        );
        if case.mechanism.bounds() || case.mechanism.in_shader() {
            line += &format!("; bounds {:?}..{:?}", self.bounds[0], self.bounds[1]);
        }
        line += &format!("; fragment depth {:?}", self.drawn);
        if let Some(written) = self.written {
            line += &format!(", written {written:?}");
        }
        if let Some(stored) = self.stored {
            line += &format!(", stored {stored:?}");
        }
        line + &format!(": expected {}, got {}", self.expected, self.got)
    }
}

/// How thoroughly to ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// Copied depths under one pair of bounds.
    Quick,
    /// Every history, and bounds at the ends of the range and of no width.
    Full,
}

/// The first difference of each kind, in every draw that is asked for; nothing where the driver is right.
///
/// # Errors
/// What the driver reports.
pub fn faults(rig: &mut Rig, case: &Case, depth: Depth) -> Result<Vec<CaseFault>> {
    let mut found: Vec<CaseFault> = Vec::new();
    for setup in setups(case, rig.precision, depth) {
        let histories = if depth == Depth::Full { &History::ALL[..] } else { &[History::Copy][..] };
        for &history in histories {
            // What a stencil holds can be copied and cleared only.
            if history == History::Draw && case.mechanism == Mechanism::Stencil {
                continue;
            }
            for input in inputs(rig, case, setup, history) {
                let left = rig.draw(case, &input)?;
                for fault in differences(rig.format, rig.device().info.occlusion_precise, case, &input, &left) {
                    if !found.iter().any(|f| f.what == fault.what && f.history == history) {
                        found.push(fault);
                    }
                }
            }
        }
    }
    Ok(found)
}

fn setups(case: &Case, precision: Precision, depth: Depth) -> Vec<Setup> {
    let own = case.setup();
    let kept = |setup: Setup| Setup {
        drawn: precision.nearest(setup.drawn),
        bounds: setup.bounds.map(|bound| precision.nearest(bound)),
    };
    let mut setups = vec![kept(own)];
    if depth == Depth::Full {
        if case.mechanism.bounds() {
            let bounds = [[0.0, 0.4], [0.4, 0.4], [0.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
            setups.extend(bounds.map(|bounds| kept(Setup { bounds, ..own })));
        }
        if case.mechanism.compares() {
            let ends = if case.compare == Compare::GreaterOrEqual { [1.0, 0.5] } else { [0.0, 0.5] };
            setups.extend(ends.map(|drawn| kept(Setup { drawn, ..own })));
        }
    }
    setups
}

/// Stored depths on and beside everything they are compared with, the ends of the range and what is hard to keep.
fn edges(case: &Case, precision: Precision, setup: &Setup) -> Vec<f32> {
    let mut edges = vec![0.0, 1.0, LEAST_NORMAL / 4.0, LEAST_NORMAL, case.stored().alive, case.stored().dead];
    let mut compared = setup.bounds.to_vec();
    compared.extend(case.writable(setup.drawn));
    // A whole number either way is open.
    let steps: &[i32] = if precision == Precision::Float { &[-1, 0, 1] } else { &[-2, 0, 2] };
    for depth in compared {
        edges.extend(steps.iter().map(|by| precision.beside(depth, *by)));
    }
    let mut edges: Vec<f32> = edges.into_iter().map(|edge| precision.nearest(edge)).collect();
    edges.sort_by(f32::total_cmp);
    edges.dedup();
    edges
}

/// One draw with all edges side by side; after a clear, one for each.
fn inputs(rig: &Rig, case: &Case, setup: Setup, history: History) -> Vec<Input> {
    let edges = edges(case, rig.precision, &setup);
    let written: Vec<f32> = case.writable(setup.drawn).into_iter().map(|w| rig.precision.nearest(w)).collect();
    let pixels = (rig.side * rig.side) as usize;
    let input = |edges: &[f32]| {
        let of = |i: usize| (i % edges.len(), i / edges.len() % written.len(), i / (edges.len() * written.len()) % 2);
        Input {
            setup,
            stored: (0..pixels).map(|i| edges[of(i).0]).collect(),
            written: (0..pixels).map(|i| written[of(i).1]).collect(),
            stencil: (0..pixels).map(|i| if history == History::Clear { 1 } else { of(i).2 as u8 }).collect(),
            history,
            work: 1,
            draws: 1,
        }
    };
    match history {
        History::Clear => edges.iter().map(|edge| input(&[*edge])).collect(),
        _ => vec![input(&edges)],
    }
}

/// What was left against what the rule says.
pub fn differences(format: vk::Format, precise: bool, case: &Case, input: &Input, left: &Left) -> Vec<CaseFault> {
    let precision = Precision::of(format);
    let fragment =
        |i: usize| Fragment { stored: input.stored[i], written: input.written[i], stencil: input.stencil[i] == 1 };
    let rule = |i: usize| case.expected(precision, &input.setup, &fragment(i));
    let pixels = input.stored.len();
    let writes = case.shader.conservative().is_some();
    let fault = |what: &str, at: Option<usize>, expected: f64, got: f64, differing: usize| CaseFault {
        what: what.to_owned(),
        format: format_name(format).to_owned(),
        history: input.history,
        bounds: input.setup.bounds,
        drawn: input.setup.drawn,
        stored: at.map(|i| input.stored[i]),
        written: at.filter(|_| writes).map(|i| input.written[i]),
        expected,
        got,
        pixels: [differing as u32, pixels as u32],
    };
    let mut found = Vec::new();
    let mut compare = |what: &str, of: &dyn Fn(usize) -> Option<(f64, f64)>| {
        let mut differing = (0..pixels).filter_map(|i| of(i).map(|pair| (i, pair)));
        if let Some((first, (expected, got))) = differing.next() {
            found.push(fault(what, Some(first), expected, got, 1 + differing.count()));
        }
    };
    compare("colour", &|i| {
        let (rule, got) = (rule(i), left.color[i]);
        let expected = f32::from(u8::from(rule.passes));
        (!rule.open && got != expected).then_some((expected.into(), got.into()))
    });
    compare("depth", &|i| {
        let (rule, got) = (rule(i), left.depth[i]);
        let off = got.abs_diff(precision.code(rule.depth));
        // A number that small may be kept as 0.
        let small = rule.depth < LEAST_NORMAL && got == 0;
        let drawn = rule.depth != input.stored[i] || input.history != History::Copy;
        let wrong = off > if drawn { tolerance(precision) } else { 0 };
        (wrong && !small && !rule.open)
            .then_some((precision.decode(precision.code(rule.depth)).into(), precision.decode(got).into()))
    });
    if let Some(touched) = &left.touched {
        compare("storage image", &|i| {
            let (rule, got) = (rule(i), touched[i]);
            let open = rule.open && case.shader.early();
            (!open && got != rule.stores).then_some((u8::from(rule.stores).into(), u8::from(got).into()))
        });
    }
    let count = |of: &dyn Fn(usize) -> (bool, bool)| {
        let all = (0..pixels).map(of);
        all.fold((0u64, 0u64), |(sum, open), (counts, is_open)| {
            (sum + u64::from(counts && !is_open), open + u64::from(is_open))
        })
    };
    let (passing, open) = count(&|i| (rule(i).passes, rule(i).open));
    let right = match precise {
        true => (passing..=passing + open).contains(&left.samples),
        // Anything but 0 where anything passes.
        false => (left.samples > 0) == (passing > 0) || open > 0,
    };
    if !right {
        let differing = left.samples.abs_diff(passing) as usize;
        found.push(fault("count", None, passing as f64, left.samples as f64, differing));
    }
    if let Some(counted) = left.counted {
        let early = case.shader.early();
        let (storing, open) = count(&|i| (rule(i).stores, rule(i).open && early));
        if !(storing..=storing + open).contains(&counted.into()) {
            let differing = u64::from(counted).abs_diff(storing) as usize;
            found.push(fault("storage buffer", None, storing as f64, counted.into(), differing));
        }
    }
    found
}
