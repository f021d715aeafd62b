//! `optimal` and `cone`: the bounds they promise, how near they come to the truth, and for whom a cone holds.

mod random;

use depthleap::scene::Field;
use depthleap::scene::Volume;
use depthleap::scene::field::NanPolicy;
use depthleap::scene::volume::Voxels;
use depthleap::structure::bundle::{Bundles, along};
use depthleap::structure::distance::omni;
use depthleap::structure::grid::{DistanceField, FAR, Grid, OCTANTS, SLACK, byte_of, octant_of};
use depthleap::structure::octants::directional;
use depthleap::structure::{LookupView, RaysFrom};
use glam::DVec3;
use random::Random;

impl Random {
    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    /// Uniform on the unit sphere.
    fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = (std::f64::consts::TAU * self.next()).sin_cos();
        let flat = (1.0 - z * z).sqrt();
        DVec3::new(flat * cos, flat * sin, z)
    }
}

const SHAPES: [[usize; 3]; 8] =
    [[1, 1, 1], [1, 7, 1], [9, 1, 1], [1, 1, 5], [2, 3, 4], [1, 6, 5], [17, 9, 8], [33, 2, 19]];

/// Where the cell `i` of a list lies.
fn place(grid: &Grid, i: usize) -> [usize; 3] {
    let [nx, ny, _] = grid.cells;
    [i % nx, i / nx % ny, i / (nx * ny)]
}

/// None, few, many or all of the cells.
fn random_mask(random: &mut Random, cells: [usize; 3]) -> Vec<bool> {
    let density = [0.0, 0.001, 0.01, 0.1, 0.5, 1.0][random.below(6)];
    (0..cells.iter().product()).map(|_| random.next() < density).collect()
}

/// A volume of one value: what is interesting is said apart.
fn volume(dims: [usize; 3], spacing: [f64; 3]) -> Field {
    let values = Voxels::F32(vec![0.0; dims.iter().product()]);
    let volume = Volume::new("test", dims, spacing, values).unwrap();
    Field::new(volume, Some([0.0, 1.0]), NanPolicy::Hole).unwrap()
}

fn made(field: &Field, grid: &Grid, mask: &[bool], view: &LookupView) -> DistanceField {
    along(&omni(grid, mask), mask, &Bundles::new(grid, field, view))
}

/// Volume space, in voxels of the finest spacing from the first voxel's centre, and back.
struct Space {
    corner: DVec3,
    finest: f64,
    spacing: DVec3,
    dims: DVec3,
}

impl Space {
    fn of(field: &Field) -> Self {
        let spacing = field.voxel() / field.finest();
        let dims = DVec3::from_array(field.dims().map(|n| n as f64));
        Self { corner: -0.5 * field.extent(), finest: field.finest(), spacing, dims }
    }

    fn voxels(&self, point: DVec3) -> DVec3 {
        (point - self.corner) / self.finest - 0.5 * self.spacing
    }

    fn volume(&self, point: DVec3) -> DVec3 {
        (point + 0.5 * self.spacing) * self.finest + self.corner
    }

    /// The direction of the view's ray through a point, in voxels.
    fn way(&self, from: RaysFrom, point: DVec3) -> Option<DVec3> {
        match from {
            RaysFrom::Eye(eye) => (point - self.voxels(eye)).try_normalize(),
            RaysFrom::Along(direction) => Some(direction),
        }
    }

    fn faces(&self) -> [DVec3; 2] {
        [-0.5 * self.spacing, (self.dims - 0.5) * self.spacing]
    }

    /// The box of a cell, border cells to the faces.
    fn cell(&self, grid: &Grid, cell: [usize; 3]) -> [DVec3; 2] {
        let [low, high] = self.faces();
        let at = |a: usize, c: usize| c as f64 * grid.sides[a];
        let lower = |a: usize| if cell[a] == 0 { low[a] } else { at(a, cell[a]) };
        let upper = |a: usize| if cell[a] + 1 == grid.cells[a] { high[a] } else { at(a, cell[a] + 1) };
        [DVec3::from_array([0, 1, 2].map(lower)), DVec3::from_array([0, 1, 2].map(upper))]
    }
}

