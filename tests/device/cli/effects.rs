//! `--effect FILE`: what runs say of it, that they are repeated with it, and what an effect cannot do to them.

use std::sync::Arc;

use depthleap::vulkan::Device;

use super::SMALL;
use super::program::Place;
use crate::harness::{Need, Test, share, test};

pub fn tests() -> Vec<Test> {
    vec![
        test("an effect is named with its hash and repeated from a run", repeated).needs(Need::AnyDriver),
        test("an effect that does not compile ends the run at its own line", broken).needs(Need::AnyDriver),
        test("an effect that never ends is given up", endless),
        test("an effect that reads what is not there does no harm", beyond),
        test("benches name effects in their pages and have no error", benched).needs(Need::AnyDriver),
    ]
}

const TINT: &str = "vec4 effect(Sample here) { return here.color * vec4(1.0, 0.5, 0.25, 1.0); }";

fn repeated(_: &Arc<Device>) {
    let place = Place::new();
    place.file("tint.glsl", TINT);
    let loops = format!("render {SMALL} --method single-pass");
    place.done(&format!("{loops} -o plain.npy"));
    let ended = place.done(&format!("{loops} --effect tint.glsl --reference-error --json a.json -o a.npy"));
    assert!(ended.err.contains("effect tint.glsl (SHA-256"), "{}", ended.err);
    assert_ne!(place.read("plain.npy"), place.read("a.npy"));
    let run = place.json("a.json");
    assert_eq!(run["effect"]["file"], "tint.glsl");
    assert_eq!(run["effect"]["hash"], run["settings"]["effects"]["hash"]);
    assert!(run["error"].is_null() && run["notes"].to_string().contains("no error against the reference"), "{run}");
    let again = place.done("render --from a.json -o b.npy");
    assert!(!again.err.contains("warning"), "{}", again.err);
    assert_eq!(place.read("a.npy"), place.read("b.npy"));
    place.file("tint.glsl", TINT.replace("0.25", "0.75"));
    let other = place.done("render --from a.json -o c.npy --json c.json");
    assert!(
        other.err.contains("warning: ") && other.err.contains("another one than that of the settings"),
        "{}",
        other.err
    );
    assert_ne!(place.read("a.npy"), place.read("c.npy"), "nothing kept stands in for a text that was changed");
    assert_ne!(place.json("c.json")["effect"]["hash"], run["effect"]["hash"]);
    // One that is given anew is nobody's other.
    place.file("other.glsl", TINT);
    let new = place.done("render --from a.json --effect other.glsl -o d.npy");
    assert!(!new.err.contains("warning"), "{}", new.err);
    assert_eq!(place.read("a.npy"), place.read("d.npy"));
}

fn broken(_: &Arc<Device>) {
    let place = Place::new();
    place.file("typo.glsl", "// Too dark.\nvec4 effect(Sample here) {\n    return darker(here.color);\n}\n");
    place.file("without.glsl", "float helper() { return 1.0; }");
    for method in ["single-pass", "single-pass+compute"] {
        let refused = |file: &str, parts: &[&str]| {
            place.refused(&format!("render {SMALL} --method {method} --effect {file} -o a.png"), 3, parts);
        };
        refused("typo.glsl", &["typo.glsl:3:", "'darker'", "glsl/shared/effect.glsl"]);
        refused("without.glsl", &["without.glsl: does not define `vec4 effect(Sample here)`"]);
    }
}

/// Loops, of which drivers share what takes a program long to begin.
const LOOPS: [&str; 2] = ["single-pass", "single-pass+compute"];

/// Lavapipe ends loops itself after some ten thousand turns, all loops of a shader together; other drivers go on.
fn endless(_: &Arc<Device>) {
    let place = Place::new();
    let text = "vec4 effect(Sample here) {\n\
                    float sum = here.color.a;\n\
                    while (sum > 0.0) {\n\
                        while (sum > 0.0) {\n\
                            while (sum > 0.0) { sum = fract(sum * 1.37) + 0.1; }\n\
                        }\n\
                    }\n\
                    return vec4(here.color.rgb, sum);\n\
                }";
    place.file("endless.glsl", text);
    for method in share(LOOPS, 0) {
        let arguments = format!("render {SMALL} --method {method} --effect endless.glsl --effect-limit 1 -o a.png");
        let parts = ["frame: did not end within 1 s", "the last step begun", "endless.glsl", "--effect-limit"];
        let ended = place.run(&arguments);
        if ended.code == Some(0) {
            println!("{method}: this driver ends loops itself");
            continue;
        }
        assert_eq!(ended.code, Some(4), "{method}: {}", ended.err);
        assert!(parts.iter().all(|part| ended.err.contains(part)), "{method}: {}", ended.err);
    }
}

fn beyond(_: &Arc<Device>) {
    let place = Place::new();
    let text = "vec4 effect(Sample here) {\n\
                    float sum = 0.0;\n\
                    for (int i = 0; i < 8; ++i) {\n\
                        sum += texelFetch(volume, ivec3(here.pixel, 7) * 1000003 * (i - 4), 0).r;\n\
                        sum += transfer.rows[uint(here.pixel.x) * 100003u * uint(i + 1)].x;\n\
                    }\n\
                    return vec4(here.color.rgb, sum == -12345.0 ? 0.0 : here.color.a);\n\
                }";
    place.file("beyond.glsl", text);
    for method in share(LOOPS, 0) {
        place.done(&format!("render {SMALL} --validate --method {method} --effect beyond.glsl -o a.npy"));
        place.done(&format!("render {SMALL} --method {method} -o b.npy"));
        assert_eq!(place.read("a.npy"), place.read("b.npy"), "{method}");
    }
}

fn benched(_: &Arc<Device>) {
    let place = Place::new();
    place.file("tint.glsl", TINT);
    let methods = "single-pass,single-pass-omni,single-pass+compute";
    let ended = place.done(&format!("bench {SMALL} --method {methods} --effect tint.glsl --repeats 1 -o out")).text();
    assert!(ended.contains("effect tint.glsl (SHA-256"), "{ended}");
    let results = place.json("out/results.json");
    for run in results["runs"].as_array().unwrap() {
        assert!(run["error"].is_null() && run["effect"]["file"] == "tint.glsl", "{run}");
    }
    let report = String::from_utf8(place.read("out/report.html")).unwrap();
    assert!(report.contains("effect tint.glsl (SHA-256") && report.contains("does not run in f64"), "{report}");
}
