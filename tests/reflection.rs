//! What shaders say about themselves; needs no device.

#[path = "device/shader.rs"]
mod shader;

#[path = "plan/cases.rs"]
mod cases;

use std::collections::{BTreeMap, BTreeSet};

use depthleap::glsl;
use depthleap::part::Work;
use depthleap::shared;
use depthleap::vulkan::{Shader, vk};

fn module(name: &str) -> Shader {
    Shader::new(name, &glsl::module(name).unwrap()).unwrap()
}

fn has(shader: &Shader, mode: &str) -> bool {
    shader.execution_modes.iter().any(|one| one == mode)
}

/// Names, binding numbers, kinds.
fn bindings(shader: &Shader) -> Vec<(&str, u32, vk::DescriptorType)> {
    assert!(shader.bindings.iter().all(|one| one.set == 0), "{:?}", shader.bindings);
    shader.bindings.iter().map(|one| (one.name.as_str(), one.binding, one.kind)).collect()
}

const TEXTURE: vk::DescriptorType = vk::DescriptorType::COMBINED_IMAGE_SAMPLER;

#[test]
fn main_pass_binds_what_it_declares() {
    let shader = module("main_pass.frag:plain");
    assert_eq!(shader.stage, vk::ShaderStageFlags::FRAGMENT);
    let expected = [
        ("frame", 0, vk::DescriptorType::UNIFORM_BUFFER),
        ("entry", 1, TEXTURE),
        ("direction", 2, TEXTURE),
        ("volume", 3, TEXTURE),
        ("transfer", 5, vk::DescriptorType::STORAGE_BUFFER),
    ];
    assert_eq!(bindings(&shader), expected);
    let holes = module("main_pass.frag:discard+holes");
    let more = [("holes", 4, TEXTURE), ("stored", 6, TEXTURE)];
    let mut expected = [&expected[..], &more].concat();
    expected.sort_by_key(|one| one.1);
    assert_eq!(bindings(&holes), expected);
}

#[test]
fn fused_pass_reads_what_it_blends_into() {
    let accumulated = ("accumulated", 7, vk::DescriptorType::INPUT_ATTACHMENT);
    for variant in ["copy", "fragdepth", "last", "copy+discard+holes"] {
        let shader = module(&format!("fused.frag:{variant}"));
        assert!(bindings(&shader).contains(&accumulated), "{variant}: {:?}", shader.bindings);
    }
    assert!(!bindings(&module("near_neighbor.frag:copy")).contains(&accumulated), "another pass samples it");
}

#[test]
fn what_a_scene_does_not_need_is_not_in_its_shaders() {
    let has = |name: &str, what: &str| bindings(&module(name)).iter().any(|(bound, ..)| *bound == what);
    for pass in ["near_neighbor.frag:copy", "near_neighbor.frag:fragdepth", "fused.frag:copy", "fused.frag:last+holes"]
    {
        assert!(has(pass, "nearest_distance") && has(pass, "accumulated"), "{pass}");
        assert!(!has(&format!("{pass}+dense"), "nearest_distance"), "{pass}");
        assert!(!has(&format!("{pass}+endless"), "accumulated"), "{pass}");
    }
    assert!(has("block_skip.frag:copy", "accumulated") && !has("block_skip.frag:copy+endless", "accumulated"));
    let table = ["transfer", "preintegrated"].map(|what| has("main_pass.frag:preintegrated", what));
    assert_eq!((table, has("main_pass.frag:plain", "transfer")), ([false, true], true));
}

#[test]
fn last_fused_pass_has_nothing_to_decide() {
    let decides = |name: &str| module(name).spec_constants.iter().any(|(name, _)| name == "BLEND_ROUNDING");
    assert!(decides("fused.frag:copy") && !decides("fused.frag:last") && !decides("fused.frag:last+discard"));
}