/// Where a ray from a point first meets an interesting cell: the length, or none.
fn entry(space: &Space, grid: &Grid, targets: &[[usize; 3]], from: DVec3, direction: DVec3) -> Option<f64> {
    let lengths = targets.iter().filter_map(|target| {
        let [lower, upper] = space.cell(grid, *target);
        let (mut first, mut last) = (0.0f64, f64::INFINITY);
        for a in 0..3 {
            if direction[a] == 0.0 {
                if from[a] < lower[a] || from[a] >= upper[a] {
                    return None;
                }
                continue;
            }
            let (s, t) = ((lower[a] - from[a]) / direction[a], (upper[a] - from[a]) / direction[a]);
            (first, last) = (first.max(s.min(t)), last.min(s.max(t)));
        }
        // A corner or a face that is only touched is none of the target's points.
        (first + 1e-9 < last).then_some(first)
    });
    lengths.min_by(f64::total_cmp)
}

/// A point of a box, often on its faces and corners.
fn point(random: &mut Random, [lower, upper]: [DVec3; 2]) -> DVec3 {
    let weight = DVec3::from_array([0; 3].map(|_: i32| match random.below(4) {
        0 => 0.0,
        1 => 1.0,
        _ => random.next(),
    }));
    lower + weight * (upper - lower)
}

const SPACINGS: [[f64; 3]; 4] = [[1.0; 3], [1.0, 1.7, 2.3], [0.5, 2.0, 0.5], [3.0, 1.0, 1.0]];

/// An eye outside, near a face, or inside; sometimes on an axis or in the plane of a face of cells.
fn random_eye(random: &mut Random, space: &Space) -> DVec3 {
    let [low, high] = space.faces();
    let (middle, size) = (0.5 * (low + high), (high - low).length());
    let eye = match random.below(4) {
        0 => middle + random.direction() * size * random.between(0.6, 8.0),
        1 => middle + DVec3::AXES[random.below(3)] * size * random.between(-3.0, 3.0),
        2 => low + DVec3::from_array([0; 3].map(|_: i32| random.next())) * (high - low),
        _ => point(random, [low, high]) + random.direction() * random.between(0.0, 6.0),
    };
    space.volume(if random.below(3) == 0 { eye.round() } else { eye })
}

struct Case {
    field: Field,
    grid: Grid,
    mask: Vec<bool>,
    targets: Vec<[usize; 3]>,
    space: Space,
}

impl Case {
    /// Often one from which an interesting cell is seen, some way off.
    fn any_cell(&self, random: &mut Random, view: &LookupView) -> [usize; 3] {
        let [low, high] = self.space.faces();
        let mut at = low + DVec3::from_array([0; 3].map(|_: i32| random.next())) * (high - low);
        if !self.targets.is_empty() && random.below(8) > 0 {
            let target = self.targets[random.below(self.targets.len())];
            at = point(random, self.space.cell(&self.grid, target));
            at -= self.space.way(view.from, at).unwrap_or_default() * random.between(1.0, 30.0);
        }
        let cell = (at / self.grid.sides).floor();
        [0, 1, 2].map(|a| (cell[a].max(0.0) as usize).min(self.grid.cells[a] - 1))
    }
}

