//! How long distance structures take to build: compute shaders beside the host, in CPU time of the process on a CPU
//! device, else device time. Median of several builds with warm pipelines; builders take turns. Then what the host takes to
//! update its distances when the transfer function moves, beside a build of the same run.
//!
//! `cargo bench --bench build [-- CELL,...]`: cells of 1 and 4 voxels by default. Without `../shared/data` it runs on
//! a built-in volume.

use std::path::Path;

use cpu_time::ProcessTime;
use depthleap::frame::{Resident, Structures};
use depthleap::method;
use depthleap::plan::plan;
use depthleap::resource::texels::Texels;
use depthleap::scene::settings::MethodName;
use depthleap::scene::{Scene, Settings};
use depthleap::structure::update::Updatable;
use depthleap::structure::{self, Lookup};
use depthleap::vulkan::{Device, Instance, pick};
use depthleap::{Error, Result, read};

const RUNS: usize = 5;
const METHODS: [MethodName; 4] =
    [method::NN_OMNI.name(), method::NN_DIRECTIONAL.name(), method::NN_OPTIMAL.name(), method::NN_CONE.name()];

fn main() -> Result<()> {
    let cells: Vec<u32> = match std::env::args().find(|a| a.starts_with(|c: char| c.is_ascii_digit())) {
        Some(list) => list.split(',').filter_map(|cell| cell.parse().ok()).collect(),
        None => vec![1, 4],
    };
    let instance = Instance::new(false)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    println!("{}, {} {}", info.name, info.driver_name, info.driver_info);
    let device = Device::new(&instance, &info, false)?;
    for (name, settings) in scenes() {
        let mut scene = read::scene(&settings)?;
        let mut resident = Resident::new(&device);
        for cell in &cells {
            scene.settings.method.cell = *cell;
            let mut omni = None;
            for method in METHODS {
                scene.settings.method.name = method;
                let plan = plan(&scene, method::papers_form(method))?;
                let lookup =
                    plan.distance.ok_or_else(|| Error::usage(method.name(), "reads no distances", "pick another"))?;
                let mut times: [Vec<f64>; 3] = Default::default();
                for run in 0..=RUNS {
                    resident.forget_transfer();
                    resident.prepare(&scene, &plan)?;
                    let Some([whole, view]) = resident.build_ms(&plan) else { continue };
                    let mut host = Structures::default();
                    host.prepare(&scene, &plan);
                    // The first one warms up.
                    if run > 0 {
                        times[0].push(whole);
                        times[1].push(view);
                        times[2].push(host.distance(&lookup).map_or(f64::NAN, |built| built.cpu_ms));
                    }
                }
                let [whole, view, host] = times.map(median);
                let omni = *omni.get_or_insert(whole);
                println!(
                    "{name:<10} cell {cell}  {:<15} device {whole:>7.1} ms ({:.2} of omni), a new view {view:>7.1} ms; host {host:>7.1} ms",
                    method.name(),
                    whole / omni,
                );
                if lookup.view.is_none() {
                    follow(&scene, &lookup, &format!("{name:<10} cell {cell}  {:<15}", method.name()));
                }
            }
        }
    }
    Ok(())
}

/// One code of 8 bits, in x.
const CODE: f64 = 1.0 / 255.0;
/// So little of it that no voxel of 8 bits shows that did not before.
const PART_OF_CODE: f64 = 0.1 * CODE;

/// How long the host takes to follow a transfer function that moves there and back.
fn follow(scene: &Scene, lookup: &Lookup, name: &str) {
    let texels = Texels::of(scene);
    let shown = |by: f64| {
        let mut moved = scene.clone();
        moved.transfer = scene.transfer.mapped(|x| x + by);
        texels.shown(&moved)
    };
    let build = || drop(std::hint::black_box(structure::build(&scene.field, &texels.values, &shown(0.0), lookup)));
    let Some(mut kept) = Updatable::new(&scene.field, &texels.values, &shown(0.0), lookup) else { return };
    let mut times: [Vec<f64>; 3] = Default::default();
    for _ in 0..RUNS {
        times[0].push(cpu_ms(build));
        for (by, times) in [CODE, PART_OF_CODE].into_iter().zip(&mut times[1..]) {
            for shown in [shown(by), shown(0.0)] {
                times.push(cpu_ms(|| kept.update(&scene.field, &texels.values, &shown)));
            }
        }
    }
    let [build, code, part] = times.map(median);
    println!(
        "{name} transfer function moved by one code: {code:>5.1} ms of a build's {build:>5.1} on the host ({:.2}), \
         so that no cell changes: {part:.2} ms",
        code / build,
    );
}

/// CPU time of the process, milliseconds.
fn cpu_ms(run: impl FnOnce()) -> f64 {
    let begin = ProcessTime::now();
    run();
    begin.elapsed().as_secs_f64() * 1e3
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

fn scenes() -> Vec<(String, Settings)> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data"));
    let ramp = || {
        let mut settings = Settings::default();
        settings.transfer.preset = Some("ramp".to_owned());
        settings
    };
    let mut scenes = Vec::new();
    for name in ["aneurism", "mri_head"] {
        let path = folder.join(name).with_extension("nrrd");
        if path.is_file() {
            let mut settings = ramp();
            settings.volume.path = Some(path);
            scenes.push((name.to_owned(), settings));
        }
    }
    if scenes.is_empty() {
        println!("{} is not there: a built-in volume instead", folder.display());
        let mut settings = ramp();
        settings.volume.builtin = Some("jets:256".to_owned());
        scenes.push(("jets:256".to_owned(), settings));
    }
    scenes
}
