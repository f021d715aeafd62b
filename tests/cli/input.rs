//! Wrong files on the command line: each is refused by its name, its fault and a remedy, and takes no memory for what it
//! only promises.

use std::io::Write;

use flate2::Compression;
use flate2::write::GzEncoder;

use crate::driverless;
use crate::program::{Ended, Place, npy};

const HEADER: &str = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n\n";

/// Renders `name` without a device.
fn render(name: &str) -> String {
    format!("render {name} --method cpu --viewport 4x4 -o a.png")
}

#[test]
fn rejects_an_nrrd_truncated_anywhere() {
    let place = driverless();
    let whole = [HEADER.as_bytes(), &[7; 24]].concat();
    place.file("a.nrrd", &whole);
    place.done(&render("a.nrrd"));
    std::fs::remove_file(place.path().join("a.png")).unwrap();
    let after = |text: &str| HEADER.find(text).unwrap() + text.len();
    for (length, part) in [
        (0, "begins with"),
        (4, "begins with"),
        (after("NRRD0004\n"), "type: is missing"),
        (after("dimen"), "is not a line of an NRRD header"),
        (after("dimension: 3\n"), "encoding: is missing"),
        (after("sizes: 2 3"), "encoding: is missing"),
        (HEADER.len() - 1, "not ended by an empty line"),
        (HEADER.len(), "holds 0 bytes"),
        (HEADER.len() + 23, "holds 23 bytes"),
    ] {
        place.file("a.nrrd", &whole[..length]);
        place.refused(&render("a.nrrd"), 3, &["a.nrrd", part]);
    }
}

#[test]
fn rejects_headers_that_promise_too_much() {
    let place = driverless();
    for (sizes, part) in [
        ("1048576 1048576 1", "1099511627776"),
        ("1048576 1024 1024", "1099511627776"),
        ("4294967296 4294967296 4294967296", "overflow"),
        ("18446744073709551616 1 1", "18446744073709551616"),
        ("0 3 4", "at least 1"),
        ("-2 3 4", "-2"),
    ] {
        let header = HEADER.replace("2 3 4", sizes);
        place.file("a.nrrd", [header.as_bytes(), &[7; 24]].concat());
        place.refused(&render("a.nrrd"), 3, &["a.nrrd", part]);
    }
}

#[test]
fn rejects_a_detached_header_without_its_data() {
    let place = driverless();
    place.file("a.nhdr", HEADER.replace("\n\n", "\ndata file: b.raw\n"));
    place.refused(&render("a.nhdr"), 3, &["b.raw", "cannot be read", "check the path"]);
    place.file("b.raw", [7; 23]);
    place.refused(&render("a.nhdr"), 3, &["b.raw", "holds 23 bytes"]);
}

#[test]
fn rejects_what_is_no_volume() {
    let place = driverless();
    place.file("empty", "");
    place.file("empty.nrrd", "");
    place.file("text.txt", "hello");
    place.file("a.raw", [1, 2, 3]);
    std::fs::create_dir(place.path().join("folder")).unwrap();
    place.refused(&render("missing.nrrd"), 3, &["missing.nrrd", "No such file", "check the path"]);
    place.refused(&render("folder"), 3, &["folder", "not a regular file"]);
    place.refused(&render("empty"), 3, &["empty", "no known volume format", "0 bytes"]);
    place.refused(&render("empty.nrrd"), 3, &["empty.nrrd", "NRRD0001"]);
    place.refused(&render("text.txt"), 3, &["text.txt", "no known volume format", ".nrrd", ".toml"]);
    place.refused(&render("a.raw --dims 1,1,4 --type u8"), 3, &["a.raw", "holds 3 bytes", "ask for 4"]);
    place.refused(&render("a.raw --dims 1000000000,1000000000,1000000000 --type f64"), 3, &["a.raw", "overflow"]);
    place.refused(&render("a.raw --dims 1,1,3"), 2, &["not type", "add type"]);
    place.refused(&render("a.raw --dims 0,1,3 --type u8"), 2, &["--dims", "`0`"]);
    place.refused(&render("a.raw --dims 1,1,3 --type u9"), 2, &["--type", "u8, i8, u16"]);
    place.refused(&render("a.raw --dims 1,1,3 --type u8 --spacing 1,1,0"), 3, &["a.raw", "spacing"]);
    place.refused(&render("builtin:shells:9999"), 2, &["builtin:shells:9999", "from 1 to 2048"]);
    place.refused(&render("builtin:shells:2048"), 2, &["too many voxels"]);
}