fn random_case(random: &mut Random) -> Case {
    let dims = match random.below(4) {
        0 => SHAPES[random.below(SHAPES.len())],
        1 => {
            let mut dims = [1 + random.below(2); 3];
            dims[random.below(3)] = 2 + random.below(300);
            dims
        }
        _ => [1 + random.below(40), 1 + random.below(40), 1 + random.below(40)],
    };
    let field = volume(dims, SPACINGS[random.below(SPACINGS.len())]);
    let grid = Grid::new(&field, 1 << random.below(4));
    let mut mask = random_mask(random, grid.cells);
    if random.below(2) == 0 {
        // A few cells, so that there is room.
        mask.fill(false);
        for _ in 0..1 + random.below(6) {
            mask[random.below(grid.count())] = true;
        }
    }
    let targets = (0..mask.len()).filter(|&i| mask[i]).map(|i| place(&grid, i)).collect();
    Case { space: Space::of(&field), field, grid, mask, targets }
}

/// Rays through random points of random cells go as far as they are told.
fn assert_bounds(
    seed: u64,
    cone: bool,
    from: impl Fn(&mut Random, &Space) -> RaysFrom,
    ray: impl Fn(&mut Random, &Case, &LookupView, DVec3) -> Option<DVec3>,
) {
    let mut random = Random(seed);
    let (mut jumped, mut met) = (0, 0);
    for _ in 0..400 {
        let case = random_case(&mut random);
        let half_angle = cone.then(|| [0.01, 1.0, 10.0, 30.0, 60.0][random.below(5)]).map(f64::to_radians);
        let view = LookupView { from: from(&mut random, &case.space), half_angle };
        let found = made(&case.field, &case.grid, &case.mask, &view);
        assert_eq!((found.octants, found.bytes.len()), (1, case.grid.count()));
        for _ in 0..400 {
            let cell = case.any_cell(&mut random, &view);
            let bound = found.bytes[case.grid.index(cell)].saturating_sub(1);
            assert_eq!(found.bytes[case.grid.index(cell)] == 0, case.mask[case.grid.index(cell)]);
            let from = point(&mut random, case.space.cell(&case.grid, cell));
            let Some(direction) = ray(&mut random, &case, &view, from).filter(|_| bound > 0) else { continue };
            jumped += 1;
            let Some(length) = entry(&case.space, &case.grid, &case.targets, from, direction) else { continue };
            met += 1;
            // The slack is for whoever jumps by the bound, not for the builder.
            assert!(
                bound == FAR && length >= f64::from(FAR) || length >= f64::from(bound) + SLACK,
                "{bound} at cell {cell:?}, but {length} from {from} along {direction}; {:?}, {view:?}, {:?}",
                case.field.volume.dims,
                case.grid
            );
        }
    }
    assert!(jumped > 20_000 && met > 700, "{jumped} rays, {met} met something");
}

/// Within an angle of a direction, often at that angle.
fn within(random: &mut Random, direction: DVec3, angle: f64) -> DVec3 {
    let angle = if random.below(2) == 0 { angle } else { angle * random.next() };
    at_angle(random, direction, angle)
}

/// At an angle to a direction.
fn at_angle(random: &mut Random, direction: DVec3, angle: f64) -> DVec3 {
    let side = direction.cross(random.direction()).normalize();
    direction * angle.cos() + side * angle.sin()
}

fn an_eye(random: &mut Random, space: &Space) -> RaysFrom {
    RaysFrom::Eye(random_eye(random, space))
}

/// Rays along any direction, often along an axis.
fn far_away(random: &mut Random, _: &Space) -> RaysFrom {
    RaysFrom::Along(match random.below(3) {
        0 => DVec3::AXES[random.below(3)],
        _ => random.direction(),
    })
}

#[test]
fn optimal_holds_for_every_ray_of_the_eye() {
    assert_bounds(40, false, an_eye, |_, case, view, from| case.space.way(view.from, from));
}

#[test]
fn optimal_holds_for_every_ray_of_an_orthographic_view() {
    assert_bounds(45, false, far_away, |_, case, view, from| case.space.way(view.from, from));
}

