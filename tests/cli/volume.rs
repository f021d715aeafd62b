//! What the command line says of a volume: how it was read, what may mislead, and which options it takes.

use crate::driverless;
use crate::program::{Place, npy};

const LOOK: &str = "--viewport 8x8 --method cpu";

/// A 3x2x2 volume of bytes with these lines in its header.
fn nrrd(place: &Place, name: &str, lines: &str, data: &[u8]) {
    let header = format!("NRRD0005\ntype: uint8\nencoding: raw\n{lines}\n\n");
    place.file(name, [header.as_bytes(), data].concat());
}

const PLAIN: &str = "dimension: 3\nsizes: 3 2 2";
const VOXELS: [u8; 12] = [0, 40, 250, 3, 9, 27, 81, 243, 17, 200, 100, 50];

#[test]
fn help_has_every_option_of_volumes() {
    let place = driverless();
    for command in ["render", "bench", "plan", "accuracy"] {
        let help = place.done(&format!("{command} --help")).text();
        for option in [
            "--range <LOW,HIGH>",
            "1%,99%",
            "--no-data <VALUE,...>",
            "--component <0..N|luminance|magnitude>",
            "--frame <N>",
            "--band <VOXELS>",
            "--orientation <AXES>",
            "--endian <ORDER>",
            "--skip <BYTES>",
            "--precision <X>",
            "nearest",
            "auto",
        ] {
            assert!(help.contains(option), "{command} --help has no {option}: {help}");
        }
    }
}

#[test]
fn what_was_done_to_a_volume_is_told_in_the_output_and_the_json() {
    let place = driverless();
    nrrd(&place, "a.nrrd", &format!("{PLAIN}\nspace: RAS\nspace directions: (0,1,0) (-1,0,0) (0,0,1)"), &VOXELS);
    let told = place.done(&format!("render a.nrrd {LOOK} -o a.png --json a.json")).err;
    assert!(told.contains("note: a, ramp: ") && told.contains("`space directions`"), "{told}");
    let json = place.json("a.json");
    assert!(json["notes"][0].as_str().unwrap().contains("`space directions`"), "{json}");
    assert_eq!(json["settings"]["volume"]["orientation"], "file");
    let told = place.done(&format!("plan a.nrrd {LOOK} --orientation index")).err;
    assert!(told.contains("note: a, ramp: ") && told.contains("its own axes"), "{told}");
    let told = place.done(&format!("render a.nrrd {LOOK} --range 10%,90% -o a.png")).err;
    assert!(told.contains("the scalar range 10% to 90% is 3 to 243"), "{told}");
}

#[test]
fn pictures_that_may_mislead_come_with_a_warning() {
    let place = driverless();
    nrrd(&place, "a.nrrd", PLAIN, &VOXELS);
    nrrd(&place, "long.nrrd", PLAIN, &[VOXELS.as_slice(), &[0; 3]].concat());
    nrrd(&place, "constant.nrrd", PLAIN, &[100; 12]);
    let shear = format!("{PLAIN}\nspace: RAS\nspace directions: (1,0,0) (1,1,0) (0,0,1)");
    nrrd(&place, "sheared.nrrd", &shear, &VOXELS);
    for (arguments, part) in [
        ("a.nrrd --range 300,400", "values run from 0 to 250"),
        ("a.nrrd --range 100,100", "the one value 100"),
        ("constant.nrrd --range 300,400", "every value is 100"),
        ("constant.nrrd --no-data 100", "every voxel is NaN"),
        ("a.nrrd --nan hole --no-data 27,81", "every cell has one"),
        ("a.nrrd --eye 0,0,3 --target 0,0,9", "no ray meets the volume"),
        ("long.nrrd", "long.nrrd holds 3 bytes behind its data"),
        ("sheared.nrrd", "sheared"),
    ] {
        let ended = place.done(&format!("render {arguments} {LOOK} -o a.npy --json a.json"));
        let said: Vec<&str> = ended.err.lines().filter(|line| line.starts_with("warning: ")).collect();
        assert!(said.len() == 1 && said[0].contains(part), "{arguments}: {}", ended.err);
        let in_json = place.json("a.json")["warnings"][0].as_str().unwrap().to_owned();
        assert!(said[0].ends_with(&in_json), "{in_json}");
        let empty = npy(&place.read("a.npy")).1.iter().all(|channel| *channel == 0.0);
        assert_eq!(empty, in_json.starts_with("the picture is empty"), "{arguments}");
    }
    let quiet = place.done(&format!("render a.nrrd {LOOK} --tf linear -o a.png")).err;
    assert!(!quiet.contains("warning: ") && !quiet.contains("note: "), "{quiet}");
}

