//! `[method]`: which passes, and how fragments are culled and marked.

use serde::{Deserialize, Serialize};

use super::section::section;
use super::tuned;
use crate::scene::limits::{Allowed, Limits};
use crate::scene::method::{Cull, DepthFormat, Mark, MethodName};

/// Sides a cell of a distance structure may have.
pub const CELLS: [u32; 4] = [1, 2, 4, 8];

section! {
    /// Which passes, and how fragments are culled and marked.
    #[serde(expecting = "the section [method]")]
    #[command(next_help_heading = "Method")]
    MethodSettings, MethodOptions, "method";

    /// The render method; auto chooses one for the scene, with M, look-ups and cell where those are left as they are
    #[arg(skip)]
    name: MethodName = Default::default();

    /// How fragments are culled
    #[arg(long, value_name = "TEST")]
    cull: Cull = Cull::Auto;

    /// How the intermediate pass stores its decision
    #[arg(long, value_name = "WAY")]
    mark: Mark = Mark::Auto;

    /// Format of the depth buffer, in which passes are told apart
    #[arg(long = "depth-format", value_name = "FORMAT")]
    depth: DepthFormat = DepthFormat::D32;

    /// Mark a ray as gone as soon as its next section lies beyond its end
    #[arg(
        long = "no-exit-lookahead", num_args = 0, default_missing_value = "false",
        help = "Notice that a ray has left the volume only on arrival, as the papers do (nn-*)"
    )]
    exit_lookahead: bool = true;

    /// rc-block: test for empty blocks before the first main pass too
    #[arg(long, num_args = 0, default_missing_value = "true")]
    block_first: bool = false;

    /// nn-*: side of a cell of the distance structure in voxels
    #[arg(long, value_name = "VOXELS", allow_negative_numbers = true)]
    cell: u32 = 1, within Limits::new(Allowed::OneOf(&CELLS), "{} voxels");

    /// nn-cone: half-angle around the view direction
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true)]
    cone: f64 = 10.0, within Limits::from_to(0.01, 60.0, "a half-angle {} degrees");

    /// nn-*: who builds the distances
    #[arg(long, value_name = "WHO")]
    build: Builder = Builder::Auto;

    /// Leave out what the scene does not need; without, everything a method may have is there
    #[arg(
        long = "no-planner", num_args = 0, default_missing_value = "false",
        help = "Leave nothing out that the method may have, whether the scene needs it or not: the planner's savings"
    )]
    planner: bool = true;

    /// slices-2d: a slice for each step, between two textures of the stack, else one for each texture
    #[arg(
        long = "no-between", num_args = 0, default_missing_value = "false",
        help = "slices-2d: a slice for each texture of the stack, none between them, whatever --step says"
    )]
    between: bool = true;

    /// slices-2d, slices-3d: who cuts slices to polygons
    #[arg(long, value_name = "WHO")]
    slice_cut: SliceCut = SliceCut::Host;

    /// auto: frames that what is built for a method is to serve
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    frames: u32 = 1, within Limits::from_to(1.0, 1e6, "a number {}");

    /// auto: the view changes from frame to frame, so that what is built for a view serves one
    #[arg(long, num_args = 0, default_missing_value = "true")]
    moving: bool = false;

    /// nn-*: how often a ray may look up a distance in a segment before it has to run there; 1 is the thesis', auto, or 0, has it chosen
    /// for the scene
    #[serde(deserialize_with = "tuned::number")]
    #[arg(long, value_name = "N", value_parser = tuned::option, allow_negative_numbers = true)]
    lookups: u32 = 1, within Limits::from_to(f64::from(tuned::AUTO), 1024.0, "a number {}, or auto"), default "1; auto of render and plan";

    /// rc-block, nn-*, single-pass-*: the tiles of 8 x 8 pixels that are drawn
    #[arg(long, value_name = "WHICH")]
    tiles: Tiles = Tiles::Auto;
}

/// The tiles of pixels that are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Tiles {
    /// Those behind which something may show, where auto chooses a method that leaves out others and finding them pays over the frames, else
    /// all.
    #[default]
    Auto,
    /// All that the volume's box covers.
    All,
    /// Those behind which something may show, in each pass those in which its samples may: no ray is begun elsewhere, and nothing else counts
    /// as a fragment.
    Live,
}

/// Who cuts slices to polygons.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum SliceCut {
    /// The CPU: by the volume, clip planes and the picture.
    #[default]
    Host,
    /// The vertex shader: by the volume.
    Device,
}

/// Who builds the distances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Builder {
    /// The host for a device that is a CPU, where it is the faster, else the device.
    #[default]
    Auto,
    /// Compute shaders, on the compute queue.
    Device,
    /// The CPU.
    Host,
}
