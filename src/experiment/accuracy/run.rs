//! Renders a scene in every way of sampling that is asked for, and holds each picture against the exact integral.

use std::path::Path;

use super::way::Way;
use super::{Accuracy, Curve, FORMAT, Point, expected_order, fit, mark_pareto, remarks};
use crate::error::{Error, Result};
use crate::experiment::Host;
use crate::experiment::folder::{keep_picture, settings_in};
use crate::measure::picture::{Picture, similarity};
use crate::measure::record::Clock;
use crate::measure::runner::{Checked, Effort, Runner, view_in_words};
use crate::measure::write::{create_folder, write_json};
use crate::measure::{Measured, compare};
use crate::method;
use crate::projection;
use crate::provenance::Provenance;
use crate::read;
use crate::scene::Scene;
use crate::scene::settings::{MethodName, MethodSettings, Settings};
use crate::truth::exact::ExactIntegrator;
use crate::truth::preintegrated;

/// So many ways of sampling are run by every method.
const FOR_ALL: usize = 3;

/// What is to be measured.
pub struct AccuracyJob {
    pub name: String,
    pub settings: Settings,
    pub methods: Vec<MethodName>,
    /// Voxels.
    pub steps: Vec<f64>,
    /// Every way of sampling by every method.
    pub full: bool,
    /// Frames timed for each picture.
    pub repeats: usize,
}

/// What is the same for all ways of sampling.
struct Asked<'a> {
    checked: &'a Checked,
    scene: &'a Scene,
    /// The scene's own way.
    own: Way,
    /// The exact integral.
    truth: &'a Picture,
    /// Whether it has opacities above T.
    opaque: bool,
}

impl AccuracyJob {
    /// What was found, and the picture of the exact integral.
    ///
    /// # Errors
    /// When the scene, a method or a step is refused, or the driver fails.
    pub fn run(&self, host: &Host) -> Result<(Accuracy, Picture)> {
        let settings = &self.settings;
        if self.methods.iter().any(|method| !method::find(*method).is_some_and(|row| row.on_device)) {
            let remedy = "leave it out; every picture is held against the exact integral";
            return Err(Error::usage("--method cpu", "is the sum in f64, which has no frame time", remedy));
        }
        for step in &self.steps {
            let mut stepped = settings.clone();
            with_step(&mut stepped, settings, *step);
            stepped.check()?;
        }
        let scene = read::scene(settings)?;
        if scene.surface.is_none() && !scene.lights.is_empty() {
            let remedy = "leave the lights out, or give an iso-surface (--iso), whose exact picture is known";
            return Err(Error::usage(
                "light",
                "shines on samples, of whose colours no exact integral is known",
                remedy,
            ));
        }
        let checked = (host.open)()?;
        let provenance = Provenance::now(FORMAT);
        (host.say)("exact integral");
        let truth = exact(&scene)?;
        let opaque = f64::from(truth.pixels.iter().map(|p| p[3]).fold(0.0, f32::max)) > settings.sampling.termination;
        let own = Way::of(settings);
        let asked = Asked { checked: &checked, scene: &scene, own, truth: &truth, opaque };
        let mut ways = match scene.surface {
            Some(_) => Way::of_surfaces(own),
            None if self.full => Way::all(own),
            None => Way::some(own),
        };
        // Some scenes cannot be classified by a table; one that asks for it is refused. Values have no opacity.
        let values = projection::of(settings).shows_values();
        ways.retain(|way| {
            let mut scene = scene.clone();
            way.apply(&mut scene.settings);
            *way == own || (preintegrated::check(&scene).is_ok() && !(values && way.alpha != own.alpha))
        });
        let mut curves = Vec::new();
        for (i, way) in ways.iter().enumerate() {
            let methods = if self.full || i < FOR_ALL { &self.methods[..] } else { &self.methods[..1] };
            (host.say)(&format!("{} of {} ways of sampling", i + 1, ways.len()));
            curves.extend(self.curves(&asked, *way, methods)?);
        }
        mark_pareto(&mut curves);
        let info = checked.device.info.clone();
        (host.close)(checked)?;
        let found = Accuracy {
            provenance,
            scene: self.name.clone(),
            view: view_in_words(&scene),
            device: info.name.clone(),
            driver: format!("{} {}", info.driver_name, info.driver_info),
            clock: (self.repeats > 0).then(|| Clock::on(info.is_cpu(), info.timestamp_valid_bits > 0)),
            curves,
            remarks: vec![format!(
                "Segments of main passes are kept about as long as {} samples of one voxel, so that all steps have about as \
                 many passes.",
                settings.sampling.samples_per_pass
            )],
            settings: settings.clone(),
            picture: None,
        };
        Ok((found, truth))
    }

