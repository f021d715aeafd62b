//! The pages of a folder of results, made again of its JSON and its pictures.

use std::path::Path;

use super::folder::{Pages, Written, write_pages};
use super::{accuracy, bench, probe, reproduce, stability};
use crate::error::{Error, Result};
use crate::measure::write::check_folder;

/// Every experiment that leaves pages.
const ALL: [&Pages; 5] = [&bench::PAGES, &probe::PAGES, &reproduce::PAGES, &accuracy::PAGES, &stability::PAGES];

/// Makes all pages of `folder` again.
///
/// # Errors
/// When `folder` is not a folder, or has no results; else as [`write_pages`].
pub fn render(folder: &Path) -> Result<Written> {
    let wrong = |problem: String| {
        Error::input(
            folder.display(),
            problem,
            "give a folder that bench, probe, reproduce, accuracy or stability wrote",
        )
    };
    if !folder.is_dir() {
        return Err(wrong(if folder.exists() { "is not a folder" } else { "is not there" }.to_owned()));
    }
    let there: Vec<&Pages> = ALL.into_iter().filter(|pages| folder.join(pages.json).exists()).collect();
    if there.is_empty() {
        return Err(wrong(format!("has no results: none of {}", ALL.map(|pages| pages.json).join(", "))));
    }
    check_folder(folder)?;
    write_pages(folder, &there)
}
