//! The house: imports point one way, from a folder to those it stands on, and nowhere in a circle, not inside a folder
//! either.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Folders and files at the top of `src`, each with all it may import; what is not named here is not there.
const MAY_IMPORT: [(&str, &str); 27] = [
    ("error", ""),
    ("cache", ""),
    ("math", ""),
    ("provenance", "error"),
    ("scene", "error math"),
    ("read", "error math scene"),
    ("projection", "error math scene"),
    ("structure", "error math scene projection"),
    ("glsl", "error cache"),
    ("vulkan", "error math"),
    ("truth", "error math scene projection"),
    ("twin", "error math scene projection structure truth"),
    ("shared", "error math scene projection structure truth"),
    ("probe", "error cache provenance glsl vulkan"),
    ("part", "error math scene projection structure glsl vulkan truth twin shared"),
    ("resource", "error math scene projection structure vulkan truth shared part"),
    ("geometry", "math scene part resource"),
    ("feature", "error math scene projection structure glsl vulkan truth twin shared part resource"),
    ("pass", "error math scene projection structure glsl vulkan truth twin shared part resource geometry feature"),
    (
        "method",
        "error math scene projection structure glsl vulkan truth twin shared part resource geometry feature pass",
    ),
    ("auto", "error math scene projection structure truth part feature method plan frame"),
    (
        "plan",
        "error math scene projection structure glsl vulkan truth twin shared part resource geometry feature pass method",
    ),
    (
        "frame",
        "error math scene projection structure glsl vulkan truth twin shared part resource geometry feature pass method plan probe",
    ),
    (
        "measure",
        "error cache math scene projection structure glsl vulkan truth twin shared part resource geometry feature pass method auto plan frame \
         provenance",
    ),
    ("report", "error math scene provenance auto measure"),
    (
        "experiment",
        "error math scene projection read structure glsl vulkan truth twin shared part resource pass method auto plan frame probe provenance \
         measure report",
    ),
    (
        "cli",
        "error math scene projection read structure glsl vulkan truth twin shared part resource pass method auto plan frame probe provenance \
         measure report experiment",
    ),
];

/// Modules by their paths (`measure::record`), each with its text.
type Modules = BTreeMap<String, String>;

/// The modules of `src`, without the program's and the library's heads.
fn modules() -> Modules {
    let mut modules = Modules::new();
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
    let root = folders[0].clone();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(&root).unwrap().with_extension("");
            let name = name.to_str().unwrap().replace(std::path::MAIN_SEPARATOR, "::");
            let name = name.strip_suffix("::mod").unwrap_or(&name).to_owned();
            if !["lib", "main"].contains(&name.as_str()) {
                modules.insert(name, std::fs::read_to_string(&path).unwrap());
            }
        }
    }
    modules
}

/// The code of a file without comments, on one line.
fn code(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or_default().trim()).collect::<Vec<_>>().join(" ")
}

/// Paths that begin with `crate` or `super`, groups in braces taken apart: `crate::a::{b, c::d}` is two.
fn paths(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (begin, _) in
        code.match_indices("crate::").chain(code.match_indices("super::")).chain(code.match_indices("self::"))
    {
        let before = code[..begin].chars().next_back();
        if !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':' || c == '$') {
            expand("", &code[begin..], &mut found);
        }
    }
    found
}

/// Adds the paths at the begin of `rest` to `found`; gives how many bytes they took.
fn expand(prefix: &str, rest: &str, found: &mut Vec<String>) -> usize {
    let head = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).unwrap_or(rest.len());
    let path = format!("{prefix}{}", &rest[..head]);
    if !rest[head..].starts_with('{') || !path.ends_with("::") {
        found.push(path);
        return head;
    }
    let mut at = head + 1;
    while at < rest.len() && !rest[at..].starts_with('}') {
        if rest[at..].starts_with([' ', ',']) {
            at += 1;
            continue;
        }
        at += expand(&path, &rest[at..], found);
        // What follows a name and is neither a comma nor an end: `as other`, or code that is no import.
        at += rest[at..].find([',', '}']).unwrap_or(rest.len() - at);
    }
    (at + 1).min(rest.len())
}

