//! The command line on a device: pictures, counts, benches, and what a device refuses.

mod accuracy;
mod costs;
mod effects;
mod limits;
#[path = "../../cli/program.rs"]
pub mod program;
mod reproduce;
mod shaders;
mod stability;

use std::sync::Arc;

use depthleap::vulkan::Device;
use program::{Place, npy};
use serde_json::Value;

use crate::harness::{Need, Test, data, least, test};

const METHODS: [&str; 5] = ["rc", "rc-ert", "rc-block", "nn-omni", "cpu"];
const SMALL: &str = "builtin:shells:24 --azimuth 31 --elevation 17 --viewport 24x18";

pub fn tests() -> Vec<Test> {
    let mut tests = vec![
        test("unknown device is refused with those there are", unknown_device),
        test("cull bounds is refused without depth bounds", bounds_without_the_feature).needs(Need::NoDepthBounds),
        test("a form the method has not is refused", unknown_form).needs(Need::AnyDriver),
        test("an output is kept when a run fails", failing_runs_change_nothing).needs(Need::AnyDriver),
        test("info writes JSON", info_writes_json),
        test("render writes every key of a run", render_writes_every_key).needs(Need::Thoroughness),
        test("the same settings give the same bits", same_settings_same_bits).needs(Need::Thoroughness),
        test("all three picture formats hold the same floats", formats_agree).needs(Need::AnyDriver),
        test("a run of a bench is repeated bit for bit", bench_runs_repeat).needs(Need::AnyDriver),
        test("bench writes one row a run and the keys of render", bench_writes_rows).needs(Need::AnyDriver),
        test("validation finds nothing", validation_finds_nothing).needs(Need::Thoroughness),
        test("voxels that are no numbers give finite pictures", policies_agree).needs(Need::AnyDriver),
        test("all methods write the same picture", methods_agree_as_files).needs(Need::AnyDriver),
        test("background in what is opaque comes with a warning", background_that_stays).needs(Need::AnyDriver),
        test("cull bounds gives the picture of ztest", bounds_and_ztest_agree)
            .needs(Need::DepthBounds)
            .needs(Need::Thoroughness),
        test("both early ends give one picture", early_ends_agree).needs(Need::Conditional),
        test("extra fetches change no picture and are swept", extra_fetches).needs(Need::AnyDriver),
        test("report makes all pages again", pages_come_again).needs(Need::AnyDriver),
        test("a data set is rendered as it was", fuel_counts).needs(Need::Data("fuel.nrrd")),
    ];
    tests.extend(limits::tests());
    tests.extend(effects::tests());
    let any_driver =
        accuracy::tests().into_iter().chain(costs::tests()).chain(shaders::tests()).chain(reproduce::tests());
    tests.extend(any_driver.map(|test| test.needs(Need::AnyDriver)));
    tests.extend(stability::tests());
    tests.into_iter().map(|test| test.within("cli")).collect()
}

