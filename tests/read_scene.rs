//! Scene files, transfer function files and settings in JSON: read, resolved, checked, and refused by name.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use depthleap::method::{self, SINGLE_PASS};
use depthleap::read;
use depthleap::scene::settings::{ReferenceUnit, Refine, TransferSettings};
use depthleap::scene::transfer::TransferFunction;
use depthleap::scene::{Settings, scenes};
use tempfile::TempDir;

fn file(name: &str, text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

fn settings(text: &str) -> depthleap::Result<Settings> {
    let (_folder, path) = file("a.toml", text);
    read::settings(&path)
}

fn from_json(text: &str) -> depthleap::Result<Settings> {
    let (_folder, path) = file("a.json", text);
    read::settings_from_json(&path)
}

#[test]
fn an_empty_scene_is_the_default_one() {
    assert_eq!(settings("").unwrap(), Settings::default());
    let scene = read::scene(&Settings::default()).unwrap();
    assert_eq!((scene.field.volume.name.as_str(), scene.transfer.name.as_str()), ("builtin:shells:64", "ramp"));
}

#[test]
fn every_key_is_read() {
    let text = r#"
        [volume]
        builtin = "jets:32"
        range = [0, 200]
        nan = "hole"
        texture = "r32f"
        [transfer]
        points = [[0, 1, 1, 1, 0.0], [1, 1, 1, 1, 0.5]]
        reference = 2.0
        [camera]
        eye = [1, 2, 3]
        target = [0.1, 0, 0]
        up = [0, 0, 1]
        fov_y = 30
        [image]
        size = [64, 32]
        background = [0.1, 0.2, 0.3]
        accumulate = "rgba16f"
        [sampling]
        step = 0.5
        offset = "midpoint"
        last = "partial"
        alpha = "paper"
        filter = "exact"
        samples_per_pass = 4
        passes = 9
        termination = 1
        [method]
        name = "rc-block"
        cull = "ztest"
        mark = "copy"
        exit_lookahead = false
        block_first = true
    "#;
    let settings = settings(text).unwrap();
    assert_eq!((settings.method.name, settings.sampling.samples_per_pass), (method::RC_BLOCK.name(), 4));
    assert_eq!((settings.image.size, settings.camera.fov_y), ([64, 32], 30.0));
    let scene = read::scene(&settings).unwrap();
    assert_eq!((scene.field.range, scene.transfer.reference), ([0.0, 200.0], 2.0));
    // What is written out as TOML or JSON is read back the same.
    assert_eq!(toml::from_str::<Settings>(&toml::to_string(&settings).unwrap()).unwrap(), settings);
    assert_eq!(from_json(&serde_json::json!({ "settings": settings }).to_string()).unwrap(), settings);
}

#[test]
fn a_height_makes_the_camera_orthographic() {
    let scene = read::scene(&settings("[camera]\nheight = 1.2\n[volume]\nbuiltin = \"shells:8\"").unwrap()).unwrap();
    assert_eq!(scene.camera.height, Some(1.2));
    assert!(scene.camera.rays([4, 3]).unwrap().parallel());
    let perspective = read::scene(&settings("[volume]\nbuiltin = \"shells:8\"").unwrap()).unwrap();
    assert_eq!(perspective.camera.height, None);
}

#[test]
fn paths_are_relative_to_the_scene_file() {
    let text = "[volume]\npath = \"data/a.nrrd\"\n[transfer]\nfile = \"/abs/map.json\"";
    let (folder, path) = file("a.toml", text);
    let settings = read::settings(&path).unwrap();
    assert_eq!(settings.volume.path.unwrap(), folder.path().join("data/a.nrrd"));
    assert_eq!(settings.transfer.file.unwrap(), Path::new("/abs/map.json"));
}

#[test]
fn a_wrong_key_or_name_is_told_with_its_line_and_the_nearest() {
    for (text, expected) in [
        ("[volume]\n\n[sampling]\nsetp = 1.0", [", line 4: ", "unknown key `setp`", "did you mean `step`?"]),
        ("[volumes]\nrange = [0, 1]", [", line 1: ", "unknown key `volumes`", "did you mean `volume`?"]),
        ("[method]\nname = \"nn-omin\"", [", line 2: ", "unknown name `nn-omin`", "did you mean `nn-omni`?"]),
        ("[image]\nzzz = 1", [", line 2: ", "unknown key `zzz`", "known are size, background, accumulate"]),
        ("[sampling]\nstep = \"long\"", [", line 2: ", "string", "expected a number"]),
        ("[sampling]\npasses = 0.5", [", line 2: ", "0.5", "expected a whole number"]),
        ("[image]\nsize = [1, 2, 3]", [", line 2: ", "3 entries", "have to be 2"]),
        ("[camera]\neye = [1, 2]", [", line 2: ", "2 entries", "have to be 3"]),
        ("[volume]\nrange = [1]", [", line 2: ", "1 entries", "have to be 2"]),
        ("[transfer]\npoints = [[0, 1, 1, 1, 0, 9]]", [", line 2: ", "6 entries", "have to be 5"]),
        ("sampling = 1", [", line 1: ", "integer `1`", "the section [sampling]"]),
        ("[sampling]\nstep = 1\nstep = 2", [", line 3: ", "duplicate", ""]),
        ("[image]\nsize = [-1, 5]", [", line 2: ", "-1", ""]),
        ("\n\nwhat", [", line 3: ", "", ""]),
    ] {
        let message = settings(text).unwrap_err().to_string();
        assert!(expected.iter().all(|part| message.contains(part)), "{text}: {message}");
    }
}

#[test]
fn deeply_nested_text_is_refused() {
    settings(&format!("a = {}", "[".repeat(100_000))).unwrap_err();
    from_json(&"[".repeat(100_000)).unwrap_err();
}

#[test]
fn values_out_of_range_are_named_with_their_key() {
    let refused = |change: fn(&mut Settings), key: &str, value: &str| {
        let mut settings = Settings::default();
        change(&mut settings);
        let message = read::scene(&settings).unwrap_err().to_string();
        assert!(message.contains(key) && message.contains(value), "{message}");
    };
    refused(|s| s.sampling.step = 0.0, "sampling.step", "is 0");
    refused(|s| s.sampling.step = f64::NAN, "sampling.step", "NaN");
    refused(|s| s.sampling.step = f64::INFINITY, "sampling.step", "inf");
    refused(|s| s.sampling.step = 2e6, "sampling.step", "2000000");
    refused(|s| s.sampling.samples_per_pass = 65537, "sampling.samples_per_pass", "65537");
    refused(|s| s.sampling.passes = 65537, "sampling.passes", "65537");
    refused(|s| s.sampling.termination = 1.5, "sampling.termination", "1.5");
    refused(|s| s.sampling.termination = f64::NAN, "sampling.termination", "NaN");
    refused(|s| s.image.size = [0, 5], "image.size", "[0, 5]");
    refused(|s| s.image.size = [5, 65536], "image.size", "65536");
    refused(|s| s.image.background = [0.0, 2.0, 0.0], "image.background", "2.0");
    refused(|s| s.camera.fov_y = 180.0, "camera", "180");
    refused(|s| s.camera.height = Some(0.0), "camera.height", "is 0");
    refused(|s| s.transfer.reference = 0.0, "transfer.reference", "is 0");
    refused(|s| s.transfer.preset = Some("ram".into()), "transfer.preset", "did you mean `ramp`?");
    refused(|s| s.volume.range = Some([1.0, 0.0].map(Into::into)), "volume.range", "[1, 0]");
}

#[test]
fn contradicting_volume_settings_are_refused() {
    let refused = |change: fn(&mut Settings), part: &str| {
        let mut settings = Settings::default();
        change(&mut settings);
        let message = read::scene(&settings).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    };
    refused(|s| (s.volume.path, s.volume.builtin) = (Some("a".into()), Some("jets".into())), "both path and builtin");
    refused(|s| s.volume.dims = Some([1; 3]), "not type");
    refused(|s| s.volume.spacing = Some([1.0; 3]), "not dims");
    refused(|s| s.volume.path = Some("absent.nrrd".into()), "absent.nrrd");
}

#[test]
fn a_raw_volume_is_read_as_the_scene_says() {
    let (folder, path) =
        file("a.toml", "[volume]\npath = \"a.raw\"\ndims = [3, 2, 1]\ntype = \"u8\"\nspacing = [1, 2, 3]");
    std::fs::write(folder.path().join("a.raw"), [0, 1, 2, 3, 4, 5]).unwrap();
    let scene = read::scene(&read::settings(&path).unwrap()).unwrap();
    assert_eq!((scene.field.dims(), scene.field.volume.spacing), ([3, 2, 1], [1.0, 2.0, 3.0]));
}

#[test]
fn settings_of_a_run_are_taken_and_of_several_one_is_picked() {
    let run = |step: f64| {
        let mut settings = Settings::default();
        settings.sampling.step = step;
        serde_json::json!({ "method": "nn-omni", "settings": settings })
    };
    let step = |text: &str| from_json(text).map(|s| s.sampling.step);
    assert_eq!(step(&run(0.5).to_string()), Ok(0.5));
    assert_eq!(step(&serde_json::json!({ "runs": [run(0.25)] }).to_string()), Ok(0.25));
    let several = serde_json::json!({ "runs": [run(1.0), run(2.0)] }).to_string();
    let message = step(&several).unwrap_err().to_string();
    assert!(message.contains("holds 2 runs") && message.contains("a.json#1"), "{message}");
    let (_folder, path) = file("a.json", &several);
    let pick = |n: &str| read::settings_from_json(Path::new(&format!("{}#{n}", path.display())));
    assert_eq!(pick("1").unwrap().sampling.step, 2.0);
    assert!(pick("2").unwrap_err().to_string().contains("none numbered 2"));
    pick("x").unwrap_err();
    for wrong in ["", "[]", "{}", "{\"runs\": []}", "{\"runs\": 5}", "{\"settings\": 5}", "null"] {
        step(wrong).unwrap_err();
    }
    let typo = step("{\"settings\": {\"sampling\": {\"stp\": 1}}}").unwrap_err().to_string();
    assert!(typo.contains("did you mean `step`?"), "{typo}");
}

fn transfer(text: &str, reference: f64) -> depthleap::Result<TransferFunction> {
    let (folder, _path) = file("map.json", text);
    read::transfer(&TransferSettings { file: Some("map.json".into()), reference, ..Default::default() }, folder.path())
}

#[test]
fn a_transfer_function_file_is_read_relative_to_its_base() {
    let tf = transfer("{\"points\": [[0, 1, 0.5, 0, 0], [1, 0, 0.5, 1, 0.8]], \"reference\": 3}", 1.0).unwrap();
    assert_eq!((tf.reference, tf.knots().len(), tf.evaluate(0.5)), (3.0, 2, [0.5, 0.5, 0.5, 0.4]));
    assert_eq!(transfer("{\"points\": [[0, 1, 1, 1, 0]]}", 2.0).unwrap().reference, 2.0);
}

#[test]
fn wrong_transfer_function_files_are_refused() {
    for (text, part) in [
        ("{\"point\": [[0, 1, 1, 1, 0]]}", "did you mean `points`?"),
        ("{\"points\": [[0, 1, 1, 1]]}", "length"),
        ("{\"points\": []}", "no points"),
        ("{\"points\": [[0, 1, 1, 1, 2]]}", "opacity 2"),
        ("{\"points\": [[0, 1, 1, 1, 1e999]]}", "out of range"),
        ("{\"points\": [[0, 1, 1, 1, 0]], \"reference\": -1}", "-1"),
        ("{\"points\":\n\n [[0,", "line 3"),
        ("", "EOF"),
    ] {
        let message = transfer(text, 1.0).unwrap_err().to_string();
        assert!(message.contains("map.json") && message.contains(part), "{text}: {message}");
    }
    let two = transfer("{\"points\": [[0, 1, 1, 1, 0]], \"reference\": 3}", 2.0).unwrap_err().to_string();
    assert!(two.contains("reference length 3, the settings 2"), "{two}");
}

#[test]
fn one_source_of_the_transfer_function_is_allowed() {
    let both = TransferSettings { preset: Some("ramp".into()), points: Some(vec![[0.0; 5]]), ..Default::default() };
    assert!(read::transfer(&both, Path::new("")).unwrap_err().to_string().contains("more than one"));
}

#[test]
fn figures_of_papers_name_their_volume() {
    let names: BTreeSet<&str> = scenes::STEGMAIER.iter().map(|row| row.name).collect();
    assert_eq!(names.len(), scenes::STEGMAIER.len(), "each has a picture of its own");
    for row in &scenes::STEGMAIER {
        let settings = read::settings_of(row.name, row.text, Path::new("data")).unwrap();
        let file = settings.volume.path.as_ref().or(settings.volume.mesh.as_ref());
        assert_eq!(file, Some(&Path::new("data").join(row.file)), "{}", row.name);
        assert_eq!(settings.method.name, SINGLE_PASS.name(), "{}", row.name);
        settings.check().unwrap();
    }
    let of = |name: &str| scenes::STEGMAIER.iter().find(|row| row.name == name).unwrap().text;
    let refine = |name: &str| read::settings_of(name, of(name), Path::new("")).unwrap().surface.refine;
    assert_eq!(refine("stegmaier-7-reflecting-none"), Refine::None);
    assert_eq!(refine("stegmaier-7-reflecting-linear"), Refine::Linear);
    let step = read::settings_of("step", of("stegmaier-7-normals-none"), Path::new("")).unwrap().sampling.step;
    assert_eq!(32.0 / step, 50.0, "samples across the 32 voxels");
}

#[test]
fn built_in_scenes_are_whole_and_their_forms_name_their_volume() {
    for row in scenes::ALL {
        let settings = read::settings_of(row.name, row.text, Path::new("")).unwrap();
        assert!(settings.volume.path.is_none() && settings.volume.builtin.is_some(), "{}", row.name);
        let scene = read::scene(&settings).unwrap();
        assert_eq!(scene.polygons.show(), !settings.meshes.is_empty(), "{}", row.name);
        assert_eq!(scene.polygons.clips().len(), settings.clips.len(), "{}", row.name);
        for form in row.on_data {
            let settings = read::settings_of(form.file, form.text, Path::new("data")).unwrap();
            assert_eq!(settings.volume.path, Some(Path::new("data").join(form.file)));
            settings.check().unwrap();
        }
    }
    let bad = read::settings_of("here", "[camera]\nye = 1", Path::new("")).unwrap_err().to_string();
    assert!(bad.contains("here, line 2") && bad.contains("eye"), "{bad}");
}

#[test]
fn a_reference_length_may_be_a_part_of_the_volume() {
    let scene = |dims: &str, reference: f64, unit: ReferenceUnit| {
        let mut settings = Settings::default();
        settings.volume.builtin = Some(format!("shells:{dims}"));
        (settings.transfer.reference, settings.transfer.reference_unit) = (reference, unit);
        read::scene(&settings)
    };
    let voxels = |dims: &str, unit| scene(dims, 0.125, unit).unwrap().transfer.reference;
    assert_eq!(voxels("16x12x10", ReferenceUnit::Voxel), 0.125);
    assert_eq!(voxels("16x12x10", ReferenceUnit::Volume), 2.0);
    assert_eq!(voxels("32x24x20", ReferenceUnit::Volume), 4.0);
    let error = scene("16", 1e-6, ReferenceUnit::Volume).map(drop);
    assert!(error.is_ok(), "{error:?}");
    let error = scene("16", 1e5, ReferenceUnit::Volume).map(drop).unwrap_err().to_string();
    assert!(error.contains("--reference") && error.contains("voxels"), "{error}");
}

#[test]
fn a_file_with_a_reference_length_has_it_in_voxels() {
    let (folder, _path) = file("map.json", "{\"points\": [[0, 1, 1, 1, 0]], \"reference\": 3}");
    let settings = TransferSettings {
        file: Some("map.json".into()),
        reference_unit: ReferenceUnit::Volume,
        ..TransferSettings::default()
    };
    let error = read::transfer(&settings, folder.path()).unwrap_err().to_string();
    assert!(error.contains("map.json") && error.contains("another unit"), "{error}");
}
