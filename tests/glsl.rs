//! The table of shaders, and what the compiler of the build script and of `--glsl DIR` says about broken ones.

// All of it is used by the build script and, with `runtime-shaders`, by the program.
#[allow(dead_code)]
#[path = "../src/glsl/compile.rs"]
mod compile;

#[path = "glsl/folder.rs"]
mod folder;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use depthleap::error::Kind;
use depthleap::glsl;
use folder::{alter, copy, files};

/// Module names, from the files as they stand: one for each `//@variant` line, twice as many after each `//@also` line, one
/// for a file without any.
fn expected_names() -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for file in files(Path::new("glsl")) {
        let stage = file.extension().and_then(|ending| ending.to_str());
        if file.starts_with("shared") || !matches!(stage, Some("vert" | "frag" | "comp")) {
            continue;
        }
        let (name, text) = (file.to_str().unwrap(), fs::read_to_string(Path::new("glsl").join(&file)).unwrap());
        let variants = text.lines().filter_map(|line| line.strip_prefix("//@variant ")?.split(' ').next());
        let mut variants: Vec<String> = variants.map(|variant| format!("{name}:{variant}")).collect();
        for also in text.lines().filter_map(|line| line.strip_prefix("//@also ")?.split(' ').next()) {
            variants.extend(variants.clone().into_iter().map(|variant| format!("{variant}+{also}")));
        }
        match variants.is_empty() {
            true => names.extend([name.to_owned()]),
            false => names.extend(variants),
        }
    }
    names
}

#[test]
fn names_list_every_shader_with_its_variants() {
    let (found, expected): (BTreeSet<String>, _) = (glsl::names().map(str::to_owned).collect(), expected_names());
    assert_eq!(found, expected);
    // One file of each kind, known by heart, so that an empty list cannot pass.
    for known in ["box.vert", "entry.frag", "main_pass.frag:discard+holes", "structure/cell_range.comp"] {
        assert!(found.contains(known), "{known}");
    }
    assert!(!found.contains("main_pass.frag"), "with variants there is no plain module");
}

#[test]
fn names_are_sorted_and_each_has_its_module() {
    let names: Vec<_> = glsl::names().collect();
    assert!(names.is_sorted());
    for name in names {
        // The first word of SPIR-V.
        assert_eq!(glsl::module(name).unwrap()[0], 0x0723_0203, "{name}");
    }
}

#[test]
fn unknown_name_names_the_nearest() {
    for (wrong, near) in [
        ("main_pass.frag:plane", "main_pass.frag:plain"),
        ("near_neighbour.frag:copy", "near_neighbor.frag:copy"),
        ("structure/cell_ranges.comp", "structure/cell_range.comp"),
        ("entry", "entry.frag"),
    ] {
        let error = glsl::module(wrong).unwrap_err();
        assert_eq!(error.kind, Kind::Usage);
        assert_eq!(error.to_string(), format!("shader {wrong}: there is no such module; did you mean `{near}`?"));
    }
}

fn compiled(root: &Path, name: &str) -> Result<Vec<u32>, compile::Broken> {
    let modules = compile::modules(root)?;
    let module = modules.into_iter().find(|module| module.name == name).unwrap();
    compile::compile(root, &module).map(|compiled| compiled.words)
}

#[test]
fn compiler_gives_the_words_of_the_table() {
    for name in ["entry.frag", "main_pass.frag:holes", "structure/cell_range.comp"] {
        assert_eq!(compiled(Path::new("glsl"), name).unwrap(), *glsl::module(name).unwrap(), "{name}");
    }
}

#[test]
fn fault_in_a_shader_is_placed_by_file_line_and_column() {
    let copy = copy();
    let line = alter(copy.path(), "main_pass.frag", "vec4 segment = vec4(0.0);", "vec4 segment = vec4(nothing);");
    let text = compiled(copy.path(), "main_pass.frag:plain").unwrap_err().text;
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
    let broken = compiled(copy.path(), "main_pass.frag:plain").unwrap_err();
    let file = copy.path().join("shared/opacity.glsl");
    assert!(broken.text.contains(&format!("{}:{line}:", file.display())), "{}", broken.text);
    assert_eq!(broken.place, copy.path().join("main_pass.frag").display().to_string(), "the shader that includes it");
}

#[test]
fn missing_include_is_named() {
    let copy = copy();
    alter(copy.path(), "main_pass.frag", "shared/opacity.glsl", "shared/opacities.glsl");
    let text = compiled(copy.path(), "main_pass.frag:plain").unwrap_err().text;
    assert!(text.contains("opacities.glsl") && text.contains("include paths count from"), "{text}");
}

#[test]
fn variant_lines_are_checked() {
    let copy = copy();
    for (line, says) in [
        ("//@variants plain", "is not a known line"),
        ("//@also more", "there is no variant that `more` goes with"),
        ("//@variant", "this variant has no name"),
        ("//@variant holes", "the variant `holes` is there twice"),
    ] {
        let file = copy.path().join("main_pass.frag");
        let text = fs::read_to_string("glsl/main_pass.frag").unwrap();
        let number = text.lines().position(|l| l == "//@variant plain").unwrap() + 1;
        fs::write(&file, text.replace("//@variant plain", line)).unwrap();
        let broken = compile::modules(copy.path()).unwrap_err().text;
        // A variant that is there twice is found at its second line.
        let number = if line.ends_with("holes") { number + 1 } else { number };
        assert!(broken.starts_with(&format!("{}:{number}:1:", file.display())), "{broken}");
        assert!(broken.contains(says), "{broken}");
    }
}

#[test]
fn macros_of_a_variant_have_their_values() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.comp"), "//@variant two SIZE=2 FLAG\n//@variant none\n").unwrap();
    let modules = compile::modules(folder.path()).unwrap();
    let [none, two] = &modules[..] else { panic!("{modules:?}") };
    assert_eq!((none.name.as_str(), none.macros.len()), ("a.comp:none", 0));
    let macros = [("SIZE".to_owned(), Some("2".to_owned())), ("FLAG".to_owned(), None)];
    assert_eq!((two.name.as_str(), &two.macros[..]), ("a.comp:two", &macros[..]));
}
