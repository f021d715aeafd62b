//! What is refused before a device is opened.

use super::AccuracyJob;
use super::cells;
use super::shells;
use super::way::with_step;
use crate::error::{Error, Result};
use crate::method;
use crate::plan;
use crate::scene::Scene;
use crate::scene::settings::{LeftOpen, MethodName, Shows};
use crate::truth::known;

/// Whether a job can be measured.
///
/// # Errors
/// When a method, a step or what a surface shows cannot be.
pub fn check_settings(job: &AccuracyJob, scene: &Scene) -> Result<()> {
    job.settings.sampling.as_written()?;
    LeftOpen::refuse(&job.settings)?;
    if job.methods.iter().any(|method| !method::find(*method).is_some_and(|row| row.on_device)) {
        let remedy = "leave it out; every picture is held against the exact integral";
        return Err(Error::usage("--method cpu", "is the sum in f64, which has no frame time", remedy));
    }
    let of_shells = |name: &MethodName| !method::takes_samples(*name) && !method::of_cells().contains(name);
    if scene.tetrahedra.is_none() && job.methods.iter().any(of_shells) {
        shells::check(&job.settings)?;
    }
    if job.settings.surface.shows != Shows::Color {
        return Err(Error::usage(
            "surface.shows (--surface-shows)",
            "is for single pictures; here places, normals and colours of a surface are all measured",
            "leave it out",
        ));
    }
    job.check_adaptive(scene)?;
    for step in &job.steps {
        let mut stepped = job.settings.clone();
        with_step(&mut stepped, &job.settings, *step);
        stepped.check()?;
    }
    Ok(())
}

/// Whether the scene of a job has a truth to be held against, and can be drawn by each of its methods with each of its steps.
///
/// # Errors
/// When it has none, or cannot be.
pub fn check_scene(job: &AccuracyJob, scene: &Scene) -> Result<()> {
    known::check(scene)?;
    for method in &job.methods {
        let row = method::of(*method)?;
        if row.goes_through_cells() {
            for (_, _, sizes) in cells::ways(scene, &job.table_sizes) {
                for nodes in sizes {
                    let mut scene = cells::with_table(scene, nodes)?;
                    scene.settings.method.name = *method;
                    plan::check(&scene)?;
                }
            }
            continue;
        }
        if !row.takes_samples() {
            for count in job.shell_numbers() {
                let mut scene = shells::with_shells(scene, count)?;
                scene.settings.method.name = *method;
                plan::check(&scene)?;
            }
            continue;
        }
        for step in &job.steps {
            let mut scene = scene.clone();
            with_step(&mut scene.settings, &job.settings, *step);
            scene.settings.method.name = *method;
            plan::plan(&scene, row.papers)?;
        }
    }
    Ok(())
}
