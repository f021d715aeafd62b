//! Stacks of slices: few and many, along a diagonal, from inside, and at the widest angles.

use super::super::case::{COLOR, Expect, ROUNDING, SAME_SUM, StabilityCase, Tolerance};
use super::named;
use super::values::{doubles, pattern};
use crate::scene::settings::{Classification, Last, Offset, Settings};

const GROUP: &str = "slices";

/// The voxels along each side of the medium that the cases look at.
const VOXELS: f64 = 24.0;

/// Thousands of slices, each blended with a picture in f32.
const MANY: Tolerance = Tolerance { absolute: 2e-5, relative: 3e-4, reason: "thousands of roundings to f32" };

pub fn cases() -> Vec<StabilityCase> {
    let by_slices =
        |case: StabilityCase| case.with(|s| s.sampling.last = Last::Full).by(&named(|method| method.stack().is_some()));
    let of = |opacity: f64, name: &str, change: &dyn Fn(&mut Settings)| {
        by_slices(StabilityCase::medium(GROUP, name, "constant:24", opacity).with(change))
    };
    let summed = |name: &str, change: &dyn Fn(&mut Settings)| of(0.03, name, change).expect(Expect::Sum, SAME_SUM);
    let eye = |eye: [f64; 3], target: [f64; 3]| move |s: &mut Settings| (s.camera.eye, s.camera.target) = (eye, target);
    let along_z = |s: &mut Settings| (s.camera.eye, s.camera.height) = ([0.0, 0.0, 1.4], Some(1.1));
    let beer = |opacity: f64| Expect::Beer { color: COLOR, opacity, steps: None };
    let mut cases = vec![
        of(0.03, "across parallel rays", &along_z).expect(beer(0.03), ROUNDING),
        of(0.03, "in the middle of steps across parallel rays", &|s| {
            along_z(s);
            s.sampling.offset = Offset::Midpoint;
        })
        .expect(beer(0.03), ROUNDING),
        of(0.999_999, "hardly clear, across parallel rays", &along_z).expect(beer(0.999_999), ROUNDING),
        of(1.0, "opaque, across parallel rays", &along_z).expect(beer(1.0), ROUNDING),
        of(1e-6, "hardly anything, across parallel rays", &along_z).expect(beer(1e-6), ROUNDING),
        of(1.0, "opaque", &|_| {}).expect(Expect::Sum, SAME_SUM),
        summed("one slice", &|s| s.sampling.step = VOXELS * 4.0),
        summed("as many as steps of 1/128 voxel", &|s| s.sampling.step = 1.0 / 128.0).expect(Expect::Sum, MANY),
        summed("along a diagonal", &eye([1.3; 3], [0.0; 3])),
        summed("nearly along a diagonal", &eye([1.3, 1.3, 1.300_001], [0.0; 3])),
        summed("parallel rays along a diagonal", &|s| (s.camera.eye, s.camera.height) = ([1.3; 3], Some(1.8))),
        // Slice 6 of those across z, between faces that are 24 voxels from each other.
        summed("eye in a slice", &eye([0.1, 0.05, 0.25], [0.13, -0.1, -0.3])),
        summed("eye in the middle", &eye([0.0; 3], [0.3, 0.2, 0.4])),
        summed("eye inside, parallel rays", &|s| {
            (s.camera.eye, s.camera.target, s.camera.height) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4], Some(1.3));
        }),
        summed("field of view of 170", &|s| s.camera.fov_y = 170.0),
        summed("field of view of 170 from inside", &|s| (s.camera.eye, s.camera.fov_y) = ([0.1, 0.05, 0.02], 170.0)),
        summed("one pixel", &|s| s.image.size = [1, 1]),
        summed("pre-integrated, field of view of 150", &|s| {
            (s.camera.fov_y, s.camera.eye, s.sampling.classification) =
                (150.0, [0.6, 0.4, 0.8], Classification::PreIntegrated);
        }),
        summed("looking away", &|s| (s.camera.eye, s.camera.target) = ([0.0, 0.1, 2.0], [0.0, 0.0, 5.0]))
            .expect(Expect::Nothing, SAME_SUM),
        summed("a short last sample, which none has", &|s| s.sampling.step = 0.7)
            .with(|s| s.sampling.last = Last::Partial)
            .expect(Expect::Refused("every slice stands for the way to the next one"), SAME_SUM),
    ];
    let values = |name: &str, value: &dyn Fn(usize) -> f64| {
        doubles(value).map(|volume| {
            let case = StabilityCase::new(GROUP, name, "").preset("ramp").voxels(volume).expect(Expect::Sum, SAME_SUM);
            by_slices(case.with(|s| s.volume.range = Some([0.0, 1.0].map(Into::into))))
        })
    };
    cases.extend(values("values from end to end", &|i| pattern(i).round()));
    cases.extend(values("values of a thousand ranges", &|i| 1e3 * (pattern(i) - 0.5)));
    cases
}
