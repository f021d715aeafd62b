//! Slices: how many there are, where they lie, and that those across parallel rays are a ray caster's samples; needs no device.

use depthleap::frame::{CpuFrame, Structures, cpu};
use depthleap::method::{self, METHODS, RC};
use depthleap::part::rows::Method;
use depthleap::plan::{Plan, plan};
use depthleap::read;
use depthleap::scene::settings::{Accumulate, Alpha, ClipSettings, Last, MethodName, Offset, SliceCut};
use depthleap::scene::slice_polygons::{CutPlanes, SlicePolygons};
use depthleap::scene::slices::{MOST, SliceSurface, Slices, Stack, within};
use depthleap::scene::{Scene, Settings};

fn scene(change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:12x10x8".to_owned());
    settings.image.size = [31, 25];
    settings.sampling.termination = 1.0;
    settings.sampling.samples_per_pass = 3;
    change(&mut settings);
    read::scene(&settings).expect("a sound scene")
}

fn drawn(scene: &Scene, method: MethodName) -> (Plan, CpuFrame) {
    let mut scene = scene.clone();
    scene.settings.method.name = method;
    let plan = plan(&scene, method::papers_form(method)).expect("a plan");
    let mut structures = Structures::default();
    structures.prepare(&scene, &plan);
    let frame = cpu::run(&scene, &plan, &structures, cpu::SUB_PIXEL_BITS);
    (plan, frame)
}

fn slicers() -> impl Iterator<Item = &'static Method> {
    METHODS.into_iter().filter(|method| method.stack().is_some())
}

/// The largest difference of two pictures where neither is undecided.
fn apart(a: &CpuFrame, b: &CpuFrame) -> f64 {
    let decided = |i: &usize| !a.undecided[*i] && !b.undecided[*i];
    let off = |i: usize| (0..4).map(|c| (a.pixels[i][c] - b.pixels[i][c]).abs()).fold(0.0, f64::max);
    (0..a.pixels.len()).filter(decided).map(off).fold(0.0, f64::max)
}

/// Voxels along z.
const VOXELS_DEEP: f64 = 8.0;

/// A view along -z.
fn along_z(settings: &mut Settings) {
    settings.camera.height = Some(1.1);
    settings.camera.eye = [0.0, 0.0, 2.0];
}

#[test]
fn slices_across_parallel_rays_along_an_axis_are_a_ray_casters_samples() {
    for (offset, step) in [(Offset::Left, 1.0), (Offset::Midpoint, 1.0), (Offset::Left, 0.7), (Offset::Midpoint, 2.3)] {
        let scene = scene(|s| {
            along_z(s);
            (s.sampling.offset, s.sampling.step) = (offset, step);
        });
        let (_, cast) = drawn(&scene, RC.name());
        for method in slicers() {
            let (_, sliced) = drawn(&scene, method.name());
            let off = apart(&cast, &sliced);
            assert!(off < 1e-6, "{}, {offset:?}, step {step}: {off:e} apart", method.name);
            assert!(sliced.pixels.iter().any(|pixel| pixel[3] > 0.1), "{}", method.name);
            if !method.looks_ahead() {
                let samples: u64 = sliced.counts.main.iter().sum();
                let rays = cast.counts.main[0];
                assert_eq!(samples, rays * u64::from(scene.samples_on(VOXELS_DEEP / step)), "{}", method.name);
            }
        }
    }
}

#[test]
fn order_of_drawing_changes_the_last_digits_alone() {
    for eye in [[0.9, 0.6, 1.5], [0.11, 0.07, -0.13]] {
        let scene = scene(|s| (s.camera.eye, s.camera.target) = (eye, [-0.1, 0.05, 0.0]));
        for rule in slicers().filter(|method| method.back_to_front()) {
            let (_, behind_first) = drawn(&scene, rule.name());
            for method in slicers().filter(|method| method.stack() == rule.stack()) {
                let (_, frame) = drawn(&scene, method.name());
                let off = apart(&behind_first, &frame);
                assert!(off < 1e-12, "{} from {eye:?}: {off:e} from {}", method.name, rule.name);
            }
        }
    }
}

