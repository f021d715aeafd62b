//! The rows of the tables.

/// A row of a table: what was counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PaperRow {
    /// Early z alone: rays end when they are opaque; in chapter 6 perhaps.
    Ert,
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
    /// With geometry, where segments that end at a surface are drawn in a pass of their own [Thesis ch. 6 §7], which the
    /// thesis did not count. Rays are looked at before the first main pass too, since theirs may be such a segment.
    BlockFirstApart,
    OptimalApart,
    OmniApart,
    /// The lower bound; not in the thesis.
    Ideal,
}

impl PaperRow {
    pub const ALL: [Self; 12] = [
        Self::Ert,
        Self::Block,
        Self::BlockFirst,
        Self::Optimal,
        Self::Omni,
        Self::Directional,
        Self::OptimalEach,
        Self::OmniEach,
        Self::BlockFirstApart,
        Self::OptimalApart,
        Self::OmniApart,
        Self::Ideal,
    ];

    /// The row that draws segments apart, where there is one.
    pub fn apart(self) -> Option<Self> {
        match self {
            Self::BlockFirst => Some(Self::BlockFirstApart),
            Self::Optimal => Some(Self::OptimalApart),
            Self::Omni => Some(Self::OmniApart),
            _ => None,
        }
    }

    /// The row that draws segments within their passes, where this one draws them apart.
    pub fn within(self) -> Option<Self> {
        Self::ALL.into_iter().find(|row| row.apart() == Some(self))
    }

    pub fn name(self) -> &'static str {
        match self {
            Self::Ert => "rc-ert",
            Self::Block => "rc-block",
            Self::BlockFirst => "rc-block (block first)",
            Self::Optimal => "nn-optimal",
            Self::Omni => "nn-omni",
            Self::Directional => "nn-directional",
            Self::OptimalEach => "nn-optimal (8 lookups)",
            Self::OmniEach => "nn-omni (8 lookups)",
            Self::BlockFirstApart => "rc-block (first, apart)",
            Self::OptimalApart => "nn-optimal (apart)",
            Self::OmniApart => "nn-omni (apart)",
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
