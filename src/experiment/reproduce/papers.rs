//! The numbers of the thesis' tables, and the views they were counted in.
//!
//! Thesis §5.4, Tables 1 and 2; Thesis §7.1, Table 1; with polygons, [`embedded`]. What a view was follows from its counts:
//! block skipping runs every fragment of the front face in every intermediate pass, so 9,891,936 = 428^2 x 54, 2,381,392 =
//! 428^2 x 13 and 489,268 = 194^2 x 13. Read as one intermediate pass less than main passes, of M = 8 samples, the steps were
//! 0.004 and 0.016 of the cube's side.

use super::embedded::{self, Geometry};
pub use super::paper_row::{PaperRow, Published};

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
    /// Empty for volumes that are not in the thesis, and where polygons are counted.
    pub rows: &'static [Published],
    /// Polygons in the volume, and what was counted with them.
    pub geometry: Option<Geometry>,
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
    geometry: None,
};

/// And for 64^3.
const SMALL: DataSet = DataSet { side: 64, step: 0.016, intermediate_passes: 13, ..LARGE };

/// Columns are added at the end: those of older results stand in front.
pub const DATA_SETS: [DataSet; 10] = [
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
    DataSet {
        name: "Foot with geometry",
        source: "Thesis ch. 6 §4, Tables 1 and 2",
        file: Some(embedded::FOOT.scene.file),
        remark: Some(
            "the Philips scan is not available; foot_cadaver.nrrd is another foot, whose box of 133 x 162 x 120 voxels covers \
             fewer pixels than the thesis' cube",
        ),
        side: 162,
        geometry: Some(embedded::FOOT),
        ..LARGE
    },
    DataSet {
        name: "Engine with geometry",
        source: "not in the thesis",
        file: Some(embedded::ENGINE.scene.file),
        remark: Some("the engine block, counted as the thesis counts the foot"),
        geometry: Some(embedded::ENGINE),
        ..LARGE
    },
    DataSet {
        name: "Chapter 7 with geometry",
        source: "Thesis §7.2, Table 2",
        file: Some(embedded::FUEL.scene.file),
        remark: Some("the thesis says nothing of this geometry; fuel is our guess, as in its Table 1"),
        face: 194,
        geometry: Some(embedded::FUEL),
        ..SMALL
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
pub const OPEN: [(&str, &str); 12] = [
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
    (
        "geometry of chapter 6",
        "\"a transparent blue sphere embedded in the volume and a green arrow behind the sphere\" [Thesis ch. 6, Figure 3], \
         without numbers. Here a guess: a sphere whose diameter is 0.34 of the foot's longest side, and an opaque arrow 0.7 long \
         behind it; in the engine a sphere and an arrow through it; in chapter 7 a sphere and a transparent arrow",
    ),
    ("early z of chapter 6", "with or without empty blocks is not said. Both are shown as rows, rc-block and rc-ert"),
    ("near neighbor of chapter 6", "which distances are looked up is not said. All three are shown as rows"),
    (
        "depth layers",
        "\"three depth layers\", whose last one is behind the volume's box; in chapter 7 the intermediate fragments of early z \
         are 4 times those without geometry. Here two layers are peeled, three in chapter 7, so that rays have as many \
         parts; layer 0 of both is the part in front of the first surface",
    ),
    (
        "begin of a layer",
        "the thesis processes \"all fragments ... at least once per layer, to set the initial value to skip\". Here rays \
         without a surface there are left out by near-neighbor skipping; behind a surface the first main pass has an \
         intermediate pass in front of it, one more than in front of the first surface",
    ),
];
