//! Tiles behind which nothing shows are left out, and no others. Needs no device.

#[path = "drawn/mod.rs"]
mod drawn;
#[path = "random/mod.rs"]
mod random;

use depthleap::feature::tiles;
use depthleap::method::{METHODS, SINGLE_PASS_BLOCK, SINGLE_PASS_OMNI};
use depthleap::plan::{check, plan};
use depthleap::read;
use depthleap::scene::Scene;
use depthleap::scene::settings::{ClipSettings, MeshSettings, Settings, Tiles};
use depthleap::scene::view::View;
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

fn in_tiles(scene: &Scene) -> View {
    View::new(scene).unwrap().in_tiles(content::boxes(scene).into_iter())
}

#[test]
fn pictures_are_those_of_all_tiles_from_all_sides() {
    let mut random = Random(7);
    let mut saved = 0;
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
        let Some(tiles) = &view.tiles else {
            assert!(all.pixels.iter().all(|pixel| pixel[3] == 0.0), "{volume} from {eye:?} shows nothing");
            continue;
        };
        let pixels = (0..SIZE[1]).flat_map(|row| (0..SIZE[0]).map(move |column| [column, row]));
        let drawn = pixels.filter(|pixel| tiles.contains(*pixel)).count() as u64;
        assert_eq!(some.counts.main.iter().sum::<u64>(), drawn, "{volume} from {eye:?}");
        saved += usize::from(drawn < all.counts.main.iter().sum::<u64>());
    }
    assert!(saved >= 10, "tiles are left out in {saved} pictures");
}

/// Triangles as a rasteriser takes them: each centre of a live tile's pixels is in one of them, no other in any.
#[test]
fn triangles_cover_each_pixel_of_live_tiles_once() {
    let view = in_tiles(&scene("blocks:40", "surface", |_| {}));
    let tiles = view.tiles.as_ref().expect("something shows");
    let mut covered = vec![0; (SIZE[0] * SIZE[1]) as usize];
    for triangle in tiles.corners.chunks_exact(3) {
        let at = |corner: [f32; 3], axis: usize| 0.5 * (f64::from(corner[axis]) + 1.0) * f64::from(SIZE[axis]);
        let corners: Vec<[f64; 2]> = triangle.iter().map(|corner| [at(*corner, 0), at(*corner, 1)]).collect();
        for (i, count) in covered.iter_mut().enumerate() {
            // A little beside the centre, which diagonals pass through.
            let place = [(i as u32 % SIZE[0]) as f64 + 0.5 + 1e-3, (i as u32 / SIZE[0]) as f64 + 0.5];
            let side =
                |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]) * (place[1] - a[1]) - (b[1] - a[1]) * (place[0] - a[0]) > 0.0;
            let sides = [0, 1, 2].map(|k| side(corners[k], corners[(k + 1) % 3]));
            *count += u32::from(sides == [true; 3] || sides == [false; 3]);
        }
    }
    for (i, count) in covered.into_iter().enumerate() {
        let pixel = [i as u32 % SIZE[0], i as u32 / SIZE[0]];
        assert_eq!(count, u32::from(tiles.contains(pixel)), "pixel {pixel:?}");
    }
}

#[test]
fn an_eye_among_what_shows_has_all_tiles() {
    let view = in_tiles(&scene("constant:8", "haze", |s| s.camera.eye = [0.1, 0.0, 0.1]));
    let tiles = view.tiles.as_ref().expect("something shows");
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
