//! Procedural volumes whose value and gradient are known in closed form, so that every command and test has data
//! and a truth to compare with.
//!
//! They are functions of p in [-1, 1]^3, which is texture space stretched: p = 2 * texture - 1. Tubes, shells and
//! boxes are made of two profiles that reach 0 with two continuous derivatives: `bump` and `smoothstep`.

use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::volume::{Volume, Voxels};
use crate::error::{Error, Result};

/// Voxels along a side where a specification names none.
pub const DEFAULT_SIZE: usize = 64;

/// The volume of a scene that names none.
pub const DEFAULT: &str = "shells:64";
/// The longest side.
pub const MAX_SIZE: usize = 2048;
/// The most voxels of one volume, 1024^3: a field of 4 GiB.
pub const MAX_VOXELS: usize = 1 << 30;

/// A scalar function on [-1, 1]^3 with its gradient.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    pub name: &'static str,
    /// One line for `--help` and reports.
    pub about: &'static str,
    /// How its voxels are kept.
    pub stored: BuiltinVoxels,
    value: fn(DVec3) -> f64,
    gradient: fn(DVec3) -> DVec3,
}

/// How the voxels of a built-in volume are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltinVoxels {
    /// u8: round(255 * value), as scanners and old data sets give it.
    U8,
    /// f32: the value, for comparison with the closed form.
    F32,
}

impl Builtin {
    /// The value at `p`, from 0 to 1.
    pub fn value(&self, p: DVec3) -> f64 {
        (self.value)(p)
    }

    /// The derivative of the value after `p` (not after texture space, where it is twice as large).
    pub fn gradient(&self, p: DVec3) -> DVec3 {
        (self.gradient)(p)
    }
}

/// Every built-in volume. `shells`, `jets` and `blocks` (u8) are exactly 0 in more than 60 % of their cells from
/// 64^3 on, and on all six faces; the others (f32) reach the faces.
pub const ALL: [Builtin; 7] = [
    Builtin {
        name: "marschner-lobb",
        about: "the Marschner-Lobb test signal; f32, reaches the faces",
        stored: BuiltinVoxels::F32,
        value: marschner_lobb,
        gradient: marschner_lobb_gradient,
    },
    Builtin {
        name: "shells",
        about: "three thin concentric shells with empty space between; u8, 0 at the faces",
        stored: BuiltinVoxels::U8,
        value: shells,
        gradient: shells_gradient,
    },
    Builtin {
        name: "jets",
        about: "a straight jet and five that wind around it, sparse as vessels are; u8, 0 at the faces",
        stored: BuiltinVoxels::U8,
        value: jets,
        gradient: jets_gradient,
    },
    Builtin {
        name: "blocks",
        about: "boxes, a rod and a thin wall whose faces lie on seams of 8^3 blocks; u8, 0 at the faces",
        stored: BuiltinVoxels::U8,
        value: blocks,
        gradient: blocks_gradient,
    },
    Builtin {
        name: "constant",
        about: "0.5 everywhere; f32, reaches the faces",
        stored: BuiltinVoxels::F32,
        value: |_| 0.5,
        gradient: |_| DVec3::ZERO,
    },
    Builtin {
        name: "linear",
        about: "rises along x from 0 to 1; f32, reaches the faces",
        stored: BuiltinVoxels::F32,
        value: |p| 0.5 + 0.5 * p.x,
        gradient: |_| DVec3::new(0.5, 0.0, 0.0),
    },
    Builtin {
        name: "gaussian",
        about: "a round Gaussian, 1 at the centre; f32, nearly 0 at the faces",
        stored: BuiltinVoxels::F32,
        value: gaussian,
        gradient: |p| -p / GAUSSIAN_SIGMA.powi(2) * gaussian(p),
    },
];

