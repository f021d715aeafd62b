//! Tiles of pixels whose rays may come to something that shows: all others need no fragment.

use std::ops::Range;

use glam::DVec3;

use super::along_rays::AlongRays;
use super::region::Region;
use super::tile_set::{SIDE, TileSet};
use crate::math::ray::ViewRays;

/// Pixels that a box counts as larger on each side: rays are rounded where single precision has them.
const MARGIN: f64 = 1.0;

/// Groups of main passes that are told from each other, at the most: what tiles take does not grow with passes beyond.
const GROUPS: u32 = 128;

/// Main passes that draw tiles.
pub struct InPasses {
    pub along: AlongRays,
    /// Steps from sample to sample, volume units.
    pub step: f64,
    /// M, samples of a main pass.
    pub samples: u32,
    /// N, main passes.
    pub passes: u32,
    /// A draw takes as long as so many pixels: live tiles are those of few rectangles.
    pub draw: u64,
}

impl InPasses {
    /// Main passes of the samples that may lie within a box, given by two corners in volume space.
    fn of_box(&self, of: [DVec3; 2]) -> Range<u32> {
        let [first, last] = self.along.lengths(of).map(|length| length / self.step);
        // A sample may stand for what is behind it, up to a step, and its place may be half a step behind its number. One more on
        // either side is for rounding. The casts saturate.
        let [first, last] = [first - 2.5, last + 1.0].map(|sample| sample as u32 / self.samples);
        first.min(self.passes)..last.saturating_add(1).min(self.passes)
    }

    /// Main passes that are not told from each other.
    fn in_group(&self) -> u32 {
        self.passes.div_ceil(GROUPS).max(1)
    }
}

/// The live tiles of a view.
#[derive(Clone, Debug, PartialEq)]
pub struct Tiles {
    region: Region,
    /// Those in which anything may show.
    tiles: TileSet,
    live: Vec<Region>,
    /// The rectangles of groups of main passes.
    groups: Vec<OfPasses>,
    /// Main passes of a group.
    in_group: u32,
}

/// Rectangles of live tiles, each pixel once, from the first pixel of the region.
#[derive(Clone, Debug, PartialEq)]
struct OfPasses {
    /// In these passes.
    here: Vec<Region>,
    /// In these or later ones.
    from: Vec<Region>,
}

impl Tiles {
    /// The tiles of a region that any of the boxes may be seen in, which are given by two corners in volume space; in each main pass those
    /// of its samples, where there are passes.
    pub fn around(
        rays: &ViewRays,
        region: Region,
        boxes: impl Iterator<Item = [DVec3; 2]>,
        passes: Option<&InPasses>,
    ) -> Self {
        let mut tiles = TileSet::none(region.size());
        let in_group = passes.map_or(1, InPasses::in_group);
        let count = passes.map_or(0, |of| of.passes.div_ceil(in_group));
        let mut groups = vec![tiles.clone(); count as usize];
        for of in boxes {
            let of_passes = passes.map(|passes| passes.of_box(of));
            if of_passes.as_ref().is_some_and(Range::is_empty) {
                // Behind all samples, or before them.
                continue;
            }
            let seen = seen(rays, region, of);
            tiles.add(&seen);
            let of_passes = of_passes.unwrap_or_default();
            let of_box = of_passes.start / in_group..of_passes.end.div_ceil(in_group);
            of_box.for_each(|group| groups[group as usize].add(&seen));
        }
        let mut rest = TileSet::none(region.size());
        let mut list = Vec::with_capacity(groups.len());
        for mut here in groups.into_iter().rev() {
            passes.iter().for_each(|passes| here.fill_bands(passes.draw));
            rest.join(&here);
            // Of others no ray goes on.
            list.push(OfPasses { here: here.rectangles(), from: rest.rectangles() });
        }
        list.reverse();
        // Rays of all that passes draw are begun.
        tiles.join(&rest);
        passes.iter().for_each(|passes| tiles.fill_bands(passes.draw));
        Self { region, live: tiles.rectangles(), tiles, groups: list, in_group }
    }

    /// Rectangles that cover live tiles, each pixel once, from the first pixel of the region.
    pub fn live(&self) -> &[Region] {
        &self.live
    }

    /// The same of tiles that are live in a main pass; of a loop, which has no passes, all.
    pub fn live_in(&self, pass: u32) -> &[Region] {
        self.of_group(pass).map_or(self.live(), |of| &of.here)
    }

    /// The same of tiles that are live in a main pass or in a later one.
    pub fn live_from(&self, pass: u32) -> &[Region] {
        self.of_group(pass).map_or(self.live(), |of| &of.from)
    }

    fn of_group(&self, pass: u32) -> Option<&OfPasses> {
        self.groups.get((pass / self.in_group) as usize)
    }

    /// Whether the tile of a pixel, column and row of the picture, is live.
    pub fn contains(&self, [column, row]: [u32; 2]) -> bool {
        self.region.contains([column, row]) && self.tiles.contains([column - self.region.x, row - self.region.y])
    }
}

/// Columns and rows of tiles of a region that a box may be seen in.
fn seen(rays: &ViewRays, region: Region, [least, greatest]: [DVec3; 2]) -> [Range<usize>; 2] {
    let pixels = rays.to_picture();
    let corner = |i: usize| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { least[axis] } else { greatest[axis] };
        pixels * (DVec3::new(pick(0), pick(1), pick(2)) - rays.origin)
    };
    let placed: [DVec3; 8] = std::array::from_fn(corner);
    if !rays.parallel() && placed.iter().any(|place| place.z < rays.near) {
        // Some of it is beside the eye or behind it, and may show anywhere.
        return [0..usize::MAX, 0..usize::MAX];
    }
    let places = placed.map(|of| if rays.parallel() { [of.x, of.y] } else { [of.x / of.z, of.y / of.z] });
    [(0, region.x), (1, region.y)].map(|(axis, origin)| {
        let tile = |pixel: f64| (pixel - f64::from(origin)) / f64::from(SIDE);
        let low = places.iter().map(|place| place[axis]).fold(f64::INFINITY, f64::min);
        let high = places.iter().map(|place| place[axis]).fold(f64::NEG_INFINITY, f64::max);
        // The casts saturate.
        tile(low - MARGIN).floor() as usize..tile(high + MARGIN).ceil() as usize
    })
}
