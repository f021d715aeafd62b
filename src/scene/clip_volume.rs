//! Another volume, by whose values the scene's own one is clipped [Stegmaier05 §6].
//!
//! What is inside are the places in its box at which its trilinear interpolant has reached a level. Beyond its box there are no
//! values, so that nothing there is inside.

use glam::{DMat4, DQuat, DVec3, DVec4};

use super::field::{NanPolicy, normalised};
use super::settings::Placed;
use super::volume::Volume;
use super::{Field, Scene};
use crate::error::{Error, Result};
use crate::math::interpolate::trilinear;

/// A place so many voxels beyond the box is on its face: what rounding makes of places on the faces of two boxes that lie on each
/// other.
pub const FACE_WIDTH: f64 = 1.0 / 1024.0;

/// Single precision has numbers for products of what is below this.
const FARTHEST: f64 = 1e15;

/// A clip volume in its place.
#[derive(Clone, Debug)]
pub struct ClipVolume {
    /// Its voxels, over a range of their own. Those without a value have not reached any level above the least value.
    pub field: Field,
    /// The value from which on places are inside, in the volume's own unit.
    pub iso: f64,
    /// The same as x of the field: a number of f32, so that shaders know the same.
    pub level: f64,
    /// Whether what is inside is kept; else what is not.
    pub keeps_inside: bool,
    /// Their products with (x, y, z, 1), of texture coordinates of the scene's volume, are voxels of the clip volume, 0 at the centre of
    /// the first one: numbers of f32, as the level.
    pub rows: [DVec4; 3],
    /// Whether it may take anything of the volume that is clipped.
    pub cuts: bool,
    /// What a user should know of it.
    pub warnings: Vec<String>,
}

impl ClipVolume {
    /// Of a volume that is clipped, with sides `extent`, whose axes `turn` leads to volume space.
    ///
    /// # Errors
    /// When memory does not suffice, or when the place cannot be undone or lies beyond the numbers of single precision.
    pub fn new(
        volume: Volume,
        iso: f64,
        keeps_inside: bool,
        placed: &Placed,
        extent: DVec3,
        turn: DQuat,
    ) -> Result<Self> {
        let own_turn = volume.turn;
        let field = Field::new(volume, None, NanPolicy::Replace)?;
        let half = 0.5 * field.extent();
        let corners = (0..8).map(|corner| own_turn * (half * signs(corner)));
        let bounds = [corners.clone().fold(half, DVec3::min), corners.fold(-half, DVec3::max)];
        let place = DMat4::from_quat(turn.inverse()) * placed.place(bounds) * DMat4::from_quat(own_turn);
        let refuse = |problem: String, remedy: &str| Err(Error::input(placed.name(), problem, remedy));
        let determinant = place.determinant();
        if !(determinant.is_finite() && determinant != 0.0) {
            let problem = format!("is placed by a transform whose determinant is {determinant}");
            return refuse(problem, "give a transform that can be undone");
        }
        let dims = DVec3::from_array(field.dims().map(|n| n as f64));
        let to_voxels = DMat4::from_translation(0.5 * dims - 0.5) * DMat4::from_scale(dims / field.extent());
        let from_texture = DMat4::from_translation(-0.5 * extent) * DMat4::from_scale(extent);
        let all = to_voxels * place.inverse() * from_texture;
        let rows = [0, 1, 2].map(|axis| all.row(axis).as_vec4().as_dvec4());
        if !rows.iter().all(|row| row.is_finite() && row.abs().max_element() < FARTHEST) {
            let problem = "is so small or so far away that single precision has no numbers for its place".to_owned();
            return refuse(problem, "place it nearer to 0,0,0, or make it larger");
        }
        let [low, high] = field.range;
        let level = match low < high {
            true => f64::from(normalised(iso, field.range)),
            // x is 0 everywhere.
            false if iso <= low => -1.0,
            false => 1.0,
        };
        let mut clip = Self { field, iso, level, keeps_inside, rows, cuts: true, warnings: Vec::new() };
        clip.cuts = clip.may_cut();
        clip.warnings.clone_from(&clip.field.volume.warnings);
        clip.warnings.extend(clip.of_level());
        Ok(clip)
    }