#[test]
fn compute_shader_says_its_work_group() {
    let shader = module("structure/cell_range.comp");
    assert_eq!(shader.stage, vk::ShaderStageFlags::COMPUTE);
    assert_eq!(shader.execution_modes, ["LocalSize 64 1 1"]);
    let expected = [("volume", 3, TEXTURE), ("cell_range", 8, vk::DescriptorType::STORAGE_BUFFER)];
    assert_eq!(bindings(&shader), expected);
}

#[test]
fn vertex_shader_binds_nothing() {
    let shader = module("box.vert");
    assert_eq!(shader.stage, vk::ShaderStageFlags::VERTEX);
    assert_eq!((shader.bindings.len(), shader.push_constants, shader.spec_constants.len()), (0, 0, 0));
}

#[test]
fn arrays_have_their_length() {
    let shader = shader::shader("vulkan/textures.comp");
    let found: Vec<_> = shader.bindings.iter().map(|one| (one.name.as_str(), one.binding, one.count)).collect();
    assert_eq!(found, [("textures", 2, 2), ("total", 5, 1)]);
}

#[test]
fn push_constants_are_as_large_as_their_struct() {
    for name in ["main_pass.frag:plain", "termination.frag:copy", "near_neighbor.frag:copy+discard"] {
        assert_eq!(module(name).push_constants as usize, size_of::<shared::Step>(), "{name}");
    }
    assert_eq!(module("entry.frag").push_constants, 0, "declared in a header, and used nowhere");
    assert_eq!(shader::shader("vulkan/color.frag").push_constants, 16);
}

/// A module lacks the constants it has no use for; one that no variant of its file has is misspelt.
#[test]
fn every_constant_of_a_plan_is_one_of_its_shaders_file() {
    let mut known: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let file = |name: &str| name.split(':').next().unwrap_or(name).to_owned();
    for name in glsl::names() {
        let found = module(name).spec_constants.into_iter().map(|(constant, _)| constant);
        known.entry(file(name)).or_default().extend(found);
    }
    let mut asked = 0;
    for case in cases::cases() {
        for step in &case.plan.steps {
            let (shader, constants) = match &step.work {
                Work::Draw(draw) => (draw.shader.as_deref().unwrap_or_default(), draw.constants.as_slice()),
                Work::Dispatch(dispatch) => (dispatch.shader.as_str(), dispatch.constants.as_slice()),
                _ => continue,
            };
            for (constant, _) in constants {
                assert!(known[&file(shader)].contains(*constant), "{constant} of {} in {}", step.name, case.name);
                asked += 1;
            }
        }
    }
    assert!(asked > 100, "{asked} constants were looked at");
}

#[test]
fn specialization_constants_have_their_names_and_ids() {
    let constants = |name: &str| {
        let mut found = module(name).spec_constants;
        found.sort_by_key(|one| one.1);
        found
    };
    let named = |list: &[(&str, u32)]| list.iter().map(|(name, id)| (name.to_string(), *id)).collect::<Vec<_>>();
    let main = named(&[
        ("SAMPLES_PER_PASS", 0),
        ("FILTER", 1),
        ("PIECES", 2),
        ("SEARCH", 3),
        ("CORRECT_OPACITY", 4),
        ("LAST_PARTIAL", 5),
        ("EXTRA_FETCHES", 11),
        ("GREY", 14),
    ]);
    assert_eq!(constants("main_pass.frag:plain"), main);
    let skipping = named(&[("EXIT_LOOKAHEAD", 6), ("CELL", 7), ("OCTANTS", 8), ("LOOKUPS", 9), ("SPANS", 12)]);
    let intermediate = [&main[..1], &skipping[..]].concat();
    assert_eq!(constants("near_neighbor.frag:fragdepth"), intermediate);
    let mut fused = [&main[..], &skipping[..], &named(&[("BLEND_ROUNDING", 10)])[..]].concat();
    fused.sort_by_key(|one| one.1);
    assert_eq!(constants("fused.frag:fragdepth"), fused);
}

