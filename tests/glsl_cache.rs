//! Modules kept on disk: a second use reads them, and whatever is wrong with the folder only means compiling again.

#[path = "glsl/folder.rs"]
mod folder;

use std::fs;
use std::path::{Path, PathBuf};

use depthleap::glsl::cache::{Cache, CacheKey};
use depthleap::glsl::library::Library;
use depthleap::glsl::source::Source;
use depthleap::glsl::{Shader, built_in};
use folder::{alter, copy};

const ENTRY: &str = "entry.frag";

fn entry() -> Shader {
    Shader::new(ENTRY, [])
}

fn key(source: &Source, file: &str, defines: &[&str]) -> CacheKey {
    CacheKey::of(&source.text(file).unwrap(), defines)
}

/// A library that has nothing in memory yet.
fn library(cache: &Path) -> Library {
    Library::new(built_in(), Cache::at(cache.to_owned()))
}

fn stored(cache: &Path) -> Vec<PathBuf> {
    fs::read_dir(cache).unwrap().map(|entry| entry.unwrap().path()).collect()
}

#[test]
fn second_use_reads_what_the_first_has_stored() {
    let folder = tempfile::tempdir().unwrap();
    // It is made where it is not there.
    let cache = folder.path().join("depthleap/shaders");
    let words = library(&cache).module(&entry()).unwrap();
    let key = key(&built_in(), ENTRY, &[]);
    let at = Cache::at(cache.clone());
    assert_eq!(stored(&cache), [at.path(&key).unwrap()], "one file, and no temporary one");
    assert_eq!(at.load(&key).unwrap(), *words);
    // Words that no compiler makes tell that they were read.
    at.store(&key, &[1, 2, 3]);
    assert_eq!(*library(&cache).module(&entry()).unwrap(), [1, 2, 3]);
}

#[test]
fn prepared_shaders_are_stored_and_the_first_fault_is_told() {
    let cache = tempfile::tempdir().unwrap();
    let library = library(cache.path());
    let shaders = ["MARK_COPY", "MARK_FRAGDEPTH"].map(|mark| Shader::new("termination.frag", [mark]));
    library.prepare(shaders.iter().chain(&shaders).chain([&entry()])).unwrap();
    assert_eq!(stored(cache.path()).len(), 3);
    let error = library.prepare([&entry(), &Shader::new(ENTRY, ["NONE"])]).unwrap_err().to_string();
    assert!(error.contains("`NONE`"), "{error}");
}

#[test]
fn damaged_files_are_ignored() {
    let cache = tempfile::tempdir().unwrap();
    let at = Cache::at(cache.path().to_owned());
    let words = library(cache.path()).module(&entry()).unwrap();
    let key_of = |file, defines| key(&built_in(), file, defines);
    let (key, other) = (key_of(ENTRY, &[]), key_of("direction.frag", &[]));
    let path = at.path(&key).unwrap();
    let whole = fs::read(&path).unwrap();
    let damaged = |change: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = whole.clone();
        change(&mut bytes);
        bytes
    };
    let last = whole.len() - 1;
    for (what, bytes) in [
        ("empty", Vec::new()),
        ("cut short", damaged(&|bytes| bytes.truncate(last - 7))),
        ("cut within a word", damaged(&|bytes| bytes.truncate(last))),
        ("too long", damaged(&|bytes| bytes.extend([0; 4]))),
        ("a head alone", damaged(&|bytes| bytes.truncate(20))),
        ("another magic", damaged(&|bytes| bytes[0] ^= 1)),
        ("another hash", damaged(&|bytes| bytes[9] ^= 1)),
        ("a bit of the module", damaged(&|bytes| bytes[last] ^= 0x10)),
    ] {
        fs::write(&path, bytes).unwrap();
        assert_eq!(at.load(&key), None, "{what}");
        assert_eq!(library(cache.path()).module(&entry()).unwrap(), words, "{what}");
        assert_eq!(fs::read(&path).unwrap(), whole, "{what}: it is written again");
    }
    fs::write(at.path(&other).unwrap(), &whole).unwrap();
    assert_eq!(at.load(&other), None, "a module under another one's name");
    fs::remove_file(&path).unwrap();
    fs::create_dir(&path).unwrap();
    assert_eq!(library(cache.path()).module(&entry()).unwrap(), words, "a folder in its place");
}

#[test]
fn folder_that_cannot_be_written_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    // Below a file there is no folder, for the superuser neither.
    let words = library(&file.join("shaders")).module(&entry()).unwrap();
    assert_eq!(words, library(folder.path()).module(&entry()).unwrap());
    assert_eq!(library(Path::new("/proc/depthleap")).module(&entry()).unwrap(), words);
}

#[test]
fn key_stands_for_all_that_a_module_is_made_from() {
    let copy = copy();
    let source = Source::Folder(copy.path().to_owned());
    let of = |file: &str, defines: &[&str]| key(&source, file, defines);
    let (main, discard) = (of("main_pass.frag", &[]), of("main_pass.frag", &["CULL_DISCARD"]));
    assert_eq!(main, key(&built_in(), "main_pass.frag", &[]), "files count, not where they lie");
    assert_ne!(main, discard);
    assert_ne!(of("main_pass.frag", &["A", "B"]), of("main_pass.frag", &["AB"]));
    let entry = of(ENTRY, &[]);
    // One of them is included under a condition only.
    for (file, from) in [
        ("main_pass.frag", "vec4 segment = no_sample();"),
        ("shared/preintegrated.glsl", "binding = 5"),
        ("shared/opacity.glsl", "float s = x / (2.0 + x);"),
    ] {
        let before = of("main_pass.frag", &[]);
        alter(copy.path(), file, from, &format!("{from} "));
        assert_ne!(of("main_pass.frag", &[]), before, "{file}");
    }
    assert_eq!(of(ENTRY, &[]), entry, "others are as they were");
}
