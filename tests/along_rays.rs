//! Lengths along rays between which a box lies are bounds, and no wide ones. Needs no device.

#[path = "random/mod.rs"]
mod random;

use depthleap::read;
use depthleap::scene::Scene;
use depthleap::scene::along_rays::AlongRays;
use depthleap::scene::settings::{ClipSettings, Settings};
use depthleap::scene::view::View;
use glam::DVec3;
use random::Random;

fn seen_from(eye: [f64; 3], round: usize) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("constant:20x33x27".to_owned());
    settings.image.size = [64, 48];
    settings.camera.eye = eye;
    settings.camera.height = round.is_multiple_of(3).then_some(1.2);
    if round.is_multiple_of(4) {
        settings.clips = vec![ClipSettings { plane: Some([0.4, -1.0, 0.3, 0.1]), ..ClipSettings::default() }];
    }
    read::scene(&settings).unwrap()
}

#[test]
fn points_of_boxes_lie_between_them() {
    let mut random = Random(23);
    let (mut met, mut wide) = (0, 0.0);
    for round in 0..60 {
        let eye = std::array::from_fn(|_| 3.0 * random.next() - 1.5);
        let scene = seen_from(eye, round);
        let view = View::new(&scene).unwrap();
        let along = AlongRays::new(&scene, &view.rays);
        let half = 0.5 * scene.field.extent();
        for _ in 0..200 {
            let within =
                |random: &mut Random| DVec3::from_array(std::array::from_fn(|_| 2.0 * random.next() - 1.0)) * half;
            let least = within(&mut random);
            let greatest = (least + DVec3::splat(0.06)).min(half);
            let [from, to] = along.lengths([least, greatest]);
            for _ in 0..20 {
                let part = DVec3::from_array(std::array::from_fn(|_| random.next()));
                let point = least + part * (greatest - least);
                let place = view.rays.to_picture() * (point - view.rays.origin);
                let at = if view.rays.parallel() { [place.x, place.y] } else { [place.x / place.z, place.y / place.z] };
                let ray = view.rays.through(at[0], at[1]);
                let Some((enter, leave)) = scene.interval(&ray, view.rays.near) else { continue };
                if !(enter..=leave).contains(&place.z) {
                    continue;
                }
                let length = (place.z - enter) * ray.direction.length();
                assert!((from - 1e-9..=to + 1e-9).contains(&length), "{length} in {from}..{to}, from {eye:?}");
                met += 1;
                wide += to - from;
            }
        }
    }
    // The diagonal of a box is 0.104 long. Its height over a plane and the way from the eye to it are bounded apart.
    let mean = wide / f64::from(met);
    assert!(met > 50_000 && mean < 0.15, "{met} points, bounds {mean} apart on average");
}
