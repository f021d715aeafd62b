//! `[[mesh]]`: polygons in and around the volume.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::placed::{Placed, placed_mesh};
use crate::error::Result;
use crate::scene::fixed;
use crate::scene::limits::BRIGHTEST;
use crate::scene::mesh::Material;

placed_mesh! {
    /// A mesh, its place and its look. Lengths are in volume space: the longest side of the volume is 1, its centre is 0,0,0.
    #[serde(default, deny_unknown_fields, expecting = "a table [[mesh]]")]
    MeshSettings, "mesh", "path";

    /// Linear red, green and blue of the mesh's fronts.
    #[serde(deserialize_with = "fixed::list")]
    color: [f64; 3] = [0.8; 3];
    /// Linear red, green and blue of the mesh's backs; those of its fronts where nothing is said.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    back: Option<[f64; 3]> = None;
    /// Opacity of the mesh's surface, from 0 to 1, which hides what is behind.
    opacity: f64 = 1.0;
    /// Whether the mesh's backs show.
    two_sided: bool = true;
}

impl MeshSettings {
    /// Whether every value is allowed.
    ///
    /// # Errors
    /// When one is not, by its key.
    pub(super) fn check(&self) -> Result<()> {
        let placed = self.placed();
        placed.check()?;
        if !(0.0..=1.0).contains(&self.opacity) {
            return Err(placed.refusal("opacity", format!("is {}", self.opacity), "give a number from 0 to 1"));
        }
        for (key, color) in [("color", Some(self.color)), ("back", self.back)] {
            if let Some(color) = color.filter(|color| !color.iter().all(|c| (0.0..=BRIGHTEST).contains(c))) {
                return Err(placed.refusal(
                    key,
                    format!("is {color:?}"),
                    &format!("give three numbers from 0 to {BRIGHTEST}"),
                ));
            }
        }
        Ok(())
    }

    /// How the mesh looks.
    pub fn material(&self) -> Material {
        Material {
            colors: [self.color, self.back.unwrap_or(self.color)],
            opacity: self.opacity,
            two_sided: self.two_sided,
            clip: None,
        }
    }
}
