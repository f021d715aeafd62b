//! Volume readers: what is written comes back, and nothing else is accepted.

use std::io::Write;
use std::path::PathBuf;

use depthleap::Result;
use depthleap::read::{self, ByteSkip, RawLayout};
use depthleap::scene::volume::{Volume, VoxelType, Voxels};
use flate2::{Compression, write::GzEncoder};
use tempfile::TempDir;

/// A folder of its own with a file in it.
fn file(name: &str, bytes: &[u8]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    (folder, path)
}

fn read_as(name: &str, bytes: &[u8]) -> Result<Volume> {
    let (_folder, path) = file(name, bytes);
    read::volume(&path, None)
}

/// The message of the error, which must come.
fn refusal(bytes: &[u8]) -> String {
    read_as("a.nrrd", bytes).unwrap_err().to_string()
}

/// An attached header of these lines, then the data.
fn nrrd(lines: &str, data: &[u8]) -> Vec<u8> {
    [b"NRRD0004\n", lines.as_bytes(), b"\n\n", data].concat()
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// A 2x1x2 volume of bytes.
const SMALL: &str = "type: uchar\ndimension: 3\nsizes: 2 1 2\nencoding: raw";

struct Sample {
    voxels: Voxels,
    name: &'static str,
    little: Vec<u8>,
    big: Vec<u8>,
    text: String,
}

/// Twelve numbers of each type, with its extremes.
fn samples() -> Vec<Sample> {
    macro_rules! sample {
        ($variant:ident, $type:ty, $name:literal) => {{
            let mut v: Vec<$type> = (0..12u8).map(|i| <$type>::try_from(7 * i).unwrap()).collect();
            (v[0], v[11]) = (<$type>::MIN, <$type>::MAX);
            Sample {
                name: $name,
                little: v.iter().flat_map(|n| n.to_le_bytes()).collect(),
                big: v.iter().flat_map(|n| n.to_be_bytes()).collect(),
                text: v.iter().map(|n| n.to_string()).collect::<Vec<_>>().join(" "),
                voxels: Voxels::$variant(v),
            }
        }};
    }
    vec![
        sample!(U8, u8, "unsigned char"),
        sample!(I8, i8, "signed char"),
        sample!(U16, u16, "ushort"),
        sample!(I16, i16, "short int"),
        sample!(U32, u32, "uint32_t"),
        sample!(I32, i32, "int"),
        sample!(F32, f32, "float"),
        sample!(F64, f64, "double"),
    ]
}

#[test]
fn every_type_byte_order_and_encoding_round_trips_attached_and_detached() {
    let forms =
        [("raw", "little"), ("raw", "big"), ("gzip", "little"), ("gz", "big"), ("ascii", "little"), ("txt", "big")];
    for (sample, (encoding, endian)) in samples().iter().flat_map(|s| forms.map(|form| (s, form))) {
        let bytes = if endian == "big" { &sample.big } else { &sample.little };
        let data = match encoding {
            "raw" => bytes.clone(),
            "gzip" | "gz" => gzip(bytes),
            _ => sample.text.clone().into_bytes(),
        };
        let lines =
            format!("type: {}\ndimension: 3\nsizes: 2 3 2\nencoding: {encoding}\nendian: {endian}", sample.name);
        let attached = read_as("a.nrrd", &nrrd(&lines, &data)).unwrap();
        assert_eq!((attached.dims, &attached.voxels), ([2, 3, 2], &sample.voxels), "{lines}");
        let (folder, header) = file("a.nhdr", format!("NRRD0001\n{lines}\ndata file: a.data\n").as_bytes());
        std::fs::write(folder.path().join("a.data"), &data).unwrap();
        assert_eq!(read::volume(&header, None).unwrap().voxels, sample.voxels, "{lines}");
    }
}

#[test]
fn every_version_and_every_spelling_of_a_type_is_read() {
    let spellings: [(VoxelType, &[&str]); 8] = [
        (VoxelType::I8, &["signed char", "int8", "int8_t"]),
        (VoxelType::U8, &["uchar", "unsigned char", "uint8", "uint8_t"]),
        (VoxelType::I16, &["short", "short int", "signed short", "signed short int", "int16", "int16_t"]),
        (VoxelType::U16, &["ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"]),
        (VoxelType::I32, &["int", "signed int", "int32", "int32_t"]),
        (VoxelType::U32, &["uint", "unsigned int", "uint32", "uint32_t"]),
        (VoxelType::F32, &["float", "FLOAT"]),
        (VoxelType::F64, &["double"]),
    ];
    for version in 1..=5 {
        for (voxel_type, names) in spellings {
            for name in names {
                let lines = format!("type: {name}\ndimension: 3\nsizes: 1 1 1\nencoding: raw\nendian: little\n\n");
                let bytes = [format!("NRRD000{version}\n{lines}").as_bytes(), &vec![0; voxel_type.bytes()]].concat();
                assert_eq!(read_as("a.nrrd", &bytes).unwrap().voxels.voxel_type(), voxel_type, "{name}");
            }
        }
    }
}

#[test]
fn raw_files_round_trip_in_both_byte_orders() {
    for sample in samples() {
        for (big_endian, bytes) in [(false, &sample.little), (true, &sample.big)] {
            let (dims, spacing) = ([3, 2, 2], [1.0, 2.0, 3.0]);
            let layout = RawLayout {
                dims,
                voxel_type: sample.voxels.voxel_type(),
                spacing,
                big_endian,
                skip: ByteSkip::Bytes(0),
            };
            let (_folder, path) = file("a.raw", bytes);
            let volume = read::volume(&path, Some(layout)).unwrap();
            assert_eq!((volume.dims, volume.spacing, &volume.voxels), (dims, spacing, &sample.voxels));
        }
    }
}

#[test]
fn raw_file_too_short_or_too_long_names_both_lengths() {
    let layout = RawLayout {
        dims: [2, 2, 2],
        voxel_type: VoxelType::U16,
        spacing: [1.0; 3],
        big_endian: false,
        skip: ByteSkip::Bytes(0),
    };
    for length in (0..40).filter(|n| *n != 16) {
        let (_folder, path) = file("a.raw", &vec![7; length]);
        let message = read::volume(&path, Some(layout)).unwrap_err().to_string();
        assert!(message.contains(&format!("holds {length} bytes")) && message.contains("ask for 16"), "{message}");
    }
}

#[test]
fn raw_sizes_that_overflow_or_are_zero_are_refused() {
    for dims in [[usize::MAX; 3], [1 << 21; 3], [1 << 20; 3], [0, 1, 1]] {
        let layout = RawLayout {
            dims,
            voxel_type: VoxelType::F64,
            spacing: [1.0; 3],
            big_endian: false,
            skip: ByteSkip::Bytes(0),
        };
        for bytes in [vec![], vec![0; 8]] {
            let (_folder, path) = file("a.raw", &bytes);
            read::volume(&path, Some(layout)).unwrap_err();
        }
    }
}

#[test]
fn every_truncation_of_a_file_is_refused() {
    let bytes: Vec<u8> = (0..4).collect();
    let text = SMALL.replace("raw", "ascii");
    for whole in [nrrd(SMALL, &bytes), nrrd(&SMALL.replace("raw", "gzip"), &gzip(&bytes)), nrrd(&text, b"0 1 2 3")] {
        assert_eq!(read_as("a.nrrd", &whole).unwrap().voxels, Voxels::U8(bytes.clone()));
        for length in 0..whole.len() {
            assert!(read_as("a.nrrd", &whole[..length]).is_err(), "accepted {length} of {} bytes", whole.len());
        }
    }
}

#[test]
fn every_truncation_of_detached_data_is_refused() {
    let (folder, header) = file("a.nhdr", format!("NRRD0001\n{SMALL}\ndata file: a.raw\n").as_bytes());
    for length in 0..4 {
        std::fs::write(folder.path().join("a.raw"), vec![0; length]).unwrap();
        let message = read::volume(&header, None).unwrap_err().to_string();
        assert!(message.contains("a.raw: ") && message.contains("ask for 4"), "{message}");
    }
}

#[test]
fn extra_bytes_are_refused() {
    let with = |encoding: &str, data: &[u8]| refusal(&nrrd(&SMALL.replace("raw", encoding), data));
    assert!(with("raw", &[0; 5]).contains("holds 5 bytes"));
    assert!(with("gzip", &gzip(&[0; 5])).contains("goes on after the last voxel"));
    with("gzip", &[gzip(&[0; 4]), vec![1, 2, 3]].concat());
    assert!(with("ascii", b"1 2 3 4 5").contains("5 numbers"));
}

#[test]
fn wrong_magic_is_refused_with_what_stands_there() {
    assert!(refusal(b"NRRD0009\ntype: uchar\n\n").contains("NRRD0009"));
    assert!(refusal(b"P5 12 12").contains("P5 12 12"));
    let unknown = read_as("a.xyz", b"hello").unwrap_err().to_string();
    assert!(unknown.contains("no known volume format") && unknown.contains(".nrrd"), "{unknown}");
}

#[test]
fn huge_sizes_are_refused_before_anything_is_allocated() {
    for sizes in
        ["4294967295 4294967295 4294967295", "1048576 1048576 1048576", "99999 99999 9", "99999999999999999999 1 1"]
    {
        for encoding in ["raw", "gzip", "ascii"] {
            let lines = format!("type: double\nendian: little\ndimension: 3\nsizes: {sizes}\nencoding: {encoding}");
            let data = if encoding == "ascii" { b"1 2 3".to_vec() } else { gzip(&[0; 64]) };
            let message = refusal(&nrrd(&lines, &data));
            assert!(["overflow", "ask for", "no number"].iter().any(|m| message.contains(m)), "{message}");
        }
    }
}

#[test]
fn gzip_that_swells_past_its_sizes_is_stopped() {
    let bomb = gzip(&vec![0; 50_000_000]);
    assert!(refusal(&nrrd(&SMALL.replace("raw", "gzip"), &bomb)).contains("goes on after the last voxel"));
}

#[test]
fn gzip_with_a_wrong_checksum_is_refused() {
    let mut wrong = nrrd(&SMALL.replace("raw", "gzip"), &gzip(&[1, 2, 3, 4]));
    let checksum = wrong.len() - 6;
    wrong[checksum] ^= 1;
    assert!(refusal(&wrong).contains("cannot be read"));
}

#[test]
fn lying_headers_are_refused_by_name() {
    for (from, to, named) in [
        ("sizes: 2 1 2", "sizes: 2 1", "sizes"),
        ("sizes: 2 1 2", "sizes: 2 1 2 1", "sizes"),
        ("sizes: 2 1 2", "sizes: 0 1 2", "at least 1"),
        ("sizes: 2 1 2", "sizes: -2 1 2", "`-2`"),
        ("sizes: 2 1 2", "content: none", "sizes: is missing"),
        ("dimension: 3", "dimension: 2", "3 axes"),
        ("dimension: 3\nsizes: 2 1 2", "dimension: 4\nsizes: 2 2 1 1", "the first 1"),
        ("uchar", "char", "`char`"),
        ("uchar", "int64", "`int64`"),
        ("uchar", "ushort", "endian: is missing"),
        ("uchar", "ushort\nendian: middle", "`middle`"),
        ("raw", "bzip2", "raw, gzip, ascii"),
        ("raw", "raw\nspacing: 1 1 1", "did you mean `spacings`"),
        ("raw", "raw\ntype: uchar", "given twice"),
        ("raw", "raw\nwhat is this", "no line of an NRRD header"),
        ("raw", "raw\ndata file: LIST", "several files"),
        ("raw", "raw\ndatafile: slice%03d.raw 1 10 1", "several files"),
        ("raw", "raw\ndata file: absent.raw", "absent.raw"),
        ("raw", "raw\ndata file: .", "not a regular file"),
        ("raw", "raw\nspacings: 1 0 1", "axis 1 is 0"),
        ("raw", "raw\nspacings: 1 inf 1", "axis 1 is inf"),
        ("raw", "raw\nspacings: 1 1", "2 entries"),
        ("raw", "raw\nspacings: 1e-300 1 1", "sides"),
        ("raw", "raw\nspace directions: (1,0,0) (0,1,0) (0,0,0)", "axis 2 is 0"),
        ("raw", "raw\nspace directions: (1,0,0) (0,1", "space directions"),
        ("raw", "raw\nbyte skip: 5", "byte skip"),
        ("raw", "raw\nbyte skip: -2", "`-2`"),
        ("raw", "raw\nline skip: 9999999999999", "line skip"),
        ("raw", "gzip\nbyte skip: -1", "encoding: raw"),
        ("raw", "ascii", "numbers"),
    ] {
        let message = refusal(&nrrd(&SMALL.replace(from, to), &[0; 4]));
        assert!(message.contains(named), "{to}: {message}");
    }
}

#[test]
fn a_header_without_end_is_refused() {
    assert!(refusal(&[b"NRRD0001\n".to_vec(), vec![b'#'; 3 << 20]].concat()).contains("header of more than"));
}

#[test]
fn text_that_is_no_number_of_the_type_is_named() {
    let message = refusal(&nrrd(&SMALL.replace("raw", "text"), b"1 2 256 4"));
    assert!(message.contains("`256` for number 2") && message.contains("u8"), "{message}");
}

#[test]
fn random_bytes_and_random_damage_never_panic() {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut random = || {
        // xorshift64
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state
    };
    let (_folder, path) = file("a.nrrd", &[]);
    let whole = nrrd(&format!("{SMALL}\nspacings: 1 2 3\nspace directions: (1,0,0) none (0,0,1)"), &[1, 2, 3, 4]);
    for i in 0..900 {
        let mut noise: Vec<u8> = (0..random() % 300).map(|_| random() as u8).collect();
        let mut bytes = match i % 3 {
            0 => noise,
            1 => {
                noise.splice(0..0, *b"NRRD0001\n");
                noise
            }
            _ => whole.clone(),
        };
        for _ in 0..random() % 8 {
            let at = (random() % 256) as usize;
            if let Some(byte) = bytes.get_mut(at) {
                *byte = random() as u8;
            }
        }
        std::fs::write(&path, &bytes).unwrap();
        let _ = read::volume(&path, None);
        let _ = read::settings(&path);
        let _ = read::settings_from_json(&path);
    }
}

#[test]
fn spacings_count_and_nan_is_one() {
    let volume = read_as("a.nrrd", &nrrd(&format!("{SMALL}\nspacings: 0.5 NaN 2"), &[0; 4])).unwrap();
    assert_eq!(volume.spacing, [0.5, 1.0, 2.0]);
}

#[test]
fn space_directions_give_their_lengths() {
    let lines = format!("{SMALL}\nspace: left-posterior-superior\nspace directions: (3,4,0) (0, -2, 0) (0,0,0.5)");
    assert_eq!(read_as("a.nrrd", &nrrd(&lines, &[0; 4])).unwrap().spacing, [5.0, 2.0, 0.5]);
}

#[test]
fn a_leading_axis_of_one_entry_is_left_out() {
    let lines = SMALL.replace("dimension: 3\nsizes: 2 1 2", "dimension: 4\nsizes: 1 2 1 2")
        + "\nspace directions: none (2,0,0) (0,3,0) (0,0,4)\nspacings: nan nan nan nan";
    let volume = read_as("a.nrrd", &nrrd(&lines, &[1, 2, 3, 4])).unwrap();
    assert_eq!((volume.dims, volume.spacing), ([2, 1, 2], [2.0, 3.0, 4.0]));
}

#[test]
fn comments_keys_and_line_ends_of_any_system_are_accepted() {
    let lines = format!("# a comment: here\n{SMALL}\nkey:=value: with := marks\ncontent:\nKinds: domain domain domain");
    let header = String::from_utf8(nrrd(&lines, &[])).unwrap().replace('\n', "\r\n");
    let volume = read_as("a.nrrd", &[header.as_bytes(), b"\n\r\n#"].concat()).unwrap();
    assert_eq!(volume.voxels, Voxels::U8(b"\n\r\n#".to_vec()));
}

#[test]
fn bytes_and_lines_before_the_data_are_skipped() {
    let with =
        |fields: &str, data: &[u8]| read_as("a.nrrd", &nrrd(&format!("{SMALL}\n{fields}"), data)).unwrap().voxels;
    let expected = Voxels::U8(vec![1, 2, 3, 4]);
    assert_eq!(with("byte skip: 3", b"abc\x01\x02\x03\x04"), expected);
    assert_eq!(with("byteskip: -1", b"whatever\x01\x02\x03\x04"), expected);
    assert_eq!(with("line skip: 2", b"P5\n2 2\n\x01\x02\x03\x04"), expected);
    assert_eq!(with("lineskip: 1\nbyte skip: 1", b"P5\n-\x01\x02\x03\x04"), expected);
    let lines = SMALL.replace("raw", "gzip") + "\nbyte skip: 3";
    assert_eq!(read_as("a.nrrd", &nrrd(&lines, &gzip(b"abc\x01\x02\x03\x04"))).unwrap().voxels, expected);
}

#[test]
fn a_layout_for_a_file_that_says_its_own_is_refused() {
    let (_folder, path) = file("a.nrrd", &nrrd(SMALL, &[0; 4]));
    let layout = RawLayout {
        dims: [2, 1, 2],
        voxel_type: VoxelType::U8,
        spacing: [1.0; 3],
        big_endian: false,
        skip: ByteSkip::Bytes(0),
    };
    assert!(read::volume(&path, Some(layout)).unwrap_err().to_string().contains("leave out dims"));
}
