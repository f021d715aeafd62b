//! What skipping saves of a frame, as ratios in one run; what recording a frame costs; how long its structure takes.
//!
//! CPU time of the process, which a busy machine disturbs less than wall time; on a CPU driver that is the whole
//! work of a frame. Methods take turns, so that trouble hits all alike. Needs a device; without `../shared/data`
//! it runs on built-in volumes, whose ratios are others.

use std::path::{Path, PathBuf};

use depthleap::frame::self_check;
use depthleap::measure::Run;
use depthleap::measure::runner::{Effort, Runner};
use depthleap::measure::{Checked, CostSource};
use depthleap::method;
use depthleap::read;
use depthleap::scene::Camera;
use depthleap::scene::settings::{MethodName, MethodSettings, Settings};
use depthleap::vulkan::{Device, Instance, pick};

/// Azimuth, elevation (degrees) and distance of the rotated view.
const VIEW: [f64; 3] = [30.0, 20.0, 1.91];
const METHODS: [MethodName; 4] =
    [method::RC.name(), method::RC_ERT.name(), method::RC_BLOCK.name(), method::NN_OMNI.name()];
const EFFORT: Effort = Effort { warmups: 2, repeats: 9, reference: false };

fn main() -> depthleap::Result<()> {
    let instance = Instance::new(false)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    println!("{}, {} {}", info.name, info.driver_name, info.driver_info);
    let device = Device::new(&instance, &info, false)?;
    let checked = Checked { check: self_check(&device)?, device, early_end: None, costs: CostSource::Fitted };
    for (name, settings) in scenes() {
        let methods = METHODS.map(|name| MethodSettings { name, ..MethodSettings::default() });
        let mut runner = Runner::new(Some(&checked), read::scene(&settings)?, name);
        let measured = runner.measure(&methods, EFFORT, &|_| {})?;
        print(&measured.into_iter().map(|one| one.run).collect::<Vec<_>>());
    }
    Ok(())
}

fn scenes() -> Vec<(String, Settings)> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data"));
    let mut names: Vec<PathBuf> =
        ["fuel", "engine_256cube", "aneurism"].map(|name| folder.join(name).with_extension("nrrd")).into();
    names.retain(|path| path.is_file());
    let view = |settings: &mut Settings| {
        let [azimuth, elevation, distance] = VIEW;
        let camera = Camera::orbit(azimuth, elevation, distance, settings.camera.fov_y);
        settings.camera.eye = camera.eye.to_array();
        settings.transfer.preset = Some("ramp".to_owned());
    };
    if names.is_empty() {
        println!("{} is not there: built-in volumes instead", folder.display());
        let mut settings = Settings::default();
        settings.volume.builtin = Some("jets:256".to_owned());
        view(&mut settings);
        return vec![("jets:256".to_owned(), settings)];
    }
    let scene = |path: PathBuf| {
        let mut settings = Settings::default();
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        settings.volume.path = Some(path);
        view(&mut settings);
        (name, settings)
    };
    names.into_iter().map(scene).collect()
}

fn print(runs: &[Run]) {
    let cpu = |run: &Run| run.host.cpu.map_or(f64::NAN, |t| t.value);
    for run in runs {
        let mad = run.host.cpu.and_then(|t| t.stats).map_or(f64::NAN, |s| s.mad);
        let record = run.host.record.map_or(f64::NAN, |t| t.value);
        println!(
            "{:<16} {:<9} {:>3} main passes  CPU {:>7.1} ms (MAD {mad:.1})  recording {record:.2} ms  build {:.0} ms",
            run.scene,
            run.method,
            run.passes,
            cpu(run),
            run.host.build.map_or(0.0, |t| t.value),
        );
    }
    if let [rc, ert, block, omni] = runs {
        println!(
            "{:<16} nn-omni is {:.2} of rc, {:.2} of rc-ert, {:.2} of rc-block\n",
            omni.scene,
            cpu(omni) / cpu(rc),
            cpu(omni) / cpu(ert),
            cpu(omni) / cpu(block)
        );
    }
}