#[test]
fn options_of_files_are_refused_with_what_there_is() {
    let place = driverless();
    nrrd(&place, "colours.nrrd", "dimension: 4\nsizes: 3 2 1 2\nkinds: RGB-color domain domain domain", &VOXELS);
    nrrd(&place, "movie.nrrd", "dimension: 4\nsizes: 2 2 1 3\nkinds: domain domain domain time", &VOXELS);
    place.file("a.raw", VOXELS);
    for (arguments, code, parts) in [
        ("colours.nrrd", 3, ["colours.nrrd", "--component", "0 to 2, luminance or magnitude"]),
        ("colours.nrrd --component 3", 3, ["--component", "is 3", "3 values"]),
        ("colours.nrrd --component red", 2, ["--component", "red", "luminance"]),
        ("movie.nrrd", 3, ["movie.nrrd", "--frame", "0 to 2"]),
        ("movie.nrrd --frame 3", 3, ["--frame", "is 3", "0 to 2"]),
        ("a.raw --dims 3,2,2 --type u8 --component 1", 3, ["a.raw", "--component", "one value"]),
        ("a.raw --dims 3,2,2 --type u8 --skip -2", 2, ["--skip", "-2", "-1"]),
        ("a.raw --dims 3,2,2 --type u8 --skip 1", 3, ["a.raw", "11", "12"]),
        ("a.raw --endian big", 2, ["endian", "dims", "add"]),
        ("builtin:shells:8 --frame 1", 3, ["--frame", "shells:8", "leave it out"]),
        ("colours.nrrd --component -1", 2, ["--component", "-1", "luminance"]),
        ("movie.nrrd --frame -1", 2, ["--frame", "-1", "invalid"]),
        ("builtin:shells:8 --range 60%,40%", 2, ["--range", "60%", "low"]),
        ("builtin:shells:8 --range 0%,101%", 2, ["--range", "101", "100"]),
        ("builtin:shells:8 --precision 0", 2, ["--precision", "0", "from"]),
        (
            "builtin:shells:8 --filter nearest --classification pre-integrated",
            2,
            ["nearest", "pre-integrated", "filter"],
        ),
    ] {
        place.refused(&format!("render {arguments} {LOOK} -o a.png"), code, &parts);
    }
    for arguments in ["colours.nrrd --component luminance", "colours.nrrd --component 2", "movie.nrrd --frame 2"] {
        place.done(&format!("render {arguments} {LOOK} -o a.png"));
    }
}

#[test]
fn every_setting_of_a_volume_is_repeated_from_json() {
    let place = driverless();
    nrrd(
        &place,
        "movie.nrrd",
        "dimension: 5\nsizes: 3 2 1 2 2\nkinds: vector domain domain domain time",
        &[VOXELS, VOXELS].concat(),
    );
    place.file("a.raw", [VOXELS.as_slice(), &VOXELS].concat());
    for arguments in [
        "movie.nrrd --component magnitude --frame 1 --orientation index --range 5%,1e2 --no-data -9999,253 --nan hole",
        "a.raw --dims 3,2,1 --type i16 --endian big --skip -1 --spacing 1,0.3,2 --filter nearest --precision 1e-4",
    ] {
        place.done(&format!("render {arguments} {LOOK} --tf linear -o first.npy --json first.json"));
        place.done("render --from first.json -o second.npy --json second.json");
        assert_eq!(place.read("first.npy"), place.read("second.npy"), "{arguments}");
        assert_eq!(place.json("first.json")["settings"], place.json("second.json")["settings"], "{arguments}");
        assert!(npy(&place.read("first.npy")).1.iter().any(|channel| *channel > 0.0), "{arguments} shows nothing");
    }
}

/// A tetrahedron whose fronts are outside.
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

