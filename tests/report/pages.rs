//! Tables, plots and the report.

use depthleap::experiment::bench::page as bench_page;
use depthleap::experiment::bench::table;
use depthleap::measure::HostTimes;
use depthleap::measure::Results;
use depthleap::measure::picture::PictureFormat;
use depthleap::measure::record::CountsRecord;
use depthleap::measure::record::DifferenceRecord;
use depthleap::measure::record::LeftOutRecord;
use depthleap::measure::record::PictureRecord;
use depthleap::report::comparison::groups;
use depthleap::report::html::Png;
use depthleap::report::plot::fragments_svg;
use depthleap::report::plot::times_svg;
use std::collections::BTreeMap;

use crate::runs::{picture, results, run};

mod text_table {
    use super::*;

    #[test]
    fn is_as_it_was() {
        let expected = include_str!("../golden/table.txt");
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

    /// With a picture for each run, and a difference for the second.
    fn page(results: &Results) -> String {
        let mut results = results.clone();
        let difference = DifferenceRecord { file: "difference.png".into(), gain: 64.0 };
        let record =
            |run| PictureRecord { run, file: format!("{run}.png"), difference: (run == 1).then(|| difference.clone()) };
        let bytes = picture([8, 6]).encode(PictureFormat::Png, [0.0; 3]).unwrap();
        let png = Png { bytes, size: [8, 6] };
        results.pictures = (0..results.runs.len()).map(record).collect();
        bench_page(&results, None, &|_| Ok(png.clone())).unwrap()
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
        results.runs[1].fragments = CountsRecord::of(vec![15_000], vec![20_000]);
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
            run.left_out = vec![LeftOutRecord { what: evil.into(), why: evil.into() }];
            run.settings.volume.builtin = Some(evil.into());
            if let Some(gpu) = &mut run.gpu_ms {
                gpu.0[0].0 = evil.into();
            }
            if let Some(error) = &mut run.error {
                error.reference = evil.into();
            }
        }
        for text in {
            let made = &mut results.provenance;
            [&mut made.program, &mut made.commit, &mut made.command, &mut made.date]
        } {
            *text = evil.into();
        }
        let page = page(&results);
        assert!(!page.contains("<script") && !page.contains("('x')"));
        assert!(page.contains("&lt;script&gt;"));
    }

    #[test]
    fn says_which_pictures_are_missing() {
        let mut results = results();
        results.pictures = vec![PictureRecord { run: 1, file: "pictures/<b>.png".into(), difference: None }];
        let page = bench_page(&results, None, &|_| Err("there is no such file".into())).unwrap();
        assert!(page.contains("The picture pictures/&lt;b&gt;.png is missing: there is no such file."), "{page}");
        assert!(!page.contains("<img"));
    }
}
