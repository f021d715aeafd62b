//! The numbers of the thesis' tables with polygons in the volume: ch. 6 §4, Tables 1 and 2, and §7.2, Table 2.
//!
//! A layer of a table is a part of the rays: the first ends at the nearest surface, the last one behind the last surface that
//! is peeled. Early z runs every fragment of the front face in every intermediate pass of each part: 29,675,808 = 3 x 428^2 x
//! 54 and 1,957,072 = 4 x 194^2 x 13.

use super::paper_row::PaperRow;
use crate::scene::scenes::{self, SceneOnData};

/// Main and intermediate fragments.
pub type Fragments = [u64; 2];

/// What the thesis counted by one method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PublishedParts {
    /// Without polygons.
    pub without: Fragments,
    /// Of each part of the rays, front to back; empty where the thesis gives their sum alone.
    pub parts: &'static [Fragments],
    /// With polygons, of all parts.
    pub with: Fragments,
}

/// A method as the thesis names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EmbeddedRow {
    /// The name in the thesis.
    pub name: &'static str,
    /// The rows of ours that it may be.
    pub ours: &'static [PaperRow],
    /// None where the volume is not in the thesis.
    pub theirs: Option<PublishedParts>,
}

/// Polygons in a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Geometry {
    /// The scene with the meshes; its camera and its transfer function are for its picture, not for the counts.
    pub scene: SceneOnData,
    /// Parts of rays that are drawn: one more than layers of polygons.
    pub parts: u32,
    /// The methods, early z first.
    pub rows: &'static [EmbeddedRow],
}

/// What "early z" and "near neighbor" of chapter 6 may be.
const EARLY_Z: &[PaperRow] = &[PaperRow::Block, PaperRow::Ert, PaperRow::BlockFirst, PaperRow::BlockFirstApart];
const NEAR_NEIGHBOR: &[PaperRow] =
    &[PaperRow::Optimal, PaperRow::Omni, PaperRow::Directional, PaperRow::OptimalApart, PaperRow::OmniApart];

/// Thesis ch. 6 §4, Tables 1 and 2.
pub const FOOT: Geometry = Geometry {
    scene: scenes::FOOT,
    parts: 3,
    rows: &[
        EmbeddedRow {
            name: "Early z",
            ours: EARLY_Z,
            theirs: Some(PublishedParts {
                without: [394_987, 9_891_936],
                parts: &[[363_046, 9_891_936], [22_960, 9_891_936], [536, 9_891_936]],
                with: [386_542, 29_675_808],
            }),
        },
        EmbeddedRow {
            name: "Near neighbor",
            ours: NEAR_NEIGHBOR,
            theirs: Some(PublishedParts {
                without: [336_413, 2_088_150],
                parts: &[[281_973, 1_830_186], [27_569, 251_942], [16, 255_178]],
                with: [309_558, 2_337_306],
            }),
        },
    ],
};

/// Counted as [`FOOT`].
pub const ENGINE: Geometry = Geometry {
    scene: scenes::ENGINE,
    parts: 3,
    rows: &[
        EmbeddedRow { name: "Early z", ours: EARLY_Z, theirs: None },
        EmbeddedRow { name: "Near neighbor", ours: NEAR_NEIGHBOR, theirs: None },
    ],
};

/// Thesis §7.2, Table 2.
pub const FUEL: Geometry = Geometry {
    scene: scenes::FUEL,
    parts: 4,
    rows: &[
        EmbeddedRow {
            name: "Early z",
            ours: &[PaperRow::Block, PaperRow::BlockFirst, PaperRow::BlockFirstApart],
            theirs: Some(PublishedParts { without: [89_603, 489_268], parts: &[], with: [79_665, 1_957_072] }),
        },
        EmbeddedRow {
            name: "Optimal near neighbor",
            ours: &[PaperRow::Optimal, PaperRow::OptimalApart],
            theirs: Some(PublishedParts { without: [6_691, 51_992], parts: &[], with: [5_125, 170_587] }),
        },
    ],
};
