//! What all meshes of a scene file, and volumes that clip, have in common: where they come from, and their place in volume space.

use std::path::PathBuf;

use glam::{DMat4, DQuat, DVec3, DVec4, EulerRot};

use crate::error::{Error, Result};

/// Where a mesh, or a volume that clips, comes from, and its place, borrowed from its table.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'a> {
    /// The name of the table, in messages.
    pub table: &'static str,
    /// The key of the table that names a file, in messages.
    pub file_key: &'static str,
    pub path: &'a Option<PathBuf>,
    pub builtin: &'a Option<String>,
    pub fit: Option<f64>,
    pub scale: f64,
    pub rotate: [f64; 3],
    pub translate: [f64; 3],
    pub transform: &'a Option<Vec<[f64; 4]>>,
}

/// Makes the struct of a table of meshes, by the names of the table and of its key for a file: the keys that all have, and its
/// own, each with its default.
macro_rules! placed_mesh {
    ($(#[$meta:meta])* $name:ident, $table:literal, $file:literal; $($(#[$of:meta])* $key:ident: $type:ty = $default:expr;)*) => {
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        $(#[$meta])*
        pub struct $name {
            /// A file of PLY, OBJ, STL or glTF, relative to the scene file.
            #[serde(rename = $file, skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
            pub path: Option<PathBuf>,
            /// `NAME` or `NAME:SEGMENTS`, see [`crate::scene::mesh::SHAPES`].
            #[serde(skip_serializing_if = "Option::is_none")]
            pub builtin: Option<String>,
            $($(#[$of])* pub $key: $type,)*
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

        impl Default for $name {
            fn default() -> Self {
                Self {
                    path: None,
                    builtin: None,
                    $($key: $default,)*
                    fit: None,
                    scale: 1.0,
                    rotate: [0.0; 3],
                    translate: [0.0; 3],
                    transform: None,
                }
            }
        }

        impl $name {
            /// Where the mesh comes from, and its place.
            pub fn placed(&self) -> Placed<'_> {
                Placed {
                    table: $table,
                    file_key: $file,
                    path: &self.path,
                    builtin: &self.builtin,
                    fit: self.fit,
                    scale: self.scale,
                    rotate: self.rotate,
                    translate: self.translate,
                    transform: &self.transform,
                }
            }
        }
    };
}
pub(super) use placed_mesh;

impl Placed<'_> {
    /// What the mesh is called in messages: its file or its shape.
    pub fn name(&self) -> String {
        match (self.path, self.builtin) {
            (Some(path), _) => path.display().to_string(),
            (None, Some(shape)) => format!("builtin:{shape}"),
            (None, None) => self.table.to_owned(),
        }
    }

    /// Why a key of the mesh's table is refused.
    pub(super) fn refusal(&self, key: &str, problem: String, remedy: &str) -> Error {
        Error::usage(format!("{}: {}.{key}", self.name(), self.table), problem, remedy.to_owned())
    }

    /// Whether every value is allowed.
    ///
    /// # Errors
    /// When one is not, by its key.
    pub(super) fn check(&self) -> Result<()> {
        let refuse = |key: &str, problem: String, remedy: &str| Err(self.refusal(key, problem, remedy));
        if self.path.is_some() == self.builtin.is_some() {
            let problem = if self.path.is_some() { "is given beside builtin" } else { "is missing, and builtin too" };
            return refuse(self.file_key, problem.to_owned(), &format!("give one of {} and builtin", self.file_key));
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
        match self.transform {
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
}
