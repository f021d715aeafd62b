//! What is around the volume, as surfaces reflect it: a picture of all directions [Thesis §4.3].

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::Polygons;
use super::settings::Mapping;
use super::sky::sky;

/// Texels of built-in pictures, across and down.
const BUILTIN_SIZE: [usize; 2] = [512, 256];

/// A texel of polygons is the mean of so many directions across and down, which smooths their edges.
const DIRECTIONS: usize = 2;

/// Linear red, green and blue of texels, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Texels across and down, neither of them 0.
    pub size: [usize; 2],
    pub texels: Vec<[f32; 3]>,
}

/// What surfaces reflect.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    pub picture: Picture,
    /// Which direction of volume space each place of the picture shows.
    pub mapping: Mapping,
    /// The part of a surface's colour that is what it reflects.
    pub reflectivity: f64,
    /// Leads from the volume's own axes to volume space.
    pub turn: DQuat,
    /// What a user should know of the picture.
    pub warnings: Vec<String>,
}

impl Picture {
    /// The latlong picture of a sky.
    pub fn of_sky() -> Self {
        Self::latlong(BUILTIN_SIZE, 1, sky)
    }

    /// The latlong picture of a scene's opaque polygons in front of the sky, as a camera in the volume's centre has them, with a light
    /// at that camera [Thesis §4.3]. `turn` leads from the polygons' axes to volume space.
    pub fn of_polygons(polygons: &Polygons, turn: DQuat) -> Self {
        if polygons.opaque().is_empty() {
            return Self::of_sky();
        }
        let back = turn.inverse();
        Self::latlong(BUILTIN_SIZE, DIRECTIONS, |way| {
            polygons.seen_from(DVec3::ZERO, back * way).unwrap_or_else(|| sky(way))
        })
    }

    /// The latlong picture of what `color` gives for directions of length 1: a texel is the mean of `directions`^2 of them.
    fn latlong(size: [usize; 2], directions: usize, color: impl Fn(DVec3) -> [f64; 3] + Sync) -> Self {
        let texel = |i: usize| {
            let mut sum = [0.0; 3];
            for part in 0..directions * directions {
                let across = ((i % size[0]) * directions + part % directions) as f64 + 0.5;
                let down = ((i / size[0]) * directions + part / directions) as f64 + 0.5;
                let azimuth = TAU * (across / (size[0] * directions) as f64 - 0.5);
                let polar = PI * down / (size[1] * directions) as f64;
                let ring = polar.sin();
                let seen = color(DVec3::new(ring * azimuth.sin(), polar.cos(), -ring * azimuth.cos()));
                (0..3).for_each(|c| sum[c] += seen[c]);
            }
            sum.map(|c| (c / (directions * directions) as f64) as f32)
        };
        Self { size, texels: (0..size[0] * size[1]).into_par_iter().map(texel).collect() }
    }

    /// The greatest number of any texel.
    pub fn brightest(&self) -> f64 {
        self.texels.iter().flatten().fold(0.0f32, |most, c| most.max(*c)).into()
    }
}

impl Environment {
    /// A surface of that colour in all lights, with what it reflects. `normal` may have any length and sign, `view` is the direction to
    /// the eye, of length 1; both in the volume's own axes. Without a normal it reflects nothing.
    pub fn on(&self, color: [f64; 3], normal: DVec3, view: DVec3) -> [f64; 3] {
        let Some(reflected) = self.reflected(normal, view) else { return color };
        let (seen, part) = (self.color(reflected), self.reflectivity);
        std::array::from_fn(|c| (1.0 - part) * color[c] + part * seen[c])
    }

    /// The direction of volume space that a surface shows to the eye; none without a normal.
    pub fn reflected(&self, normal: DVec3, view: DVec3) -> Option<DVec3> {
        let normal = normal.try_normalize()?;
        Some(self.turn * (2.0 * normal.dot(view) * normal - view))
    }

    /// The linear colour that is seen in a direction of volume space, of length 1, between the four texels around its place.
    pub fn color(&self, direction: DVec3) -> [f64; 3] {
        let place = self.place(direction);
        let [column, row] = place.map(|at| at.floor() as i64);
        let [across, down] = place.map(|at| at - at.floor());
        let texel = |x: i64, y: i64| self.texel(column + x, row + y);
        let mix = |a: f64, b: f64, weight: f64| (1.0 - weight) * a + weight * b;
        let [a, b, c, d] = [texel(0, 0), texel(1, 0), texel(0, 1), texel(1, 1)];
        std::array::from_fn(|i| mix(mix(a[i], b[i], across), mix(c[i], d[i], across), down))
    }

    /// Where a direction of volume space, of length 1, is in the picture: texels from the centre of the first one, across and down.
    pub fn place(&self, direction: DVec3) -> [f64; 2] {
        let DVec3 { x, y, z } = direction;
        let at = match self.mapping {
            Mapping::Latlong => {
                let ring = x.hypot(z);
                let azimuth = if ring > 0.0 { x.atan2(-z) } else { 0.0 };
                [0.5 + azimuth / TAU, ring.atan2(y) / PI]
            }
            Mapping::Sphere => match 2.0 * (direction + DVec3::Z).length() {
                m if m > 0.0 => [0.5 + x / m, 0.5 - y / m],
                // All of the rim shows what is behind the ball.
                _ => [0.5, 0.0],
            },
        };
        std::array::from_fn(|axis| at[axis] * self.picture.size[axis] as f64 - 0.5)
    }

    /// A texel; beside the picture that on its edge, of latlong ones across that on the other side.
    pub fn texel(&self, column: i64, row: i64) -> [f64; 3] {
        let [width, height] = self.picture.size.map(|n| n as i64);
        let column = match self.mapping {
            Mapping::Latlong => column.rem_euclid(width),
            Mapping::Sphere => column.clamp(0, width - 1),
        };
        let row = row.clamp(0, height - 1);
        self.picture.texels[(row * width + column) as usize].map(f64::from)
    }
}
