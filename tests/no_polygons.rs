//! Scenes without polygons have nothing of them: no pass, image, descriptor, constant or line of shader.

use std::collections::BTreeSet;

use depthleap::glsl;
use depthleap::method::METHODS;
use depthleap::part::Group;
use depthleap::plan::{Plan, plan};
use depthleap::read;
use depthleap::resource;
use depthleap::scene::mesh::Keep;
use depthleap::scene::settings::{ClipSettings, MeshSettings, PartialSegments, Settings};
use depthleap::vulkan::ShaderModule;

/// Defines of shaders in frames with polygons or clip geometry.
const DEFINES: [&str; 10] = [
    "LAYER_BEFORE",
    "LAYER_BEHIND",
    "OPAQUE",
    "CLIPPED",
    "CLIP_FIRST",
    "COLORED",
    "BEGINS",
    "PARTIAL",
    "PARTIAL_APART",
    "LAYERS",
];

/// Names in the shaders that come with them: bindings and constants.
const NAMES: [&str; 9] = [
    "layer",
    "layer_color",
    "clip_winding",
    "triangles",
    "materials",
    "placement",
    "CLIP_MESHES",
    "PARTIAL_DEPTH",
    "PARTIAL_AHEAD",
];

/// What a plan has of polygons, in words.
fn traces(plan: &Plan) -> BTreeSet<String> {
    let rows = [
        resource::LAYER,
        resource::LAYER_COLOR,
        resource::PEEL_DEPTH,
        resource::CLIP_WINDING,
        resource::TRIANGLES,
        resource::MATERIALS,
        resource::PLACEMENT,
        resource::POLYGON_CORNERS,
        resource::SCREEN_CORNERS,
    ];
    let mut found = BTreeSet::new();
    for resource in plan.resources() {
        found.extend(rows.iter().any(|row| std::ptr::eq(row.of, resource.of)).then(|| format!("{resource:?}")));
    }
    for step in &plan.steps {
        found.extend(matches!(step.group, Group::Peel | Group::Blend).then(|| step.name.clone()));
        found.extend((step.section > 0 || step.pass_name() == "partial_pass").then(|| step.name.clone()));
        let Some(shader) = step.work.shader() else { continue };
        found.extend(shader.defines.iter().filter(|define| DEFINES.contains(define)).map(|define| define.to_string()));
        let words = glsl::module(shader).unwrap();
        let module = ShaderModule::new(&shader.to_string(), &words).unwrap();
        found.extend(
            module.bindings.iter().filter(|one| NAMES.contains(&one.name.as_str())).map(|one| one.name.clone()),
        );
        let names = text(&words);
        found.extend(
            NAMES.iter().filter(|name| names.iter().any(|n| n.starts_with(**name))).map(|n| format!("{n} in code")),
        );
    }
    found
}

/// The names that a module keeps: the strings of its OpName and OpMemberName.
fn text(words: &[u32]) -> Vec<String> {
    const HEADER: usize = 5;
    const NAME: u32 = 5;
    const MEMBER_NAME: u32 = 6;
    let mut names = Vec::new();
    let mut at = HEADER;
    while at < words.len() {
        let (count, code) = ((words[at] >> 16) as usize, words[at] & 0xffff);
        let first = match code {
            NAME => 2,
            MEMBER_NAME => 3,
            _ => count,
        };
        let bytes: Vec<u8> = words[at + first..at + count].iter().flat_map(|word| word.to_le_bytes()).collect();
        let end = bytes.iter().position(|byte| *byte == 0).unwrap_or(bytes.len());
        names.extend((end > 0).then(|| String::from_utf8_lossy(&bytes[..end]).into_owned()));
        at += count.max(1);
    }
    names
}

fn settings() -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:16".to_owned());
    settings.image.size = [32, 32];
    settings
}

/// Plans of a scene by each method, in each of its forms.
fn plans(settings: &Settings) -> Vec<Plan> {
    let mut plans = Vec::new();
    for method in METHODS.into_iter().filter(|method| method.takes_samples()) {
        let mut settings = settings.clone();
        settings.method.name = method.name();
        let scene = read::scene(&settings).unwrap();
        let forms = (method.forms)();
        let forms = if forms.is_empty() { vec![None] } else { forms.into_iter().map(Some).collect() };
        plans.extend(forms.into_iter().map(|form| plan(&scene, form).unwrap()));
    }
    plans
}

#[test]
fn frames_without_polygons_have_nothing_of_them() {
    for plan in plans(&settings()) {
        let found = traces(&plan);
        assert!(found.is_empty(), "{}: {found:?}", plan.method.name);
    }
}

#[test]
fn what_there_is_of_polygons_is_seen() {
    let box_shape = Some("box".to_owned());
    let mesh = |opacity| MeshSettings { builtin: box_shape.clone(), opacity, scale: 0.6, ..MeshSettings::default() };
    let mut all = settings();
    all.meshes = vec![mesh(0.5), mesh(1.0)];
    all.clips = vec![ClipSettings { builtin: box_shape.clone(), keep: Keep::Outside, ..ClipSettings::default() }];
    all.camera.eye = [0.0, 0.0, 0.3];
    (all.layers.most, all.layers.partial) = (2, PartialSegments::Apart);
    let mut found: BTreeSet<String> = plans(&all).iter().flat_map(traces).collect();
    let mut first = all.clone();
    first.clips[0].keep = Keep::Thesis;
    found.extend(plans(&first).iter().flat_map(traces));
    for define in DEFINES.iter().filter(|define| **define != "LAYERS") {
        assert!(found.contains(*define), "{define} is not among {found:?}");
    }
    for name in NAMES {
        assert!(found.contains(name) || found.contains(&format!("{name} in code")), "{name} is not among {found:?}");
    }
}
