//! Every projection by every method and form: skipping changes no picture, and the f64 twin says the same.

use std::collections::BTreeMap;
use std::sync::Arc;

use depthleap::method::{self, METHODS, RC};
use depthleap::part::form::Form;
use depthleap::part::rows::Method;
use depthleap::projection::{PROJECTIONS, Projection};
use depthleap::scene::Scene;
use depthleap::scene::settings::{Accumulate, Last, Offset, Settings};
use depthleap::vulkan::Device;

use super::scenes::{Stage, VIEWS, by, differing, exactly, forms, forms_here, loops_in_turn, scene, seen, shapes};
use crate::harness::{Need, Test, share, test};

/// Largest difference between a frame in f32 and the same in f64, of values about 1 or relative to them.
const SAME_SUM: f64 = 2e-5;

type Change = fn(&mut Settings);

/// Volume and what is set: empty space and blocks, values below the range and above it, formats that the blend unit rounds
/// to, and look-ups within a segment.
const SCENES: [(&str, Change); 4] = [
    ("blocks:24", |_| {}),
    ("shells:22x25x20", |s| {
        s.volume.range = Some([60.0, 140.0].map(Into::into));
        (s.sampling.offset, s.sampling.last, s.sampling.step) = (Offset::Midpoint, Last::Partial, 0.7);
        s.method.lookups = s.sampling.samples_per_pass;
    }),
    ("jets:20", |s| (s.image.accumulate, s.method.block_first) = (Accumulate::Rgba16f, true)),
    ("shells:24", |s| (s.image.accumulate, s.method.cell, s.sampling.passes) = (Accumulate::Rgba8, 2, 30)),
];

const REAL: [&str; 4] = ["fuel.nrrd", "nucleon.nrrd", "neghip.nrrd", "silicium.nrrd"];

pub fn tests() -> Vec<Test> {
    let mut tests = Vec::new();
    for (of_row, row) in PROJECTIONS.into_iter().enumerate() {
        for (number, (volume, change)) in SCENES.into_iter().enumerate() {
            tests.push(test(&format!("projections::{}::{volume}", row.name), move |device| {
                skipping(device, &projected(volume, row, change), of_row + number);
            }));
        }
        tests.push(test(&format!("projections::{}::twin", row.name), move |device| {
            for (number, (volume, change)) in SCENES.into_iter().take(2).enumerate() {
                let scene = projected(volume, row, |s| {
                    change(s);
                    exactly(s);
                });
                twin(device, &scene, of_row + number);
            }
        }));
    }
    for row in PROJECTIONS.into_iter().filter(|row| row.shows_values()) {
        for volume in REAL {
            let one = test(&format!("projections::{}::{volume}", row.name), move |device| {
                real(device, &projected(volume, row, |s| s.sampling.samples_per_pass = 8));
            });
            tests.push(one.needs(Need::Data(volume)));
        }
    }
    tests
}

fn projected(volume: &str, row: &Projection, change: impl FnOnce(&mut Settings)) -> Scene {
    scene(volume, "ramp", |s| {
        change(s);
        s.projection.kind = row.name();
        s.image.size = [62, 50];
    })
}

/// The picture that no skipping may change: values are the same whether rays end between passes or not.
fn rule(stage: &mut Stage, scene: &Scene, row: &'static Method) -> Vec<[f32; 4]> {
    let colors = !depthleap::projection::of(&scene.settings).shows_values();
    let row = if colors || row.loops() { row.unskipped() } else { &RC };
    stage.shoot(&by(scene, row.name()), row.papers).picture
}

/// Every method gives one picture, and the same counts in all of its forms: in every form from the first side, in one of them from
/// the second. Drivers share the methods of a scene.
fn skipping(device: &Arc<Device>, scene: &Scene, turn: usize) {
    let mut stage = Stage::new(device);
    for (side, view) in share(VIEWS.into_iter().skip(1).take(2).enumerate(), turn) {
        let scene = seen(scene, view);
        let mut rules = BTreeMap::new();
        // The matrix has slices under every projection.
        let here = |row: &&Method| row.on_device && row.stack().is_none() && (!row.loops() || loops_in_turn(row, turn));
        for row in share(METHODS.into_iter().filter(|row| row.takes_samples() && here(row)), turn + side) {
            let scene = by(&scene, row.name());
            let mut counts = None;
            let mut forms = forms_here(device, &scene);
            if side > 0 {
                forms = vec![forms[turn % forms.len()]];
            }
            for form in forms {
                let shot = stage.shoot(&scene, form);
                let name = format!("{}, {}, {}", row.name, form.map_or_else(String::new, Form::name), view.0);
                let rule = rules.entry(row.unskipped().name).or_insert_with(|| rule(&mut stage, &scene, row));
                assert!(rule.iter().any(|pixel| *pixel != [0.0; 4]), "{name}: nothing is seen");
                let differs = differing(&shot.picture, rule);
                assert_eq!(differs, 0, "{name}: {differs} pixels are not those of the picture without skipping");
                let found = shot.run.fragments.expect("counts");
                let counts = counts.get_or_insert_with(|| found.clone());
                assert_eq!(*counts, found, "{name}: fragments differ from those of the first form");
            }
        }
    }
}

/// Pictures are those of the twins, and so are the fragments of main passes. By one method of each kind: that others differ in
/// their distances alone, `matrix` holds for every projection.
fn twin(device: &Arc<Device>, scene: &Scene, turn: usize) {
    let mut stage = Stage::new(device);
    let mut largest = 0.0f64;
    for view in share(VIEWS.into_iter().skip(1).take(3), turn) {
        for row in shapes() {
            let scene = by(&seen(scene, view), row.name());
            let twin = stage.twin(&scene, row.papers);
            let shot = stage.shoot(&scene, forms(device, row.name()).pop().flatten());
            let undecided = twin.undecided.iter().filter(|open| **open).count() as u64;
            for (i, (found, rule)) in shot.picture.iter().zip(&twin.pixels).enumerate() {
                for c in (0..4).filter(|_| !twin.undecided[i]) {
                    let off = (f64::from(found[c]) - rule[c]).abs() / rule[c].abs().max(1.0);
                    largest = largest.max(off);
                    assert!(off < SAME_SUM, "{}, {}: pixel {i} is {found:?}, its twin {rule:?}", row.name, view.0);
                }
            }
            let found: u64 = shot.run.fragments.expect("counts").main.iter().sum();
            let expected: u64 = twin.counts.main.iter().sum();
            let off = found.abs_diff(expected);
            let open = undecided * u64::from(shot.plan.passes);
            assert!(off <= open, "{}, {}: {found} main fragments, its twin {expected}", row.name, view.0);
        }
    }
    println!("largest difference {largest:.1e}");
}

/// Near-neighbor skipping of a real volume gives the picture of `rc`, with fewer main fragments.
fn real(device: &Arc<Device>, scene: &Scene) {
    let mut stage = Stage::new(device);
    let mut all = |row: &Method| stage.shoot(&by(scene, row.name()), forms(device, row.name()).pop().flatten());
    let (skipped, plain) = (all(&method::NN_OMNI), all(&RC));
    assert_eq!(differing(&skipped.picture, &plain.picture), 0);
    let main =
        |shot: &super::scenes::Shot| shot.run.fragments.as_ref().map_or(0, |counts| counts.main.iter().sum::<u64>());
    println!("{} main fragments of {}", main(&skipped), main(&plain));
    assert!(main(&skipped) <= main(&plain));
}
