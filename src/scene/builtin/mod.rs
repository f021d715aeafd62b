//! Procedural volumes whose value and gradient are known in closed form, so that every command and test has data
//! and a truth to compare with.
//!
//! They are functions of p in [-1, 1]^3, which is texture space stretched: p = 2 * texture - 1. Tubes, shells and
//! boxes are made of two profiles that reach 0 with two continuous derivatives: `bump` and `smoothstep`.
//!
//! **To add a volume**: its value and gradient in a file here, its row in [`ALL`]; `tests/scene.rs` goes through the rows.

mod blocks;
mod engine;
mod head;
mod profile;
mod signals;

use glam::DVec3;
use rayon::prelude::*;

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

/// Every built-in volume. Those in u8 are exactly 0 in more than 60 % of their cells from 64^3 on, and on all six faces; the
/// others (f32) reach the faces.
pub const ALL: [Builtin; 10] = [
    Builtin {
        name: "marschner-lobb",
        about: "the Marschner-Lobb test signal; f32, reaches the faces",
        stored: BuiltinVoxels::F32,
        value: signals::marschner_lobb,
        gradient: signals::marschner_lobb_gradient,
    },
    Builtin {
        name: "shells",
        about: "three thin concentric shells with empty space between; u8, 0 at the faces",
        stored: BuiltinVoxels::U8,
        value: signals::shells,
        gradient: signals::shells_gradient,
    },
    Builtin {
        name: "jets",
        about: "a straight jet and five that wind around it, sparse as vessels are; u8, 0 at the faces",
        stored: BuiltinVoxels::U8,
        value: signals::jets,
        gradient: signals::jets_gradient,
    },
    Builtin {
        name: "blocks",
        about: "boxes, a rod and a thin wall whose faces lie on seams of 8^3 blocks; u8, 0 at the faces",
        stored: BuiltinVoxels::U8,
        value: blocks::blocks,
        gradient: blocks::blocks_gradient,
    },
    Builtin {
        name: "engine",
        about: "a casting with two lined bores, a tunnel across them and bolts, in two densities; u8, 0 at the faces",
        stored: BuiltinVoxels::U8,
        value: |p| engine::engine(p).value,
        gradient: |p| engine::engine(p).gradient,
    },
    Builtin {
        name: "head",
        about: "skin, skull and what is in it, as nested ellipsoids; u8, 0 at the faces",
        stored: BuiltinVoxels::U8,
        value: |p| head::head(p).value,
        gradient: |p| head::head(p).gradient,
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
        value: signals::gaussian,
        gradient: |p| -p / signals::GAUSSIAN_SIGMA.powi(2) * signals::gaussian(p),
    },
    Builtin {
        name: "torus",
        about: "a Gaussian about a ring in the plane y = 0; f32, nearly 0 at the faces",
        stored: BuiltinVoxels::F32,
        value: signals::torus,
        gradient: signals::torus_gradient,
    },
];

/// The built-in volume of that name.
///
/// # Errors
/// When there is none; the nearest name is given.
pub fn find(name: &str) -> Result<&'static Builtin> {
    static TABLE: [Builtin; 10] = ALL;
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
