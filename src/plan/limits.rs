//! How many passes, slices, entries and samples a frame may have.

use crate::error::{Error, Result};
use crate::part::rows::Method;
use crate::scene::view::View;
use crate::scene::{Scene, slices};
use crate::twin::section::most_sections;

/// Main passes beyond this many are refused: each is recorded, counted and timed by itself.
const MOST_PASSES: u32 = 65_536;

/// The most times that rays may enter a mesh of cells: each has an image of its own.
const MOST_ENTRIES: u32 = 256;

/// Samples of a ray, those beyond its end included; their indices are 32-bit numbers in shaders.
const MOST_SAMPLES: u64 = 1 << 31;

/// Whether the frame of so many main passes can be run.
///
/// # Errors
/// When it cannot, with what to change.
pub(super) fn check(scene: &Scene, view: &View, method: &Method, passes: u32) -> Result<()> {
    check_slices(scene, view)?;
    check_cells(scene, view, passes)?;
    check_passes(scene, method, passes)
}

/// Whether so many slices can be drawn.
///
/// # Errors
/// When they cannot, with what to change.
fn check_slices(scene: &Scene, view: &View) -> Result<()> {
    match &view.slices {
        Some(slices) if slices.count > slices::MOST => Err(Error::usage(
            format!("--step {}", scene.settings.sampling.step),
            format!("this view needs {} slices, and at most {} are possible", slices.count, slices::MOST),
            "take a longer step",
        )),
        _ => Ok(()),
    }
}

/// Whether the frame of a mesh of cells can be run that rays enter so often, in so many passes behind each entry.
///
/// # Errors
/// When it cannot, with what to change.
fn check_cells(scene: &Scene, view: &View, passes: u32) -> Result<()> {
    let Some(cells) = &view.cells else { return Ok(()) };
    let (layers, name) = (cells.layers(), &scene.field.volume.name);
    if layers > MOST_ENTRIES {
        let problem =
            format!("is entered {layers} times by a ray of this view, and at most {MOST_ENTRIES} times are possible");
        return Err(Error::input(name, problem, "join cells whose faces lie on each other, or choose another view"));
    }
    if layers.saturating_mul(passes) > MOST_PASSES {
        let problem = format!(
            "needs {passes} passes behind each of {layers} entries, and at most {MOST_PASSES} are possible in all"
        );
        return Err(Error::input(name, problem, "use tet-single-pass, or force fewer passes (--passes)"));
    }
    Ok(())
}

/// Whether a frame of so many main passes can be run.
///
/// # Errors
/// When it cannot, with what to change.
fn check_passes(scene: &Scene, method: &Method, passes: u32) -> Result<()> {
    let sampling = &scene.settings.sampling;
    if passes > MOST_PASSES {
        return Err(Error::usage(
            format!("{} --samples-per-pass {}", scene.settings.step_in_words(), sampling.samples_per_pass),
            format!("this view needs {passes} main passes, and at most {MOST_PASSES} are possible"),
            "take longer steps or more samples a pass",
        ));
    }
    let depth = scene.settings.method.depth;
    let told_apart = most_sections(depth);
    if method.marks_sections() && passes > told_apart {
        return Err(Error::usage(
            format!("method.depth (--depth-format) {}", depth.name()),
            format!("tells at most {told_apart} main passes apart, and this frame has {passes}"),
            "use --depth-format d32, longer steps or more samples a pass",
        ));
    }
    let samples = u64::from(passes) * u64::from(sampling.samples_per_pass);
    if samples > MOST_SAMPLES {
        return Err(Error::usage(
            format!("--passes {passes} --samples-per-pass {}", sampling.samples_per_pass),
            format!("this is {samples} samples a ray, and at most {MOST_SAMPLES} are possible"),
            "take fewer passes or fewer samples a pass",
        ));
    }
    Ok(())
}
