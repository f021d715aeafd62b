//! Files that showed faults, in a folder beside the repository: each gives what the folder's README calls right.

use std::path::{Path, PathBuf};

use depthleap::read::{self, ByteSkip, RawLayout, ReadChoice};
use depthleap::scene::settings::TransferSettings;
use depthleap::scene::volume::{Volume, VoxelType};
use glam::DQuat;

use crate::kit::{by_index, layout, says, values};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/cases")
}

/// What is right for a file.
enum Right {
    /// A volume of these sizes and spacings, its voxels in this order, with a word of these in its warnings.
    Volume([usize; 3], [f64; 3], Order, Option<&'static str>),
    /// An error that holds these words.
    Refused(&'static [&'static str]),
    /// No volume, and read by another test.
    Other,
}

enum Order {
    /// The numbers that most of these files hold.
    Plain,
    /// The same by their index among the plain ones.
    By(fn(usize) -> usize),
    /// 256 times the plain ones.
    High,
    /// These.
    Values(&'static [f64]),
    /// That many of 16^3 hold a value above 0, and the largest of them.
    Above(usize, f64),
}

use Order::{Above, By, High, Plain, Values};
use Right::{Other, Refused, Volume as Is};

const BOX: [usize; 3] = [4, 5, 6];
const ONE: [f64; 3] = [1.0; 3];
const TEXT: Order = Values(&[241.0, 160.0, 148.0, 198.0, 209.0, 77.0, 184.0, 65.0]);
const FLAT: [f64; 3] = [1.0, 1.0, 0.625];

/// Axis 0 in reverse.
fn mirrored(i: usize) -> usize {
    i / 4 * 4 + 3 - i % 4
}

/// x along -axis 2, y along axis 0, z along -axis 1; 6 x 4 x 5 voxels.
fn permuted(i: usize) -> usize {
    let (x, y, z) = (i % 6, i / 6 % 4, i / 24);
    y + 4 * ((4 - z) + 5 * (5 - x))
}

const RIGHT: [(&str, Right); 47] = [
    ("04-axis-mins-maxs/minmax.nrrd", Is(BOX, [1.0, 1.0, 10.0], Plain, None)),
    ("04-axis-mins-maxs/none.nrrd", Is(BOX, ONE, Plain, None)),
    ("04-axis-mins-maxs/spacings.nrrd", Is(BOX, [1.0, 1.0, 10.0], Plain, None)),
    ("05-shear-and-mirror/a.nrrd", Is(BOX, ONE, Plain, Some("sheared"))),
    ("05-shear-and-mirror/b.nrrd", Is(BOX, ONE, By(mirrored), None)),
    ("05-shear-and-mirror/box.nrrd", Is(BOX, ONE, Plain, None)),
    ("05-shear-and-mirror/c.nrrd", Is([6, 4, 5], ONE, By(permuted), None)),
    ("05-shear-and-mirror/mirror.nrrd", Is(BOX, ONE, By(mirrored), None)),
    ("05-shear-and-mirror/permuted.nrrd", Is([6, 4, 5], ONE, By(permuted), None)),
    ("05-shear-and-mirror/plain.nrrd", Is(BOX, ONE, Plain, None)),
    ("05-shear-and-mirror/shear.nrrd", Is(BOX, ONE, Plain, Some("sheared"))),
    ("09-broken-icd/broken.json", Other),
    ("10-u16-12bit/ct12.nrrd", Is([16; 3], ONE, Above(2176, 3651.0), None)),
    ("12-labels-nearest/labels.nrrd", Is([16; 3], ONE, Above(912, 200.0), None)),
    ("12-labels-nearest/only100.json", Other),
    ("14-int64/long.nrrd", Is(BOX, ONE, Plain, None)),
    ("14-int64/ulong.nrrd", Is(BOX, ONE, Plain, None)),
    ("16-encodings/GZ.nrrd", Is(BOX, ONE, Plain, None)),
    ("16-encodings/bz2.nrrd", Is(BOX, ONE, Plain, None)),
    ("16-encodings/bzip2.nrrd", Is(BOX, ONE, Plain, None)),
    ("16-encodings/gzi.nrrd", Refused(&["encoding", "`gzi`", "unknown", "raw, gzip, bzip2, ascii, hex"])),
    ("16-encodings/hex.nrrd", Is(BOX, ONE, Plain, None)),
    ("16-encodings/raw.nrrd", Is(BOX, ONE, Plain, None)),
    ("17-text-numbers/alone.nrrd", Is([2; 3], ONE, TEXT, None)),
    ("17-text-numbers/before.nrrd", Is([2; 3], ONE, TEXT, None)),
    ("17-text-numbers/behind.nrrd", Is([2; 3], ONE, TEXT, None)),
    ("17-text-numbers/nan.nrrd", Other),
    ("17-text-numbers/plain.nrrd", Is([2; 3], ONE, TEXT, None)),
    ("18-first-and-last-line/bom.nhdr", Is(BOX, ONE, Plain, None)),
    ("18-first-and-last-line/d.raw", Other),
    ("18-first-and-last-line/old.nrrd", Is(BOX, ONE, Plain, None)),
    ("18-first-and-last-line/space.nrrd", Is(BOX, ONE, Plain, None)),
    ("19-spacing-signs/gz.nrrd", Is(BOX, FLAT, Plain, None)),
    ("19-spacing-signs/nanvector.nrrd", Is(BOX, FLAT, Plain, None)),
    ("19-spacing-signs/negative.nrrd", Is(BOX, FLAT, Plain, Some("negative spacing"))),
    ("19-spacing-signs/plain.nrrd", Is(BOX, FLAT, Plain, None)),
    ("20-trailing-bytes/members.nrrd", Is(BOX, ONE, Plain, None)),
    ("20-trailing-bytes/newline.nrrd", Is(BOX, ONE, Plain, Some("1 byte behind its data"))),
    ("20-trailing-bytes/plain.nrrd", Is(BOX, ONE, Plain, None)),
    ("20-trailing-bytes/short.nrrd", Refused(&["holds 119 bytes", "ask for 120"])),
    ("20-trailing-bytes/zeros.nrrd", Is(BOX, ONE, Plain, Some("512 bytes behind its gzip stream"))),
    ("21-long-header/frames.seq.nrrd", Other),
    ("22-raw-order-and-offset/big.raw", Other),
    ("22-raw-order-and-offset/head16.nhdr", Is(BOX, ONE, High, None)),
    ("22-raw-order-and-offset/head16.raw", Other),
    ("22-raw-order-and-offset/little.raw", Other),
    ("23-packed-or-piped/whole.nrrd.gz", Is(BOX, ONE, Plain, None)),
];

fn read(name: &str) -> depthleap::Result<Volume> {
    read::volume(&folder().join(name), None)
}

/// 120 bytes that most of the files hold.
fn plain() -> Vec<f64> {
    let bytes = std::fs::read(folder().join("18-first-and-last-line/d.raw")).unwrap();
    bytes.into_iter().map(f64::from).collect()
}

fn high(plain: &[f64]) -> Vec<f64> {
    plain.iter().map(|value| 256.0 * value).collect()
}

fn check(name: &str, right: &Right, plain: &[f64]) {
    let read = read(name);
    let (dims, spacing, order, warning) = match right {
        Is(dims, spacing, order, warning) => (dims, spacing, order, warning),
        Refused(parts) => {
            let message = read.unwrap_err().to_string();
            assert!(parts.iter().all(|part| message.contains(part)) && message.contains(name), "{name}: {message}");
            return;
        }
        Other => return,
    };
    let volume = read.unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!((&volume.dims, &volume.spacing, volume.turn), (dims, spacing, DQuat::IDENTITY), "{name}");
    let found = values(&volume);
    match order {
        Plain => assert_eq!(found, plain, "{name}"),
        By(place) => assert_eq!(found, (0..plain.len()).map(|i| plain[place(i)]).collect::<Vec<_>>(), "{name}"),
        High => assert_eq!(found, high(plain), "{name}"),
        Values(expected) => assert_eq!(found, *expected, "{name}"),
        Above(count, most) => {
            let above = found.iter().filter(|value| **value > 0.0);
            assert_eq!((above.clone().count(), above.fold(0.0, |a: f64, b| a.max(*b))), (*count, *most), "{name}");
        }
    }
    match warning {
        Some(told) => assert!(says(&volume.warnings, &[told]), "{name}: {:?}", volume.warnings),
        None => assert_eq!(volume.warnings, [""; 0], "{name}"),
    }
}

/// Whether the folder is there; where it is not, it is said that nothing was tested.
fn is_there() -> bool {
    let there = folder().is_dir();
    if !there {
        eprintln!("SKIPPED: {} is not there, so its files are NOT TESTED", folder().display());
    }
    there
}

/// Files below the folder, by their path from there; the README is none of them.
fn files() -> Vec<String> {
    let mut found = Vec::new();
    for group in std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()) {
        for file in std::fs::read_dir(&group).unwrap() {
            let path = file.unwrap().path();
            found.push(path.strip_prefix(folder()).unwrap().to_str().unwrap().to_owned());
        }
    }
    found.sort();
    found
}

