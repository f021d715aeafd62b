//! Damaged scene files and NRRD headers: whatever a file holds, it is read or refused, and what is read can be planned.
//! Seeded, so that a failure comes again.

use std::path::Path;

use depthleap::plan;
use depthleap::read;
use depthleap::scene::settings::MethodName;

const SCENE: &str = r#"
[volume]
path = "a.nrrd"
range = [0, 255]
nan = "hole"
spacing = [1.0, 2.0, 0.5]
texture = "r32f"
[transfer]
points = [[0, 1, 1, 1, 0.0], [0.5, 1, 0, 1, 0.5], [1, 1, 1, 1, 0.9]]
reference = 1.0
[camera]
eye = [0.3, 0.2, 1.9]
target = [0, 0, 0]
up = [0, 1, 0]
fov_y = 45
[image]
size = [50, 40]
background = [0.1, 0.2, 0.3]
[sampling]
step = 0.5
samples_per_pass = 8
passes = 0
termination = 0.95
[method]
name = "nn-omni"
"#;

const HEADER: &str = "NRRD0004\n# a comment\ntype: unsigned char\ndimension: 3\nsizes: 4 3 2\nspacings: 1 2 0.5\n\
                      encoding: raw\nbyte skip: 0\nline skip: 0\nendian: little\nkey:=value\n\n";

/// In memory where the system has such a place: thousands of small files go through it.
fn folder() -> tempfile::TempDir {
    tempfile::tempdir_in("/dev/shm").or_else(|_| tempfile::tempdir()).unwrap()
}

/// What numbers are changed into.
const ODD: [&str; 24] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "0.5",
    "1e-320",
    "1e-30",
    "1e-4",
    "1e4",
    "1e30",
    "1e308",
    "-1e308",
    "1e999",
    "nan",
    "inf",
    "-inf",
    "65535",
    "65536",
    "4294967296",
    "9223372036854775807",
    "18446744073709551616",
    "[]",
    "\"\"",
];

/// Numbers below a bound, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }
}

/// `text` with one to three changes: a number made odd, or a few bytes changed, left out, doubled or cut off.
fn damaged(text: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut text = text.to_vec();
    for _ in 0..=numbers.below(3) {
        let at = numbers.below(text.len().max(1)).min(text.len());
        let end = (at + 1 + numbers.below(8)).min(text.len());
        match numbers.below(8) {
            0 => text.iter_mut().skip(at).take(1).for_each(|b| *b = numbers.below(256) as u8),
            1 => drop(text.drain(at..end)),
            2 => {
                let part = text[at..end].to_vec();
                text.splice(at..at, part);
            }
            3 => text.truncate(at),
            _ => {
                let digit = |b: &u8| b.is_ascii_digit() || *b == b'.';
                let Some(begin) = text[at..].iter().position(digit).map(|i| at + i) else { continue };
                let length = text[begin..].iter().take_while(|b| digit(b)).count();
                let odd = ODD[numbers.below(ODD.len())];
                text.splice(begin..begin + length, odd.bytes());
            }
        }
    }
    text
}

/// Reads the scene file and plans it by every method; whether all of it went well.
fn plans(scene: &Path) -> bool {
    let Ok(settings) = read::settings(scene) else { return false };
    let Ok(mut scene) = read::scene(&settings) else { return false };
    MethodName::ALL.into_iter().all(|method| {
        scene.settings.method.name = method;
        plan::form(&scene, plan::papers_form(method)).and_then(|form| plan::plan(&scene, form)).is_ok()
    })
}

#[test]
fn of_a_scene_file_never_panic() {
    let folder = folder();
    let scene = folder.path().join("a.toml");
    let data = [HEADER.as_bytes(), &[7; 24]].concat();
    std::fs::write(folder.path().join("a.nrrd"), data).unwrap();
    std::fs::write(&scene, SCENE.replace("spacing = [1.0, 2.0, 0.5]", "")).unwrap();
    assert!(plans(&scene), "the undamaged scene has to be right");

    let raw = SCENE.replace("\"a.nrrd\"", "\"a.raw\"\ndims = [4, 3, 2]\ntype = \"u8\"");
    std::fs::write(folder.path().join("a.raw"), [7; 24]).unwrap();
    let mut numbers = Numbers(1);
    let mut read = 0;
    for _ in 0..3000 {
        std::fs::write(&scene, damaged(raw.as_bytes(), &mut numbers)).unwrap();
        read += usize::from(plans(&scene));
    }
    // Not all of them damage: the plans are reached too.
    assert!((100..2900).contains(&read), "{read} of 3000 scenes were read");
}

#[test]
fn of_a_header_never_panic() {
    let folder = folder();
    let path = folder.path().join("a.nrrd");
    let mut numbers = Numbers(2);
    let mut read = 0;
    for i in 0..4000 {
        let detached = i % 4 == 0;
        let header = if detached { HEADER.replace("key:=value", "data file: b.raw") } else { HEADER.to_owned() };
        let mut file = damaged(header.as_bytes(), &mut numbers);
        file.extend([7; 24].iter().filter(|_| !detached));
        std::fs::write(&path, file).unwrap();
        std::fs::write(folder.path().join("b.raw"), [7; 24]).unwrap();
        read += usize::from(read::volume(&path, None).is_ok());
    }
    assert!((100..3900).contains(&read), "{read} of 4000 volumes were read");
}