    /// That the level parts nothing from nothing.
    fn of_level(&self) -> Vec<String> {
        let (name, iso) = (&self.field.volume.name, self.iso);
        let [least, most] = self.reached();
        let values = match self.field.value_extremes() {
            None => "no voxel has a value".to_owned(),
            Some([least, most]) if least == most => format!("every value is {least}"),
            Some([least, most]) => format!("values run from {least} to {most}"),
        };
        let (kept, beyond) = if self.keeps_inside { ("nothing", "all of it") } else { ("everything", "none of it") };
        match () {
            () if !most => vec![format!(
                "no place of the clip volume {name} has reached clip.iso {iso} ({values}), so that {kept} is kept; give an iso value \
                 between its values"
            )],
            () if least => vec![format!(
                "all of the clip volume {name} has reached clip.iso {iso} ({values}), so that {beyond} that lies in its box is kept; give \
                 an iso value between its values"
            )],
            () => Vec::new(),
        }
    }

    /// What it is, in words.
    pub fn words(&self) -> String {
        let [x, y, z] = self.field.dims();
        let side = if self.keeps_inside { "inside" } else { "outside" };
        format!(
            "clipped by {}, of {x} x {y} x {z} voxels: what is {side} of {} is kept",
            self.field.volume.name, self.iso
        )
    }

    /// Whether its least and its greatest value have reached the level.
    fn reached(&self) -> [bool; 2] {
        self.field.extremes().map(|value| f64::from(value) >= self.level)
    }

    /// Whether it may take anything of the volume that is clipped; of the two boxes the corners alone are compared.
    fn may_cut(&self) -> bool {
        let [least, most] = self.reached();
        let corners = (0..8).map(|corner| self.voxel(0.5 + 0.5 * signs(corner)));
        let [low, high] = self.faces(0.0);
        match self.keeps_inside {
            // All of the volume lies in the box, which is convex, and has reached the level there.
            true => !least || !corners.into_iter().all(|at| at.cmpge(low).all() && at.cmple(high).all()),
            false => {
                let [from, to] =
                    corners.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[from, to], at| [from.min(at), to.max(at)]);
                most && from.cmple(high).all() && to.cmpge(low).all()
            }
        }
    }

    /// The faces of its box, in voxels from the centre of the first one, `grown` by so many voxels on each side.
    pub fn faces(&self, grown: f64) -> [DVec3; 2] {
        let reach = 0.5 + FACE_WIDTH + grown;
        [DVec3::splat(-reach), DVec3::from_array(self.field.dims().map(|n| n as f64 - 1.0)) + reach]
    }

    /// The voxel at texture coordinates of the scene's volume, counted from the centre of the first one.
    pub fn voxel(&self, place: DVec3) -> DVec3 {
        DVec3::from_array(self.rows.map(|row| row.dot(place.extend(1.0))))
    }

    /// The interpolated value there, as x of the field; that on the nearest face beyond its box.
    pub fn value(&self, voxel: DVec3) -> f64 {
        trilinear(&self.field.values, self.field.dims(), voxel + 0.5)
    }

    /// Whether texture coordinates of the scene's volume are kept.
    pub fn keeps(&self, place: DVec3) -> bool {
        let voxel = self.voxel(place);
        let [low, high] = self.faces(0.0);
        let inside = voxel.cmpge(low).all() && voxel.cmple(high).all() && self.value(voxel) >= self.level;
        inside == self.keeps_inside
    }
}

/// The signs of a corner of a box.
fn signs(corner: usize) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 }))
}

impl Scene {
    /// The clip volume that its frames know: one that cuts something off, without the planner any.
    pub fn cutting_volume(&self) -> Option<&ClipVolume> {
        self.clip_volume.as_deref().filter(|clip| !self.settings.method.planner || clip.cuts)
    }
}
