//! From counts, times and pictures to tables, JSON, CSV and the report.

use std::collections::BTreeMap;
use std::path::Path;

use depthleap::measure::comparison::groups;
use depthleap::measure::csv::csv;
use depthleap::measure::error::difference;
use depthleap::measure::number::{milliseconds, percent, thousands};
use depthleap::measure::picture::Format;
use depthleap::measure::plot::{fragments_svg, times_svg};
use depthleap::measure::record::{Counts, ErrorRecord, FORMAT, Ideal, LeftOut, PassTimes};
use depthleap::measure::report::Difference;
use depthleap::measure::table::table;
use depthleap::measure::{
    HostTimes, Picture, ReportInput, Results, Run, Statistics, Timing, Timings, compare, report_html, write_atomically,
};
use depthleap::scene::Settings;

/// A run as `frame` would fill it, with small counts one can check by eye.
fn run(method: &str, main: &[u64], intermediate: &[u64]) -> Run {
    let near = method.starts_with("nn-");
    let mut gpu = Timings::default();
    gpu.push("setup", Timing::of(&[0.5, 0.4, 0.6]).unwrap());
    gpu.push("main", Timing::of(&[4.0, 3.0, 9.0]).unwrap());
    gpu.push("intermediate", Timing::of(&[1.0, 1.5, 2.0]).unwrap());
    gpu.push("total", Timing::of(&[6.0, 5.0, 11.0]).unwrap());
    Run {
        version: FORMAT,
        scene: "fuel".into(),
        view: "front".into(),
        method: method.into(),
        cull: Some(if near { "bounds" } else { "ztest" }.into()),
        mark: near.then(|| "copy".into()),
        passes: main.len() as u32,
        fragments: Counts::of(main.to_vec(), intermediate.to_vec()),
        invocations: near.then(|| Counts::of(main.to_vec(), intermediate.to_vec())),
        gpu_ms: Some(gpu),
        gpu_ms_per_pass: Some(PassTimes { main: vec![1.0, 2.0], intermediate: vec![0.5] }),
        host: HostTimes {
            frame: Some(Timing::once(7.25)),
            cpu: Timing::of(&[12.0, 13.0]),
            record: None,
            build: near.then(|| Timing::once(2.5)),
        },
        bytes: 4096,
        memory: BTreeMap::from([("depth".into(), 1_000_000), ("accumulated".into(), 4_000_000)]),
        ideal: Some(Ideal { main: 1200 }),
        error: Some(ErrorRecord {
            max: 4.8e-7,
            rmse: 1e-8,
            psnr: Some(160.0),
            undecided: if near { 3 } else { 0 },
            reference: "f64 twin".into(),
        }),
        device: "llvmpipe".into(),
        driver: "Mesa 22.3.6".into(),
        self_check: BTreeMap::from([("bounds + copy".into(), "right".into())]),
        left_out: vec![LeftOut { what: "depth_peel".into(), why: "no translucent polygons".into() }],
        plan: vec![" 1 ray_setup".into(), " 2 main_pass #0".into()],
        notes: vec!["software driver".into()],
        settings: Settings::default(),
    }
}

fn results() -> Results {
    let mut cpu = run("cpu", &[10_000, 9_000], &[10_000]);
    (cpu.cull, cpu.gpu_ms, cpu.gpu_ms_per_pass, cpu.error) = (None, None, None, None);
    Results {
        version: FORMAT,
        program: "depthleap 0.1.0".into(),
        commit: "0123abc".into(),
        command: "depthleap bench fuel.toml -o out".into(),
        date: "2005-07-01T12:00:00Z".into(),
        runs: vec![
            run("rc-block", &[10_000, 2_000, 0], &[10_000, 10_000]),
            run("nn-omni", &[1_500, 1_500, 0], &[2_000, 500]),
            cpu,
        ],
    }
}

fn picture(size: [u32; 2]) -> Picture {
    let pixels = (0..size[0] * size[1]).map(|i| [0.001 * i as f32, 0.25, 0.125, 0.5]).collect();
    Picture::new(size, pixels).unwrap()
}

