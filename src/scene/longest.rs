//! The longest ray of a view, by branch and bound: a picture of 65535 x 65535 pixels costs some ten thousand rays, not
//! four thousand million.
//!
//! For all pixels of a tile the components of where rays come from, and of their directions, lie between those of its corners, and so
//! do the depths at which rays meet each face of the box and each clip plane; what lies between two of these is bounded as a whole, so
//! that thin slabs are bounded well. A tile whose bound is no longer than a ray already found is left out; the others are cut in four.

use glam::DVec3;

use super::region::Region;
use crate::math::polyhedron::HalfSpace;
use crate::math::ray::{ViewRay, ViewRays, cut_interval};

/// Tiles of at most so many pixels are gone through one by one.
const FEW: u64 = 16;
/// Relative slack of bounds: some dozen roundings of f64, so that none hides a longer ray.
const ROUNDING: f64 = 1e-14;

/// What rays are inside of.
struct Solid<'a> {
    rays: &'a ViewRays,
    half: DVec3,
    planes: &'a [HalfSpace],
}

/// Length of the longest ray through the pixels of `region` inside the box [-half, half] and all half spaces of `planes`, 0
/// where none meets that.
pub fn longest_ray(rays: &ViewRays, half: DVec3, planes: &[HalfSpace], region: Region) -> f64 {
    let solid = Solid { rays, half, planes };
    let mut longest = 0.0;
    let mut tiles = vec![(f64::INFINITY, region)];
    while let Some((bound, tile)) = tiles.pop() {
        if bound <= longest || tile.pixels() == 0 {
            continue;
        }
        if tile.pixels() <= FEW {
            let pixels = tile.rows().flat_map(|row| tile.columns().map(move |column| (column, row)));
            longest = pixels.map(|(column, row)| solid.length(column, row)).fold(longest, f64::max);
            continue;
        }
        let mut quarters = quarters(tile).map(|quarter| (solid.bound_of(quarter), quarter));
        // The most promising one on top.
        quarters.sort_by(|a, b| a.0.total_cmp(&b.0));
        tiles.extend(quarters);
    }
    longest
}

fn quarters(tile: Region) -> [Region; 4] {
    let (left, top) = (tile.width / 2, tile.height / 2);
    let [right, bottom] = [tile.width - left, tile.height - top];
    let part = |x, y, width, height| Region { x: tile.x + x, y: tile.y + y, width, height };
    [part(0, 0, left, top), part(left, 0, right, top), part(0, top, left, bottom), part(left, top, right, bottom)]
}

impl Solid<'_> {
    fn length(&self, column: u32, row: u32) -> f64 {
        let ray = self.rays.of(column, row);
        cut_interval(&ray, self.half, self.rays.near, self.planes)
            .map_or(0.0, |(enter, leave)| (leave - enter) * ray.direction.length())
    }

    /// No ray through a pixel of the tile is longer than this.
    fn bound_of(&self, tile: Region) -> f64 {
        if tile.pixels() == 0 {
            return 0.0;
        }
        let (right, bottom) = (tile.x + tile.width - 1, tile.y + tile.height - 1);
        let corners = [(tile.x, tile.y), (right, tile.y), (tile.x, bottom), (right, bottom)];
        let rays = corners.map(|(column, row)| self.rays.of(column, row));
        // The length of a vector is convex, so it is greatest at a corner.
        let steepest = rays.iter().map(|ray| ray.direction.length()).fold(0.0, f64::max);
        let slack = ROUNDING * steepest;
        let (mut entering, mut leaving) = (Vec::new(), Vec::new());
        for space in faces(self.half).iter().chain(self.planes) {
            let rises = spread(rays.map(|ray| space.normal.dot(ray.direction)), slack * space.normal.length());
            let side = Side { space: *space, heights: spread(rays.map(|ray| space.height(ray.origin)), 0.0), rises };
            match rises {
                [low, _] if low > 0.0 => entering.push(side),
                [_, high] if high < 0.0 => leaving.push(side),
                // Some ray may run along it: it bounds nothing.
                _ => {}
            }
        }
        let enter = entering.iter().map(|side| side.depths()[0]).fold(self.rays.near, f64::max);
        let leave = leaving.iter().map(|side| side.depths()[1]).fold(f64::INFINITY, f64::min);
        let slack = ROUNDING * (enter.abs() + leave.abs());
        let pairs = entering.iter().flat_map(|front| leaving.iter().map(move |back| front.depth_to(back, &rays)));
        pairs.fold((leave - enter) + slack, f64::min).max(0.0) * steepest * (1.0 + ROUNDING)
    }
}

/// The six half spaces of the box [-half, half].
fn faces(half: DVec3) -> [HalfSpace; 6] {
    std::array::from_fn(|face| {
        let (axis, sign) = (face / 2, if face % 2 == 0 { 1.0 } else { -1.0 });
        HalfSpace { normal: sign * DVec3::AXES[axis], distance: -half[axis] }
    })
}

/// A plane that all rays of a tile enter or leave by.
struct Side {
    space: HalfSpace,
    /// The least and the greatest height over it of where rays come from.
    heights: [f64; 2],
    /// The least and the greatest that rays rise by over it in a unit of depth.
    rises: [f64; 2],
}

impl Side {
    /// The least and the greatest depth at which rays meet it.
    fn depths(&self) -> [f64; 2] {
        let [low, high] = self.heights;
        spread(self.rises.into_iter().flat_map(|rise| [-low / rise, -high / rise]), 0.0)
    }

    /// The most depth that any ray has between this plane, by which it enters, and the one by which it leaves: a linear function of
    /// the place in the picture, so that it is greatest at a corner, by the product of both rises. (Either the heights or the rises are
    /// the same for all rays.)
    fn depth_to(&self, back: &Self, rays: &[ViewRay; 4]) -> f64 {
        let numerator = |ray: &ViewRay| {
            let [front_height, back_height] = [self, back].map(|side| side.space.height(ray.origin));
            let product = |height: f64, side: &Self| height * side.space.normal.dot(ray.direction);
            let size = (back_height.abs() + front_height.abs()) * ray.direction.length();
            product(back_height, self) - product(front_height, back) + ROUNDING * size
        };
        let most = rays.iter().map(numerator).fold(f64::NEG_INFINITY, f64::max);
        most.max(0.0) / (self.rises[0] * -back.rises[1])
    }
}

/// The least and the greatest of some numbers, apart by as much more on each side.
fn spread(numbers: impl IntoIterator<Item = f64>, slack: f64) -> [f64; 2] {
    let ends = [f64::INFINITY, f64::NEG_INFINITY];
    let [low, high] = numbers.into_iter().fold(ends, |[low, high], number| [low.min(number), high.max(number)]);
    [low - slack, high + slack]
}
