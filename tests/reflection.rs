//! What shaders say about themselves; needs no device.

#[path = "device/shader.rs"]
mod shader;

#[path = "glsl/asked.rs"]
mod asked;

use std::collections::BTreeSet;

use depthleap::glsl::compile::compile;
use depthleap::glsl::{self, Shader as Source};
use depthleap::pass::Work;
use depthleap::shared;
use depthleap::vulkan::{Shader, vk};
use rayon::prelude::*;

fn compiled(shader: &Source) -> Shader {
    Shader::new(&shader.to_string(), &glsl::module(shader).unwrap()).unwrap()
}

/// The module of `FILE:DEFINE+DEFINE`.
fn module(name: &'static str) -> Shader {
    let (file, defines) = name.split_once(':').unwrap_or((name, ""));
    compiled(&Source::new(file, defines.split('+').filter(|define| !define.is_empty())))
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
    let shader = module("main_pass.frag");
    assert_eq!(shader.stage, vk::ShaderStageFlags::FRAGMENT);
    let expected = [
        ("frame", 0, vk::DescriptorType::UNIFORM_BUFFER),
        ("entry", 1, TEXTURE),
        ("direction", 2, TEXTURE),
        ("volume", 3, TEXTURE),
        ("transfer", 5, vk::DescriptorType::STORAGE_BUFFER),
    ];
    assert_eq!(bindings(&shader), expected);
    let holes = module("main_pass.frag:CULL_DISCARD+HOLES");
    let more = [("holes", 4, TEXTURE), ("stored", 6, TEXTURE)];
    let mut expected = [&expected[..], &more].concat();
    expected.sort_by_key(|one| one.1);
    assert_eq!(bindings(&holes), expected);
}

#[test]
fn fused_pass_reads_what_it_blends_into() {
    let accumulated = ("accumulated", 7, vk::DescriptorType::INPUT_ATTACHMENT);
    for name in [
        "fused.frag:MARK_COPY",
        "fused.frag:MARK_FRAGDEPTH",
        "fused.frag:MARK_NONE",
        "fused.frag:CULL_DISCARD+HOLES+MARK_COPY",
    ] {
        let shader = module(name);
        assert!(bindings(&shader).contains(&accumulated), "{name}: {:?}", shader.bindings);
    }
    assert!(!bindings(&module("near_neighbor.frag:MARK_COPY")).contains(&accumulated), "another pass samples it");
}

#[test]
fn what_a_scene_does_not_need_is_not_in_its_shaders() {
    let has = |file: &'static str, defines: &[&'static str], what: &str| {
        let shader = compiled(&Source::new(file, defines.iter().copied()));
        bindings(&shader).iter().any(|(bound, ..)| *bound == what)
    };
    for (file, mark) in [
        ("near_neighbor.frag", "MARK_COPY"),
        ("near_neighbor.frag", "MARK_FRAGDEPTH"),
        ("fused.frag", "MARK_COPY"),
        ("fused.frag", "MARK_NONE"),
    ] {
        let all = ["nearest_distance", "accumulated"].map(|what| has(file, &[mark], what));
        assert_eq!(all, [true, true], "{file} {mark}");
        assert!(!has(file, &[mark, "DENSE"], "nearest_distance"), "{file} {mark}");
        assert!(!has(file, &[mark, "ENDLESS"], "accumulated"), "{file} {mark}");
    }
    let ends = [&["MARK_COPY"][..], &["MARK_COPY", "ENDLESS"]].map(|set| has("block_skip.frag", set, "accumulated"));
    assert_eq!(ends, [true, false]);
    let table = ["transfer", "preintegrated"].map(|what| has("main_pass.frag", &["PREINTEGRATED"], what));
    assert_eq!((table, has("main_pass.frag", &[], "transfer")), ([false, true], true));
}

