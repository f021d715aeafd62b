//! `[layers]`: how many surfaces of transparent polygons are peeled.

use super::section::section;
use crate::scene::limits::Limits;

section! {
    /// The depth layers of transparent polygons [Thesis ch. 6 §1.5].
    #[serde(expecting = "the section [layers]")]
    #[command(next_help_heading = "Scene")]
    LayersSettings, LayersOptions, "layers";

    /// Depth layers of transparent polygons that are peeled at the most; those behind are left out of the picture
    #[arg(long = "layers", value_name = "N", allow_negative_numbers = true)]
    most: u32 = 4, within Limits::from_to(1.0, 64.0, "layers {}");
}
