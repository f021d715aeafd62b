//! Damaged NRRD files, their data attached, and in files of a list or a pattern.

use std::io::Write;
use std::path::Path;

use depthleap::read::{self, ReadChoice};
use depthleap::scene::settings::{Component, Orientation};

use crate::damage::{Numbers, damaged, each, folder};
use crate::{INPUTS, is_fit};

const FRONT: &str = "NRRD0005\n# a comment\ntype: unsigned char\ndimension: 3\nsizes: 4 3 2\n";
const FOUR: &str = "NRRD0004\ntype: uint8\ndimension: 4\nsizes: 2 3 2 2\n";

/// Fields that say much of the axes; the first of three, the second of four.
const AXES: [[&str; 2]; 4] = [
    ["spacings: 1 2 0.5\nbyte skip: 0\nline skip: 0\n", "spacings: nan 1 2 3\nkinds: vector domain domain domain\n"],
    [
        "space: left-posterior-superior\nspace directions: (0,1,0) (0.6,0,-0.8) (0.8,0,0.6)\n",
        "space directions: none (1,0,0) (0,-1,0) (0,0,2)\nspace origin: (0,0,0)\n",
    ],
    ["axis mins: 0 0 0\naxis maxs: 4 3 2\ncenters: cell node ???\n", "kinds: space space space time\n"],
    ["kinds: domain domain list\nkey: with a colon:=value\n", "kinds: domain domain domain RGB-color\ncontent: c\n"],
];

fn packed(encoding: &str) -> Vec<u8> {
    let bytes = [7; 24];
    match encoding {
        "gzip" => {
            let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
            encoder.write_all(&bytes).unwrap();
            encoder.finish().unwrap()
        }
        "bzip2" => {
            let mut encoder = bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::fast());
            encoder.write_all(&bytes).unwrap();
            encoder.finish().unwrap()
        }
        "ascii" => b"7, 7 ".repeat(12),
        "hex" => b"07".repeat(24),
        _ => bytes.to_vec(),
    }
}