/// The built-in volume of that name.
///
/// # Errors
/// When there is none; the nearest name is given.
pub fn find(name: &str) -> Result<&'static Builtin> {
    static TABLE: [Builtin; 7] = ALL;
    TABLE.iter().find(|b| b.name == name).ok_or_else(|| {
        let names = TABLE.iter().map(|b| b.name);
        let near = nearest(name, names.clone()).map_or(String::new(), |n| format!("did you mean `{n}`? "));
        let known = names.collect::<Vec<_>>().join(", ");
        Error::usage(format!("builtin:{name}"), "is not a built-in volume", format!("{near}choose one of {known}"))
    })
}

/// The volume `NAME`, `NAME:SIZE` or `NAME:NXxNYxNZ` (a leading `builtin:` is allowed), evaluated at its voxel
/// centres, spacing 1.
///
/// # Errors
/// When the name is unknown, a side is not 1 to [`MAX_SIZE`], there are more than [`MAX_VOXELS`] or no memory
/// for them.
pub fn volume(spec: &str) -> Result<Volume> {
    let spec = spec.strip_prefix("builtin:").unwrap_or(spec);
    let (name, size) = spec.split_once(':').map_or((spec, None), |(name, size)| (name, Some(size)));
    let builtin = find(name)?;
    let label = format!("builtin:{spec}");
    let dims = size.map_or(Ok([DEFAULT_SIZE; 3]), |size| sizes(&label, size))?;
    let voxels = match builtin.stored {
        BuiltinVoxels::U8 => fill(&label, builtin, dims, |v| (255.0 * v).round() as u8).map(Voxels::U8),
        BuiltinVoxels::F32 => fill(&label, builtin, dims, |v| v as f32).map(Voxels::F32),
    }?;
    Volume::new(label, dims, [1.0; 3], voxels)
}

/// The sides in `SIZE` or `NXxNYxNZ`.
fn sizes(label: &str, text: &str) -> Result<[usize; 3]> {
    let sides: Option<Vec<usize>> =
        text.split('x').map(|s| s.parse().ok().filter(|n| (1..=MAX_SIZE).contains(n))).collect();
    let dims = match sides.as_deref() {
        Some(&[n]) => [n; 3],
        Some(&[x, y, z]) => [x, y, z],
        _ => {
            let remedy = format!("give one side or three as 64x32x16, each from 1 to {MAX_SIZE}");
            return Err(Error::usage(label, format!("has the size `{}`", text.escape_debug()), remedy));
        }
    };
    if dims.iter().try_fold(1usize, |n, &d| n.checked_mul(d)).is_none_or(|n| n > MAX_VOXELS) {
        let remedy = format!("choose a smaller size, at most {MAX_VOXELS} voxels (1024x1024x1024)");
        return Err(Error::usage(label, format!("has too many voxels ({dims:?})"), remedy));
    }
    Ok(dims)
}

/// The values at the voxel centres, x fastest. `dims` has passed [`sizes`].
fn fill<T: Send>(label: &str, builtin: &Builtin, dims: [usize; 3], store: fn(f64) -> T) -> Result<Vec<T>> {
    let count = dims.iter().product();
    let mut values = Vec::new();
    values.try_reserve_exact(count).map_err(|_| {
        Error::usage(
            label,
            format!("has {count} voxels, and there is not enough memory for them"),
            "choose a smaller size",
        )
    })?;
    values.par_extend((0..count).into_par_iter().map(|i| {
        let voxel = [i % dims[0], i / dims[0] % dims[1], i / (dims[0] * dims[1])];
        let p = DVec3::from_array(std::array::from_fn(|a| 2.0 * (voxel[a] as f64 + 0.5) / dims[a] as f64 - 1.0));
        store(builtin.value(p))
    }));
    Ok(values)
}

/// The known name that is most like `wanted`, if any is like it at all.
pub fn nearest<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    /// Two names that share less (Jaro-Winkler, 0 to 1) are not one another's misspelling.
    const ALIKE: f64 = 0.7;
    known
        .into_iter()
        .map(|name| (strsim::jaro_winkler(wanted, name), name))
        .filter(|(likeness, _)| *likeness >= ALIKE)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// (1 - s)^3 below s = 1, 0 beyond, for s = (distance / half width)^2.
