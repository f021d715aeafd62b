//! Numbers that are given, or left to `auto`: in a scene file and on the command line a number or the word.

use serde::{Deserialize, Deserializer};

use super::{MethodSettings, SamplingSettings, Settings};
use crate::error::{Error, Result as Outcome};

/// The number that stands for one to be chosen.
pub const AUTO: u32 = 0;

/// The word that leaves a number to be chosen.
const WORD: &str = "auto";

/// Reads a number of an option, or the word.
pub(super) fn option(text: &str) -> Result<u32, String> {
    match text {
        WORD => Ok(AUTO),
        number => number.parse().map_err(|e| format!("{e}, and it is not {WORD} either")),
    }
}

/// Reads a number of a scene file, or the word.
pub(super) fn number<'de, D: Deserializer<'de>>(from: D) -> Result<u32, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "expected a number, or auto")]
    enum Said {
        Number(u32),
        Word(Word),
    }
    #[derive(Deserialize)]
    enum Word {
        #[serde(rename = "auto")]
        Auto,
    }
    Ok(match Said::deserialize(from)? {
        Said::Number(number) => number,
        Said::Word(Word::Auto) => AUTO,
    })
}

/// Which numbers are left to `auto`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOpen {
    /// M, samples of a main pass.
    pub samples_per_pass: bool,
    /// Look-ups in a segment.
    pub lookups: bool,
}

impl LeftOpen {
    pub fn of(settings: &Settings) -> Self {
        let (sampling, method) = (&settings.sampling, &settings.method);
        Self { samples_per_pass: sampling.samples_per_pass == AUTO, lookups: method.lookups == AUTO }
    }

    pub fn any(self) -> bool {
        self.samples_per_pass || self.lookups
    }

    /// Puts the numbers by default in place of those that are left open, and says which these were.
    pub fn close(settings: &mut Settings) -> Self {
        let open = Self::of(settings);
        if open.samples_per_pass {
            settings.sampling.samples_per_pass = SamplingSettings::default().samples_per_pass;
        }
        if open.lookups {
            settings.method.lookups = MethodSettings::default().lookups;
        }
        open
    }

    /// Leaves these numbers open, whatever they were.
    pub fn leave(self, settings: &mut Settings) {
        if self.samples_per_pass {
            settings.sampling.samples_per_pass = AUTO;
        }
        if self.lookups {
            settings.method.lookups = AUTO;
        }
    }

    /// Whether nothing is open.
    ///
    /// # Errors
    /// When a number is, which nobody has chosen.
    pub fn refuse(settings: &Settings) -> Outcome<()> {
        let refused = |what: &str| Err(Error::usage(what, "is left to auto, which has no say here", "give a number"));
        match Self::of(settings) {
            Self { samples_per_pass: true, .. } => refused("sampling.samples_per_pass (--samples-per-pass auto)"),
            Self { lookups: true, .. } => refused("method.lookups (--lookups auto)"),
            _ => Ok(()),
        }
    }
}