#[test]
fn a_stack_lies_across_the_axis_nearest_to_the_view() {
    let axis = |eye: [f64; 3]| {
        let scene = scene(|s| s.camera.eye = eye);
        Slices::new(&scene, Stack::Objects, None).unwrap().surface
    };
    assert_eq!(axis([2.0, 0.5, 0.4]), SliceSurface::Axis(0));
    assert_eq!(axis([0.5, -2.0, 0.4]), SliceSurface::Axis(1));
    assert_eq!(axis([0.1, 0.5, 2.0]), SliceSurface::Axis(2));
    // Along a diagonal any will do.
    assert!(matches!(axis([1.2, 1.2, 1.2]), SliceSurface::Axis(_)));
}

#[test]
fn without_slices_between_textures_each_has_one() {
    for (eye, voxels) in [([2.0, 0.5, 0.4], 12), ([0.5, -2.0, 0.4], 10), ([0.1, 0.5, 2.0], 8)] {
        let scene = scene(|s| (s.camera.eye, s.method.between, s.sampling.step) = (eye, false, 0.3));
        let slices = Slices::new(&scene, Stack::Objects, None).unwrap();
        assert_eq!(slices.count, voxels);
        let SliceSurface::Axis(axis) = slices.surface else { panic!("{slices:?}") };
        let voxel = scene.field.voxel()[axis];
        assert!((slices.spacing - voxel).abs() < 1e-15);
        // From the side of the eye.
        let first = if eye[axis] < 0.0 { slices.first[0] } else { -slices.first[1] };
        assert!((first + 0.5 * scene.field.extent()[axis] - 0.5 * voxel).abs() < 1e-12, "{slices:?}");
    }
}

#[test]
fn spheres_are_a_step_apart_on_every_ray_and_planes_are_not() {
    let scene = scene(|s| s.camera.fov_y = 60.0);
    let plan = plan(&scene, None).unwrap();
    let [middle, corner] = [plan.view.rays.of(15, 12), plan.view.rays.of(0, 0)];
    let step = scene.settings.sampling.step * scene.field.finest();
    let stride = |stack, ray| Slices::new(&scene, stack, None).unwrap().stride(ray) / step;
    assert!(
        (stride(Stack::Shells, &middle) - 1.0).abs() < 1e-12 && (stride(Stack::Shells, &corner) - 1.0).abs() < 1e-12
    );
    assert!((stride(Stack::View, &middle) - 1.0).abs() < 1e-12);
    assert!((stride(Stack::View, &corner) - corner.direction.length()).abs() < 1e-12);
    assert!(corner.direction.length() > 1.2);
}

#[test]
fn what_slices_cannot_have_is_refused() {
    let refused = |change: fn(&mut Settings), method: &Method, parts: &[&str]| {
        let mut scene = scene(change);
        scene.settings.method.name = method.name();
        let error = plan(&scene, method.papers).map(drop).unwrap_err().to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{}: {error}", method.name);
    };
    for method in slicers() {
        refused(|s| s.sampling.last = Last::Partial, method, &["--method slices-", "--last full"]);
        refused(|s| s.surface.iso = Some(90.0), method, &["--method slices-", "iso-surface", "--iso"]);
        let many: fn(&mut Settings) = |s| {
            s.volume.builtin = Some("shells:40".to_owned());
            (s.sampling.step, s.transfer.reference) = (1e-4, 1e-4);
            // There are slices for all of the volume.
            s.image.size = [3, 2];
        };
        let most = MOST.to_string();
        refused(many, method, &["slices", &most, "--step 0.0001"]);
    }
}

#[test]
fn one_slice_and_many_are_drawn() {
    let one = scene(|s| s.sampling.step = 40.0);
    let many = scene(|s| (s.sampling.step, s.image.size) = (1e-3, [11, 9]));
    for method in slicers().filter(|method| !method.looks_ahead()) {
        let (plan, frame) = drawn(&one, method.name());
        assert_eq!(plan.passes, 1, "{}", method.name);
        assert!(frame.pixels.iter().flatten().all(|channel| channel.is_finite()), "{}", method.name);
    }
    let (plan, frame) = drawn(&many, method::SLICES_3D.name());
    assert!(plan.view.slices.is_some_and(|slices| slices.count >= 8_000));
    let (_, cast) = drawn(&many, RC.name());
    let off = apart(&frame, &cast);
    assert!(off < 1e-3 && frame.pixels.iter().any(|pixel| pixel[3] > 0.1), "{off:e} from rays as finely sampled");
}

