//! Rays of a view in single floats: numbers that keep them good, and how far they may be off.
//!
//! At the depth half way between the nearest and the deepest place of the volume a ray's place changes evenly over the picture, and so
//! does its heading: `middle + column * right + row * down`. Both are found in two parts. The high parts of the three are whole multiples of one
//! grain, coarse enough for their products with columns and rows, and the sum of these, to be exact in f32. The low parts, what is
//! left, are so small that their rounding does not count. So nothing is lost where a ray's place and a face of the box, or its heading
//! and 0, almost cancel, and what is off does not grow with the distance of the eye.

use glam::DVec3;

use crate::math::ray::ViewRays;

/// The most that single floats may be off with places on a ray, in voxels: an eighth of what texture units of 8 bits tell of
/// places between voxels.
pub const ENOUGH: f64 = 1.0 / 2048.0;

/// What rounding takes from an f32, relative.
const UNIT: f64 = 1.0 / (1 << 24) as f64;

/// What a device may take from a quotient or a root, relative: 2.5 units in the last place (Vulkan specification, precision of operations).
const QUOTIENT: f64 = 5.0 * UNIT;

/// So many bits less than its largest number a grain has: of the 24 of an f32 one is for the sum of three roundings, which holds for
/// pictures of fewer than 2^23 columns and rows.
const BITS_OF_GRAIN: i32 = 23;

/// Smaller numbers count as this one: their grain would be no normal number of single precision.
const SMALLEST: f64 = 1e-25;

/// Three numbers, one of each axis, that change evenly over the picture: `middle + column * right + row * down`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Even {
    pub middle: DVec3,
    pub right: DVec3,
    pub down: DVec3,
}

impl Even {
    /// The most that the numbers come to at up to so many columns and rows from the middle, each part by its amount.
    fn most(&self, half: [f64; 2]) -> DVec3 {
        self.middle.abs() + half[0] * self.right.abs() + half[1] * self.down.abs()
    }

    /// The high parts and the low ones.
    fn parts(&self, half: [f64; 2]) -> [Self; 2] {
        let bits = |most: f64| most.max(SMALLEST).log2().ceil() as i32 - BITS_OF_GRAIN;
        let grain = DVec3::from_array(self.most(half).to_array().map(|most| 2.0_f64.powi(bits(most))));
        let whole = |numbers: DVec3, grain: DVec3| (numbers / grain).round() * grain;
        // Columns and rows are halves.
        let (right, down) = (whole(self.right, 2.0 * grain), whole(self.down, 2.0 * grain));
        let high = Self { middle: whole(self.middle, grain), right, down };
        [high, Self { middle: self.middle - high.middle, right: self.right - right, down: self.down - down }]
    }
}

/// The rays of a view as single floats find them, in texture coordinates from the middle of the volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SingleRays {
    /// Column and row of the middle of the picture, in pixels.
    pub center: [f64; 2],
    /// Where rays are half way between the nearest and the deepest place of the volume, high parts and low ones.
    pub place: [Even; 2],
    /// What rays come on in a unit of depth, high parts and low ones.
    pub heading: [Even; 2],
    /// Where rays begin, in depth from those places.
    pub near: f64,
    /// How far off places on a ray may be on any axis.
    pub error: f64,
}

impl SingleRays {
    /// Of a view of a box with these sides, in volume units, in a picture of so many columns and rows.
    pub fn new(rays: &ViewRays, extent: DVec3, size: [u32; 2]) -> Self {
        let center = size.map(|pixels| 0.5 * f64::from(pixels));
        let corner = 0.5 * extent;
        let depths = [rays.nearest(-corner, corner), rays.deepest(-corner, corner)];
        let middle = 0.5 * (depths[0] + depths[1]);
        let axis = rays.through(center[0], center[1]);
        let (still, even) = (DVec3::ZERO, |by: f64| (by * rays.right / extent, by * rays.down / extent));
        let [place, heading] = match rays.parallel() {
            true => [even(1.0), (still, still)],
            false => [even(middle), even(1.0)],
        };
        let place = Even { middle: axis.at(middle) / extent, right: place.0, down: place.1 };
        let heading = Even { middle: axis.direction / extent, right: heading.0, down: heading.1 };
        let single = Self {
            center,
            place: place.parts(center),
            heading: heading.parts(center),
            near: rays.near - middle,
            error: f64::INFINITY,
        };
        let slowest = match rays.parallel() {
            true => heading.middle.abs().min_element(),
            // A ray that meets a face at most at that depth comes on as fast as this towards it.
            false => ((rays.origin / extent).abs() - 0.5).abs().min_element() / depths[1],
        };
        let [places, headings] = [place.most(center), heading.most(center)];
        Self { error: single.error([places, headings], 0.5 * (depths[1] - depths[0]), slowest), ..single }
    }

    /// A bound of the error of places on a ray, in texture coordinates: from the most that places and headings come to, the most depth from
    /// the middle, and the least speed towards a face that is met, in texture coordinates for a unit of depth. It follows the operations of
    /// `glsl/shared/single_rays.glsl`.
    fn error(&self, [places, headings]: [DVec3; 2], depth: f64, slowest: f64) -> f64 {
        // Of a low part: its three numbers, two products and two sums.
        let low = |parts: &[Even; 2]| 4.0 * UNIT * parts[1].most(self.center);
        let (place, heading) = (low(&self.place), low(&self.heading));
        // The depth of a face: two differences, the heading's sum, a quotient. The low parts count as the ray nears the face.
        let of_depth = (3.0 * UNIT + QUOTIENT) * depth + (place + depth * heading).max_element() / slowest;
        // The place there: the sums of both parts, a product, a sum, and the way to coordinates from 0 to 1.
        let at_depth = UNIT * (places + 2.0 * depth * headings + 1.5) + place + depth * heading;
        // The way from end to end, at most 1: two differences, a product and its number, half of a square's two, a root, a quotient.
        let of_way = 5.5 * UNIT + 2.0 * QUOTIENT;
        let error = (at_depth + headings * of_depth).max_element() + of_way;
        if error.is_nan() { f64::INFINITY } else { error }
    }
}