fn extra_fetches(_: &Arc<Device>) {
    let place = Place::new();
    for (name, method) in [("a", "rc-ert"), ("b", "nn-omni"), ("c", "nn-omni+fused")] {
        for extra in [0, 5] {
            place.done(&format!("render {SMALL} --method {method} --extra-fetches {extra} -o {name}{extra}.npy"));
        }
        assert_eq!(place.read(&format!("{name}0.npy")), place.read(&format!("{name}5.npy")), "{method}");
    }
    let said = place.done(&format!("bench {SMALL} --method rc-ert,nn-omni --gpu-cost 3 --repeats 2 -o out")).text();
    assert!(said.contains("Time by the cost of a sample") && said.contains("of the fragments of rc-ert"), "{said}");
    let results = place.json("out/results.json");
    let runs = results["runs"].as_array().unwrap();
    let extra = |run: &Value| run["settings"]["sampling"]["extra_fetches"].as_u64().unwrap();
    assert_eq!(runs.iter().map(extra).collect::<Vec<_>>(), [0, 0, 1, 1, 2, 2, 3, 3]);
    for pair in runs.chunks(2) {
        assert!(pair[0]["saved"].is_null());
        let fragments = pair[1]["saved"]["fragments"].as_f64().unwrap();
        assert!(fragments > 0.0 && fragments == runs[1]["saved"]["fragments"].as_f64().unwrap(), "counts have no cost");
        assert!(pair[1]["saved"]["time"].is_f64());
    }
    let report = String::from_utf8(place.read("out/report.html")).unwrap();
    assert!(report.contains("Time by the cost of a sample"), "the curves are in the report");
    for wrong in ["--gpu-cost 0", "--gpu-cost 100000"] {
        place.refused(&format!("bench {SMALL} {wrong} -o other"), 2, &["--gpu-cost", "from 1 to 4096"]);
    }
    place.refused(&format!("render {SMALL} --extra-fetches 5000 -o a.png"), 2, &["extra_fetches", "0 to 4096"]);
}

fn pages_come_again(_: &Arc<Device>) {
    let place = Place::new();
    let small = "builtin:shells:16 --viewport 16x12";
    place.done(&format!("bench {small} --method rc-ert,nn-omni --repeats 2 --orbit 3 --gpu-cost 2 -o out"));
    place.done(&format!("accuracy {small} --method rc,nn-omni --steps 2,1,0.5 --repeats 2 -o out"));
    place.done("stability --case values --method rc,nn-omni -o out");
    place.done("probe --quick -o out");
    // The bench's report takes in what the probe found, and from here on pages change no more.
    let pages = || -> Vec<(String, Vec<u8>)> {
        let names = std::fs::read_dir(place.path().join("out")).unwrap().map(|e| e.unwrap().file_name());
        let mut names: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
        names.retain(|name| [".html", ".svg", ".csv"].iter().any(|end| name.ends_with(end)));
        names.sort();
        names.into_iter().map(|name| (name.clone(), place.read(&format!("out/{name}")))).collect()
    };
    let alone = pages();
    place.done("report out");
    let changed: Vec<String> =
        pages().into_iter().zip(&alone).filter(|(a, b)| a != *b).map(|((name, _), _)| name).collect();
    assert_eq!(changed, ["report.html"]);
    let before = pages();
    before.iter().for_each(|(name, _)| std::fs::remove_file(place.path().join("out").join(name)).unwrap());
    let ended = place.done("report out");
    assert_eq!(ended.err, "");
    assert_eq!(
        before.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
        [
            "accuracy.csv",
            "accuracy.html",
            "error-step.svg",
            "error-time.svg",
            "probe.html",
            "report.html",
            "results.csv",
            "stability.html",
        ]
    );
    assert!(pages() == before, "a page is not as it was");
}

/// Rays that end early, in passes or in a loop, leave some of what is behind them.
fn background_that_stays(_: &Arc<Device>) {
    let place = Place::new();
    place.file("white.toml", "[volume]\nbuiltin = \"shells:24\"\n[image]\nbackground = [1, 1, 1]\n");
    let warned = |scene: &str, method: &str, termination: &str| {
        let arguments =
            format!("--viewport 24x18 --tf surface --method {method} --termination {termination} --samples-per-pass 8");
        let rendered = place.done(&format!("render {scene} {arguments} -o a.png"));
        rendered.err.contains("up to 5.000 % of the background stays in what is opaque")
    };
    for method in ["rc-ert", "nn-omni", "single-pass", "single-pass-omni+compute"] {
        assert!(warned("white.toml", method, "0.95"), "{method}");
        assert!(!warned("white.toml", method, "1"), "{method}, whose rays do not end early");
        assert!(!warned("builtin:shells:24", method, "0.95"), "{method} over black");
    }
    assert!(!warned("white.toml", "rc", "0.95"), "rays of rc do not end early");
}

