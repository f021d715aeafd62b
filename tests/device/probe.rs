//! The probe on the device: what it finds is what is known of the drivers, and what a device lacks stops nothing.

use std::sync::Arc;

use depthleap::probe::case::Case;
use depthleap::probe::correct::{Depth, faults};
use depthleap::probe::measure::{How, ProbeClock, cost, statistics};
use depthleap::probe::record::{self, MechanismRecord, Probe};
use depthleap::probe::run::missing;
use depthleap::probe::{CaseShader, Compare, Culling, Mechanism, Rig};
use depthleap::vulkan::{Device, DeviceInfo, vk};

use crate::cli::program::Place;
use crate::harness::{Test, test};

pub fn tests() -> Vec<Test> {
    let tests = vec![
        test("finds what is known of this driver", known_of_this_driver),
        test("a device that lacks things is asked for the rest", lacking_device),
        test("what is no probe is refused before anything runs", other_that_is_no_probe),
    ];
    tests.into_iter().map(|test| test.within("probe")).collect()
}

fn known_of_this_driver(device: &Arc<Device>) {
    let place = Place::new();
    let said = place.done("probe --quick --validate -o out").text();
    let probe = record::read(&text(&place, "out/probe.json"), "out/probe.json").unwrap();
    assert!(text(&place, "out/report.html").contains("What "), "the report has its section");
    for mechanism in Mechanism::ALL {
        assert!(said.contains(mechanism.words()), "{said}");
    }
    // Of every driver: what must not be culled is not, and what the shader rejects itself comes out right.
    for line in probe.lines.iter().filter(|line| line.missing.is_none()) {
        let forbidden = line.promise == depthleap::probe::rule::Promise::Forbidden;
        assert!(!(forbidden && line.culling() == Some(Culling::Early)), "{}", line.case.name());
        assert!(!line.case.mechanism.in_shader() || line.faults().next().is_none(), "{}", line.case.name());
    }
    let driver = format!("{} {}", device.info.name, device.info.driver_info);
    match () {
        () if driver.contains("Mesa 22.3") => mesa_22(&probe),
        () if driver.contains("Mesa 26") => mesa_26(&probe),
        () if driver.contains("SwiftShader") => swiftshader(&probe),
        () => eprintln!("          ... nothing is known of {driver}"),
    }
}

fn text(place: &Place, file: &str) -> String {
    String::from_utf8(place.read(file)).unwrap()
}

fn of(probe: &Probe, mechanism: Mechanism, shader: CaseShader) -> &MechanismRecord {
    let case = Case { mechanism, shader, compare: Compare::GreaterOrEqual };
    probe.lines.iter().find(|line| line.case == case).unwrap()
}

/// Where a driver has no counts that tell, culling is judged by times. On a machine that others use too they may fall between
/// both verdicts, and never on the other side: that would be another driver.
#[track_caller]
fn culled(probe: &Probe, mechanism: Mechanism, shader: CaseShader, expected: Culling) {
    let line = of(probe, mechanism, shader);
    let found = line.culling();
    let fits = found == Some(expected) || found == Some(Culling::Partly);
    assert!(fits, "{} is {found:?}, not {expected:?}: {:?}", line.case.name(), line.cost);
}

/// Mechanisms with a fault.
fn wrong(probe: &Probe) -> Vec<Mechanism> {
    let wrong =
        |m: &Mechanism| probe.lines.iter().any(|line| line.case.mechanism == *m && line.faults().next().is_some());
    Mechanism::ALL.into_iter().filter(wrong).collect()
}

/// No depth bounds test; early depth and stencil tests, unless the shader stores or writes depth; constant statistics.
fn mesa_22(probe: &Probe) {
    assert_eq!(wrong(probe), []);
    assert!(probe.statistics.is_some() && !probe.device.depth_bounds);
    assert!(of(probe, Mechanism::BoundsRead, CaseShader::Plain).missing.is_some());
    lavapipe(probe, &[Mechanism::DepthRead, Mechanism::DepthWrite, Mechanism::Stencil]);
}

