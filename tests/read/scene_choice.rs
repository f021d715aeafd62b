//! What a scene says of its volume's file: byte order, bytes to skip, component, frame, orientation, names of any bytes.

use depthleap::read;
use depthleap::scene::settings::{Component, Endian, Orientation, Settings};
use tempfile::TempDir;

use crate::kit::{counted, file, nrrd, sized, values};

/// The settings of a scene file with this section [volume], beside a file of this name.
fn settings(volume: &str, name: &str, data: &[u8]) -> (TempDir, depthleap::Result<Settings>) {
    let (folder, path) = file("scene.toml", format!("[volume]\n{volume}").as_bytes());
    std::fs::write(folder.path().join(name), data).unwrap();
    let settings = read::settings(&path);
    (folder, settings)
}

fn voxels(volume: &str, name: &str, data: &[u8]) -> Vec<f64> {
    let (_folder, settings) = settings(volume, name, data);
    values(&read::scene(&settings.unwrap()).unwrap().field.volume)
}

fn message(volume: &str, name: &str, data: &[u8]) -> String {
    let (_folder, settings) = settings(volume, name, data);
    settings.and_then(|settings| read::scene(&settings)).unwrap_err().to_string()
}

const RAW: &str = "path = \"a.raw\"\ndims = [2, 1, 1]\ntype = \"u16\"\n";

#[test]
fn byte_order_and_skip_are_keys() {
    let data = [9, 9, 9, 1, 2, 3, 4];
    for (keys, expected) in [
        ("endian = \"big\"\nskip = 3", [258.0, 772.0]),
        ("endian = \"big\"\nskip = -1", [258.0, 772.0]),
        ("endian = \"little\"\nskip = 3", [513.0, 1027.0]),
        ("skip = -1", [513.0, 1027.0]),
    ] {
        assert_eq!(voxels(&format!("{RAW}{keys}"), "a.raw", &data), expected, "{keys}");
    }
    for (keys, part) in [
        ("skip = -2", "volume.skip (--skip): is -2"),
        ("skip = 9223372036854775807", "holds 0 bytes"),
        ("endian = \"middle\"", "unknown name `middle`"),
        ("skip = 1.5", "expected"),
    ] {
        let message = message(&format!("{RAW}{keys}"), "a.raw", &data);
        assert!(message.contains(part), "{message}");
    }
    for keys in ["endian = \"big\"", "skip = 3"] {
        let message = message(&format!("path = \"a.raw\"\n{keys}"), "a.raw", &data);
        assert!(message.contains("has some of dims, type, spacing, endian and skip, but not dims"), "{message}");
    }
}

#[test]
fn component_frame_and_orientation_are_keys() {
    let colours = nrrd(&sized(&[3, 2, 1, 2], "kinds: RGB-color domain domain domain"), &counted(&[3, 2, 1, 2]));
    let with = |keys: &str| voxels(&format!("path = \"a.nrrd\"\n{keys}"), "a.nrrd", &colours);
    assert_eq!(with("component = 1"), [1.0, 4.0, 7.0, 10.0]);
    assert_eq!(with("component = \"2\""), [2.0, 5.0, 8.0, 11.0]);
    assert_eq!(with("component = \"magnitude\"")[0], f64::from(5f32.sqrt()));
    let frames = nrrd(&sized(&[2, 1, 2, 3], "kinds: domain domain domain time"), &counted(&[2, 1, 2, 3]));
    assert_eq!(voxels("path = \"a.nrrd\"\nframe = 2", "a.nrrd", &frames), [8.0, 9.0, 10.0, 11.0]);
    let mirrored = nrrd(&sized(&[2, 1, 2], "space directions: (-1,0,0) (0,1,0) (0,0,1)"), &counted(&[2, 1, 2]));
    for (keys, expected) in [
        ("", [1.0, 0.0, 3.0, 2.0]),
        ("orientation = \"file\"", [1.0, 0.0, 3.0, 2.0]),
        ("orientation = \"index\"", [0.0, 1.0, 2.0, 3.0]),
    ] {
        assert_eq!(voxels(&format!("path = \"a.nrrd\"\n{keys}"), "a.nrrd", &mirrored), expected);
    }
    for (keys, part) in [
        ("component = -1", "`-1`, expected a number from 0, luminance or magnitude"),
        ("component = \"red\"", "`red` is not a component, expected a number from 0, luminance or magnitude"),
        ("component = 0.5", "a number from 0, luminance or magnitude"),
        ("frame = -1", "expected a whole number"),
        ("orientation = \"patient\"", "unknown name `patient`"),
    ] {
        let message = message(&format!("path = \"a.nrrd\"\n{keys}"), "a.nrrd", &mirrored);
        assert!(message.contains(part) && message.contains("scene.toml, line 3"), "{message}");
    }
}

#[test]
fn components_and_frames_of_built_in_voxels_are_refused_by_name() {
    for (keys, part) in [
        ("component = 1", "builtin:jets:8: volume.component (--component): is 1"),
        ("component = \"luminance\"", "volume.component (--component): is luminance"),
        ("frame = 3", "volume.frame (--frame): is 3"),
    ] {
        let message = message(&format!("builtin = \"builtin:jets:8\"\n{keys}"), "unused", &[]);
        assert!(message.contains(part) && message.contains("built-in voxels are one volume"), "{message}");
    }
}

#[test]
fn the_choice_is_read_again_as_it_was_written() {
    let mut settings = Settings::default();
    for component in [None, Some(Component::Number(7)), Some(Component::Luminance), Some(Component::Magnitude)] {
        settings.volume.component = component;
        settings.volume.frame = component.map(|_| 3);
        settings.volume.orientation = if component.is_none() { Orientation::File } else { Orientation::Index };
        settings.volume.endian = component.map(|_| Endian::Big);
        settings.volume.skip = component.map(|_| -1);
        let json = serde_json::to_string(&settings).unwrap();
        assert_eq!(serde_json::from_str::<Settings>(&json).unwrap(), settings, "{json}");
        let text = toml::to_string(&settings).unwrap();
        assert_eq!(toml::from_str::<Settings>(&text).unwrap(), settings, "{text}");
    }
}

/// Names that are no UTF-8 come through settings, their JSON and their TOML.
#[cfg(unix)]
#[test]
fn a_name_of_any_bytes_is_kept_in_settings() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let (folder, _) = file("unused", &[]);
    let path = folder.path().join(OsStr::from_bytes(b"gr\xf6\xdfe \xff.nrrd"));
    std::fs::write(&path, nrrd(&sized(&[2, 1, 2], ""), &[4, 3, 2, 1])).unwrap();
    let mut settings = Settings::default();
    settings.volume.path = Some(path.clone());
    settings.transfer.file = Some(path);
    let json = serde_json::to_string(&settings).unwrap();
    assert_eq!(serde_json::from_str::<Settings>(&json).unwrap(), settings, "{json}");
    let text = toml::to_string(&settings).unwrap();
    assert_eq!(toml::from_str::<Settings>(&text).unwrap(), settings, "{text}");
    settings.transfer.file = None;
    assert_eq!(values(&read::scene(&settings).unwrap().field.volume), [4.0, 3.0, 2.0, 1.0]);
    // And relative ones are made relative to the scene file.
    let scene = folder.path().join("scene.toml");
    let name = b"gr\xf6\xdfe \xff.nrrd".map(|b| b.to_string()).join(", ");
    std::fs::write(&scene, format!("[volume]\npath = [{name}]")).unwrap();
    assert_eq!(read::settings(&scene).unwrap().volume.path, settings.volume.path);
}