/// How opaque the most opaque ray of a view becomes, and whether the plan of the method at a T asks rays whether they end.
fn most_opaque_and_asked(method: &Method, termination: f64, change: impl Fn(&mut Settings)) -> (f64, bool) {
    let scene = scene(|s| {
        (s.transfer.preset, s.sampling.termination) = (Some("haze".to_owned()), termination);
        change(s);
    });
    let (plan, frame) = drawn(&scene, method.name());
    let opacities = frame.pixels.iter().map(|pixel| pixel[3]);
    (opacities.fold(0.0, f64::max), plan.left_out.iter().all(|left| left.what != "early ends of rays"))
}

#[test]
fn rays_on_slices_that_cannot_end_are_not_asked() {
    let wide = |s: &mut Settings| s.camera.fov_y = 120.0;
    let coarse = |s: &mut Settings| s.sampling.step = 3.0;
    let as_they_stand = |s: &mut Settings| (s.sampling.alpha, s.sampling.step) = (Alpha::Paper, 2.0);
    let parallel = |s: &mut Settings| (s.camera.height, s.sampling.step) = (Some(1.4), 0.6);
    let far_apart = |s: &mut Settings| (s.method.between, s.sampling.step, s.transfer.reference) = (false, 0.3, 2.0);
    let inside = |s: &mut Settings| (s.camera.eye, s.camera.fov_y) = ([0.1, 0.0, 0.2], 150.0);
    let coarsely_kept = |s: &mut Settings| s.image.accumulate = Accumulate::Rgba16f;
    // A slab that is thinner than the slack of slices on both of its sides together, in steps that are far thinner.
    let slab = |s: &mut Settings| {
        along_z(s);
        let plane = |plane| ClipSettings { plane: Some(plane), ..ClipSettings::default() };
        s.clips = vec![plane([0.0, 0.0, 1.0, 1e-5]), plane([0.0, 0.0, -1.0, 1e-5])];
        (s.sampling.step, s.transfer.reference) = (1e-4, 1e-4);
        // There are slices for all of the volume.
        s.image.size = [3, 2];
    };
    let changes: [&dyn Fn(&mut Settings); 9] =
        [&|_| {}, &wide, &coarse, &as_they_stand, &parallel, &far_apart, &inside, &coarsely_kept, &slab];
    for method in slicers().filter(|method| method.ends_rays && !method.looks_ahead()) {
        for (i, change) in changes.into_iter().enumerate() {
            let (most, _) = most_opaque_and_asked(method, 1.0, change);
            assert!(most > 0.02, "{} {i}: {most}", method.name);
            assert!(most_opaque_and_asked(method, 0.999 * most, change).1, "{} {i}: one ends", method.name);
        }
        let (most, _) = most_opaque_and_asked(method, 1.0, |_| {});
        let (same, asked) = most_opaque_and_asked(method, 1.5 * most, |_| {});
        assert!(!asked && same == most, "{}: none comes above {} of {most}", method.name, 1.5 * most);
    }
}

#[test]
fn planes_for_the_vertex_shader_are_those_that_rays_meet() {
    for (method, height) in [(method::SLICES_3D, None), (method::SLICES_2D, None), (method::SLICES_2D, Some(1.2))] {
        let scene = scene(|s| s.camera.height = height);
        let (plan, _) = drawn(&scene, method.name());
        let slices = plan.view.slices.as_ref().unwrap();
        let planes = CutPlanes::new(&scene, slices).unwrap();
        let ray = plan.view.rays.of(11, 7);
        let place = ray.at(slices.depth(&ray, 3));
        let up = match slices.surface {
            SliceSurface::Axis(axis) => ray.direction[axis] > 0.0,
            _ => true,
        };
        let by = 3.0 * planes.spacing;
        let (at, shows) = match up {
            true => (planes.first[0] + by, planes.first[0] + by > planes.beyond[0]),
            false => (planes.first[1] - by, planes.first[1] - by < planes.beyond[1]),
        };
        assert!((planes.normal.dot(place) - at).abs() < 1e-12 && shows, "{}", method.name);
        let [x, y, w] = planes.clip.map(|row| row.dot(place.extend(1.0)));
        let pixel = [(x / w + 1.0) * 0.5 * 31.0, (y / w + 1.0) * 0.5 * 25.0];
        assert!((pixel[0] - 11.5).abs() < 1e-9 && (pixel[1] - 7.5).abs() < 1e-9, "{}: {pixel:?}", method.name);
        assert_eq!(slices.numbers().len(), slices.numbers_in_all() as usize);
        assert_eq!(slices.numbers_in(0), 0..slices.numbers_in_all(), "all in one pass");
    }
    let (plan, _) = drawn(&scene(|_| {}), method::SLICES_SHELLS.name());
    assert_eq!(CutPlanes::new(&scene(|_| {}), plan.view.slices.as_ref().unwrap()), None);
}