fn bump(s: f64) -> f64 {
    (1.0 - s).max(0.0).powi(3)
}

/// Derivative of [`bump`] after s.
fn bump_slope(s: f64) -> f64 {
    -3.0 * (1.0 - s).max(0.0).powi(2)
}

/// 0 below 0, 1 above 1, 6 t^5 - 15 t^4 + 10 t^3 between.
fn smoothstep(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t.powi(3) * (t * (6.0 * t - 15.0) + 10.0)
}

/// Derivative of [`smoothstep`] after t.
fn smoothstep_slope(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    30.0 * (t * (1.0 - t)).powi(2)
}

const GAUSSIAN_SIGMA: f64 = 0.3;

fn gaussian(p: DVec3) -> f64 {
    (-0.5 * p.length_squared() / GAUSSIAN_SIGMA.powi(2)).exp()
}

/// Frequency f_M and amplitude alpha of the signal's ripple, as Marschner and Lobb (An Evaluation of
/// Reconstruction Filters for Volume Rendering, VIS 1994) chose them.
const ML_FREQUENCY: f64 = 6.0;
const ML_ALPHA: f64 = 0.25;

/// (1 - sin(pi z / 2) + alpha (1 + rho(r))) / (2 (1 + alpha)) with rho(r) = cos(2 pi f_M cos(pi r / 2)) and r the
/// distance from the z axis.
fn marschner_lobb(p: DVec3) -> f64 {
    let r = p.truncate().length();
    let ripple = (TAU * ML_FREQUENCY * (FRAC_PI_2 * r).cos()).cos();
    (1.0 - (FRAC_PI_2 * p.z).sin() + ML_ALPHA * (1.0 + ripple)) / (2.0 * (1.0 + ML_ALPHA))
}

fn marschner_lobb_gradient(p: DVec3) -> DVec3 {
    let r = p.truncate().length();
    let (sin, cos) = (FRAC_PI_2 * r).sin_cos();
    let slope = PI * PI * ML_FREQUENCY * sin * (TAU * ML_FREQUENCY * cos).sin();
    // The ripple is even in r, so its slope on the axis is 0.
    let across = p.truncate().try_normalize().unwrap_or(DVec2::ZERO) * (ML_ALPHA * slope);
    across.extend(-FRAC_PI_2 * (FRAC_PI_2 * p.z).cos()) / (2.0 * (1.0 + ML_ALPHA))
}

/// Radius and peak value of each shell: the brighter one lies inside the dimmer.
const SHELLS: [(f64, f64); 3] = [(0.3, 1.0), (0.55, 0.75), (0.8, 0.5)];
const SHELL_HALF_WIDTH: f64 = 0.07;

fn shells(p: DVec3) -> f64 {
    let r = p.length();
    SHELLS.iter().map(|(radius, peak)| peak * bump(((r - radius) / SHELL_HALF_WIDTH).powi(2))).sum()
}

fn shells_gradient(p: DVec3) -> DVec3 {
    let r = p.length();
    let slope = SHELLS.iter().map(|(radius, peak)| {
        let t = (r - radius) / SHELL_HALF_WIDTH;
        peak * bump_slope(t * t) * 2.0 * t / SHELL_HALF_WIDTH
    });
    p.try_normalize().unwrap_or(DVec3::ZERO) * slope.sum::<f64>()
}

const WINDING_JETS: usize = 5;
/// Turn of the winding jets along z, radians per unit.
const JET_TURN: f64 = 1.6;
/// Jets end at this |z|.
const JET_END: f64 = 0.9;

/// Centre of a jet at height z and its derivative: jet 0 is the axis, the others wind around it on a cone.
fn jet_centre(jet: usize, z: f64) -> (DVec2, DVec2) {
    if jet == 0 {
        return (DVec2::ZERO, DVec2::ZERO);
    }
    let (radius, opening) = (0.4 + 0.25 * z, 0.25);
    let outward = DVec2::from_angle(TAU * jet as f64 / WINDING_JETS as f64 + JET_TURN * z);
    (radius * outward, opening * outward + radius * JET_TURN * outward.perp())
}

