//! Built-in shapes, closed and with their fronts outside, centred at the origin and as long as 1.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::Mesh;
use crate::error::{Error, Result};
use crate::scene::builtin::nearest;

/// A built-in shape.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub name: &'static str,
    /// One line for `--help` and reports.
    pub about: &'static str,
    /// Its triangles, with so many segments around.
    make: fn(&mut Faces, usize),
}

/// Segments around a round shape where a specification names none.
const SEGMENTS: usize = 48;

/// Segments around a round shape at the most: 4 million triangles of a sphere.
const MOST_SEGMENTS: usize = 2048;

/// Segments around a round shape at the least.
const LEAST_SEGMENTS: usize = 3;

/// Every built-in shape.
pub static SHAPES: [Shape; 5] = [
    Shape { name: "sphere", about: "a sphere of diameter 1", make: sphere },
    Shape { name: "box", about: "a cube of side 1", make: cube },
    Shape { name: "arrow", about: "an arrow along +x, 1 long", make: arrow },
    Shape { name: "torus", about: "a torus in the plane y = 0, of diameter 1", make: torus },
    Shape { name: "teapot", about: "a pot with lid, spout and handle, 1 from handle to spout", make: teapot },
];

/// The shape `NAME` or `NAME:SEGMENTS` (a leading `builtin:` is allowed).
///
/// # Errors
/// When the name is unknown or the number of segments is not one.
pub fn shape(spec: &str) -> Result<Mesh> {
    let spec = spec.strip_prefix("builtin:").unwrap_or(spec);
    let (name, segments) = spec.split_once(':').map_or((spec, None), |(name, n)| (name, Some(n)));
    let label = format!("builtin:{spec}");
    let Some(shape) = SHAPES.iter().find(|shape| shape.name == name) else {
        let names = SHAPES.iter().map(|shape| shape.name);
        let near = nearest(name, names.clone()).map_or(String::new(), |n| format!("did you mean `{n}`? "));
        let known = names.collect::<Vec<_>>().join(", ");
        return Err(Error::usage(label, "is not a built-in shape", format!("{near}choose one of {known}")));
    };
    let segments = match segments.map(|text| text.parse()) {
        None => SEGMENTS,
        Some(Ok(n)) if (LEAST_SEGMENTS..=MOST_SEGMENTS).contains(&n) => n,
        Some(_) => {
            let remedy = format!("give a whole number from {LEAST_SEGMENTS} to {MOST_SEGMENTS} behind the name");
            return Err(Error::usage(label, "has another number of segments than a shape may have", remedy));
        }
    };
    let mut faces = Faces::default();
    (shape.make)(&mut faces, segments);
    let corners = faces.corners.iter().map(|corner| corner.as_vec3().to_array()).collect();
    Ok(Mesh { name: label, corners, triangles: faces.triangles, warnings: Vec::new() })
}

