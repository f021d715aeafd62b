//! How long marching cubes takes for a level on the host, in CPU time of the process (all threads), beside VTK's two ways where Python has
//! the package `vtk` (`pip install vtk`): the same voxels and levels; and, of the shell that is closed at the volume's faces, on the host
//! beside compute shaders, in CPU time too on a device that is a CPU, else in device time. Those who are compared take turns.
//!
//! `cargo bench --bench shells`. Without a device that part is left out; without `../shared/data` it runs on a built-in volume.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;

use cpu_time::ProcessTime;
use depthleap::frame::Resident;
use depthleap::method::SHELLS;
use depthleap::plan::{Choice, plan_for};
use depthleap::scene::settings::ShellMode;
use depthleap::scene::shells::{Faces, polygons};
use depthleap::scene::{Field, Scene, Settings};
use depthleap::vulkan::{Device, Instance, pick};
use depthleap::{Result, read};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
const PEER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/shells_vtk.py");
const RUNS: usize = 7;

/// Files, and a level of each in the volume's own unit.
const VOLUMES: [(&str, f64); 4] =
    [("engine_256cube.nrrd", 90.0), ("aneurism.nrrd", 60.0), ("mri_head.nrrd", 70.0), ("mra_tof.nrrd", 100.0)];

fn main() -> Result<()> {
    let present: Vec<(PathBuf, f64)> = VOLUMES
        .iter()
        .map(|(file, level)| (Path::new(DATA).join(file), *level))
        .filter(|(path, _)| path.exists())
        .collect();
    let device = open();
    if let Err(reason) = &device {
        println!("no compute shaders beside the host: {reason}");
    }
    let device = device.ok();
    if present.is_empty() {
        let scene = scene(0.5, |s| s.volume.builtin = Some("jets:256".to_owned()))?;
        return time("jets:256", &scene, 0.5, device.as_ref());
    }
    for (path, level) in present {
        let scene = scene(level, |s| s.volume.path = Some(path.clone()))?;
        time(&path.file_stem().unwrap_or_default().to_string_lossy(), &scene, level, device.as_ref())?;
    }
    Ok(())
}

fn open() -> Result<Arc<Device>> {
    let instance = Instance::new(false)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    println!("{}, {} {}", info.name, info.driver_name, info.driver_info);
    Device::new(&instance, &info, false)
}

/// A scene of one shell.
fn scene(level: f64, volume: impl FnOnce(&mut Settings)) -> Result<Scene> {
    let mut settings = Settings::default();
    volume(&mut settings);
    settings.method.name = SHELLS.name();
    (settings.shells.mode, settings.shells.shell_levels) = (Some(ShellMode::Max), vec![level]);
    read::scene(&settings)
}

/// Prints the median times.
fn time(name: &str, scene: &Scene, level: f64, device: Option<&Arc<Device>>) -> Result<()> {
    let (field, x) = (&scene.field, scene.field.x(level));
    let (mut ours, mut triangles) = (Vec::new(), 0);
    for _ in 0..RUNS {
        let (made, ms) = host(field, x, Faces::Open)?;
        (triangles, ours) = (made, [ours, vec![ms]].concat());
    }
    println!("{name} at {level}: {triangles} triangles, {:.1} ms CPU, median of {RUNS}", median(ours));
    match peers(field, level) {
        Ok(lines) => lines.lines().for_each(|line| println!("  {line}")),
        Err(reason) => println!("  no peer beside it: {reason}"),
    }
    let Some(device) = device else { return Ok(()) };
    let mut resident = Resident::new(device);
    let plan = plan_for(scene, Choice::default())?;
    let [mut on_host, mut computed] = [Vec::new(), Vec::new()];
    // The first ones warm up.
    for run in 0..=RUNS {
        resident.forget_scene();
        resident.prepare(scene, &plan)?;
        let (made, ms) = host(field, x, Faces::Closed)?;
        if let Some([built, _]) = resident.build_ms(&plan).filter(|_| run > 0) {
            (triangles, on_host, computed) = (made, [on_host, vec![ms]].concat(), [computed, vec![built]].concat());
        }
    }
    let [on_host, computed] = [on_host, computed].map(median);
    println!(
        "  closed: {triangles} triangles, {on_host:.1} ms on the host, {computed:.1} ms by compute shaders ({:.2} of it)",
        computed / on_host
    );
    Ok(())
}

/// Triangles that the host makes, and the CPU time that takes, milliseconds.
fn host(field: &Field, x: f32, faces: Faces) -> Result<(usize, f64)> {
    let begin = ProcessTime::now();
    let triangles = std::hint::black_box(polygons(field, x, faces)?).triangles.len();
    Ok((triangles, begin.elapsed().as_secs_f64() * 1e3))
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}

/// What the peers print, of the same voxels in f32.
fn peers(field: &Field, level: f64) -> std::result::Result<String, String> {
    let file = tempfile::NamedTempFile::new().map_err(|e| e.to_string())?;
    std::fs::write(&file, bytemuck::cast_slice::<f32, u8>(&field.values)).map_err(|e| e.to_string())?;
    let [nx, ny, nz] = field.dims().map(|n| n.to_string());
    let x = field.x(level).to_string();
    let said = Command::new("python3")
        .arg(PEER)
        .arg(file.path())
        .args([nx, ny, nz, x, RUNS.to_string()])
        .output()
        .map_err(|e| format!("python3 cannot be started ({e})"))?;
    match said.status.success() {
        true => Ok(String::from_utf8_lossy(&said.stdout).into_owned()),
        false => Err("python3 has no package vtk, or it failed".to_owned()),
    }
}
