//! What a shader takes, and what the compiler of the build script, of the program and of `--glsl DIR` says about broken ones.

#[path = "glsl/folder.rs"]
mod folder;

use std::fs;
use std::path::Path;

use depthleap::error::ErrorKind;
use depthleap::glsl::compile::compile;
use depthleap::glsl::source::{Broken, Source, Text};
use depthleap::glsl::takes::Takes;
use depthleap::glsl::{self, Shader};
use folder::{alter, copy, files};

#[test]
fn files_of_the_program_are_those_of_the_folder() {
    let names: Vec<String> = files(Path::new("glsl")).iter().map(|file| file.to_str().unwrap().to_owned()).collect();
    let built_in = glsl::built_in();
    let mut found = built_in.files().unwrap();
    assert!(found.is_sorted());
    let mut expected = names.clone();
    expected.sort();
    found.sort();
    assert_eq!(found, expected);
    for file in built_in.shaders().unwrap() {
        let (here, there) = (built_in.text(&file).unwrap(), Source::Folder("glsl".into()).text(&file).unwrap());
        assert_eq!(here.parts, there.parts, "{file}");
    }
    // One file of each kind, known by heart, so that an empty list cannot pass.
    let shaders = built_in.shaders().unwrap();
    for known in ["box.vert", "entry.frag", "main_pass.frag", "structure/cell_range.comp"] {
        assert!(shaders.iter().any(|file| file == known), "{known}");
    }
    assert!(!shaders.iter().any(|file| file.starts_with("shared/")), "{shaders:?}");
}

#[test]
fn name_follows_from_file_and_sorted_defines() {
    assert_eq!(Shader::new("box.vert", []).to_string(), "box.vert");
    let one = Shader::new("fused.frag", ["MARK_COPY", "DENSE", "CULL_DISCARD"]);
    let same = Shader::new("fused.frag", ["CULL_DISCARD", "MARK_COPY", "DENSE", "DENSE"]);
    assert_eq!(one, same);
    assert_eq!(one.to_string(), "fused.frag:CULL_DISCARD+DENSE+MARK_COPY");
}

#[test]
fn unknown_file_names_the_nearest() {
    for (wrong, near) in [
        ("main_pas.frag", "main_pass.frag"),
        ("near_neighbour.frag", "near_neighbor.frag"),
        ("structure/cell_ranges.comp", "structure/cell_range.comp"),
        ("entry", "entry.frag"),
    ] {
        let error = glsl::module(&Shader::new(wrong, [])).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Usage);
        assert_eq!(error.to_string(), format!("shader {wrong}: there is no such file; did you mean `{near}`?"));
    }
}

#[test]
fn defines_that_a_shader_does_not_take_are_refused() {
    for (file, defines, says) in [
        (
            "clip_begin.frag",
            &["HOLES"][..],
            "glsl/clip_begin.frag:1:1: the define `HOLES` is asked for, and this shader takes no define",
        ),
        (
            "main_pass.frag",
            &["HOLE"],
            "`HOLE` is asked for, and this shader takes [CULL_DISCARD], [HOLES | PREINTEGRATED]",
        ),
        ("main_pass.frag", &["HOLES", "PREINTEGRATED"], "HOLES and PREINTEGRATED are asked for together"),
        ("termination.frag", &[], "one of MARK_COPY | MARK_FRAGDEPTH | MARK_FRAGDEPTH_ANY is needed"),
        ("fused.frag", &["MARK_COPY", "MARK_NONE"], "MARK_COPY and MARK_NONE are asked for together"),
        ("probe/probe.frag", &["DEPTH"], "`DEPTH` is asked for"),
    ] {
        let error = glsl::module(&Shader::new(file, defines.iter().copied())).unwrap_err();
        assert_eq!(error.kind, ErrorKind::Input, "{error}");
        assert!(error.to_string().contains(says), "{error}");
    }
    // The place is that of the line that says what the shader takes.
    let line = fs::read_to_string("glsl/main_pass.frag").unwrap();
    let line = line.lines().position(|line| line.starts_with("//@takes")).unwrap() + 1;
    let error = glsl::module(&Shader::new("main_pass.frag", ["HOLE"])).unwrap_err().to_string();
    assert!(error.contains(&format!("glsl/main_pass.frag:{line}:1:")), "{error}");
}

/// The text of a folder with one shader, `a.comp`.
fn alone(text: &str) -> Text {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.comp"), text).unwrap();
    Source::Folder(folder.path().to_owned()).text("a.comp").unwrap()
}

