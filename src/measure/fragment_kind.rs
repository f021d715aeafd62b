//! What a fragment of a method is: counts of one kind say nothing beside those of another.

use crate::method;
use crate::part::rows::{CellWalk, Traversal};

/// What a main fragment stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FragmentKind {
    /// A segment of a ray: M samples.
    Segment,
    /// A whole ray.
    Ray,
    /// A pixel of a compute shader's targets, with the whole ray where it has one.
    Pixel,
    /// A single sample.
    Sample,
    /// A place where a ray meets a shell.
    Crossing,
    /// A cell that a ray goes through.
    Cell,
}

impl FragmentKind {
    /// That of a method, by its name; none where it runs on no device.
    pub fn of(method: &str) -> Option<Self> {
        let row = method::METHODS.iter().find(|row| row.name == method && row.on_device)?;
        Some(match row.traversal {
            Traversal::Passes => Self::Segment,
            Traversal::FragmentLoop | Traversal::Cells(CellWalk::FragmentLoop) => Self::Ray,
            Traversal::ComputeLoop | Traversal::Cells(CellWalk::ComputeLoop) => Self::Pixel,
            Traversal::Cells(CellWalk::Passes) => Self::Cell,
            Traversal::Slices(_) => Self::Sample,
            Traversal::Shells => Self::Crossing,
        })
    }

    /// The word for so many of what it stands for.
    pub fn noun(self) -> &'static str {
        match self {
            Self::Segment => "segments",
            Self::Ray => "rays",
            Self::Pixel => "invocations",
            Self::Sample => "samples",
            Self::Crossing => "crossings",
            Self::Cell => "cells",
        }
    }

    /// What its counts are, where they are not those of segments.
    pub fn words(self) -> Option<&'static str> {
        match self {
            Self::Segment => None,
            Self::Ray => Some("a fragment is a ray: its loop takes all samples of it"),
            Self::Pixel => {
                Some("fragments are invocations of a compute shader, one for each pixel that the box may cover")
            }
            Self::Sample => Some("a fragment is a sample: it has one on each slice"),
            Self::Crossing => Some("a fragment is a place where a ray meets a shell"),
            Self::Cell => Some(
                "a fragment is a cell that a ray goes through, or nothing where its ray has ended in the pass before",
            ),
        }
    }

    /// Why its counts are not held against those of segments; none of those.
    pub fn apart(self) -> Option<&'static str> {
        match self {
            Self::Segment => None,
            Self::Ray | Self::Pixel => Some("a fragment is a ray here, not a segment of one"),
            Self::Sample => Some("a fragment is a sample here, not a segment of several"),
            Self::Crossing => Some("a fragment is a place where a ray meets a shell here, not a segment of samples"),
            Self::Cell => Some("a fragment is a cell here, not a segment of samples"),
        }
    }
}