mod statistics {
    use super::*;

    #[test]
    fn of_an_odd_list() {
        // Sorted 1 2 4 7 100: median 4, deviations 0 2 3 3 96.
        let s = Statistics::of(&[7.0, 1.0, 100.0, 2.0, 4.0]).unwrap();
        assert_eq!(s, Statistics { median: 4.0, min: 1.0, max: 100.0, mad: 3.0, n: 5 });
    }

    #[test]
    fn of_an_even_list() {
        // Sorted 1 3 5 9: median 4, deviations 1 1 3 5.
        let s = Statistics::of(&[9.0, 3.0, 1.0, 5.0]).unwrap();
        assert_eq!(s, Statistics { median: 4.0, min: 1.0, max: 9.0, mad: 2.0, n: 4 });
    }

    #[test]
    fn of_one_sample() {
        assert_eq!(Statistics::of(&[2.5]).unwrap(), Statistics { median: 2.5, min: 2.5, max: 2.5, mad: 0.0, n: 1 });
    }

    #[test]
    fn refuses_nothing_and_what_is_no_number() {
        assert_eq!(Statistics::of(&[]), None);
        assert_eq!(Statistics::of(&[1.0, f64::NAN]), None);
        assert_eq!(Statistics::of(&[f64::INFINITY]), None);
    }
}

mod numbers {
    use super::*;

    #[test]
    fn are_written_for_readers() {
        assert_eq!([0, 999, 1000, 299_356, 9_891_936].map(thousands), ["0", "999", "1,000", "299,356", "9,891,936"]);
        assert_eq!(thousands(u64::MAX), "18,446,744,073,709,551,615");
        assert_eq!([0.1234, 12.347, 741.26].map(milliseconds), ["0.12", "12.35", "741.26"]);
        assert_eq!((percent(1, 4), percent(1, 0)), (Some(25.0), None));
    }
}

mod json {
    use super::*;

    fn keys(value: &serde_json::Value) -> Vec<&str> {
        value.as_object().unwrap().keys().map(String::as_str).collect()
    }

    #[test]
    fn comes_back_as_it_went() {
        let results = results();
        let text = results.to_json().unwrap();
        assert_eq!(Results::from_json("results.json", &text).unwrap(), results);
        let run = &results.runs[1];
        assert_eq!(&Run::from_json("run.json", &run.to_json().unwrap()).unwrap(), run);
    }

    #[test]
    fn has_exactly_the_keys_of_the_format() {
        let value: serde_json::Value = serde_json::from_str(&results().runs[1].to_json().unwrap()).unwrap();
        let expected = "version scene view method cull mark passes fragments invocations gpu_ms gpu_ms_per_pass \
                        frame_ms frame_ms_stats cpu_ms cpu_ms_stats record_ms record_ms_stats build_ms \
                        build_ms_stats bytes memory ideal error device driver self_check left_out plan notes settings";
        let mut expected: Vec<&str> = expected.split_whitespace().collect();
        expected.sort_unstable();
        assert_eq!(keys(&value), expected);
        let counts = ["intermediate", "intermediate_per_pass", "main", "main_per_pass"];
        assert_eq!(keys(&value["fragments"]), counts);
        assert_eq!(keys(&value["invocations"]), counts);
        let groups = "intermediate intermediate_stats main main_stats setup setup_stats total total_stats";
        assert_eq!(keys(&value["gpu_ms"]).join(" "), groups);
        assert_eq!(keys(&value["gpu_ms"]["main_stats"]), ["mad", "max", "min", "n"]);
        assert_eq!(keys(&value["gpu_ms_per_pass"]), ["intermediate", "main"]);
        assert_eq!(keys(&value["error"]), ["max", "psnr", "reference", "rmse", "undecided"]);
        assert_eq!(value["gpu_ms"]["main"], 4.0);
        assert_eq!(value["gpu_ms"]["main_stats"]["mad"], 1.0);
        assert_eq!(value["record_ms"], serde_json::Value::Null);
        assert_eq!(value["fragments"]["main_per_pass"][1], 1500);
        assert_eq!(value["left_out"][0]["why"], "no translucent polygons");
    }

