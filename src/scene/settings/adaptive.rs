//! `[adaptive]`: steps as long as the volume allows at each place (Weiler03 "Adaptive Sampling").

use super::section::section;
use crate::scene::limits::Limits;

/// Steps that are neither below what single precision resolves nor longer than any volume, in voxels.
const STEPS: Limits = Limits::from_to(1e-3, 1e4, "a number of voxels {}");

/// One code of 8 bits.
const ONE_CODE: f64 = 1.0 / 255.0;

section! {
    /// Steps as long as the volume allows at each place.
    #[serde(expecting = "the section [adaptive]")]
    #[command(next_help_heading = "Sampling")]
    AdaptiveSettings, AdaptiveOptions, "adaptive";

    /// Adaptive sampling: an importance volume holds how long a step may be from each cell on, in place of --step and --last
    /// (rc-ert, single-pass, single-pass+compute, cpu)
    #[arg(long = "importance", num_args = 0, default_missing_value = "true")]
    importance: bool = false;

    /// Adaptive sampling: the most by which a channel may be off from the exact integral, as far as steps are to blame
    #[arg(long, value_name = "ERROR", allow_negative_numbers = true)]
    tolerance: f64 = ONE_CODE, within Limits::from_to(1e-6, 1.0, "an error {}"), default "1/255";

    /// Adaptive sampling: the longest step, in voxels of the finest spacing
    #[arg(long, value_name = "VOXELS", allow_negative_numbers = true)]
    longest: f64 = 16.0, within STEPS;

    /// Adaptive sampling: the shortest step, in voxels of the finest spacing; all others are this one doubled some times
    #[arg(long, value_name = "VOXELS", allow_negative_numbers = true)]
    shortest: f64 = 0.0625, within STEPS;
}

impl AdaptiveSettings {
    /// How often the shortest step is doubled before it is longer than a voxel of the finest spacing.
    pub fn voxel_doublings(&self) -> u8 {
        (1.0 / self.shortest).log2().floor().max(0.0) as u8
    }

    /// How often the shortest step is doubled at the most.
    pub fn doublings(&self) -> u8 {
        // No more than 23, by the limits of both.
        (self.longest / self.shortest).log2().floor().max(0.0) as u8
    }
}
