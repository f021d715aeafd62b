//! `[projection]`: how the samples of a ray become its pixel.

use super::section::section;
use crate::scene::projection::ProjectionName;

section! {
    /// How the samples of a ray become its pixel.
    #[serde(expecting = "the section [projection]")]
    #[command(next_help_heading = "Sampling")]
    ProjectionSettings, ProjectionOptions, "projection";

    /// How the samples of a ray become its pixel
    #[arg(long = "projection", value_name = "KIND")]
    kind: ProjectionName = ProjectionName::default();
}
