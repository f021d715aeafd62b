//! Every type, byte order and encoding of voxels.

use depthleap::read::{self, RawLayout};
use depthleap::scene::volume::{VoxelType, Voxels};

use crate::kit::{bzip2, file, gzip, layout, nrrd, read_as, read_nrrd, says};

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
        sample!(U64, u64, "unsigned long long int"),
        sample!(I64, i64, "int64"),
        sample!(F32, f32, "float"),
        sample!(F64, f64, "double"),
    ]
}

/// As hexadecimal digits of both cases, with white space between them and within a pair.
fn hex(bytes: &[u8]) -> Vec<u8> {
    let pair = |(i, b): (usize, &u8)| match i % 4 {
        0 => format!("{b:02x}"),
        1 => format!("{b:02X} "),
        2 => format!("\n{:X}\t{:x}", b >> 4, b & 15),
        _ => format!("{b:02X}\r\n"),
    };
    bytes.iter().enumerate().map(pair).collect::<String>().into_bytes()
}

#[test]
fn every_type_byte_order_and_encoding_round_trips_attached_and_detached() {
    for sample in samples() {
        for (encoding, endian) in ["raw", "gzip", "gz", "bzip2", "bz2", "hex", "ascii", "text", "TXT"]
            .into_iter()
            .flat_map(|encoding| ["little", "big"].map(|endian| (encoding, endian)))
        {
            let bytes = if endian == "big" { &sample.big } else { &sample.little };
            let data = match encoding {
                "raw" => bytes.clone(),
                "gzip" | "gz" => gzip(bytes),
                "bzip2" | "bz2" => bzip2(bytes),
                "hex" => hex(bytes),
                _ => sample.text.clone().into_bytes(),
            };
            let lines =
                format!("type: {}\ndimension: 3\nsizes: 2 3 2\nencoding: {encoding}\nendian: {endian}", sample.name);
            let attached = read_nrrd(&lines, &data);
            assert_eq!((attached.dims, &attached.voxels), ([2, 3, 2], &sample.voxels), "{lines}");
            let (folder, header) = file("a.nhdr", format!("NRRD0001\n{lines}\ndata file: a.data\n").as_bytes());
            std::fs::write(folder.path().join("a.data"), &data).unwrap();
            assert_eq!(read::volume(&header, None).unwrap().voxels, sample.voxels, "{lines}");
        }
    }
}

#[test]
fn every_version_and_every_spelling_of_a_type_is_read() {
    let spellings: [(VoxelType, &[&str]); 10] = [
        (VoxelType::I8, &["signed char", "int8", "int8_t"]),
        (VoxelType::U8, &["uchar", "unsigned char", "uint8", "uint8_t"]),
        (VoxelType::I16, &["short", "short int", "signed short", "signed short int", "int16", "int16_t"]),
        (VoxelType::U16, &["ushort", "unsigned short", "unsigned short int", "uint16", "uint16_t"]),
        (VoxelType::I32, &["int", "signed int", "int32", "int32_t"]),
        (VoxelType::U32, &["uint", "unsigned int", "uint32", "uint32_t"]),
        (
            VoxelType::I64,
            &["longlong", "long long", "long long int", "signed long long", "signed long long int", "int64", "int64_t"],
        ),
        (VoxelType::U64, &["ulonglong", "unsigned long long", "unsigned long long int", "uint64", "uint64_t"]),
        (VoxelType::F32, &["float", "FLOAT"]),
        (VoxelType::F64, &["double"]),
    ];
    for magic in ["NRRD00.01", "NRRD0001", "NRRD0002", "NRRD0003", "NRRD0004", "NRRD0005", "NRRD0004 "] {
        for (voxel_type, names) in spellings {
            for name in names {
                let lines = format!("type: {name}\ndimension: 3\nsizes: 1 1 1\nencoding: raw\nendian: little\n\n");
                let bytes = [format!("{magic}\n{lines}").as_bytes(), &vec![0; voxel_type.bytes()]].concat();
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
            let layout = RawLayout { spacing, big_endian, ..layout(dims, sample.voxels.voxel_type()) };
            let (_folder, path) = file("a.raw", bytes);
            let volume = read::volume(&path, Some(layout)).unwrap();
            assert_eq!((volume.dims, volume.spacing, &volume.voxels), (dims, spacing, &sample.voxels));
        }
    }
}

#[test]
fn integers_that_f64_rounds_are_counted_in_a_warning() {
    const FIRST_ROUNDED: i64 = (1 << 53) + 1;
    let signed = [0, -1, 1 << 53, FIRST_ROUNDED, -FIRST_ROUNDED, 1 << 62, i64::MIN, i64::MAX];
    let unsigned: [u64; 8] = [0, 1, 1 << 53, FIRST_ROUNDED as u64, 1 << 63, u64::MAX, u64::MAX - 1, 3];
    let lines = |name: &str| format!("type: {name}\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: big");
    let data: [(Vec<u8>, &str); 2] = [
        (signed.iter().flat_map(|n| n.to_be_bytes()).collect(), "int64"),
        (unsigned.iter().flat_map(|n| n.to_be_bytes()).collect(), "uint64"),
    ];
    for (data, name) in &data {
        let volume = read_nrrd(&lines(name), data);
        assert!(says(&volume.warnings, &["3 voxels", "2^53"]), "{name}: {:?}", volume.warnings);
        assert_eq!(volume.warnings.len(), 1);
        let (_folder, path) = file("a.raw", data);
        let raw = RawLayout { big_endian: true, ..layout([2; 3], volume.voxels.voxel_type()) };
        let raw = read::volume(&path, Some(raw)).unwrap();
        assert_eq!((raw.voxels, raw.warnings), (volume.voxels, volume.warnings));
    }
    let exact = read_nrrd(&lines("int64"), &[0i64, 1, 2, 3, 4, 5, 1 << 53, -(1 << 53)].map(i64::to_be_bytes).concat());
    assert_eq!(exact.warnings, [""; 0]);
}

#[test]
fn voxels_of_a_byte_and_text_need_no_byte_order() {
    read_as("a.nrrd", &nrrd("type: int8\ndimension: 3\nsizes: 1 1 1\nencoding: hex", b"7f")).unwrap();
    read_as("a.nrrd", &nrrd("type: double\ndimension: 3\nsizes: 1 1 1\nencoding: txt", b"7")).unwrap();
}
