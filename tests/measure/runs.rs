//! Runs with small counts, and a picture, for all tests of this program.

use depthleap::measure::HostTimes;
use depthleap::measure::Picture;
use depthleap::measure::Results;
use depthleap::measure::Run;
use depthleap::measure::Timing;
use depthleap::measure::Timings;
use depthleap::measure::record::CountsRecord;
use depthleap::measure::record::ErrorRecord;
use depthleap::measure::record::FORMAT;
use depthleap::measure::record::Ideal;
use depthleap::measure::record::LeftOutRecord;
use depthleap::measure::record::PassTimes;
use depthleap::provenance::Provenance;
use depthleap::scene::Settings;
use std::collections::BTreeMap;
/// A run as `frame` would fill it, with small counts one can check by eye.
pub fn run(method: &str, main: &[u64], intermediate: &[u64]) -> Run {
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
        fragments: CountsRecord::of(main.to_vec(), intermediate.to_vec()),
        invocations: near.then(|| CountsRecord::of(main.to_vec(), intermediate.to_vec())),
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
        left_out: vec![LeftOutRecord { what: "depth_peel".into(), why: "no translucent polygons".into() }],
        plan: vec![" 1 ray_setup".into(), " 2 main_pass #0".into()],
        notes: vec!["software driver".into()],
        texture: None,
        warnings: Vec::new(),
        orbit: None,
        effect: None,
        auto: None,
        saved: None,
        settings: Settings::default(),
    }
}

pub fn results() -> Results {
    let mut cpu = run("cpu", &[10_000, 9_000], &[10_000]);
    (cpu.cull, cpu.gpu_ms, cpu.gpu_ms_per_pass, cpu.error) = (None, None, None, None);
    Results {
        provenance: Provenance {
            version: FORMAT,
            program: "depthleap 0.1.0".into(),
            commit: "0123abc".into(),
            command: "depthleap bench fuel.toml -o out".into(),
            date: "2005-07-01T12:00:00Z".into(),
        },
        runs: vec![
            run("rc-block", &[10_000, 2_000, 0], &[10_000, 10_000]),
            run("nn-omni", &[1_500, 1_500, 0], &[2_000, 500]),
            cpu,
        ],
        pictures: Vec::new(),
    }
}

pub fn picture(size: [u32; 2]) -> Picture {
    let pixels = (0..size[0] * size[1]).map(|i| [0.001 * i as f32, 0.25, 0.125, 0.5]).collect();
    Picture::new(size, pixels).unwrap()
}
