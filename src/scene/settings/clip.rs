//! `[[clip]]`: meshes [Thesis ch. 6 §3] and planes [Thesis §3.1.2] that the volume is cut at.

use std::path::PathBuf;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::parse::numbers;
use super::placed::{Placed, placed_mesh};
use crate::error::{Error, Result};
use crate::math::polyhedron::HalfSpace;
use crate::scene::fixed;
use crate::scene::mesh::{Keep, MOST_CLIPS};
use crate::scene::planes::MOST_PLANES;

placed_mesh! {
    /// A mesh that the volume is cut at, with its place, or a plane; what every one of them keeps is drawn. Lengths are in volume
    /// space: the longest side of the volume is 1, its centre is 0,0,0.
    #[serde(default, deny_unknown_fields, expecting = "a table [[clip]]")]
    ClipSettings, "clip", "mesh";

    /// The part of the volume that is kept by a mesh.
    keep: Keep = Keep::Inside;
    /// `[nx, ny, nz, d]`, in place of a mesh: the plane keeps the points p with n . p + d >= 0.
    #[serde(skip_serializing_if = "Option::is_none", deserialize_with = "fixed::optional")]
    plane: Option<[f64; 4]> = None;
}

/// Planes in place of tables `[[clip]]`.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Scene")]
pub struct ClipOptions {
    /// Plane that the volume is cut at, besides those of the scene file: it keeps the points p of volume space with
    /// n . p + d >= 0; up to 6 in all, one an option
    #[arg(long = "clip-plane", value_name = "NX,NY,NZ,D", value_parser = numbers::<4>, allow_hyphen_values = true)]
    planes: Vec<[f64; 4]>,
}

impl ClipOptions {
    /// Adds the planes that were given to the tables.
    pub fn apply(&self, clips: &mut Vec<ClipSettings>) {
        clips.extend(self.planes.iter().map(|plane| ClipSettings { plane: Some(*plane), ..ClipSettings::default() }));
    }
}

impl ClipSettings {
    /// What a plane keeps, with a normal of length 1.
    pub fn half_space(&self) -> Option<HalfSpace> {
        let [x, y, z, d] = self.plane?;
        let normal = DVec3::new(x, y, z);
        // By the largest component first, so that no square leaves the range of numbers.
        let largest = normal.abs().max_element();
        let (normal, d) = (normal / largest, d / largest);
        let length = normal.length();
        Some(HalfSpace { normal: normal / length, distance: -d / length })
    }

    fn check(&self) -> Result<()> {
        let Some(plane) = self.plane else { return self.placed().check() };
        let refuse = |problem: String, remedy: &str| Err(Error::usage("clip.plane (--clip-plane)", problem, remedy));
        if !plane.iter().all(|n| n.is_finite()) {
            return refuse(format!("is {plane:?}"), "give four finite numbers");
        }
        if *self != (Self { plane: self.plane, ..Self::default() }) {
            return refuse(
                format!("{plane:?} stands beside other keys"),
                "give a plane alone: mesh, builtin, keep and the keys of places are those of meshes",
            );
        }
        if plane[..3] == [0.0; 3] {
            return refuse(
                format!("{plane:?} has a normal of length 0"),
                "give [nx, ny, nz, d] with a normal that is not 0, 0, 0: the plane keeps the points p with n . p + d >= 0",
            );
        }
        match self.half_space() {
            Some(space) if space.distance.is_finite() => Ok(()),
            _ => refuse(
                format!("{plane:?} lies beyond all numbers"),
                "give a d that is not so much larger than the normal",
            ),
        }
    }
}

/// Whether every table is allowed, and all of them together.
///
/// # Errors
/// When one is not, by its key.
pub(super) fn check(clips: &[ClipSettings]) -> Result<()> {
    clips.iter().try_for_each(ClipSettings::check)?;
    let planes = clips.iter().filter(|clip| clip.plane.is_some()).count();
    if planes > MOST_PLANES {
        return Err(Error::usage(
            "clip.plane (--clip-plane)",
            format!("has {planes} planes"),
            format!("keep them to {MOST_PLANES}"),
        ));
    }
    let meshes = clips.len() - planes;
    let thesis = clips.iter().filter(|clip| clip.keep == Keep::Thesis).count();
    if thesis > 0 && thesis < meshes {
        return Err(Error::usage(
            "clip.keep",
            "is \"thesis\" in some of the tables [[clip]] with a mesh only",
            "the thesis cuts in front of the first surface of all clip geometry together: give it in all of them, or in none",
        ));
    }
    if thesis == 0 && meshes > MOST_CLIPS {
        return Err(Error::usage(
            "clip",
            format!("has {meshes} meshes"),
            format!("keep them to {MOST_CLIPS}, or join those that keep the same part in one file"),
        ));
    }
    Ok(())
}
