//! `depthleap stability`: every case is right by every method on the device under test.

use std::iter;
use std::sync::Arc;

use depthleap::experiment::stability::{Stability, StabilityVerdict, battery};
use depthleap::method::{CPU, METHODS, RC_ERT};
use depthleap::part::rows::Method;
use depthleap::scene::settings::MethodName;
use depthleap::vulkan::Device;

use super::program::Place;
use crate::frame::scenes::shapes;
use crate::harness::{Need, Test, all_forms, least, share, test};

pub fn tests() -> Vec<Test> {
    vec![
        test("stability: every case is right", every_case),
        test("stability runs what is asked for, validated", validated).needs(Need::Thoroughness),
        test("stability refuses what it does not know", refused),
    ]
}

fn read(place: &Place) -> Stability {
    serde_json::from_slice(&place.read("out/stability.json")).unwrap()
}

/// Words of the groups of cases that are about depths and what may be skipped by them.
const OF_SKIPPING: [&str; 2] = ["trap", "buffer"];

/// What is run: the cases with a text in their names, by some methods. All cases by the first of those methods that differ in no more
/// than their distances, or by all where nothing is to be left out; beside another driver by every other one of them, and there by the
/// rest. Where others do more of everything, by one that skips nothing, and cases of skipping by the one that both draws and decides in
/// its main passes. By that one all cases take three times as long there.
fn asked() -> Vec<(&'static str, Vec<MethodName>)> {
    match all_forms() {
        false if least() => {
            let fused: Vec<MethodName> = shapes().into_iter().filter(|method| method.fused).map(Method::name).collect();
            let skipping = OF_SKIPPING.map(|group| (group, fused.clone()));
            iter::once(("", vec![RC_ERT.name()])).chain(skipping).collect()
        }
        false => vec![("", share(shapes().into_iter().map(Method::name).chain([CPU.name()]), 0))],
        true => vec![("", METHODS.map(Method::name).to_vec())],
    }
}

fn every_case(device: &Arc<Device>) {
    for (text, methods) in asked() {
        cases(device, text, &methods);
    }
}

/// The cases with `text` in their names are right by these methods.
fn cases(device: &Device, text: &str, methods: &[MethodName]) {
    let place = Place::new();
    let mut cases = battery();
    cases.retain(|case| format!("{}: {}", case.group, case.name).contains(text));
    let names: Vec<&str> = methods.iter().map(|method| method.name()).collect();
    let part = if text.is_empty() { String::new() } else { format!("--case {text}") };
    let said = place.done(&format!("stability {part} --method {} -o out", names.join(","))).text();
    let found = read(&place);
    assert_eq!(found.device, device.info.name);
    let names: Vec<(String, String)> = cases.iter().map(|c| (c.group.to_owned(), c.name.clone())).collect();
    assert_eq!(found.cases.iter().map(|c| (c.group.clone(), c.name.clone())).collect::<Vec<_>>(), names);
    for (case, asked) in found.cases.iter().zip(&cases) {
        let scene = asked.scene().ok();
        let of_case = |method: &&MethodName| asked.is_for(**method, scene.as_ref());
        assert_eq!(case.outcomes.len(), methods.iter().filter(of_case).count(), "{}", case.name);
        assert!(
            case.outcomes.iter().all(|o| o.verdict != StabilityVerdict::Wrong),
            "{}: {:?}",
            case.name,
            case.outcomes
        );
    }
    // A device may lack the depth bounds test, and a depth buffer of 24 bits. Cases of other methods count as missing too.
    let of_others = found.cases.iter().filter(|case| case.outcomes.is_empty()).count();
    let missing = found.count(StabilityVerdict::Missing) - of_others;
    println!("{}", found.summary());
    assert!(missing <= 7 && said.contains(&found.summary()), "{missing} cases were not run");
    let page = String::from_utf8(place.read("out/stability.html")).unwrap();
    let first = cases.first().expect("a case");
    assert!(page.contains(&first.name) && page.contains(&found.summary()), "{}", first.name);
}

fn validated(_: &Arc<Device>) {
    let place = Place::new();
    place.done("stability --case d16 --method nn-omni,nn-omni+fused --validate -o out");
    assert!(read(&place).cases.iter().all(|case| case.name.contains("d16")));
}

fn refused(_: &Arc<Device>) {
    let place = Place::new();
    place.refused("stability --case nonsense -o out", 2, &["nonsense", "--list"]);
    place.refused("stability", 2, &["--output"]);
    assert!(place.done("stability --list").text().contains("skip trap: one voxel"));
}