#[test]
fn spheres_are_not_cut_by_the_vertex_shader() {
    let scene = scene(|s| s.method.slice_cut = SliceCut::Device);
    for row in slicers() {
        let refused = (row.takes)(&{
            let mut scene = scene.clone();
            scene.settings.method.name = row.name();
            scene
        });
        assert_eq!(refused.is_err(), row.stack() == Some(Stack::Shells), "{}", row.name);
    }
}

/// Pixels that the polygons of a slice have to reach beyond what shows: rasterisers move corners to a raster of 1/16 pixel or a finer one.
const RASTER: f64 = 1.0 / 16.0;

/// Whether some triangle of a slice covers a place of the picture, in pixels.
fn covered(polygons: &SlicePolygons, slice: u32, size: [u32; 2], at: [f64; 2]) -> bool {
    let place = |[x, y, w, _]: [f32; 4]| {
        let on = |c: f32, axis: usize| (f64::from(c / w) + 1.0) * 0.5 * f64::from(size[axis]) - at[axis];
        [on(x, 0), on(y, 1)]
    };
    polygons.corners.chunks_exact(3).filter(|corners| corners[0][3] == slice as f32).any(|corners| {
        let corners: Vec<[f64; 2]> = corners.iter().copied().map(place).collect();
        let turn = |i: usize| {
            let ([ax, ay], [bx, by]) = (corners[i], corners[(i + 1) % 3]);
            ax * by - ay * bx
        };
        let turns = [turn(0), turn(1), turn(2)];
        turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0)
    })
}

/// The places of a slice that a view shows and its polygons do not cover with the raster's margin, and how many it shows.
fn uncovered(scene: &Scene, slices: &Slices, polygons: &SlicePolygons) -> (Vec<String>, usize) {
    let (size, rays) = (scene.settings.image.size, scene.camera.rays(scene.settings.image.size).unwrap());
    let (mut missed, mut shown) = (Vec::new(), 0);
    let pixels = (0..size[0]).flat_map(|column| (0..size[1]).map(move |row| [column, row]));
    for ([column, row], slice) in pixels.flat_map(|pixel| (0..slices.count).map(move |slice| (pixel, slice))) {
        let ray = rays.of(column, row);
        let depth = slices.depth(&ray, slice);
        if depth.is_nan() || depth < rays.near || within(scene, ray.at(depth), 0.0) < 0.0 {
            continue;
        }
        shown += 1;
        let beside = [[0.0, 0.0], [RASTER, 0.0], [-RASTER, 0.0], [0.0, RASTER], [0.0, -RASTER]];
        let at = |by: [f64; 2]| [f64::from(column) + 0.5 + by[0], f64::from(row) + 0.5 + by[1]];
        if !beside.into_iter().all(|by| covered(polygons, slice, size, at(by))) {
            missed.push(format!("slice {slice} at pixel {column}, {row}"));
        }
    }
    (missed, shown)
}

#[test]
fn polygons_cover_all_that_shows_of_slices_whatever_the_near_plane_cuts() {
    // From outside, and from within, where slices go through the near plane.
    for (eye, target) in [([0.9, 0.6, 1.5], [0.0; 3]), ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4])] {
        for (method, height) in slicers().flat_map(|method| [(method, None), (method, Some(1.3))]) {
            let mut scene = scene(|s| (s.camera.eye, s.camera.target, s.camera.height) = (eye, target, height));
            scene.settings.method.name = method.name();
            let view = plan(&scene, method.papers).unwrap().view;
            let (missed, shown) = uncovered(&scene, view.slices.as_ref().unwrap(), view.slice_polygons(&scene));
            assert!(missed.is_empty() && shown > 1000, "{} from {eye:?}, {height:?}: {shown}, {missed:?}", method.name);
        }
    }
}
