//! Interesting cells, distances and blocks against obvious twins, and the bounds they promise.

mod random;

use depthleap::math::interpolate::trilinear;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::transfer::Knot;
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Field, TransferFunction, Volume};
use depthleap::structure::blocks::{BLOCK, CODES, range_codes, visibility_table};
use depthleap::structure::cells::{self, Support, Values, widened};
use depthleap::structure::distance::omni;
use depthleap::structure::grid::{FAR, Grid, OCTANTS, byte_of};
use depthleap::structure::octants::directional;
use depthleap::structure::ranges::ranges;
use depthleap::structure::square::{FAR_SQUARED, UNIT, reach, weight};
use glam::DVec3;
use random::Random;

impl Random {
    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }
}

fn field(dims: [usize; 3], spacing: [f64; 3], values: Vec<f32>) -> Field {
    let volume = Volume::new("test", dims, spacing, Voxels::F32(values)).unwrap();
    Field::new(volume, Some([0.0, 1.0]), NanPolicy::Hole).unwrap()
}

/// Cells of one voxel.
fn grid(cells: [usize; 3], sides: DVec3) -> Grid {
    Grid { cell: 1, cells, sides, volume_cells: cells }
}

/// Flags of the cells of one voxel.
fn interesting(field: &Field, transfer: &TransferFunction) -> Vec<bool> {
    let values = Values::Float(field.values.as_slice().into());
    cells::interesting(field, &values, &transfer.into(), &Grid::new(field, 1), false)
}

fn preset(name: &str) -> TransferFunction {
    TransferFunction::preset(name, 1.0).unwrap().unwrap()
}

fn transfer(points: &[[f64; 2]]) -> TransferFunction {
    let knots = points.iter().map(|p| Knot { x: p[0], color: [1.0; 3], opacity: p[1] }).collect();
    TransferFunction::new("test", knots, 1.0).unwrap()
}

/// Knots on a coarse grid of x, from `low` to `high`, so that jumps, spikes and gaps abound.
fn random_transfer(random: &mut Random, low: f64, high: f64) -> TransferFunction {
    let mut places: Vec<f64> =
        (0..1 + random.below(7)).map(|_| low + (high - low) * random.below(17) as f64 / 16.0).collect();
    places.sort_by(f64::total_cmp);
    let points: Vec<[f64; 2]> =
        places.iter().map(|&x| [x, if random.below(2) == 0 { 0.0 } else { random.next() }]).collect();
    transfer(&points)
}

/// Values on the same grid as the knots, with constant neighbourhoods among them, and some between.
fn random_field(random: &mut Random, dims: [usize; 3]) -> Field {
    let mut last = 0.0;
    let values = (0..dims.iter().product())
        .map(|_| {
            last = match random.below(4) {
                0 => random.below(17) as f32 / 16.0,
                1 => (1.4 * random.next() - 0.2) as f32,
                _ => last,
            };
            last
        })
        .collect();
    field(dims, [1.0; 3], values)
}

const SHAPES: [[usize; 3]; 8] =
    [[1, 1, 1], [1, 7, 1], [9, 1, 1], [1, 1, 5], [2, 3, 4], [1, 6, 5], [17, 9, 8], [33, 2, 19]];

#[test]
fn support_says_what_visible_says() {
    let mut random = Random(1);
    let mut seen = [0; 2];
    for _ in 0..2000 {
        let tf = random_transfer(&mut random, -0.5, 1.5);
        let support = Support::of(&(&tf).into());
        for _ in 0..50 {
            let mut ends = [0, 1].map(|_| {
                let x = (2.5 * random.below(41) as f64 / 40.0 - 0.75) as f32;
                // On a knot's place, or just above or below it: at least so far that `visible`, which evaluates in
                // f64, can tell (beside x = 0 f32 goes on to 1e-45).
                let near = f32::EPSILON * x.abs().max(0.1);
                [x, x + near, x - near][random.below(3)]
            });
            ends.sort_by(f32::total_cmp);
            let [low, high] = ends;
            let visible = tf.visible(f64::from(low), f64::from(high));
            assert_eq!(support.meets(low, high), visible, "{tf:?} over [{low}, {high}]");
            seen[usize::from(visible)] += 1;
        }
    }
    assert!(seen[0] > 10_000 && seen[1] > 10_000, "{seen:?}");
}

