//! Why the loader gives no driver: the environment variables that chose manifests, and the loader's own words.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use ash::{ext, vk};

use super::messages::messenger_info;
use super::version::API_VERSION;
use crate::error::Error;

/// Environment variables that choose the manifests of drivers.
const FILES: [&str; 3] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_ADD_DRIVER_FILES"];

/// Environment variables that choose among drivers by the names of their manifests.
const FILTERS: [&str; 2] = ["VK_LOADER_DRIVERS_SELECT", "VK_LOADER_DRIVERS_DISABLE"];

/// Words of the loader that are shown; the first say most.
const MOST_WORDS: usize = 4;

/// An error of the loader or of its drivers, with what chose the drivers and what the loader says of them.
pub(super) fn diagnosed(entry: &ash::Entry, error: Error) -> Error {
    let chosen: Vec<String> =
        FILES.into_iter().filter_map(files).chain(FILTERS.into_iter().filter_map(filter)).collect();
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

/// What a manifest looks like to somebody who reads it.
fn state(path: &Path) -> String {
    if path.is_dir() {
        return "a folder".to_owned();
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
    words.truncate(MOST_WORDS);
    let plain = |word: String| word.trim_start_matches(LOADER_ID).trim_start_matches(": ").trim().to_owned();
    words.into_iter().map(plain).collect()
}

/// The id of the loader's own messages.
const LOADER_ID: &str = "Loader Message";
