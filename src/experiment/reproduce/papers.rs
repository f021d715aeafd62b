//! The numbers of the thesis' tables, and the views they were counted in.
//!
//! Thesis §5.4, Tables 1 and 2; Thesis §7.1, Table 1. What a view was follows from its counts: block skipping runs every
//! fragment of the front face in every intermediate pass, so 9,891,936 = 428^2 x 54, 2,381,392 = 428^2 x 13 and 489,268 =
//! 194^2 x 13. Read as one intermediate pass less than main passes, of M = 8 samples, the steps were 0.004 and 0.016 of
//! the cube's side.

/// A row of a table: what was counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PaperRow {
    /// Early z and empty blocks, tested after each main pass [KW03 §2.3].
    Block,
    /// The same, tested before the first main pass too; not in the thesis.
    BlockFirst,
    Optimal,
    Omni,
    Directional,
    /// Omni and optimal, where a ray may look up a distance for every sample of a segment; not in the thesis.
    OmniEach,
    OptimalEach,
    /// The lower bound; not in the thesis.
    Ideal,
}

impl PaperRow {
    pub const ALL: [Self; 8] = [
        Self::Block,
        Self::BlockFirst,
        Self::Optimal,
        Self::Omni,
        Self::Directional,
        Self::OptimalEach,
        Self::OmniEach,
        Self::Ideal,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Block => "rc-block",
            Self::BlockFirst => "rc-block (block first)",
            Self::Optimal => "nn-optimal",
            Self::Omni => "nn-omni",
            Self::Directional => "nn-directional",
            Self::OptimalEach => "nn-optimal (8 lookups)",
            Self::OmniEach => "nn-omni (8 lookups)",
            Self::Ideal => "ideal",
        }
    }
}

/// Fragments of one method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Published {
    pub row: PaperRow,
    pub main: u64,
    pub intermediate: u64,
}

/// A column of the thesis' tables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DataSet {
    /// As the thesis calls it.
    pub name: &'static str,
    pub source: &'static str,
    /// The file that is this very volume; none where none is to be had.
    pub file: Option<&'static str>,
    /// What a reader should know of that file.
    pub remark: Option<&'static str>,
    /// Side of the cube, voxels.
    pub side: u32,
    /// Step, in sides of the cube.
    pub step: f64,
    /// Side of the front face, pixels.
    pub face: u32,
    pub intermediate_passes: u32,
    /// Empty for volumes that are not in the thesis.
    pub rows: &'static [Published],
}

const fn row(row: PaperRow, main: u64, intermediate: u64) -> Published {
    Published { row, main, intermediate }
}

/// The columns of chapter 5 for volumes of 256^3, but for what each has of its own.
const LARGE: DataSet = DataSet {
    name: "",
    source: "Thesis §5.4, Tables 1 and 2",
    file: None,
    remark: None,
    side: 256,
    step: 0.004,
    face: 428,
    intermediate_passes: 54,
    rows: &[],
};

/// And for 64^3.
const SMALL: DataSet = DataSet { side: 64, step: 0.016, intermediate_passes: 13, ..LARGE };

