//! How the samples of a ray become its pixel: [`PROJECTIONS`] is the one list.
//!
//! To add one:
//!
//! 1. A row, in a file here: its `mod` and `pub use` lines below, its entry in [`PROJECTIONS`] and the count there. A pixel is
//!    what one blend leaves, and nothing is done to it afterwards, so that roots, quotients and differences of two such sums
//!    cannot be rows. What a row of values says of a sample in f64 is the twin of the shader.
//! 2. Its code in `glsl/shared/projection.glsl`, and a case in each function of that file.
//! 3. Where its exact pixel takes more of a ray than [`Met`] has: that, with its closed form, in `src/truth/exact/met.rs`.
//! 4. Its entry and its closed forms in `tests/projections.rs`, which has no default for a row; its line in the README's table;
//!    a `Case` of `tests/plan/cases.rs` with its golden plan where its steps differ from those of `mip`.
//!
//! Methods, passes, experiments and the matrix of tests go through all rows by themselves.

mod composite;
mod extreme;
mod row;
mod shown;
mod sum;

pub use composite::COMPOSITE;
pub use extreme::{MINIP, MIP};
pub use row::{Ends, Levels, Met, OfValues, Projection, SampleWeight, ValueSpan};
pub use shown::Shown;
pub use sum::{AVERAGE, XRAY};

use std::str::FromStr;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

use crate::scene::Settings;
use crate::scene::settings::ProjectionName;

/// Every projection, in the order of tables and of the help.
pub const PROJECTIONS: [&Projection; 5] = [&COMPOSITE, &MIP, &MINIP, &AVERAGE, &XRAY];

/// The projection of a scene with these settings. Names are read here, so that every one has its row.
pub fn of(settings: &Settings) -> &'static Projection {
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