#[test]
fn interesting_is_visible_over_each_cell() {
    let mut random = Random(2);
    for round in 0..400 {
        let f = random_field(&mut random, SHAPES[round % SHAPES.len()]);
        let tf = random_transfer(&mut random, -0.1, 1.1);
        let [nx, ny, nz] = f.cells();
        let flags = interesting(&f, &tf);
        assert_eq!(flags.len(), nx * ny * nz);
        for (i, flag) in flags.into_iter().enumerate() {
            let corners = f.corners([i % nx, i / nx % ny, i / (nx * ny)]).map(|c| f.values[c]);
            let low = corners.into_iter().fold(f32::INFINITY, f32::min);
            let high = corners.into_iter().fold(f32::NEG_INFINITY, f32::max);
            let [low, high] = widened(low, high);
            assert_eq!(flag, tf.visible(f64::from(low), f64::from(high)), "cell {i} of {:?}", f.dims());
        }
    }
}

#[test]
fn constant_background_at_the_end_of_a_ramp_is_not_interesting() {
    let mut values = vec![0.0; 4 * 4 * 4];
    assert_eq!(interesting(&field([4; 3], [1.0; 3], values.clone()), &preset("linear")), [false; 27]);
    values[63] = 1e-30;
    let flags = interesting(&field([4; 3], [1.0; 3], values), &preset("linear"));
    assert_eq!(flags.iter().position(|f| *f), Some(26), "only the cell with the voxel that is not 0");
}

#[test]
fn range_that_ends_within_rounding_of_a_ramp_is_interesting() {
    // 0.25 is invisible and one rounding above it is not: interpolation between 0 and 0.25 may get there.
    let flags = interesting(&field([2, 1, 1], [1.0; 3], vec![0.0, 0.25]), &preset("ramp"));
    assert_eq!(flags, [true]);
    // A texture's idea of a code may be a rounding above it too.
    let flags = interesting(&field([2, 1, 1], [1.0; 3], vec![0.25, 0.25]), &preset("ramp"));
    assert_eq!(flags, [true]);
    let flags = interesting(&field([2, 1, 1], [1.0; 3], vec![0.2499, 0.2499]), &preset("ramp"));
    assert_eq!(flags, [false]);
}

#[test]
fn holes_are_never_interesting() {
    let mut values = vec![0.5; 5];
    values[2] = f32::NAN;
    assert_eq!(interesting(&field([5, 1, 1], [1.0; 3], values), &preset("haze")), [true, false, false, true]);
}

/// Distances by the definition: for rays that may go to any cell for which `reachable` holds on every axis.
fn brute_force(
    cells: [usize; 3],
    sides: DVec3,
    interesting: &[bool],
    reachable: impl Fn(usize, usize, usize) -> bool,
) -> Vec<u8> {
    let place = |i: usize| [i % cells[0], i / cells[0] % cells[1], i / (cells[0] * cells[1])];
    let targets: Vec<[usize; 3]> = (0..interesting.len()).filter(|&i| interesting[i]).map(place).collect();
    (0..interesting.len())
        .map(|i| {
            let here = place(i);
            let square = |there: &[usize; 3]| -> u64 {
                (0..3)
                    .map(|a| (here[a].abs_diff(there[a]).saturating_sub(1) as u64).pow(2) * u64::from(weight(sides[a])))
                    .sum()
            };
            let targets = targets.iter().filter(|there| (0..3).all(|axis| reachable(axis, here[axis], there[axis])));
            let square = targets.map(square).min().unwrap_or(u64::MAX);
            let within = |d: &u64| *d == 0 || d * d * u64::from(UNIT) + 32 * d < square;
            let free = (0..=254u64).rev().find(within).unwrap_or(0) as u8;
            if interesting[i] { 0 } else { free + 1 }
        })
        .collect()
}

#[track_caller]
fn assert_exact(cells: [usize; 3], sides: DVec3, interesting: &[bool]) {
    let found = omni(&grid(cells, sides), interesting);
    assert_eq!(found.bytes, brute_force(cells, sides, interesting, |_, _, _| true), "omni of {cells:?}, {sides}");
    let found = directional(&grid(cells, sides), interesting);
    for octant in 0..OCTANTS {
        let reachable = |axis: usize, here: usize, there: usize| {
            if octant >> axis & 1 == 0 { there >= here } else { there <= here }
        };
        let of_octant: Vec<u8> = found.bytes.iter().copied().skip(octant).step_by(OCTANTS).collect();
        let expected = brute_force(cells, sides, interesting, reachable);
        assert_eq!(of_octant, expected, "octant {octant} of {cells:?}, {sides}");
    }
}

#[test]
fn reach_is_where_squares_become_far() {
    for side in [1.0, 1.3, 2.0, 8.0, 40.0, 255.0, 256.0, 1e4] {
        let (weight, reach) = (u64::from(weight(side)), u64::from(reach(weight(side))));
        let far = u64::from(FAR_SQUARED);
        assert!(reach * reach * weight >= far && (reach - 1) * (reach - 1) * weight < far, "side {side}");
    }
}

