//! The battery of stiff and extreme cases: the same samples in f64 pass it, and whoever integrates wrongly does not.

use std::collections::BTreeSet;

use depthleap::error::Result;
use depthleap::experiment::stability::{
    Expect, Integrator, Outcome, Rendered, StabilityCase, StabilityVerdict, battery, judge,
};
use depthleap::frame::{Structures, cpu};
use depthleap::method;
use depthleap::plan;
use depthleap::scene::Scene;
use depthleap::scene::settings::{Alpha, DepthFormat, Last, MethodName};

/// An integrator in f64, with what is done wrongly before and after.
struct Twin {
    scene: fn(&mut Scene),
    pixel: fn(&Scene, [f64; 4]) -> [f64; 4],
}

const RIGHT: Twin = Twin { scene: |_| {}, pixel: |_, pixel| pixel };

impl Integrator for Twin {
    fn sub_pixel_bits(&self) -> u32 {
        cpu::SUB_PIXEL_BITS
    }

    fn render(&mut self, scene: &Scene) -> Result<std::result::Result<Rendered, String>> {
        // What is refused is refused as it stands.
        let plan = plan::plan(scene, method::papers_form(scene.settings.method.name))?;
        let mut changed = scene.clone();
        (self.scene)(&mut changed);
        let mut structures = Structures::default();
        structures.prepare(&changed, &plan);
        let frame = cpu::run(&changed, &plan, &structures, cpu::SUB_PIXEL_BITS);
        let pixels = frame.pixels.into_iter().map(|pixel| (self.pixel)(scene, pixel)).collect();
        Ok(Ok(Rendered { pixels, steps: plan.steps.len() }))
    }
}

/// Of each case of the groups whose names begin so, but those of thousands of passes, by one method; judged when asked for.
fn outcomes(method: MethodName, groups: &str, mut integrator: Twin) -> impl Iterator<Item = (StabilityCase, Outcome)> {
    let cases = battery().into_iter().filter(|case| !case.name.contains("5461 passes"));
    let of_groups = cases.filter(move |case| case.group.starts_with(groups));
    of_groups.filter_map(move |case| {
        let outcome = judge(&case, &[method], &mut integrator).unwrap().pop()?;
        Some((case, outcome))
    })
}

/// The first case of the groups that the integrator gets wrong.
fn first_wrong(integrator: Twin, groups: &str) -> Option<String> {
    let wrong = |(case, outcome): (StabilityCase, Outcome)| {
        (outcome.verdict == StabilityVerdict::Wrong)
            .then(|| format!("{}: {}: {:?}", case.group, case.name, outcome.remark))
    };
    outcomes(method::NN_OMNI.name(), groups, integrator).find_map(wrong)
}

#[test]
fn the_same_samples_in_f64_pass() {
    for method in [method::NN_OMNI.name(), method::RC_BLOCK.name()] {
        for (case, outcome) in outcomes(method, "", RIGHT) {
            assert_eq!(outcome.verdict, StabilityVerdict::Right, "{}: {}: {:?}", case.group, case.name, outcome.remark);
        }
    }
}

