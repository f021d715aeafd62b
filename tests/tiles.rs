//! Tiles behind which nothing shows are left out, and no others. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;
#[path = "random/mod.rs"]
mod random;

use std::sync::Arc;

use depthleap::feature::tiles;
use depthleap::frame::CpuFrame;
use depthleap::method::{self, METHODS, NN_OMNI, NN_OPTIMAL_FUSED, RC_BLOCK, SINGLE_PASS_BLOCK, SINGLE_PASS_OMNI};
use depthleap::part::Group;
use depthleap::part::rows::Method;
use depthleap::plan::{check, plan};
use depthleap::read;
use depthleap::scene::along_rays::AlongRays;
use depthleap::scene::settings::{ClipSettings, MeshSettings, Settings, Tiles};
use depthleap::scene::tiles::{InPasses, Tiles as ViewTiles};
use depthleap::scene::view::View;
use depthleap::scene::{Region, Scene};
use depthleap::structure::content;
use drawn::drawn;
use random::Random;

/// Pixels along the sides of a picture: no multiples of those of a tile.
const SIZE: [u32; 2] = [75, 61];

fn scene(volume: &str, tf: &str, change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some(volume.to_owned());
    settings.transfer.preset = Some(tf.to_owned());
    settings.image.size = SIZE;
    settings.camera.eye = [0.9, 0.65, 1.3];
    settings.method.name = SINGLE_PASS_OMNI.name();
    change(&mut settings);
    read::scene(&settings).unwrap()
}

fn live(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.settings.method.tiles = Tiles::Live;
    scene
}

fn pixels() -> impl Iterator<Item = [u32; 2]> {
    (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row]))
}

fn in_tiles(scene: &Scene) -> View {
    plan(&live(scene), method::papers_form(scene.settings.method.name)).unwrap().view
}

/// Live tiles of a view by itself, in one main pass or in none.
fn live_tiles(scene: &Scene, draw: Option<u64>) -> Arc<ViewTiles> {
    let view = View::new(scene).unwrap();
    let of_draw =
        |draw| InPasses { along: AlongRays::new(scene, &view.rays), step: 1.0, samples: 1 << 20, passes: 1, draw };
    let passes = draw.map(of_draw);
    view.in_tiles(content::boxes(scene, true).into_iter(), passes.as_ref()).tiles.expect("tiles were asked for")
}

const DRAWN_BY: [&Method; 5] = [&SINGLE_PASS_OMNI, &NN_OMNI, &SINGLE_PASS_BLOCK, &RC_BLOCK, &NN_OPTIMAL_FUSED];

#[test]
fn pictures_are_those_of_all_tiles_from_all_sides() {
    let mut random = Random(7);
    let mut saved = [0; 2];
    for round in 0..40 {
        let volume = ["blocks:40", "shells:24", "jets:20x24x28", "gaussian:9x40x33"][round % 4];
        let eye: [f64; 3] = std::array::from_fn(|_| 4.0 * random.next() - 2.0);
        let scene = scene(volume, if round % 3 == 0 { "surface" } else { "linear" }, |s| {
            s.camera.eye = eye;
            s.camera.height = (round % 5 == 0).then_some(1.5);
            s.method.name = DRAWN_BY[round % DRAWN_BY.len()].name();
            s.sampling.samples_per_pass = [8, 1, 3, 16][round / 4 % 4];
            s.sampling.step = [1.0, 0.4][round / 2 % 2];
            s.clips = if round % 7 == 0 {
                vec![ClipSettings { plane: Some([0.3, 1.0, 0.2, 0.1]), ..ClipSettings::default() }]
            } else {
                Vec::new()
            };
        });
        let ((_, all), (_, some)) = (drawn(&scene), drawn(&live(&scene)));
        assert_eq!(all.pixels, some.pixels, "{volume} from {eye:?}");
        let [all, some] =
            [&all, &some].map(|CpuFrame { counts, .. }| counts.main.iter().chain(&counts.intermediate).sum::<u64>());
        assert!(some <= all, "{volume} from {eye:?}: {some} of {all} fragments");
        saved[usize::from(round % 3 == 0)] += usize::from(some < all);
    }
    assert!(saved[0] >= 5 && saved[1] >= 5, "tiles are left out in {saved:?} pictures");
}

#[test]
fn rectangles_cover_each_pixel_of_live_tiles_once() {
    let view = in_tiles(&scene("blocks:40", "surface", |s| s.camera.target = [-0.4, 0.0, 0.0]));
    let tiles = view.tiles.as_ref().expect("tiles were asked for");
    assert!(view.region.x > 0 && tiles.live().len() > 1, "{:?}", view.region);
    for [column, row] in pixels() {
        let covers = |part: &&Region| {
            let [x, y] = [part.x + view.region.x, part.y + view.region.y];
            Region { x, y, ..**part }.contains([column, row])
        };
        let count = tiles.live().iter().filter(covers).count();
        assert_eq!(count, usize::from(tiles.contains([column, row])), "pixel {column}, {row}");
    }
}

