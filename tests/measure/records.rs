//! Statistics, numbers, JSON and CSV.

use depthleap::experiment::bench::csv;
use depthleap::measure::Results;
use depthleap::measure::Run;
use depthleap::measure::Statistics;
use depthleap::measure::Timings;
use depthleap::measure::record::ErrorRecord;
use depthleap::measure::record::TextureRecord;
use depthleap::report::number::milliseconds;
use depthleap::report::number::percent;
use depthleap::report::number::thousands;

use crate::runs::{results, run};

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
                        build_ms_stats bytes memory ideal error device driver self_check left_out plan notes orbit effect saved \
                        settings texture warnings auto";
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
        let mut results = results();
        let kept = TextureRecord { format: "r16".into(), x_error: 0.001, pixel_error: 0.5, measured: true };
        (results.runs[0].texture, results.runs[0].warnings) = (Some(kept), vec!["one".into(), "two".into()]);
        let text = csv(&results).unwrap();
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
        assert_eq!((at(0, "texture"), at(0, "texture_x_error")), ("r16".to_owned(), "0.001".to_owned()));
        assert_eq!((at(0, "warnings"), at(1, "warnings")), ("one; two".to_owned(), String::new()));
        for name in ["gpu_total_ms", "gpu_main_ms", "error_max", "cull", "invocations_main"] {
            assert_eq!(at(2, name), "", "{name}");
        }
    }
}
