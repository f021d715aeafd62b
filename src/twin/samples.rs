//! Samples along a ray: how many and where. Twin of `glsl/shared/samples.glsl`.

use glam::DVec3;

use super::{Pixel, Twin};
use crate::projection::Ends;
use crate::scene::settings::{Last, PartialSegments};

/// The GPU's count of samples comes from the stored length and an f32 step. Within this of a whole number (relative to
/// the length in steps: two roundings and that of the offset, of 2^-24 each) the two may differ by one.
const LENGTH_ROUNDING: f64 = 2e-7;

/// Places are good to 2^-22 voxels: a sample this near to the face of a cell may be on either side of it.
pub(super) const FACE_ROUNDING: f64 = 1e-6;

/// Places are good to 2^-22 voxels on each axis, over which the value changes by that share of the spread of its cell.
pub(super) const PLACE_ROUNDING: f64 = 1e-6;

impl Twin<'_> {
    /// Distance between samples in volume units.
    pub fn step_length(&self) -> f64 {
        self.scene.settings.step() * self.scene.field.finest()
    }

    /// Length of the ray in steps.
    pub fn steps(&self, pixel: &Pixel) -> f64 {
        pixel.length / self.step_length()
    }

    /// Samples on the ray: all i with (i + offset) steps < length, or all whose whole step lies on it.
    pub fn sample_count(&self, pixel: &Pixel) -> u32 {
        self.scene.samples_on(self.steps(pixel))
    }

    /// Whether f32 can tell the number of samples.
    pub fn sample_count_decided(&self, pixel: &Pixel) -> bool {
        let steps = self.steps(pixel);
        let shifted = match self.scene.last() {
            Last::None => steps,
            Last::Full | Last::Partial => steps - self.scene.settings.sampling.offset.steps(),
        };
        // Both ends of a ray may be off on three axes.
        let off = 2.0 * 3.0_f64.sqrt() * self.rays_off / self.step_length();
        (shifted - shifted.round()).abs() > LENGTH_ROUNDING * steps.max(1.0) + off
    }

    /// How far off places may be in f32, in voxels.
    pub(super) fn place_rounding(&self) -> f64 {
        PLACE_ROUNDING + self.voxels_off()
    }

    /// How far off rays in single floats are, in voxels.
    fn voxels_off(&self) -> f64 {
        self.rays_off * self.scene.field.dims().into_iter().max().unwrap_or(1) as f64
    }

    /// Steps from the entry point to sample `i`.
    pub fn steps_to(&self, i: u32) -> f64 {
        f64::from(i) + self.scene.settings.sampling.offset.steps()
    }

    /// The begin and the end of the step after sample `i`, in steps, cut off at the exit point.
    pub fn span(&self, pixel: &Pixel, i: u32) -> [f64; 2] {
        [self.steps_to(i), self.steps_to(i + 1).min(self.steps(pixel))]
    }

    /// Texture coordinates `steps` from the entry point.
    pub fn position_at(&self, pixel: &Pixel, steps: f64) -> DVec3 {
        pixel.entry + pixel.direction / self.scene.field.extent() * ((steps - pixel.anchor) * self.step_length())
    }

    /// Position of sample `i`, texture coordinates.
    pub fn sample_position(&self, pixel: &Pixel, i: u32) -> DVec3 {
        self.position_at(pixel, self.steps_to(i))
    }

    /// Texture coordinates to voxel coordinates (centres at i + 0.5).
    pub fn voxel(&self, position: DVec3) -> DVec3 {
        position * DVec3::from_array(self.scene.field.dims().map(|n| n as f64))
    }

    /// What `look` says of the cell that sample `i` lies in; undecided where it says another thing of one beside it
    /// that f32 might take.
    pub fn at_cell<T: PartialEq>(&self, pixel: &mut Pixel, i: u32, look: impl Fn([usize; 3]) -> T) -> T {
        self.at_cell_of(pixel, self.place_of(pixel, i), look)
    }

    /// The same for the cell at these texture coordinates.
    pub fn at_cell_of<T: PartialEq>(&self, pixel: &mut Pixel, place: DVec3, look: impl Fn([usize; 3]) -> T) -> T {
        let voxel = self.voxel(place);
        let found = look(self.scene.field.cell_at(voxel));
        let near = |by: f64| self.scene.field.cell_at(voxel + DVec3::splat(by));
        let off = FACE_ROUNDING + self.voxels_off();
        let (low, high) = (near(-off), near(off));
        if low != high {
            let corner = |n: usize| std::array::from_fn(|axis| if n >> axis & 1 == 0 { low[axis] } else { high[axis] });
            pixel.undecided |= (0..8).any(|n| look(corner(n)) != found);
        }
        found
    }

    /// Steps from sample `i` until the ray leaves the box of `side`^3 cells around the volume's `cell`, in which it lies;
    /// infinite where it leaves the volume with it. The least and the most that f32 may find.
    pub fn steps_inside(&self, pixel: &Pixel, i: u32, cell: [usize; 3], side: usize) -> [f64; 2] {
        let field = &self.scene.field;
        let place = self.voxel(self.place_of(pixel, i)) - 0.5;
        let stride = self.voxel(pixel.direction / field.extent() * self.step_length());
        let off = FACE_ROUNDING + self.voxels_off();
        let mut steps = [f64::INFINITY; 2];
        for axis in 0..3 {
            let (at, last, up) = (cell[axis] / side, (field.cells()[axis] - 1) / side, stride[axis] > 0.0);
            if stride[axis] == 0.0 || at == if up { last } else { 0 } {
                continue;
            }
            let way = ((at + usize::from(up)) * side) as f64 - place[axis];
            for (least, by) in steps.iter_mut().zip([-off, off]) {
                *least = least.min(way / stride[axis] + by / stride[axis].abs());
            }
        }
        steps.map(|steps| steps.max(0.0))
    }

    /// The samples of main pass `pass`: first and one past the last.
    pub fn segment(&self, pixel: &Pixel, pass: u32) -> (u32, u32) {
        let m = self.scene.settings.sampling.samples_per_pass;
        let (first, end) = self.samples_of_part(pixel);
        ((pass * m).max(first), (pass * m + m).min(end))
    }

    /// Whether the part of the ray that is drawn begins behind the segment of main pass `pass`.
    pub fn begins_later(&self, pixel: &Pixel, pass: u32) -> bool {
        let (first, end) = self.samples_of_part(pixel);
        (pass + 1) * self.scene.settings.sampling.samples_per_pass <= first && first < end
    }

    /// The main pass of the last segment of the part of the ray that is drawn, where a surface ends it; `pass` where that is at or
    /// before it, in frames in which such segments are drawn apart.
    pub fn only_partial(&self, pixel: &Pixel, pass: u32) -> Option<u32> {
        let sampling = &self.scene.settings.sampling;
        let (first, end) = self.samples_of_part(pixel);
        let last = end.checked_sub(1)? / sampling.samples_per_pass;
        let apart = self.scene.settings.layers.partial == PartialSegments::Apart && self.slices.is_none();
        (apart && first < end && self.part(pixel)[1] < self.steps(pixel) && last <= pass).then_some(last)
    }

    /// Whether the ray needs no further samples; undecided where rounding may decide.
    pub fn saturated(&self, pixel: &mut Pixel) -> bool {
        self.saturated_by(pixel, 0.0)
    }

    /// Whether it needs none, where that is an opacity above T, by more than `margin`.
    pub fn saturated_by(&self, pixel: &mut Pixel, margin: f64) -> bool {
        match self.projection.ends {
            Ends::Opaque => self.opaque_by(pixel, margin),
            // Samples stop at the end to the bit, and one that f32 may have on its other side is undecided itself.
            Ends::Reached => {
                let [value, ..] = pixel.accumulated;
                let end = self.projection.grey(self.levels.end);
                self.projection.blend.apply(pixel.accumulated, end)[0] == value
            }
            Ends::Never(_) => false,
        }
    }

    /// Whether the ray's opacity is above the threshold T by more than `margin`.
    fn opaque_by(&self, pixel: &mut Pixel, margin: f64) -> bool {
        // The sum of up to some thousand rounded samples.
        const ROUNDING: f64 = 1e-5;
        let threshold = self.scene.settings.sampling.termination + margin;
        // Opacity never exceeds 1, so that at T = 1 there is nothing to decide.
        let opacity = self.gathered(pixel)[3];
        // That of a surface is 1 to the bit.
        if threshold < 1.0 && opacity > 0.0 && !self.scene.ends_at_surfaces() {
            pixel.undecided |= (opacity - threshold).abs() < ROUNDING;
        }
        opacity > threshold
    }
}
