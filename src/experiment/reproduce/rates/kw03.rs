//! The frame rates of [KW03, Table 1]: slices, and ray casting without and with its accelerations.

use super::{NO_TERMINATION, RateSet, RateTable, Renderer, TERMINATION, seen_near, whole_file};
use crate::method;
use crate::scene::settings::{Last, Settings};

/// M, "restricted to 8 due to hardware shader limitations" [KW03 §3].
const SAMPLES_PER_PASS: u32 = 8;

/// One of the volumes of 256^3 voxels, but for its file.
const CUBE: RateSet =
    RateSet { name: "", dims: [256; 3], file: "", open: Ok(whole_file), remark: None, step: 1.0, theirs: &[] };

/// Slices, and ray casting without acceleration, with early ray termination, and with empty-space skipping besides.
pub const KW03: RateTable = RateTable {
    paper: "KW03",
    title: "Frame rates of slices and of ray casting with its accelerations",
    renderers: &[
        Renderer { name: "SBVR", method: &method::SLICES_3D, adapt: |_| {} },
        Renderer { name: "RC", method: &method::RC, adapt: |_| {} },
        Renderer { name: "RC-a", method: &method::RC_ERT, adapt: |_| {} },
        Renderer { name: "RC-b", method: &method::RC_BLOCK, adapt: |_| {} },
    ],
    base: 1,
    sets: &[
        RateSet {
            name: "Head",
            file: "mri_head.nrrd",
            remark: Some("mri_head.nrrd is an MRI head of that size from the collection that the paper names"),
            theirs: &[&[7.1], &[4.8], &[14.4], &[23.4]],
            ..CUBE
        },
        RateSet { name: "Aneurism", file: "aneurism.nrrd", theirs: &[&[7.1], &[4.8], &[8.9], &[19.6]], ..CUBE },
        RateSet {
            name: "Foot",
            open: Err("the Philips scan is not available"),
            theirs: &[&[7.1], &[4.8], &[10.2], &[17.7]],
            ..CUBE
        },
        RateSet {
            name: "Engine",
            dims: [256, 256, 128],
            file: "engine.nrrd",
            theirs: &[&[10.4], &[6.3], &[6.3], &[13.6]],
            ..CUBE
        },
    ],
    base_set: None,
    sizes: &[512],
    common: |settings| {
        settings.sampling.samples_per_pass = SAMPLES_PER_PASS;
        settings.sampling.termination = TERMINATION;
        settings.sampling.last = Last::Full;
    },
    main: "ramp, T = 0.95, steps of a voxel, eye 1.91 away",
    choices: &[
        ("transfer function", "surface", |s| transfer(s, "surface")),
        ("transfer function", "haze", |s| transfer(s, "haze")),
        ("early ray termination", "T = 1", |s| s.sampling.termination = NO_TERMINATION),
        ("view", "eye 1.4 away", seen_near),
    ],
    open: &[
        (
            "transfer function",
            "not given; the figure shows opaque structures. Here `ramp`; swept: `surface`, and `haze`, for whose like the paper \
             states that the intermediate pass costs about 30 %",
        ),
        ("early ray termination", "the threshold is not given. Here T = 0.95; swept: T = 1"),
        ("sampling distance", "not given. Here a voxel for slices and rays alike"),
        (
            "view",
            "not given. Here a tilt of 20 degrees and a vertical field of view of 45 degrees, the eye 1.91 longest sides from \
             the volume's centre, in several directions; swept: 1.4",
        ),
        ("number of passes", "N is not given. Here as many as the longest ray of the view needs"),
        (
            "the end of a ray",
            "not given. Here the last sample counts in full, so that slices and rays have as many samples",
        ),
        ("geometry of slices", "not given. Here planes across the view direction, cut on the host"),
    ],
};

fn transfer(settings: &mut Settings, preset: &str) {
    settings.transfer.preset = Some(preset.to_owned());
}
