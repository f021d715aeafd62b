//! Effects: GLSL of the user's.

use std::path::Path;

use crate::error::{Error, Result};
use crate::scene::Effect;
use crate::scene::effect::MOST_BYTES;
use crate::scene::settings::EffectsSettings;

/// The effect that `settings` name, none where they name none; its path is taken as it stands.
///
/// # Errors
/// When the file cannot be read, is not text, or cannot be an effect.
pub fn effect(settings: &EffectsSettings) -> Result<Option<Effect>> {
    let Some(path) = &settings.file else { return Ok(None) };
    if path == Path::new("-") {
        let problem = "is standard input, from which no run can be repeated";
        return Err(Error::usage("effects.file (--effect -)", problem, "give the path of a file"));
    }
    let (_, length) = super::open(path)?;
    if length > MOST_BYTES as u64 {
        let remedy = format!("give an effect of up to {MOST_BYTES} bytes");
        return Err(Error::input(path.display(), format!("has {length} bytes"), remedy));
    }
    let mut effect = Effect::new(&path.display().to_string(), &super::text(path)?)?;
    if let Some(hash) = &settings.hash {
        effect.was(hash);
    }
    Ok(Some(effect))
}