#[test]
fn rejects_wrong_scenes() {
    let place = driverless();
    for (scene, parts) in [
        ("[sampling]\nsetp = 1", ["line 2", "unknown key `setp`; did you mean `step`?"]),
        ("[samplin]\nstep = 1", ["line 1", "did you mean `sampling`?"]),
        ("[sampling]\nstep = \"1\"", ["line 2", "expected a number"]),
        ("[image]\nsize = [1, 2, 3]", ["line 2", "3 entries where there have to be 2"]),
        ("[method]\nname = \"nn-omnni\"", ["line 2", "did you mean `nn-omni`?"]),
        ("[volume", ["line 1", "]"]),
        ("\u{0}", ["line 1", "a.toml"]),
    ] {
        place.file("a.toml", scene);
        place.refused(&render("a.toml"), 3, &[&parts[..], &["a.toml"]].concat());
    }
    place.file("a.toml", "[volume]\npath = \"data/b.nrrd\"");
    place.refused(&render("a.toml"), 3, &["data/b.nrrd", "cannot be read"]);
    place.file("a.toml", [0xff, 0xfe]);
    place.refused(&render("a.toml"), 3, &["a.toml", "not UTF-8"]);
    place.refused(&render("b.toml"), 3, &["b.toml", "cannot be read"]);
    place.file("map.json", r#"{"points": [[0, 1, 1, 1, 2]]}"#);
    place.refused(&render("--tf map.json"), 3, &["map.json", "opacity 2"]);
}

#[test]
fn voxels_that_are_no_numbers_follow_the_policy() {
    let place = driverless();
    let mut floats: Vec<f32> = (0..64).map(|i| i as f32 / 64.0).collect();
    (floats[21], floats[22], floats[41]) = (f32::NAN, f32::INFINITY, f32::NEG_INFINITY);
    place.file("a.raw", floats.iter().flat_map(|f| f.to_le_bytes()).collect::<Vec<_>>());
    let volume = "a.raw --dims 4,4,4 --type f32 --range 0,1";
    place.refused(&render(&format!("{volume} --nan error")), 3, &["a.raw", "3 voxels", "NaN or infinite", "replace"]);
    let sum = |policy: &str| {
        let ended = place.done(&format!("render {volume} --nan {policy} --viewport 8x8 --method cpu -o -.npy"));
        let floats = npy(&ended.out).1;
        assert!(floats.iter().all(|f| f.is_finite()), "{policy}");
        floats.iter().sum::<f32>()
    };
    assert!(sum("hole") < sum("replace"), "holes are transparent");
}

/// Runs the program in an address space that is enough for a small picture and far too little for what is asked.
#[cfg(target_os = "linux")]
fn run_in_little_memory(place: &Place, arguments: &str) -> Ended {
    const ROOM: u64 = 2 << 30;
    let runner = std::env::var("DEPTHLEAP_RUNNER").unwrap_or_default();
    Ended::of(place.after(&format!("prlimit --as={ROOM} {runner}"), arguments).output().unwrap())
}

#[cfg(target_os = "linux")]
#[test]
fn no_memory_is_taken_for_what_a_header_promises() {
    let place = driverless();
    let noise: Vec<u8> = (0..1_u32 << 16).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let mut gzip = GzEncoder::new(Vec::new(), Compression::fast());
    gzip.write_all(&noise).unwrap();
    let gzip = gzip.finish().unwrap();
    // As much as so many bytes of gzip can give at the most, and more.
    let most = 1000 * gzip.len();
    let text = vec![b'1'; 1 << 16];
    let files: [(&str, String, &[u8]); 5] = [
        ("raw", "1048576 1048576 4".into(), &noise),
        ("raw", "1048576 1048576 4\nbyte skip: -1".into(), &noise),
        ("gzip", format!("{most} 1 1"), &gzip),
        ("gzip", "1048576 1048576 4".into(), &gzip),
        ("ascii", "1048576 1048576 4".into(), &text),
    ];
    for (encoding, sizes, data) in files {
        let header = HEADER.replace("raw", encoding).replace("2 3 4", &sizes);
        place.file("a.nrrd", [header.as_bytes(), data].concat());
        let ended = run_in_little_memory(&place, &render("a.nrrd"));
        assert_eq!(ended.code, Some(3), "{encoding} {sizes}: {}", ended.err);
        assert!(ended.err.starts_with("error: a.nrrd: "), "{}", ended.err);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_picture_without_memory_is_refused() {
    let place = driverless();
    let arguments = "render builtin:shells:16 --method cpu --viewport 20000x20000 -o a.png";
    let ended = run_in_little_memory(&place, arguments);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(ended.err.contains("--viewport") && ended.err.contains("MiB of memory"), "{}", ended.err);
}
