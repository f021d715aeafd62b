//! Distances that were updated against those that are built anew.

mod random;

use depthleap::structure::distance::omni;
use depthleap::structure::grid::Grid;
use depthleap::structure::octants::directional;
use depthleap::structure::transform::Transform;
use glam::DVec3;
use random::Random;

impl Random {
    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }
}

/// Turns flags until they are these, of both kinds of distances, which must be those of a build.
#[track_caller]
fn assert_follows(kept: &mut [Transform; 2], flags: &[bool]) {
    for (kept, directional_too) in kept.iter_mut().zip([false, true]) {
        let grid = kept.distances().grid;
        let slab = grid.cells[0] * grid.cells[1];
        let slabs = kept.interesting().chunks(slab).zip(flags.chunks(slab));
        let changed: Vec<Vec<usize>> =
            slabs.map(|(before, now)| (0..slab).filter(|i| before[*i] != now[*i]).collect()).collect();
        kept.flip(&changed);
        assert_eq!(kept.interesting(), flags);
        let built = if directional_too { directional(&grid, flags) } else { omni(&grid, flags) };
        let wrong = kept.distances().bytes.iter().zip(&built.bytes).position(|(a, b)| a != b);
        assert_eq!(wrong, None, "of {grid:?}, octants {}", built.octants);
        assert_eq!(kept.distances(), &built);
    }
}

fn kept(cells: [usize; 3], sides: DVec3, flags: &[bool]) -> [Transform; 2] {
    let grid = Grid { cell: 1, cells, sides, volume_cells: cells };
    [false, true].map(|octants| Transform::new(&grid, octants, flags.to_vec()))
}

const SIDES: [DVec3; 5] = [
    DVec3::ONE,
    DVec3::new(1.0, 2.5, 1.0),
    DVec3::new(3.7, 1.0, 1.9),
    DVec3::new(1.0, 1.0, 40.0),
    DVec3::new(30.0, 30.0, 30.0),
];

#[test]
fn random_cells_that_come_and_go() {
    let mut random = Random(11);
    for round in 0..400 {
        let longest = [6, 20, 45][round % 3];
        let cells = [0; 3].map(|_| 1 + random.below(longest));
        let count: usize = cells.iter().product();
        let density = [0.0, 0.001, 0.01, 0.1, 0.9, 1.0][random.below(6)];
        let mut flags: Vec<bool> = (0..count).map(|_| random.next() < density).collect();
        let mut kept = kept(cells, SIDES[random.below(SIDES.len())], &flags);
        for _ in 0..6 {
            let most = 1 + count / [2, 17, 40, 200][random.below(4)];
            for _ in 0..1 + random.below(most) {
                let cell = random.below(count);
                flags[cell] = if random.below(3) == 0 { random.next() < density } else { !flags[cell] };
            }
            assert_follows(&mut kept, &flags);
        }
    }
}
