//! How far the estimates of `auto` are off: frames of volumes by each way of working, with what a look says that they do, what they took, and
//! what they were taken to take by the constants of `src/auto/cost.rs` and by what was measured on the device before (`depthleap render --costs
//! again`). The constants are fitted to these lines.
//!
//! `cargo bench --bench costs [-- PART-OF-NAME]` writes CSV to standard output, and to standard error how far each way of working is off. The
//! name is `aneurism, ramp`. Times are milliseconds of CPU time on a device that is a CPU, else of the device, the least of three. Needs a
//! device and `../shared/data`.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use depthleap::auto::{DeviceCosts, Look, Tuning, Way, Work, build_ms, frame_ms};
use depthleap::frame::{GpuFrame, Measure, Resident, SelfCheck, plan_on, self_check};
use depthleap::measure::costs;
use depthleap::method::{self, METHODS};
use depthleap::part::rows::Method;
use depthleap::scene::settings::{Classification, Settings, Tiles};
use depthleap::scene::{Camera, Scene};
use depthleap::vulkan::{Device, Instance, pick};
use depthleap::{Result, plan, read};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
const VOLUMES: [&str; 4] = ["aneurism", "engine", "fuel", "mri_head"];

/// Pixels of a side, and of small pictures, of which the first two kinds have some.
const SIDE: u32 = 500;
const SMALL: u32 = 160;
const OF_SMALL: usize = 2;

/// What is made of a volume.
type Change = fn(&mut Settings);
const KINDS: [(&str, Change); 6] = [
    ("ramp", |_| {}),
    ("haze", |s| s.transfer.preset = Some("haze".to_owned())),
    ("surface", |s| s.transfer.preset = Some("surface".to_owned())),
    ("ramp pre-integrated", |s| s.sampling.classification = Classification::PreIntegrated),
    ("iso 100", |s| s.surface.iso = Some(100.0)),
    ("mip", |s| s.projection.kind = "mip".parse().unwrap_or_default()),
];

/// M, look-ups in a segment, and voxels along a side of a cell.
const OF_LOOPS: [[u32; 3]; 3] = [[4, 1, 1], [8, 1, 2], [16, 1, 4]];
const OF_PASSES: [[u32; 3]; 3] = [[8, 1, 1], [16, 4, 2], [32, 16, 1]];

/// Times taken, of which the least counts.
const RUNS: usize = 3;

fn main() -> Result<()> {
    // Cargo adds options of its own.
    let asked = std::env::args().skip(1).find(|argument| !argument.starts_with("--")).unwrap_or_default();
    let instance = Instance::new(false)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    let device = Device::new(&instance, &info, false)?;
    let measured = costs::known(&info);
    let mut bench = CostBench { check: self_check(&device)?, device, measured, off: Vec::new() };
    println!(
        "scene,side,method,m,lookups,cell,voxels,pixels,passes,main_lanes,samples,intermediate_lanes,work_lookups,shown,ms,fitted_ms,measured_ms,\
         build_ms,fitted_build_ms"
    );
    let kinds = || KINDS.into_iter().enumerate();
    for (volume, (i, (kind, change))) in VOLUMES.into_iter().flat_map(|volume| kinds().map(move |kind| (volume, kind)))
    {
        let (name, file) = (format!("{volume}, {kind}"), Path::new(DATA).join(format!("{volume}.nrrd")));
        if name.contains(&asked) && file.exists() {
            let mut resident = Resident::new(&bench.device);
            for side in if i < OF_SMALL { &[SIDE, SMALL][..] } else { &[SIDE] } {
                bench.run(&mut resident, &name, &scene(file.clone(), *side, change)?)?;
            }
        }
    }
    bench.say();
    Ok(())
}

fn scene(file: PathBuf, side: u32, change: Change) -> Result<Scene> {
    let mut settings = Settings::default();
    settings.volume.path = Some(file);
    settings.transfer.preset = Some("ramp".to_owned());
    settings.image.size = [side; 2];
    settings.method.tiles = Tiles::All;
    settings.camera.eye = Camera::orbit(30.0, 20.0, 1.91, settings.camera.fov_y).eye.to_array();
    change(&mut settings);
    read::scene(&settings)
}

