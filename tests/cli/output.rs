//! What is written where: pictures, JSON, plans; and that a run can be repeated from it.

use std::process::Stdio;

use crate::program::{Ended, npy};
use crate::{SMALL, driverless};

#[test]
fn rejects_places_that_cannot_be_written() {
    let place = driverless();
    place.file("file", "x");
    place.file("old.png", "as it was");
    std::fs::create_dir(place.path().join("dir.png")).unwrap();
    place.refused(&format!("{SMALL} -o no/a.png"), 6, &["no/a.png", "no folder no", "make it"]);
    place.refused(&format!("{SMALL} -o file/a.png"), 6, &["file/a.png", "no folder file"]);
    place.refused(&format!("{SMALL} -o dir.png"), 6, &["dir.png", "is a folder"]);
    place.refused(&format!("{SMALL} -o a.png --json no/a.json"), 6, &["no/a.json", "no folder no"]);
    place.refused(&format!("{SMALL} -o a.gif"), 2, &["a.gif", ".gif", ".png, .exr or .npy"]);
    place.refused(&format!("{SMALL} -o a"), 2, &["a: ", "no extension"]);
    place.refused(&format!("{SMALL} -o - --json -"), 2, &["standard output", "picture and the JSON"]);
    place.refused("plan --json no/a.json", 6, &["no/a.json"]);
    place.refused("bench --method cpu -o file", 6, &["file", "choose another folder"]);
    place.refused("bench --method cpu -o file/below", 6, &["file/below"]);
    // No driver: the run fails after its outputs were found good, and leaves them as they were.
    place.refused("render -o old.png", 4, &["driver"]);
    place.refused("bench -o new/folder", 4, &["driver"]);
    place.refused("bench builtin:shells:16 missing.nrrd --method cpu -o new", 3, &["missing.nrrd"]);
}

