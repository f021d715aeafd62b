//! Tiles behind which nothing shows are left out, and no others. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;
#[path = "random/mod.rs"]
mod random;

use depthleap::feature::tiles;
use depthleap::method::{METHODS, SINGLE_PASS_BLOCK, SINGLE_PASS_OMNI};
use depthleap::plan::{check, plan};
use depthleap::read;
use depthleap::scene::settings::{ClipSettings, MeshSettings, Settings, Tiles};
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
    View::new(scene).unwrap().in_tiles(content::boxes(scene).into_iter())
}

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
            s.method.name = if round % 2 == 0 { SINGLE_PASS_OMNI.name() } else { SINGLE_PASS_BLOCK.name() };
            s.clips = if round % 7 == 0 {
                vec![ClipSettings { plane: Some([0.3, 1.0, 0.2, 0.1]), ..ClipSettings::default() }]
            } else {
                Vec::new()
            };
        });
        let ((_, all), (_, some)) = (drawn(&scene), drawn(&live(&scene)));
        assert_eq!(all.pixels, some.pixels, "{volume} from {eye:?}");
        let view = in_tiles(&scene);
        let tiles = view.tiles.as_ref().expect("tiles were asked for");
        let dead = pixels().filter(|pixel| !tiles.contains(*pixel)).count();
        let [all, some] = [&all, &some].map(|frame| frame.counts.main.iter().sum::<u64>());
        assert!(some <= all && all - some <= dead as u64, "{volume} from {eye:?}: {some} of {all} fragments");
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

/// A setting of a scene serves all its methods: those that know nothing of what lies ahead, or decide between passes, draw all.
#[test]
fn other_methods_draw_all() {
    for method in METHODS.into_iter().filter(|method| method.takes_samples() && !tiles::are_left_out_by(method)) {
        let mut scene = live(&scene("shells:16", "ramp", |_| {}));
        scene.settings.method.name = method.name();
        let plan = plan(&scene, depthleap::method::papers_form(method.name())).unwrap();
        assert!(plan.view.tiles.is_none(), "{}", method.name);
    }
}