/// The bounds test too, which rejects samples in the bounds where depths are written.
fn mesa_26(probe: &Probe) {
    assert_eq!(wrong(probe), [Mechanism::BoundsWrite, Mechanism::BoundsCompare]);
    assert_eq!(probe.statistics, None);
    let early = [Mechanism::DepthRead, Mechanism::DepthWrite, Mechanism::BoundsRead, Mechanism::BoundsAlone];
    lavapipe(probe, &early);
    let words = depthleap::experiment::probe::text(probe);
    assert!(words.contains("Wrong, the first case of each kind") && words.contains("colour wrong in"), "{words}");
}

fn lavapipe(probe: &Probe, early: &[Mechanism]) {
    for &mechanism in early {
        for shader in [
            CaseShader::Plain,
            CaseShader::Early,
            CaseShader::Discards,
            CaseShader::EarlyBuffer,
            CaseShader::EarlyImage,
        ] {
            culled(probe, mechanism, shader, Culling::Early);
        }
        for shader in [
            CaseShader::Buffer,
            CaseShader::Image,
            CaseShader::DepthAny,
            CaseShader::DepthLess,
            CaseShader::DepthLessImage,
        ] {
            culled(probe, mechanism, shader, Culling::Late);
        }
    }
}

/// Counts that ignore bounds where the depth test is off; a bounds test that never saves shader work; early depth tests
/// only where they are declared.
fn swiftshader(probe: &Probe) {
    assert_eq!(wrong(probe), [Mechanism::BoundsAlone]);
    assert!(probe.lines.iter().flat_map(MechanismRecord::faults).all(|fault| fault.what == "count"));
    for shader in [CaseShader::Plain, CaseShader::Early, CaseShader::DepthLess, CaseShader::EarlyImage] {
        for mechanism in [Mechanism::BoundsRead, Mechanism::BoundsWrite, Mechanism::BoundsCompare] {
            culled(probe, mechanism, shader, Culling::Late);
        }
    }
    culled(probe, Mechanism::DepthRead, CaseShader::Early, Culling::Early);
    culled(probe, Mechanism::DepthRead, CaseShader::Plain, Culling::Late);
    culled(probe, Mechanism::Alive, CaseShader::Plain, Culling::Early);
}

/// As if the device had no bounds test, no statistics, no timestamps and no exact counts.
fn lacking_device(device: &Arc<Device>) {
    let info = DeviceInfo {
        depth_bounds: false,
        occlusion_precise: false,
        pipeline_statistics: false,
        timestamp_valid_bits: 0,
        queue_families: device
            .info
            .queue_families
            .iter()
            .map(|family| depthleap::vulkan::QueueFamily { timestamp_valid_bits: 0, ..family.clone() })
            .collect(),
        ..device.info.clone()
    };
    let lacking = Device::new(device.instance(), &info, true).unwrap();
    let clock = ProbeClock::of(&lacking.info);
    assert!(lacking.info.is_cpu() || clock == ProbeClock::Wall);
    let mut rig = Rig::new(&lacking, vk::Format::D32_SFLOAT, 64).unwrap();
    assert_eq!(statistics(&mut rig).unwrap().as_deref(), Some("the device has none"));
    let case = |mechanism, shader| Case { mechanism, shader, compare: Compare::GreaterOrEqual };
    let bounds = case(Mechanism::BoundsCompare, CaseShader::DepthLess);
    assert_eq!(missing(&lacking, &bounds).as_deref(), Some("no depth bounds test"));
    let early = case(Mechanism::DepthRead, CaseShader::Early);
    assert_eq!(missing(&lacking, &early), None);
    assert_eq!(faults(&mut rig, &early, Depth::Full).unwrap(), []);
    let how = How { clock, work: 2000, believed: false, mixed: true };
    let found = cost(&mut rig, &early, &how).unwrap();
    assert_eq!((found.invocations, found.verdict.by.as_str()), (None, "time"));
    // And a wall clock serves too, where it must.
    let found = cost(&mut rig, &early, &How { clock: ProbeClock::Wall, mixed: false, ..how }).unwrap();
    assert!(found.none_ms.iter().all(|ms| *ms > 0.0));
}

fn other_that_is_no_probe(_: &Arc<Device>) {
    let place = Place::new();
    place.file("a.json", "{\"version\": 9}");
    place.refused("probe --quick --compare a.json -o out", 3, &["a.json", "format version 9"]);
    place.refused("probe --quick --compare b.json -o out", 3, &["b.json", "cannot be read"]);
    assert!(!place.path().join("out").exists(), "nothing is left behind");
}
