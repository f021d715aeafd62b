//! What an error shows of a file: its name, and of its bytes no more than a line holds, with nothing that steers a terminal.

use std::path::Path;

use depthleap::error::{Error, shown};
use depthleap::read;

use crate::kit::{SMALL, file, layout, nrrd, read_as};

/// Bytes that steer terminals, turn the direction of writing, or are no text at all.
const STEERING: &str = "\u{1b}[31m\u{7}\u{8}\u{b}\u{202e}\u{2066}\u{85}\u{2028}\0";

fn fit(error: &Error, input: &str) {
    let steers = |c: char| c.is_control() || "\u{202e}\u{2066}\u{2028}".contains(c);
    let message = error.to_string();
    assert!(!message.contains(steers), "{message:?}");
    assert!(error.input.contains(input), "{message}");
    for part in [&error.input, &error.problem, &error.remedy] {
        assert!(!part.is_empty() && part.chars().count() <= 1001, "{} characters: {part}", part.chars().count());
    }
}

#[test]
fn values_of_a_header_are_escaped_and_cut() {
    let long = "x".repeat(5000);
    for value in [STEERING, &long, &format!("{STEERING}{long}"), &STEERING.repeat(300)] {
        for line in [
            format!("type: {value}"),
            format!("encoding: {value}"),
            format!("endian: {value}"),
            format!("sizes: {value} {value} {value}"),
            format!("dimension: {value}"),
            format!("spacings: {value} {value} {value}"),
            format!("space directions: ({value}) none none"),
            format!("space directions: {value}"),
            format!("centers: {value} {value} {value}"),
            format!("byte skip: {value}"),
            format!("line skip: {value}"),
            format!("data file: {value}"),
            format!("data file: LIST\n{value}"),
            format!("data file: {value}%d 1 2 1"),
            format!("{value}: field"),
            format!("no field {value}"),
            value.to_owned(),
        ] {
            let field = line.split(':').next().unwrap();
            let kept = SMALL.lines().filter(|other| !other.starts_with(&format!("{field}:"))).collect::<Vec<_>>();
            let lines = format!("{}\n{line}", kept.join("\n")).replace("uchar", "ushort");
            let Err(error) = read_as("a.nrrd", &nrrd(&lines, &[0; 8])) else { panic!("{line:.60} was read") };
            // A data file is named itself.
            let input = if line.starts_with("data file") { "" } else { "a.nrrd" };
            fit(&error, input);
        }
        fit(&read_as("a.nrrd", format!("NRRD{value}").as_bytes()).unwrap_err(), "a.nrrd");
        let ascii = nrrd(&SMALL.replace("raw", "ascii"), value.as_bytes());
        fit(&read_as("a.nrrd", &[&ascii, &b" 1 2 3 4"[..]].concat()).unwrap_err(), "a.nrrd");
        fit(&read_as("a.nrrd", &nrrd(&SMALL.replace("raw", "hex"), value.as_bytes())).unwrap_err(), "a.nrrd");
    }
}

#[test]
fn wrong_keys_and_names_of_scenes_are_escaped_and_cut() {
    let long = "x".repeat(5000);
    let escaped = "\\u001b[31m\\u0007\\u0000\\u202e\\n".to_owned();
    for value in [&long, &escaped, &format!("{escaped}{long}"), &escaped.repeat(300)] {
        for text in [
            format!("[volume]\n\"{value}\" = 1"),
            format!("[volume]\ncomponent = \"{value}\""),
            format!("[volume]\nrange = \"{value}\""),
            format!("[method]\nname = \"{value}\""),
            format!("\"{value}\" = 1"),
        ] {
            let (_folder, path) = file("a.toml", text.as_bytes());
            fit(&read::settings(&path).unwrap_err(), "a.toml");
        }
        for text in [
            format!("{{\"settings\": {{\"volume\": {{\"{value}\": 1}}}}}}"),
            format!("{{\"settings\": {{\"method\": {{\"name\": \"{value}\"}}}}}}"),
            format!("{{\"settings\": {{\"volume\": {{\"component\": \"{value}\"}}}}}}"),
            format!("{{\"{value}\": 1}}"),
            value.clone(),
        ] {
            let (_folder, path) = file("a.json", text.as_bytes());
            fit(&read::settings_from_json(&path).unwrap_err(), "a.json");
        }
        let (_folder, path) = file("a.toml", format!("[volume]\nbuiltin = \"{value}\"").as_bytes());
        fit(&read::scene(&read::settings(&path).unwrap()).unwrap_err(), "builtin");
    }
}

/// A file's name is the user's, but it too may steer a terminal or begin a line of its own.
#[cfg(unix)]
#[test]
fn names_of_files_are_escaped() {
    let name = "a\n\u{1b}[31merror: b\r\u{202e}.nrrd";
    let (folder, path) = file(name, &nrrd(&SMALL.replace("uchar", "none"), &[0; 4]));
    fit(&read::volume(&path, None).unwrap_err(), "a\\n\\u{1b}[31merror: b\\r\\u{202e}.nrrd");
    fit(&read::volume(&folder.path().join("absent\nfile"), None).unwrap_err(), "absent\\nfile");
    let raw = layout([9; 3], depthleap::scene::volume::VoxelType::U8);
    let (_folder, path) = file("raw\nvoxels", &[0; 4]);
    fit(&read::volume(&path, Some(raw)).unwrap_err(), "raw\\nvoxels");
    fit(&read::volume(Path::new("no\0name"), None).unwrap_err(), "no\\u{0}name");
}

#[test]
fn text_is_shown_by_the_line_and_long_lines_end_in_an_ellipsis() {
    assert_eq!(shown("a\nb"), "a\nb");
    assert_eq!(shown(&"y".repeat(1000)), "y".repeat(1000));
    assert_eq!(shown(&"y".repeat(1001)), format!("{}\u{2026}", "y".repeat(1000)));
    assert_eq!(shown("\u{1b}\u{202e}"), "\\u{1b}\\u{202e}");
    assert_eq!(shown(&"\u{1b}".repeat(1000)), format!("{}\u{2026}", "\\u{1b}".repeat(166)));
}
