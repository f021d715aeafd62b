//! The planner: scenes that each lack one thing, whose plans then lack it too; needs no device.

#[path = "plan/lacking.rs"]
mod lacking;

use std::collections::HashSet;

use depthleap::glsl;
use depthleap::method;
use depthleap::part::resource::Resource;
use depthleap::part::{Group, Work};
use depthleap::plan::{Plan, plan};
use depthleap::read;
use depthleap::resource;
use depthleap::scene::Settings;
use depthleap::vulkan::ShaderModule;

use lacking::{Less, SCENES};

fn planned(settings: &Settings, planner: bool) -> Plan {
    let mut settings = settings.clone();
    settings.method.planner = planner;
    let scene = read::scene(&settings).unwrap();
    plan(&scene, method::papers_form(settings.method.name)).unwrap()
}

fn resources(plan: &Plan) -> HashSet<Resource> {
    plan.steps.iter().flat_map(|step| step.accesses.iter()).map(|access| access.resource).collect()
}

fn steps(plan: &Plan, group: Group) -> usize {
    plan.steps.iter().filter(|step| step.group == group).count()
}

/// Shaders of a plan, as they are compiled.
fn shaders(plan: &Plan) -> Vec<ShaderModule> {
    let shaders: HashSet<_> = plan
        .steps
        .iter()
        .filter_map(|step| match &step.work {
            Work::Draw(draw) => draw.shader.clone(),
            _ => None,
        })
        .collect();
    shaders.iter().map(|one| ShaderModule::new(&one.to_string(), &glsl::module(one).unwrap()).unwrap()).collect()
}

#[test]
fn twenty_scenes_lack_what_they_do_not_need() {
    assert!(SCENES.len() >= 20);
    for (name, change, less) in SCENES {
        let settings = lacking::settings(change);
        let (lean, full) = (planned(&settings, true), planned(&settings, false));
        assert!(lean.steps.len() <= full.steps.len(), "{name}");
        match less {
            Less::Resource(resource) => {
                assert!(resources(&full).contains(&resource), "{name}");
                assert!(!resources(&lean).contains(&resource), "{name}");
            }
            Less::Group(group) => {
                assert!(steps(&full, group) > 0, "{name}");
                assert_eq!(steps(&lean, group), 0, "{name}");
            }
            Less::Passes => assert!(lean.passes < full.passes, "{name}: {} and {}", lean.passes, full.passes),
            Less::Pixels => {
                let (lean, full) = (lean.view.region.pixels(), full.view.region.pixels());
                assert!(3 * lean < 2 * full, "{name}: {lean} and {full} pixels");
            }
            Less::Everything => assert!(lean.steps.is_empty(), "{name}"),
        }
        assert!(!lean.left_out.is_empty(), "{name}");
    }
}

#[test]
fn without_the_planner_everything_is_there() {
    for (name, change, _) in SCENES {
        let full = planned(&lacking::settings(change), false);
        let told = full.left_out.iter().find(|left| left.what.starts_with("early") || left.what.starts_with("colours"));
        assert_eq!(told, None, "{name}");
        assert!(full.steps.is_empty() || full.view.region.size() == full.view.size, "{name}");
    }
}

/// A feature that is left out is not in the SPIR-V: neither the binding it reads nor the constant that it is set by.
#[test]
fn what_is_left_out_is_not_in_the_shaders() {
    for (name, change, less) in SCENES {
        let settings = lacking::settings(change);
        let (lean, full) = (planned(&settings, true), planned(&settings, false));
        let has = |plan: &Plan, what: &str| {
            let shaders = shaders(plan);
            let bound = |s: &ShaderModule| s.bindings.iter().any(|b| b.name == what);
            let set = |s: &ShaderModule| s.spec_constants.iter().any(|(n, _)| n == what);
            shaders.iter().any(|s| bound(s) || set(s))
        };
        let gone: &[&str] = match less {
            Less::Resource(it) if it == resource::NEAREST_DISTANCE => {
                &["nearest_distance", "LOOKUPS", "EXIT_LOOKAHEAD"]
            }
            Less::Resource(it) if it == resource::block_ranges() => &["CellRange", "cell_range", "block_table"],
            Less::Group(Group::Intermediate) => &["accumulated", "EXIT_LOOKAHEAD", "DEPTH_BITS", "block_table"],
            _ => continue,
        };
        assert!(gone.iter().any(|what| has(&full, what)), "{name}: {gone:?}");
        for what in gone {
            assert!(!has(&lean, what), "{name}: {what}");
        }
    }
}

/// Where no ray can end early no shader reads what has been gathered.
#[test]
fn rays_that_cannot_end_are_not_asked() {
    for method in ["nn-omni", "nn-omni+fused", "rc-block"] {
        for (termination, reads) in [(0.9, true), (1.0, false)] {
            let settings = lacking::settings(|s| {
                s.method.name = serde_json::from_value(method.into()).unwrap();
                s.sampling.termination = termination;
            });
            let plan = planned(&settings, true);
            let bound = shaders(&plan).iter().any(|s| s.bindings.iter().any(|b| b.name == "accumulated"));
            assert_eq!(bound, reads, "{method} at T = {termination}");
        }
    }
}

#[test]
fn the_bound_of_an_opacity_is_one() {
    // 1 - 0.99^n: above 0.3 from the 36th sample on, and the longest ray of this view has 33 to 40.
    let ends = |termination: f64| {
        let settings = lacking::settings(|s| {
            s.transfer.preset = Some("haze".to_owned());
            (s.method.name, s.sampling.termination) = (method::RC_ERT.name(), termination);
        });
        let plan = planned(&settings, true);
        let longest = plan.view.longest_samples;
        (steps(&plan, Group::Intermediate) > 0, 1.0 - 0.99f64.powi(longest as i32))
    };
    let (_, most) = ends(1.0);
    assert!(ends(most - 1e-3).0, "a ray may come above {most} less a little");
    assert!(!ends(most + 2e-2).0, "no ray comes above {most} and a little");
}
