//! The lines of a header: comments, keys, line ends, what begins it and what ends it, and how long it may be.

use std::fmt::Write;

use depthleap::read;
use depthleap::scene::volume::Voxels;

use crate::kit::{SMALL, bytes, file, gzip, nrrd, read_as, read_nrrd, refusal};

#[test]
fn comments_keys_and_line_ends_of_any_system_are_accepted() {
    let lines = format!("# a comment: here\n{SMALL}\nkey:=value: with := marks\ncontent:\nKinds: domain domain domain");
    let header = String::from_utf8(nrrd(&lines, &[])).unwrap().replace('\n', "\r\n");
    let volume = read_as("a.nrrd", &[header.as_bytes(), b"\n\r\n#"].concat()).unwrap();
    assert_eq!(volume.voxels, Voxels::U8(b"\n\r\n#".to_vec()));
}

#[test]
fn the_key_of_a_key_value_line_may_hold_anything() {
    for line in [
        "a key: with a colon:=value",
        "DICOM: tag (0010,0010):=Name^Given",
        "no field at all: x:=y",
        "key:=",
        "key:=value:",
        ":=value without a key",
        "key:=# no comment",
        "spacing: 1 1 1:=of another tool",
        "\u{4f53}\u{7d20}:=\u{3000}",
        "tab\there:=\tthere",
        "a:b:=c",
        "url:=http://host: 80/",
    ] {
        assert_eq!(bytes(&read_nrrd(&format!("{SMALL}\n{line}"), &[1, 2, 3, 4])), [1, 2, 3, 4], "{line}");
    }
    let latin_1 = [format!("{SMALL}\n").as_bytes(), b"gr\xf6\xdfe:=\xff\xfe"].concat();
    let whole = [b"NRRD0005\n", latin_1.as_slice(), b"\n\n\x01\x02\x03\x04"].concat();
    assert_eq!(bytes(&read_as("a.nrrd", &whole).unwrap()), [1, 2, 3, 4]);
}

/// A field is a field, whatever stands in its value.
#[test]
fn a_field_whose_value_looks_like_a_key_is_a_field() {
    read_nrrd(&format!("{SMALL}\ncontent: a:=b"), &[0; 4]);
    read_nrrd(&format!("{SMALL}\nlabels: \"a: b\" \"c:=d\" \"\""), &[0; 4]);
    assert!(refusal(&nrrd(&format!("{SMALL}\nline skip: 1:=2"), &[0; 4])).contains("`1:=2`"));
}

#[test]
fn fields_are_known_in_any_case_and_spelling() {
    let lines = "TYPE: Unsigned  Char\nDimension: 3\nSizes: 2 1 2\nENCODING: RAW\nByteSkip: 1\nlineskip: 1\nCenterings: cell \
                 ??? node\nAxisMins: 0 0 nan\nAXISMAXS: 4 nan nan\nsampleunits: mm\noldmin: 0\noldmax: 1\nblocksize: 1";
    let volume = read_nrrd(lines, b"line\n-\x01\x02\x03\x04");
    assert_eq!((bytes(&volume), volume.spacing), (&[1, 2, 3, 4][..], [2.0, 1.0, 1.0]));
}

#[test]
fn every_field_of_the_format_is_known() {
    let others = "content: c\nnumber: 4\nmin: 0\nmax: 4\nold min: 0\nold max: 1\nsample units: mm\nblock size: 1\nthicknesses: \
                  1 nan 2\nlabels: \"a\" \"b\" \"c\"\nunits: \"mm\" \"mm\" \"mm\"\nspace: right-anterior-superior\nspace units: \
                  \"mm\" \"mm\" \"mm\"\nspace origin: (1,2,3)\nmeasurement frame: (1,0,0) (0,1,0) (0,0,1)\nspace directions: \
                  (1,0,0) (0,1,0) (0,0,1)";
    assert_eq!(read_nrrd(&format!("{SMALL}\n{others}"), &[0; 4]).notes, [""; 0]);
    read_nrrd(&format!("{SMALL}\nspace dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1)"), &[0; 4]);
}

