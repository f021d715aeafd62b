//! `depthleap stability`: every case is right by every method on the device under test.

use std::sync::Arc;

use depthleap::experiment::stability::{Stability, StabilityVerdict, battery};
use depthleap::method::{CPU, METHODS};
use depthleap::part::rows::Method;
use depthleap::scene::settings::MethodName;
use depthleap::vulkan::Device;

use super::program::Place;
use crate::frame::scenes::shapes;
use crate::harness::{Need, Test, least, some_forms, test};

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

/// All methods; where another driver draws by all of them, the first of those that differ in no more than their distances; where
/// others do all that, the one that both draws and decides in its main passes.
fn methods() -> Vec<MethodName> {
    match some_forms() {
        _ if least() => shapes().into_iter().filter(|method| method.fused).map(Method::name).collect(),
        true => shapes().into_iter().map(Method::name).chain([CPU.name()]).collect(),
        false => METHODS.map(Method::name).to_vec(),
    }
}

fn every_case(device: &Arc<Device>) {
    let place = Place::new();
    let methods = methods();
    let names: Vec<&str> = methods.iter().map(|method| method.name()).collect();
    let said = place.done(&format!("stability --method {} -o out", names.join(","))).text();
    let found = read(&place);
    assert_eq!(found.device, device.info.name);
    let names: Vec<(String, String)> = battery().iter().map(|c| (c.group.to_owned(), c.name.clone())).collect();
    assert_eq!(found.cases.iter().map(|c| (c.group.clone(), c.name.clone())).collect::<Vec<_>>(), names);
    for (case, asked) in found.cases.iter().zip(battery()) {
        let of_case = |method: &&MethodName| asked.methods.is_empty() || asked.methods.contains(method);
        assert_eq!(case.outcomes.len(), methods.iter().filter(of_case).count(), "{}", case.name);
        assert!(
            case.outcomes.iter().all(|o| o.verdict != StabilityVerdict::Wrong),
            "{}: {:?}",
            case.name,
            case.outcomes
        );
    }
    // A device may lack the depth bounds test, and a depth buffer of 24 bits.
    let missing = found.count(StabilityVerdict::Missing);
    println!("{}", found.summary());
    assert!(missing <= 7 && said.contains(&found.summary()), "{missing} cases were not run");
    let page = String::from_utf8(place.read("out/stability.html")).unwrap();
    assert!(page.contains("one voxel at the far corner") && page.contains(&found.summary()));
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