    #[test]
    fn has_null_where_a_device_has_nothing() {
        let value: serde_json::Value = serde_json::from_str(&results().runs[2].to_json().unwrap()).unwrap();
        for key in ["cull", "mark", "invocations", "gpu_ms", "gpu_ms_per_pass", "error", "build_ms"] {
            assert_eq!(value[key], serde_json::Value::Null, "{key}");
        }
    }

    #[test]
    fn keeps_an_infinite_error() {
        let mut run = run("rc", &[1], &[]);
        run.error = Some(ErrorRecord {
            max: f64::INFINITY,
            rmse: f64::INFINITY,
            psnr: None,
            undecided: 0,
            reference: String::new(),
        });
        let text = run.to_json().unwrap();
        assert!(text.contains("\"max\": null"));
        assert_eq!(Run::from_json("run.json", &text).unwrap(), run);
    }

    #[test]
    fn refuses_another_version() {
        let text = results().to_json().unwrap().replacen("\"version\": 1", "\"version\": 7", 1);
        let error = Results::from_json("old.json", &text).unwrap_err().to_string();
        assert!(error.contains("old.json") && error.contains("version 7"), "{error}");
    }

    #[test]
    fn refuses_truncated_text_and_a_stray_spread() {
        let text = results().to_json().unwrap();
        for length in (0..text.len() - 2).step_by(97) {
            assert!(Results::from_json("cut.json", &text[..length]).is_err(), "{length}");
        }
        assert!(serde_json::from_str::<Timings>(r#"{"a_stats": {"min":0,"max":1,"mad":0,"n":2}}"#).is_err());
    }
}

mod rows_of_csv {
    use super::*;

    #[test]
    fn one_a_run_under_documented_names() {
        let text = csv(&results()).unwrap();
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        let heading = reader.headers().unwrap().clone();
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), 3);
        let column = |name: &str| heading.iter().position(|h| h == name).unwrap_or_else(|| panic!("no column {name}"));
        let at = |row: usize, name: &str| rows[row][column(name)].to_string();
        assert_eq!(&heading[0], "scene");
        assert_eq!(at(0, "method"), "rc-block");
        assert_eq!(at(0, "fragments_main"), "12000");
        assert_eq!(at(1, "fragments_main_per_pass"), "1500 1500 0");
        assert_eq!(at(1, "gpu_total_ms"), "6");
        assert_eq!(at(1, "gpu_main_ms_mad"), "1");
        assert_eq!(at(1, "gpu_main_ms_n"), "3");
        assert_eq!(at(1, "memory_bytes"), "5000000");
        assert_eq!(at(1, "settings.sampling.step"), "1.0");
        assert_eq!(at(1, "settings.image.size"), "[500,500]");
        assert_eq!(at(1, "commit"), "0123abc");
        for name in ["gpu_total_ms", "gpu_main_ms", "error_max", "cull", "invocations_main"] {
            assert_eq!(at(2, name), "", "{name}");
        }
    }
}

mod comparer {
    use super::*;

    #[test]
    fn finds_equal_pictures_equal() {
        let mut a = picture([7, 5]);
        a.pixels[3][0] = f32::NAN;
        let e = compare(&a, &a.clone(), None).unwrap();
        assert_eq!((e.max, e.rmse, e.psnr, e.worst_pixel, e.differing), (0.0, 0.0, None, None, 0));
    }

    #[test]
    fn sees_one_altered_pixel() {
        let a = picture([7, 5]);
        let mut b = a.clone();
        b.pixels[2 * 7 + 4][3] += 0.25;
        let e = compare(&a, &b, None).unwrap();
        assert_eq!((e.max, e.worst_pixel, e.differing), (0.25, Some([4, 2]), 1));
        let rmse = (0.25_f64.powi(2) / 140.0).sqrt();
        assert!((e.rmse - rmse).abs() < 1e-15, "{}", e.rmse);
        assert!((e.psnr.unwrap() - 33.5025).abs() < 1e-3, "{:?}", e.psnr);
    }