#[test]
fn distances_agree_with_brute_force() {
    let mut random = Random(3);
    let all_sides = [DVec3::ONE, DVec3::new(1.0, 2.5, 1.0), DVec3::new(3.7, 1.0, 1.9), DVec3::new(1.0, 1.0, 40.0)];
    for round in 0..100 {
        let cells = if round % 2 == 0 {
            SHAPES[round / 2 % SHAPES.len()]
        } else {
            [1 + random.below(14), 1 + random.below(14), 1 + random.below(14)]
        };
        let density = [0.0, 0.001, 0.01, 0.1, 0.5, 1.0][random.below(6)];
        let mask: Vec<bool> = (0..cells.iter().product()).map(|_| random.next() < density).collect();
        for sides in all_sides {
            assert_exact(cells, sides, &mask);
        }
    }
}

#[test]
fn distances_agree_with_brute_force_on_structures() {
    let cells = [24, 21, 19];
    let mask = |inside: &dyn Fn([f64; 3]) -> bool| -> Vec<bool> {
        (0..cells.iter().product::<usize>())
            .map(|i| inside([i % cells[0], i / cells[0] % cells[1], i / (cells[0] * cells[1])].map(|c| c as f64)))
            .collect()
    };
    let radius = |[x, y, z]: [f64; 3]| ((x - 12.0).powi(2) + (y - 10.0).powi(2) + (z - 9.0).powi(2)).sqrt();
    let shell = mask(&|p| (radius(p) - 7.0).abs() < 0.5);
    let plane = mask(&|p| p[2] == 16.0);
    let rod = mask(&|p| p[0] == 3.0 && p[1] == 19.0);
    let corners = mask(&|p| p == [0.0; 3] || p == [23.0, 20.0, 18.0]);
    for mask in [shell, plane, rod, corners] {
        assert_exact(cells, DVec3::ONE, &mask);
        assert_exact(cells, DVec3::new(1.0, 1.25, 2.0), &mask);
    }
}

#[test]
fn far_distances_saturate() {
    let mut mask = vec![false; 600];
    mask[10] = true;
    for (axis, sides) in [(0, 1), (1, 1), (2, 1), (0, 2), (1, 2), (2, 2)] {
        let mut cells = [1; 3];
        cells[axis] = 600;
        let mut scale = DVec3::ONE;
        scale[axis] = f64::from(sides);
        let found = omni(&grid(cells, scale), &mask).bytes;
        let expected: Vec<u8> = (0..600usize)
            .map(|i| match i.abs_diff(10) {
                0 => 0,
                apart => ((apart - 1) * sides as usize).saturating_sub(1).min(254) as u8 + 1,
            })
            .collect();
        assert_eq!(found, expected, "axis {axis}, side {sides}");
    }
}

#[test]
fn nothing_interesting_is_far_and_everything_is_near() {
    for cells in SHAPES {
        let count = cells.iter().product();
        assert_eq!(omni(&grid(cells, DVec3::ONE), &vec![false; count]).bytes, vec![byte_of(false, FAR); count]);
        assert_eq!(omni(&grid(cells, DVec3::ONE), &vec![true; count]).bytes, vec![0; count]);
    }
}

#[test]
fn bound_holds_at_random_points_between_voxels() {
    // From any point, in border regions too, no point nearer than the distance shows anything.
    let mut random = Random(5);
    let dims = [24, 20, 16];
    let tf = preset("ramp");
    for spacing in [[1.0; 3], [1.0, 1.7, 2.3]] {
        let mut values = vec![0.1f32; dims.iter().product()];
        for _ in 0..4 {
            values[random.below(dims.iter().product())] = 0.9;
        }
        let f = field(dims, spacing, values);
        let distances = omni(&Grid::new(&f, 1), &interesting(&f, &tf));
        let side = DVec3::from_array(spacing);
        let (mut tested, mut jumped) = (0, 0);
        for _ in 0..300_000 {
            let here = DVec3::from_array(dims.map(|n| n as f64 * random.next()));
            let reach = distances.free(f.cell_at(here), 0).map_or(0.0, f64::from);
            jumped += usize::from(reach > 0.0);
            let z = 2.0 * random.next() - 1.0;
            let (sin, cos) = (std::f64::consts::TAU * random.next()).sin_cos();
            let flat = (1.0 - z * z).sqrt();
            // Mostly near the end of the reach, where a wrong bound would show.
            let there =
                here + DVec3::new(flat * cos, flat * sin, z) * reach * (1.0 - 0.3 * random.next().powi(4)) / side;
            if there.cmplt(DVec3::ZERO).any() || there.cmpgt(DVec3::from_array(dims.map(|n| n as f64))).any() {
                continue;
            }
            tested += 1;
            let x = trilinear(&f.values, dims, there);
            assert!(reach == 0.0 || tf.evaluate(x)[3] == 0.0, "{here} sees x = {x} at {there}, within {reach}");
        }
        assert!(tested > 100_000 && jumped > 100_000, "{tested} tested, {jumped} with a distance");
    }
}

