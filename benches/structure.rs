//! How long a change of the transfer function takes on the CPU: `interesting` and the distance transform of 256^3
//! voxels, in CPU time of the process (all threads), which a busy machine disturbs less than wall time.

use std::time::Duration;

use cpu_time::ProcessTime;
use depthleap::projection::Shown;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, TransferFunction, Volume};
use depthleap::structure::cells::{Values, interesting};
use depthleap::structure::distance::omni;
use depthleap::structure::grid::Grid;
use depthleap::structure::octants::directional;

const SIZE: usize = 256;
const RUNS: usize = 9;

/// Thin bent tubes that fork, in an empty background: what an angiogram looks like to a distance transform.
fn vessels() -> Field {
    let mut voxels = vec![0u8; SIZE * SIZE * SIZE];
    for tube in 0..12 {
        let phase = tube as f64 * 0.7;
        for step in 0..4 * SIZE {
            let t = step as f64 / (4 * SIZE) as f64;
            let radius = 1.5 + 4.0 * (1.0 - t) / (1.0 + (tube % 4) as f64);
            let middle = [
                0.5 + 0.45 * t * (phase + 3.0 * t).cos(),
                0.5 + 0.45 * t * (phase + 5.0 * t).sin(),
                0.1 + 0.8 * t + 0.05 * (9.0 * t + phase).sin(),
            ]
            .map(|c| c * SIZE as f64);
            let span = |c: f64| (c - radius).max(0.0) as usize..((c + radius) as usize + 1).min(SIZE);
            for z in span(middle[2]) {
                for y in span(middle[1]) {
                    for x in span(middle[0]) {
                        let square: f64 = [x, y, z].iter().zip(middle).map(|(&v, m)| (v as f64 - m).powi(2)).sum();
                        let value = (255.0 * (1.0 - square.sqrt() / radius)).max(0.0) as u8;
                        let voxel = &mut voxels[(z * SIZE + y) * SIZE + x];
                        *voxel = value.max(*voxel);
                    }
                }
            }
        }
    }
    let volume = Volume::new("vessels", [SIZE; 3], [1.0; 3], Voxels::U8(voxels)).expect("a sound volume");
    Field::new(volume, None, NanPolicy::Replace).expect("a sound field")
}

/// Median CPU time of `RUNS` runs after one to warm up.
fn median(mut run: impl FnMut()) -> Duration {
    run();
    let mut times: Vec<Duration> = (0..RUNS)
        .map(|_| {
            let start = ProcessTime::now();
            run();
            start.elapsed()
        })
        .collect();
    times.sort();
    times[RUNS / 2]
}

fn main() {
    let field = vessels();
    let grid = Grid::new(&field, 1);
    let Voxels::U8(codes) = &field.volume.voxels else { return };
    let values = Values::Unorm8(codes.into());
    for preset in ["ramp", "surface", "linear"] {
        let transfer = TransferFunction::preset(preset, 1.0).expect("a built-in").expect("a sound function");
        let shows = Shown::from(&transfer);
        let flags = interesting(&field, &values, &shows, &grid, false);
        let shown = flags.iter().filter(|flag| **flag).count() as f64 / flags.len() as f64;
        let find = median(|| drop(std::hint::black_box(interesting(&field, &values, &shows, &grid, false))));
        let any = median(|| drop(std::hint::black_box(omni(&grid, &flags))));
        let octants = median(|| drop(std::hint::black_box(directional(&grid, &flags))));
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        println!(
            "vessels {SIZE}^3, {preset}: {:.1} % interesting; interesting {:.0} ms, omni {:.0} ms, directional {:.0} ms \
             CPU, median of {RUNS}",
            100.0 * shown,
            ms(find),
            ms(any),
            ms(octants),
        );
    }
}