#[test]
fn broken_integrators_fail() {
    let broken: [(&str, Twin, &str); 8] = [
        (
            "opacity as it stands",
            Twin { scene: |s| s.settings.sampling.alpha = Alpha::Paper, ..RIGHT },
            "optical depth",
        ),
        ("a whole last sample", Twin { scene: |s| s.settings.sampling.last = Last::Full, ..RIGHT }, "optical depth"),
        ("a step a thousandth too long", Twin { scene: |s| s.settings.sampling.step *= 1.001, ..RIGHT }, "sampling"),
        (
            "1 - (1 - a)^x in f32",
            Twin {
                // What is left of a thin medium when 1 - alpha is rounded.
                pixel: |_, [r, g, b, a]| {
                    let rounded = f64::from(1.0 - (1.0 - a as f32));
                    let share = if a > 0.0 { rounded / a } else { 1.0 };
                    [r * share, g * share, b * share, rounded]
                },
                ..RIGHT
            },
            "optical depth",
        ),
        ("rays that never end early", Twin { scene: |s| s.settings.sampling.termination = 1.0, ..RIGHT }, "sampling"),
        (
            "rays that end at the threshold, not above",
            Twin { scene: |s| s.settings.sampling.termination -= 1e-9, ..RIGHT },
            "sampling",
        ),
        ("a pixel that is no number", Twin { pixel: |_, [r, g, b, a]| [r / a, g / a, b / a, a], ..RIGHT }, "values"),
        (
            "colour that is not premultiplied",
            Twin { pixel: |_, [r, g, b, a]| if a > 0.0 { [r / a, g / a, b / a, a] } else { [r, g, b, a] }, ..RIGHT },
            "view",
        ),
    ];
    for (name, integrator, group) in broken {
        println!("{name}: {}", first_wrong(integrator, group).expect(name));
    }
}

/// Near-neighbor skipping with distances that are one voxel too long.
#[test]
fn a_structure_that_jumps_too_far_fails() {
    struct TooFar;
    impl Integrator for TooFar {
        fn sub_pixel_bits(&self) -> u32 {
            cpu::SUB_PIXEL_BITS
        }

        fn render(&mut self, scene: &Scene) -> Result<std::result::Result<Rendered, String>> {
            let plan = plan::plan(scene, method::papers_form(method::NN_OMNI.name()))?;
            let mut structures = Structures::default();
            structures.prepare(scene, &plan);
            for (_, built) in &mut structures.distances {
                let longer = |byte: &mut u8| *byte = if *byte == 0 { 2 } else { byte.saturating_add(1) };
                built.value.bytes.iter_mut().for_each(longer);
            }
            let frame = cpu::run(scene, &plan, &structures, cpu::SUB_PIXEL_BITS);
            Ok(Ok(Rendered { pixels: frame.pixels, steps: plan.steps.len() }))
        }
    }
    let traps = battery().into_iter().filter(|case| case.group == "skip trap");
    let fails = |case: &StabilityCase| {
        judge(case, &[method::NN_OMNI.name()], &mut TooFar).unwrap()[0].verdict == StabilityVerdict::Wrong
    };
    let caught = traps.filter(fails).count();
    assert!(caught >= 10, "{caught} traps caught it");
}

#[test]
fn every_case_says_what_it_holds_and_why() {
    let cases = battery();
    let names: BTreeSet<(&str, &str)> = cases.iter().map(|case| (case.group, case.name.as_str())).collect();
    assert_eq!(names.len(), cases.len(), "names are told apart");
    for case in &cases {
        assert!(!case.tolerance.reason.is_empty() && case.tolerance.absolute >= 0.0, "{}", case.name);
        // What is refused is refused when it is loaded or planned.
        if let Expect::Refused(part) = case.expect {
            let method = case.methods.first().copied().unwrap_or(method::NN_OMNI.name());
            let refused = case.scene().and_then(|mut scene| {
                scene.settings.method.name = method;
                plan::plan(&scene, method::papers_form(method))
            });
            let error = refused.map(drop).unwrap_err().to_string();
            assert!(error.contains(part), "{}: {error}", case.name);
        }
    }
}

#[test]
fn sections_are_as_many_as_a_format_tells_apart() {
    use depthleap::twin::section::{most_sections, section_depth, section_end};
    assert_eq!(most_sections(DepthFormat::D16), 5461);
    assert!(most_sections(DepthFormat::D24) > 65_536 && most_sections(DepthFormat::D32) > 65_536);
    // Every mark of 16 bits is on its own side of every bound of 16 bits.
    let most = most_sections(DepthFormat::D16);
    let code = |depth: f64| (depth * 65535.0).round() as u32;
    for section in 0..most {
        assert!(code(section_depth(section, most)) < code(section_end(section, most)), "{section}");
        assert!(section == 0 || code(section_depth(section, most)) > code(section_end(section - 1, most)), "{section}");
    }
}