/// The module that a path of `module` leads to.
fn leads_to(modules: &Modules, module: &str, path: &str) -> Option<String> {
    let mut parts: Vec<&str> = path.split("::").filter(|part| !part.is_empty()).collect();
    let mut base: Vec<&str> = match parts[0] {
        "crate" => Vec::new(),
        _ => module.split("::").collect(),
    };
    while parts.first().is_some_and(|part| ["crate", "super", "self"].contains(part)) {
        if parts.remove(0) == "super" {
            base.pop();
        }
    }
    base.extend(parts);
    while !base.is_empty() {
        let name = base.join("::");
        if modules.contains_key(&name) {
            return (name != module).then_some(name);
        }
        base.pop();
    }
    None
}

/// What each module imports. A folder's head is what its files stand in, not what they import.
fn imports(modules: &Modules) -> BTreeMap<&str, BTreeSet<String>> {
    let of = |(module, text): (&'_ String, &String)| -> BTreeSet<String> {
        paths(&code(text)).iter().filter_map(|path| leads_to(modules, module, path)).collect()
    };
    modules.iter().map(|entry| (entry.0.as_str(), of(entry))).collect()
}

/// Imports that go where they may not, in words.
fn wrong(modules: &Modules) -> Vec<String> {
    let top = |module: &str| module.split("::").next().unwrap_or_default().to_owned();
    let mut wrong = Vec::new();
    for (module, imported) in imports(modules) {
        let Some((_, may)) = MAY_IMPORT.iter().find(|(name, _)| *name == top(module)) else {
            wrong.push(format!("{module} stands in no room of the house"));
            continue;
        };
        for other in imported {
            let allowed = top(module) == top(&other) || may.split_whitespace().any(|name| name == top(&other));
            wrong.extend((!allowed).then(|| format!("{module} imports {other}")));
        }
    }
    wrong
}

/// A circle of imports, if there is one.
fn circle(modules: &Modules) -> Option<Vec<String>> {
    let imports = imports(modules);
    let mut done = BTreeSet::new();
    for begin in imports.keys() {
        let mut way = Vec::new();
        if let Some(found) = walk(begin, &imports, &mut way, &mut done) {
            return Some(found);
        }
    }
    None
}

fn walk(
    module: &str,
    imports: &BTreeMap<&str, BTreeSet<String>>,
    way: &mut Vec<String>,
    done: &mut BTreeSet<String>,
) -> Option<Vec<String>> {
    if let Some(at) = way.iter().position(|before| before == module) {
        return Some(way[at..].to_vec());
    }
    if !done.insert(module.to_owned()) {
        return None;
    }
    way.push(module.to_owned());
    let found = imports[module].iter().find_map(|other| walk(other, imports, way, done));
    way.pop();
    found
}

#[test]
fn imports_point_one_way() {
    let wrong = wrong(&modules());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_imports_go_in_a_circle() {
    let circle = circle(&modules());
    assert!(circle.is_none(), "{}", circle.unwrap_or_default().join(" -> "));
}

/// Modules of a made-up house.
fn made(files: &[(&str, &str)]) -> Modules {
    files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect()
}

#[test]
fn a_wrong_import_and_a_circle_are_seen() {
    let mut files = vec![
        ("error", ""),
        ("scene", "pub mod view;"),
        ("scene::view", "use crate::error::{self, Error};"),
        ("vulkan::image", "use crate::error::Error;"),
    ];
    assert_eq!((wrong(&made(&files)), circle(&made(&files))), (vec![], None));
    files.push(("vulkan::queue", "use crate::{error::Error,\n    scene::view::{View as Other}};"));
    assert_eq!(wrong(&made(&files)), ["vulkan::queue imports scene::view"]);
    files.push(("attic::box", ""));
    assert!(wrong(&made(&files)).contains(&"attic::box stands in no room of the house".to_owned()));
    files.push(("structure::cells", "let one = super::blocks::SIDE; // use crate::cli::Plan;"));
    assert_eq!(circle(&made(&files)), None);
    files.push(("structure::blocks", "use super::grid::{Grid};"));
    files.push(("structure::grid", "fn f() -> crate::structure::cells::Cells"));
    assert_eq!(circle(&made(&files)).unwrap(), ["structure::blocks", "structure::grid", "structure::cells"]);
}
