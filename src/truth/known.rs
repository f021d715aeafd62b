//! Which pictures have an exact integral to be held against.

use crate::error::{Error, Result};
use crate::scene::Scene;

/// # Errors
/// When no exact integral of the scene is known.
pub fn check(scene: &Scene) -> Result<()> {
    if scene.sees_through_surfaces() && scene.tetrahedra.is_none() {
        return Err(Error::usage(
            "surface",
            "has surfaces that rays go on behind, and the one that a ray meets is held against its root",
            "give opacity = 1 and leave out surface.volume, or use render and bench without an error",
        ));
    }
    if let Some(effect) = &scene.effect {
        let problem = format!("is {}, of whose colours no exact integral is known", effect.file());
        return Err(Error::usage("effects.file (--effect)", problem, "leave it out"));
    }
    if scene.settings.effects.refraction.is_some() || scene.backdrop.is_some() {
        return Err(Error::usage(
            "effects.refraction, effects.background (--refraction, --behind)",
            "bend rays, or show what is behind the volume, and the exact integral goes straight to where the volume ends",
            "leave them out, or use render and bench without an error",
        ));
    }
    if scene.surface.is_none() && !scene.lights.is_empty() {
        let remedy = "leave the lights out, or give an iso-surface (--iso), whose exact picture is known";
        return Err(Error::usage("light", "shines on samples, of whose colours no exact integral is known", remedy));
    }
    Ok(())
}