#[test]
fn a_blank_line_ends_the_header_also_where_it_holds_spaces() {
    for blank in ["\n", " \n", "\t  \n", "\r\n", " \r\n", " \t \r\n"] {
        let whole = [format!("NRRD0005\n{SMALL}\n{blank}").as_bytes(), &[10, 32, 13, 9]].concat();
        assert_eq!(bytes(&read_as("a.nrrd", &whole).unwrap()), [10, 32, 13, 9], "{blank:?}");
    }
}

#[test]
fn a_byte_order_mark_in_front_is_passed_over() {
    let mark = [0xef, 0xbb, 0xbf];
    let whole = [&mark[..], &nrrd(SMALL, &[1, 2, 3, 4])].concat();
    for name in ["a.nrrd", "a.nhdr", "a.unknown"] {
        assert_eq!(bytes(&read_as(name, &whole).unwrap()), [1, 2, 3, 4]);
    }
    let (folder, path) = file("a.nhdr", &[&mark[..], format!("NRRD00.01\n{SMALL}\ndatafile: b").as_bytes()].concat());
    std::fs::write(folder.path().join("b"), [1, 2, 3, 4]).unwrap();
    assert_eq!(bytes(&read::volume(&path, None).unwrap()), [1, 2, 3, 4]);
}

#[test]
fn headers_of_megabytes_are_read() {
    let mut lines = format!("{SMALL}\n");
    for frame in 0..40_000 {
        writeln!(lines, "Seq_Frame{frame:05}_ProbeToTrackerTransform:=1 0 0 {frame} 0 1 0 0 0 0 1 0 0 0 0 1").unwrap();
    }
    writeln!(lines, "# {}", "one long line ".repeat(100_000)).unwrap();
    assert!(lines.len() > 4 << 20);
    let whole = nrrd(lines.trim_end(), &[1, 2, 3, 4]);
    assert_eq!(bytes(&read_as("a.nrrd", &whole).unwrap()), [1, 2, 3, 4]);
    assert_eq!(bytes(&read_as("a.nrrd", &gzip(&whole)).unwrap()), [1, 2, 3, 4]);
}

#[test]
fn bytes_and_lines_before_the_data_are_skipped() {
    let with = |fields: &str, data: &[u8]| read_nrrd(&format!("{SMALL}\n{fields}"), data).voxels;
    let expected = Voxels::U8(vec![1, 2, 3, 4]);
    assert_eq!(with("byte skip: 3", b"abc\x01\x02\x03\x04"), expected);
    assert_eq!(with("byteskip: -1", b"whatever\x01\x02\x03\x04"), expected);
    assert_eq!(with("byteskip: -1", b"\x01\x02\x03\x04"), expected);
    assert_eq!(with("line skip: 2", b"P5\n2 2\n\x01\x02\x03\x04"), expected);
    assert_eq!(with("lineskip: 1\nbyte skip: 1", b"P5\n-\x01\x02\x03\x04"), expected);
    assert_eq!(with("lineskip: 1\nbyte skip: -1", b"P5\n----\x01\x02\x03\x04"), expected);
}

/// A megabyte of gzip may hold a thousand of them: lines and names are kept up to a bound.
#[test]
fn lines_and_lists_without_end_are_refused() {
    let long = [b"NRRD0001\n# ".to_vec(), vec![b'x'; 1 << 26]].concat();
    for bytes in [gzip(&long), long] {
        assert!(refusal(&bytes).contains("has a line of more than 67108864 bytes"));
    }
    let list = [format!("NRRD0001\n{SMALL}\ndata file: LIST\n").as_bytes(), &b"a\n".repeat(1 << 20)].concat();
    assert!(refusal(&list).contains("names 1048576 files"));
    let longer = [&list[..], b"a\n"].concat();
    assert!(refusal(&gzip(&longer)).contains("lists more than 1048576 files"));
}
