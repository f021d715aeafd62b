//! Data in other files: one, a list, or a pattern with numbers.

use std::path::PathBuf;

use depthleap::read;
use depthleap::scene::volume::{Volume, Voxels};
use tempfile::TempDir;

use crate::kit::{bytes, bzip2, file, gzip, says, sized};

/// A detached header of a 2x3x4 volume of 0 to 23 whose `data file` is this.
fn detached(data_file: &str, lines: &str, files: &[(&str, Vec<u8>)]) -> (TempDir, PathBuf) {
    let header = format!("NRRD0005\n{}\ndata file: {data_file}", sized(&[2, 3, 4], lines));
    let (folder, path) = file("a.nhdr", header.as_bytes());
    for (name, data) in files {
        std::fs::write(folder.path().join(name), data).unwrap();
    }
    (folder, path)
}

fn read(data_file: &str, lines: &str, files: &[(&str, Vec<u8>)]) -> depthleap::Result<Volume> {
    let (_folder, path) = detached(data_file, lines, files);
    read::volume(&path, None)
}

/// Bytes `begin` up to `end` of the volume.
fn part(begin: u8, end: u8) -> Vec<u8> {
    (begin..end).collect()
}

/// `s0` to `s3`, a slice each.
fn slices() -> [(&'static str, Vec<u8>); 4] {
    ["s0", "s1", "s2", "s3"].map(|name| (name, name.as_bytes()[1] - b'0')).map(|(s, i)| (s, part(6 * i, 6 * i + 6)))
}

fn whole(volume: &Volume) {
    assert_eq!((volume.dims, bytes(volume)), ([2, 3, 4], &part(0, 24)[..]));
    assert_eq!(volume.warnings, [""; 0]);
}

#[test]
fn a_list_without_subdim_holds_slices_or_slabs() {
    for list in ["LIST", "LIST 2"] {
        whole(&read(&format!("{list}\ns0\ns1\ns2\ns3\n"), "", &slices()).unwrap());
        whole(&read(&format!("{list}\n  s0  \r\ns1\r\ns2\r\ns3\r\n\r\nno file"), "", &slices()).unwrap());
    }
    let slabs = [("a b", part(0, 12)), ("c:=d", part(12, 24))];
    whole(&read("LIST\na b\nc:=d", "", &slabs).unwrap());
    whole(&read("LIST 3\na b\nc:=d", "", &slabs).unwrap());
    whole(&read("LIST\nall", "", &[("all", part(0, 24))]).unwrap());
    let twice = read("LIST\ns1\ns1\ns0\ns0", "", &slices()).unwrap();
    assert_eq!(bytes(&twice), [part(6, 12), part(6, 12), part(0, 6), part(0, 6)].concat());
}

#[test]
fn a_list_with_subdim_holds_parts_of_so_many_axes() {
    let rows: Vec<(String, Vec<u8>)> = (0..12).map(|i| (format!("r{i}"), part(2 * i, 2 * i + 2))).collect();
    let names: Vec<&str> = rows.iter().map(|(name, _)| name.as_str()).collect();
    let files: Vec<(&str, Vec<u8>)> = rows.iter().map(|(name, data)| (name.as_str(), data.clone())).collect();
    whole(&read(&format!("LIST 1\n{}", names.join("\n")), "", &files).unwrap());
    whole(&read("r%d 0 11 1 1", "", &files).unwrap());
}

#[test]
fn a_pattern_makes_names_of_numbers_up_and_down() {
    for (pattern, names) in [
        ("s%d 0 3 1", ["s0", "s1", "s2", "s3"]),
        ("s%i 0 3 1 2", ["s0", "s1", "s2", "s3"]),
        ("s%03d.raw 8 11 1", ["s008.raw", "s009.raw", "s010.raw", "s011.raw"]),
        ("s%03d.raw 3 0 -1", ["s003.raw", "s002.raw", "s001.raw", "s000.raw"]),
        ("s%02u 10 -20 -10", ["s10", "s00", "s-10", "s-20"]),
        ("s%03d 10 -20 -10", ["s010", "s000", "s-10", "s-20"]),
        ("%5d 1 10 3", ["    1", "    4", "    7", "   10"]),
        ("s%d 0 10 3", ["s0", "s3", "s6", "s9"]),
        ("100%% of %d a b 1 4 1", ["100% of 1 a b", "100% of 2 a b", "100% of 3 a b", "100% of 4 a b"]),
        ("s%d -3 0 1", ["s-3", "s-2", "s-1", "s0"]),
    ] {
        let files = [0, 1, 2, 3].map(|i: u8| (names[usize::from(i)], part(6 * i, 6 * i + 6)));
        let volume = read(pattern, "", &files).unwrap_or_else(|e| panic!("{pattern}: {e}"));
        whole(&volume);
    }
    whole(&read("s%d 7 7 1", "", &[("s7", part(0, 24))]).unwrap());
    whole(&read("s%d 7 7 -1", "", &[("s7", part(0, 24))]).unwrap());
}

/// From one end of 64 bits to the other the numbers of a pattern differ by more than they themselves may be.
#[test]
fn a_pattern_from_end_to_end_of_its_numbers_is_read() {
    let (low, step) = (i64::MIN, i64::MAX);
    let names = [low, low + step, low + step + step].map(|n| format!("s{n}"));
    let header = sized(&[2, 1, 3], &format!("data file: s%d {low} {} {step}", i64::MAX));
    let (folder, path) = file("a.nhdr", format!("NRRD0005\n{header}").as_bytes());
    for (i, name) in names.iter().enumerate() {
        std::fs::write(folder.path().join(name), [i as u8; 2]).unwrap();
    }
    assert_eq!(bytes(&read::volume(&path, None).unwrap()), [0, 0, 1, 1, 2, 2]);
}

/// A name with numbers behind it, and no place for them in it, is a name.
#[test]
fn a_name_with_spaces_and_numbers_is_one_file() {
    for name in ["scan 1 10 1", "scan 1 10 1 2", "LISTED", "50% 1 2 3"] {
        whole(&read(name, "", &[(name, part(0, 24))]).unwrap());
    }
}

#[test]
fn lines_and_bytes_are_skipped_in_every_file_and_each_is_unpacked() {
    let with = |pack: fn(&[u8]) -> Vec<u8>| slices().map(|(name, data)| (name, pack(&data)));
    let headed = with(|data| [b"P5\n-", data].concat());
    whole(&read("s%d 0 3 1", "line skip: 1\nbyte skip: 1", &headed).unwrap());
    whole(&read("s%d 0 3 1", "byte skip: -1", &headed).unwrap());
    let packed = |encoding: &str, files: &[(&str, Vec<u8>)]| {
        let header = sized(&[2, 3, 4], "data file: LIST").replace("raw", encoding);
        let (folder, path) = file("a.nhdr", format!("NRRD0005\n{header}\ns0\ns1\ns2\ns3").as_bytes());
        files.iter().for_each(|(name, data)| std::fs::write(folder.path().join(name), data).unwrap());
        whole(&read::volume(&path, None).unwrap());
    };
    packed("gzip", &with(gzip));
    packed("bzip2", &with(bzip2));
    packed("hex", &with(|data| data.iter().map(|b| format!("{b:02x}")).collect::<String>().into_bytes()));
    packed("ascii", &with(|data| format!("{data:?}").replace(['[', ']'], " ").into_bytes()));
}

#[test]
fn files_that_hold_more_are_told_of_and_the_fourth_and_later_counted() {
    let header = sized(&[1, 1, 6], "data file: s%d 1 6 1");
    let (folder, path) = file("a.nhdr", format!("NRRD0005\n{header}").as_bytes());
    for i in 1..=6u8 {
        std::fs::write(folder.path().join(format!("s{i}")), vec![i; if i == 2 { 1 } else { 5 }]).unwrap();
    }
    let volume = read::volume(&path, None).unwrap();
    assert_eq!(bytes(&volume), [1, 2, 3, 4, 5, 6]);
    assert_eq!(volume.warnings.len(), 4);
    for name in ["s1", "s3", "s4"] {
        assert!(says(&volume.warnings, &[name, "4 bytes behind its data"]), "{:?}", volume.warnings);
    }
    assert!(says(&volume.warnings, &["2 further files"]), "{:?}", volume.warnings);
}

#[test]
fn lists_and_patterns_that_do_not_fit_are_refused_by_name() {
    for (data_file, named) in [
        ("LIST\ns0\ns1\ns2", "names 3 files, which do not share the 4 entries"),
        ("LIST\n", "names 0 files"),
        ("LIST 1\ns0\ns1\ns2\ns3", "names 4 files of 1 axes each, where the sizes ask for 12"),
        ("LIST 0\ns0", "has files of 0 axes each; give a number of axes from 1 to 3"),
        ("LIST 4\ns0", "has files of 4 axes each"),
        ("LIST -1\ns0", "LIST with a wrong number of axes"),
        ("LIST two\ns0", "LIST with a wrong number of axes"),
        ("SKIPLIST\n0 s0", "is a SKIPLIST, which is not read"),
        ("s%d 0 3 0", "numbers that make no name"),
        ("s%d 0 3 -1", "numbers that make no name"),
        ("s%d 3 0 1", "numbers that make no name"),
        ("s%d 0 3 1 -2", "negative number of axes"),
        ("s%d 0 4 1", "names 5 files"),
        ("s%d 0 9223372036854775807 1", "names 9223372036854775808 files"),
        ("s%d -9223372036854775808 9223372036854775807 1", "files, which do not share"),
        ("s%d 1 4 1", "s4: cannot be read"),
        ("s%d%d 0 3 1", "s%d%d 0 3 1: cannot be read"),
        ("s%s 0 3 1", "s%s 0 3 1: cannot be read"),
        ("s%999d 0 3 1", "s%999d 0 3 1: cannot be read"),
    ] {
        let message = read(data_file, "", &slices()).unwrap_err().to_string();
        assert!(message.contains(named), "{data_file}: {message}");
    }
}

#[test]
fn a_file_of_a_list_that_is_too_short_is_named_with_its_share() {
    let mut files = slices();
    files[2].1.pop();
    let message = read("s%d 0 3 1", "", &files).unwrap_err().to_string();
    let parts = ["s2: holds 5 bytes of data", "its share of sizes 2 3 4 of type u8", "ask for 6"];
    assert!(parts.iter().all(|part| message.contains(part)), "{message}");
}

/// Names that are no UTF-8, of the volume, of its data, of a list and of a pattern.
#[cfg(unix)]
#[test]
fn file_names_of_any_bytes_are_read() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let folder = tempfile::tempdir().unwrap();
    let name = |bytes: &[u8]| folder.path().join(OsStr::from_bytes(bytes));
    let header = format!("NRRD0005\n{}\n", sized(&[2, 1, 2], ""));
    for (i, data_file) in [&b"\xffdata.raw"[..], b"LIST\n\xff0\n\xff1", b"\xfe\xff%d 0 1 1"].into_iter().enumerate() {
        let path = name(format!("h{i}\u{fc}").as_bytes());
        let path = path.with_file_name(OsStr::from_bytes(&[b"\xe4", path.file_name().unwrap().as_bytes()].concat()));
        std::fs::write(&path, [header.as_bytes(), b"data file: ", data_file].concat()).unwrap();
        std::fs::write(name(b"\xffdata.raw"), [1, 2, 3, 4]).unwrap();
        for prefix in [&b"\xff"[..], b"\xfe\xff"] {
            std::fs::write(name(&[prefix, b"0"].concat()), [1, 2]).unwrap();
            std::fs::write(name(&[prefix, b"1"].concat()), [3, 4]).unwrap();
        }
        assert_eq!(read::volume(&path, None).unwrap().voxels, Voxels::U8(vec![1, 2, 3, 4]));
    }
}
