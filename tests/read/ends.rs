//! Where data end: too short is refused with both lengths, what lies behind is told in a warning.

use depthleap::read;
use depthleap::scene::volume::Voxels;

use crate::kit::{SMALL, bytes, bzip2, file, gzip, nrrd, read_as, read_nrrd, refusal, says};

fn encoded(encoding: &str) -> String {
    SMALL.replace("raw", encoding)
}

#[test]
fn every_truncation_of_a_file_is_refused() {
    let data: Vec<u8> = (0..4).collect();
    let forms = [
        nrrd(SMALL, &data),
        nrrd(&encoded("gzip"), &gzip(&data)),
        nrrd(&encoded("bzip2"), &bzip2(&data)),
        nrrd(&encoded("ascii"), b"0 1 2 3"),
        nrrd(&encoded("hex"), b"00010203"),
        gzip(&nrrd(SMALL, &data)),
    ];
    for whole in forms {
        assert_eq!(read_as("a.nrrd", &whole).unwrap().voxels, Voxels::U8(data.clone()));
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
        let parts = ["a.raw: ", &format!("holds {length} bytes"), "sizes 2 1 2 of type u8 ask for 4"];
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
}

#[test]
fn short_data_are_refused_with_both_lengths() {
    let raw = nrrd(SMALL, &[1, 2, 3]);
    for (whole, found) in [
        (raw.clone(), "holds 3 bytes"),
        (gzip(&raw), "ends after 3 bytes"),
        (nrrd(&encoded("gzip"), &gzip(&[1, 2, 3])), "ends after 3 bytes"),
        (nrrd(&encoded("bzip2"), &bzip2(&[1, 2, 3])), "ends after 3 bytes"),
        (nrrd(&encoded("ascii"), b"1 2 3"), "holds 3 numbers"),
        (nrrd(&encoded("hex"), b"01 02 03"), "ends after 3 bytes"),
        (nrrd(&encoded("hex"), b"01 02 03 0"), "ends after 3 bytes"),
    ] {
        let message = refusal(&whole);
        assert!(message.contains(found) && message.contains("ask for 4"), "{message}");
    }
}

#[test]
fn what_lies_behind_the_data_is_counted_in_a_warning() {
    let four = [1, 2, 3, 4];
    let with = |encoding: &str, data: Vec<u8>| read_nrrd(&encoded(encoding), &data);
    let raw = |behind: &[u8]| nrrd(SMALL, &[&four, behind].concat());
    for (volume, told) in [
        (with("raw", [&four[..], b"\n"].concat()), "1 byte behind its data"),
        (with("raw", vec![1, 2, 3, 4, 5, 6, 7]), "3 bytes behind its data"),
        (with("gzip", gzip(&[1, 2, 3, 4, 5])), "1 byte behind its data, unpacked"),
        (with("gzip", [gzip(&four), vec![0; 512]].concat()), "512 bytes behind its gzip stream"),
        (with("gzip", [gzip(&four), vec![0x1f, 0x8b, 3]].concat()), "3 bytes behind its gzip stream"),
        (with("gzip", [gzip(&four), b"trailer".to_vec()].concat()), "7 bytes behind its gzip stream"),
        (with("bzip2", bzip2(&[1, 2, 3, 4, 5])), "1 byte behind its data, unpacked"),
        (with("bzip2", [bzip2(&four), vec![0; 512]].concat()), "512 bytes behind its bzip2 stream"),
        (with("bzip2", [bzip2(&four), b"BZ".to_vec()].concat()), "2 bytes behind its bzip2 stream"),
        (with("ascii", b"1 2 3 4 5 six".to_vec()), "2 more numbers than its data has"),
        (with("hex", b"01 02 03 04 05 0".to_vec()), "2 bytes behind its data"),
        (with("hex", b"01020304 is all".to_vec()), "3 bytes behind its data"),
        (read_as("a.nrrd", &gzip(&raw(&[9, 9]))).unwrap(), "2 bytes behind its data"),
        (read_as("a.nrrd", &[gzip(&raw(&[])), vec![0; 77]].concat()).unwrap(), "77 bytes behind what gzip packed"),
    ] {
        assert_eq!((bytes(&volume), volume.warnings.len()), (&four[..], 1), "{told}: {:?}", volume.warnings);
        assert!(says(&volume.warnings, &["a.nrrd holds ", told, "which is not read"]), "{told}: {:?}", volume.warnings);
    }
}

#[test]
fn both_ends_behind_packed_data_are_told() {
    let data = [gzip(&[1, 2, 3, 4, 5]), vec![0; 9]].concat();
    let volume = read_nrrd(&encoded("gzip"), &data);
    let told = "1 byte behind its data, unpacked and 9 bytes behind its gzip stream";
    assert!(says(&volume.warnings, &[told]), "{:?}", volume.warnings);
}

#[test]
fn data_that_end_where_they_should_are_read_without_a_word() {
    for (encoding, data) in [
        ("raw", vec![1, 2, 3, 4]),
        ("gzip", gzip(&[1, 2, 3, 4])),
        ("bzip2", bzip2(&[1, 2, 3, 4])),
        ("ascii", b"1 2 3 4\n".to_vec()),
        ("hex", b"01020304\n\n".to_vec()),
    ] {
        let volume = read_nrrd(&encoded(encoding), &data);
        assert_eq!((volume.warnings, volume.notes), (Vec::new(), Vec::new()), "{encoding}");
    }
}
