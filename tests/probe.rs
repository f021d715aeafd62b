//! The probe without a device: its rule, its verdicts, what it says; and that its shaders are what their rows say.

use depthleap::glsl;
use depthleap::probe::case::{Case, Conservative, FORMATS, format_name};
use depthleap::probe::correct::differences;
use depthleap::probe::decide::{MeasuredWork, decide, doubtful, saved, tile, time_share};
use depthleap::probe::depth::{LEAST_NORMAL, Precision};
use depthleap::probe::rig::{Input, Left};
use depthleap::probe::rule::{Fragment, Promise, Setup};
use depthleap::probe::statistics::{Known, doubt};
use depthleap::probe::{CaseShader, Compare, Culling, History, Mechanism, Pattern};
use depthleap::vulkan::{self, vk};

fn case(mechanism: Mechanism, shader: CaseShader) -> Case {
    Case { mechanism, shader, compare: Compare::GreaterOrEqual }
}

#[test]
fn shaders_declare_what_their_rows_say() {
    let mut seen = std::collections::BTreeSet::new();
    for case in Case::all() {
        let shader = case.fragment();
        let (name, words) = (shader.to_string(), glsl::module(&shader).unwrap());
        let module = vulkan::ShaderModule::new(&name, &words).unwrap();
        let has = |mode: &str| module.execution_modes.iter().any(|m| m == mode);
        let binds = |binding: &str| module.bindings.iter().any(|b| b.name == binding);
        let depth = case.shader.conservative();
        assert_eq!(has("EarlyFragmentTests"), case.shader.early(), "{name}");
        assert_eq!(has("DepthReplacing"), depth.is_some(), "{name}");
        assert_eq!(has("DepthLess"), depth == Some(Conservative::Less), "{name}");
        assert_eq!(has("DepthGreater"), depth == Some(Conservative::Greater), "{name}");
        assert_eq!(has("DepthUnchanged"), depth == Some(Conservative::Unchanged), "{name}");
        assert_eq!(binds("counter"), case.shader.counts(), "{name}");
        assert_eq!(binds("touched"), case.shader.touches(), "{name}");
        assert_eq!(binds("stored"), case.mechanism.in_shader(), "{name}");
        // OpKill, OpTerminateInvocation, OpDemoteToHelperInvocation.
        let discards = opcodes(&words).any(|op| [252, 4416, 5380].contains(&op));
        assert_eq!(discards, case.shader == CaseShader::Discards || case.mechanism.in_shader(), "{name}");
        seen.insert(name);
    }
    // 13 kinds, and 5 of them for each of the two ways to look at the stored depth.
    assert_eq!(seen.len(), 23, "{seen:?}");
}

fn opcodes(words: &[u32]) -> impl Iterator<Item = u32> + '_ {
    let mut at = 5;
    std::iter::from_fn(move || {
        let word = *words.get(at)?;
        at += (word >> 16).max(1) as usize;
        Some(word & 0xffff)
    })
}

#[test]
fn formats_keep_depths() {
    for format in FORMATS {
        let precision = Precision::of(format);
        for depth in [0.0, 1.0, 0.25, 0.3333, LEAST_NORMAL] {
            let kept = precision.nearest(depth);
            assert!((kept - depth).abs() <= 1.0 / 65535.0 / 2.0 + 1e-7, "{}: {depth}", format_name(format));
            assert_eq!(precision.nearest(kept), kept);
            assert_eq!(precision.decode(precision.code(kept)), kept);
            assert_eq!(precision.codes(&precision.bytes(&[kept])), [precision.code(kept)]);
        }
        let (below, above) = (precision.beside(0.4, -1), precision.beside(0.4, 1));
        assert!(below < precision.nearest(0.4) && precision.nearest(0.4) < above);
        assert_eq!(precision.beside(1.0, 5), 1.0);
        assert_eq!(precision.beside(0.0, -5), 0.0);
    }
    assert_eq!(Precision::Float.beside(0.4, 1), 0.4f32.next_up());
}

