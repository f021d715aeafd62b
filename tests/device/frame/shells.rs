//! Shells: pictures and counts are those of the twin, in both orders, and the pictures of both orders are the same.

use std::sync::Arc;

use depthleap::method::SHELLS;
use depthleap::scene::Scene;
use depthleap::scene::settings::{Filter, MeshSettings, Settings, ShellMode, ShellOrder, ShellSum};
use depthleap::vulkan::Device;

use super::compare::{counts, held, same_picture};
use super::scenes::{Stage, scene};
use crate::harness::{Test, test};

type Change = fn(&mut Settings);

const SCENES: [(&str, &str, Change); 9] = [
    ("greatest", "shells:24x20x16", |s| s.shells.mode = Some(ShellMode::Max)),
    ("greatest_by_depth", "jets:24", |s| {
        (s.shells.mode, s.shells.count) = (Some(ShellMode::Max), 7);
        (s.shells.beta0, s.shells.a, s.shells.b) = (0.1, 0.6, 0.2);
    }),
    ("greatest_from_within", "shells:20", |s| {
        (s.shells.mode, s.shells.a) = (Some(ShellMode::Max), 0.3);
        (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4]);
    }),
    ("greatest_with_surfaces", "jets:20x24x28", |s| {
        (s.shells.mode, s.shells.a, s.shells.b) = (Some(ShellMode::Max), 0.7, 0.3);
        s.meshes = vec![tool([0.6, 0.5, 0.4])];
    }),
    ("ways", "shells:22x18x20", |s| s.shells.mode = Some(ShellMode::Sum)),
    ("ways_by_depth_side_by_side", "jets:24", |s| {
        (s.shells.mode, s.camera.height) = (Some(ShellMode::Sum), Some(1.2));
        (s.shells.beta0, s.shells.a, s.shells.b) = (0.0, 1.0, 0.5);
    }),
    ("ways_from_within", "gaussian:20", |s| {
        (s.shells.mode, s.shells.a) = (Some(ShellMode::Sum), 0.3);
        (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4]);
    }),
    ("ways_with_surfaces", "jets:20x24x28", |s| {
        (s.shells.mode, s.shells.a, s.shells.b) = (Some(ShellMode::Sum), 0.7, 0.3);
        s.meshes = vec![tool([0.6, 0.5, 0.4])];
    }),
    ("crossings_with_surfaces", "shells:24", |s| {
        (s.shells.mode, s.shells.sum, s.shells.count) = (Some(ShellMode::Sum), ShellSum::Crossings, 5);
        s.meshes = vec![tool([0.2, 0.1, 0.1])];
    }),
];

/// A tool that crosses all shells.
fn tool(color: [f64; 3]) -> MeshSettings {
    MeshSettings {
        builtin: Some("arrow".to_owned()),
        color,
        scale: 1.2,
        rotate: [20.0, 40.0, 10.0],
        ..MeshSettings::default()
    }
}

/// The most pixels of a picture that a rasteriser may leave open: outlines of many shells go through it.
const UNDECIDED: usize = 400;

pub fn tests() -> Vec<Test> {
    let one = |(name, volume, change): (&'static str, &'static str, Change)| {
        test(&format!("shells::{name}"), move |device| both_orders(device, &shown(volume, change)))
    };
    SCENES.into_iter().map(one).collect()
}

fn shown(volume: &str, change: Change) -> Scene {
    scene(volume, "linear", |s| {
        s.method.name = SHELLS.name();
        s.sampling.filter = Filter::Exact;
        s.image.size = [63, 51];
        change(s);
    })
}

fn both_orders(device: &Arc<Device>, scene: &Scene) {
    let mut stage = Stage::new(device);
    let mut before: Option<Vec<[f32; 4]>> = None;
    let max = scene.settings.shells.mode == Some(ShellMode::Max);
    // Behind surfaces the dimmest comes first, and a sum rounds as its order is.
    let orders = match max && scene.polygons.is_empty() {
        true => &[ShellOrder::Brightest, ShellOrder::Dimmest][..],
        false => &[ShellOrder::Auto],
    };
    for order in orders {
        let mut scene = scene.clone();
        scene.settings.shells.order = *order;
        let shot = stage.shoot(&scene, None);
        let twin = stage.twin(&scene, None);
        let undecided = twin.undecided.iter().filter(|undecided| **undecided).count();
        let shows = shot.picture.iter().filter(|pixel| pixel[0] > 0.01).count();
        let largest = held(&shot, &twin, 0.0).unwrap_or_else(|what| panic!("{order:?}: {what}"));
        let stated = twin.rounding.iter().copied().fold(0.0, f64::max);
        println!(
            "{order:?}: {shows} pixels show, {undecided} undecided, {:?} fragments, {largest:.1e} beyond at most {stated:.1e}",
            counts(&shot).main.iter().sum::<u64>()
        );
        assert!(shows > 400 && undecided < UNDECIDED.min(shows / 2), "{shows} pixels show, {undecided} are undecided");
        if let Some(before) = &before {
            same_picture(&shot.picture, before).unwrap_or_else(|what| panic!("{order:?}: {what}"));
        }
        before = Some(shot.picture);
    }
}
