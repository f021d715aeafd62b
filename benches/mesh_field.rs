//! How long the distance field of a mesh takes, in CPU time of the process (all threads) and by the clock: a torus, and Lucy
//! where `../shared/data` has her.
//!
//! `cargo bench --bench mesh_field [-- BAND]`: voxels to each side of the surface, 4 by default.

use std::path::Path;
use std::time::Instant;

use cpu_time::ProcessTime;
use depthleap::scene::mesh::{Mesh, shape};
use depthleap::scene::mesh_field::{DEFAULT_BAND, volume};
use depthleap::{Result, read};

const LUCY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data/lucy_decimated.ply");
const RUNS: usize = 3;

fn main() -> Result<()> {
    let band = std::env::args().find_map(|argument| argument.parse().ok()).unwrap_or(DEFAULT_BAND);
    time(&shape("torus:200")?, [256, 96, 256], band)?;
    let lucy = Path::new(LUCY);
    if lucy.exists() { time(&read::mesh(lucy)?, [256, 256, 512], band) } else { Ok(()) }
}

/// Prints the median CPU time and the least time by the clock.
fn time(mesh: &Mesh, dims: [usize; 3], band: f64) -> Result<()> {
    let (mut cpu, mut clock) = (Vec::new(), Vec::new());
    for _ in 0..RUNS {
        let (process, start) = (ProcessTime::now(), Instant::now());
        drop(std::hint::black_box(volume(mesh, Some(dims), band)?));
        cpu.push(process.elapsed());
        clock.push(start.elapsed());
    }
    cpu.sort();
    clock.sort();
    println!(
        "{}, {} triangles, {dims:?} voxels, band {band}: {:.1} s CPU, median of {RUNS}; {:.1} s by the clock at the least",
        mesh.name,
        mesh.triangles.len(),
        cpu[RUNS / 2].as_secs_f64(),
        clock[0].as_secs_f64(),
    );
    Ok(())
}
