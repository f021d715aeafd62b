//! Distances that were updated against those that are built anew, byte for byte.

mod random;

use depthleap::projection::Shown;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::settings::{Distance, ProjectionName};
use depthleap::scene::transfer::Knot;
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, TransferFunction, Volume};
use depthleap::structure::cells::Values;
use depthleap::structure::distance::omni;
use depthleap::structure::grid::Grid;
use depthleap::structure::octants::directional;
use depthleap::structure::transform::Transform;
use depthleap::structure::update::Updatable;
use depthleap::structure::{self, Lookup};
use glam::DVec3;
use random::Random;

impl Random {
    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }
}

const SIDES: [DVec3; 5] = [
    DVec3::ONE,
    DVec3::new(1.0, 2.5, 1.0),
    DVec3::new(3.7, 1.0, 1.9),
    DVec3::new(1.0, 1.0, 40.0),
    // Cubes of which few are within the distances that are told apart.
    DVec3::splat(30.0),
];

/// Both kinds of distances.
fn kept(cells: [usize; 3], sides: DVec3, flags: &[bool]) -> [Transform; 2] {
    let grid = Grid { cell: 1, cells, sides, volume_cells: cells };
    [false, true].map(|octants| Transform::new(&grid, octants, flags.to_vec()))
}

/// Turns flags until they are these. The distances must be those of a build.
#[track_caller]
fn assert_follows(kept: &mut [Transform; 2], flags: &[bool]) {
    for (kept, octants) in kept.iter_mut().zip([false, true]) {
        let grid = kept.distances().grid;
        let slab = grid.cells[0] * grid.cells[1];
        let slabs = kept.interesting().chunks(slab).zip(flags.chunks(slab));
        let changed: Vec<Vec<usize>> =
            slabs.map(|(before, now)| (0..slab).filter(|i| before[*i] != now[*i]).collect()).collect();
        kept.flip(&changed);
        assert_eq!(kept.interesting(), flags);
        let built = if octants { directional(&grid, flags) } else { omni(&grid, flags) };
        let wrong = kept.distances().bytes.iter().zip(&built.bytes).position(|(a, b)| a != b);
        assert_eq!(wrong, None, "of {grid:?}, octants {}", built.octants);
        assert_eq!(kept.distances(), &built);
    }
}

