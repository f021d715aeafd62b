//! The matrix: every method on every scene of `tests/matrix/scenes.rs`, in every form on one or another. Whatever is in its tables is in
//! it: nothing here names a method, a form or a feature.
//!
//! The forms of a method take turns, so that a scene has every third one and three scenes on end have all of them; so do stacks of
//! slices, and loops, whose shaders take most of the time. `DEPTHLEAP_ALL_FORMS` draws every scene in every form by every loop.
//!
//! Of each frame: it runs without a message of the validation layer (the harness sees to that); it is its f64 twin's;
//! methods that end rays have one picture to the bit, those that end none have another; the fragments of a method are the
//! same in every form, and all of it in every format of the depth buffer.

use std::collections::BTreeMap;
use std::sync::Arc;

use depthleap::part::form::Form;
use depthleap::part::rows::Method;
use depthleap::projection::{self, Ends};
use depthleap::resource;
use depthleap::scene::Scene;
use depthleap::scene::settings::{DepthFormat, Filter, Formats};
use depthleap::scene::slices::Stack;
use depthleap::vulkan::{Device, vk};

use super::compare::{SAME_SUM, counts, difference, held, same_counts, same_picture};
use super::matrix_scenes;
use super::scenes::{Shot, Stage, checked, forms, forms_in_turn, in_turn, right_forms};
use crate::harness::{Need, Test, all_forms, beside, least, share, some_forms, test};

/// Formats of the depth buffer, in which sections are the same. The first is that of every scene.
const DEPTHS: [DepthFormat; 3] = [DepthFormat::D32, DepthFormat::D24, DepthFormat::D16];

/// Scenes that are drawn in every form on every driver, and in every format of the depth buffer: the only ones whose marks differ
/// from each other, by their number, by what they say and by who writes them anew.
const IN_EVERY_FORMAT: [&str; 5] = [
    "as it is",
    "many passes",
    "more passes than samples",
    "segments that end at a surface, drawn apart",
    "what is outside of boxes that the eye is in",
];

/// Pixels of a frame that f32 may leave undecided: with so few of them, that counts may be off by one for each hides nothing.
const UNDECIDED: u64 = 4;

/// The same where rays end at a value: the background is next to the least of them, and many rays pass near it.
const UNDECIDED_AT_AN_EXTREME: u64 = 64;

/// The same of shells, where two of them, or a shell and a surface, may be at one depth: what the outermost one in light leaves beside a box, the
/// most of all scenes.
const UNDECIDED_OF_SHELLS: u64 = 49;

/// The same of slices at textures by methods that look ahead: all of them lie in faces between cells, and rounding decides which of the two
/// is asked what can be skipped. Their pictures are held against the rule's to the bit, whose twin leaves no more undecided than others.
const UNDECIDED_IN_FACES: u64 = 204;

/// Pixels on the outline of the box that the rasteriser may leave undecided: none from within, from outside some fifteen on
/// a raster of 1/16 pixel.
const OUTLINE: u64 = 24;

/// The same with polygons, each of whose edges is an outline.
const OUTLINE_OF_POLYGONS: u64 = 96;

/// The same with shells, each of which has outlines through the picture; what they leave is held by tests of their own as well.
const OUTLINE_OF_SHELLS: u64 = 600;

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    let scenes = matrix_scenes::scenes();
    let named = |name: &&str| scenes.iter().any(|(one, _)| one == name);
    assert!(IN_EVERY_FORMAT.iter().all(named), "scenes have other names");
    for (number, (name, scene)) in scenes.into_iter().enumerate() {
        let depths = if IN_EVERY_FORMAT.contains(&name.as_str()) { &DEPTHS[..] } else { &DEPTHS[..1] };
        let whole = depths.len() > 1;
        let one = test(&format!("matrix::{name}"), move |device| every_method(device, &scene, depths, number));
        // Where other drivers do more of everything, two scenes on end, of different sides and methods, and not the next two.
        tests.push(if whole || number % 4 < 2 { one } else { one.needs(Need::Thoroughness) });
    }
    tests.push(test("matrix::would_see_a_changed_pixel_and_a_changed_count", changes_are_seen));
    tests
}