    #[test]
    fn leaves_undecided_pixels_out_of_the_maximum_only() {
        let a = picture([7, 5]);
        let mut b = a.clone();
        b.pixels[9][1] = 0.75;
        let mut skip = vec![false; 35];
        skip[9] = true;
        let e = compare(&a, &b, Some(&skip)).unwrap();
        assert_eq!((e.max, e.worst_pixel, e.differing, e.undecided), (0.0, None, 0, 1));
        assert!(e.rmse > 0.0);
    }

    #[test]
    fn finds_what_is_no_number_infinitely_far() {
        let a = picture([7, 5]);
        for bad in [f32::NAN, f32::INFINITY] {
            let mut b = a.clone();
            b.pixels[0][2] = bad;
            let e = compare(&a, &b, None).unwrap();
            assert_eq!((e.max, e.rmse, e.psnr, e.differing), (f64::INFINITY, f64::INFINITY, None, 1));
        }
    }

    #[test]
    fn refuses_other_sizes() {
        assert!(compare(&picture([7, 5]), &picture([5, 7]), None).is_err());
        assert!(compare(&picture([7, 5]), &picture([7, 5]), Some(&[true])).is_err());
        let broken = Picture { size: [7, 5], pixels: Vec::new() };
        assert!(compare(&broken, &picture([7, 5]), None).is_err());
        assert!(Picture::new([0, 5], Vec::new()).is_err());
    }

    #[test]
    fn draws_the_difference() {
        let a = picture([2, 1]);
        let mut b = a.clone();
        b.pixels[1][0] += 0.0625;
        let d = difference(&a, &b, 4.0).unwrap();
        assert_eq!(d.pixels[0], [0.0, 0.0, 0.0, 1.0]);
        assert!((d.pixels[1][1] - 0.25).abs() < 1e-6);
    }
}

mod picture_files {
    use super::*;

    #[test]
    fn png_is_srgb_over_the_background() {
        let p = Picture::new([3, 1], vec![[0.0; 4], [0.2, 0.0, 0.0, 0.5], [2.0, f32::NAN, 0.5, 1.0]]).unwrap();
        let bytes = p.encode(Format::Png, [1.0, 0.5, 0.0]).unwrap();
        let read = image::load_from_memory(&bytes).unwrap().into_rgb8();
        assert_eq!(read.dimensions(), (3, 1));
        // sRGB of 0.5 is 187.5, of 0.25 136.96, of 0.7 217.9.
        assert_eq!(read.get_pixel(0, 0).0, [255, 188, 0]);
        assert_eq!(read.get_pixel(1, 0).0, [218, 137, 0]);
        assert_eq!(read.get_pixel(2, 0).0, [255, 0, 188]);
    }

    #[test]
    fn exr_holds_the_floats() {
        let p = picture([7, 5]);
        let bytes = p.encode(Format::Exr, [1.0; 3]).unwrap();
        let read = image::load_from_memory_with_format(&bytes, image::ImageFormat::OpenExr).unwrap().into_rgba32f();
        assert_eq!(read.dimensions(), (7, 5));
        assert_eq!(read.as_raw().as_slice(), p.pixels.as_flattened());
    }

    #[test]
    fn npy_holds_the_floats() {
        let p = picture([7, 5]);
        let bytes = p.encode(Format::Npy, [1.0; 3]).unwrap();
        let file = npyz::NpyFile::new(&bytes[..]).unwrap();
        assert_eq!(file.shape(), [5, 7, 4]);
        assert_eq!(file.into_vec::<f32>().unwrap(), p.pixels.as_flattened());
    }

