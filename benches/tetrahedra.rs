//! How long a picture of a mesh of tetrahedra takes, in CPU time of the process (all threads) on a device that is a CPU, beside VTK's rays
//! [Bunyk et al. 1997] and projected tetrahedra where Python has the package `vtk` (`pip install vtk`): the same mesh, view and transfer
//! function; those of ours take turns. Then the cost against the number of cells, by every method.
//!
//! `cargo bench --bench tetrahedra`. Needs a device; without `../shared/data` it runs on built-in meshes.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use depthleap::frame::{GpuFrame, Measure, Resident};
use depthleap::method::{self, METHODS};
use depthleap::part::rows::Method;
use depthleap::plan::{Choice, plan_for};
use depthleap::scene::settings::Settings;
use depthleap::scene::{Scene, Tetrahedra};
use depthleap::vulkan::{Device, Instance, pick};
use depthleap::{Result, read};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
const PEER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/tetrahedra_vtk.py");
const RUNS: usize = 7;

/// Pixels of a side.
const SIZE: u32 = 256;

/// Boxes along a side of cubes, whose cells are from 10^3 to 10^6.
const CUBES: [usize; 5] = [6, 12, 16, 26, 55];

fn main() -> Result<()> {
    let instance = Instance::new(false)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    println!("{}, {} {}; {SIZE} x {SIZE} pixels, ms, median of {RUNS}", info.name, info.driver_name, info.driver_info);
    let device = Device::new(&instance, &info, false)?;
    let fin = Path::new(DATA).join("bluntfin_tet.vtk");
    let mut scenes = vec![("tets-cube:16", scene(|s| s.volume.builtin = Some("tets-cube:16".to_owned()))?)];
    if fin.exists() {
        let blunt = scene(|s| (s.volume.path, s.volume.array) = (Some(fin), Some("density".to_owned())))?;
        scenes.push(("bluntfin_tet", blunt));
    }
    for (name, scene) in &scenes {
        let Some(mesh) = scene.tetrahedra.as_deref() else { continue };
        println!("{name}: {} cells", mesh.cells.len());
        ours(&device, scene)?;
        match peers(scene, mesh) {
            Ok(lines) => lines.lines().for_each(|line| println!("  VTK {line}")),
            Err(reason) => println!("  no peer beside it: {reason}"),
        }
    }
    println!("cost against cells, cubes");
    for boxes in CUBES {
        let scene = scene(|s| s.volume.builtin = Some(format!("tets-cube:{boxes}")))?;
        println!("{} cells, cube root {:.1}", 6 * boxes.pow(3), (6.0 * (boxes as f64).powi(3)).cbrt());
        ours(&device, &scene)?;
    }
    Ok(())
}

fn scene(volume: impl FnOnce(&mut Settings)) -> Result<Scene> {
    let mut settings = Settings::default();
    volume(&mut settings);
    settings.transfer.points = Some(vec![[0.0, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.1]]);
    settings.image.size = [SIZE; 2];
    (settings.camera.eye, settings.sampling.termination) = ([0.8974, 0.6533, 1.5544], 1.0);
    read::scene(&settings)
}

/// Prints the median time of a frame by each method.
fn ours(device: &Arc<Device>, scene: &Scene) -> Result<()> {
    let methods: Vec<&Method> = METHODS.into_iter().filter(|method| method.goes_through_cells()).collect();
    let mut frames = Vec::new();
    let mut resident = Resident::new(device);
    for method in &methods {
        let mut scene = scene.clone();
        scene.settings.method.name = method.name();
        let plan = plan_for(&scene, Choice { form: method::papers_form(method.name()), ..Choice::default() })?;
        resident.prepare(&scene, &plan)?;
        let mut frame = GpuFrame::new(device, &scene, &plan, &mut resident, None)?;
        let counts = frame.run(Measure::Counts { statistics: false })?;
        let main: u64 = counts.fragments.iter().flat_map(|counts| &counts.main).sum();
        frames.push((frame, plan.passes, main, Vec::new()));
    }
    for _ in 0..RUNS {
        for (frame, _, _, times) in &mut frames {
            times.push(frame.run(Measure::Nothing)?.cpu_ms);
        }
    }
    for (method, (_, passes, main, mut times)) in methods.iter().zip(frames) {
        times.sort_by(f64::total_cmp);
        let spread = times[times.len() - 1] - times[0];
        println!(
            "  {:<24} {:9.1} (spread {spread:.1}), {passes} passes, {main} main fragments",
            method.name,
            times[times.len() / 2]
        );
    }
    Ok(())
}

/// What the peers print.
fn peers(scene: &Scene, mesh: &Tetrahedra) -> std::result::Result<String, String> {
    let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
    let rows: Vec<[f32; 4]> = mesh.points.iter().zip(&mesh.values).map(|([x, y, z], v)| [*x, *y, *z, *v]).collect();
    let corners: Vec<[i64; 4]> = mesh.cells.iter().map(|cell| cell.map(i64::from)).collect();
    let [points, cells] = ["points", "cells"].map(|name| folder.path().join(name));
    std::fs::write(&points, bytemuck::cast_slice::<_, u8>(&rows)).map_err(|e| e.to_string())?;
    std::fs::write(&cells, bytemuck::cast_slice::<_, u8>(&corners)).map_err(|e| e.to_string())?;
    let out = std::env::var("PICTURES").unwrap_or_else(|_| folder.path().join("picture").display().to_string());
    let said = Command::new("python3")
        .arg(PEER)
        .args([points, cells])
        .args([SIZE.to_string(), scene.field.finest().to_string(), RUNS.to_string(), out])
        .output()
        .map_err(|e| format!("python3 cannot be started ({e})"))?;
    match said.status.success() {
        true => Ok(String::from_utf8_lossy(&said.stdout).into_owned()),
        false => Err("python3 has no package vtk, or it failed".to_owned()),
    }
}
