//! The frame rates of [Stegmaier05, Table 1]: the single pass beside slices.
//!
//! The sampling distance was such that it "reflected the actual number of slices contained in the data set": one slice of
//! the paper's volume, whatever the size of the one that is there.

use std::path::PathBuf;

use super::{NO_TERMINATION, RateSet, RateTable, Renderer, TERMINATION, seen_near, whole_file};
use crate::method;
use crate::scene::settings::{Classification, ClipSettings, Last, Settings};

/// The place in the table's sets of the engine, the one whose volume is the paper's.
const ENGINE: usize = 1;

/// The single pass beside slices with pre-integration, on volumes of several sizes.
pub const STEGMAIER: RateTable = RateTable {
    paper: "Stegmaier05",
    title: "Frame rates of the single pass and of slices",
    renderers: &[
        Renderer { name: "Raycasting", method: &method::SINGLE_PASS, adapt: |_| {} },
        // Every slice stands for the way to the next one.
        Renderer { name: "Texture-based", method: &method::SLICES_3D, adapt: |s| s.sampling.last = Last::Full },
    ],
    base: 0,
    sets: &SETS,
    base_set: Some(ENGINE),
    sizes: &[512, 1024],
    common: |settings| {
        settings.sampling.termination = NO_TERMINATION;
        settings.sampling.classification = Classification::PreIntegrated;
        settings.sampling.last = Last::None;
    },
    main: "ramp, T = 1, pre-integrated, one slice of the paper's volume, eye 1.91 away",
    choices: &[
        ("early ray termination", "T = 0.95", |s| s.sampling.termination = TERMINATION),
        ("classification", "by the value of each sample", |s| s.sampling.classification = Classification::Post),
        ("sampling distance", "one slice of the file's volume", |s| s.sampling.step = 1.0),
        ("view", "eye 1.4 away", seen_near),
    ],
    open: &OPEN,
};

const SETS: [RateSet; 4] = [
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
        theirs: &[&[14.0, 4.1], &[41.3, 11.5]],
    },
    RateSet {
        name: "Engine",
        dims: [256, 256, ENGINE_SLICES],
        file: "engine.nrrd",
        open: Ok(engine),
        remark: Some("engine.nrrd has 128 slices, of which a clip plane leaves the paper's 110; the others are empty"),
        step: 1.0,
        theirs: &[&[10.8, 3.2], &[25.5, 7.2]],
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
        theirs: &[&[7.2, 2.2], &[16.6, 4.6]],
    },
    RateSet {
        name: "Lucy",
        dims: [256, 256, 512],
        file: "lucy_decimated.ply",
        open: Ok(distances),
        remark: Some(
            "a distance field that is made of lucy_decimated.ply, a mesh of 99,970 of the statue's triangles; the paper's slices \
             could not load theirs",
        ),
        step: 1.0,
        theirs: &[&[7.0, 2.6], &[]],
    },
];

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

const OPEN: [(&str, &str); 9] = [
    (
        "transfer function of the frame rates",
        "not given. Here `ramp`; without early ray termination no method of the table does other work for another one. With it, \
         the table of early ray termination shows what it does",
    ),
    (
        "early ray termination",
        "not in the shader that the paper prints. Here T = 1, which ends no ray early; swept: T = 0.95, which slices back to front \
         take no notice of",
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
    (
        "slices",
        "their geometry is not given. Here planes across the view direction, cut on the host, as many samples of a ray as the \
         single pass takes and one more, which the printed shader leaves out",
    ),
    ("light", "the printed shader has none, and Table 1 names no other. Here none"),
    (
        "texture",
        "value and gradient in one of 8 bits each, which the printed shader reads the value of. Here the value alone, in the \
         format that each run names",
    ),
];