fn unknown_device(device: &Arc<Device>) {
    let place = Place::new();
    for wanted in ["nonesuch", "77"] {
        let parts = [wanted, "no device has that", &device.info.name, "choose another"];
        place.refused(&format!("render {SMALL} --device {wanted} -o a.png"), 4, &parts);
    }
}

fn bounds_without_the_feature(device: &Arc<Device>) {
    let place = Place::new();
    for arguments in [
        "render --method nn-omni -o a.png --cull bounds",
        "render --method nn-omni -o a.png --mark fragdepth",
        "bench -o out --method nn-omni --cull bounds --mark copy",
    ] {
        place.refused(arguments, 4, &["--cull bounds", &device.info.name, "no depth bounds test", "--cull ztest"]);
    }
}

fn unknown_form(_: &Arc<Device>) {
    let place = Place::new();
    let parts = ["--cull ztest --mark fragdepth", "nn-omni has no such form", "ztest+copy"];
    place.refused("render --method nn-omni --cull ztest --mark fragdepth -o a.png", 2, &parts);
}

fn failing_runs_change_nothing(_: &Arc<Device>) {
    let place = Place::new();
    place.file("a.png", "as it was");
    place.refused("render --viewport 65535x65535 -o a.png --json a.json", 4, &["--viewport"]);
    place.refused("bench builtin:shells:16 --viewport 65535x1 -o out/below", 4, &["--viewport"]);
}

fn info_writes_json(device: &Arc<Device>) {
    let place = Place::new();
    let text = place.done("info --json info.json").text();
    assert!(text.contains(&device.info.name), "{text}");
    let json = place.json("info.json");
    let mine = &json["devices"][device.info.index];
    assert_eq!(mine["name"], device.info.name.as_str());
    assert_eq!(mine["depth_bounds"], device.info.depth_bounds);
    assert!(mine["self_check"]["ztest+copy"].is_string() && mine["auto"].is_string(), "{mine}");
    if least() {
        return;
    }
    let same: Value = serde_json::from_slice(&place.done("info --json -").out).unwrap();
    assert_eq!(same, json);
}

/// The keys of every run: those of DESIGN.md and what was added to them.
const KEYS: &str = "auto build_ms build_ms_stats bytes cpu_ms cpu_ms_stats cull device driver effect error fragments frame_ms \
                    frame_ms_stats gpu_ms gpu_ms_per_pass ideal invocations left_out mark memory method notes orbit passes plan \
                    record_ms record_ms_stats saved scene self_check settings texture version view warnings";

fn keys(run: &Value) -> Vec<&str> {
    run.as_object().unwrap().keys().map(String::as_str).collect()
}

fn render_writes_every_key(_: &Arc<Device>) {
    let place = Place::new();
    for method in ["rc", "nn-omni", "cpu"] {
        let ended = place.done(&format!("render {SMALL} --method {method} --reference-error -o a.png --json a.json"));
        assert!(ended.out.is_empty() && ended.err.contains(method), "{}", ended.err);
        let run = place.json("a.json");
        let mut found = keys(&run);
        found.sort_unstable();
        assert_eq!(found, KEYS.split_whitespace().collect::<Vec<_>>(), "{method}");
        assert_eq!((&run["version"], &run["method"]), (&Value::from(1), &Value::from(method)));
        let passes = run["passes"].as_u64().unwrap() as usize;
        for list in ["main_per_pass", "intermediate_per_pass"] {
            let counts = run["fragments"][list].as_array().unwrap();
            let total = &run["fragments"][list.trim_end_matches("_per_pass")];
            assert_eq!(
                (counts.len(), counts.iter().map(|c| c.as_u64().unwrap()).sum()),
                (passes, total.as_u64().unwrap())
            );
        }
        assert!(run["error"]["max"].as_f64().unwrap() < 0.02 && run["error"]["rmse"].is_number(), "{}", run["error"]);
        assert_eq!(run["ideal"]["main"].is_u64(), method != "rc");
        assert!(run["frame_ms"].is_number() && run["frame_ms_stats"]["n"].is_u64());
        if method != "cpu" {
            let parts = [&run["gpu_ms"]["total"], &run["gpu_ms"]["main"], &run["gpu_ms"]["main_stats"]["mad"]];
            assert!(run["gpu_ms"].is_null() || parts.iter().all(|p| p.is_number()), "{}", run["gpu_ms"]);
        }
        assert_eq!(run["build_ms"].is_number(), ["rc-block", "nn-omni"].contains(&method));
        assert!(run["left_out"].as_array().unwrap().iter().all(|l| l["what"].is_string() && l["why"].is_string()));
    }
}

