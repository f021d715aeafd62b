//! Why the loader gives no driver: the environment variables that chose manifests, and the loader's own words.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use ash::{ext, vk};

use super::messages::messenger_info;
use super::version::API_VERSION;
use crate::error::Error;

/// Environment variables that choose the manifests of drivers. The loader asks the second only without the first.
const FILES: [&str; 3] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"];

/// Environment variables that choose among drivers by the names of their manifests.
const FILTERS: [&str; 2] = ["VK_LOADER_DRIVERS_SELECT", "VK_LOADER_DRIVERS_DISABLE"];

/// Lines of the loader that are shown.
const MOST_WORDS: usize = 4;

/// Lines of the loader that say most: what failed, and which file it is about.
const TELLING: [&str; 4] = ["Failed", "failed", "error", "/"];

/// An error of the loader or of its drivers, with what chose the drivers and what the loader says of them.
pub(super) fn diagnosed(entry: &ash::Entry, error: Error) -> Error {
    let chosen: Vec<String> = FILES
        .into_iter()
        .filter(|variable| is_asked(variable))
        .filter_map(files)
        .chain(FILTERS.into_iter().filter_map(filter))
        .collect();
    let words = loader_words(entry);
    if chosen.is_empty() && words.is_empty() {
        return error;
    }
    let mut problem = error.problem;
    for part in &chosen {
        problem += &format!("; {part}");
    }
    if !words.is_empty() {
        problem += &format!("; the loader says: {}", words.join("; "));
    }
    let remedy = if chosen.is_empty() {
        "repair or install the driver again (Debian: mesa-vulkan-drivers)"
    } else {
        "correct the driver manifest, or the variable that names it, or unset the variable"
    };
    Error::device("Vulkan driver", problem, remedy)
}

/// Whether the loader asks the variable.
fn is_asked(variable: &str) -> bool {
    variable != FILES[1] || std::env::var_os(FILES[0]).is_none_or(|value| value.is_empty())
}

/// The variable with the manifests it names, and what is wrong with them at first sight.
fn files(variable: &str) -> Option<String> {
    let value = std::env::var_os(variable).filter(|value| !value.is_empty())?;
    let described = |path: std::path::PathBuf| format!("{} ({})", path.display(), state(&path));
    let paths: Vec<String> = std::env::split_paths(&value).map(described).collect();
    Some(format!("{variable} names {}", paths.join(", ")))
}

fn filter(variable: &str) -> Option<String> {
    let value = std::env::var_os(variable).filter(|value| !value.is_empty())?;
    Some(format!("{variable} is {}", value.to_string_lossy()))
}

/// Manifests are a few hundred bytes long.
const LONGEST_MANIFEST: u64 = 1 << 20;

/// What a manifest looks like to somebody who reads it.
fn state(path: &Path) -> String {
    match std::fs::metadata(path) {
        Err(error) => return format!("cannot be read: {error}"),
        Ok(meta) if meta.is_dir() => return "a folder".to_owned(),
        Ok(meta) if !meta.is_file() => return "is not a regular file".to_owned(),
        Ok(meta) if meta.len() > LONGEST_MANIFEST => {
            return format!("has {} bytes, too many for a manifest", meta.len());
        }
        Ok(_) => {}
    }
    match std::fs::read(path) {
        Err(error) => format!("cannot be read: {error}"),
        Ok(bytes) => match serde_json::from_slice::<serde_json::Value>(&bytes) {
            Err(error) => format!("is not JSON: {error}"),
            Ok(manifest) => match manifest["ICD"]["library_path"].as_str() {
                Some(library) => format!("names the library {library}"),
                None => "names no ICD.library_path".to_owned(),
            },
        },
    }
}

/// What the loader reports while it makes an instance.
fn loader_words(entry: &ash::Entry) -> Vec<String> {
    let words: Box<Mutex<Vec<String>>> = Box::default();
    let application = vk::ApplicationInfo::default().api_version(API_VERSION);
    let names = [ext::debug_utils::NAME.as_ptr()];
    let mut messenger = messenger_info(&words);
    let info = vk::InstanceCreateInfo::default()
        .application_info(&application)
        .enabled_extension_names(&names)
        .push_next(&mut messenger);
    // SAFETY: everything `info` points to outlives the call; the instance, if one comes, goes at once, before `words`.
    unsafe {
        if let Ok(instance) = entry.create_instance(&info, None) {
            instance.destroy_instance(None);
        }
    }
    let mut words = std::mem::take(&mut *words.lock().unwrap_or_else(PoisonError::into_inner));
    words.dedup();
    words.sort_by_key(|word| std::cmp::Reverse(TELLING.iter().filter(|telling| word.contains(**telling)).count()));
    let others = words.len().saturating_sub(MOST_WORDS);
    words.truncate(MOST_WORDS);
    words.extend((others > 0).then(|| format!("and {others} more lines")));
    let plain = |word: String| word.trim_start_matches(LOADER_ID).trim_start_matches(": ").trim().to_owned();
    words.into_iter().map(plain).collect()
}

/// The id of the loader's own messages.
const LOADER_ID: &str = "Loader Message";