#[test]
fn lines_that_say_what_a_shader_takes_are_checked() {
    for (line, says) in [
        ("//@take A", "is not a known line"),
        ("//@variant plain", "is not a known line"),
        ("//@unoptimised for now", "is not a known line"),
        ("//@takes A,, B", "`` is not a define"),
        ("//@takes A-B", "`A-B` is not a define"),
        ("//@takes A=", "`A=` is not a define"),
        ("//@takes 3D", "`3D` is not a define"),
        ("//@takes [A | B", "the bracket of `[A | B` is not closed"),
        ("//@takes A | B, [A]", "`A` is there twice"),
        ("//@takes A | A", "`A` is there twice"),
        ("//@takes A\n//@takes [A]", "a.comp:3:1: `A` is there twice"),
    ] {
        let text = alone(&format!("// First.\n{line}\n"));
        let broken = Takes::of(&text).unwrap_err();
        assert!(broken.text.contains("a.comp:2:1:") || says.contains("a.comp:3:1:"), "{broken}");
        assert!(broken.text.contains(says), "{broken}");
    }
}

#[test]
fn choices_are_made_once_or_left_open() {
    let text = alone("//@takes A | B, [C | D=2]\n//@takes [E]\n");
    let takes = Takes::of(&text).unwrap();
    assert_eq!(takes.plain(), ["A"]);
    assert_eq!(takes.defines().collect::<Vec<_>>(), ["A", "B", "C", "D=2", "E"]);
    for right in [&["A"][..], &["B", "C"], &["B", "D=2", "E"]] {
        takes.check(&text, right).unwrap();
    }
    for wrong in [&[][..], &["C"], &["A", "B"], &["A", "C", "D=2"], &["A", "D"], &["A", "D=3"], &["A", "F"]] {
        takes.check(&text, wrong).unwrap_err();
    }
}

#[test]
fn defines_have_their_values() {
    let text = alone(
        "#version 460\n//@takes [SIZE=2 | SIZE=3], [FLAG]\n#ifdef FLAG\n#error SIZE is set\n#endif\n\
         #if SIZE != 3\n#error not three\n#endif\nvoid main() {}\n",
    );
    assert!(compile(&text, &["SIZE=3"]).is_ok());
    let says = |defines: &[&str]| compile(&text, defines).map(|_| ()).unwrap_err().text;
    assert!(says(&["SIZE=2"]).contains("a.comp:7:"), "{}", says(&["SIZE=2"]));
    assert!(says(&["SIZE=3", "FLAG"]).contains("a.comp:4:"), "{}", says(&["SIZE=3", "FLAG"]));
}

fn compiled(root: &Path, file: &str, defines: &[&str]) -> Result<Vec<u32>, Broken> {
    compile(&Source::Folder(root.to_owned()).text(file)?, defines).map(|compiled| compiled.words)
}

#[test]
fn compiler_gives_the_words_of_the_program() {
    for (file, defines) in [("entry.frag", &[][..]), ("main_pass.frag", &["HOLES"]), ("structure/cell_range.comp", &[])]
    {
        let words = compiled(Path::new("glsl"), file, defines).unwrap();
        // The first word of SPIR-V.
        assert_eq!(words[0], 0x0723_0203, "{file}");
        assert_eq!(words, *glsl::module(&Shader::new(file, defines.iter().copied())).unwrap(), "{file}");
    }
}

#[test]
fn fault_in_a_shader_is_placed_by_file_line_and_column() {
    let copy = copy();
    let line = alter(copy.path(), "main_pass.frag", "vec4 segment = no_sample();", "vec4 segment = vec4(nothing);");
    let text = compiled(copy.path(), "main_pass.frag", &[]).unwrap_err().text;
    let file = copy.path().join("main_pass.frag");
    // The column is that of the word that is not known.
    assert!(text.contains(&format!("{}:{line}:25:", file.display())), "{text}");
    assert!(text.contains("'nothing'"), "{text}");
    assert!(text.contains("    vec4 segment = vec4(nothing);\n"), "the line itself is shown:\n{text}");
}

#[test]
fn fault_in_an_included_file_is_placed_there() {
    let copy = copy();
    let line = alter(copy.path(), "shared/opacity.glsl", "float s = x / (2.0 + x);", "float s = x / (2.0 + why);");
    let broken = compiled(copy.path(), "main_pass.frag", &[]).unwrap_err();
    let file = copy.path().join("shared/opacity.glsl");
    assert!(broken.text.contains(&format!("{}:{line}:", file.display())), "{}", broken.text);
    assert_eq!(broken.place, copy.path().join("main_pass.frag").display().to_string(), "the shader that includes it");
}

#[test]
fn missing_include_is_named() {
    let copy = copy();
    alter(copy.path(), "main_pass.frag", "shared/opacity.glsl", "shared/opacities.glsl");
    let text = compiled(copy.path(), "main_pass.frag", &[]).unwrap_err().text;
    assert!(text.contains("opacities.glsl") && text.contains("include paths count from"), "{text}");
}
