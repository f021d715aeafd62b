//! What a method does for a scene, estimated from a look at it.

use serde::{Deserialize, Serialize};

use super::look::{Look, LookRay, anything_shows};
use super::tunings::Tuning;
use crate::feature::tiles;
use crate::part::rows::{Ahead, Method, Traversal};
use crate::scene::settings::Distance;
use crate::structure::blocks::BLOCK;

/// What a frame does, in numbers of things that take time. Devices shade neighbours together: what is counted in lanes is that of
/// the ray that has most to do, for each of its neighbours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Work {
    /// Pixels whose rays meet the volume, those of tiles that are left out too.
    #[serde(default)]
    pub met: f64,
    /// Rays that are begun.
    pub pixels: f64,
    /// Main passes.
    pub passes: f64,
    /// Main fragments: rays, segments or samples on slices; and intermediate fragments.
    pub main: f64,
    pub intermediate: f64,
    /// In lanes: main fragments, samples, intermediate fragments, and times that a block or a distance is looked up.
    pub main_lanes: f64,
    pub samples: f64,
    pub intermediate_lanes: f64,
    pub lookups: f64,
    /// Samples that show something.
    pub shown: f64,
}

/// All of a method that [`Work`] follows from, beside its settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WayOfWorking {
    loops: bool,
    slices: bool,
    ends_rays: bool,
    ahead: Ahead,
    /// Whether it leaves out tiles behind which nothing shows, where the scene lets it.
    leaves_out_tiles: bool,
}

impl WayOfWorking {
    pub fn of(method: &Method) -> Self {
        let ahead = match method.ahead {
            // A cone is made for the rays of its view, too.
            Ahead::Distances(Distance::Cone) => Ahead::Distances(Distance::Optimal),
            ahead => ahead,
        };
        Self {
            loops: method.loops(),
            slices: method.stack().is_some(),
            ends_rays: method.ends_rays,
            ahead,
            leaves_out_tiles: tiles::are_left_out_by(method),
        }
    }
}

impl Work {
    /// What `method` would do.
    pub fn of(method: &Method, tuning: Tuning, look: &Look) -> Self {
        let m = f64::from(tuning.samples_per_pass);
        let passes = if method.loops() || method.back_to_front() { 1.0 } else { (f64::from(look.longest) / m).ceil() };
        let in_tiles = look.leaves_out_tiles && tiles::are_left_out_by(method);
        let pixels = if in_tiles { look.live_pixels() } else { look.pixels };
        let mut sum = Self { met: look.pixels, pixels, passes, ..Self::default() };
        for cluster in look.clusters.iter().filter(|cluster| !in_tiles || anything_shows(cluster)) {
            let walks = cluster.iter().map(|ray| Walk { method, tuning, look, ray });
            sum.add(walks.map(|walk| walk.trace()).collect());
        }
        let rays = look.rays().count().max(1) as f64;
        sum.times(look.pixels / rays)
    }

    /// The same where fragments that are culled run all the same, as those of a method that culls none.
    pub fn with_late_culling(self, all: &Self) -> Self {
        let shown = self.shown.max(all.shown);
        Self { main_lanes: self.main_lanes.max(all.main_lanes), samples: self.samples.max(all.samples), shown, ..self }
    }

    /// Adds what a cluster of rays does.
    fn add(&mut self, traces: Vec<Trace>) {
        let rays = traces.len() as f64;
        let passes = traces.iter().map(|trace| trace.passes.len()).max().unwrap_or(0);
        for pass in 0..passes {
            let of_pass = || traces.iter().filter_map(|trace| trace.passes.get(pass));
            let most = |of: fn(&PassOfRay) -> f64| rays * of_pass().map(of).fold(0.0, f64::max);
            self.main += of_pass().map(|one| one.main).sum::<f64>();
            self.intermediate += of_pass().map(|one| one.intermediate).sum::<f64>();
            self.main_lanes += most(|one| one.main);
            self.samples += most(|one| one.samples);
            self.intermediate_lanes += most(|one| one.intermediate);
            self.lookups += most(|one| one.lookups);
        }
        self.shown += traces.iter().map(|trace| trace.shown).sum::<f64>();
    }

