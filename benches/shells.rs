//! How long marching cubes takes for a level, in CPU time of the process (all threads), beside VTK's two ways where Python has the
//! package `vtk` (`pip install vtk`): the same voxels and levels.
//!
//! `cargo bench --bench shells`. Without `../shared/data` it runs on a built-in volume.

use std::path::{Path, PathBuf};
use std::process::Command;

use cpu_time::ProcessTime;
use depthleap::scene::shells::{Faces, polygons};
use depthleap::scene::{Field, Settings};
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
    if present.is_empty() {
        let mut settings = Settings::default();
        settings.volume.builtin = Some("jets:256".to_owned());
        return time("jets:256", &read::scene(&settings)?.field, 0.5);
    }
    for (path, level) in present {
        let mut settings = Settings::default();
        settings.volume.path = Some(path.clone());
        time(&path.file_stem().unwrap_or_default().to_string_lossy(), &read::scene(&settings)?.field, level)?;
    }
    Ok(())
}

/// Prints the median CPU times.
fn time(name: &str, field: &Field, level: f64) -> Result<()> {
    let mut ours = Vec::new();
    let mut triangles = 0;
    for _ in 0..RUNS {
        let begin = ProcessTime::now();
        triangles = std::hint::black_box(polygons(field, field.x(level), Faces::Open)?).triangles.len();
        ours.push(begin.elapsed().as_secs_f64() * 1e3);
    }
    ours.sort_by(f64::total_cmp);
    println!("{name} at {level}: {triangles} triangles, {:.1} ms CPU, median of {RUNS}", ours[RUNS / 2]);
    match peers(field, level) {
        Ok(lines) => lines.lines().for_each(|line| println!("  {line}")),
        Err(reason) => println!("  no peer beside it: {reason}"),
    }
    Ok(())
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