#[test]
fn rule_is_the_specifications() {
    let setup = Setup { drawn: 0.8, bounds: [0.2, 0.4] };
    let of = |mechanism, shader, stored, written| {
        case(mechanism, shader).expected(Precision::Float, &setup, &Fragment { stored, written, stencil: true })
    };
    // Bounds compare what is stored, and both ends are in.
    for (stored, passes) in
        [(0.2, true), (0.4, true), (0.2f32.next_down(), false), (0.4f32.next_up(), false), (0.8, false)]
    {
        for mechanism in [Mechanism::BoundsAlone, Mechanism::BoundsRead, Mechanism::BoundsWrite] {
            let found = of(mechanism, CaseShader::DepthAny, stored, 0.3);
            assert_eq!(found.passes, passes, "{mechanism:?}, {stored}");
            let written = passes && mechanism == Mechanism::BoundsWrite;
            assert_eq!(found.depth, if written { 0.3 } else { stored });
            assert!(!found.open);
        }
    }
    // The depth test compares what the shader writes, unless tests are early.
    assert!(of(Mechanism::DepthRead, CaseShader::DepthLess, 0.75, 0.75).passes);
    assert!(!of(Mechanism::DepthRead, CaseShader::DepthLess, 0.75f32.next_up(), 0.75).passes);
    assert!(of(Mechanism::DepthRead, CaseShader::Early, 0.8, 0.1).passes);
    assert!(!of(Mechanism::DepthRead, CaseShader::Plain, 0.8f32.next_up(), 0.9).passes);
    let less = Case { compare: Compare::LessOrEqual, ..case(Mechanism::DepthRead, CaseShader::Plain) };
    assert!(less.expected(Precision::Float, &setup, &Fragment { stored: 0.9, written: 0.0, stencil: true }).passes);
    // Stores are late unless early tests are declared; a shader that looks stores for those alive.
    assert!(of(Mechanism::DepthRead, CaseShader::Buffer, 0.9, 0.0).stores);
    assert!(!of(Mechanism::DepthRead, CaseShader::EarlyBuffer, 0.9, 0.0).stores);
    assert!(!of(Mechanism::Alive, CaseShader::Image, 0.5, 0.0).stores);
    assert!(of(Mechanism::DiscardFirst, CaseShader::Image, 0.4, 0.0).passes);
    let stencil = |stencil| {
        case(Mechanism::Stencil, CaseShader::Plain)
            .expected(Precision::Float, &setup, &Fragment { stored: 0.9, written: 0.0, stencil })
            .passes
    };
    assert!(stencil(true) && !stencil(false));
    // What rounding or flushing decides is open.
    let unorm = Precision::Unorm(16);
    let beside = |by| unorm.beside(0.4, by);
    let open = |stored| {
        case(Mechanism::BoundsRead, CaseShader::Plain)
            .expected(unorm, &setup, &Fragment { stored, written: 0.0, stencil: true })
            .open
    };
    assert!(open(beside(0)) && open(beside(1)) && !open(beside(2)) && !open(beside(-2)));
    let ends = Setup { drawn: 0.8, bounds: [0.0, 0.0] };
    let tiny = Fragment { stored: LEAST_NORMAL / 2.0, written: 0.0, stencil: true };
    assert!(case(Mechanism::BoundsRead, CaseShader::Plain).expected(Precision::Float, &ends, &tiny).open);
}

#[test]
fn each_pattern_passes_and_rejects_whatever_the_shader_writes() {
    for case in Case::all() {
        let (setup, stored) = (case.setup(), case.stored());
        for written in case.writable(setup.drawn) {
            let of = |stored, stencil| case.expected(Precision::Float, &setup, &Fragment { stored, written, stencil });
            assert!(of(stored.alive, true).passes, "{}, {written}", case.name());
            assert!(!of(stored.dead, false).passes, "{}, {written}", case.name());
        }
    }
}

#[test]
fn promises_are_the_specifications() {
    let promise = |mechanism, shader, compare| Case { mechanism, shader, compare }.promise();
    let (ge, le) = (Compare::GreaterOrEqual, Compare::LessOrEqual);
    assert_eq!(promise(Mechanism::BoundsRead, CaseShader::EarlyImage, ge), Promise::Promised);
    assert_eq!(promise(Mechanism::BoundsCompare, CaseShader::DepthAny, ge), Promise::Allowed);
    assert_eq!(promise(Mechanism::BoundsCompare, CaseShader::DepthAnyBuffer, ge), Promise::Forbidden);
    assert_eq!(promise(Mechanism::DepthWrite, CaseShader::DepthLess, ge), Promise::Allowed);
    assert_eq!(promise(Mechanism::DepthWrite, CaseShader::DepthLess, le), Promise::Forbidden);
    assert_eq!(promise(Mechanism::DepthWrite, CaseShader::DepthGreater, le), Promise::Allowed);
    assert_eq!(promise(Mechanism::DepthRead, CaseShader::DepthAny, ge), Promise::Forbidden);
    assert_eq!(promise(Mechanism::Alive, CaseShader::Plain, ge), Promise::Own);
}

