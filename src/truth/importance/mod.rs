//! The importance volume of adaptive sampling: how long a step may be from each cell on (Weiler03 "Adaptive Sampling").
//!
//! A step takes the field for linear between its two ends and integrates that exactly, whatever the transfer function does between
//! the two values ([`Absorber::ramp`]). What is left of its error comes from the field's second derivatives (`bend.rs`), as far as the
//! transfer function tells values there apart (`response.rs`): an estimate of the error of each length of step against the exact
//! integral.
//!
//! **How much error a step may have.** As few steps as an error of the whole allows all have errors alike. None errs by more than E, and a
//! ray no longer than D takes no more than D / shortest of them: with E = tolerance shortest / D no ray is farther off than the tolerance,
//! even where all its steps err to one side and nothing hides what is behind. They do not: the importance volume is made for a multiple of
//! that, a power of the root of two, the greatest found in at most ten tries for which none of [`RAYS`] rays in all directions through what
//! shows is off from the exact integral by more than half the tolerance (`look.rs`).
//!
//! **Steps that reach into other cells.** A step of a length is allowed from a cell on where what the field bends by, the most among all
//! cells that the step may touch (`reach.rs`), is no more than any of them allows. What is evenly filled allows any length; so does what
//! is empty, where a step is crossed without a look at the field: there is nothing else to leap with.
//!
//! Departure: Weiler03 names the second derivative and the transfer function, and leaves open how lengths follow from them.

mod bend;
mod code;
mod look;
mod reach;
mod response;

use glam::DVec3;
use rayon::prelude::*;

use self::bend::bends;
use self::code::Code;
use self::look::Look;
use self::reach::{any_within, least_within, most_within};
use self::response::Response;
use super::exact::Absorber;
use crate::math::interpolate::trilinear;
use crate::math::opacity::composite;
use crate::scene::Scene;
use crate::scene::settings::AdaptiveSettings;

pub use look::{LookRay, RAYS};

/// How long steps may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Importance {
    /// Cells along x, y and z.
    pub cells: [usize; 3],
    /// How often the shortest step is doubled from each cell on, and [`NOTHING_SHOWS`]; x fastest.
    pub steps: Vec<u8>,
    /// The most that any ray of the look is off from the exact integral in a channel.
    pub error: f64,
}

/// The bit that is set where nothing shows all along the step, in any direction.
pub const NOTHING_SHOWS: u8 = 0x80;

/// Bounds that are tried at the most: a try makes the whole volume anew, and the step to the next bound is taken from its error.
const TRIES: usize = 10;

/// The first bound tried is this power of the root of two times the one of the worst case: that of real volumes was 2^9 to 2^14 times it.
const FIRST: i32 = 24;

/// The least power of the root of two, with which steps are the shortest wherever the worst case may be met, and the greatest, with which
/// they are the longest.
const POWERS: [i32; 2] = [-8, 48];

/// The part of the tolerance that rays of the look keep to: pictures have more rays.
const KEPT: f64 = 0.5;

impl Importance {
    /// That of a scene; none of one that asks for none.
    pub fn of(scene: &Scene) -> Option<Self> {
        let settings = &scene.settings.adaptive;
        let asked = settings.importance && scene.tetrahedra.is_none();
        asked.then(|| {
            let (parts, look) = Parts::of(scene);
            let reaches = parts.reaches(scene);
            let (mut power, [mut low, mut high]) = (FIRST, POWERS);
            let mut best: Option<Self> = None;
            for _ in 0..TRIES {
                let made = parts.made(scene, power, &reaches, &look);
                // Errors grow about as their bound does; without any there is nothing to keep to.
                let ratio = 2.0 * (KEPT * settings.tolerance / made.error).log2();
                let by = if ratio.is_finite() { ratio.floor().clamp(-64.0, 64.0) as i32 } else { 64 };
                if by >= 0 {
                    (low, best) = (power, Some(made));
                } else {
                    high = power - 1;
                }
                if by == 0 || low >= high {
                    break;
                }
                power = (power + by).clamp(low + 1, high);
            }
            best.unwrap_or_else(|| parts.made(scene, POWERS[0], &reaches, &look))
        })
    }

    /// What is known of the step from a cell on.
    pub fn at(&self, [x, y, z]: [usize; 3]) -> u8 {
        self.steps[(z * self.cells[1] + y) * self.cells[0] + x]
    }
}

/// The steps of a ray, one after the other.
pub struct Strides {
    /// How often the shortest step is doubled before it is longer than a voxel of the finest spacing.
    voxel: u8,
    stride: u32,
    left_over: u32,
}

impl Strides {
    pub fn new(settings: &AdaptiveSettings) -> Self {
        Self { voxel: settings.voxel_doublings(), stride: 1, left_over: 0 }
    }

    /// The next step in steps of the shortest length, and whether anything may show on it, by what is `known` where it begins. A step
    /// shorter than a voxel is allowed where all of a voxel around is, so that it holds for as many as make one.
    pub fn next(&mut self, known: impl FnOnce() -> u8) -> (u32, bool) {
        let mut shows = true;
        if self.left_over == 0 {
            let known = known();
            let doublings = known & !NOTHING_SHOWS;
            (self.stride, shows) = (1 << doublings, known < NOTHING_SHOWS);
            self.left_over = if shows { 1 << (self.voxel - doublings.min(self.voxel)) } else { 1 };
        }
        self.left_over -= 1;
        (self.stride, shows)
    }
}

/// Bytes that making the importance volume of a scene takes for each cell, besides one for each length of step: ranges, and what they
/// become.
const BYTES_OF_CELL: u64 = 17;

