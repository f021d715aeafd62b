//! Bare voxels: sizes, bytes in front, and what does not belong to them.

use depthleap::read::{self, ByteSkip, RawLayout, ReadChoice};
use depthleap::scene::settings::Component;
use depthleap::scene::volume::{VoxelType, Voxels};

use crate::kit::{SMALL, component, file, frame, gzip, layout, nrrd};

#[test]
fn a_file_too_short_or_too_long_names_both_lengths() {
    for length in (0..40).filter(|n| *n != 16) {
        let (_folder, path) = file("a.raw", &vec![7; length]);
        let message = read::volume(&path, Some(layout([2; 3], VoxelType::U16))).unwrap_err().to_string();
        assert!(message.contains(&format!("holds {length} bytes")) && message.contains("ask for 16"), "{message}");
    }
}

#[test]
fn sizes_that_overflow_or_are_zero_are_refused() {
    for dims in [[usize::MAX; 3], [1 << 21; 3], [1 << 20; 3], [0, 1, 1], [0, usize::MAX, usize::MAX]] {
        for skip in [ByteSkip::Bytes(0), ByteSkip::Bytes(u64::MAX), ByteSkip::ToTail] {
            for bytes in [vec![], vec![0; 8]] {
                let (_folder, path) = file("a.raw", &bytes);
                read::volume(&path, Some(RawLayout { skip, ..layout(dims, VoxelType::F64) })).unwrap_err();
            }
        }
    }
}

#[test]
fn bytes_in_front_are_skipped_as_many_as_are_said_or_left_over() {
    let expected = Voxels::U16(vec![0x0102, 0x0304]);
    for front in 0..9u64 {
        let bytes = [vec![0xee; front as usize], vec![1, 2, 3, 4]].concat();
        let (_folder, path) = file("a.raw", &bytes);
        let read =
            |skip| read::volume(&path, Some(RawLayout { big_endian: true, skip, ..layout([2, 1, 1], VoxelType::U16) }));
        assert_eq!(read(ByteSkip::Bytes(front)).unwrap().voxels, expected);
        assert_eq!(read(ByteSkip::ToTail).unwrap().voxels, expected);
        for wrong in [front + 1, front + 100, u64::MAX] {
            let message = read(ByteSkip::Bytes(wrong)).unwrap_err().to_string();
            let left = (front + 4).saturating_sub(wrong);
            assert!(message.contains(&format!("holds {left} bytes behind the {wrong}")), "{message}");
            assert!(message.contains("ask for 4"), "{message}");
        }
        // Without a word about where they lie, voxels are all there is; with one they need not be.
        if front > 0 {
            let message = read(ByteSkip::Bytes(0)).unwrap_err().to_string();
            assert!(message.contains(&format!("holds {} bytes", front + 4)), "{message}");
            assert!(message.contains("--skip BYTES"), "{message}");
        }
        if front > 1 {
            let warnings = read(ByteSkip::Bytes(front - 1)).unwrap().warnings;
            assert!(warnings[0].contains("1 byte behind its voxels"), "{warnings:?}");
        }
    }
    let (_folder, path) = file("a.raw", &[1; 3]);
    let short = RawLayout { skip: ByteSkip::ToTail, ..layout([2, 1, 1], VoxelType::U16) };
    assert!(read::volume(&path, Some(short)).unwrap_err().to_string().contains("holds 3 bytes"));
}

#[test]
fn a_layout_for_a_file_that_says_its_own_is_refused() {
    let whole = nrrd(SMALL, &[0; 4]);
    for bytes in [whole.clone(), gzip(&whole)] {
        let (_folder, path) = file("a.raw", &bytes);
        let message = read::volume(&path, Some(layout([2, 1, 2], VoxelType::U8))).unwrap_err().to_string();
        assert!(message.contains("is an NRRD file") && message.contains("leave out dims"), "{message}");
    }
}

/// Bytes that begin as gzip does are voxels like others.
#[test]
fn voxels_that_look_packed_are_read_as_they_stand() {
    for bytes in [vec![0x1f, 0x8b, 8, 0], vec![0x1f, 0x8b, 0xff, 0xff], gzip(b"voxels")] {
        let (_folder, path) = file("a.raw", &bytes);
        let volume = read::volume(&path, Some(layout([bytes.len(), 1, 1], VoxelType::U8))).unwrap();
        assert_eq!(volume.voxels, Voxels::U8(bytes));
    }
}

#[test]
fn components_and_frames_of_raw_voxels_are_refused_by_name() {
    let (_folder, path) = file("a.raw", &[1, 2, 3, 4]);
    for (choice, said) in [
        (component(Component::Number(1)), "volume.component (--component): is 1"),
        (component(Component::Luminance), "volume.component (--component): is luminance"),
        (component(Component::Magnitude), "volume.component (--component): is magnitude"),
        (frame(1), "volume.frame (--frame): is 1"),
        (ReadChoice { component: Some(Component::Number(7)), ..frame(0) }, "volume.component (--component): is 7"),
    ] {
        let read = read::volume_with(&path, Some(layout([2, 1, 2], VoxelType::U8)), &choice);
        let message = read.unwrap_err().to_string();
        let parts = ["a.raw", said, "raw voxels are one volume", "leave it out"];
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
    for choice in [component(Component::Number(0)), frame(0)] {
        read::volume_with(&path, Some(layout([2, 1, 2], VoxelType::U8)), &choice).unwrap();
    }
}