#[test]
fn patterns_reject_their_share() {
    let side = 256;
    let share = |pattern: Pattern| {
        pattern.mask(side).iter().filter(|rejected| **rejected).count() as f64 / f64::from(side * side)
    };
    assert_eq!([Pattern::None, Pattern::All, Pattern::Halves].map(share), [0.0, 1.0, 0.5]);
    for pattern in Pattern::MIXED {
        let expected = if let Pattern::Random(percent) = pattern { f64::from(percent) / 100.0 } else { 0.5 };
        let found = share(pattern);
        assert!((found - expected).abs() < 0.01, "{}: {found}", pattern.name());
        assert_eq!(pattern.tile().is_some(), matches!(pattern, Pattern::Checker(_)));
    }
    assert!(Pattern::Checker(8).rejects([8, 0], side) && !Pattern::Checker(8).rejects([8, 8], side));
}

fn times(none: &[f64], all: &[f64]) -> MeasuredWork {
    MeasuredWork { invocations: None, none_ms: none.to_vec(), all_ms: all.to_vec() }
}

#[test]
fn verdicts_by_time() {
    let verdict = |none: &[f64], all: &[f64]| decide(&times(none, all), false);
    assert_eq!(verdict(&[10.0, 10.2, 10.1], &[0.2, 0.3, 0.2]).culling, Culling::Early);
    assert_eq!(verdict(&[10.0, 10.2, 10.1], &[9.9, 10.3, 11.8]).culling, Culling::Late);
    assert_eq!(verdict(&[10.0, 10.2, 10.1], &[5.0, 5.3, 5.1]).culling, Culling::Partly);
    // One draw that other work held up tells nothing; nor do times that say another thing each.
    assert_eq!(verdict(&[10.0, 60.0, 10.1], &[0.2, 9.0, 0.2]).culling, Culling::Early);
    let noisy = verdict(&[10.0, 35.0, 38.0], &[2.0, 11.0, 30.0]);
    assert_eq!((noisy.culling, noisy.by.as_str()), (Culling::Unclear, "nothing"));
    assert_eq!(verdict(&[], &[]).culling, Culling::Unclear);
    assert_eq!(verdict(&[0.0, 0.0], &[0.0, 0.0]).culling, Culling::Unclear);
    assert_eq!(verdict(&[f64::NAN], &[1.0]).culling, Culling::Unclear);
    assert_eq!(time_share(&times(&[10.0], &[1.0])), Some(0.1));
}

#[test]
fn statistics_that_lie_are_not_believed() {
    let early = MeasuredWork { invocations: Some([65_536, 65_536]), ..times(&[10.0, 10.1, 10.0], &[0.3, 0.2, 0.2]) };
    let late = MeasuredWork { invocations: Some([65_536, 0]), ..times(&[10.0, 10.1, 10.0], &[9.8, 10.0, 10.1]) };
    for (measured, truth) in [(&early, Culling::Early), (&late, Culling::Late)] {
        // Found out by draws whose count is known, or else by the time.
        let unbelieved = decide(measured, false);
        assert_eq!((unbelieved.culling, unbelieved.by.as_str(), &unbelieved.remark), (truth, "time", &None));
        let believed = decide(measured, true);
        assert_eq!((believed.culling, believed.by.as_str()), (truth, "time"));
        assert!(believed.remark.unwrap().contains("invocations say"));
    }
    let honest = MeasuredWork { invocations: Some([65_536, 128]), ..times(&[10.0, 10.1, 10.0], &[0.3, 0.2, 0.2]) };
    assert_eq!(decide(&honest, true).by, "invocations and time");
    let untimed = MeasuredWork { invocations: Some([65_536, 65_536]), ..MeasuredWork::default() };
    assert_eq!((decide(&untimed, true).culling, decide(&untimed, false).culling), (Culling::Late, Culling::Unclear));

    let known = Known { pixels: 4096, none: 4096, all: 0, half: 2048 };
    assert_eq!(doubt(&known), None);
    assert_eq!(doubt(&Known { none: 4608, half: 2304, ..known }), None, "helpers at edges");
    let constant = doubt(&Known { none: 4180, all: 4180, half: 4180, ..known }).unwrap();
    assert!(constant.contains("4180") && constant.contains("half of 4096"), "{constant}");
    assert!(doubt(&Known { all: 4096, ..known }).is_some());
    assert!(doubt(&Known { none: 0, half: 0, ..known }).is_some());
    assert!(doubt(&Known { none: 4095 * 2, ..known }).is_some());
}