#[test]
fn cell_sides_are_one_where_spacings_are_equal() {
    assert_eq!(Grid::new(&field([41, 61, 57], [0.3; 3], vec![0.0; 41 * 61 * 57]), 1).sides, DVec3::ONE);
    assert_eq!(Grid::new(&field([1, 2, 3], [0.5, 1.0, 0.25], vec![0.0; 6]), 1).sides, DVec3::new(2.0, 4.0, 1.0));
}

#[test]
fn block_ranges_cover_the_voxels_their_cells_interpolate() {
    let mut random = Random(6);
    for dims in [[1, 1, 1], [8, 9, 10], [17, 16, 18], [1, 30, 2], [25, 1, 9]] {
        let f = random_field(&mut random, dims);
        let (blocks, found) = ranges(&f, BLOCK);
        let cells = f.cells();
        let mut expected = vec![[f32::INFINITY, f32::NEG_INFINITY]; blocks.iter().product()];
        for z in 0..cells[2] {
            for y in 0..cells[1] {
                for x in 0..cells[0] {
                    let block = (z / BLOCK * blocks[1] + y / BLOCK) * blocks[0] + x / BLOCK;
                    for corner in f.corners([x, y, z]) {
                        let [low, high] = &mut expected[block];
                        (*low, *high) = (low.min(f.values[corner]), high.max(f.values[corner]));
                    }
                }
            }
        }
        assert_eq!(found, expected, "{dims:?}");
    }
}

#[test]
fn thin_wall_on_a_seam_is_in_both_blocks() {
    // Voxel 8 is the first of block 1, and the last that block 0 interpolates.
    let f = field([17, 1, 1], [1.0; 3], (0..17).map(|x| f32::from(x == 8)).collect());
    assert_eq!(ranges(&f, BLOCK), ([2, 1, 1], vec![[0.0, 1.0]; 2]));
}

#[test]
fn codes_of_codes_are_themselves() {
    for code in 0..=255u8 {
        let x = f32::from(code) / 255.0;
        assert_eq!(range_codes(x, x), (code, code));
    }
    assert_eq!(range_codes(-3.0, 7.0), (0, 255));
    assert_eq!(range_codes(0.5, 0.5), (127, 128));
    assert_eq!(range_codes(f32::MIN, f32::MAX), (0, 255));
}

#[test]
fn invisible_by_the_table_is_invisible() {
    let mut random = Random(7);
    let (mut skipped, mut invisible) = (0, 0);
    for round in 0..200 {
        let (low, high) = if round % 2 == 0 { (0.0, 1.0) } else { (-0.5, 1.5) };
        let tf = random_transfer(&mut random, low, high);
        let table = visibility_table(&(&tf).into());
        for _ in 0..500 {
            let mut ends = [0, 1].map(|_| match random.below(3) {
                0 => random.below(256) as f32 / 255.0,
                1 => random.below(17) as f32 / 16.0,
                _ => (2.0 * random.next() - 0.5) as f32,
            });
            if random.below(3) == 0 {
                ends[1] = ends[0] + 0.02 * random.next() as f32;
            }
            ends.sort_by(f32::total_cmp);
            let (low, high) = range_codes(ends[0], ends[1]);
            let visible = tf.visible(f64::from(ends[0]), f64::from(ends[1]));
            let told = table[usize::from(high) * CODES + usize::from(low)] == 1;
            assert!(told || !visible, "{tf:?} over {ends:?}, codes {low} {high}");
            skipped += usize::from(!told);
            invisible += usize::from(!visible);
        }
    }
    // It also skips: most of what is invisible is known to be.
    assert!(skipped * 10 > invisible * 7, "{skipped} of {invisible}");
}

#[test]
fn table_keeps_an_empty_background_empty() {
    let table = visibility_table(&(&preset("linear")).into());
    assert_eq!(table[0], 0);
    assert!(table[1..].iter().enumerate().all(|(i, &v)| v == u8::from((i + 1) % CODES <= (i + 1) / CODES)));
    // 0.25 * 255 lies between codes 63 and 64.
    let ramp = visibility_table(&(&preset("ramp")).into());
    assert_eq!((ramp[63 * CODES], ramp[64 * CODES], ramp[64 * CODES + 64]), (0, 1, 1));
}
