//! Voxels that are no numbers, enormous, tiny or nearly alike.

use super::super::case::{COLOR, Expect, SAME_SUM, StabilityCase};
use crate::scene::Volume;
use crate::scene::field::NanPolicy;
use crate::scene::settings::VolumeTexture;
use crate::scene::volume::Voxels;

const GROUP: &str = "values";
const SIDE: usize = 12;

/// A cube of voxels; without a name of a file it is called by what it is.
fn cube(voxels: Voxels) -> Option<Volume> {
    Volume::new("voxels", [SIDE; 3], [1.0; 3], voxels).ok()
}

/// Values from 0 to 1 that differ from voxel to voxel.
pub(super) fn pattern(i: usize) -> f64 {
    let [x, y, z] = [i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)];
    ((x * 5 + y * 3 + z * 7) % 23) as f64 / 22.0
}

fn floats(value: impl Fn(usize) -> f64) -> Option<Volume> {
    cube(Voxels::F32((0..SIDE.pow(3)).map(|i| value(i) as f32).collect()))
}

pub(super) fn doubles(value: impl Fn(usize) -> f64) -> Option<Volume> {
    cube(Voxels::F64((0..SIDE.pow(3)).map(value).collect()))
}

pub fn cases() -> Vec<StabilityCase> {
    let [r, g, b] = COLOR;
    let points = [[0.1, r, g, b, 0.0], [0.5, g, b, r, 0.05], [1.0, b, r, g, 0.4]];
    let case = |name: &str, volume: Option<Volume>| {
        volume.map(|v| StabilityCase::new(GROUP, name, "").points(&points).voxels(v))
    };
    let broken = |i: usize| match i % 31 {
        3 => f64::NAN,
        11 => f64::INFINITY,
        17 => f64::NEG_INFINITY,
        _ => pattern(i),
    };
    let replaced = floats(|i| match broken(i) {
        value if value == f64::INFINITY => 1.0,
        value if value.is_finite() => value,
        _ => 0.0,
    });
    let greatest = f64::from(f32::MAX);
    let own = |case: Option<StabilityCase>| {
        case.map(|case| case.with(|s| (s.volume.texture, s.volume.range) = (VolumeTexture::Native, None)))
    };
    let signed: Vec<i16> = (0..SIDE.pow(3)).map(|i| (pattern(i) * 65535.0 - 32768.0) as i16).collect();
    let unsigned: Vec<u16> = (0..SIDE.pow(3)).map(|i| 1000 + (pattern(i) * 7.0) as u16).collect();
    let bytes: Vec<i8> = (0..SIDE.pow(3)).map(|i| (pattern(i) * 255.0 - 128.0) as i8).collect();
    let quantised =
        case("values in 16 bits", floats(pattern)).map(|case| case.with(|s| s.volume.texture = VolumeTexture::R16));
    [
        case("NaN and infinities, replaced", floats(broken))
            .zip(replaced)
            .map(|(case, replaced)| case.expect(Expect::SumOf(replaced), SAME_SUM)),
        case("NaN and infinities, holes", floats(broken)).map(|case| case.with(|s| s.volume.nan = NanPolicy::Hole)),
        case("NaN and infinities, an error", floats(broken)).map(|case| {
            case.with(|s| s.volume.nan = NanPolicy::Error).expect(Expect::Refused("NaN or infinite"), SAME_SUM)
        }),
        case("nothing but NaN", floats(|_| f64::NAN)),
        case("nothing but NaN, holes", floats(|_| f64::NAN))
            .map(|case| case.with(|s| s.volume.nan = NanPolicy::Hole).expect(Expect::Constant([0.0; 4]), SAME_SUM)),
        case("from -FLT_MAX to FLT_MAX", floats(|i| (2.0 * pattern(i) - 1.0) * greatest)),
        case("FLT_MAX beside values of the range", floats(|i| if i % 29 == 5 { greatest } else { pattern(i) }))
            .map(|case| case.with(|s| s.volume.range = Some([0.0, 1.0].map(Into::into)))),
        case("denormal numbers", floats(|i| pattern(i) * 1e-39)),
        case("a contrast of 1e-6 on an offset of 1e3", doubles(|i| 1e3 + 1e-6 * pattern(i))),
        case("a contrast of 1e-12 of the range", doubles(|i| pattern(i) * 1e-12))
            .map(|case| case.with(|s| s.volume.range = Some([0.0, 1.0].map(Into::into)))),
        own(case("signed 16 bits over their whole range", cube(Voxels::I16(signed)))),
        own(case("unsigned 16 bits on an offset of 1000", cube(Voxels::U16(unsigned))))
            .map(|case| case.with(|s| s.volume.range = Some([1000.0, 1007.0].map(Into::into)))),
        own(case("signed bytes", cube(Voxels::I8(bytes)))),
        quantised,
    ]
    .into_iter()
    .flatten()
    .collect()
}
