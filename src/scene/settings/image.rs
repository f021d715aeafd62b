//! `[image]`: the picture and what it is accumulated in.

use serde::{Deserialize, Serialize};

use super::parse::numbers;
use super::section::section;
use crate::scene::fixed;
use crate::scene::limits::Limits;

/// The longest side of a picture, in pixels: the last number of 16 bits, which is beyond what any device draws into.
const MAX_SIDE: u32 = 65535;

const SIDE: u32 = 500;

section! {
    /// The picture and what it is accumulated in.
    #[serde(expecting = "the section [image]")]
    // The help of the view begins with the picture's size, in front of the camera.
    #[command(next_help_heading = "View", next_display_order = 0)]
    ImageSettings, ImageOptions, "image";

    /// Picture size in pixels
    #[serde(deserialize_with = "fixed::list")]
    #[arg(long = "viewport", value_name = "WxH", value_parser = viewport, allow_hyphen_values = true)]
    size: [u32; 2] = [SIDE; 2],
        within Limits::from_to(1.0, f64::from(MAX_SIDE), "width and height {} pixels"),
        default format!("{SIDE}x{SIDE}");

    /// Colour behind the volume in PNG files, linear light
    #[serde(deserialize_with = "fixed::list")]
    #[arg(long, value_name = "R,G,B", value_parser = numbers::<3>, allow_hyphen_values = true)]
    background: [f64; 3] = [0.0; 3], within Limits::from_to(0.0, 1.0, "red, green and blue {}");

    /// Format colours are accumulated in
    #[arg(long, value_name = "FORMAT")]
    accumulate: Accumulate = Accumulate::Rgba32f;
}

/// The format colours are accumulated in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Accumulate {
    #[default]
    Rgba32f,
    Rgba16f,
    Rgba8,
}

/// `500x500` as width and height.
fn viewport(text: &str) -> Result<[u32; 2], String> {
    let (width, height) = text.split_once('x').ok_or("give WIDTHxHEIGHT, 500x500 for example")?;
    let side = |part: &str| part.trim().parse::<u32>().map_err(|_| format!("`{part}` is not a number of pixels"));
    Ok([side(width)?, side(height)?])
}
