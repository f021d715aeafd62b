//! Errors of shells by their number [Heidrich95 §2].

use std::sync::Arc;

use super::{AccuracyJob, Curve};
use crate::error::{Error, Result};
use crate::scene::Scene;
use crate::scene::settings::{Settings, ShellMode, ShellSum};
use crate::scene::shells::Shells;

/// The order of shells in the inverse of their number: values between two levels count as one of them, or as the middle between them.
pub const EXPECTED_ORDER: f64 = 1.0;

/// Why an error may not fall with the number of shells.
pub const REMARK: &str = "polygons go straight between the edges of cells, where the interpolant does not: an error that does not fall with \
                          the number of shells";

/// Whether the shells of settings go to an exact picture with their number.
///
/// # Errors
/// When they go to none, or their number is given otherwise.
pub fn check(settings: &Settings) -> Result<()> {
    let shells = &settings.shells;
    let refused = |input: &str, problem: &str, remedy: &str| Err(Error::usage(input, problem, remedy));
    match () {
        () if shells.mode == Some(ShellMode::Surface) => refused(
            "shells.mode (--shells surface)",
            "shows one shell, whose error has nothing to do with their number, by which it is measured here",
            "use max or sum, or leave --method shells out",
        ),
        () if !shells.shell_levels.is_empty() || !shells.disabled.is_empty() => refused(
            "shells.levels, shells.disabled (--shell-levels, --shell-disabled)",
            "choose shells, whose number is what errors are measured by here",
            "leave them out; --shell-counts has the numbers",
        ),
        () if shells.mode == Some(ShellMode::Sum) && shells.sum == ShellSum::Crossings => refused(
            "shells.sum (--shell-sum) crossings",
            "grows with the number of shells, and goes to no integral",
            "use lengths, or leave --method shells out",
        ),
        () if shells.a != 0.0 || shells.beta0 + shells.b != 1.0 => refused(
            "shells.beta0, a, b (--shell-beta0, --shell-a, --shell-b)",
            "ask for a depth cue, and the exact picture has none",
            "leave them out, or use render and bench",
        ),
        () => Ok(()),
    }
}

/// The scene with so many shells.
///
/// # Errors
/// When it cannot have them.
pub fn with_shells(scene: &Scene, count: u32) -> Result<Scene> {
    let mut scene = scene.clone();
    scene.settings.shells.count = count;
    scene.settings.check()?;
    scene.shells = Shells::new(&scene.settings.shells, &scene.field, scene.shells.as_deref())?.map(Arc::new);
    Ok(scene)
}

impl AccuracyJob {
    /// The numbers of shells, each once, rising.
    pub(super) fn shell_numbers(&self) -> Vec<u32> {
        let mut numbers = self.shell_counts.clone();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }
}

impl Curve {
    /// Whether it goes by the number of shells.
    pub fn is_of_shells(&self) -> bool {
        self.points.iter().any(|point| point.shells.is_some())
    }
}