    #[test]
    fn appear_whole_under_their_name() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.png");
        picture([4, 4]).write(&path, [0.0; 3]).unwrap();
        picture([7, 5]).write(&path, [0.0; 3]).unwrap();
        assert_eq!(image::image_dimensions(&path).unwrap(), (7, 5));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "a temporary file was left behind");
    }

    #[test]
    fn of_an_unknown_kind_are_refused() {
        for (name, word) in [("out.jpg", ".jpg"), ("out", "extension")] {
            let error = picture([1, 1]).write(Path::new(name), [0.0; 3]).unwrap_err().to_string();
            assert!(error.contains(word) && error.contains(".png, .exr or .npy"), "{error}");
        }
        assert_eq!(Format::of(Path::new("-")).unwrap(), Format::Png);
        assert_eq!(Format::of(Path::new("-.npy")).unwrap(), Format::Npy);
        assert_eq!(Format::of(Path::new("A.EXR")).unwrap(), Format::Exr);
    }

    #[test]
    fn in_an_impossible_place_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        write_atomically(&file, b"x").unwrap();
        let error = write_atomically(&file.join("below"), b"x").unwrap_err();
        assert_eq!(error.exit_code(), 6);
        assert!(error.to_string().contains("choose another folder"), "{error}");
        assert!(write_atomically(folder.path(), b"x").unwrap_err().to_string().contains("is a folder"));
        assert_eq!(std::fs::read(&file).unwrap(), b"x");
    }

    #[cfg(unix)]
    #[test]
    fn go_through_links_and_into_devices() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        std::fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_atomically(&link, b"new").unwrap();
        assert!(link.is_symlink());
        assert_eq!(std::fs::read(&file).unwrap(), b"new");
        write_atomically(Path::new("/dev/null"), b"gone").unwrap();
        assert!(!Path::new("/dev/null").is_file());
    }
}

mod text_table {
    use super::*;

    #[test]
    fn is_as_it_was() {
        let expected = include_str!("golden/table.txt");
        let actual = table(&results().runs);
        assert!(actual == expected, "the table changed; if it should, put this into tests/golden/table.txt:\n{actual}");
    }

    #[test]
    fn compares_only_what_differs_in_the_method_alone() {
        let mut runs = results().runs;
        runs[1].settings.sampling.step = 0.5;
        assert_eq!(groups(&runs).len(), 2);
        assert!(table(&runs).contains("no rc-block run of this scene"));
    }

    #[test]
    fn takes_the_papers_order_as_its_measure() {
        let mut runs = results().runs;
        let mut first = run("rc-block", &[100, 100, 0], &[50, 50]);
        first.settings.method.block_first = true;
        runs.insert(0, first);
        let text = table(&runs);
        assert!(text.contains("rc-block (block first)"), "{text}");
        assert_eq!(groups(&runs)[0].baseline().unwrap().fragments.main, 12_000);
    }
}

mod plots {
    use super::*;

    #[test]
    fn name_their_axes_and_lines() {
        let results = results();
        let group = &groups(&results.runs)[0];
        let fragments = fragments_svg(group).unwrap().unwrap();
        for text in ["pass", "fragments in the pass", "rc-block", "nn-omni", "10,000", "0 stands one decade below 1"] {
            assert!(fragments.contains(text), "{text}");
        }
        let times = times_svg(group).unwrap().unwrap();
        for text in ["device time of a frame / ms", "nn-omni, bounds + copy", "setup", "intermediate", "6.00"] {
            assert!(times.contains(text), "{text}");
        }
        assert!(!times.contains("cpu"), "a run without device time stands among device times");
    }

    #[test]
    fn fall_back_to_cpu_time() {
        let mut runs = results().runs;
        runs.iter_mut().for_each(|run| run.gpu_ms = None);
        assert!(times_svg(&groups(&runs)[0]).unwrap().unwrap().contains("CPU time of a frame"));
    }

    #[test]
    fn of_nothing_are_not_drawn() {
        let mut nothing = run("rc", &[], &[]);
        (nothing.gpu_ms, nothing.host) = (None, HostTimes::default());
        let runs = [nothing];
        let group = &groups(&runs)[0];
        assert_eq!((fragments_svg(group).unwrap(), times_svg(group).unwrap()), (None, None));
    }

