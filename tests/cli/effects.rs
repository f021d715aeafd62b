//! What the command line says of effects before it looks for a device.

use crate::driverless;

const SAME: &str = "vec4 effect(Sample here) { return here.color; }";

const RENDER: &str = "render builtin:shells:12 --viewport 12x8 -o a.png --method";

#[test]
fn files_that_cannot_be_effects_are_refused() {
    let place = driverless();
    place.file("empty.glsl", "");
    place.file("latin.glsl", b"vec4 effect(Sample here) { return here.color; } // gr\xfcn");
    place.file("include.glsl", "\n#include \"shared/ray.glsl\"\n");
    place.file("mine.glsl", format!("layout(binding = 50) uniform sampler2D mine;\n{SAME}"));
    std::fs::create_dir(place.path().join("folder.glsl")).unwrap();
    let refused = |file: &str, code: i32, parts: &[&str]| {
        place.refused(&format!("{RENDER} single-pass --effect {file}"), code, parts);
        place.refused(&format!("bench builtin:shells:12 --method single-pass --effect {file} -o out"), code, parts);
    };
    refused("no.glsl", 3, &["no.glsl", "cannot be read"]);
    refused("folder.glsl", 3, &["folder.glsl", "not a regular file"]);
    refused("empty.glsl", 3, &["empty.glsl", "holds no code", "vec4 effect(Sample here)"]);
    refused("latin.glsl", 3, &["latin.glsl", "not UTF-8", "byte 53"]);
    refused("include.glsl", 3, &["include.glsl:2", "`#include`", "one file"]);
    refused("mine.glsl", 3, &["mine.glsl:1", "`layout`", "bindings"]);
    refused("-", 2, &["--effect -", "standard input", "path of a file"]);
}

#[test]
fn what_takes_no_effect_says_so() {
    let place = driverless();
    place.file("tint.glsl", SAME);
    place.refused(&format!("{RENDER} cpu --effect tint.glsl"), 2, &["cpu", "tint.glsl", "--method single-pass"]);
    let plan = "plan builtin:shells:12 --effect tint.glsl --method";
    place.refused(&format!("{plan} nn-omni"), 2, &["--method nn-omni", "takes no effect", "--method single-pass"]);
    place.refused(&format!("{plan} single-pass --projection mip"), 2, &["mip", "--effect tint.glsl"]);
    place.refused(&format!("{plan} single-pass --effect-limit 0"), 2, &["--effect-limit", "from 0.01 to 86400"]);
    let accuracy = "accuracy builtin:shells:12 --method single-pass --effect tint.glsl -o out";
    place.refused(accuracy, 2, &["--effect", "tint.glsl", "no exact integral"]);
}

#[test]
fn plans_name_the_effect() {
    let place = driverless();
    std::fs::create_dir(place.path().join("sub")).unwrap();
    place.file("sub/tint.glsl", SAME);
    // Relative to the scene file.
    place.file("sub/a.toml", "[volume]\nbuiltin = \"shells:12\"\n[effects]\nfile = \"tint.glsl\"\n");
    let text = place.done("plan sub/a.toml --method single-pass --json -").text();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["scene"], "shells:12 with the effect tint, ramp");
    assert!(
        json["steps"]
            .as_array()
            .unwrap()
            .iter()
            .any(|step| step["shader"] == "single_pass.frag:EFFECT+FEW_PIECES+SINGLE_RAYS"),
        "{json}"
    );
    assert!(json["texture"]["pixel_error"].is_number() || json["texture"]["pixel_error"].is_null());
    let help = place.done("render --help").text();
    assert!(help.contains("--effect <FILE>") && help.contains("vec4 effect(Sample here)"), "{help}");
}
