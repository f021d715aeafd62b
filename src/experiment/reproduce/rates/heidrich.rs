//! The frame rates of [Heidrich95, Table 1]: shells of emissive volumes, their greatest emission and the sum, beside rays.

use std::path::PathBuf;

use super::{RateSet, RateTable, Renderer, seen_near, whole_file};
use crate::method;
use crate::scene::settings::{Last, Settings, ShellMode, ShellOrder, ShellSum};

/// Shells by both operators, and rays that skip what adds nothing.
pub const HEIDRICH: RateTable = RateTable {
    paper: "Heidrich95",
    title: "Frame rates of emissive shells",
    renderers: &[
        Renderer { name: "Maximum", method: &method::SHELLS, adapt: |s| s.shells.mode = Some(ShellMode::Max) },
        Renderer { name: "Summation", method: &method::SHELLS, adapt: |s| s.shells.mode = Some(ShellMode::Sum) },
        Renderer { name: "Maximum by rays", method: &method::NN_OMNI, adapt: |s| s.shells.mode = Some(ShellMode::Max) },
        Renderer {
            name: "Summation by rays",
            method: &method::NN_OMNI,
            adapt: |s| (s.shells.mode, s.shells.sum) = (Some(ShellMode::Sum), ShellSum::Lengths),
        },
    ],
    base: 0,
    sets: &SETS,
    base_set: Some(0),
    sizes: &[512],
    common: |settings| {
        // Shells are made by the reader, whatever is made of them.
        settings.shells.mode = Some(ShellMode::Max);
        settings.sampling.last = Last::Full;
    },
    main: "levels in the middle of equal parts of the scalar range, lengths summed up, brightest first, eye 1.91 away",
    choices: &[
        ("levels", "from a tenth of the scalar range on", |s| s.volume.range = Some([25.5, 255.0].map(Into::into))),
        ("levels", "in the lower half of the scalar range", |s| s.volume.range = Some([0.0, 127.5].map(Into::into))),
        ("summation", "emissions at crossings, as in the paper", |s| s.shells.sum = ShellSum::Crossings),
        ("order", "dimmest first", |s| s.shells.order = ShellOrder::Dimmest),
        ("view", "eye 1.4 away", seen_near),
    ],
    open: &OPEN,
};

const SETS: [RateSet; 4] = [
    RateSet {
        name: "Hipip 1",
        dims: [64; 3],
        file: "neghip.nrrd",
        open: Ok(|settings, path| shells(settings, path, 11)),
        remark: Some("the paper's 11 shells have 44,846 polygons"),
        step: 1.0,
        theirs: &[&[8.51], &[5.60], &[], &[]],
    },
    RateSet {
        name: "Hipip 2",
        dims: [64; 3],
        file: "neghip.nrrd",
        open: Ok(|settings, path| shells(settings, path, 6)),
        remark: Some("the paper's 6 shells have 14,844 polygons, and more than 20 frames per second by maximum"),
        step: 1.0,
        theirs: &[&[], &[12.0], &[], &[]],
    },
    RateSet {
        name: "Angiogram",
        dims: [256, 256, 124],
        file: "mra_tof.nrrd",
        open: Ok(|settings, path| shells(settings, path, 12)),
        remark: Some(
            "mra_tof.nrrd is another scan, of 200 x 256 x 120 voxels; the paper's 12 shells have 177,594 polygons",
        ),
        step: 1.0,
        theirs: &[&[2.66], &[1.38], &[], &[]],
    },
    RateSet {
        name: "Sat",
        dims: [21, 21, 51],
        file: "",
        open: Err("the groundwater simulation is not available"),
        remark: None,
        step: 1.0,
        theirs: &[&[], &[5.48], &[], &[]],
    },
];

/// The whole file as so many shells.
fn shells(settings: &mut Settings, path: PathBuf, count: u32) {
    whole_file(settings, path);
    settings.shells.count = count;
}

const OPEN: [(&str, &str); 6] = [
    (
        "platform",
        "three of them. The numbers here are those of the Onyx, whose hardware blends; the Indigo has 1.59, 4.50 and 0.74 by \
         maximum and 0.23, 0.41 and 0.071 by summation on the first three sets, the Alpha 1.63, 4.26, 0.39 and 0.047, 0.080, 0.040",
    ),
    (
        "levels of the shells",
        "not given. Here in the middle of equal parts of the scalar range; swept: from a tenth of it on, and in its lower half",
    ),
    ("order of the shells", "not given without surfaces. Here the brightest first; swept: the dimmest first"),
    (
        "summation",
        "the sum of emissions at crossings. Here ways within shells times what they rise by, whose sum goes to the emission \
         integral; swept: emissions at crossings",
    ),
    ("viewport", "not given. Here 512 x 512"),
    (
        "view",
        "not given. Here a tilt of 20 degrees and a vertical field of view of 45 degrees, the eye 1.91 longest sides from the \
         volume's centre; swept: 1.4",
    ),
];