#[test]
fn last_fused_pass_has_nothing_to_decide() {
    let decides = |name| module(name).spec_constants.iter().any(|(name, _)| name == "BLEND_ROUNDING");
    assert!(decides("fused.frag:MARK_COPY") && !decides("fused.frag:MARK_NONE"));
    assert!(!decides("fused.frag:MARK_NONE+CULL_DISCARD"));
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
    for name in ["main_pass.frag", "termination.frag:MARK_COPY", "near_neighbor.frag:MARK_COPY+CULL_DISCARD"] {
        assert_eq!(module(name).push_constants as usize, size_of::<shared::Step>(), "{name}");
    }
    assert_eq!(module("entry.frag").push_constants, 0, "declared in a header, and used nowhere");
    assert_eq!(shader::shader("vulkan/color.frag").push_constants, 16);
}

/// A module lacks the constants it has no use for; one that its file declares for no set of defines is misspelt.
#[test]
fn every_constant_of_a_plan_is_one_of_its_shaders_file() {
    let mut asked = BTreeSet::new();
    for (name, plan) in asked::plans() {
        for step in &plan.steps {
            let (shader, constants) = match &step.work {
                Work::Draw(draw) => (draw.shader.as_ref(), draw.constants.as_slice()),
                Work::Dispatch(dispatch) => (Some(&dispatch.shader), dispatch.constants.as_slice()),
                _ => continue,
            };
            for (constant, _) in constants {
                let file = shader.map_or("", |shader| shader.file);
                if asked.insert((file, *constant)) {
                    assert!(glsl::declares(file, constant).unwrap(), "{constant} of {} in {name}", step.name);
                }
            }
        }
    }
    assert!(asked.len() > 30, "{asked:?}");
    // A name that only looks like one of the file's.
    assert!(!glsl::declares("main_pass.frag", "SAMPLES_PER_PAS").unwrap());
    assert!(!glsl::declares("termination.frag", "EXIT_LOOKAHEAD").unwrap());
}