/// Rectangles and pixels of live tiles, where a draw takes as long as so many pixels.
fn drawn_in(scene: &Scene, draw: Option<u64>) -> (usize, u64) {
    let tiles = live_tiles(scene, draw);
    (tiles.live().len(), tiles.live().iter().map(|part| part.pixels()).sum())
}

#[test]
fn fewer_rectangles_are_drawn_the_dearer_a_draw_is() {
    let mut random = Random(11);
    for round in 0..20 {
        let eye: [f64; 3] = std::array::from_fn(|_| 3.0 * random.next() - 1.5);
        let scene = scene(["blocks:40", "jets:32"][round % 2], "surface", |s| s.camera.eye = eye);
        let exact = drawn_in(&scene, None);
        let costs = [0, 64, 512, 4096, u64::from(u32::MAX)];
        let found = costs.map(|draw| drawn_in(&scene, Some(draw)));
        assert!(found[0].1 >= exact.1, "live tiles are drawn: {found:?}, {exact:?}");
        assert!(found.is_sorted_by(|a, b| a.0 >= b.0 && a.1 <= b.1), "from {eye:?}: {found:?}");
        assert!(found[4].0 <= 1, "from {eye:?}: {found:?}");
        // No other bands take less time than those for a cost.
        for (draw, (count, pixels)) in costs.into_iter().zip(found).take(4) {
            let others = found.into_iter().map(|(count, pixels)| count as u64 * draw + pixels);
            // Rectangles end with the region, and bands are weighed by whole tiles.
            let rim = u64::from(8 * (SIZE[0] + SIZE[1]) + 64);
            assert!(others.min().is_none_or(|least| count as u64 * draw + pixels <= least + rim), "{draw}: {found:?}");
        }
    }
}

#[test]
fn tiles_of_bands_hold_all_live_ones() {
    let scene = scene("jets:32", "surface", |_| {});
    let (exact, bands) = (live_tiles(&scene, None), live_tiles(&scene, Some(512)));
    assert!(pixels().all(|pixel| bands.contains(pixel) || !exact.contains(pixel)));
    for [column, row] in pixels() {
        let region = View::new(&scene).unwrap().region;
        let covers =
            |part: &&Region| Region { x: part.x + region.x, y: part.y + region.y, ..**part }.contains([column, row]);
        assert_eq!(bands.live().iter().filter(covers).count(), usize::from(bands.contains([column, row])));
    }
}

#[test]
fn passes_draw_live_tiles_alone_and_count_those_to_come() {
    for (volume, samples) in [("jets:40", 4), ("blocks:40", 1), ("shells:24", 16)] {
        let scene = scene(volume, "surface", |s| {
            (s.method.name, s.sampling.samples_per_pass) = (NN_OMNI.name(), samples);
        });
        let plan = plan(&live(&scene), method::papers_form(NN_OMNI.name())).unwrap();
        let tiles = plan.view.tiles.as_ref().expect("tiles were asked for");
        let covering = |parts: &[Region], pixel: [u32; 2]| parts.iter().filter(|part| part.contains(pixel)).count();
        let mut drawn = 0;
        for pixel in pixels()
            .filter(|[column, row]| plan.view.region.contains([column + plan.view.region.x, row + plan.view.region.y]))
        {
            let here: Vec<usize> = (0..plan.passes).map(|pass| covering(tiles.live_in(pass), pixel)).collect();
            let rest: Vec<usize> = (0..plan.passes).map(|pass| covering(tiles.live_from(pass), pixel)).collect();
            let any_from = |pass: usize| usize::from(here[pass..].contains(&1));
            assert!(here.iter().all(|count| *count <= covering(tiles.live(), pixel)), "{volume}, {pixel:?}: {here:?}");
            assert_eq!(rest, (0..rest.len()).map(any_from).collect::<Vec<_>>(), "{volume}, {pixel:?}");
            drawn += here.iter().sum::<usize>();
        }
        let all = plan.view.region.pixels() as usize * plan.passes as usize;
        assert!(drawn > 0 && 2 * drawn < all, "{volume}: {drawn} of {all} pixels in all passes");
    }
}

