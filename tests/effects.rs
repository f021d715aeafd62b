//! A user's effect: what its file may hold, how it becomes a part of shaders, where the compiler's messages point, and what plans and
//! settings know of it. Needs no device.

use std::sync::Arc;

use depthleap::error::{Error, ErrorKind};
use depthleap::feature::EFFECT;
use depthleap::glsl::cache::{Cache, CacheKey};
use depthleap::glsl::library::Library;
use depthleap::glsl::{Insert, Shader, built_in};
use depthleap::method::{METHODS, SINGLE_PASS, SINGLE_PASS_OMNI};
use depthleap::part::rows::Method;
use depthleap::plan::{Plan, plan, warnings};
use depthleap::projection::PROJECTIONS;
use depthleap::read;
use depthleap::scene::effect::{MOST_BYTES, SIGNATURE};
use depthleap::scene::settings::{Classification, Settings, Shows};
use depthleap::scene::{Effect, Scene};

const SAME: &str = "vec4 effect(Sample here) { return here.color; }";

/// A shader with an effect of that text.
fn shader(file: &'static str, defines: &[&'static str], text: &str) -> Shader {
    let insert = Insert { name: "my/tint.glsl".to_owned(), text: text.to_owned(), defines: SIGNATURE };
    let defines = defines.iter().copied().chain(["EFFECT"]);
    Shader { insert: Some(Arc::new(insert)), ..Shader::new(file, defines) }
}

/// What comes of compiling it, as a fragment shader and as a compute shader.
fn compiled(text: &str) -> Result<(), Error> {
    let folder = tempfile::tempdir().unwrap();
    let library = Library::new(built_in(), Cache::at(folder.path().to_owned()));
    library.module(&shader("single_pass.frag", &[], text))?;
    library.module(&shader("single_pass.comp", &["RGBA32F"], text)).map(drop)
}

fn refused(text: &str, parts: &[&str]) {
    let error = compiled(text).expect_err(text);
    assert_eq!((error.kind, error.input.as_str()), (ErrorKind::Input, "my/tint.glsl"), "{error}");
    let said = error.to_string();
    for part in parts {
        assert!(said.contains(part), "no `{part}` in: {said}");
    }
}

#[test]
fn everything_that_the_header_tells_can_be_used() {
    compiled(SAME).unwrap();
    compiled(
        "float strength = 0.5;\n\
         vec3 helper(Sample here) { return sample_normal(here) + sample_gradient(here) * strength; }\n\
         vec4 effect(Sample here) {\n\
             vec3 sum = helper(here) + here.position + here.coordinate + here.direction + here.eye + here.extent;\n\
             sum += here.place.below + here.place.weight + vec3(here.pixel, here.surface);\n\
             return vec4(sum, here.color.a * (here.value + here.x + here.way + here.spacing));\n\
         }",
    )
    .unwrap();
}

/// It stands behind all else, so that what it defines has no meaning there.
#[test]
fn macros_do_not_reach_the_programs_own_text() {
    compiled(&format!("#define ray nothing\n#define frame nothing\n#define gathered 3\n{SAME}")).unwrap();
}

#[test]
fn messages_name_the_users_file_and_line() {
    refused(
        "// One.\nvec4 effect(Sample here) {\n    return nothing;\n}\n",
        &["my/tint.glsl:3:12:", "'nothing'", "    return nothing;"],
    );
    refused("vec4 effect(Sample here) {\n    return here.colour;\n}", &["my/tint.glsl:2:", "colour"]);
    refused("vec4 effect(Sample here) {\n    return here.color\n}", &["my/tint.glsl:3:"]);
    refused("vec4 effect(Sample here) {\n    return here.color;\n", &["my/tint.glsl:"]);
    refused(
        &format!("int composite(int a) {{ return a; }}\n\nfloat x_of(float value) {{ return 1.0; }}\n{SAME}"),
        &["my/tint.glsl:3:"],
    );
    refused("vec3 effect(Sample here) {\n    return here.color.rgb;\n}", &["my/tint.glsl:1:"]);
}

#[test]
fn a_file_without_the_function_is_told_what_to_define() {
    for text in ["float helper() { return 1.0; }", "vec4 effect(vec3 place) { return vec4(place, 1.0); }"] {
        refused(text, &["does not define `vec4 effect(Sample here)`", "glsl/shared/effect.glsl"]);
    }
}

#[test]
fn shaders_without_an_effect_know_nothing_of_it() {
    let library = Library::new(built_in(), Cache::at(tempfile::tempdir().unwrap().path().to_owned()));
    let words = library.module(&Shader::new("single_pass.frag", [])).unwrap();
    let mut with = shader("single_pass.frag", &[], SAME);
    with.defines.clear();
    assert_eq!(words, library.module(&with).unwrap());
}

#[test]
fn another_text_is_another_module() {
    let text = built_in().text("single_pass.frag").unwrap();
    let key = |effect: &str| {
        let insert = shader("single_pass.frag", &[], effect).insert.unwrap();
        CacheKey::of(&text.clone().with(Some(&insert)), &["EFFECT"])
    };
    assert_eq!(key(SAME), key(SAME));
    assert_ne!(key(SAME), key(&format!("{SAME} ")));
    assert_ne!(shader("a.frag", &[], SAME), shader("a.frag", &[], "other"), "pipelines are told apart too");
}

