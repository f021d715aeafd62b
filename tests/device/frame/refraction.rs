//! Rays that bend on a device: where the index does not change they are the straight ones to the bit, and what is behind a
//! transparent volume has no seam. By fragment and compute shaders, with leaps and without.

use std::sync::Arc;

use depthleap::method::METHODS;
use depthleap::part::rows::Method;
use depthleap::scene::backdrop::GREYS;
use depthleap::scene::settings::{Refraction, Settings};
use depthleap::vulkan::Device;

use super::compare::same_picture;
use super::scenes::{Stage, VIEWS, by, exactly, scene, seen};
use crate::harness::{Test, share, test};

pub fn tests() -> Vec<Test> {
    vec![
        test("refraction::constant_index_is_the_straight_ray_to_the_bit", constant),
        test("refraction::leaps_change_no_bit", leaps),
        test("refraction::checker_behind_a_transparent_volume_has_no_seam", seamless),
    ]
}

fn loops() -> impl Iterator<Item = &'static Method> {
    METHODS.into_iter().filter(|method| method.loops() && !method.goes_through_cells())
}

fn bending(settings: &mut Settings, points: &[[f64; 2]]) {
    settings.effects.refraction = Some(Refraction { points: points.to_vec() });
}

fn constant(device: &Arc<Device>) {
    let of = |index: Option<f64>| {
        let scene = scene("shells:20", "ramp", |s| {
            exactly(s);
            (s.image.size, s.method.planner) = ([40, 30], false);
            index.into_iter().for_each(|index| bending(s, &[[0.0, index], [1.0, index]]));
        });
        seen(&scene, VIEWS[2])
    };
    let straight = of(None);
    let mut stage = Stage::new(device);
    for index in [1.0, 1.7] {
        let with = of(Some(index));
        for method in share(loops(), index as usize) {
            let rule = stage.shoot(&by(&straight, method.name()), None).picture;
            let found = stage.shoot(&by(&with, method.name()), None).picture;
            assert!(rule.iter().any(|pixel| pixel[3] > 0.1), "{}: nothing shows", method.name);
            same_picture(&found, &rule).unwrap_or_else(|e| panic!("{}, index {index}: {e}", method.name));
        }
    }
}

/// Larger than the scenes of the matrix, so that there is room to leap in.
fn leaps(device: &Arc<Device>) {
    let scene = scene("blocks:40", "ramp", |s| {
        exactly(s);
        (s.image.size, s.effects.behind) = ([50, 40], Some("checker".into()));
        bending(s, &[[0.3, 1.0], [0.9, 1.3]]);
    });
    let mut stage = Stage::new(device);
    for (i, view) in VIEWS.into_iter().enumerate() {
        let scene = seen(&scene, view);
        for method in share(loops().filter(|method| method.looks_ahead()), i) {
            let rule = stage.shoot(&by(&scene, method.unskipped().name()), None).picture;
            let found = stage.shoot(&by(&scene, method.name()), None).picture;
            same_picture(&found, &rule).unwrap_or_else(|e| panic!("{}, view {i}: {e}", method.name));
        }
    }
}

fn seamless(device: &Arc<Device>) {
    let [width, height] = [40, 30];
    let scene = scene("shells:20", "ramp", |s| {
        exactly(s);
        (s.image.size, s.effects.behind) = ([width, height], Some("checker".into()));
        s.transfer.preset = None;
        s.transfer.points = Some(vec![[0.0, 1.0, 1.0, 1.0, 0.0]]);
    });
    let squares = scene.settings.effects.background_squares;
    let grey = |i: u32| {
        let square = |at: u32| ((f64::from(at) + 0.5) * squares / f64::from(height)).floor() as i64;
        GREYS[(square(i % width) + square(i / width)).rem_euclid(2) as usize] as f32
    };
    let greys: Vec<[f32; 4]> = (0..width * height).map(grey).map(|grey| [grey, grey, grey, 1.0]).collect();
    let mut stage = Stage::new(device);
    for view in VIEWS {
        for method in loops() {
            let shot = stage.shoot(&by(&seen(&scene, view), method.name()), None);
            same_picture(&shot.picture, &greys).unwrap_or_else(|e| panic!("{}: {e}", method.name));
        }
    }
}
