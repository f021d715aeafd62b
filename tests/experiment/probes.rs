//! What a probe found as text, as a page, as a record, and against another one.

use depthleap::experiment::probe::{compare, page, summary, text};
use depthleap::probe::case::Case;
use depthleap::probe::correct::CaseFault;
use depthleap::probe::marks::MarkCost;
use depthleap::probe::measure::{Cost, Mixed, ProbeClock};
use depthleap::probe::record::{self, Correct, DeviceRecord, FORMAT, MechanismRecord, Probe};
use depthleap::probe::{CaseShader, Compare, Culling, CullingVerdict, History, Mechanism};
use depthleap::provenance::Provenance;

fn case(mechanism: Mechanism, shader: CaseShader) -> Case {
    Case { mechanism, shader, compare: Compare::GreaterOrEqual }
}

/// A probe of two lines: one culled early in squares of 4, one wrong.
fn record() -> Probe {
    let cost = |culling, share| Cost {
        invocations: Some([65_536, 0]),
        none_ms: vec![10.0; 3],
        all_ms: vec![10.0 * share; 3],
        verdict: CullingVerdict { culling, by: "time".into(), share: Some(share), remark: None },
        mixed: Vec::new(),
        tile: None,
    };
    let early = Cost {
        mixed: vec![Mixed {
            pattern: "4 px".into(),
            rejected: 0.5,
            invocations: None,
            ms: vec![5.0],
            saved: Some(0.9),
        }],
        tile: Some(4),
        ..cost(Culling::Early, 0.02)
    };
    let wrong = case(Mechanism::BoundsCompare, CaseShader::DepthLess);
    // No sample was counted of those that pass.
    let fault = CaseFault {
        what: "count".into(),
        format: "D32_SFLOAT".into(),
        history: History::Copy,
        bounds: [0.2, 0.4],
        drawn: 0.8,
        stored: None,
        written: None,
        expected: 8.0,
        got: 0.0,
        pixels: [28, 28],
    };
    let line = |case: Case, cost, faults| MechanismRecord {
        case,
        promise: case.promise(),
        missing: None,
        correct: vec![Correct { format: "D32_SFLOAT".into(), faults }],
        cost: Some(cost),
        others: Vec::new(),
        rejected_per_second: Some(1.5e9),
    };
    Probe {
        provenance: Provenance {
            version: FORMAT,
            program: "depthleap".into(),
            commit: "abc".into(),
            command: "depthleap probe".into(),
            date: "2026-01-02T03:04:05Z".into(),
        },
        device: DeviceRecord {
            name: "A <device>".into(),
            driver: "a driver 1".into(),
            driver_version: "1".into(),
            api_version: "1.3.0".into(),
            depth_bounds: true,
            occlusion_precise: true,
            pipeline_statistics: true,
            timestamp_valid_bits: 64,
        },
        clock: ProbeClock::Timestamps,
        statistics: None,
        work: 100,
        sides: [64, 256, 256],
        quick: true,
        formats: vec!["D32_SFLOAT".into()],
        lines: vec![
            line(case(Mechanism::BoundsRead, CaseShader::Early), early, Vec::new()),
            line(wrong, cost(Culling::Late, 1.0), vec![fault]),
        ],
        marks: MarkCost { side: 512, fragdepth_ms: vec![2.0, 2.2, 2.1], copy_ms: vec![1.0] },
    }
}

#[test]
fn records_are_read_as_written() {
    let json = serde_json::to_string(&record()).unwrap();
    assert_eq!(record::read(&json, "a.json").unwrap(), record());
    for (text, part) in
        [("{", "not a result of a probe"), ("{\"version\": 77}", "77"), ("{\"version\": 1}", "not a result")]
    {
        let error = record::read(text, "a.json").unwrap_err().to_string();
        assert!(error.contains("a.json") && error.contains(part), "{error}");
    }
}

#[test]
fn table_and_page_say_what_was_found() {
    let (table, page) = (text(&record()), page(&record()));
    for part in
        ["early, from 4 px", "promised", "WRONG in D32_SFLOAT", "late", "1.5 G", "count wrong in", "1 of 2 cases"]
    {
        assert!(table.contains(part), "{part} is not in\n{table}");
    }
    for part in ["A &lt;device&gt;", "2 %", "✗", "count wrong in", "90 %"] {
        assert!(page.contains(part), "{part}");
    }
    let sentences = summary(&record()).join("\n");
    assert!(sentences.contains("always where the shader writes nothing but colour"), "{sentences}");
    assert!(sentences.contains("never where it changes depth"), "{sentences}");
    assert!(sentences.contains("2.100 ms by gl_FragDepth and 1.000 ms by a copy"), "{sentences}");
    let mut without = record();
    without.lines.iter_mut().for_each(|line| line.missing = Some("no depth bounds test".into()));
    assert!(summary(&without).join("\n").contains("The device has no depth bounds test."));
}

#[test]
fn comparison_names_what_differs_and_nothing_else() {
    let ours = record();
    assert_eq!(compare(&ours, &ours)[2..], ["No difference."]);
    let mut other = ours.clone();
    other.lines[0].cost.as_mut().unwrap().verdict.culling = Culling::Late;
    other.lines[0].rejected_per_second = Some(1.4e9);
    other.lines[1].correct[0].faults.clear();
    let found = compare(&ours, &other);
    assert_eq!(found.len(), 4, "{found:?}");
    assert!(found[2].contains("culled: early, from 4 px; other: late"), "{found:?}");
    assert!(found[3].contains("right: WRONG in D32_SFLOAT; other: yes"), "{found:?}");
    other.lines[0].rejected_per_second = Some(0.5e9);
    other.statistics = Some("constant".into());
    assert_eq!(compare(&ours, &other).len(), 6);
    // A format that one was not asked for is no difference.
    let mut more = ours.clone();
    let fault = ours.lines[1].correct[0].faults.clone();
    more.lines[0].correct.push(Correct { format: "D16_UNORM".into(), faults: fault });
    assert_eq!(compare(&more, &ours)[2..], ["No difference."]);
}