/// Bytes of memory that making the importance volume of a scene takes.
pub fn host_bytes(scene: &Scene) -> u64 {
    let cells: u64 = scene.field.cells().iter().map(|n| *n as u64).product();
    cells * (BYTES_OF_CELL + u64::from(scene.settings.adaptive.doublings()))
}

/// What lengths of steps follow from, whatever error they may have.
struct Parts {
    response: Response,
    /// The least and the greatest x of each cell, as the response has them.
    coded: Vec<[u8; 2]>,
    /// How much the field bends in each cell.
    bends: Vec<Code>,
    /// Whether anything shows in each cell.
    shows: Vec<u8>,
    /// Sides of a cell in voxels of the finest spacing.
    sides: [f64; 3],
    /// Cells along x, y and z.
    cells: [usize; 3],
    /// The longest ray, in voxels of the finest spacing.
    longest: f64,
}

/// A length of step, with what is within its reach from each cell on.
struct Reach {
    doublings: u8,
    /// Voxels of the finest spacing.
    step: f64,
    cells: [usize; 3],
    /// How much the field bends at the most; [`Code::NONE`] where nothing shows.
    bends: Vec<Code>,
}

impl Parts {
    /// Those of a scene, with a look at it.
    fn of(scene: &Scene) -> (Self, Look<'_>) {
        let field = &scene.field;
        let (ranges, bends) = bends(field);
        let response = Response::of(scene);
        let look = Look::new(scene, &response, &ranges);
        let slack = scene.value_slack();
        let shows = |[low, high]: &[f32; 2]| {
            u8::from(scene.transfer.visible(f64::from(*low) - slack, f64::from(*high) + slack))
        };
        let parts = Self {
            coded: ranges.par_iter().map(|range| response.coded(*range)).collect(),
            shows: ranges.par_iter().map(shows).collect(),
            response,
            bends,
            sides: (field.voxel() / field.finest()).to_array(),
            cells: field.cells(),
            longest: field.extent().length() / field.finest(),
        };
        (parts, look)
    }

    /// Every length of step, from the shortest on.
    fn reaches(&self, scene: &Scene) -> Vec<Reach> {
        let settings = &scene.settings.adaptive;
        let of = |doublings: u8| {
            let step = settings.shortest * 2f64.powi(doublings.into());
            let cells = self.sides.map(|side| (step / side).ceil() as usize);
            let mut bends = most_within(&self.bends, self.cells, cells);
            let shows = any_within(&self.shows, self.cells, cells);
            bends.par_iter_mut().zip(shows).filter(|(_, shows)| *shows == 0).for_each(|(bend, _)| *bend = Code::NONE);
            Reach { doublings, step, cells, bends }
        };
        (0..=settings.doublings()).map(of).collect()
    }

    /// The volume for the bound of the worst case times a power of the root of two, with the look at it.
    fn made(&self, scene: &Scene, power: i32, reaches: &[Reach], look: &Look) -> Importance {
        let settings = &scene.settings.adaptive;
        let bound = 2f64.powf(0.5 * f64::from(power)) * settings.tolerance * settings.shortest / self.longest;
        // The shortest one is allowed whatever it crosses.
        let mut steps = vec![0; self.coded.len()];
        for reach in reaches {
            let greatest = self.response.greatest(bound / reach.step);
            let allowed: Vec<Code> = self.coded.par_iter().map(|range| greatest.of(*range)).collect();
            let allowed = least_within(&allowed, self.cells, reach.cells);
            // A step of a length takes what bends by b for linear, and is off by b / 8 times its square in the middle.
            let square = Code::up(reach.step * reach.step / 8.0);
            steps.par_iter_mut().zip(&reach.bends).zip(&allowed).for_each(|((longest, bend), allowed)| {
                let doublings = reach.doublings;
                // One that is not allowed is none of which half is.
                if doublings > 0 && (*longest & !NOTHING_SHOWS) + 1 != doublings {
                    return;
                }
                if *bend == Code::NONE {
                    *longest = doublings | NOTHING_SHOWS;
                } else if doublings > 0 && bend.times(square) <= *allowed {
                    *longest = doublings;
                }
            });
        }
        let mut made = Importance { cells: self.cells, steps, error: 0.0 };
        made.error = look.most(|ray| march(scene, &made, &look.medium, ray));
        made
    }
}

/// Premultiplied colour and opacity of a ray by adaptive steps.
fn march(scene: &Scene, importance: &Importance, medium: &Absorber, ray: &LookRay) -> [f64; 4] {
    let field = &scene.field;
    let unit = scene.settings.step() * field.finest();
    let lengths = scene.settings.step() / scene.transfer.reference;
    let steps = ray.length / unit;
    let middle = 0.5 * DVec3::from_array(field.dims().map(|n| n as f64));
    let voxel = |at: f64| (ray.entry + at * unit * ray.direction) / field.voxel() + middle;
    let value = |at: f64| trilinear(&field.values, field.dims(), voxel(at));
    let mut light = [0.0; 4];
    let (mut at, mut front) = (0.0, None);
    let mut strides = Strides::new(&scene.settings.adaptive);
    while at < steps {
        let (step, shows) = strides.next(|| importance.at(field.cell_at(voxel(at))));
        let to = (at + f64::from(step)).min(steps);
        let known = front.filter(|_| shows);
        front = shows.then(|| value(to));
        if let Some(back) = front {
            let from = known.unwrap_or_else(|| value(at));
            light = composite(light, medium.ramp(from, back, (to - at) * lengths));
        }
        at = to;
    }
    light
}