#[test]
fn every_file_gives_what_is_right_for_it() {
    if !is_there() {
        return;
    }
    let known: Vec<&str> = RIGHT.iter().map(|(name, _)| *name).collect();
    assert_eq!(files(), known, "files and what is right for them");
    let plain = plain();
    RIGHT.iter().for_each(|(name, right)| check(name, right, &plain));
}

#[test]
fn files_that_lie_askew_are_plain_by_index() {
    if !is_there() {
        return;
    }
    for name in ["a", "b", "box", "c", "mirror", "permuted", "plain", "shear"] {
        let path = folder().join(format!("05-shear-and-mirror/{name}.nrrd"));
        let volume = read::volume_with(&path, None, &by_index()).unwrap();
        assert_eq!((volume.dims, values(&volume)), (BOX, plain()), "{name}");
    }
}

#[test]
fn numbers_that_are_none_are_read_from_text() {
    if is_there() {
        let written: Vec<String> =
            values(&read("17-text-numbers/nan.nrrd").unwrap()).iter().map(f64::to_string).collect();
        assert_eq!(written, ["1", "NaN", "-inf", "inf", "5", "6", "7", "8"]);
    }
}

#[test]
fn a_sequence_with_a_long_header_is_a_stack_or_one_picture() {
    if !is_there() {
        return;
    }
    const NAME: &str = "21-long-header/frames.seq.nrrd";
    let stack = read(NAME).unwrap();
    assert_eq!((stack.dims, stack.spacing, stack.warnings.len()), ([4, 4, 3000], ONE, 0));
    assert!(says(&stack.notes, &["3000 pictures", "--frame picks one"]), "{:?}", stack.notes);
    let whole = std::fs::read(folder().join(NAME)).unwrap();
    let data: Vec<f64> = whole[whole.len() - 48_000..].iter().copied().map(f64::from).collect();
    assert_eq!(values(&stack), data);
    let choice = ReadChoice { frame: Some(2999), ..ReadChoice::default() };
    let last = read::volume_with(&folder().join(NAME), None, &choice).unwrap();
    assert_eq!((last.dims, values(&last)), ([4, 4, 1], data[data.len() - 16..].to_vec()));
}