    #[test]
    fn of_extreme_counts_are_drawn() {
        let runs = [run("rc", &[u64::MAX, 0, 1], &[]), run("rc-ert", &[7; 3000], &[0; 3000])];
        assert!(fragments_svg(&groups(&runs)[0]).unwrap().is_some());
    }
}

mod report {
    use super::*;

    fn page(results: &Results) -> String {
        let pictures: Vec<_> = (0..results.runs.len()).map(|i| (i, picture([8, 6]))).collect();
        let differences = [Difference { run: 1, gain: 64.0, picture: picture([8, 6]) }];
        let title = "Depth-bounds culling";
        report_html(&ReportInput { title, results, pictures: &pictures, differences: &differences }).unwrap()
    }

    #[test]
    fn says_first_what_was_saved() {
        let page = page(&results());
        // 3,000 of 12,000 and 2,500 of 20,000.
        let claim = "fuel (front): nn-omni runs 75.0 % fewer main fragments (3,000 against 12,000) and 87.5 % fewer \
                     intermediate fragments (2,500 against 20,000) than rc-block.";
        let first = page.find("<p>").unwrap();
        assert!(page[first..].starts_with(&format!("<p>{claim}</p>")), "{}", &page[first..first + 300]);
    }

    #[test]
    fn says_so_where_nothing_was_saved() {
        let mut results = results();
        results.runs[1].fragments = Counts::of(vec![15_000], vec![20_000]);
        let text = page(&results);
        assert!(text.contains("25.0 % more main fragments") && text.contains("no fewer intermediate fragments"));
        results.runs.remove(1);
        assert!(page(&results).contains("no nn-omni run"));
    }

    #[test]
    fn needs_nothing_from_elsewhere() {
        let page = page(&results());
        assert!(!page.contains("http"));
        assert!(!page.contains("<link") && !page.contains("<script") && !page.contains("@import"));
    }

    #[test]
    fn has_a_picture_a_run_the_difference_the_plots_and_the_plan() {
        let page = page(&results());
        assert_eq!(page.matches("<img src=\"data:image/png;base64,").count(), 4);
        assert_eq!(page.matches("<svg").count(), 2);
        for text in ["fragments in the pass", "device time of a frame / ms", "0 stands one decade below 1"] {
            assert!(page.contains(text), "{text}");
        }
        for text in ["no translucent polygons", "main_pass #0", "samples_per_pass", "Mesa 22.3.6", "0123abc"] {
            assert!(page.contains(text), "{text}");
        }
    }

    #[test]
    fn escapes_every_text_of_a_run() {
        let evil = "<script>alert('x')</script>&\"";
        let mut results = results();
        for run in &mut results.runs {
            for text in [&mut run.scene, &mut run.view, &mut run.device, &mut run.driver, &mut run.plan[0]] {
                *text = evil.into();
            }
            run.method.push_str(evil);
            run.cull = Some(evil.into());
            run.mark = Some(evil.into());
            run.notes = vec![evil.into()];
            run.self_check = BTreeMap::from([(evil.into(), evil.into())]);
            run.memory = BTreeMap::from([(evil.into(), 1)]);
            run.left_out = vec![LeftOut { what: evil.into(), why: evil.into() }];
            run.settings.volume.builtin = Some(evil.into());
            if let Some(gpu) = &mut run.gpu_ms {
                gpu.0[0].0 = evil.into();
            }
            if let Some(error) = &mut run.error {
                error.reference = evil.into();
            }
        }
        for text in [&mut results.program, &mut results.commit, &mut results.command, &mut results.date] {
            *text = evil.into();
        }
        let page = page(&results);
        assert!(!page.contains("<script") && !page.contains("('x')"));
        assert!(page.contains("&lt;script&gt;"));
    }

    #[test]
    fn names_the_run_whose_picture_is_broken() {
        let results = results();
        let pictures = [(1, Picture { size: [3, 3], pixels: Vec::new() })];
        let input = ReportInput { title: "t", results: &results, pictures: &pictures, differences: &[] };
        let error = report_html(&input).unwrap_err().to_string();
        assert!(error.contains("picture of fuel, nn-omni"), "{error}");
    }
}