/// Every method on a scene, from outside and from within; beside other drivers, a fourth of the methods or fewer, from one of these sides,
/// and others, or from the other side, on another driver.
fn every_method(device: &Arc<Device>, scene: &Scene, depths: &[DepthFormat], number: usize) {
    let mut runs = Runs { device, stage: Stage::new(device), frames: 0, largest: 0.0, undecided: 0 };
    let mut scene = scene.clone();
    scene.unit = checked(device).unit;
    // The scenes of a driver that leaves two of four out, counted without these.
    let number = if least() { number / 4 * 2 + number % 4 } else { number };
    for (i, (view, scene)) in matrix_scenes::views(&scene).into_iter().enumerate() {
        if left_out(i, number, depths) {
            continue;
        }
        // What a format of the depth buffer may get wrong, it gets wrong in any view.
        let depths = if i == 0 { there(device, &scene, depths) } else { vec![scene.settings.method.depth] };
        // What has to come out, by the method with the same samples that skips nothing.
        let mut rules = BTreeMap::new();
        let methods = matrix_scenes::methods(&scene);
        let every = all_forms() || depths.len() > 1;
        let whole = |method: &Method| every && (all_forms() || method.stack().is_none());
        let here = |method: &&Method| whole(method) || in_turn(method, number + i);
        for (turn, method) in share(methods.filter(here), number).into_iter().enumerate() {
            let rule: &Shot = rules.entry(method.unskipped().name).or_insert_with(|| runs.rule(&scene, method));
            assert!(rule.picture.iter().any(|pixel| pixel[3] > 0.0), "{view}: nothing shows");
            let forms = forms_from(i, device, &matrix_scenes::by(&scene, method), number + turn, every);
            let held = runs.in_forms(&scene, method, forms, &depths, rule);
            held.unwrap_or_else(|what| panic!("{}, {view}: {what}", method.name));
        }
    }
    let Runs { frames, largest, undecided, .. } = runs;
    println!("{frames} frames, largest difference to a twin {largest:.1e}, at most {undecided} pixels undecided");
}

/// Whether other drivers draw this view of a scene, which this one has another view of. What a format of the depth buffer may get
/// wrong, it gets wrong in the first.
fn left_out(view: usize, number: usize, depths: &[DepthFormat]) -> bool {
    match depths.len() {
        1 if some_forms() || beside() => {
            let others = least() || beside();
            !(view + number + usize::from(others)).is_multiple_of(2)
        }
        1 => false,
        _ => least() && view > 0,
    }
}

/// The forms that a scene by a method is drawn in: from within in one of them by `turn`; from outside in `every` one, else in every third
/// one, which one first by `turn`, or in a single one where other drivers have more of them.
fn forms_from(view: usize, device: &Arc<Device>, scene: &Scene, turn: usize, every: bool) -> Vec<Option<Form>> {
    let forms = match every {
        true => right_forms(device, scene.settings.method.name),
        false => forms_in_turn(device, scene, turn),
    };
    if view == 0 { forms } else { vec![forms[turn % forms.len()]] }
}

struct Runs<'a> {
    device: &'a Arc<Device>,
    stage: Stage,
    frames: usize,
    /// The largest difference of a picture to its twin.
    largest: f64,
    /// The most pixels that a twin left undecided, apart from those on the outline.
    undecided: u64,
}

impl Runs<'_> {
    /// The frame without skipping whose picture the method's has to be.
    fn rule(&mut self, scene: &Scene, method: &'static Method) -> Shot {
        let rule = method.unskipped();
        // The last form of each method is the one every device has.
        let form = forms(self.device, rule.name()).pop().flatten();
        self.stage.shoot(&matrix_scenes::by(scene, rule), form)
    }

    /// A method in these forms, held against its twin, the rule and its first form.
    fn in_forms(
        &mut self,
        scene: &Scene,
        method: &Method,
        forms: Vec<Option<Form>>,
        depths: &[DepthFormat],
        rule: &Shot,
    ) -> Result<(), String> {
        let scene = matrix_scenes::by(scene, method);
        if method.loops() && method.looks_ahead() {
            // Its twin is that of the rule, but for the leaps.
            self.frames += 1;
            return same_picture(&self.stage.shoot(&scene, None).picture, &rule.picture);
        }
        let twin = self.stage.twin(&scene, method.papers);
        let undecided = twin.undecided.iter().filter(|undecided| **undecided).count() as u64 - twin.outline;
        self.undecided = self.undecided.max(undecided);
        let most = most_undecided(&scene, method);
        let outline = match method.takes_samples() {
            true if scene.polygons.is_empty() => OUTLINE,
            true => OUTLINE_OF_POLYGONS,
            false => OUTLINE_OF_SHELLS,
        };
        if undecided > most || twin.outline > outline {
            return Err(format!("{undecided} pixels are undecided, and {} on the outline", twin.outline));
        }
        if !method.on_device {
            return difference(&rule.picture, &twin, SAME_SUM + stated(&scene, rule)).map(drop);
        }
        let mut first = None;
        for (i, form) in forms.into_iter().enumerate() {
            let depths = match form {
                None => &depths[..1],
                // Each form in one format, where another driver draws them in all.
                Some(_) if some_forms() => &depths[i % depths.len()..][..1],
                Some(_) => depths,
            };
            for depth in depths {
                let shot = self.stage.shoot(&with_depth(&scene, *depth), form);
                self.frames += 1;
                let first = first.get_or_insert_with(|| counts(&shot).clone());
                let held = held(&shot, &twin, stated(&scene, &shot)).and_then(|largest| {
                    same_picture(&shot.picture, &rule.picture)?;
                    same_counts(counts(&shot), first)?;
                    Ok(largest)
                });
                let named = |what| format!("{}, {}: {what}", form.map_or_else(String::new, Form::name), depth.name());
                self.largest = self.largest.max(held.map_err(named)?);
            }
        }
        Ok(())
    }
}