struct CostBench {
    device: Arc<Device>,
    check: SelfCheck,
    measured: Option<DeviceCosts>,
    /// The logarithm of what a way of working was taken to take, over what it took: by the constants, and by what was measured.
    off: Vec<(Way, [f64; 2])>,
}

impl CostBench {
    /// All methods that are weighed, each with several settings.
    fn run(&mut self, resident: &mut Resident, name: &str, scene: &Scene) -> Result<()> {
        let look = Look::of(scene)?;
        // As compute shaders loops do the same work, cones are found as the optimal is, and other stacks are sampled alike.
        let asked = |method: &&'static Method| {
            let of_view = |other: &Method| method.ahead == other.ahead;
            method.on_device
                && method.takes_samples()
                && !method.goes_through_cells()
                && !method.name.contains("compute")
                && !of_view(&method::NN_CONE)
                && method.stack().is_none_or(|_| method.name.starts_with(method::SLICES_3D.name))
        };
        for method in METHODS.into_iter().filter(asked) {
            let tunings = if method.loops() { &OF_LOOPS[..] } else { &OF_PASSES[..] };
            for (i, [m, lookups, cell]) in tunings.iter().copied().enumerate() {
                // All settings are one to those.
                if i > 0 && (method.loops() && !method.looks_ahead() || method.back_to_front()) {
                    continue;
                }
                let mut scene = scene.clone();
                scene.unit = self.check.unit;
                scene.settings.method.name = method.name();
                scene.settings.sampling.samples_per_pass = m;
                (scene.settings.method.lookups, scene.settings.method.cell) = (lookups, cell);
                if plan::check(&scene).is_ok() {
                    self.time(resident, name, &scene, method, &look)?;
                }
            }
        }
        Ok(())
    }

    fn time(&mut self, resident: &mut Resident, name: &str, scene: &Scene, method: &Method, look: &Look) -> Result<()> {
        let form = plan::form(scene, self.check.automatic(method.name()))?;
        let plan = plan_on(&self.device, scene, form, None)?;
        resident.prepare(scene, &plan)?;
        let mut frame = GpuFrame::new(&self.device, scene, &plan, resident, None)?;
        frame.run(Measure::Nothing)?;
        let mut ms = f64::INFINITY;
        for _ in 0..RUNS {
            ms = ms.min(costs::taken(&mut frame, self.device.info.is_cpu())?);
        }
        let tuning = Tuning::of(&scene.settings);
        let work = Work::of(method, tuning, look);
        let fitted = DeviceCosts::default();
        let of = |costs: &DeviceCosts| frame_ms(method, tuning, &work, scene, costs);
        let [by_fit, by_device] = [of(&fitted), self.measured.as_ref().map_or(f64::NAN, of)];
        self.off.push((Way::of(method), [by_fit, by_device].map(|estimate| (estimate / ms).ln())));
        let built = resident.build_ms(&plan).map_or(0.0, |[ms, _]| ms);
        let Work { pixels, passes, main_lanes, samples, intermediate_lanes, lookups, shown, .. } = work;
        let Tuning { samples_per_pass, lookups: of_segment, cell, .. } = tuning;
        println!(
            "\"{name}\",{},{},{samples_per_pass},{of_segment},{cell},{},{pixels:.0},{passes:.0},{main_lanes:.0},{samples:.0},\
             {intermediate_lanes:.0},{lookups:.0},{shown:.0},{ms:.3},{by_fit:.3},{by_device:.3},{built:.2},{:.2}",
            scene.settings.image.size[0],
            method.name,
            scene.field.values.len(),
            build_ms(method, tuning, scene, &fitted),
        );
        Ok(())
    }

    /// How far each way of working is off.
    fn say(&self) {
        for way in Way::ALL {
            let of_way = || self.off.iter().filter(move |(of, _)| *of == way);
            let count = of_way().count() as f64;
            for (i, by) in ["the constants", "what was measured"].into_iter().enumerate() {
                let mean = of_way().map(|(_, off)| off[i]).sum::<f64>() / count;
                let deviation = (of_way().map(|(_, off)| (off[i] - mean).powi(2)).sum::<f64>() / count).sqrt();
                let factor = mean.exp();
                eprintln!(
                    "{way:?}, by {by}: {count} frames, estimates {factor:.2} times as long, standard deviation {deviation:.2} of the logarithm"
                );
            }
        }
    }
}
