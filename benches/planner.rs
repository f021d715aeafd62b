//! What the planner saves, as ratios in one run: CPU time and bytes of the same frames with and without it, which take
//! turns. On a CPU driver the CPU time of the process is the whole work of a frame. Needs a device.

use depthleap::frame::self_check;
use depthleap::measure::Run;
use depthleap::measure::runner::{Effort, Runner};
use depthleap::measure::{Checked, CostSource};
use depthleap::method;
use depthleap::read;
use depthleap::scene::settings::{MethodName, MethodSettings, Settings};
use depthleap::vulkan::{Device, Instance, pick};

const EFFORT: Effort = Effort { warmups: 2, repeats: 15, reference: false };
const METHODS: [MethodName; 3] = [method::RC_ERT.name(), method::NN_OMNI.name(), method::NN_OMNI_FUSED.name()];

type Change = fn(&mut Settings);

/// Views and transfer functions of one volume.
const SCENES: [(&str, Change); 4] = [
    ("far away", |s| s.camera.eye = [7.0, 5.0, 14.0]),
    ("a corner of the box", |s| s.camera.target = [-1.1, -1.1, 0.0]),
    ("transparent", |s| s.transfer.preset = Some("haze".to_owned())),
    ("dense", |s| s.transfer.points = Some(vec![[0.0, 0.2, 0.3, 0.9, 0.2], [1.0, 1.0, 0.6, 0.2, 0.9]])),
];

fn main() -> depthleap::Result<()> {
    let instance = Instance::new(false)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    println!("{}, {} {}; shells:128, 500x500", info.name, info.driver_name, info.driver_info);
    let device = Device::new(&instance, &info, false)?;
    let checked = Checked { check: self_check(&device)?, device, early_end: None, costs: CostSource::Fitted };
    println!(
        "{:<20} {:<15} {:>22} {:>8} {:>12} {:>12} {:>8}",
        "scene", "method", "CPU ms without -> with", "saved", "KiB without", "KiB with", "steps"
    );
    for (name, change) in SCENES {
        let mut settings = Settings::default();
        settings.volume.builtin = Some("shells:128".to_owned());
        settings.transfer.preset = Some("ramp".to_owned());
        settings.camera.eye = [0.8974, 0.6533, 1.5544];
        change(&mut settings);
        if settings.transfer.points.is_some() {
            settings.transfer.preset = None;
        }
        let scene = read::scene(&settings)?;
        let methods: Vec<MethodSettings> = METHODS
            .into_iter()
            .flat_map(|name| [false, true].map(|planner| MethodSettings { name, planner, ..MethodSettings::default() }))
            .collect();
        let mut runner = Runner::new(Some(&checked), scene, name.to_owned());
        let measured = runner.measure(&methods, EFFORT, &|_| {})?;
        for pair in measured.chunks_exact(2) {
            print(name, &pair[0].run, &pair[1].run);
        }
    }
    Ok(())
}

fn print(name: &str, without: &Run, with: &Run) {
    let cpu = |run: &Run| run.host.cpu.as_ref().map_or(f64::NAN, |timing| timing.value);
    let kib = |run: &Run| run.memory.values().sum::<u64>() >> 10;
    println!(
        "{name:<20} {:<15} {:>10.2} -> {:>8.2} {:>7.1}% {:>12} {:>12} {:>3} of {}",
        with.method,
        cpu(without),
        cpu(with),
        100.0 * (1.0 - cpu(with) / cpu(without)),
        kib(without),
        kib(with),
        steps(with),
        steps(without)
    );
}

/// Lines of a plan that are steps.
fn steps(run: &Run) -> usize {
    run.plan.iter().filter(|line| !line.trim_start().starts_with('-')).count()
}