/// A pass in which nothing may show is none of the frame's.
#[test]
fn passes_without_live_tiles_are_left_out() {
    let scene = live(&scene("gaussian:40", "surface", |s| {
        (s.method.name, s.camera.eye, s.sampling.samples_per_pass) = (NN_OMNI.name(), [0.0, 0.0, 3.0], 2);
    }));
    let mains = |scene: &Scene| {
        let plan = plan(scene, method::papers_form(NN_OMNI.name())).unwrap();
        let list = plan.frame().iter().filter(|step| step.group == Group::Main).map(|step| step.pass);
        (list.collect::<Vec<_>>(), plan.passes)
    };
    let (list, passes) = mains(&scene);
    assert!(!list.is_empty() && list.len() < passes as usize && list[0] > 0, "{list:?} of {passes}");
    let lines = plan(&scene, method::papers_form(NN_OMNI.name())).unwrap().lines().join("\n");
    let others = format!("  - {} of the main passes left out", passes as usize - list.len());
    assert!(lines.contains(&others) && lines.contains(" pixels, rectangles: 1]"), "{lines}");
    let mut whole = scene;
    whole.settings.method.planner = false;
    assert_eq!(mains(&whole).0.len(), mains(&whole).1 as usize, "without the planner nothing is left out");
}

/// Whichever main pass is the first that draws, what rays gather is written before it is read.
#[test]
fn what_rays_gather_is_written_first() {
    for method in [&RC_BLOCK, &NN_OMNI, &NN_OPTIMAL_FUSED] {
        for (samples, depth) in [(2, 3.0), (64, 3.0), (1, 9.0)] {
            let scene = live(&scene("gaussian:40", "surface", |s| {
                (s.method.name, s.camera.eye) = (method.name(), [0.0, 0.0, depth]);
                s.sampling.samples_per_pass = samples;
            }));
            let lines = plan(&scene, method::papers_form(method.name())).unwrap().lines();
            let first = lines.iter().find(|line| line.contains("accumulated")).expect("rays gather something");
            let (reads, writes) = first.split_once("->").expect("a step writes something");
            let written_first = !reads.contains("accumulated") && writes.contains("accumulated");
            assert!(written_first, "{}, M = {samples}: {first}", method.name());
        }
    }
}

/// A box beside the picture has no pixels, and no tiles.
#[test]
fn views_beside_the_volume_have_no_tiles() {
    for height in [None, Some(0.5)] {
        let scene = scene("shells:16", "ramp", |s| {
            (s.camera.eye, s.camera.target, s.camera.height) = ([0.0, 0.0, 3.0], [40.0, 0.0, 3.0], height);
        });
        let plan = plan(&live(&scene), None).unwrap();
        assert!(plan.frame().is_empty() && plan.view.tiles.is_some_and(|tiles| tiles.live().is_empty()));
    }
}

#[test]
fn a_volume_that_shows_nothing_has_no_live_tiles() {
    let scene =
        live(&scene("constant:8", "ramp", |s| s.volume.range = Some(["1".parse().unwrap(), "2".parse().unwrap()])));
    let (plan, frame) = drawn(&scene);
    assert!(plan.view.tiles.is_none_or(|tiles| tiles.live().is_empty()));
    assert_eq!(frame.counts.main.iter().sum::<u64>(), 0);
}

#[test]
fn an_eye_among_what_shows_has_all_tiles() {
    let view = in_tiles(&scene("constant:8", "haze", |s| s.camera.eye = [0.1, 0.0, 0.1]));
    let tiles = view.tiles.as_ref().expect("tiles were asked for");
    assert!((0..SIZE[0]).all(|column| tiles.contains([column, 30])));
}

#[test]
fn scenes_whose_other_tiles_show_something_are_refused() {
    let asked = |change: fn(&mut Settings)| check(&live(&scene("shells:16", "ramp", change)));
    assert!(asked(|_| {}).is_ok());
    let refused = |change: fn(&mut Settings), part: &str| {
        let error = asked(change).unwrap_err().to_string();
        assert!(error.contains("--tiles live") && error.contains(part), "{error}");
    };
    refused(|s| s.projection.kind = "mip".parse().unwrap(), "--projection mip");
    refused(
        |s| s.meshes = vec![MeshSettings { builtin: Some("box".to_owned()), ..MeshSettings::default() }],
        "meshes show",
    );
}

/// A setting of a scene serves all its methods: those that know nothing of what lies ahead, and compute shaders, draw all.
#[test]
fn other_methods_draw_all() {
    for method in METHODS.into_iter().filter(|method| method.takes_samples() && !tiles::are_left_out_by(method)) {
        let mut scene = live(&scene("shells:16", "ramp", |_| {}));
        scene.settings.method.name = method.name();
        let plan = plan(&scene, depthleap::method::papers_form(method.name())).unwrap();
        assert!(plan.view.tiles.is_none(), "{}", method.name);
    }
}