#[test]
fn a_mesh_is_a_volume_of_its_distances() {
    let place = driverless();
    place.file("a.obj", TETRAHEDRON);
    let field = "a.obj --dims 20,21,22 --band 3 --iso 0";
    let told = place.done(&format!("render {field} {LOOK} -o first.npy --json first.json")).err;
    assert!(told.contains("note: a, iso 0: distances from the 4 triangles of a.obj"), "{told}");
    let first = place.json("first.json");
    let volume = &first["settings"]["volume"];
    assert_eq!((&volume["mesh"], &volume["band"]), (&"a.obj".into(), &3.0.into()), "{volume}");
    assert!(npy(&place.read("first.npy")).1.iter().any(|channel| *channel > 0.0), "nothing shows");
    place.done("render --from first.json -o second.npy --json second.json");
    assert_eq!(place.read("first.npy"), place.read("second.npy"));
    assert_eq!(first["settings"], place.json("second.json")["settings"]);
    // Beside a results file in another folder the mesh is found again.
    std::fs::create_dir(place.path().join("out")).unwrap();
    place.done(&format!("render {field} {LOOK} -o third.npy --json out/third.json"));
    assert_eq!(place.json("out/third.json")["settings"]["volume"]["mesh"], "../a.obj");
    place.done("render --from out/third.json -o third.npy");
    assert_eq!(place.read("first.npy"), place.read("third.npy"));
    place.file("sheet.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let told = place.done(&format!("render sheet.obj --dims 20,20,20 --iso 0 {LOOK} -o a.png")).err;
    assert!(told.contains("warning: sheet, iso 0: the mesh sheet.obj") && told.contains("has no inside"), "{told}");
    for (arguments, code, parts) in [
        ("none.stl --dims 20,20,20", 3, ["none.stl", "cannot be read", "check"]),
        ("a.obj --dims 9,20,20", 3, ["a.obj", "9 x 20 x 20", "at least 10"]),
        ("a.obj --dims 2049,20,20", 3, ["a.obj", "2049 x 20 x 20", "2048 along a side"]),
        ("a.obj --dims 20,20,20 --type u8", 2, ["--type", "distance field", "leave it out"]),
        ("a.obj --band 0", 2, ["--band", "is 0", "from 1 to 512"]),
        ("builtin:shells:8 --band 2", 2, ["--band", "without a mesh", "volume.mesh"]),
    ] {
        place.refused(&format!("render {arguments} {LOOK} -o a.png"), code, &parts);
    }
}

#[test]
fn messages_escape_what_a_file_holds_and_are_cut() {
    let place = driverless();
    let mut name = "\u{1b}[31mred\u{7}".to_owned();
    name.push_str(&"x".repeat(100_000));
    place.file("a.nrrd", format!("NRRD0005\ntype: {name}\nencoding: raw\n{PLAIN}\n\n"));
    let key = name.replace('\u{1b}', "\\u001b").replace('\u{7}', "\\u0007");
    place.file("a.toml", format!("[volume]\n\"{key}\" = 1\n"));
    for file in ["a.nrrd", "a.toml"] {
        let ended = place.run(&format!("render {file} {LOOK} -o a.png"));
        assert!(ended.code == Some(3) || ended.code == Some(2), "{}", ended.err);
        assert!(!ended.err.contains(['\u{1b}', '\u{7}']), "{:?}", ended.err);
        assert!(ended.err.len() < 3000 && ended.err.contains('…'), "{} bytes: {}", ended.err.len(), ended.err);
    }
}

#[test]
fn a_broken_manifest_is_named_with_its_variable_and_the_loaders_words() {
    let place = Place::new();
    place.file("broken.json", "this is not JSON");
    place.file(
        "library.json",
        r#"{"file_format_version": "1.0.0", "ICD": {"library_path": "/nonexistent/lib.so", "api_version": "1.3.0"}}"#,
    );
    for (file, part) in [("broken.json", "is not JSON"), ("library.json", "/nonexistent/lib.so")] {
        for arguments in ["info", "render -o a.png"] {
            let mut command = place.command(arguments);
            command.env("VK_DRIVER_FILES", file).env_remove("VK_ICD_FILENAMES");
            let ended = crate::program::Ended::of(command.output().unwrap());
            assert_eq!(ended.code, Some(4), "{}", ended.err);
            for part in ["VK_DRIVER_FILES", file, part, "manifest"] {
                assert!(ended.err.contains(part), "no `{part}` in {}", ended.err);
            }
            assert!(!ended.err.contains("--viewport"), "{}", ended.err);
        }
    }
}