#[test]
fn tiles_are_where_culling_sets_in() {
    // Lanes of 4 x 2 pixels: squares of 4 are saved, smaller ones partly or not.
    let by_lanes = [(64, 0.99), (32, 0.99), (16, 0.98), (8, 0.98), (4, 0.97), (2, 0.02), (1, 0.0)];
    assert_eq!(tile(&by_lanes), Some(4));
    assert_eq!(tile(&by_lanes.map(|(side, _)| (side, 1.0))), Some(1));
    assert_eq!(tile(&by_lanes.map(|(side, _)| (side, 0.1))), None);
    // A small square that seems saved between larger ones that are not is noise.
    assert_eq!(tile(&[(64, 0.9), (32, 0.2), (16, 0.9)]), Some(64));
    // Which is measured again.
    assert_eq!(doubtful(&[(64, 0.9), (32, 0.2), (16, 0.9)]), Some(32));
    assert_eq!(doubtful(&[(64, 0.1), (32, 0.2), (16, 0.9), (8, 0.0)]), Some(64));
    assert_eq!(doubtful(&by_lanes), None);
    assert_eq!(saved(10.0, 10.0, 0.0, 0.5), Some(0.0));
    assert_eq!(saved(5.0, 10.0, 0.0, 0.5), Some(1.0));
    assert_eq!(saved(7.5, 10.0, 0.0, 0.5), Some(0.5));
    assert_eq!(saved(1.0, 1.0, 1.0, 0.5), None, "nothing can be saved");
}

/// A draw with every edge value, as a driver that is right leaves it.
fn right(case: &Case, format: vk::Format) -> (Input, Left) {
    let precision = Precision::of(format);
    let stored = [0.0, 0.1, 0.25, 0.3, 0.5625, 0.86, 1.0].map(|depth| precision.nearest(depth)).repeat(4);
    let setup = Setup { drawn: precision.nearest(0.8), bounds: [0.2, 0.4].map(|bound| precision.nearest(bound)) };
    let written = vec![precision.nearest(*case.writable(setup.drawn).last().unwrap()); stored.len()];
    let stencil: Vec<u8> = (0..stored.len()).map(|i| (i % 2) as u8).collect();
    let input = Input { setup, stored, written, stencil, history: History::Copy, work: 1, draws: 1 };
    let rule = |i: usize| {
        let fragment = Fragment { stored: input.stored[i], written: input.written[i], stencil: input.stencil[i] == 1 };
        case.expected(precision, &setup, &fragment)
    };
    let all = || (0..input.stored.len()).map(rule);
    let left = Left {
        color: all().map(|rule| f32::from(u8::from(rule.passes))).collect(),
        depth: all().map(|rule| precision.code(rule.depth)).collect(),
        samples: all().filter(|rule| rule.passes).count() as u64,
        touched: case.shader.touches().then(|| all().map(|rule| rule.stores).collect()),
        counted: case.shader.counts().then(|| all().filter(|rule| rule.stores).count() as u32),
    };
    (input, left)
}

#[test]
fn every_fault_is_seen_and_named() {
    for case in Case::all() {
        for format in FORMATS {
            let (input, left) = right(&case, format);
            assert_eq!(differences(format, true, &case, &input, &left), [], "{}", case.name());
            // 0.3 is alive in every mechanism but the depth tests with LESS_OR_EQUAL, and never on an edge.
            let at = 3;
            let broken: [(&str, Left); 5] = [
                ("colour", Left { color: changed(&left.color, at, |c| 1.0 - c), ..left.clone() }),
                ("depth", Left { depth: changed(&left.depth, at, |d| d ^ 64), ..left.clone() }),
                ("count", Left { samples: left.samples + 1, ..left.clone() }),
                (
                    "storage image",
                    Left { touched: left.touched.as_ref().map(|t| changed(t, at, |t| !t)), ..left.clone() },
                ),
                ("storage buffer", Left { counted: left.counted.map(|count| count + 1), ..left.clone() }),
            ];
            for (what, broken) in broken {
                let stores = what == "storage image" && !case.shader.touches()
                    || what == "storage buffer" && !case.shader.counts();
                let found = differences(format, true, &case, &input, &broken);
                let names: Vec<&str> = found.iter().map(|fault| fault.what.as_str()).collect();
                let expected: &[&str] = if stores { &[] } else { &[what] };
                assert_eq!(names, expected, "{}, {}", case.name(), format_name(format));
                for fault in &found {
                    let line = fault.line(&case);
                    for part in [case.mechanism.words(), format_name(format), "after a copy", "expected", "got"] {
                        assert!(line.contains(part), "{line}");
                    }
                }
            }
        }
    }
    // Where counts are not exact, only none and any can be told apart.
    let (input, left) = right(&case(Mechanism::DepthRead, CaseShader::Plain), vk::Format::D32_SFLOAT);
    let count = |samples| {
        let left = Left { samples, ..left.clone() };
        differences(vk::Format::D32_SFLOAT, false, &case(Mechanism::DepthRead, CaseShader::Plain), &input, &left).len()
    };
    assert_eq!((count(1), count(left.samples), count(0)), (0, 0, 1));
}

fn changed<T: Copy>(list: &[T], at: usize, change: impl Fn(T) -> T) -> Vec<T> {
    let mut list = list.to_vec();
    list[at] = change(list[at]);
    list
}
