//! The law of skipping, held at run time.

use super::measured::Measured;
use super::record::Run;
use crate::error::{Error, Result};

/// Skipping changes which fragments run, never the picture: holds every run that ends rays early against the first one with the same
/// samples, and notes what was found.
pub fn law_of_skipping(measured: &mut [Measured]) {
    let mut rules: Vec<(&'static str, u32)> = Vec::new();
    for rule in 0..measured.len() {
        let (before, rest) = measured.split_at_mut(rule + 1);
        let rule = &before[rule];
        // Where `auto` has chosen another M, colours are rounded at other places.
        let samples_of = |one: &Measured| (one.method.unskipped().name, one.run.settings.sampling.samples_per_pass);
        let samples = samples_of(rule);
        if !rule.method.under_the_law() || rules.contains(&samples) {
            continue;
        }
        rules.push(samples);
        let same = |one: &&mut Measured| one.method.under_the_law() && samples_of(one) == samples;
        rest.iter_mut().filter(same).for_each(|one| hold(one, rule));
    }
}

/// Holds a run against the first one with the same samples.
fn hold(one: &mut Measured, rule: &Measured) {
    let name = |run: &Run| run.form().map_or_else(|| run.method.clone(), |f| format!("{} ({f})", run.method));
    let rule_name = name(&rule.run);
    let pairs = one.picture.pixels.iter().zip(&rule.picture.pixels);
    let differing = pairs.filter(|(p, q)| p.map(f32::to_bits) != q.map(f32::to_bits)).count() as u64;
    one.differing = Some(differing);
    one.run.notes.push(match differing {
        0 => format!("the picture is that of {rule_name}, bit for bit"),
        n => format!("the picture is NOT that of {rule_name}: {n} pixels differ, and skipping must change none"),
    });
}

/// Whether skipping changed no picture of a run whose form passed the self-check.
///
/// # Errors
/// When it did.
pub fn check(measured: &[Measured]) -> Result<()> {
    let broken: Vec<String> = measured.iter().filter_map(broken).collect();
    match broken.first() {
        None => Ok(()),
        Some(first) => Err(Error::check(
            "law of skipping",
            format!("{} run(s) changed the picture, the first: {first}", broken.len()),
            "this is a bug in depthleap, in the driver or in a changed shader; the report has the pictures",
        )),
    }
}

/// How a run breaks the law.
fn broken(one: &Measured) -> Option<String> {
    let differs = |count: Option<u64>, what: &str| {
        let count = count.filter(|n| one.trusted && *n > 0)?;
        Some(format!("{}, {}: {count} {what}", one.run.scene, one.run.method))
    };
    differs(one.differing, "pixels").or_else(|| differs(one.differing_frames, "frames of the orbit"))
}