pub const DATA_SETS: [DataSet; 7] = [
    DataSet {
        name: "MRI-Head",
        remark: Some("the volren.org scan of that name is not available; mri_head.nrrd is another head"),
        rows: &[
            row(PaperRow::Block, 869_293, 9_891_936),
            row(PaperRow::Optimal, 181_139, 534_272),
            row(PaperRow::Omni, 744_754, 1_218_485),
            row(PaperRow::Directional, 725_099, 1_458_291),
        ],
        ..LARGE
    },
    DataSet {
        name: "Foot",
        remark: Some("the Philips scan is not available; foot_cadaver.nrrd is another foot"),
        rows: &[
            row(PaperRow::Block, 538_173, 9_891_936),
            row(PaperRow::Optimal, 159_380, 427_510),
            row(PaperRow::Omni, 455_547, 2_134_119),
            row(PaperRow::Directional, 410_729, 1_856_402),
        ],
        ..LARGE
    },
    DataSet {
        name: "Engine",
        file: Some("engine_256cube.nrrd"),
        rows: &[
            row(PaperRow::Block, 309_097, 9_891_936),
            row(PaperRow::Optimal, 65_927, 274_393),
            row(PaperRow::Omni, 186_059, 1_552_627),
            row(PaperRow::Directional, 178_331, 1_367_713),
        ],
        ..LARGE
    },
    DataSet {
        name: "Fuel",
        file: Some("fuel.nrrd"),
        rows: &[
            row(PaperRow::Block, 299_356, 2_381_392),
            row(PaperRow::Optimal, 31_220, 244_118),
            row(PaperRow::Omni, 155_011, 1_106_584),
            row(PaperRow::Directional, 131_495, 916_156),
        ],
        ..SMALL
    },
    DataSet {
        name: "Chapter 7",
        source: "Thesis §7.1, Table 1",
        file: Some("fuel.nrrd"),
        remark: Some(
            "the thesis shows this scene in a figure only; 13 passes fit a 64^3 volume, and fuel is our guess",
        ),
        face: 194,
        rows: &[
            row(PaperRow::Block, 89_603, 489_268),
            row(PaperRow::Optimal, 6_691, 51_992),
            row(PaperRow::Omni, 69_330, 315_061),
            row(PaperRow::Directional, 60_162, 296_217),
        ],
        ..SMALL
    },
    DataSet {
        name: "mri_head",
        source: "not in the thesis",
        file: Some("mri_head.nrrd"),
        remark: Some("another head than the thesis', with its parameters"),
        ..LARGE
    },
    DataSet {
        name: "aneurism",
        source: "not in the thesis",
        file: Some("aneurism.nrrd"),
        remark: Some("vessels, with the thesis' parameters"),
        ..LARGE
    },
];

/// Side of the square viewport, pixels.
pub const VIEWPORT: u32 = 500;

/// Vertical field of view, degrees. The thesis names none; with 45 degrees the front face of the unit cube has 428 pixels
/// from a distance of 1.91.
pub const FOV: f64 = 45.0;

/// Samples of a main pass.
pub const SAMPLES_PER_PASS: u32 = 8;

impl DataSet {
    /// Distance of the eye from the centre of the unit cube from which its front face has `face` pixels: with a field of
    /// view f a length l at the depth d fills l / (2 d tan(f/2)) of the viewport.
    pub fn distance(&self) -> f64 {
        let depth = f64::from(VIEWPORT) / (f64::from(self.face) * 2.0 * (0.5 * FOV.to_radians()).tan());
        // To the hundredth, as a camera would be set.
        ((depth + 0.5) * 100.0).round() / 100.0
    }

    /// Step in voxels.
    pub fn step_voxels(&self) -> f64 {
        self.step * f64::from(self.side)
    }
}

/// What the thesis leaves open, and what that means here.
pub const OPEN: [(&str, &str); 7] = [
    (
        "transfer function",
        "\"a simple linear transfer function\": no points are given. Here `ramp` (0 below a quarter of the range, then \
         linear); swept: linear over the whole range, and linear from 12/255, where a model fitted to the Fuel counts puts \
         the begin",
    ),
    ("threshold T", "not given. Here 0.95; swept: 0.5 and 1, which ends no ray early"),
    ("opacity correction", "not mentioned. Here 1 - (1 - a)^(step / voxel); swept: opacities as they stand"),
    (
        "definition of distance",
        "\"the radius of the largest possible sphere centered on the voxel\", from voxel to voxel, which skips visible \
         samples between voxels. Here between the boxes of cells, which never does; swept: cells of 2^3 voxels, looser still",
    ),
    (
        "lookups of a distance",
        "one by a ray in each intermediate pass. Here too; rows with 8 lookups let it look again from where the first \
         distance ends, as long as that is in the segment",
    ),
    ("end of a ray", "noticed on arrival. Here as soon as the next section lies beyond it; swept: on arrival"),
    ("order of the block test", "KW03 tests after each main pass. Both orders are shown as rows"),
];
