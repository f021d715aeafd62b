//! What a ray sees of its crossings: the surfaces that cut it, and which of its parts are drawn.

use rayon::prelude::*;

use super::clip::{MOST_CLIPS, Windings};
use super::crossings::Crossing;
use super::polygons::Polygons;
use crate::math::ray::{ViewRay, ViewRays};

/// A surface that cuts a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    pub crossing: Crossing,
    /// Whether clip geometry keeps the volume behind the surface.
    pub kept: bool,
}

/// The surfaces that cut a ray, from the eye on.
#[derive(Clone, Debug, PartialEq)]
pub struct Cuts {
    /// Where the volume begins, where clip geometry cuts all that is in front of its first surface.
    pub begin: Option<Crossing>,
    /// Whether clip geometry keeps the volume in front of all surfaces, from `begin` on where there is one.
    pub kept: bool,
    /// Transparent surfaces, and those of clip geometry, in front of the opaque one.
    pub surfaces: Vec<Cut>,
    /// The nearest opaque surface.
    pub opaque: Option<Crossing>,
}

/// A surface as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShownSurface {
    /// Depth in front of the eye, the ray's own parameter.
    pub depth: f64,
    /// Lit, premultiplied RGBA; nothing of clip geometry.
    pub color: [f64; 4],
    /// Whether the volume behind the surface is drawn.
    pub kept: bool,
}

/// A ray as its surfaces divide it.
#[derive(Clone, Debug, PartialEq)]
pub struct DividedRay {
    /// Depth at which the volume begins, where clip geometry says so.
    pub begin: Option<f64>,
    /// Whether the volume is drawn in front of all surfaces.
    pub kept: bool,
    /// From the eye on; the opaque one, behind which nothing is drawn, comes last.
    pub surfaces: Vec<ShownSurface>,
}

impl Polygons {
    /// What a ray sees of its sorted crossings.
    pub fn cuts(&self, crossings: &[Crossing]) -> Cuts {
        if self.cuts_in_front() { self.cuts_behind_first(crossings) } else { self.cuts_by_windings(crossings) }
    }

    /// Clip geometry hides all that is in front of its first surface, polygons too; a ray without one keeps these and loses the
    /// volume [Thesis ch. 6 §3].
    fn cuts_behind_first(&self, crossings: &[Crossing]) -> Cuts {
        let is_clip = |one: &Crossing| self.material(one.triangle).clip.is_some();
        let first = crossings.iter().position(is_clip);
        let rest = crossings[first.map_or(0, |at| at + 1)..].iter().copied().filter(|one| !is_clip(one));
        let (shown, opaque) = self.up_to_opaque(rest);
        let kept = first.is_some();
        let surfaces = shown.into_iter().map(|crossing| Cut { crossing, kept }).collect();
        Cuts { begin: first.map(|at| crossings[at]), kept, surfaces, opaque }
    }

    /// Clip geometry keeps what is inside of its meshes, or outside.
    fn cuts_by_windings(&self, crossings: &[Crossing]) -> Cuts {
        let mut windings = Windings::of_begin(self.entered(crossings));
        let kept = windings.kept_by(self.clips());
        let (shown, opaque) = self.up_to_opaque(crossings.iter().copied());
        let cut = |crossing: Crossing| {
            if let Some(mesh) = self.material(crossing.triangle).clip {
                windings = windings.behind(mesh, crossing.front);
            }
            Cut { crossing, kept: windings.kept_by(self.clips()) }
        };
        Cuts { begin: None, kept, surfaces: shown.into_iter().map(cut).collect(), opaque }
    }

    /// How often more a ray enters each clip mesh than it leaves it: fronts less backs.
    pub fn entered(&self, crossings: &[Crossing]) -> [i32; MOST_CLIPS] {
        let mut entered = [0; MOST_CLIPS];
        for one in crossings {
            if let Some(mesh) = self.material(one.triangle).clip {
                entered[usize::from(mesh)] += if one.front { 1 } else { -1 };
            }
        }
        entered
    }

    /// The crossings in front of the first opaque one, and that one.
    fn up_to_opaque(&self, crossings: impl Iterator<Item = Crossing>) -> (Vec<Crossing>, Option<Crossing>) {
        let mut shown = Vec::new();
        for one in crossings {
            if self.material(one.triangle).is_opaque() {
                return (shown, Some(one));
            }
            shown.push(one);
        }
        (shown, None)
    }

    /// The ray of a pixel with up to `most` surfaces and the opaque one that ends it.
    pub fn divided(&self, rays: &ViewRays, pixel: [u32; 2], most: u32) -> DividedRay {
        let cuts = self.cuts(&self.crossings(rays, pixel, 0.0).list);
        let direction = rays.of(pixel[0], pixel[1]).direction;
        let opaque = cuts.opaque.map(|crossing| Cut { crossing, kept: false });
        let shown = cuts.surfaces.iter().take(most as usize).chain(&opaque);
        let surface = |cut: &Cut| ShownSurface {
            depth: cut.crossing.depth,
            color: self.lit(direction, &cut.crossing),
            kept: cut.kept,
        };
        DividedRay { begin: cuts.begin.map(|one| one.depth), kept: cuts.kept, surfaces: shown.map(surface).collect() }
    }

    /// Of each pixel, row by row, how many surfaces that divide its ray lie behind the first `most`, in front of opaque ones.
    pub fn lacking(&self, rays: &ViewRays, size: [u32; 2], most: u32) -> Vec<u32> {
        if self.peeled().is_empty() {
            return Vec::new();
        }
        let pixel = |i: u32| {
            let crossings = self.crossings(rays, [i % size[0], i / size[0]], 0.0).list;
            (self.cuts(&crossings).surfaces.len() as u32).saturating_sub(most)
        };
        (0..size[0] * size[1]).into_par_iter().map(pixel).collect()
    }

    /// Of how many pixels the ray `meets` the volume but no clip geometry, which cuts in front of its first surface.
    pub fn uncovered(&self, rays: &ViewRays, size: [u32; 2], meets: impl Fn(&ViewRay) -> bool + Sync) -> usize {
        let pixel = |i: u32| {
            let at = [i % size[0], i / size[0]];
            meets(&rays.of(at[0], at[1])) && self.cuts(&self.crossings(rays, at, 0.0).list).begin.is_none()
        };
        if self.cuts_in_front() { (0..size[0] * size[1]).into_par_iter().filter(|i| pixel(*i)).count() } else { 0 }
    }
}
