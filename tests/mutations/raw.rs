//! Raw files of random lengths and layouts: read exactly where the arithmetic of their lengths says so.

use depthleap::read::{self, ByteSkip, RawLayout};
use depthleap::scene::volume::VoxelType;

use crate::damage::{Numbers, each};
use crate::{INPUTS, is_fit};

const TYPES: [VoxelType; 10] = [
    VoxelType::U8,
    VoxelType::I8,
    VoxelType::U16,
    VoxelType::I16,
    VoxelType::U32,
    VoxelType::I32,
    VoxelType::U64,
    VoxelType::I64,
    VoxelType::F32,
    VoxelType::F64,
];

/// Small sides, seldom one that cannot be.
fn side(numbers: &mut Numbers) -> usize {
    match numbers.below(40) {
        0 => *numbers.pick(&[0, 1 << 20, 1 << 31, 1 << 40, usize::MAX / 2, usize::MAX]),
        _ => 1 + numbers.below(4),
    }
}

fn layout(numbers: &mut Numbers) -> RawLayout {
    let skip = match numbers.below(8) {
        0 => ByteSkip::ToTail,
        1 => ByteSkip::Bytes(*numbers.pick(&[u64::MAX, 1 << 63, 1 << 40, 200])),
        n => ByteSkip::Bytes(n as u64 - 2),
    };
    let spacing = *numbers.pick(&[[1.0; 3], [1.0, 2.0, 0.5], [1.0, 0.0, 1.0], [f64::NAN; 3], [1e300; 3], [-1.0; 3]]);
    RawLayout {
        dims: [side(numbers), side(numbers), side(numbers)],
        voxel_type: *numbers.pick(&TYPES),
        spacing,
        big_endian: numbers.below(2) == 0,
        skip,
    }
}

/// Whether such a layout is that of a file of so many bytes.
fn fits(layout: &RawLayout, length: u128) -> bool {
    let size = layout.voxel_type.bytes() as u128;
    let bytes = layout.dims.iter().try_fold(size, |n, side| n.checked_mul(*side as u128));
    let held = match layout.skip {
        ByteSkip::Bytes(0) => bytes == Some(length),
        ByteSkip::Bytes(skip) => bytes.is_some_and(|bytes| bytes.saturating_add(u128::from(skip)) <= length),
        ByteSkip::ToTail => bytes.is_some_and(|bytes| bytes <= length),
    };
    let sides = layout.spacing.iter().all(|s| s.is_finite() && *s > 0.0 && *s < 1e29);
    held && sides && !layout.dims.contains(&0)
}

#[test]
fn raw_files() {
    let read = each(
        5,
        INPUTS,
        |_| {},
        |folder, numbers| {
            let path = folder.join("a.raw");
            let layout = layout(numbers);
            let asked: usize = layout.dims.iter().fold(layout.voxel_type.bytes(), |n, side| n.saturating_mul(*side));
            let length = (asked.min(4096) + numbers.below(9)).saturating_sub(numbers.below(4));
            std::fs::write(&path, vec![0x41; length]).unwrap();
            let read = read::volume(&path, Some(layout));
            assert_eq!(read.is_ok(), fits(&layout, length as u128), "{layout:?} of {length} bytes: {read:?}");
            let _ = read.as_ref().map_err(|error| is_fit(error, "a.raw"));
            read.is_ok()
        },
    );
    assert!((INPUTS / 30..INPUTS / 2).contains(&read), "{read} of {INPUTS} volumes were read");
}