#[test]
fn raw_files_are_read_in_their_byte_order_and_behind_their_head() {
    if !is_there() {
        return;
    }
    let expected = high(&plain());
    for (name, big_endian, skip) in [
        ("big", true, ByteSkip::Bytes(0)),
        ("big", true, ByteSkip::ToTail),
        ("little", false, ByteSkip::Bytes(0)),
        ("head16", true, ByteSkip::Bytes(16)),
        ("head16", true, ByteSkip::ToTail),
    ] {
        let path = folder().join(format!("22-raw-order-and-offset/{name}.raw"));
        let layout = RawLayout { big_endian, skip, ..layout(BOX, VoxelType::U16) };
        assert_eq!(values(&read::volume(&path, Some(layout)).unwrap()), expected, "{name}");
    }
    let path = folder().join("22-raw-order-and-offset/head16.raw");
    let message = read::volume(&path, Some(layout(BOX, VoxelType::U16))).unwrap_err().to_string();
    assert!(["holds 256 bytes", "ask for 240", "--skip"].iter().all(|part| message.contains(part)), "{message}");
}

/// Opaque for the value 100 of a scale from 0 to 200 alone, which no label has.
#[test]
fn the_transfer_function_of_the_labels_shows_none_of_them() {
    if is_there() {
        let settings = TransferSettings { file: Some("12-labels-nearest/only100.json".into()), ..Default::default() };
        let transfer = read::transfer(&settings, &folder()).unwrap();
        assert_eq!([0.0, 0.5, 1.0].map(|x| transfer.evaluate(x)[3]), [0.0, 0.9, 0.0]);
    }
}
