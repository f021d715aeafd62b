//! An orbit in a few numbers.

use crate::measure::Statistics;
use crate::measure::record::{ChangeRecord, OrbitFrame};
use crate::report::number::{milliseconds, thousands};

/// An orbit in a few numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    pub frames: usize,
    /// Frames by the structure they read, in the order of their first use.
    pub structures: Vec<(String, usize)>,
    /// Lowest and highest age of structures that were made for a view.
    pub ages: Option<[i64; 2]>,
    /// Medians of a frame.
    pub main: u64,
    pub intermediate: u64,
    pub frame: Statistics,
    pub cpu: Statistics,
    pub build: Statistics,
    /// What neighbouring pictures differ by where the stack of slices changes between them, and elsewhere; none where nothing does.
    pub popping: Option<Popping>,
}

/// The greatest changes between neighbouring pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Popping {
    /// Of pictures of different stacks, and how many pairs of those there are.
    pub at_stacks: ChangeRecord,
    pub stacks: usize,
    /// Of all others.
    pub elsewhere: ChangeRecord,
}

impl Popping {
    /// None where no stack changes, or everything does.
    fn of(frames: &[OrbitFrame]) -> Option<Self> {
        let changes = |stacks: bool| {
            let pairs = frames.windows(2).filter(move |pair| changes_stack(pair) == stacks);
            pairs.filter_map(|pair| pair[1].change)
        };
        let greatest = |stacks: bool| {
            changes(stacks).reduce(|a, b| ChangeRecord { largest: a.largest.max(b.largest), rms: a.rms.max(b.rms) })
        };
        Some(Self { at_stacks: greatest(true)?, stacks: changes(true).count(), elsewhere: greatest(false)? })
    }

    fn words(&self) -> String {
        let Self { at_stacks: at, stacks, elsewhere } = self;
        format!(
            "popping: where the stack changes ({stacks} times) neighbouring pictures differ by up to {:.4} (rms {:.5}), elsewhere by up \
             to {:.4} (rms {:.5})",
            at.largest, at.rms, elsewhere.largest, elsewhere.rms
        )
    }
}

/// Whether two neighbouring frames take their slices from different stacks.
fn changes_stack(pair: &[OrbitFrame]) -> bool {
    pair[0].stack != pair[1].stack
}

impl Summary {
    /// None where there are no frames.
    pub fn of(frames: &[OrbitFrame]) -> Option<Self> {
        let mut structures: Vec<(String, usize)> = Vec::new();
        for name in frames.iter().filter_map(|frame| frame.structure.as_ref()) {
            match structures.iter_mut().find(|(known, _)| known == name) {
                Some((_, count)) => *count += 1,
                None => structures.push((name.clone(), 1)),
            }
        }
        let ages = frames.iter().filter_map(|frame| frame.age);
        let times = |get: fn(&OrbitFrame) -> f64| Statistics::of(&frames.iter().map(get).collect::<Vec<_>>());
        let median = |get: fn(&OrbitFrame) -> u64| {
            let mut counts: Vec<u64> = frames.iter().map(get).collect();
            counts.sort_unstable();
            counts.get(counts.len() / 2).copied()
        };
        Some(Self {
            frames: frames.len(),
            structures,
            ages: ages.clone().min().zip(ages.max()).map(|(low, high)| [low, high]),
            main: median(|frame| frame.main)?,
            intermediate: median(|frame| frame.intermediate)?,
            frame: times(|frame| frame.frame_ms)?,
            cpu: times(|frame| frame.cpu_ms)?,
            build: times(|frame| frame.build_ms)?,
            popping: Popping::of(frames),
        })
    }

    /// In a line.
    pub fn words(&self) -> String {
        let read: Vec<String> = self.structures.iter().map(|(name, count)| format!("{count} by {name}")).collect();
        let read = if read.is_empty() {
            format!("{} frames", self.frames)
        } else {
            format!("{} frames, {}", self.frames, read.join(", "))
        };
        let ages = self.ages.map(|[low, high]| format!(" (made {low} to {high} frames before)")).unwrap_or_default();
        let popping = self.popping.iter().map(|popping| format!("; {}", popping.words())).collect::<String>();
        format!(
            "{read}{ages}; main {}, intermediate {}; frame {} ms, CPU {} ms, slices of builds between frames {} ms{popping}",
            thousands(self.main),
            thousands(self.intermediate),
            milliseconds(self.frame.median),
            milliseconds(self.cpu.median),
            milliseconds(self.build.median),
        )
    }
}