fn same_settings_same_bits(_: &Arc<Device>) {
    let place = Place::new();
    for method in ["rc-block", "nn-omni"] {
        let render = || place.done(&format!("render {SMALL} --method {method} -o -.npy")).out;
        assert_eq!(render(), render(), "{method}");
    }
}

fn formats_agree(_: &Arc<Device>) {
    let place = Place::new();
    for name in ["a.png", "a.exr", "a.npy"] {
        place.done(&format!("render {SMALL} -o {name}"));
    }
    let (size, floats) = npy(&place.read("a.npy"));
    let exr = image::open(place.path().join("a.exr")).unwrap().into_rgba32f();
    assert_eq!((size, exr.dimensions()), ([24, 18], (24, 18)));
    assert_eq!(exr.as_raw(), &floats);
    assert!(floats.iter().any(|f| *f > 0.1));
    assert_eq!(image::image_dimensions(place.path().join("a.png")).unwrap(), (24, 18));
}

fn bench_runs_repeat(_: &Arc<Device>) {
    let place = Place::new();
    std::fs::create_dir(place.path().join("data")).unwrap();
    place.file("data/a.raw", (0..512_u32).map(|i| (i * 37 % 256) as u8).collect::<Vec<_>>());
    let options = "--dims 8,8,8 --type u8 --viewport 20x16 --azimuth 20";
    place.done(&format!("bench data/a.raw {options} --method rc-block,nn-omni --repeats 1 -o out"));
    let runs = place.json("out/results.json")["runs"].as_array().unwrap().clone();
    assert_eq!(runs.len(), 2);
    for (i, run) in runs.iter().enumerate() {
        let method = run["method"].as_str().unwrap();
        place.done(&format!("render data/a.raw {options} --method {method} -o first.npy"));
        place.done(&format!("render --from out/results.json#{i} -o second.npy --json again.json"));
        assert_eq!(place.read("first.npy"), place.read("second.npy"), "{method}");
        assert_eq!(place.json("again.json")["fragments"], run["fragments"], "{method}");
    }
}

fn bench_writes_rows(_: &Arc<Device>) {
    let place = Place::new();
    let table =
        place.done("bench builtin:shells:16 builtin:jets:24 --forms all --repeats 2 --viewport 16x16 -o a/b").text();
    let json = place.json("a/b/results.json");
    let runs = json["runs"].as_array().unwrap();
    place.done("render builtin:shells:16 --viewport 16x16 -o a.png --json a.json");
    let one = place.json("a.json");
    assert!(runs.iter().all(|run| keys(run) == keys(&one)));
    assert!(runs.iter().all(|run| run["frame_ms_stats"]["n"] == 2 && run["error"]["max"].is_number()));
    let mut rows = csv::Reader::from_path(place.path().join("a/b/results.csv")).unwrap();
    let column = |name: &str, rows: &csv::StringRecord| rows.iter().position(|c| c == name).unwrap();
    let (scene, cull) = (column("scene", rows.headers().unwrap()), column("cull", rows.headers().unwrap()));
    let rows: Vec<csv::StringRecord> = rows.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), runs.len());
    for (row, run) in rows.iter().zip(runs) {
        assert_eq!(&row[scene], run["scene"].as_str().unwrap());
        assert_eq!(&row[cull], run["cull"].as_str().unwrap_or_default());
        assert!(table.contains(run["scene"].as_str().unwrap()));
    }
    assert!(place.read("a/b/report.html").starts_with(b"<!DOCTYPE html>"));
    let mut files: Vec<_> =
        std::fs::read_dir(place.path().join("a/b")).unwrap().map(|e| e.unwrap().file_name()).collect();
    files.sort();
    assert_eq!(files, ["pictures", "report.html", "results.csv", "results.json"], "a temporary file was left behind");
}

