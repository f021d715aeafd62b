//! `[[mesh]]`: polygons in and around the volume.

use std::path::PathBuf;

use glam::{DMat4, DQuat, DVec3, DVec4, EulerRot};
use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::scene::fixed;
use crate::scene::mesh::Material;

/// A mesh, its place and its look. Lengths are in volume space: the longest side of the volume is 1, its centre is 0,0,0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields, expecting = "a table [[mesh]]")]
pub struct MeshSettings {
    /// A file of PLY, OBJ, STL or glTF, relative to the scene file.
    #[serde(skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
    pub path: Option<PathBuf>,
    /// `NAME` or `NAME:SEGMENTS`, see [`crate::scene::mesh::SHAPES`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub builtin: Option<String>,
    /// Linear red, green and blue of the mesh's fronts.
    #[serde(deserialize_with = "fixed::list")]
    pub color: [f64; 3],
    /// Linear red, green and blue of the mesh's backs; those of its fronts where nothing is said.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    pub back: Option<[f64; 3]>,
    /// Opacity of the mesh's surface, from 0 to 1, which hides what is behind.
    pub opacity: f64,
    /// Whether the mesh's backs show.
    pub two_sided: bool,
    /// Length of the longest side of the mesh's box, whose middle is moved to 0,0,0; before all that follows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fit: Option<f64>,
    /// Factor by which the mesh is made larger, after `fit`.
    pub scale: f64,
    /// Degrees by which the mesh is turned about x, about y and about z, in this order, after `scale`.
    #[serde(deserialize_with = "fixed::list")]
    pub rotate: [f64; 3],
    /// Where the mesh is moved, after `rotate`.
    #[serde(deserialize_with = "fixed::list")]
    pub translate: [f64; 3],
    /// Three rows, whose products with (x, y, z, 1) take the place of each corner, after `translate`.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional_lists")]
    pub transform: Option<Vec<[f64; 4]>>,
}

impl Default for MeshSettings {
    fn default() -> Self {
        Self {
            path: None,
            builtin: None,
            color: [0.8; 3],
            back: None,
            opacity: 1.0,
            two_sided: true,
            fit: None,
            scale: 1.0,
            rotate: [0.0; 3],
            translate: [0.0; 3],
            transform: None,
        }
    }
}

impl MeshSettings {
    /// What it is called in messages: its file or its shape.
    pub fn name(&self) -> String {
        match (&self.path, &self.builtin) {
            (Some(path), _) => path.display().to_string(),
            (None, Some(shape)) => format!("builtin:{shape}"),
            (None, None) => "mesh".to_owned(),
        }
    }

    /// Whether every value is allowed.
    ///
    /// # Errors
    /// When one is not, by its key.
    pub(super) fn check(&self) -> Result<()> {
        let name = self.name();
        let refuse = |key: &str, problem: String, remedy: &str| {
            Err(Error::usage(format!("{name}: mesh.{key}"), problem, remedy.to_owned()))
        };
        if self.path.is_some() == self.builtin.is_some() {
            let problem = if self.path.is_some() { "is given beside builtin" } else { "is missing, and builtin too" };
            return refuse("path", problem.to_owned(), "give one of path and builtin");
        }
        if !(0.0..=1.0).contains(&self.opacity) {
            return refuse("opacity", format!("is {}", self.opacity), "give a number from 0 to 1");
        }
        for (key, color) in [("color", Some(self.color)), ("back", self.back)] {
            if let Some(color) = color.filter(|color| !color.iter().all(|c| (0.0..=f64::MAX).contains(c))) {
                return refuse(key, format!("is {color:?}"), "give three finite numbers, none below 0");
            }
        }
        for (key, length) in [("fit", self.fit), ("scale", Some(self.scale))] {
            if let Some(length) = length.filter(|length| !(length.is_finite() && *length > 0.0)) {
                return refuse(key, format!("is {length}"), "give a finite number above 0");
            }
        }
        for (key, numbers) in [("rotate", self.rotate), ("translate", self.translate)] {
            if !numbers.iter().all(|n| n.is_finite()) {
                return refuse(key, format!("is {numbers:?}"), "give three finite numbers");
            }
        }
        match &self.transform {
            Some(rows) if rows.len() != 3 || !rows.iter().flatten().all(|n| n.is_finite()) => {
                refuse("transform", format!("is {rows:?}"), "give three rows of four finite numbers")
            }
            _ => Ok(()),
        }
    }

    /// From the mesh's own space to volume space; `bounds`: the least and the greatest corner of its box.
    pub fn place(&self, bounds: [DVec3; 2]) -> DMat4 {
        let [least, greatest] = bounds;
        let fit = self.fit.map_or(DMat4::IDENTITY, |size| {
            let longest = (greatest - least).max_element();
            let scale = if longest > 0.0 { size / longest } else { 1.0 };
            DMat4::from_scale(DVec3::splat(scale)) * DMat4::from_translation(-0.5 * (least + greatest))
        });
        let [x, y, z] = self.rotate.map(f64::to_radians);
        // Fixed axes, x first.
        let turn = DQuat::from_euler(EulerRot::ZYX, z, y, x);
        let placed = DMat4::from_scale_rotation_translation(DVec3::splat(self.scale), turn, self.translate.into());
        let rows = self.transform.as_deref().and_then(|rows| <[[f64; 4]; 3]>::try_from(rows).ok());
        let last = rows
            .map_or(DMat4::IDENTITY, |[x, y, z]| DMat4::from_cols(x.into(), y.into(), z.into(), DVec4::W).transpose());
        last * placed * fit
    }

    pub fn material(&self) -> Material {
        Material {
            colors: [self.color, self.back.unwrap_or(self.color)],
            opacity: self.opacity,
            two_sided: self.two_sided,
        }
    }
}
