//! `[[clip]]`: meshes [Thesis ch. 6 §3], planes [Thesis §3.1.2] and iso-surfaces of another volume [Stegmaier05 §6] that the volume is
//! cut at.

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
    /// A mesh or another volume that the volume is cut at, with its place, or a plane; what every one of them keeps is drawn. Lengths
    /// are in volume space: the longest side of the volume is 1, its centre is 0,0,0. So is the longest side of another volume, and
    /// its centre, before it is placed.
    #[serde(default, deny_unknown_fields, expecting = "a table [[clip]]")]
    ClipSettings, "clip", "mesh";

    /// A file of a volume, in place of a mesh, relative to the scene file; or `builtin` beside `iso`, `NAME:SIZE`.
    #[serde(skip_serializing_if = "Option::is_none", with = "crate::scene::file_name")]
    volume: Option<PathBuf> = None;
    /// The value of such a volume, in its own unit, from which on a place is inside. Places beyond its box are outside.
    #[serde(skip_serializing_if = "Option::is_none")]
    iso: Option<f64> = None;
    /// The part of the volume that is kept by a mesh, or by another volume.
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

    /// Where another volume comes from that the volume is cut at, its place, and the value from which on places are inside; none of
    /// meshes and planes.
    pub fn volume(&self) -> Option<(Placed<'_>, f64)> {
        let asked = self.plane.is_none() && (self.volume.is_some() || self.iso.is_some());
        asked
            .then(|| (Placed { file_key: "volume", path: &self.volume, ..self.placed() }, self.iso.unwrap_or(f64::NAN)))
    }

    /// Whether it is a mesh.
    pub fn is_mesh(&self) -> bool {
        self.plane.is_none() && self.volume().is_none()
    }

    fn check_volume(&self, placed: &Placed, iso: f64) -> Result<()> {
        let refuse = |key: &str, problem: &str, remedy: &str| Err(placed.refusal(key, problem.to_owned(), remedy));
        match () {
            () if self.path.is_some() => refuse("mesh", "is given beside a volume", "give them in tables of their own"),
            () if self.iso.is_none() => refuse(
                "iso",
                "is missing",
                "give the value of the volume, in its own unit, from which on a place is inside",
            ),
            () if !iso.is_finite() => refuse("iso", &format!("is {iso}"), "give a finite number"),
            () if self.keep == Keep::Thesis => {
                refuse("keep", "is \"thesis\", which cuts in front of the surfaces of meshes", "use inside or outside")
            }
            () => placed.check(),
        }
    }

    fn check(&self) -> Result<()> {
        if let Some((placed, iso)) = self.volume() {
            return self.check_volume(&placed, iso);
        }
        let Some(plane) = self.plane else { return self.placed().check() };
        let refuse = |problem: String, remedy: &str| Err(Error::usage("clip.plane (--clip-plane)", problem, remedy));
        if !plane.iter().all(|n| n.is_finite()) {
            return refuse(format!("is {plane:?}"), "give four finite numbers");
        }
        if *self != (Self { plane: self.plane, ..Self::default() }) {
            return refuse(
                format!("{plane:?} stands beside other keys"),
                "give a plane alone: mesh, builtin, volume, iso, keep and the keys of places are those of meshes and volumes",
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
    let volumes = clips.iter().filter(|clip| clip.volume().is_some()).count();
    if volumes > 1 {
        let remedy =
            "keep it to one, or join them in one file: the greatest of their values is at least what any of them is";
        return Err(Error::usage("clip.volume", format!("has {volumes} volumes"), remedy));
    }
    let meshes = clips.len() - planes - volumes;
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