#[derive(Default)]
struct Faces {
    corners: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Faces {
    /// A surface over a grid of `across` x `along` quads: `at` gives the point of a knot. Its front is where
    /// (along x across) points. Quads without an area have no triangles.
    fn grid(&mut self, across: usize, along: usize, at: impl Fn(usize, usize) -> DVec3) {
        let first = self.corners.len() as u32;
        let wide = across as u32 + 1;
        for j in 0..=along {
            self.corners.extend((0..=across).map(|i| at(i, j)));
        }
        for j in 0..along as u32 {
            for i in 0..across as u32 {
                let knot = |i: u32, j: u32| first + j * wide + i;
                let (a, b, c, d) = (knot(i, j), knot(i + 1, j), knot(i, j + 1), knot(i + 1, j + 1));
                self.triangle([a, c, b]);
                self.triangle([b, c, d]);
            }
        }
    }

    /// A triangle, unless two of its corners are one point.
    fn triangle(&mut self, corners: [u32; 3]) {
        let [a, b, c] = corners.map(|corner| self.corners[corner as usize].as_vec3());
        if a != b && b != c && c != a {
            self.triangles.push(corners);
        }
    }

    /// The surface that a profile (radius, height) from bottom to top makes around the y axis.
    fn turned(&mut self, segments: usize, profile: &[[f64; 2]]) {
        self.grid(segments, profile.len() - 1, |i, j| {
            let [radius, y] = profile[j];
            // The same angle to the bit where the circle closes.
            let (sin, cos) = (TAU * (i % segments) as f64 / segments as f64).sin_cos();
            DVec3::new(radius * cos, y, radius * sin)
        });
    }

    /// A tube along a curve in the plane z = 0, with a radius at each place of it, closed at both ends.
    fn tube(&mut self, segments: usize, steps: usize, curve: impl Fn(f64) -> [f64; 3]) {
        let at = |t: f64| {
            let [x, y, radius] = curve(t);
            (DVec3::new(x, y, 0.0), radius)
        };
        // Rings from the first end to the last; those before and behind close the ends.
        self.grid(segments, steps + 2, |i, j| {
            let t = (j.clamp(1, steps + 1) - 1) as f64 / steps as f64;
            let (middle, radius) = at(t);
            let radius = if j == 0 || j == steps + 2 { 0.0 } else { radius };
            let (before, behind) = (at((t - 0.01).max(0.0)).0, at((t + 0.01).min(1.0)).0);
            let way = (behind - before).normalize();
            let side = DVec3::new(way.y, -way.x, 0.0);
            let (sin, cos) = (TAU * (i % segments) as f64 / segments as f64).sin_cos();
            middle + radius * (cos * side + sin * DVec3::Z)
        });
    }
}

/// A half circle of radius `radius` about (0, 0), from the bottom to the top.
fn half_circle(radius: f64, steps: usize) -> Vec<[f64; 2]> {
    let at = |i: usize| {
        let angle = PI * i as f64 / steps as f64 - FRAC_PI_2;
        [if i == 0 || i == steps { 0.0 } else { radius * angle.cos() }, radius * angle.sin()]
    };
    (0..=steps).map(at).collect()
}

fn sphere(faces: &mut Faces, segments: usize) {
    faces.turned(segments, &half_circle(0.5, segments.div_ceil(2).max(2)));
}

fn cube(faces: &mut Faces, _: usize) {
    for axis in 0..3 {
        for side in [-0.5, 0.5] {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            faces.grid(1, 1, |i, j| {
                let (across, along) = if side > 0.0 { (j, i) } else { (i, j) };
                let mut corner = DVec3::ZERO;
                (corner[axis], corner[u], corner[v]) = (side, across as f64 - 0.5, along as f64 - 0.5);
                corner
            });
        }
    }
}

fn arrow(faces: &mut Faces, segments: usize) {
    const PROFILE: [[f64; 2]; 5] = [[0.0, -0.5], [0.04, -0.5], [0.04, 0.2], [0.12, 0.2], [0.0, 0.5]];
    faces.turned(segments, &PROFILE);
    // From along y to along x.
    for corner in &mut faces.corners {
        *corner = DVec3::new(corner.y, -corner.x, corner.z);
    }
}

fn torus(faces: &mut Faces, segments: usize) {
    const RADII: [f64; 2] = [0.35, 0.15];
    let tube = segments.div_ceil(2).max(LEAST_SEGMENTS);
    faces.grid(segments, tube, |i, j| {
        let angle = |k: usize, n: usize| (TAU * (k % n) as f64 / n as f64).sin_cos();
        let ((sin, cos), (up, out)) = (angle(i, segments), angle(j, tube));
        let radius = RADII[0] + RADII[1] * out;
        DVec3::new(radius * cos, RADII[1] * up, radius * sin)
    });
}

fn teapot(faces: &mut Faces, segments: usize) {
    const BODY: [[f64; 2]; 14] = [
        [0.0, -0.2],
        [0.2, -0.2],
        [0.27, -0.15],
        [0.31, -0.06],
        [0.3, 0.03],
        [0.26, 0.1],
        [0.21, 0.14],
        [0.2, 0.16],
        [0.14, 0.19],
        [0.05, 0.21],
        [0.03, 0.23],
        [0.05, 0.26],
        [0.03, 0.28],
        [0.0, 0.28],
    ];
    faces.turned(segments, &BODY);
    let tube = segments.div_ceil(3).max(LEAST_SEGMENTS);
    // From the body out and up, thinner towards its end.
    faces.tube(tube, tube, |t| [0.26 + 0.21 * t, -0.08 + 0.22 * t * t, 0.07 - 0.04 * t]);
    // A half ring on the other side.
    faces.tube(tube, tube, |t| {
        let (sin, cos) = (FRAC_PI_2 + PI * t).sin_cos();
        [-0.27 + 0.2 * cos, 0.01 + 0.11 * sin, 0.03]
    });
}
