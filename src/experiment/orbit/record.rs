//! An orbit in a few numbers.

use crate::measure::Statistics;
use crate::measure::record::OrbitFrame;
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
        format!(
            "{read}{ages}; main {}, intermediate {}; frame {} ms, CPU {} ms, slices of builds between frames {} ms",
            thousands(self.main),
            thousands(self.intermediate),
            milliseconds(self.frame.median),
            milliseconds(self.cpu.median),
            milliseconds(self.build.median),
        )
    }
}
