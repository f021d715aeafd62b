//! What is behind the volume.

use std::path::Path;

use super::environment::picture;
use crate::error::Result;
use crate::scene::Backdrop;
use crate::scene::backdrop::Pattern;
use crate::scene::settings::{CHECKER, EffectsSettings};

/// The background that `settings` ask for, none where they ask for none; its path is taken as it stands.
///
/// # Errors
/// When the file is not a picture that can be taken.
pub fn backdrop(settings: &EffectsSettings) -> Result<Option<Backdrop>> {
    let Some(name) = &settings.behind else { return Ok(None) };
    let pattern = match name.as_path() == Path::new(CHECKER) {
        true => Pattern::Checker(settings.background_squares),
        false => Pattern::Picture(picture(name)?),
    };
    Ok(Some(Backdrop { pattern, distance: settings.background_distance }))
}