#[test]
fn cone_holds_for_every_direction_it_serves_of_orthographic_views() {
    assert_bounds(46, true, far_away, |random, case, view, from| {
        let own = case.space.way(view.from, from)?;
        let moved = within(random, own, 0.999 * view.half_angle?);
        let serves = |way: DVec3| view.serves(&case.grid, &case.field, RaysFrom::Along(way));
        assert!(serves(moved) && !serves(at_angle(random, own, 1.001 * view.half_angle?)));
        assert!(!view.serves(&case.grid, &case.field, RaysFrom::Eye(own)));
        Some(moved)
    });
}

#[test]
fn cone_holds_for_every_direction_within_the_half_angle_of_the_views() {
    assert_bounds(41, true, an_eye, |random, case, view, from| {
        let own = case.space.way(view.from, from)?;
        Some(within(random, own, view.half_angle?))
    });
}

#[test]
fn cone_holds_for_every_eye_it_serves() {
    assert_bounds(42, true, an_eye, |random, case, view, from| {
        let [low, high] = case.space.faces();
        let RaysFrom::Eye(eye) = view.from else { return None };
        let eye = case.space.voxels(eye);
        let allowed = view.half_angle?.sin() * (eye - eye.clamp(low, high)).length();
        let away = random.direction();
        let serves = |eye: DVec3| view.serves(&case.grid, &case.field, RaysFrom::Eye(case.space.volume(eye)));
        if allowed < 1e-3 {
            assert!(!serves(eye + away * (allowed + 1e-3)) && view.serves(&case.grid, &case.field, view.from));
            return None;
        }
        let moved = eye + away * (allowed - 1e-4) * 0.9999;
        assert!(serves(moved) && !serves(eye + away * (allowed * 1.0001 + 1e-4)));
        (from - moved).try_normalize()
    });
}

#[test]
fn optimal_serves_its_own_eye_only() {
    let field = volume([9; 3], [1.0; 3]);
    for half_angle in [None, Some(0.2)] {
        let grid = Grid::new(&field, 1);
        let made_for = |from: RaysFrom| LookupView { from, half_angle };
        let (outside, inside) = (DVec3::new(0.1, 0.2, 1.9), DVec3::splat(0.1));
        let beside = 1e-12 * DVec3::X;
        for (eye, moves) in [(outside, half_angle.is_some()), (inside, false)] {
            let view = made_for(RaysFrom::Eye(eye));
            assert!(view.serves(&grid, &field, view.from));
            assert_eq!(view.serves(&grid, &field, RaysFrom::Eye(eye + beside)), moves);
        }
        let along = made_for(RaysFrom::Along(DVec3::NEG_Z));
        assert!(along.serves(&grid, &field, along.from));
        assert_eq!(along.serves(&grid, &field, RaysFrom::Along(DVec3::NEG_Z + beside)), half_angle.is_some());
    }
}

#[test]
fn bounds_of_a_cell_stand_in_order() {
    let mut random = Random(43);
    for _ in 0..150 {
        let case = random_case(&mut random);
        let eye = random_eye(&mut random, &case.space);
        let (any, each) = (omni(&case.grid, &case.mask), directional(&case.grid, &case.mask));
        let view = |half_angle: Option<f64>| LookupView { from: RaysFrom::Eye(eye), half_angle };
        let optimal = made(&case.field, &case.grid, &case.mask, &view(None));
        let wide = made(&case.field, &case.grid, &case.mask, &view(Some(0.4)));
        let narrow = made(&case.field, &case.grid, &case.mask, &view(Some(0.02)));
        for i in 0..case.grid.count() {
            let any = any.bytes[i];
            assert!(each.bytes[i * OCTANTS..][..OCTANTS].iter().all(|one| *one >= any));
            let [wide, narrow, optimal] = [&wide, &narrow, &optimal].map(|made| made.bytes[i]);
            assert!(any <= wide && any <= optimal, "{any}, {wide}, {optimal}");
            // Where the search of a larger box has found enough, neither goes on.
            assert!(wide.min(33) <= narrow.min(33) + 1, "{wide}, {narrow}");
        }
    }
}

