//! `[layers]`: how many surfaces of transparent polygons are peeled, and where segments that surfaces cut are drawn.

use serde::{Deserialize, Serialize};

use super::section::section;
use crate::scene::limits::Limits;

section! {
    /// The depth layers of transparent polygons [Thesis ch. 6 §1.5].
    #[serde(expecting = "the section [layers]")]
    #[command(next_help_heading = "Scene")]
    LayersSettings, LayersOptions, "layers";

    /// Depth layers of transparent polygons and clip geometry that are peeled at the most; those behind are left out of the
    /// picture
    #[arg(long = "layers", value_name = "N", allow_negative_numbers = true)]
    most: u32 = 4, within Limits::from_to(1.0, 64.0, "layers {}");

    /// Where the segment of a ray is drawn that ends at a surface
    #[arg(long = "partial-segments", value_name = "WHERE")]
    partial: PartialSegments = PartialSegments::Within;
}

/// Where the segment of a ray is drawn that ends at a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum PartialSegments {
    /// In its main pass, which knows where the surface is [Thesis ch. 6 §2.2].
    #[default]
    Within,
    /// In a pass of its own behind all main passes, which then know nothing of the surface [Thesis ch. 6 §7].
    Apart,
}
