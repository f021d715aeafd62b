//! Shells: pictures and counts are those of the twin, in both orders, and the pictures of both orders are the same.

use std::sync::Arc;

use depthleap::method::SHELLS;
use depthleap::scene::Scene;
use depthleap::scene::settings::{
    Filter, GradientOperator, GradientTexture, Gradients, LightSettings, MeshSettings, Settings, ShellMode, ShellOrder,
    ShellSum,
};
use depthleap::vulkan::Device;

use super::compare::{SAME_SUM, counts, difference, same_picture};
use super::scenes::{Stage, scene};
use crate::harness::{Test, test};

type Change = fn(&mut Settings);

const SCENES: [(&str, &str, Change); 13] = [
    ("greatest", "gaussian:12x10x8", |s| s.shells.mode = Some(ShellMode::Max)),
    ("greatest_by_depth", "gaussian:10x11x9", |s| {
        s.shells.mode = Some(ShellMode::Max);
        (s.shells.beta0, s.shells.a, s.shells.b) = (0.1, 0.6, 0.2);
    }),
    ("greatest_from_within", "gaussian:9", |s| {
        (s.shells.mode, s.shells.a) = (Some(ShellMode::Max), 0.3);
        (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4]);
    }),
    ("greatest_with_surfaces", "gaussian:9x10x11", |s| {
        (s.shells.mode, s.shells.a, s.shells.b) = (Some(ShellMode::Max), 0.7, 0.3);
        s.meshes = vec![tool([0.6, 0.5, 0.4])];
    }),
    ("ways", "gaussian:11x9x10", |s| s.shells.mode = Some(ShellMode::Sum)),
    ("ways_by_depth_side_by_side", "gaussian:10x11x9", |s| {
        (s.shells.mode, s.camera.height) = (Some(ShellMode::Sum), Some(1.2));
        (s.shells.beta0, s.shells.a, s.shells.b) = (0.0, 1.0, 0.5);
    }),
    ("ways_from_within", "gaussian:9", |s| {
        (s.shells.mode, s.shells.a) = (Some(ShellMode::Sum), 0.3);
        (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4]);
    }),
    ("ways_with_surfaces", "gaussian:9x10x11", |s| {
        (s.shells.mode, s.shells.a, s.shells.b) = (Some(ShellMode::Sum), 0.7, 0.3);
        s.meshes = vec![tool([0.6, 0.5, 0.4])];
    }),
    ("outermost_in_light", "gaussian:12x10x8", |s| s.shells.mode = Some(ShellMode::Surface)),
    ("outermost_with_surfaces_side_by_side", "gaussian:9x10x11", |s| {
        (s.shells.mode, s.camera.height) = (Some(ShellMode::Surface), Some(1.2));
        s.meshes = vec![tool([0.6, 0.5, 0.4])];
    }),
    ("outermost_from_within", "gaussian:9", |s| {
        s.shells.mode = Some(ShellMode::Surface);
        (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4]);
    }),
    ("outermost_in_two_colours_by_gradients_in_a_texture", "gaussian:9", |s| {
        s.shells.mode = Some(ShellMode::Surface);
        (s.camera.eye, s.camera.target) = ([0.11, 0.07, -0.13], [-0.3, 0.2, 0.4]);
        let light = |direction, color| LightSettings { direction: Some(direction), color, ..LightSettings::default() };
        s.lights = vec![light([1.0, 0.4, 0.2], [0.9, 0.2, 0.1]), light([-0.3, 1.0, 0.5], [0.1, 0.3, 0.8])];
        (s.shading.gradients, s.shading.gradient) = (Gradients::Precomputed, GradientOperator::Sobel);
        s.shading.format = GradientTexture::Rgba32f;
        (s.environment.builtin, s.environment.reflectivity) = (Some("sky".to_owned()), 0.2);
    }),
    ("crossings_with_surfaces", "gaussian:10", |s| {
        (s.shells.mode, s.shells.sum) = (Some(ShellMode::Sum), ShellSum::Crossings);
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
const UNDECIDED: usize = 300;

/// The median of how far a rasteriser may move what a pixel shows, in the brightest one: that of a raster of 1/16 pixel.
const MEDIAN: f64 = 0.05;

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
        (s.image.size, s.shells.count) = ([63, 51], 3);
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
        let largest = difference(&shot.picture, &twin, SAME_SUM).unwrap_or_else(|what| panic!("{order:?}: {what}"));
        // An outline has two surfaces, one on each side of the shell.
        let may_differ = 2 * undecided as u64;
        for (pass, (found, rule)) in counts(&shot).main.iter().zip(&twin.counts.main).enumerate() {
            let near = found.abs_diff(*rule) <= may_differ;
            assert!(near, "{order:?}: pass {pass} has {found} fragments, its twin {rule}, {undecided} are undecided");
        }
        // Most pixels are held to what f32 takes from them: what a rasteriser may move is where polygons are seen from the side.
        let brightest = shot.picture.iter().map(|pixel| pixel[0]).fold(0.0, f32::max);
        let mut stated = twin.rounding.clone();
        stated.retain(|rounding| *rounding > 0.0);
        stated.sort_by(f64::total_cmp);
        let (median, stated) = (stated[stated.len() / 2], stated[stated.len() - 1]);
        assert!(median < MEDIAN * f64::from(brightest), "{median:e} of {brightest}");
        println!(
            "{order:?}: {shows} pixels show, {undecided} undecided, {:?} fragments, {largest:.1e} beyond at most {stated:.1e}, median {median:.1e} of {brightest}",
            counts(&shot).main.iter().sum::<u64>()
        );
        assert!(
            shows > 200 && undecided < UNDECIDED.min(shows * 2 / 3),
            "{shows} pixels show, {undecided} are undecided"
        );
        if let Some(before) = &before {
            same_picture(&shot.picture, before).unwrap_or_else(|what| panic!("{order:?}: {what}"));
        }
        before = Some(shot.picture);
    }
}
