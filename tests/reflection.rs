//! What shaders say about themselves; needs no device.

#[path = "device/shader.rs"]
mod shader;

#[path = "glsl/module.rs"]
mod module;

use depthleap::glsl::Shader as Source;
use depthleap::shared;
use depthleap::vulkan::{ShaderModule, vk};
use module::{compiled, module};

/// Names, binding numbers, kinds.
fn bindings(shader: &ShaderModule) -> Vec<(&str, u32, vk::DescriptorType)> {
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
        assert_eq!(module(name).push_constants as usize, size_of::<shared::PushStep>(), "{name}");
    }
    assert_eq!(module("entry.frag").push_constants, 0, "declared in a header, and used nowhere");
    assert_eq!(shader::shader("vulkan/color.frag").push_constants, 16);
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
        ("PROJECTION", 15),
        ("LAST_NONE", 27),
    ]);
    assert_eq!(constants("main_pass.frag"), main);
    let skipping = named(&[("EXIT_LOOKAHEAD", 6), ("CELL", 7), ("OCTANTS", 8), ("LOOKUPS", 9), ("SPANS", 12)]);
    let projection = named(&[("PROJECTION", 15), ("LAST_NONE", 27)]);
    let intermediate = [&main[..1], &skipping[..], &projection[..]].concat();
    assert_eq!(constants("near_neighbor.frag:MARK_FRAGDEPTH"), intermediate);
    let mut fused = [&main[..], &skipping[..], &named(&[("BLEND_ROUNDING", 10)])[..]].concat();
    fused.sort_by_key(|one| one.1);
    assert_eq!(constants("fused.frag:MARK_FRAGDEPTH"), fused);
}

#[test]
fn words_that_are_no_spirv_are_refused_by_name() {
    for words in [&[][..], &[0], &[1, 2, 3, 4, 5, 6], b"#version 460".map(u32::from).as_slice()] {
        let text = ShaderModule::new("broken.frag", words).unwrap_err().to_string();
        assert!(text.contains("shader broken.frag"), "{text}");
    }
}