/// What `optimal` could say of a cell, as a length: the box scaled about the eye until it touches an interesting cell,
/// counted for the point of the box that is nearest to the eye.
fn scaled_until_touch(case: &Case, eye: DVec3, cell: [usize; 3]) -> f64 {
    let [lower, upper] = case.space.cell(&case.grid, cell);
    let scales = case.targets.iter().filter_map(|target| {
        let [from, to] = case.space.cell(&case.grid, *target);
        let (mut first, mut last) = (1.0f64, f64::INFINITY);
        for a in 0..3 {
            // eye + scale (lower - eye) <= to and eye + scale (upper - eye) >= from.
            for (speed, room) in [(lower[a] - eye[a], to[a] - eye[a]), (eye[a] - upper[a], eye[a] - from[a])] {
                if speed > 0.0 {
                    last = last.min(room / speed);
                } else if speed < 0.0 {
                    first = first.max(room / speed);
                } else if room < 0.0 {
                    return None;
                }
            }
        }
        // What is touched at the start only lies behind.
        (first < last - 1e-12).then_some(first)
    });
    let scale = scales.fold(f64::INFINITY, f64::min);
    (scale - 1.0) * (eye - eye.clamp(lower, upper)).length()
}

#[test]
fn optimal_is_as_long_as_a_bundle_can_be() {
    let mut random = Random(44);
    let (mut loss, mut shorter, mut cells) = (0.0, 0, 0);
    for _ in 0..60 {
        let case = random_case(&mut random);
        let [low, high] = case.space.faces();
        let eye = 0.5 * (low + high) + random.direction() * (high - low).length() * random.between(0.8, 3.0);
        let view = LookupView { from: RaysFrom::Eye(case.space.volume(eye)), half_angle: None };
        let found = made(&case.field, &case.grid, &case.mask, &view);
        for i in 0..case.grid.count() {
            let length = scaled_until_touch(&case, eye, place(&case.grid, i));
            // Farther than that the search of a larger box may do.
            let whole = (length - SLACK).clamp(0.0, 32.0).floor();
            let less = whole - f64::from(found.bytes[i].saturating_sub(1));
            loss += less.max(0.0);
            shorter += usize::from(less > 0.0);
            cells += 1;
        }
    }
    let mean = loss / cells as f64;
    assert!(mean < 0.05, "{mean} voxels lost on average, in {shorter} of {cells} cells");
}

#[test]
fn optimal_looks_along_the_rays_only() {
    // A wall beside the rays, a cell away: any direction says 0, the octant says 0, the rays never meet it.
    let f = volume([4, 4, 200], [1.0; 3]);
    let grid = Grid::new(&f, 1);
    let mut mask = vec![false; grid.count()];
    for z in 0..grid.cells[2] {
        mask[grid.index([2, 1, z])] = true;
    }
    let eye = DVec3::new(-0.001, 0.0, 3.0);
    let view = LookupView { from: RaysFrom::Eye(eye), half_angle: None };
    let found = made(&f, &grid, &mask, &view);
    assert_eq!(found.free([0, 1, 150], 0), Some(FAR), "leaves by the near side");
    assert_eq!(octant_of(DVec3::ZERO - eye), 4);
    assert_eq!(omni(&grid, &mask).free([1, 1, 150], 0), Some(0));
    assert_eq!(found.free([2, 1, 150], 0), None);
}

#[test]
fn nothing_interesting_is_far_and_everything_is_near() {
    for dims in SHAPES {
        let f = volume(dims, [1.0; 3]);
        let grid = Grid::new(&f, 1);
        for half_angle in [None, Some(0.1)] {
            let view = LookupView { from: RaysFrom::Eye(DVec3::new(0.3, 0.2, 4.0)), half_angle };
            let count = grid.count();
            assert_eq!(made(&f, &grid, &vec![false; count], &view).bytes, vec![byte_of(false, FAR); count]);
            assert_eq!(made(&f, &grid, &vec![true; count], &view).bytes, vec![0; count]);
        }
    }
}
