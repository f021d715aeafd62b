//! Plans as text, held by `tests/golden/plan_*.txt`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use depthleap::method::METHODS;
use depthleap::plan::Plan;

use crate::cases::cases;

const UPDATE: &str = "UPDATE_GOLDEN=1 cargo test --test plan";

/// Whether `text` is what the file holds. An update writes it, and fails all the same: somebody has to look.
fn held(file: &Path, text: &str, update: bool) -> Result<(), String> {
    let shown = file.display();
    if update {
        std::fs::write(file, text).map_err(|error| format!("{shown}: {error}"))?;
        return Err(format!("{shown} was written; look at its diff, then run the test without UPDATE_GOLDEN"));
    }
    let golden = std::fs::read_to_string(file).map_err(|error| format!("{shown}: {error}; `{UPDATE}` makes it"))?;
    if golden == text {
        return Ok(());
    }
    let lines = golden.lines().zip(text.lines()).position(|(a, b)| a != b);
    let at = lines.unwrap_or_else(|| golden.lines().count().min(text.lines().count()));
    let line = |text: &str| text.lines().nth(at).unwrap_or("nothing").to_owned();
    Err(format!(
        "{shown}, line {}:\n  golden {}\n  actual {}\nif this is right, `{UPDATE}` makes it anew",
        at + 1,
        line(&golden),
        line(text)
    ))
}

fn golden(name: &str) -> PathBuf {
    Path::new("tests/golden").join(format!("plan_{name}.txt"))
}

#[test]
fn plans_are_those_of_their_goldens() {
    let update = std::env::var_os("UPDATE_GOLDEN").is_some();
    let text = |plan: &Plan| plan.lines().iter().map(|line| format!("{line}\n")).collect::<String>();
    let failed: Vec<String> =
        cases().iter().filter_map(|case| held(&golden(case.name), &text(&case.plan), update).err()).collect();
    assert!(failed.is_empty(), "{}", failed.join("\n"));
    let known: BTreeSet<PathBuf> = cases().iter().map(|case| golden(case.name)).collect();
    let files = std::fs::read_dir("tests/golden").unwrap().map(|entry| entry.unwrap().path());
    let plans = files.filter(|file| file.to_string_lossy().contains("plan_"));
    assert_eq!(plans.collect::<BTreeSet<_>>(), known, "every golden of a plan is held by a case");
}

#[test]
fn missing_or_different_golden_fails_and_names_the_command() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("plan.txt");
    let missing = held(&file, "a\n", false).unwrap_err();
    assert!(missing.contains("plan.txt") && missing.contains(UPDATE), "{missing}");
    let written = held(&file, "a\nb\n", true).unwrap_err();
    assert!(written.contains("look at its diff"), "{written}");
    assert_eq!(held(&file, "a\nb\n", false), Ok(()));
    for (other, line) in [("a\nc\n", "line 2"), ("a\n", "line 2"), ("a\nb\nc\n", "line 3"), ("", "line 1")] {
        let different = held(&file, other, false).unwrap_err();
        assert!(different.contains(line) && different.contains(UPDATE), "{different}");
    }
}

#[test]
fn every_method_has_a_golden() {
    let planned: BTreeSet<&str> = cases().iter().map(|case| case.plan.method.name).collect();
    let without: Vec<&str> =
        METHODS.map(|method| method.name).into_iter().filter(|name| !planned.contains(name)).collect();
    assert!(without.is_empty(), "add a case to tests/plan/cases.rs for {}", without.join(", "));
}