/// Radius of every jet at height z and its derivative.
fn jet_radius(z: f64) -> (f64, f64) {
    (0.1 + 0.03 * z, 0.03)
}

/// The share of a jet's value left at height z and its derivative: whole in the middle, 0 at the ends.
fn jet_fade(z: f64) -> (f64, f64) {
    let u = z / JET_END;
    (bump(u.powi(4)), bump_slope(u.powi(4)) * 4.0 * u.powi(3) / JET_END)
}

/// Horizontal circles about each centre. Near the nozzle at -z the jets come close but do not overlap.
fn jets(p: DVec3) -> f64 {
    let (radius, _) = jet_radius(p.z);
    let across = |jet| bump((p.truncate() - jet_centre(jet, p.z).0).length_squared() / (radius * radius));
    (0..=WINDING_JETS).map(across).sum::<f64>() * jet_fade(p.z).0
}

fn jets_gradient(p: DVec3) -> DVec3 {
    let ((radius, widening), (fade, fading)) = (jet_radius(p.z), jet_fade(p.z));
    let one = |jet| {
        let (centre, leaning) = jet_centre(jet, p.z);
        let d = p.truncate() - centre;
        let s = d.length_squared() / (radius * radius);
        let s_across = 2.0 * d / (radius * radius);
        let s_along = -s_across.dot(leaning) - 2.0 * s * widening / radius;
        (bump_slope(s) * fade * s_across).extend(bump_slope(s) * fade * s_along + bump(s) * fading)
    };
    (0..=WINDING_JETS).map(one).sum()
}

struct Block {
    centre: DVec3,
    half: DVec3,
    /// Over this depth inside each face the value rises from 0.
    rise: f64,
    value: f64,
}

/// None overlap. Outlines lie on multiples of 1/4, which are seams of 8^3 blocks in volumes of 64, 128, ... voxels:
/// the first two boxes meet at one, and the wall straddles one with its brightest voxels on both sides.
const BLOCKS: [Block; 5] = [
    block([-0.5, -0.5, -0.25], [0.25, 0.25, 0.5], 0.1, 1.0),
    block([0.0, -0.5, -0.25], [0.25, 0.25, 0.25], 0.1, 0.7),
    block([0.5, 0.5, 0.5], [0.25, 0.25, 0.25], 0.1, 0.85),
    block([0.0, 0.0, 0.0], [0.75, 0.07, 0.75], 0.07, 0.55),
    block([-0.5, 0.5, 0.0], [0.1, 0.1, 0.75], 0.1, 0.65),
];

const fn block(centre: [f64; 3], half: [f64; 3], rise: f64, value: f64) -> Block {
    Block { centre: DVec3::from_array(centre), half: DVec3::from_array(half), rise, value }
}

impl Block {
    /// Depth inside the faces across each axis, 1 where the value has risen in full.
    fn depth(&self, p: DVec3) -> DVec3 {
        (self.half - (p - self.centre).abs()) / self.rise
    }
}

fn blocks(p: DVec3) -> f64 {
    BLOCKS.iter().map(|b| b.value * b.depth(p).to_array().map(smoothstep).iter().product::<f64>()).sum()
}

fn blocks_gradient(p: DVec3) -> DVec3 {
    let one = |b: &Block| {
        let step = DVec3::from_array(b.depth(p).to_array().map(smoothstep));
        let slope = DVec3::from_array(b.depth(p).to_array().map(smoothstep_slope));
        let inward = -(p - b.centre).signum() / b.rise;
        let others = DVec3::new(step.y * step.z, step.z * step.x, step.x * step.y);
        b.value * inward * slope * others
    };
    BLOCKS.iter().map(one).sum()
}
