//! What a fragment has to leave behind, by the specification: the one definition of right.
//!
//! The depth bounds test compares the *stored* depth, both ends included; the depth test compares the fragment's own,
//! which is the shader's where it writes one and no early tests are declared. What a shader stores it stores for every
//! fragment it runs for: for all of them, unless early tests are declared.

use serde::{Deserialize, Serialize};

use super::case::{Case, Compare, Conservative, Mechanism};
use super::depth::{LEAST_NORMAL, Precision};

/// What a draw is set up with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// Depth of every fragment as it is rasterised.
    pub drawn: f32,
    /// Depth bounds, or 0 and the bound a shader looks at.
    pub bounds: [f32; 2],
}

/// A fragment before it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fragment {
    pub stored: f32,
    /// What the shader writes, where it writes a depth.
    pub written: f32,
    /// Whether the stencil lets it through.
    pub stencil: bool,
}

/// What it has to leave behind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// It passes all tests: colour is written, the occlusion query counts it.
    pub passes: bool,
    /// The depth stored after it.
    pub depth: f32,
    /// The shader's own stores are there.
    pub stores: bool,
    /// The specification leaves open whether it passes: rounding may decide, or a number so small that a device may take
    /// it for 0.
    pub open: bool,
}

impl Case {
    /// The rule.
    pub fn expected(&self, precision: Precision, setup: &Setup, fragment: &Fragment) -> Expected {
        let Fragment { stored, written, stencil } = *fragment;
        let writes = self.shader.conservative().is_some() && !self.shader.early();
        let own = if writes { written } else { setup.drawn };
        let [low, high] = setup.bounds;
        let mut open = false;
        let mut passes = match self.mechanism {
            Mechanism::Stencil => stencil,
            Mechanism::DiscardFirst | Mechanism::Alive => {
                open |= flushed(stored, high);
                stored <= high
            }
            mechanism if mechanism.bounds() => {
                open |= bound_is_open(precision, stored, low) || bound_is_open(precision, stored, high);
                low <= stored && stored <= high
            }
            _ => true,
        };
        if self.mechanism.compares() {
            open |= compare_is_open(precision, own, stored);
            passes &= match self.compare {
                Compare::GreaterOrEqual => own >= stored,
                Compare::LessOrEqual => own <= stored,
            };
        }
        let looks_alive = !self.mechanism.in_shader() || stored <= high;
        let stores = if self.shader.early() { passes } else { looks_alive };
        let depth = if passes && self.mechanism.writes_depth() { own } else { stored };
        Expected { passes, depth, stores, open }
    }

    /// Depths a shader may write that is given `drawn`, as far as it promises.
    pub fn writable(&self, drawn: f32) -> Vec<f32> {
        let (below, above) = (0.875 * drawn, (1.125 * drawn).min(1.0));
        match self.shader.conservative() {
            None | Some(Conservative::Unchanged) => vec![drawn],
            Some(Conservative::Any) => vec![drawn, below, above],
            Some(Conservative::Less) => vec![drawn, below],
            Some(Conservative::Greater) => vec![drawn, above],
        }
    }

    /// A draw in which a stored depth of [`StoredDepths::alive`] passes and one of [`StoredDepths::dead`] does not, by the mechanism
    /// alone and whatever the shader writes.
    pub fn setup(&self) -> Setup {
        let drawn = match self.compare {
            Compare::GreaterOrEqual => 0.8,
            Compare::LessOrEqual => 0.05,
        };
        Setup { drawn, bounds: if self.mechanism.in_shader() { [0.0, 0.4] } else { [0.2, 0.4] } }
    }

    pub fn stored(&self) -> StoredDepths {
        let dead = match (self.mechanism, self.compare) {
            (Mechanism::DepthRead | Mechanism::DepthWrite, Compare::GreaterOrEqual) => 0.96875,
            (Mechanism::DepthRead | Mechanism::DepthWrite, Compare::LessOrEqual) => 0.015625,
            _ => 0.5625,
        };
        StoredDepths { alive: 0.3125, dead }
    }
}

/// What the specification says about rejecting a case's fragments before their shader runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Promise {
    /// `early_fragment_tests` asks for it.
    Promised,
    /// Nobody could tell.
    Allowed,
    /// The shader's stores, or the depth it writes, would be missing.
    Forbidden,
    /// The shader itself rejects.
    Own,
}

impl Promise {
    pub fn word(self) -> &'static str {
        match self {
            Self::Promised => "promised",
            Self::Allowed => "allowed",
            Self::Forbidden => "forbidden",
            Self::Own => "-",
        }
    }
}

impl Case {
    pub fn promise(&self) -> Promise {
        let depth_test = matches!(self.mechanism, Mechanism::DepthRead | Mechanism::DepthWrite);
        let decided = match (self.shader.conservative(), self.compare) {
            (None | Some(Conservative::Unchanged), _)
            | (Some(Conservative::Less), Compare::GreaterOrEqual)
            | (Some(Conservative::Greater), Compare::LessOrEqual) => true,
            // The depth written may pass where the rasterised one fails.
            _ => !depth_test,
        };
        match () {
            () if self.mechanism.in_shader() => Promise::Own,
            () if self.shader.early() => Promise::Promised,
            () if self.shader.stores() || !decided => Promise::Forbidden,
            () => Promise::Allowed,
        }
    }
}

/// StoredDepths depths of the two halves of a pattern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StoredDepths {
    pub alive: f32,
    pub dead: f32,
}

/// Numbers below the least normal one may count as 0.
fn flushed(stored: f32, bound: f32) -> bool {
    let small = |x: f32| x > 0.0 && x < LEAST_NORMAL;
    (small(stored) && bound <= LEAST_NORMAL) || small(bound)
}

/// How float bounds compare with whole numbers the specification does not say: a step apart is certain.
fn bound_is_open(precision: Precision, stored: f32, bound: f32) -> bool {
    let near = matches!(precision, Precision::Unorm(_)) && precision.code(stored).abs_diff(precision.code(bound)) <= 1;
    // Both ends of the range are exact in every format.
    near && bound != 0.0 && bound != 1.0 || flushed(stored, bound)
}

/// A depth may become either of the two whole numbers beside it before it is compared.
fn compare_is_open(precision: Precision, own: f32, stored: f32) -> bool {
    let near = matches!(precision, Precision::Unorm(_)) && precision.code(own).abs_diff(precision.code(stored)) <= 1;
    near || flushed(stored, own)
}

/// Steps of the format by which a depth that was drawn may differ from the one asked for.
pub fn tolerance(precision: Precision) -> u32 {
    match precision {
        Precision::Float => 0,
        Precision::Unorm(_) => 1,
    }
}
