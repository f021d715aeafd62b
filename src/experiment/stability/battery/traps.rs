//! What skipping may jump over: things between voxels, on seams, at the border, hardly visible, head-on.

use super::super::case::StabilityCase;
use crate::scene::Volume;
use crate::scene::settings::{Classification, Settings};
use crate::scene::volume::Voxels;

const GROUP: &str = "skip trap";
const SIDE: usize = 33;

/// A cube of zeros with that value where `lit` says so.
fn cube(value: u8, lit: impl Fn([usize; 3]) -> bool) -> Option<Volume> {
    let at = |i: usize| [i % SIDE, i / SIDE % SIDE, i / (SIDE * SIDE)];
    let voxels = (0..SIDE.pow(3)).map(|i| if lit(at(i)) { value } else { 0 }).collect();
    Volume::new("voxels", [SIDE; 3], [1.0; 3], Voxels::U8(voxels)).ok()
}

pub fn cases() -> Vec<StabilityCase> {
    let mut cases = Vec::new();
    let mut put = |name: &str, volume: Option<Volume>, change: &dyn Fn(&mut Settings)| {
        cases.extend(volume.map(|volume| {
            StabilityCase::new(GROUP, name, "")
                .preset("ramp")
                .voxels(volume)
                .with(|s| s.sampling.termination = 0.95)
                .with(change)
        }));
    };
    let single = |at: [usize; 3]| move |voxel: [usize; 3]| voxel == at;
    put("one voxel", cube(255, single([16, 16, 16])), &|_| {});
    // 64 is the first code that ramp shows, by 0.0013.
    put("one voxel that is hardly visible", cube(64, single([11, 20, 9])), &|_| {});
    put("one voxel that is just invisible", cube(63, single([11, 20, 9])), &|_| {});
    put("one voxel at a corner", cube(255, single([0, 0, 0])), &|_| {});
    put("one voxel at the far corner", cube(255, single([32, 32, 32])), &|_| {});
    put("a sheet between blocks", cube(255, |[x, _, _]| x == 16), &|_| {});
    put("sheets on all seams of blocks", cube(200, |v| v.iter().any(|c| c % 8 == 0 && *c > 0 && *c < 32)), &|_| {});
    put("the border alone", cube(255, |v| v.iter().any(|c| *c == 0 || *c == 32)), &|_| {});
    put("the last layer alone", cube(255, |[_, _, z]| z == 0), &|_| {});
    put("lines between blocks", cube(255, |[x, y, _]| x == 8 && y == 24), &|_| {});
    let speckled = || cube(180, |[x, y, z]| (x * 7 + y * 13 + z * 29) % 97 == 0);
    put("octants head-on", speckled(), &|s| s.camera.eye = [0.0, 0.0, 1.91]);
    put("octants head-on, from below", speckled(), &|s| {
        (s.camera.eye, s.camera.up) = ([0.0, -1.91, 0.0], [0.0, 0.0, 1.0]);
    });
    put("rays in all octants", speckled(), &|s| (s.camera.eye, s.camera.fov_y) = ([0.02, 0.01, 0.03], 150.0));
    put("steps of 1/4 voxel", speckled(), &|s| s.sampling.step = 0.25);
    put("steps of 3 voxels", speckled(), &|s| s.sampling.step = 3.0);
    put("steps of 3 voxels, pre-integrated", speckled(), &|s| {
        (s.sampling.step, s.sampling.classification) = (3.0, Classification::PreIntegrated);
    });
    put("a sheet between blocks, pre-integrated", cube(255, |[x, _, _]| x == 16), &|s| {
        (s.sampling.step, s.sampling.classification) = (2.5, Classification::PreIntegrated);
    });
    put("cells of 8 voxels", speckled(), &|s| s.method.cell = 8);
    put("cells of 2 voxels, a lookup for every sample", speckled(), &|s| {
        (s.method.cell, s.method.lookups) = (2, 4);
    });
    put("no exit lookahead", speckled(), &|s| s.method.exit_lookahead = false);
    put("blocks tested before the first pass", speckled(), &|s| s.method.block_first = true);
    put("one sample a pass", speckled(), &|s| s.sampling.samples_per_pass = 1);
    put("the cone's widest angle", speckled(), &|s| s.method.cone = 60.0);
    cases
}
