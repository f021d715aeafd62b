//! How the samples of a ray become its pixel: [`PROJECTIONS`] is the one list.
//!
//! To add one:
//!
//! 1. A row, in a file here: its `mod` and `pub use` lines below, its entry in [`PROJECTIONS`] and the count there. A pixel is
//!    what one blend (`Add`, `Max`, `Min`, `Over`) leaves of samples that know nothing of each other, and nothing is done to it
//!    afterwards: no roots, no quotient or difference of two sums or extremes, nothing that depends on samples before. What a
//!    row of values says of a sample in f64 is the twin of the shader. Its `part` is continuous in x but at its levels, where
//!    `src/twin/segment.rs` knows that f32 may see the other side. Its `magnification` is that of pixels which are linear in x,
//!    or an extreme of it; a sum of another function of x first needs that field made more general, with its two readers,
//!    `src/plan/precision.rs` and `src/plan/warnings.rs`.
//! 2. Its code in `glsl/shared/projection.glsl`, and a case in each function of that file which has cases, as its head says.
//! 3. Where its exact pixel takes more of a ray than [`Met`] has: a field there, filled in `src/truth/exact/met.rs`, its closed
//!    form a function of the cubic in `src/truth/exact/cubic.rs`.
//! 4. Its closed forms in `tests/projections.rs`, where no row has a default; its line in the README's table, and the paragraph
//!    under it; a `Case` of `tests/plan/cases.rs` with its golden plan where its steps differ from those of every row that has
//!    one (sums share one).
//!
//! Methods, passes, experiments and the matrix of tests go through all rows by themselves. While at it, run
//! `cargo test --test projections --test asked_shaders`, and on a device `cargo test --test device -- NAME`, which takes one
//! name and finds the matrix' and its own tests; `depthleap stability --case NAME` holds its extremes.

mod composite;
mod extreme;
mod row;
mod shown;
mod sum;
mod surface;

pub use composite::COMPOSITE;
pub use extreme::{MINIP, MIP};
pub use row::{Ends, Levels, Met, OfValues, Projection, SampleWeight, ValueSpan};
pub use shown::{Shown, Visible};
pub use sum::{AVERAGE, XRAY};
pub use surface::{first_met, on_surface, surface_values, surfaces_around};

use std::str::FromStr;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::scene::Settings;
use crate::scene::settings::{ProjectionName, ShellMode};

/// Every projection, in the order of tables and of the help.
pub const PROJECTIONS: [&Projection; 5] = [&COMPOSITE, &MIP, &MINIP, &AVERAGE, &XRAY];

/// The projection of a scene with these settings. Names are read here, so that every one has its row. What is made of shells says what
/// is made of the values between them as well.
pub fn of(settings: &Settings) -> &'static Projection {
    match settings.shells.mode {
        Some(ShellMode::Max) => return &MIP,
        Some(ShellMode::Sum) => return &XRAY,
        Some(ShellMode::Surface) | None => {}
    }
    let named = |row: &&Projection| row.name == settings.projection.kind.name();
    PROJECTIONS.into_iter().find(named).unwrap_or(&COMPOSITE)
}

/// The names of all projections, in their order.
const NAMES: [&str; PROJECTIONS.len()] = {
    let mut names = [""; PROJECTIONS.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = PROJECTIONS[i].name;
        i += 1;
    }
    names
};

impl<'de> Deserialize<'de> for ProjectionName {
    fn deserialize<D: Deserializer<'de>>(from: D) -> std::result::Result<Self, D::Error> {
        let name = String::deserialize(from)?;
        name.parse().map_err(|_| D::Error::unknown_variant(&name, &NAMES))
    }
}

impl FromStr for ProjectionName {
    type Err = String;

    fn from_str(name: &str) -> std::result::Result<Self, String> {
        let row = PROJECTIONS.iter().find(|row| row.name == name);
        row.map(|row| row.name()).ok_or_else(|| format!("is not one of {}", NAMES.join(", ")))
    }
}

impl Default for ProjectionName {
    fn default() -> Self {
        COMPOSITE.name()
    }
}