    /// Counts of all rays of a view, of those of its clusters.
    fn times(self, factor: f64) -> Self {
        Self {
            met: self.met,
            pixels: self.pixels,
            passes: self.passes,
            main: factor * self.main,
            intermediate: factor * self.intermediate,
            main_lanes: factor * self.main_lanes,
            samples: factor * self.samples,
            intermediate_lanes: factor * self.intermediate_lanes,
            lookups: factor * self.lookups,
            shown: factor * self.shown,
        }
    }
}

/// What a method does on a ray.
#[derive(Clone, Debug, Default)]
struct Trace {
    passes: Vec<PassOfRay>,
    shown: f64,
}

/// What a main pass does on a ray, with the intermediate pass before it; or a round of a loop, which leaps as far as it can and then
/// takes M samples.
#[derive(Clone, Copy, Debug, Default)]
struct PassOfRay {
    main: f64,
    samples: f64,
    intermediate: f64,
    lookups: f64,
}

/// A method on a ray.
struct Walk<'a> {
    method: &'a Method,
    tuning: Tuning,
    look: &'a Look,
    ray: &'a LookRay,
}

impl Walk<'_> {
    fn trace(&self) -> Trace {
        let all = self.ray.samples;
        match self.method.traversal {
            Traversal::FragmentLoop | Traversal::ComputeLoop => self.in_a_loop(),
            Traversal::Slices(_) if self.method.back_to_front() => {
                let pass = PassOfRay { main: f64::from(all), samples: f64::from(all), ..PassOfRay::default() };
                Trace { passes: vec![pass], shown: self.shown(0, self.ray.seen.len()) }
            }
            Traversal::Passes | Traversal::Slices(_) if self.decides() => self.in_passes(),
            // Nobody weighs shells, or cells.
            Traversal::Passes | Traversal::Slices(_) | Traversal::Shells | Traversal::Cells(_) => self.in_all_passes(),
        }
    }

    /// Whether anything is looked up: planners leave out what tells nothing.
    fn looks_ahead(&self) -> bool {
        self.method.looks_ahead() && self.look.any_is_free
    }

    /// Whether there are intermediate passes.
    fn decides(&self) -> bool {
        self.looks_ahead() || self.method.ends_rays && self.look.may_end
    }

    fn shown(&self, from: usize, to: usize) -> f64 {
        let seen = &self.ray.seen;
        let (from, to) = (from.min(seen.len()), to.min(seen.len()));
        seen[from..to].iter().filter(|seen| seen.shows).count() as f64
    }

    /// One loop for all samples, which leaps over those that are free: all rays that are shaded together, and then all sample.
    fn in_a_loop(&self) -> Trace {
        let mut trace = Trace::default();
        let looks_ahead = self.looks_ahead();
        let end = self.ray.seen.len();
        let mut i = 0;
        while i < end || trace.passes.is_empty() {
            let mut round = PassOfRay { main: f64::from(u8::from(trace.passes.is_empty())), ..PassOfRay::default() };
            while looks_ahead && i < end {
                round.lookups += 1.0;
                match self.free_from(i) {
                    0 => break,
                    free => i += free,
                }
            }
            let from = i.min(end);
            i = if looks_ahead { (from + self.tuning.samples_per_pass as usize).min(end) } else { end };
            round.samples = (i - from) as f64;
            trace.shown += self.shown(from, i);
            trace.passes.push(round);
        }
        trace
    }

    fn segments(&self, samples: usize) -> usize {
        samples.div_ceil(self.tuning.samples_per_pass as usize)
    }

    /// Segments, or samples on some slices, of which none is left out: fragments run behind the end of their rays too.
    fn in_all_passes(&self) -> Trace {
        let passes = 0..self.segments(self.look.longest as usize);
        Trace { passes: passes.map(|pass| self.run(pass)).collect(), shown: self.shown(0, self.ray.seen.len()) }
    }

    /// Segments, or samples on some slices, with an intermediate pass before each that decides about it.
    fn in_passes(&self) -> Trace {
        let m = self.tuning.samples_per_pass as usize;
        let marks = self.method.marks_sections();
        let mut passes = vec![PassOfRay::default(); self.segments(self.look.longest as usize)];
        // Blocks are looked up for each segment alone, also of rays that have ended.
        passes.iter_mut().skip(1).filter(|_| !marks).for_each(|pass| pass.intermediate = 1.0);
        let mut shown = 0.0;
        let (mut pass, end) = (0, self.segments(self.ray.seen.len()).min(passes.len()));
        while pass < end {
            let mut lookups = 0.0;
            // In the papers' order the first segment runs before anything is decided.
            let decided = marks || pass > 0 || self.tuning.first;
            let free = if decided { self.free_segment(pass * m, &mut lookups) } else { 0 };
            let intermediate = if marks { 1.0 } else { passes[pass].intermediate };
            let run = if free < m { self.run(pass) } else { PassOfRay::default() };
            shown += if free < m { self.shown(pass * m, pass * m + m) } else { 0.0 };
            passes[pass] = PassOfRay { intermediate, lookups, ..run };
            pass += if marks { (free / m).max(1) } else { 1 };
        }
        Trace { passes, shown }
    }

    /// A segment that is drawn.
    fn run(&self, pass: usize) -> PassOfRay {
        let m = self.tuning.samples_per_pass as usize;
        let samples = (self.ray.samples as usize).saturating_sub(pass * m).min(m) as f64;
        let slices = matches!(self.method.traversal, Traversal::Slices(_));
        PassOfRay { main: if slices { samples } else { 1.0 }, samples, ..PassOfRay::default() }
    }

    /// Samples that are free from the begin of a segment on, by as many look-ups as there may be.
    fn free_segment(&self, begin: usize, lookups: &mut f64) -> usize {
        let m = self.tuning.samples_per_pass as usize;
        match self.method.ahead {
            _ if !self.looks_ahead() => 0,
            Ahead::Nothing => 0,
            Ahead::Blocks => {
                *lookups += 1.0;
                let seen = &self.ray.seen;
                let [from, to] = [begin, begin + m].map(|i| seen[i.min(seen.len() - 1)].voxel);
                if self.look.coarse.blocks_are_open(from, to) || self.shown(begin, begin + m) > 0.0 { 0 } else { m }
            }
            Ahead::Distances(_) => {
                let mut free = 0;
                for _ in 0..self.tuning.lookups {
                    *lookups += 1.0;
                    let more = self.free_from(begin + free);
                    free += more;
                    if more == 0 || free >= m {
                        break;
                    }
                }
                free
            }
        }
    }

    /// Samples from one on that the method knows to be free of what shows.
    fn free_from(&self, i: usize) -> usize {
        if i >= self.ray.seen.len() {
            return self.look.longest as usize;
        }
        match self.method.ahead {
            Ahead::Nothing => 0,
            Ahead::Blocks => self.free_of_blocks(i),
            Ahead::Distances(distance) => self.free_of_distances(i, distance),
        }
    }

    /// To the end of an empty block.
    fn free_of_blocks(&self, i: usize) -> usize {
        let open = |voxel| self.look.coarse.blocks_are_open(voxel, voxel);
        let voxel = self.ray.seen[i].voxel;
        let block = |voxel: [u16; 3]| voxel.map(|n| usize::from(n) / BLOCK);
        match open(voxel) {
            true => 0,
            false => self.ray.seen[i..].iter().take_while(|seen| block(seen.voxel) == block(voxel)).count(),
        }
    }

    fn free_of_distances(&self, i: usize, distance: Distance) -> usize {
        let (seen, cell) = (self.ray.seen[i], f64::from(self.tuning.cell));
        let cells = match distance {
            Distance::Omni => self.look.coarse.distance(seen.cell, None),
            Distance::Directional => self.look.coarse.distance(seen.cell, Some(self.ray.octant)),
            Distance::Optimal | Distance::Cone => return self.free_along(i),
        };
        let voxels = match (cells, seen.shows) {
            (_, true) => return 0,
            // Something shows near by, of which the grid does not say where.
            (0, false) => (0.5 * self.look.coarse.side as f64).min(NEAR_BY) - OF_CELL * (cell - 1.0),
            (cells, false) => (f64::from(cells) - 0.5) * self.look.coarse.side as f64 - OF_CELL * (cell - 1.0),
        };
        (voxels / self.ray.step).max(0.0) as usize
    }

    /// To the next sample on the ray that shows something.
    fn free_along(&self, i: usize) -> usize {
        self.ray.seen[i..].iter().take_while(|seen| !seen.shows).count()
    }
}

/// The part of a cell by which distances between cells are shorter than those between places, of each voxel that it is longer.
const OF_CELL: f64 = 0.75;

/// Voxels to what shows from within a cell in which something shows elsewhere, at the most about.
const NEAR_BY: f64 = 2.0;