/// A constant that a module has, its text declares.
#[test]
fn declared_constants_are_those_of_the_modules() {
    let mut seen = 0;
    for shader in asked::shaders(&asked::plans()) {
        for (constant, _) in compiled(&shader).spec_constants {
            assert!(glsl::declares(shader.file, &constant).unwrap(), "{constant} of {shader}");
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen} constants were looked at");
}

#[test]
fn specialization_constants_have_their_names_and_ids() {
    let constants = |name| {
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
    assert_eq!(constants("main_pass.frag"), main);
    let skipping = named(&[("EXIT_LOOKAHEAD", 6), ("CELL", 7), ("OCTANTS", 8), ("LOOKUPS", 9), ("SPANS", 12)]);
    let intermediate = [&main[..1], &skipping[..]].concat();
    assert_eq!(constants("near_neighbor.frag:MARK_FRAGDEPTH"), intermediate);
    let mut fused = [&main[..], &skipping[..], &named(&[("BLEND_ROUNDING", 10)])[..]].concat();
    fused.sort_by_key(|one| one.1);
    assert_eq!(constants("fused.frag:MARK_FRAGDEPTH"), fused);
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
    for (name, expected) in [
        ("main_pass.frag", EARLY),
        ("main_pass.frag:HOLES", EARLY),
        ("main_pass.frag:CULL_DISCARD", LATE),
        ("main_pass.frag:CULL_DISCARD+HOLES", LATE),
    ] {
        assert_eq!(depth(&module(name)), expected, "{name}");
    }
}

#[test]
fn passes_that_mark_promise_what_their_mark_allows() {
    for file in ["termination.frag", "block_skip.frag", "near_neighbor.frag", "fused.frag"] {
        for (mark, expected) in [
            ("MARK_COPY", EARLY),
            ("MARK_FRAGDEPTH", Depth { early: false, replacing: true, less: true }),
            ("MARK_FRAGDEPTH_ANY", Depth { early: false, replacing: true, less: false }),
        ] {
            assert_eq!(depth(&compiled(&Source::new(file, [mark]))), expected, "{file} {mark}");
        }
    }
    for (name, expected) in [
        ("near_neighbor.frag:MARK_COPY+CULL_DISCARD", LATE),
        ("fused.frag:MARK_COPY+CULL_DISCARD", LATE),
        ("fused.frag:MARK_NONE+CULL_DISCARD", LATE),
        ("fused.frag:MARK_NONE", EARLY),
    ] {
        assert_eq!(depth(&module(name)), expected, "{name}");
    }
}

/// With early tests a written depth has no effect, and a discarded fragment has been counted already.
fn contradiction(shader: &Source, found: &Depth) -> Option<&'static str> {
    if found.early && found.replacing {
        return Some("declares early tests and writes depth");
    }
    if found.early && ["CULL_DISCARD", "DISCARDS", "FIRST", "ALIVE"].iter().any(|d| shader.defines.contains(d)) {
        return Some("declares early tests and discards");
    }
    (found.less && !found.replacing).then_some("promises about a depth it does not write")
}

#[test]
fn contradictions_are_seen() {
    let (plain, discards) = (Source::new("a.frag", []), Source::new("a.frag", ["CULL_DISCARD"]));
    assert!(contradiction(&plain, &Depth { replacing: true, ..EARLY }).is_some());
    assert!(contradiction(&discards, &EARLY).is_some());
    assert!(contradiction(&plain, &Depth { less: true, ..LATE }).is_some());
}

/// All that the program may ever compile compiles without a warning, can be read, and does not contradict itself.
#[test]
fn every_shader_that_is_asked_for_is_sound() {
    let asked = asked::shaders(&asked::plans());
    // By the compiler itself, which has warnings that a module kept on disk has not.
    let fresh = |shader: &Source| {
        let text = glsl::built_in().text(shader.file).unwrap();
        let defines: Vec<&str> = shader.defines.iter().copied().collect();
        let made = compile(&text, &defines).unwrap_or_else(|broken| panic!("{shader}: {broken}"));
        assert_eq!(made.warnings, "", "{shader}");
        Shader::new(&shader.to_string(), &made.words).unwrap()
    };
    let modules: Vec<Shader> = asked.par_iter().map(fresh).collect();
    for (shader, module) in asked.iter().zip(modules) {
        assert_eq!(contradiction(shader, &depth(&module)), None, "{shader}");
        let stage = match shader.file.rsplit_once('.') {
            Some((_, "vert")) => vk::ShaderStageFlags::VERTEX,
            Some((_, "frag")) => vk::ShaderStageFlags::FRAGMENT,
            Some((_, "comp")) => vk::ShaderStageFlags::COMPUTE,
            other => panic!("{shader} is named {other:?}"),
        };
        assert_eq!(module.stage, stage, "{shader}");
        // One binding number, one resource: passes share the numbers.
        let mut numbers: Vec<u32> = module.bindings.iter().map(|one| one.binding).collect();
        numbers.dedup();
        assert_eq!(numbers.len(), module.bindings.len(), "{shader}");
    }
    // Every file is asked for, and every define that any file takes.
    let files: BTreeSet<String> = asked.iter().map(|shader| shader.file.to_owned()).collect();
    assert_eq!(files, glsl::built_in().shaders().unwrap().into_iter().collect());
    for file in files {
        let text = glsl::built_in().text(&file).unwrap();
        let taken = glsl::takes::Takes::of(&text).unwrap();
        let used = |define: &str| asked.iter().any(|one| one.file == file && one.defines.contains(define));
        let idle: Vec<&str> = taken.defines().filter(|define| !used(define)).collect();
        assert_eq!(idle, [""; 0], "{file}");
    }
}

#[test]
fn words_that_are_no_spirv_are_refused_by_name() {
    for words in [&[][..], &[0], &[1, 2, 3, 4, 5, 6], b"#version 460".map(u32::from).as_slice()] {
        let text = Shader::new("broken.frag", words).unwrap_err().to_string();
        assert!(text.contains("shader broken.frag"), "{text}");
    }
}
