//! The scenes that `tests/device/frame/matrix.rs` has drawn by every method in every form: what a frame may have is there in
//! some of these frames and lacking in others; needs no device.

#[path = "matrix/scenes.rs"]
mod scenes;

use std::collections::BTreeSet;

use depthleap::feature::FEATURES;
use depthleap::feature::layers::first_section;
use depthleap::frame::{Structures, cpu};
use depthleap::method::{METHODS, RC};
use depthleap::part::rows::{Context, Feature, Method, Why};
use depthleap::plan::plan;
use depthleap::scene::Scene;

/// Whether some frames of the matrix have a feature, and whether some lack it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Seen {
    there: bool,
    lacking: bool,
}

fn seen(features: &[&Feature]) -> Vec<Seen> {
    let mut seen = vec![Seen::default(); features.len()];
    for (name, scene) in scenes::scenes() {
        for method in scenes::methods(&scene) {
            let scene = scenes::by(&scene, method);
            for form in scenes::forms(method) {
                let plan = plan(&scene, form).unwrap_or_else(|e| panic!("{name}, {}: {e}", method.name));
                let context = Context::new(&scene, &plan.view, method, form, plan.passes);
                for part in context.sections(first_section(&context)) {
                    for (seen, feature) in seen.iter_mut().zip(features) {
                        let there = part.has(feature);
                        *seen = Seen { there: seen.there || there, lacking: seen.lacking || !there };
                    }
                }
            }
        }
    }
    seen
}

#[test]
fn every_feature_is_there_in_some_frames_and_lacking_in_others() {
    for (feature, seen) in FEATURES.iter().zip(seen(&FEATURES)) {
        let name = feature.name;
        assert!(seen.there, "no frame of the matrix has: {name}; give it a scene in tests/matrix/scenes.rs");
        assert!(
            seen.lacking,
            "every frame of the matrix has: {name}; give it a scene without in tests/matrix/scenes.rs"
        );
    }
}

#[test]
fn a_feature_without_scenes_is_seen() {
    let never = Feature::of_frame("never there", |_| Err(Why::Untold));
    let always = Feature::of_frame("always there", |_| Ok(()));
    let expected = [Seen { there: false, lacking: true }, Seen { there: true, lacking: false }];
    assert_eq!(seen(&[&never, &always]), expected);
}

#[test]
fn every_method_draws_a_scene_and_every_scene_has_a_name_of_its_own() {
    let scenes = scenes::scenes();
    for method in METHODS {
        let drawn = scenes.iter().any(|(_, scene)| scenes::methods(scene).any(|one| one.name == method.name));
        assert!(drawn, "no scene of the matrix is drawn by {}", method.name);
    }
    let names: BTreeSet<&str> = scenes.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names.len(), scenes.len());
}

/// Frames of more passes show no more, and take some drivers minutes.
const MOST_PASSES: u32 = 16;

/// The same of cells, by a bound of how many a ray goes through.
const MOST_PASSES_OF_CELLS: u32 = 32;

/// The same of slices, which reach from the nearest corner of the volume to the farthest: that is longer than any ray.
const MOST_PASSES_OF_SLICES: u32 = 20;

#[test]
fn frames_are_small() {
    for (name, scene) in scenes::scenes() {
        for (view, scene) in scenes::views(&scene) {
            for method in scenes::methods(&scene) {
                let passes = plan(&scenes::by(&scene, method), method.papers).unwrap().passes;
                let most = match () {
                    () if method.stack().is_some() => MOST_PASSES_OF_SLICES,
                    () if method.goes_through_cells() => MOST_PASSES_OF_CELLS,
                    () => MOST_PASSES,
                };
                assert!((1..=most).contains(&passes), "{name}, {view}: {passes} passes");
            }
        }
    }
}

/// Main fragments of a frame, in f64.
fn main_fragments(scene: &Scene, method: &Method) -> u64 {
    let scene = scenes::by(scene, method);
    let plan = plan(&scene, method.papers).unwrap();
    let mut structures = Structures::default();
    structures.prepare(&scene, &plan);
    cpu::run(&scene, &plan, &structures, cpu::SUB_PIXEL_BITS).counts.main.iter().sum()
}

/// The method whose rays do not end, with the samples of one whose slices lie alike.
fn endless(method: &Method) -> &'static Method {
    let like = |one: &&Method| one.stack() == method.stack() && one.back_to_front();
    METHODS.into_iter().find(like).expect("a stack is drawn back to front as well")
}

/// The first scene has what the others lack one by one: rays that end, and empty space for all that looks ahead.
#[test]
fn the_first_scene_has_work_to_skip() {
    let (_, scene) = scenes::scenes().swap_remove(0);
    for (view, scene) in scenes::views(&scene) {
        let all = main_fragments(&scene, &RC);
        for method in scenes::methods(&scene) {
            let (rule, own) = (main_fragments(&scene, method.unskipped()), main_fragments(&scene, method));
            let said = format!("{}, {view}: {own} main fragments, {rule} without skipping, {all} in all", method.name);
            if method.loops() {
                // A fragment holds the whole ray.
                assert_eq!(own, rule, "{said}");
                continue;
            }
            // A fragment of a slice is a sample, not a segment of several.
            let all = if method.stack().is_some() { main_fragments(&scene, endless(method)) } else { all };
            assert!(method.ends_rays == (rule < all), "{said}");
            assert!(method.looks_ahead() == (own < rule), "{said}");
        }
    }
}
