//! Every shader that the program may ask for: that it compiles, and what early tests and depths it declares; needs no device.

#[path = "glsl/asked.rs"]
mod asked;

#[path = "glsl/module.rs"]
mod module;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

use depthleap::glsl::compile::CompiledModule;
use depthleap::glsl::{self, Shader as Source};
use depthleap::vulkan::{ShaderModule, vk};
use module::{compiled, module};
use rayon::prelude::*;

/// A module lacks the constants it has no use for; one that its file declares for no set of defines is misspelt.
#[test]
fn every_constant_of_a_plan_is_one_of_its_shaders_file() {
    let mut asked = BTreeSet::new();
    for (name, plan) in asked::plans() {
        for step in &plan.steps {
            for (constant, _) in step.work.constants() {
                let file = step.work.shader().map_or("", |shader| shader.file);
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

/// All shaders that may be asked for, each compiled once for all tests, by the compiler itself: it has warnings that a module kept on
/// disk has not.
fn fresh() -> &'static [(Source, ShaderModule)] {
    static MODULES: OnceLock<Vec<(Source, ShaderModule)>> = OnceLock::new();
    MODULES.get_or_init(|| {
        let fresh = |(shader, made): (Source, CompiledModule)| {
            assert_eq!(made.warnings, "", "{shader}");
            let module = ShaderModule::new(&shader.to_string(), &made.words).unwrap();
            (shader, module)
        };
        asked::unoptimised().map(fresh).collect()
    })
}

/// A constant that a module has, its text declares.
#[test]
fn declared_constants_are_those_of_the_modules() {
    let mut seen = 0;
    for (shader, module) in fresh() {
        for (constant, _) in &module.spec_constants {
            assert!(glsl::declares(shader.file, constant).unwrap(), "{constant} of {shader}");
            seen += 1;
        }
    }
    assert!(seen > 100, "{seen} constants were looked at");
}

fn has(shader: &ShaderModule, mode: &str) -> bool {
    shader.execution_modes.iter().any(|one| one == mode)
}

/// Which fragments a driver may cull before it runs the shader stands in three execution modes.
#[derive(Debug, PartialEq)]
struct Depth {
    early: bool,
    replacing: bool,
    less: bool,
}

fn depth(shader: &ShaderModule) -> Depth {
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
    if found.early
        && ["CULL_DISCARD", "BEGINS", "DISCARDS", "FIRST", "ALIVE"].iter().any(|d| shader.defines.contains(d))
    {
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
    let asked = fresh();
    for (shader, module) in asked {
        assert_eq!(contradiction(shader, &depth(module)), None, "{shader}");
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
}

#[test]
fn every_file_is_asked_for_and_every_define_that_it_takes() {
    let asked = asked::shaders(asked::plans());
    let mut files: BTreeMap<String, usize> = BTreeMap::new();
    asked.iter().for_each(|shader| *files.entry(shader.file.to_owned()).or_default() += 1);
    println!("{} shaders: {files:?}", asked.len());
    let files: BTreeSet<String> = files.into_keys().collect();
    assert_eq!(files, glsl::built_in().shaders().unwrap().into_iter().collect());
    for file in files {
        let text = glsl::built_in().text(&file).unwrap();
        let taken = glsl::takes::Takes::of(&text).unwrap();
        let used = |define: &str| asked.iter().any(|one| one.file == file && one.defines.contains(define));
        let idle: Vec<&str> = taken.defines().filter(|define| !used(define)).collect();
        assert_eq!(idle, [""; 0], "{file}");
    }
}
