//! gzip and bzip2: data in several members, damaged ones, ones that swell, and files that are packed as a whole.

use depthleap::read;
use depthleap::scene::volume::Voxels;

use crate::kit::{SMALL, bytes, bzip2, file, gzip, nrrd, read_as, read_nrrd, refusal, says};

type Pack = fn(&[u8]) -> Vec<u8>;

#[test]
fn members_are_read_one_after_another() {
    for (encoding, pack) in [("gzip", gzip as Pack), ("bzip2", bzip2)] {
        let lines = SMALL.replace("raw", encoding);
        for parts in [vec![&[1u8, 2][..], &[3, 4]], vec![&[1], &[], &[2, 3], &[4]], vec![&[], &[1, 2, 3, 4], &[]]] {
            let volume = read_nrrd(&lines, &parts.iter().flat_map(|part| pack(part)).collect::<Vec<_>>());
            assert_eq!((bytes(&volume), volume.warnings.len()), (&[1, 2, 3, 4][..], 0), "{encoding} {parts:?}");
        }
        let padded = [pack(&[1, 2]), pack(&[3, 4]), vec![0; 100]].concat();
        let volume = read_nrrd(&lines, &padded);
        assert_eq!(bytes(&volume), [1, 2, 3, 4]);
        assert!(says(&volume.warnings, &["100 bytes behind its", encoding]), "{:?}", volume.warnings);
        // Members that stand apart are not joined: nobody knows what stands between them.
        let apart = [pack(&[1, 2]), vec![0; 4], pack(&[3, 4])].concat();
        assert!(refusal(&nrrd(&lines, &apart)).contains("ends after 2 bytes"));
    }
}

#[test]
fn data_that_swell_past_their_sizes_are_told_of_and_not_kept() {
    // 100 MB in 100 kB, and in 100 bytes.
    for (encoding, bomb) in [("gzip", gzip(&vec![0; 100_000_000])), ("bzip2", bzip2(&vec![0; 100_000_000]))] {
        let volume = read_nrrd(&SMALL.replace("raw", encoding), &bomb);
        assert_eq!(bytes(&volume), [0; 4]);
        assert!(says(&volume.warnings, &["at least 67108864 bytes behind its data"]), "{:?}", volume.warnings);
    }
}

#[test]
fn packed_data_that_cannot_hold_the_sizes_are_refused_unread() {
    let lines = |encoding: &str| SMALL.replace("raw", encoding).replace("2 1 2", "99999 99999 9");
    for (encoding, data) in [("gzip", gzip(&[0; 64])), ("bzip2", bzip2(&[0; 64]))] {
        let message = refusal(&nrrd(&lines(encoding), &data));
        let parts = [&format!("holds {} bytes of {encoding} data, which cannot give", data.len()), "89998200009"];
        assert!(parts.iter().all(|part| message.contains(part)), "{message}");
    }
}

#[test]
fn a_wrong_checksum_is_refused() {
    for (encoding, data) in [("gzip", gzip(&[1, 2, 3, 4])), ("bzip2", bzip2(&[1, 2, 3, 4]))] {
        let mut wrong = nrrd(&SMALL.replace("raw", encoding), &data);
        let checksum = wrong.len() - 6;
        wrong[checksum] ^= 1;
        let message = refusal(&wrong);
        assert!(message.contains("cannot be read") && message.contains("make or fetch the file again"), "{message}");
    }
    let mut whole = gzip(&nrrd(SMALL, &[1, 2, 3, 4]));
    let checksum = whole.len() - 6;
    whole[checksum] ^= 1;
    refusal(&whole);
}

#[test]
fn a_file_packed_as_a_whole_is_known_by_its_bytes_not_its_name() {
    for name in ["x.nrrd.gz", "x.nrrd", "x.gz", "x.raw", "x", "x.png"] {
        let volume = read_as(name, &gzip(&nrrd(SMALL, &[1, 2, 3, 4]))).unwrap();
        assert_eq!((bytes(&volume), volume.warnings.len()), (&[1, 2, 3, 4][..], 0), "{name}");
    }
    let forms = [
        ("gzip", gzip(&[1, 2, 3, 4])),
        ("bzip2", bzip2(&[1, 2, 3, 4])),
        ("ascii", b"1,2,3,4".to_vec()),
        ("hex", b"01020304".to_vec()),
    ];
    for (encoding, data) in forms {
        let volume = read_as("x.nrrd.gz", &gzip(&nrrd(&SMALL.replace("raw", encoding), &data))).unwrap();
        assert_eq!((bytes(&volume), volume.warnings.len()), (&[1, 2, 3, 4][..], 0), "{encoding}");
    }
    let with_mark = [&[0xef, 0xbb, 0xbf], nrrd(SMALL, &[1, 2, 3, 4]).as_slice()].concat();
    assert_eq!(bytes(&read_as("x", &gzip(&with_mark)).unwrap()), [1, 2, 3, 4]);
    let members = nrrd(SMALL, &[1, 2, 3, 4]).chunks(3).flat_map(gzip).collect::<Vec<_>>();
    assert_eq!(bytes(&read_as("x", &members).unwrap()), [1, 2, 3, 4]);
}

#[test]
fn a_packed_header_names_files_as_any_other() {
    let header = format!("NRRD0001\n{SMALL}\ndata file: a.raw\n");
    let (folder, path) = file("a.nhdr.gz", &gzip(header.as_bytes()));
    std::fs::write(folder.path().join("a.raw"), [1, 2, 3, 4]).unwrap();
    assert_eq!(read::volume(&path, None).unwrap().voxels, Voxels::U8(vec![1, 2, 3, 4]));
}

#[test]
fn bytes_in_front_of_packed_data_are_skipped_unpacked_but_not_from_the_end() {
    for (encoding, data) in [("gzip", gzip(b"abc\x01\x02\x03\x04")), ("bzip2", bzip2(b"abc\x01\x02\x03\x04"))] {
        let lines = SMALL.replace("raw", encoding) + "\nbyte skip: 3";
        assert_eq!(bytes(&read_nrrd(&lines, &data)), [1, 2, 3, 4]);
    }
    let whole = gzip(&nrrd(&format!("{SMALL}\nbyte skip: 3"), b"abc\x01\x02\x03\x04"));
    assert_eq!(bytes(&read_as("x", &whole).unwrap()), [1, 2, 3, 4]);
    let whole = gzip(&nrrd(&format!("{SMALL}\nbyte skip: -1"), b"abc\x01\x02\x03\x04"));
    assert!(refusal(&whole).contains("`byte skip: -1` in a packed file"));
}
