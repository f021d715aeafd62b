//! `[[clip]]`: geometry that the volume is cut at [Thesis ch. 6 §3].

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::placed::{Placed, placed_mesh};
use crate::error::{Error, Result};
use crate::scene::fixed;
use crate::scene::mesh::{Keep, MOST_CLIPS};

placed_mesh! {
    /// A mesh that the volume is cut at, with its place; what every one of them keeps is drawn. Lengths are in volume space:
    /// the longest side of the volume is 1, its centre is 0,0,0.
    #[serde(default, deny_unknown_fields, expecting = "a table [[clip]]")]
    ClipSettings, "clip", "mesh";

    /// The part of the volume that is kept.
    keep: Keep = Keep::Inside;
}

/// Whether every table is allowed, and all of them together.
///
/// # Errors
/// When one is not, by its key.
pub(super) fn check(clips: &[ClipSettings]) -> Result<()> {
    clips.iter().try_for_each(|clip| clip.placed().check())?;
    let thesis = clips.iter().filter(|clip| clip.keep == Keep::Thesis).count();
    if thesis > 0 && thesis < clips.len() {
        return Err(Error::usage(
            "clip.keep",
            "is \"thesis\" in some of the tables [[clip]] only",
            "the thesis cuts in front of the first surface of all clip geometry together: give it in all of them, or in none",
        ));
    }
    if thesis == 0 && clips.len() > MOST_CLIPS {
        return Err(Error::usage(
            "clip",
            format!("has {} meshes", clips.len()),
            format!("keep them to {MOST_CLIPS}, or join those that keep the same part in one file"),
        ));
    }
    Ok(())
}