/// How many pixels a twin of the scene may leave undecided, apart from those on the outline.
fn most_undecided(scene: &Scene, method: &Method) -> u64 {
    if !method.takes_samples() {
        return UNDECIDED_OF_SHELLS;
    }
    if method.looks_ahead() && method.stack() == Some(Stack::Objects) && !scene.settings.method.between {
        return UNDECIDED_IN_FACES;
    }
    // A loop asks after every sample whether the ray has ended, and from each surface along the ways of light what they meet; f32
    // cannot tell each time.
    let asks = if method.loops() { 2 } else { 1 };
    let paths = scene.shadow_bias().is_some() || scene.translucency().is_some();
    let ways = if paths { 1 + scene.lights.len() as u64 } else { 1 };
    let a_time = match projection::of(&scene.settings).ends {
        Ends::Opaque | Ends::Never(_) => UNDECIDED,
        Ends::Reached => UNDECIDED_AT_AN_EXTREME,
    };
    asks * ways * a_time
}

/// How far the plan says that the device's texture unit may be from a twin, which interpolates in f64.
fn stated(scene: &Scene, shot: &Shot) -> f64 {
    if scene.settings.sampling.filter == Filter::Hardware { shot.plan.pixel_error } else { 0.0 }
}

fn with_depth(scene: &Scene, depth: DepthFormat) -> Scene {
    let mut scene = scene.clone();
    scene.settings.method.depth = depth;
    scene
}

/// Those formats of the depth buffer that the device has.
fn there(device: &Device, scene: &Scene, depths: &[DepthFormat]) -> Vec<DepthFormat> {
    let there = |depth: &DepthFormat| {
        let formats = Formats { depth: *depth, ..scene.settings.formats() };
        let needed = vk::FormatFeatureFlags::DEPTH_STENCIL_ATTACHMENT;
        device.format_supports(resource::STORED.format(formats), needed)
    };
    depths.iter().copied().filter(there).collect()
}

/// The comparisons above see one bit of one pixel, a pixel beyond rounding, and a fragment too many.
fn changes_are_seen(device: &Arc<Device>) {
    let (_, scene) = matrix_scenes::scenes().swap_remove(0);
    let method = matrix_scenes::methods(&scene).find(|method| method.looks_ahead()).expect("one that skips");
    let scene = matrix_scenes::by(&scene, method);
    let mut stage = Stage::new(device);
    let shot = stage.shoot(&scene, forms(device, method.name()).pop().flatten());
    let twin = stage.twin(&scene, method.papers);
    let decided = twin.undecided.iter().zip(&shot.picture).position(|(u, pixel)| !u && pixel[3] > 0.1).expect("one");
    let unchanged = |other: &Shot| {
        [
            held(other, &twin, 0.0).is_ok(),
            same_picture(&other.picture, &shot.picture).is_ok(),
            same_counts(counts(other), counts(&shot)).is_ok(),
        ]
    };
    assert_eq!(unchanged(&shot), [true; 3]);

    let mut bit = shot.clone();
    bit.picture[decided][2] = f32::from_bits(bit.picture[decided][2].to_bits() ^ 1);
    assert_eq!(unchanged(&bit), [true, false, true]);

    let mut pixel = shot.clone();
    pixel.picture[decided][3] += 1e-3;
    assert_eq!(unchanged(&pixel), [false, false, true]);

    let mut count = shot.clone();
    let undecided = twin.undecided.iter().filter(|undecided| **undecided).count() as u64;
    let fragments = count.run.fragments.as_mut().expect("counts");
    fragments.main[0] += 1;
    assert_eq!(unchanged(&count), [undecided > 0, true, false]);
    let fragments = count.run.fragments.as_mut().expect("counts");
    fragments.intermediate[0] += undecided + 1;
    assert_eq!(unchanged(&count), [false, true, false]);
}