fn validation_finds_nothing(_: &Arc<Device>) {
    let place = Place::new();
    place.done(&format!("render {SMALL} --validate -o a.png"));
    place.done(&format!("bench {SMALL} --validate --repeats 1 --no-reference -o out"));
}

fn policies_agree(_: &Arc<Device>) {
    let place = Place::new();
    let mut floats: Vec<f32> = (0..216).map(|i| (i % 11) as f32 / 11.0).collect();
    (floats[50], floats[90], floats[120]) = (f32::NAN, f32::INFINITY, f32::NEG_INFINITY);
    place.file("a.raw", floats.iter().flat_map(|f| f.to_le_bytes()).collect::<Vec<_>>());
    for policy in ["replace", "hole"] {
        let volume = format!("a.raw --dims 6,6,6 --type f32 --nan {policy} --azimuth 31 --elevation 17");
        place.done(&format!("bench {volume} --viewport 24x18 --filter exact --repeats 1 -o out"));
        for run in place.json("out/results.json")["runs"].as_array().unwrap() {
            let max = run["error"]["max"].as_f64();
            assert!(max.is_some_and(|max| max < 1e-5), "{policy} {}: {max:?}", run["method"]);
        }
    }
}

/// As files, compared by another reader than the program's own.
fn methods_agree_as_files(_: &Arc<Device>) {
    let place = Place::new();
    // Opaque nowhere, and no edge of the box in the picture.
    let scene = "builtin:gaussian:24 --azimuth 31 --elevation 17 --viewport 24x18 --fov 20 --termination 1";
    let picture = |method: &str| {
        let options = "--filter exact --texture r32f -o -.npy";
        npy(&place.done(&format!("render {scene} --method {method} {options}")).out).1
    };
    let rule = picture("cpu");
    assert!(rule.iter().any(|f| *f > 0.1));
    for method in &METHODS[..4] {
        let off = picture(method).iter().zip(&rule).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(off < 1e-5, "{method}: {off}");
    }
}

fn bounds_and_ztest_agree(_: &Arc<Device>) {
    let place = Place::new();
    let picture =
        |cull: &str| place.done(&format!("render {SMALL} --method nn-omni --cull {cull} --mark copy -o -.npy")).out;
    assert_eq!(picture("bounds"), picture("ztest"));
}

fn early_ends_agree(_: &Arc<Device>) {
    let place = Place::new();
    let picture = |way: &str| {
        let options = format!("--method nn-omni --samples-per-pass 1 --early-end {way} -o {way}.npy --json {way}.json");
        place.done(&format!("render {SMALL} {options}"));
        (place.read(&format!("{way}.npy")), place.json(&format!("{way}.json"))["fragments"].clone())
    };
    assert_eq!(picture("conditional"), picture("readback"));
}

/// Fragments of the front view at 500 x 500 with 8 samples a pass; 183,184 pixels are covered, as in [Thesis §5.6].
fn fuel_counts(_: &Arc<Device>) {
    let place = Place::new();
    let volume = data("fuel.nrrd");
    place.done(&format!("render {} --method rc-block -o a.npy --json a.json", volume.display()));
    let fragments = &place.json("a.json")["fragments"];
    assert_eq!(fragments["main_per_pass"][0], 183_184);
    assert!(npy(&place.read("a.npy")).1.iter().all(|f| f.is_finite()));
}