    /// One way of sampling by several methods, every step.
    fn curves(&self, asked: &Asked, way: Way, methods: &[MethodName]) -> Result<Vec<Curve>> {
        let Asked { checked, own, truth, opaque, .. } = *asked;
        let mut scene = asked.scene.clone();
        way.apply(&mut scene.settings);
        let own_settings = scene.settings.clone();
        let curve = |name: &MethodName| Curve {
            method: name.name().to_owned(),
            variation: way.words(own),
            settings: Settings {
                method: MethodSettings { name: *name, ..own_settings.method.clone() },
                ..own_settings.clone()
            },
            points: Vec::new(),
            order: None,
            expected: expected_order(&scene),
            remarks: remarks(&scene, *name, opaque),
        };
        let mut curves: Vec<Curve> = methods.iter().map(curve).collect();
        let variants: Vec<MethodSettings> = curves.iter().map(|curve| curve.settings.method.clone()).collect();
        let mut runner = Runner::new(Some(checked), scene, String::new());
        for &step in &self.steps {
            runner.vary(|settings| with_step(settings, &own_settings, step));
            let effort = Effort { warmups: usize::from(self.repeats > 0), repeats: self.repeats, reference: false };
            let sampling = runner.scene().settings.sampling.clone();
            let measured = runner.measure(&variants, effort, &|_| {})?;
            let clock = Clock::on(checked.device.info.is_cpu(), checked.device.info.timestamp_valid_bits > 0);
            for (curve, one) in curves.iter_mut().zip(&measured) {
                curve.points.push(point(step, sampling.samples_per_pass, one, truth, clock)?);
            }
        }
        for curve in &mut curves {
            let errors: Vec<(f64, f64)> = curve.points.iter().filter_map(|p| Some((p.step, p.rmse?))).collect();
            curve.order = fit(&errors);
        }
        Ok(curves)
    }
}

/// Keeps what was found in `folder`, with the exact picture.
///
/// # Errors
/// When a file cannot be written.
pub fn keep(folder: &Path, mut found: Accuracy, exact: &Picture) -> Result<Accuracy> {
    create_folder(folder)?;
    let words = ["accuracy", &found.scene, "exact"];
    found.picture = Some(keep_picture(folder, &words, exact, found.settings.image.background)?);
    found.settings = settings_in(folder, found.settings);
    for curve in &mut found.curves {
        curve.settings = settings_in(folder, curve.settings.clone());
    }
    write_json(&folder.join("accuracy.json"), &found)?;
    Ok(found)
}

/// The step, and M so that a pass goes as far as with steps of one voxel.
fn with_step(settings: &mut Settings, own: &Settings, step: f64) {
    settings.sampling.step = step;
    let samples = f64::from(own.sampling.samples_per_pass) / step;
    // The cast saturates, and the check of the settings refuses what is too much.
    settings.sampling.samples_per_pass = samples.round().max(1.0) as u32;
}

/// The exact integral of the scene, without early termination.
fn exact(scene: &Scene) -> Result<Picture> {
    let size = scene.settings.image.size;
    let rays = scene.camera.rays(size)?;
    let pixels = ExactIntegrator::of(scene).picture(&rays, size);
    Picture::new(size, pixels.into_iter().map(|pixel| pixel.map(|c| c as f32)).collect())
}

fn point(step: f64, samples_per_pass: u32, one: &Measured, truth: &Picture, clock: Clock) -> Result<Point> {
    let error = compare(&one.picture, truth, None)?;
    let finite = |value: f64| value.is_finite().then_some(value);
    let (ms, timed) = Point::times(one.run.timing(clock));
    Ok(Point {
        step,
        samples_per_pass,
        max: finite(error.max),
        rmse: finite(error.rmse),
        psnr: error.psnr,
        ssim: similarity(&one.picture, truth, one.run.settings.image.background)?,
        ms,
        timed,
        samples: one.run.fragments.main.saturating_mul(samples_per_pass.into()),
        pareto: false,
    })
}
