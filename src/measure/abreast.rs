//! Several scenes measured abreast: frame after frame in turn, so that a busy machine troubles all of them alike.

use super::measured::Measured;
use super::runner::{Effort, Runner};
use crate::error::Result;

/// Measures the scene of each runner by the method of its settings, their repeats interleaved as those of one scene's methods
/// are. Nothing is compared, since the scenes need have nothing in common.
///
/// # Errors
/// As [`Runner::measure`].
pub fn measure_abreast(runners: &mut [Runner], effort: Effort) -> Result<Vec<Measured>> {
    let mut entries = Vec::with_capacity(runners.len());
    for runner in runners.iter_mut() {
        let method = runner.scene().settings.method.clone();
        entries.push(runner.prepare(&method, effort)?);
    }
    for _ in 0..effort.repeats {
        entries.iter_mut().try_for_each(|entry| entry.time())?;
    }
    runners.iter_mut().zip(entries).map(|(runner, entry)| runner.finish(entry, effort)).collect()
}
