//! Damaged scene files, settings in JSON and transfer functions.

use std::path::Path;

use depthleap::Result;
use depthleap::read;
use depthleap::scene::settings::{Settings, TransferSettings};

use crate::damage::{damaged, each};
use crate::{INPUTS, is_fit};

pub const SCENE: &str = r#"
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

const TRANSFER: &str =
    r#"{"points": [[0, 1, 0.5, 0, 0], [0.25, 1, 1, 1, 0.2], [1, 0, 0.5, 1, 0.8]], "reference": 1.5}"#;

/// Writes damaged texts into files of this name and reads them.
fn read_damaged(seed: u64, name: &str, text: &str, read: impl Fn(&Path) -> Result<()> + Sync) {
    let right = |folder: &Path| {
        std::fs::write(folder.join(name), text).unwrap();
        read(&folder.join(name)).expect("what is not damaged has to be right");
    };
    let were_read = each(seed, INPUTS, right, |folder, numbers| {
        let path = folder.join(name);
        std::fs::write(&path, damaged(text.as_bytes(), numbers)).unwrap();
        let read = read(&path);
        let _ = read.as_ref().map_err(|error| is_fit(error, name));
        read.is_ok()
    });
    assert!((INPUTS / 100..INPUTS - INPUTS / 100).contains(&were_read), "{were_read} of {INPUTS} were read");
}

#[test]
fn scene_files() {
    read_damaged(2, "a.toml", SCENE, |path| {
        let settings = read::settings(path)?;
        let _ = settings.check().map_err(|error| is_fit(&error, ""));
        Ok(())
    });
}

#[test]
fn settings_in_json() {
    let settings: Settings = toml::from_str(SCENE).unwrap();
    let whole = serde_json::json!({ "runs": [{ "method": "nn-omni", "settings": settings }] }).to_string();
    read_damaged(3, "a.json", &whole, |path| {
        let settings = read::settings_from_json(path)?;
        let _ = settings.check().map_err(|error| is_fit(&error, ""));
        Ok(())
    });
}

#[test]
fn transfer_functions() {
    read_damaged(4, "map.json", TRANSFER, |path| {
        let settings = TransferSettings { file: Some(path.into()), ..Default::default() };
        read::transfer(&settings, Path::new("")).map(drop)
    });
}