/// A file and what has to be chosen of it.
type Form = (Vec<u8>, ReadChoice<'static>);

/// Every form of an attached file; each holds 24 bytes. bzip2 is rare: its blocks take a megabyte to begin with.
fn attached() -> Vec<Form> {
    let mut files = Vec::new();
    for (encoding, often) in [("raw", 6), ("gzip", 2), ("ascii", 3), ("hex", 3), ("bzip2", 1)] {
        for axes in AXES.iter().cycle().take(4 * often) {
            for (front, axes) in [FRONT, FOUR].into_iter().zip(axes) {
                let header = format!("{front}{axes}encoding: {encoding}\n\n");
                let (four, time) = (front == FOUR, axes.contains("time"));
                let component = (four && !time).then_some(Component::Number(1));
                let choice = ReadChoice { component, frame: (four && time).then_some(1), ..ReadChoice::default() };
                let file = [header.as_bytes(), &packed(encoding)].concat();
                assert!(is_right(&file, &choice), "{header}");
                files.push((file, choice));
            }
        }
    }
    files
}

/// What is not damaged has to be read.
fn is_right(file: &[u8], choice: &ReadChoice) -> bool {
    let folder = folder();
    std::fs::write(folder.path().join("a.nrrd"), file).unwrap();
    read::volume_with(&folder.path().join("a.nrrd"), None, choice).is_ok()
}

/// Mostly what is right for the file.
fn chosen(right: &ReadChoice<'static>, numbers: &mut Numbers) -> ReadChoice<'static> {
    let mut choice = *right;
    match numbers.below(16) {
        0 => choice.component = Some(Component::Luminance),
        1 => choice.component = Some(Component::Magnitude),
        2 => choice.component = Some(Component::Number(*numbers.pick(&[0, 1, 2, usize::MAX]))),
        3 => choice.frame = Some(*numbers.pick(&[0, 1, 2, usize::MAX])),
        4 => choice = ReadChoice::default(),
        _ => {}
    }
    choice.orientation = *numbers.pick(&[Orientation::File, Orientation::Index]);
    choice
}

/// Whether the file was read; what was read is whole, and what was refused is named.
fn is_read(path: &Path, named: &str, choice: &ReadChoice) -> bool {
    match read::volume_with(path, None, choice) {
        Ok(volume) => {
            assert_eq!(volume.voxels.len(), volume.dims.iter().product::<usize>());
            assert!(volume.turn.is_normalized() && volume.spacing.iter().all(|s| s.is_finite() && *s > 0.0));
            true
        }
        Err(error) => {
            is_fit(&error, named);
            false
        }
    }
}

#[test]
fn attached_nrrd_files() {
    let files = attached();
    let read = each(
        6,
        INPUTS,
        |_| {},
        |folder, numbers| {
            let path = folder.join("a.nrrd");
            let (file, choice) = numbers.pick(&files);
            std::fs::write(&path, damaged(file, numbers)).unwrap();
            is_read(&path, "a.nrrd", &chosen(choice, numbers))
        },
    );
    assert!((INPUTS / 25..INPUTS - INPUTS / 25).contains(&read), "{read} of {INPUTS} volumes were read");
}

#[test]
fn attached_nrrd_files_in_gzip() {
    let files = attached();
    let read = each(
        7,
        INPUTS / 10,
        |_| {},
        |folder, numbers| {
            let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
            let (file, choice) = numbers.pick(&files);
            encoder.write_all(&damaged(file, numbers)).unwrap();
            let whole = encoder.finish().unwrap();
            let whole = if numbers.below(2) == 0 { damaged(&whole, numbers) } else { whole };
            std::fs::write(folder.join("a.nrrd"), whole).unwrap();
            is_read(&folder.join("a.nrrd"), "a.nrrd", &chosen(choice, numbers))
        },
    );
    assert!(read > INPUTS / 400, "{read} of {} volumes were read", INPUTS / 10);
}

#[test]
fn detached_nrrd_files() {
    const ENDS: [&str; 5] = [
        "data file: LIST\ns0\ns1\n",
        "data file: LIST 2\ns1\ns0\n",
        "data file: s%d 0 1 1\n",
        "data file: s%01d 1 0 -1 2\n",
        "data file: whole\n",
    ];
    let files: Vec<String> =
        ENDS.iter().flat_map(|end| AXES.map(|axes| format!("{FRONT}{}encoding: raw\n{end}", axes[0]))).collect();
    let prepare = |folder: &Path| {
        for (name, length) in [("s0", 12), ("s1", 12), ("whole", 24)] {
            std::fs::write(folder.join(name), vec![7; length]).unwrap();
        }
    };
    let read = each(8, INPUTS, prepare, |folder, numbers| {
        let path = folder.join("a.nhdr");
        let file = numbers.pick(&files);
        std::fs::write(&path, damaged(file.as_bytes(), numbers)).unwrap();
        is_read(&path, "", &chosen(&ReadChoice::default(), numbers))
    });
    assert!((INPUTS / 25..INPUTS - INPUTS / 25).contains(&read), "{read} of {INPUTS} volumes were read");
}

/// Bytes that nobody wrote, also behind the beginning of a file.
#[test]
fn noise() {
    each(
        9,
        INPUTS / 5,
        |_| {},
        |folder, numbers| {
            let path = folder.join("a.nrrd");
            let mut bytes = numbers.pick(&[&b""[..], b"NRRD0001\n", b"\x1f\x8b\x08", FRONT.as_bytes()]).to_vec();
            bytes.extend((0..numbers.below(300)).map(|_| numbers.below(256) as u8).collect::<Vec<_>>());
            std::fs::write(&path, &bytes).unwrap();
            is_read(&path, "a.nrrd", &ReadChoice::default())
        },
    );
}
