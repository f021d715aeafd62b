//! The settings that methods are weighed with.

use crate::part::rows::{Ahead, Method};
use crate::scene::settings::{LeftOpen, Settings};

/// The settings of a method that change what it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tuning {
    /// M, samples of a main pass.
    pub samples_per_pass: u32,
    /// Distances that a ray may look up in a segment.
    pub lookups: u32,
    /// Voxels along a side of a cell of a distance structure.
    pub cell: u32,
    /// Whether blocks are tested before the first main pass too.
    pub first: bool,
}

impl Tuning {
    /// The tuning that settings ask for.
    pub fn of(settings: &Settings) -> Self {
        Self {
            samples_per_pass: settings.sampling.samples_per_pass,
            lookups: settings.method.lookups,
            cell: settings.method.cell,
            first: settings.method.block_first,
        }
    }
}

/// Settings of methods that are weighed where the scene leaves them as they are by default.
const SAMPLES_PER_PASS: [u32; 4] = [8, 16, 32, 64];
/// Of loops that look ahead: samples that a ray takes before it looks again.
const SAMPLES_PER_LOOK: [u32; 3] = [4, 8, 16];
const LOOKUPS: [u32; 2] = [1, 16];
const CELLS: [u32; 3] = [1, 2, 4];

/// The settings that a method is weighed with first.
const FIRST: Tuning = Tuning { samples_per_pass: 32, lookups: 16, cell: 1, first: false };

/// Whether a method has passes that can be forced, and M samples in each.
pub fn takes_passes(method: &Method) -> bool {
    !method.loops() && !method.back_to_front()
}

/// The settings that a method is weighed with first: of each one that may be chosen, that of [`FIRST`].
pub fn first(method: &Method, settings: &Settings, open: LeftOpen) -> Tuning {
    let (asked, all) = (Tuning::of(settings), tunings(method, settings, open));
    let pick =
        |of: fn(&Tuning) -> u32| if all.iter().any(|one| of(one) == of(&FIRST)) { of(&FIRST) } else { of(&asked) };
    Tuning {
        samples_per_pass: pick(|one| one.samples_per_pass),
        lookups: pick(|one| one.lookups),
        cell: pick(|one| one.cell),
        first: asked.first,
    }
}

/// The settings that a method is weighed with. Numbers that were left open vary; where none was, or the method is to be chosen, those do too
/// that the scene has as they are by default.
pub fn tunings(method: &Method, settings: &Settings, open: LeftOpen) -> Vec<Tuning> {
    let (asked, default) = (Tuning::of(settings), Tuning::of(&Settings::default()));
    let others = settings.method.name.is_auto() || !open.any();
    let pick = |changes: bool, asked: u32, default: u32, is_open: bool, all: &[u32]| {
        let varies = changes && (is_open || others && asked == default);
        if varies { all.to_vec() } else { vec![asked] }
    };
    // Where passes are forced, M says how far they go.
    let in_passes = takes_passes(method) && settings.sampling.passes == 0;
    let in_looks = method.loops() && method.looks_ahead();
    let of_method = if in_looks { &SAMPLES_PER_LOOK[..] } else { &SAMPLES_PER_PASS };
    let in_segments = in_passes || in_looks;
    let ms = pick(in_segments, asked.samples_per_pass, default.samples_per_pass, open.samples_per_pass, of_method);
    let lookups = pick(method.marks_sections(), asked.lookups, default.lookups, open.lookups, &LOOKUPS);
    let distances = matches!(method.ahead, Ahead::Distances(_));
    let cells = pick(distances, asked.cell, default.cell, false, &CELLS);
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