#[test]
fn reproduce_without_volumes_names_them_and_shows_the_papers_numbers() {
    let place = driverless();
    for data in ["", "--data nowhere"] {
        let ended = place.run(&format!("reproduce {data} -o out"));
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        let text = ended.text();
        assert!(text.contains("9,891,936") && text.contains("Foot") && !text.contains("over a factor"), "{text}");
        let named = if data.is_empty() { "give the folder with fuel.nrrd as --data" } else { "fuel.nrrd is not there" };
        assert!(text.contains(named), "{text}");
        assert!(
            text.contains("Raycasting 10.8 at 512^2, 3.2 at 1024^2") && text.contains("lucy_decimated.ply"),
            "{text}"
        );
        for file in ["reproduce.html", "reproduce.json", "reproduce.csv", "reproduce-rates.csv"] {
            assert!(!place.read(&format!("out/{file}")).is_empty(), "{file}");
        }
    }
    let text = place.done("reproduce --parts times,figures -o out").text();
    assert!(
        text.contains("Fuel: left out: --parts does not name it") && text.contains("with engine.nrrd as"),
        "{text}"
    );
    place.refused("reproduce --parts pictures -o out", 2, &["--parts", "counts", "times", "figures"]);
    place.refused("reproduce --directions 0 -o out", 2, &["--directions", "1..=360"]);
    place.file("file", "x");
    place.refused("reproduce -o file", 6, &["file", "choose another folder"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error_and_a_reader_that_left_is_none() {
    let place = driverless();
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    for arguments in ["plan", &format!("{SMALL} -o -")] {
        let ended = Ended::of(place.command(arguments).stdout(full()).output().unwrap());
        assert_eq!(ended.code, Some(6), "{}", ended.err);
        assert!(ended.err.starts_with("error: standard output: cannot be written"), "{}", ended.err);
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let ended = Ended::of(place.command(arguments).stdout(writer).stderr(Stdio::piped()).output().unwrap());
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert!(!ended.err.contains("error:") && !ended.err.contains("panicked"), "{}", ended.err);
    }
    // Nobody reads the table; the picture is written all the same.
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let status = place.command(&format!("{SMALL} -o a.npy")).stderr(writer).status().unwrap();
    assert!(status.success());
    assert_eq!(npy(&place.read("a.npy")).0, [12, 8]);
}

#[test]
fn a_built_in_scene_is_named_with_its_meshes() {
    let place = driverless();
    let text = place.done("plan builtin:engine-geometry --viewport 20x10 --method rc-ert --json plan.json").text();
    assert!(text.contains("engine:128 with 2 meshes, points"), "{text}");
    assert_eq!(place.json("plan.json")["scene"], "engine:128 with 2 meshes, points");
}

#[test]
fn plan_needs_no_device_and_its_json_says_the_steps() {
    let place = driverless();
    let text = place
        .done(&format!("plan builtin:shells:16 --viewport 20x10 --method nn-omni {PAPERS} --json plan.json"))
        .text();
    let json = place.json("plan.json");
    assert_eq!((&json["method"], &json["auto"]), (&"nn-omni".into(), &serde_json::Value::Null));
    let steps = json["steps"].as_array().unwrap();
    assert!(steps.iter().all(|s| text.contains(s["name"].as_str().unwrap())));
    assert_eq!(steps.iter().filter(|s| s["group"] == "main").count() as u64, json["passes"].as_u64().unwrap());
    // On standard output the JSON stands alone.
    let same: serde_json::Value = serde_json::from_slice(
        &place.done(&format!("plan builtin:shells:16 --viewport 20x10 --method nn-omni {PAPERS} --json -")).out,
    )
    .unwrap();
    assert_eq!(same, json);
}

/// The papers' M, and one look-up.
const PAPERS: &str = "--samples-per-pass 8 --lookups 1";

#[test]
fn numbers_that_nobody_says_are_chosen_for_a_method_that_is_named() {
    let place = driverless();
    let numbers = |arguments: &str| {
        place.done(&format!("plan {arguments} --json plan.json"));
        let json = place.json("plan.json");
        (json["auto"]["chosen"]["samples_per_pass"].as_u64(), json["auto"]["chosen"]["lookups"].as_u64())
    };
    let open = "builtin:jets:64 --viewport 200x200 --method nn-omni";
    let (m, lookups) = numbers(open);
    assert!(m > Some(8) && lookups > Some(1), "{m:?} {lookups:?}");
    // What is said stays, by an option or in a scene file, and the other is chosen.
    assert_eq!(numbers(&format!("{open} --samples-per-pass 8")).0, Some(8));
    assert_eq!(numbers(&format!("{open} --lookups 1")).1, Some(1));
    let both = "[volume]\nbuiltin = \"jets:64\"\n[method]\nname = \"nn-omni\"\nlookups = 1\n[sampling]\nsamples_per_pass = 8\n";
    place.file("both.toml", both);
    assert_eq!(numbers("both.toml"), (None, None), "nothing is left to choose");
    place.file("one.toml", both.replace("lookups = 1\n", ""));
    let (m, lookups) = numbers("one.toml");
    assert!(m == Some(8) && lookups > Some(1), "{m:?} {lookups:?}");
}

#[test]
fn plan_says_what_auto_chose_and_why() {
    let place = driverless();
    let text = place.done("plan builtin:shells:16 --viewport 40x30 --json plan.json").text();
    let json = place.json("plan.json");
    let chosen = json["method"].as_str().unwrap();
    assert_eq!(json["auto"]["chosen"]["method"], chosen);
    assert!(text.contains(&format!("auto chose {chosen}")) && text.contains("the runner-up is"), "{text}");
    let named = place.done("plan builtin:shells:16 --viewport 40x30 --method auto").text();
    assert_eq!(named, text);
}

#[test]
fn plans_of_the_largest_pictures_and_the_most_passes_are_quick() {
    let place = driverless();
    let begin = std::time::Instant::now();
    let text = place.done("plan --viewport 65535x65535 --samples-per-pass 100").text();
    assert!(text.contains("of 65535 x 65535"), "{text}");
    let text = place.done("plan --passes 65536 --samples-per-pass 32768").text();
    assert!(text.contains("65536 main passes of 32768 samples"), "{text}");
    assert!(begin.elapsed().as_secs() < 30, "{:?}", begin.elapsed());
}

#[test]
fn pictures_are_what_their_formats_say() {
    let place = driverless();
    for name in ["a.png", "a.exr", "a.npy"] {
        place.done(&format!("{SMALL} -o {name}"));
    }
    let (size, floats) = npy(&place.read("a.npy"));
    assert_eq!(size, [12, 8]);
    let exr = image::open(place.path().join("a.exr")).unwrap().into_rgba32f();
    assert_eq!((exr.dimensions(), exr.as_raw()), ((12, 8), &floats));
    let png = image::open(place.path().join("a.png")).unwrap();
    assert_eq!((png.width(), png.height(), png.color()), (12, 8, image::ColorType::Rgb8));
    assert_eq!(npy(&place.done(&format!("{SMALL} -o -.npy")).out).1, floats);
    assert_eq!(place.done(&format!("{SMALL} -o -")).out, place.read("a.png"));

    // Row 0 is on top.
    place.file("ramp.raw", [0, 0, 0, 0, 255, 255, 255, 255]);
    place.done("render ramp.raw --dims 2,2,2 --type u8 --up 0,0,1 --eye 0,3,0 --viewport 8x8 --method cpu -o up.npy");
    let rows: Vec<f32> = npy(&place.read("up.npy")).1.chunks(8 * 4).map(|row| row.iter().sum()).collect();
    assert!(rows[2] > rows[5], "z is up and the volume brighter there: {rows:?}");
}

#[test]
fn the_same_settings_give_the_same_bits() {
    let place = driverless();
    let render = || place.done(&format!("{SMALL} -o -.npy")).out;
    assert_eq!(render(), render());
}

#[test]
fn a_run_is_repeated_from_its_json_in_any_folder() {
    let place = driverless();
    for folder in ["data", "out", "elsewhere"] {
        std::fs::create_dir(place.path().join(folder)).unwrap();
    }
    place.file("data/a.raw", (0..27).map(|i| i * 9).collect::<Vec<u8>>());
    place.file("data/map.json", r#"{"points": [[0, 1, 0, 0, 0.1], [1, 0, 1, 1, 0.6]]}"#);
    let options = "--dims 3,3,3 --type u8 --tf data/map.json --viewport 9x7 --step 0.3 --method cpu";
    place.done(&format!("render data/a.raw {options} -o first.npy --json out/run.json"));
    assert_eq!(place.json("out/run.json")["settings"]["volume"]["path"], "../data/a.raw");
    place.done("render --from out/run.json -o second.npy");
    let mut command = place.command("render --from ../out/run.json -o ../third.npy");
    command.current_dir(place.path().join("elsewhere"));
    let third = Ended::of(command.output().unwrap());
    assert_eq!(third.code, Some(0), "{}", third.err);
    assert_eq!(place.read("first.npy"), place.read("second.npy"));
    assert_eq!(place.read("first.npy"), place.read("third.npy"));
    // An option given wins.
    place.done("render --from out/run.json --viewport 5x4 -o fourth.npy");
    assert_eq!(npy(&place.read("fourth.npy")).0, [5, 4]);
}

#[test]
fn two_results_are_compared_with_an_exit_code() {
    let place = driverless();
    let render = |step: &str, json: &str| place.done(&format!("{SMALL} --step {step} -o a.npy --json {json}"));
    render("1", "a.json");
    render("1", "b.json");
    render("0.5", "c.json");
    let same = place.done("compare a.json b.json --json same.json").text();
    assert!(same.ends_with("All counts are the same.\n"), "{same}");
    assert_eq!(place.json("same.json")["only_in_a"], serde_json::json!([]));
    let other = place.run("compare a.json c.json");
    assert_eq!(other.code, Some(1), "{}", other.err);
    assert!(other.text().contains("setting sampling.step: 1.0 -> 0.5"), "{}", other.text());
    assert!(other.text().ends_with("Counts differ.\n"), "{}", other.text());
    place.file("d.json", "{}");
    place.refused("compare a.json d.json", 3, &["d.json", "is not a results file", "render --json"]);
    place.refused("compare a.json gone.json", 3, &["gone.json", "cannot be read"]);
}