/// Which fragments a driver may cull before it runs the shader stands in three execution modes.
#[derive(Debug, PartialEq)]
struct Depth {
    early: bool,
    replacing: bool,
    less: bool,
}

fn depth(shader: &Shader) -> Depth {
    Depth {
        early: has(shader, "EarlyFragmentTests"),
        replacing: has(shader, "DepthReplacing"),
        less: has(shader, "DepthLess"),
    }
}

const EARLY: Depth = Depth { early: true, replacing: false, less: false };
const LATE: Depth = Depth { early: false, replacing: false, less: false };

#[test]
fn main_pass_is_culled_early_unless_it_discards() {
    for (variant, expected) in [("plain", EARLY), ("holes", EARLY), ("discard", LATE), ("discard+holes", LATE)] {
        assert_eq!(depth(&module(&format!("main_pass.frag:{variant}"))), expected, "{variant}");
    }
}

#[test]
fn passes_that_mark_promise_what_their_mark_allows() {
    for pass in ["termination", "block_skip", "near_neighbor", "fused"] {
        for (variant, expected) in [
            ("copy", EARLY),
            ("fragdepth", Depth { early: false, replacing: true, less: true }),
            ("fragdepth-any", Depth { early: false, replacing: true, less: false }),
        ] {
            assert_eq!(depth(&module(&format!("{pass}.frag:{variant}"))), expected, "{pass} {variant}");
        }
    }
    for (name, expected) in [
        ("near_neighbor.frag:copy+discard", LATE),
        ("fused.frag:copy+discard", LATE),
        ("fused.frag:last+discard", LATE),
        ("fused.frag:last", EARLY),
    ] {
        assert_eq!(depth(&module(name)), expected, "{name}");
    }
}

/// With early tests a written depth has no effect, and a discarded fragment has been counted already.
fn contradiction(name: &str, found: &Depth) -> Option<&'static str> {
    if found.early && found.replacing {
        return Some("declares early tests and writes depth");
    }
    if found.early && name.contains("discard") {
        return Some("declares early tests and discards");
    }
    (found.less && !found.replacing).then_some("promises about a depth it does not write")
}

#[test]
fn no_shader_contradicts_itself() {
    for name in glsl::names() {
        assert_eq!(contradiction(name, &depth(&module(name))), None, "{name}");
    }
    assert!(contradiction("a.frag:copy", &Depth { replacing: true, ..EARLY }).is_some());
    assert!(contradiction("a.frag:discard", &EARLY).is_some());
    assert!(contradiction("a.frag:fragdepth", &Depth { less: true, ..LATE }).is_some());
}

#[test]
fn every_module_of_the_program_can_be_read() {
    for name in glsl::names() {
        let shader = module(name);
        let stage = match name.split(':').next().and_then(|file| file.rsplit_once('.')) {
            Some((_, "vert")) => vk::ShaderStageFlags::VERTEX,
            Some((_, "frag")) => vk::ShaderStageFlags::FRAGMENT,
            Some((_, "comp")) => vk::ShaderStageFlags::COMPUTE,
            other => panic!("{name} is named {other:?}"),
        };
        assert_eq!(shader.stage, stage, "{name}");
        // One binding number, one resource: passes share the numbers.
        let mut numbers: Vec<u32> = shader.bindings.iter().map(|one| one.binding).collect();
        numbers.dedup();
        assert_eq!(numbers.len(), shader.bindings.len(), "{name}");
    }
}

#[test]
fn words_that_are_no_spirv_are_refused_by_name() {
    for words in [&[][..], &[0], &[1, 2, 3, 4, 5, 6], b"#version 460".map(u32::from).as_slice()] {
        let text = Shader::new("broken.frag", words).unwrap_err().to_string();
        assert!(text.contains("shader broken.frag"), "{text}");
    }
}
