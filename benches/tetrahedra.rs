//! How long a picture of a mesh of tetrahedra takes, in CPU time of the process (all threads) on a device that is a CPU, beside VTK's rays
//! [Bunyk et al. 1997] and projected tetrahedra where Python has the package `vtk` (`pip install vtk`): the same mesh, view and transfer
//! function; those of ours take turns. The propagation with early z and counts of the rays left, and without. Then the cost against the number of cells, by every method.
//!
//! `cargo bench --bench tetrahedra`. Needs a device; without `../shared/data` it runs on built-in meshes.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use depthleap::frame::{EarlyEnd, GpuFrame, Measure, Resident};
use depthleap::method::{METHODS, TET_PROPAGATION};
use depthleap::part::form::Form;
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
        ours(&device, scene, &by_method())?;
        ours(&device, scene, &by_ends())?;
        match peers(scene, mesh) {
            Ok(lines) => lines.lines().for_each(|line| println!("  VTK {line}")),
            Err(reason) => println!("  no peer beside it: {reason}"),
        }
    }
    println!("cost against cells, cubes");
    for boxes in CUBES {
        let scene = scene(|s| s.volume.builtin = Some(format!("tets-cube:{boxes}")))?;
        println!("{} cells, cube root {:.1}", 6 * boxes.pow(3), (6.0 * (boxes as f64).powi(3)).cbrt());
        ours(&device, &scene, &by_method())?;
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

/// A way to draw a mesh.
struct Way {
    words: &'static str,
    method: &'static Method,
    form: Option<Form>,
    early_end: Option<EarlyEnd>,
}

/// By each method, as the papers cull.
fn by_method() -> Vec<Way> {
    let rows = METHODS.into_iter().filter(|method| method.goes_through_cells());
    rows.map(|method| Way { words: method.name, method, form: method.papers, early_end: None }).collect()
}

/// The propagation with what ends rays and passes, and without.
fn by_ends() -> Vec<Way> {
    let way = |words, form, early_end| Way { words, method: &TET_PROPAGATION, form, early_end };
    let papers = TET_PROPAGATION.papers;
    vec![
        way("early z and counts", papers, None),
        way("early z", papers, Some(EarlyEnd::Never)),
        way("neither", None, Some(EarlyEnd::Never)),
    ]
}

/// Prints the median time of a frame by each way, the passes that any fragment runs in, and their fragments.
fn ours(device: &Arc<Device>, scene: &Scene, ways: &[Way]) -> Result<()> {
    let mut frames = Vec::new();
    let mut resident = Resident::new(device);
    for way in ways {
        let mut scene = scene.clone();
        scene.settings.method.name = way.method.name();
        let plan = plan_for(
            &scene,
            Choice { form: way.form, most_texels: Some(device.info.max_texel_buffer), ..Choice::default() },
        )?;
        resident.prepare(&scene, &plan)?;
        let mut frame = GpuFrame::new(device, &scene, &plan, &mut resident, way.early_end)?;
        let fragments = frame.run(Measure::Counts { statistics: false })?.fragments.unwrap_or_default();
        let run = fragments.main.iter().filter(|fragments| **fragments > 0).count();
        let sum = |of: &[u64]| of.iter().sum::<u64>();
        let [main, updates] = [sum(&fragments.main), sum(&fragments.intermediate)];
        let words = format!(
            "{} passes, {run} with fragments: {main} main fragments, {updates} of updates; {} pixels a pass",
            plan.passes,
            plan.view.region.pixels()
        );
        frames.push((frame, words, Vec::new()));
    }
    for _ in 0..RUNS {
        for (frame, _, times) in &mut frames {
            times.push(frame.run(Measure::Nothing)?.cpu_ms);
        }
    }
    for (way, (_, words, mut times)) in ways.iter().zip(frames) {
        times.sort_by(f64::total_cmp);
        let spread = times[times.len() - 1] - times[0];
        println!("  {:<24} {:9.1} (spread {spread:.1}), {words}", way.words, times[times.len() / 2]);
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