#[test]
fn random_cells_come_and_go() {
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

#[test]
fn few_cells_of_long_columns_come_and_go() {
    // So few that columns are updated place by place.
    let mut random = Random(14);
    for round in 0..60 {
        let cells = [[20, 150, 4], [17, 5, 160], [33, 70, 80], [5, 400, 3]][round % 4];
        let count: usize = cells.iter().product();
        let density = [0.0005, 0.01, 0.3, 0.95][random.below(4)];
        let mut flags: Vec<bool> = (0..count).map(|_| random.next() < density).collect();
        let mut kept = kept(cells, SIDES[random.below(SIDES.len())], &flags);
        for _ in 0..8 {
            let near = random.below(count);
            for _ in 0..1 + random.below(4) {
                let cell = (near + random.below(4)).min(count - 1);
                flags[cell] = !flags[cell];
            }
            assert_follows(&mut kept, &flags);
        }
    }
}

#[test]
fn surfaces_grow_and_shrink() {
    // Smooth bodies, near to and far from each other, whose outermost cells change: what a transfer function does.
    let cells = [70, 61, 66];
    let middles = [[15.0, 12.0, 14.0], [50.0, 45.0, 20.0], [20.0, 40.0, 55.0]];
    let inside = |radius: f64| -> Vec<bool> {
        (0..cells.iter().product::<usize>())
            .map(|i| {
                let at = [i % cells[0], i / cells[0] % cells[1], i / (cells[0] * cells[1])].map(|c| c as f64);
                let square = |middle: &[f64; 3]| (0..3).map(|axis| (at[axis] - middle[axis]).powi(2)).sum::<f64>();
                middles.iter().zip(0..).any(|(middle, nth)| square(middle).sqrt() < radius + f64::from(nth))
            })
            .collect()
    };
    for sides in [DVec3::ONE, DVec3::new(1.0, 1.3, 2.0)] {
        let mut kept = kept(cells, sides, &inside(7.0));
        for radius in [7.1, 7.3, 7.0, 6.9, 6.9, 9.0, 1.5, 7.0] {
            assert_follows(&mut kept, &inside(radius));
        }
    }
}

#[test]
fn last_cells_go_and_first_ones_come() {
    for cells in [[1, 1, 1], [40, 1, 1], [1, 1, 300], [1, 40, 1], [33, 17, 19], [300, 3, 2]] {
        let count: usize = cells.iter().product();
        let mut kept = kept(cells, DVec3::ONE, &vec![false; count]);
        let one = |cell: usize| (0..count).map(|i| i == cell).collect::<Vec<bool>>();
        for flags in [one(count / 2), one(0), one(count - 1), vec![false; count], one(count / 3), vec![true; count]] {
            assert_follows(&mut kept, &flags);
        }
        assert_follows(&mut kept, &vec![false; count]);
        assert_follows(&mut kept, &vec![false; count]);
        assert_follows(&mut kept, &one(0));
    }
}

fn field(random: &mut Random, dims: [usize; 3], spacing: [f64; 3], holes: bool) -> Field {
    let mut last = 0.0;
    let value = |_| {
        match random.below(8) {
            0 => last = random.next(),
            1 if holes => return f32::NAN,
            _ => {}
        }
        last as f32
    };
    let values: Vec<f32> = (0..dims.iter().product()).map(value).collect();
    let volume = Volume::new("test", dims, spacing, Voxels::F32(values)).unwrap();
    Field::new(volume, Some([0.0, 1.0]), NanPolicy::Hole).unwrap()
}

/// Opacity between two values, with a ramp before the first.
fn window(low: f64, high: f64) -> Shown {
    let knot = |x: f64, opacity: f64| Knot { x, color: [1.0; 3], opacity };
    let knots = vec![knot(low, 0.0), knot(low + 0.05, 0.5), knot(high, 0.5), knot(high + 1e-3, 0.0)];
    Shown::from(&TransferFunction::new("window", knots, 1.0).unwrap())
}

#[test]
fn distances_follow_a_transfer_function() {
    let mut random = Random(12);
    for round in 0..120 {
        let (dims, spacing) = ([0; 3].map(|_| 1 + random.below(24)), [1.0, 1.0, [1.0, 1.7][random.below(2)]]);
        // Cells are looked for in stretches of a row.
        let dims = [dims[0] + if round % 5 == 0 { 150 } else { 0 }, dims[1], dims[2]];
        let field = field(&mut random, dims, spacing, round % 4 == 0);
        let code = |most: f32| field.values.iter().map(move |value| value * most);
        let values = match round % 3 {
            0 => Values::Unorm8(code(255.0).map(|code| code as u8).collect::<Vec<u8>>().into()),
            1 => Values::Unorm16(code(65535.0).map(|code| code as u16).collect::<Vec<u16>>().into()),
            _ => Values::Float(field.values.as_slice().into()),
        };
        let lookup = Lookup {
            distance: [Distance::Omni, Distance::Directional][random.below(2)],
            cell: 1 + random.below(3) as u32,
            nearest: random.below(4) == 0,
            projection: ProjectionName::default(),
            view: None,
        };
        let (mut low, mut high) = (0.5f64, 0.9);
        let mut kept = Updatable::new(&field, &values, &window(low, high), &lookup).unwrap();
        for _ in 0..8 {
            low = (low + [0.0, 1.0 / 255.0, -1.0 / 255.0, 1e-4, 0.1, -0.2][random.below(6)]).clamp(-0.1, 0.6);
            high = [high, high, 0.7 + 0.4 * random.next()][random.below(3)];
            let shown = window(low, high);
            kept.update(&field, &values, &shown);
            assert_eq!(kept.distances(), &structure::build(&field, &values, &shown, &lookup), "{lookup:?} of {dims:?}");
        }
    }
}

#[test]
fn distances_of_a_view_do_not_follow() {
    let field = field(&mut Random(13), [4; 3], [1.0; 3], false);
    let values = Values::Float(field.values.as_slice().into());
    let lookup =
        |distance| Lookup { distance, cell: 1, nearest: false, projection: ProjectionName::default(), view: None };
    for distance in [Distance::Optimal, Distance::Cone] {
        assert!(Updatable::new(&field, &values, &window(0.5, 0.9), &lookup(distance)).is_none());
    }
}