#[test]
fn what_no_effect_may_have_is_placed() {
    for (text, says) in [
        ("", "holds no code"),
        (" \n// Nothing.\n/* and\nnothing */", "holds no code"),
        ("\n#include \"shared/ray.glsl\"\n", "e.glsl:2: has `#include`"),
        ("#version 460\n", "e.glsl:1: has `#version`"),
        ("/* One.\nTwo. */ layout(binding = 40) uniform sampler2D mine;", "e.glsl:2: has `layout`"),
        ("\n\nuniform sampler2D mine;", "e.glsl:3: has `uniform`"),
        ("shared vec4 all[8];", "e.glsl:1: has `shared`"),
        ("vec4 effect(Sample here) {\n  discard;\n}", "e.glsl:2: has `discard`"),
        ("void main() {}", "e.glsl:1: has `main`"),
        ("vec4 \0", "e.glsl:1: holds a zero byte"),
    ] {
        let error = Effect::new("e.glsl", text).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Input);
        assert!(error.to_string().contains(says), "{error}");
    }
    let large = format!("{SAME}{}", " ".repeat(MOST_BYTES));
    assert!(Effect::new("e.glsl", &large).unwrap_err().to_string().contains("bytes"));
    // Words that only hold one of these, and comments, are nobody's business.
    Effect::new("e.glsl", "float layouts; // uniform, discard\nfloat remain; /* main */").unwrap();
}

#[test]
fn a_hash_tells_texts_apart() {
    let effect = Effect::new("a/b/tint.glsl", "abc").unwrap();
    // Of FIPS 180-2, B.1.
    assert_eq!(effect.hash, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    assert_eq!((effect.file(), effect.words()), ("tint.glsl", "tint.glsl (SHA-256 ba7816bf8f01)".to_owned()));
}

fn scene(change: impl FnOnce(&mut Settings)) -> Scene {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:16".to_owned());
    settings.image.size = [24, 18];
    settings.method.name = SINGLE_PASS.name();
    change(&mut settings);
    let mut scene = read::scene(&settings).unwrap();
    scene.effect = Some(Arc::new(Effect::new("tint.glsl", SAME).unwrap()));
    scene
}

fn by(method: &Method) -> Result<Plan, Error> {
    plan(&scene(|s| s.method.name = method.name()), method.papers)
}

#[test]
fn loops_take_effects_and_other_methods_refuse_them() {
    for method in METHODS.into_iter().filter(|method| !method.goes_through_cells()) {
        match by(method) {
            Ok(plan) => {
                let shaders = plan.steps.iter().filter_map(|step| step.work.shader());
                let with = shaders.filter(|shader| shader.defines.contains("EFFECT") && shader.insert.is_some());
                assert_eq!((with.count(), method.loops()), (1, true), "{}", method.name);
                assert!(plan.left_out.iter().all(|left| left.what != EFFECT.name));
                assert!(plan.pixel_error == 0.0 || plan.pixel_error.is_infinite());
            }
            Err(error) => {
                assert!(!method.loops(), "{error}");
                let said = error.to_string();
                assert!(
                    said.contains(method.name) && said.contains("tint.glsl") && said.contains("single-pass"),
                    "{said}"
                );
            }
        }
    }
    let mut without = scene(|_| {});
    without.effect = None;
    // What no scene has but by the user's wish is not told of those without.
    let left = plan(&without, None).unwrap().left_out;
    assert!(left.iter().all(|left| left.what != EFFECT.name), "{left:?}");
}

#[test]
fn what_has_no_colours_of_samples_is_refused() {
    let error = |scene: &Scene| plan(scene, None).unwrap_err().to_string();
    for row in PROJECTIONS.into_iter().filter(|row| row.shows_values()) {
        let said = error(&scene(|s| s.projection.kind = row.name()));
        assert!(said.contains(row.name) && said.contains("--effect tint.glsl"), "{said}");
    }
    let said = error(&scene(|s| s.sampling.classification = Classification::PreIntegrated));
    assert!(said.contains("pre-integrated") && said.contains("post"), "{said}");
    let said = error(&scene(|s| (s.surface.iso, s.surface.shows) = (Some(90.0), Shows::Normal)));
    assert!(said.contains("surface.shows"), "{said}");
}

/// An effect may raise opacities, so that rays end that would not without.
#[test]
fn rays_may_end_by_what_an_effect_makes_of_opacities() {
    let ends = |effect: bool| {
        let mut scene = scene(|s| s.transfer.preset = Some("haze".to_owned()));
        scene.effect = scene.effect.filter(|_| effect);
        let plan = plan(&scene, None).unwrap();
        plan.left_out.iter().all(|left| left.what != "early ends of rays")
    };
    assert_eq!((ends(false), ends(true)), (false, true));
}

#[test]
fn distances_are_those_without_an_effect() {
    let with = by(&SINGLE_PASS_OMNI).unwrap();
    assert!(with.distance.is_some(), "an effect shows nothing that the transfer function does not");
}

#[test]
fn settings_note_the_hash_and_another_text_is_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("tint.glsl");
    std::fs::write(&file, SAME).unwrap();
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:16".to_owned());
    settings.method.name = SINGLE_PASS.name();
    settings.effects.file = Some(file.clone());
    let said = |settings: &Settings| {
        let scene = read::scene(settings).unwrap();
        let said = warnings(&scene, &plan(&scene, None).unwrap());
        (scene.settings, said.into_iter().filter(|warning| warning.contains("effect")).collect::<Vec<_>>())
    };
    let (first, none) = said(&settings);
    assert_eq!((first.effects.hash.as_ref().map(String::len), none.len()), (Some(64), 0));
    let (second, none) = said(&first);
    assert_eq!((&second, none.len()), (&first, 0));
    std::fs::write(&file, format!("{SAME}\n")).unwrap();
    let (third, one) = said(&first);
    assert!(one.len() == 1 && one[0].contains("tint.glsl (SHA-256") && one[0].contains("another one"), "{one:?}");
    assert_ne!(third.effects.hash, first.effects.hash, "a run notes what it was made with");
}
