//! The frame rates of [Stegmaier05, Table 1], the volumes they are of, and what the paper leaves open.
//!
//! Its sampling distance was such that it "reflected the actual number of slices contained in the data set": one slice of
//! the paper's volume, whatever the size of the one that is there.

use std::path::PathBuf;

use crate::method;
use crate::part::rows::Method;
use crate::scene::settings::{ClipSettings, Settings};

/// A way of rendering that the table compares.
#[derive(Clone, Copy)]
pub struct Renderer {
    /// As the paper calls it.
    pub name: &'static str,
    /// The method of ours.
    pub method: &'static Method,
}

/// The table's halves. **To add one**: its row here, and its rates in `theirs` of each of [`RATE_SETS`].
pub const RENDERERS: [Renderer; 1] = [Renderer { name: "Raycasting", method: &method::SINGLE_PASS }];

/// Sides of the table's square viewports, pixels.
pub const RATE_SIZES: [u32; 2] = [512, 1024];

/// The place in [`RATE_SETS`] of the data set that the rates of the others are told in: the one whose volume is the paper's.
pub const RATE_BASE: usize = 1;

/// Makes settings see the volume of a file.
pub type OpenVolume = fn(&mut Settings, PathBuf);

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct RateSet {
    /// As the paper calls it.
    pub name: &'static str,
    /// Voxels of the paper's volume.
    pub dims: [u32; 3],
    /// The file that is this volume, or the one that is nearest to it.
    pub file: &'static str,
    /// How the volume is made of the file, or why it cannot be.
    pub open: std::result::Result<OpenVolume, &'static str>,
    /// What a reader should know of that volume.
    pub remark: Option<&'static str>,
    /// One slice of the paper's volume, in voxels of the file's.
    pub step: f64,
    /// Frames per second by each of [`RENDERERS`] at each of [`RATE_SIZES`].
    pub theirs: [[f64; RATE_SIZES.len()]; RENDERERS.len()],
}

/// The table's rows, in its order.
pub const RATE_SETS: [RateSet; 4] = [
    RateSet {
        name: "Bucky Ball",
        dims: [128, 128, 128],
        file: "buckyball.nrrd",
        open: Ok(whole_file),
        remark: Some(
            "the set of 128^3 voxels is not available; buckyball.nrrd is the same molecule in 32^3 voxels, sampled as often as \
             the paper's, from a texture that is a 64th of its size",
        ),
        step: 0.25,
        theirs: [[14.0, 4.1]],
    },
    RateSet {
        name: "Engine",
        dims: [256, 256, ENGINE_SLICES],
        file: "engine.nrrd",
        open: Ok(engine),
        remark: Some("engine.nrrd has 128 slices, of which a clip plane leaves the paper's 110; the others are empty"),
        step: 1.0,
        theirs: [[10.8, 3.2]],
    },
    RateSet {
        name: "Head",
        dims: [256, 256, 225],
        file: "ct_head.nrrd",
        open: Ok(whole_file),
        remark: Some(
            "ct_head.nrrd has 208 x 256 x 225 voxels: by shape and size a part of the paper's head, which is not proven",
        ),
        step: 1.0,
        theirs: [[7.2, 2.2]],
    },
    RateSet {
        name: "Lucy",
        dims: [256, 256, 512],
        file: "lucy_decimated.ply",
        open: Ok(distances),
        remark: Some("a distance field that is made of lucy_decimated.ply, a mesh of 99,970 of the statue's triangles"),
        step: 1.0,
        theirs: [[7.0, 2.6]],
    },
];

fn whole_file(settings: &mut Settings, path: PathBuf) {
    settings.volume.path = Some(path);
}

/// As many distances to the mesh as the paper has.
fn distances(settings: &mut Settings, path: PathBuf) {
    (settings.volume.mesh, settings.volume.dims) = (Some(path), Some([256, 256, 512]));
}

/// Slices of the paper's engine, and of the file's; both have 256 x 256 voxels in each.
const ENGINE_SLICES: u32 = 110;
const ENGINE_FILE_SLICES: u32 = 128;
const ENGINE_SIDE: f64 = 256.0;

/// The engine's first slices, the view being centred on them.
fn engine(settings: &mut Settings, path: PathBuf) {
    whole_file(settings, path);
    let slices = f64::from(ENGINE_SLICES);
    let top = (slices - 0.5 * f64::from(ENGINE_FILE_SLICES)) / ENGINE_SIDE;
    settings.clips = vec![ClipSettings { plane: Some([0.0, 0.0, -1.0, top]), ..ClipSettings::default() }];
    settings.camera.target[2] = top - 0.5 * slices / ENGINE_SIDE;
}

impl RateSet {
    /// What the paper says of the volume.
    pub fn source(&self) -> String {
        let [x, y, z] = self.dims;
        format!("Stegmaier05, Table 1: {x} x {y} x {z} voxels")
    }
}

/// What the paper leaves open, and what that means here.
pub const RATES_OPEN: [(&str, &str); 8] = [
    (
        "transfer function of the frame rates",
        "not given. Here `ramp`; without early ray termination no method of the table does other work for another one. With it, \
         the table of early ray termination shows what it does",
    ),
    (
        "early ray termination",
        "not in the shader that the paper prints. Here T = 1, which ends no ray early; swept: T = 0.95",
    ),
    ("classification", "pre-integrated in the printed shader. Here too; swept: by the value of each sample"),
    (
        "view",
        "\"while rotating the tilted volume around the y-axis\": neither tilt nor distance is given. Here a tilt of 20 degrees \
         and a vertical field of view of 45 degrees, the eye 1.91 longest sides from the volume's centre; swept: 1.4",
    ),
    (
        "average of frame rates",
        "how it was taken is not said. Here the frames of one turn divided by the time of all of them, each the median of its \
         direction by the wall clock",
    ),
    (
        "sampling distance",
        "one slice. Here one of the paper's volume; swept, where the file has other slices: one of the file's",
    ),
    ("light", "the printed shader has none, and Table 1 names no other. Here none"),
    (
        "texture",
        "value and gradient in one of 8 bits each, which the printed shader reads the value of. Here the value alone, in the \
         format that each run names",
    ),
];
