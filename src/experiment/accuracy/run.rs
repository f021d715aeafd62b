//! Renders a scene in every way of sampling that is asked for, and holds each picture against the exact integral.

use std::path::Path;

use super::check::{check_scene, check_settings};
use super::surface::{ExactSurface, SurfacePictures, exact, shows_only, surface_error, surface_orders};
use super::way::{Way, with_step};
use super::{Accuracy, Curve, FORMAT, Point, SurfaceError, expected_order, fit, mark_pareto, remarks, remarks_on_all};
use crate::error::Result;
use crate::experiment::Host;
use crate::experiment::folder::{keep_picture, settings_in};
use crate::measure::Checked;
use crate::measure::fragment_kind::FragmentKind;
use crate::measure::picture::{Picture, similarity};
use crate::measure::record::Clock;
use crate::measure::runner::{Effort, Runner};
use crate::measure::view::view_in_words;
use crate::measure::write::{create_folder, write_json};
use crate::measure::{Measured, compare};
use crate::method;
use crate::projection;
use crate::provenance::Provenance;
use crate::read;
use crate::scene::Scene;
use crate::scene::settings::{MethodName, MethodSettings, Settings, Shows};

/// What is to be measured.
#[derive(Clone)]
pub struct AccuracyJob {
    pub name: String,
    pub settings: Settings,
    pub methods: Vec<MethodName>,
    /// Whether nobody asked for these methods: a mesh of cells is drawn by those that go through cells then.
    pub by_default: bool,
    /// Voxels.
    pub steps: Vec<f64>,
    /// Numbers of shells, of methods that take no samples.
    pub shell_counts: Vec<u32>,
    /// Nodes along a side of tables of ways through cells.
    pub table_sizes: Vec<u32>,
    /// Errors that adaptive steps are made for; none where they are not measured.
    pub tolerances: Vec<f64>,
    /// Every way of sampling by every method.
    pub full: bool,
    /// Frames timed for each picture.
    pub repeats: usize,
}

/// What is the same for all ways of sampling.
pub(super) struct Asked<'a> {
    pub checked: &'a Checked,
    pub scene: &'a Scene,
    /// The scene's own way.
    pub own: Way,
    /// The exact integral.
    pub truth: &'a Picture,
    /// What is known of the exact surface.
    surface: Option<&'a ExactSurface>,
    /// Whether the exact picture has opacities above T.
    opaque: bool,
}

impl AccuracyJob {
    /// What was found, and the picture of the exact integral.
    ///
    /// # Errors
    /// When the scene, a method or a step is refused, or the driver fails.
    pub fn run(&self, host: &Host) -> Result<(Accuracy, Picture)> {
        let settings = &self.settings;
        let scene = read::scene(settings)?;
        let methods = match self.by_default && scene.tetrahedra.is_some() {
            true => method::of_cells(),
            false => self.methods.clone(),
        };
        let job = Self { methods, ..self.clone() };
        job.measure(&scene, host)
    }

    fn measure(&self, scene: &Scene, host: &Host) -> Result<(Accuracy, Picture)> {
        let settings = &self.settings;
        check_settings(self, scene)?;
        check_scene(self, scene)?;
        let surface = ExactSurface::of(scene)?;
        let checked = (host.open)()?;
        let provenance = Provenance::now(FORMAT);
        (host.say)("exact integral");
        let truth = exact(scene)?;
        let opaque = f64::from(truth.pixels.iter().map(|p| p[3]).fold(0.0, f32::max)) > settings.sampling.termination;
        let surface = surface.as_ref();
        let asked = Asked { checked: &checked, scene, own: Way::of(settings), truth: &truth, surface, opaque };
        let (ways, left_out) = self.ways(&asked);
        let mut curves = Vec::new();
        let sampled = self.sampled();
        for (i, way) in ways.iter().enumerate() {
            let count = if self.full || i < for_all(scene) { sampled.len() } else { 1 };
            (host.say)(&format!("{} of {} ways of sampling", i + 1, ways.len()));
            curves.extend(self.curves(&asked, *way, &sampled[..count.min(sampled.len())])?);
        }
        for name in self.methods.iter().copied().filter(|name| !method::takes_samples(*name)) {
            if method::of(name)?.goes_through_cells() {
                (host.say)(&format!("{name} by tables"));
                curves.extend(self.cell_curves(&asked, name)?);
            } else {
                (host.say)(&format!("{name} by their number"));
                curves.push(self.shell_curve(&asked, name)?);
            }
        }
        for name in self.adaptive_methods(scene) {
            (host.say)(&format!("{name} in adaptive steps"));
            curves.extend(self.adaptive_curves(&asked, name)?);
        }
        mark_pareto(&mut curves);
        let mut remarks = remarks_on_all(scene);
        remarks.extend(left_out);
        let info = checked.device.info.clone();
        (host.close)(checked)?;
        let found = Accuracy {
            provenance,
            scene: self.name.clone(),
            view: view_in_words(scene),
            device: info.name.clone(),
            driver: format!("{} {}", info.driver_name, info.driver_info),
            clock: (self.repeats > 0).then(|| Clock::on(info.is_cpu(), info.timestamp_valid_bits > 0)),
            curves,
            remarks,
            settings: settings.clone(),
            picture: None,
        };
        Ok((found, truth))
    }

    /// The methods that take samples.
    fn sampled(&self) -> Vec<MethodName> {
        self.methods.iter().copied().filter(|name| method::takes_samples(*name)).collect()
    }

    /// The ways of sampling in which the scene can be drawn, its own first; and in words which ones cannot be.
    fn ways(&self, asked: &Asked) -> (Vec<Way>, Option<String>) {
        let Some(first) = self.sampled().first().copied() else { return (Vec::new(), None) };
        let Asked { scene, own, checked, .. } = *asked;
        let mut ways = match scene.surface {
            Some(_) => Way::of_surfaces(own),
            None if self.full => Way::all(own),
            None => Way::some(own),
        };
        // Values have no opacity.
        let values = projection::of(&self.settings).shows_values();
        ways.retain(|way| *way == own || !(values && way.alpha != own.alpha));
        let shortest = self.steps.iter().copied().fold(f64::INFINITY, f64::min);
        let mut left_out = Vec::new();
        ways.retain(|way| {
            let mut scene = scene.clone();
            way.apply(&mut scene.settings);
            with_step(&mut scene.settings, &self.settings, shortest);
            let method = MethodSettings { name: first, ..scene.settings.method.clone() };
            // What is wrong with the scene's own way is an error when it is run.
            let drawn = *way == own || Runner::new(Some(checked), scene, String::new()).check(&[method]).is_ok();
            left_out.extend((!drawn).then(|| way.words(own)));
            drawn
        });
        let words = (!left_out.is_empty())
            .then(|| format!("Left out, since the scene cannot be drawn so: {}.", left_out.join("; ")));
        (ways, words)
    }

    /// One way of sampling by several methods, every step.
    fn curves(&self, asked: &Asked, way: Way, methods: &[MethodName]) -> Result<Vec<Curve>> {
        let Asked { checked, truth, .. } = *asked;
        let mut scene = asked.scene.clone();
        way.apply(&mut scene.settings);
        let own_settings = scene.settings.clone();
        // What is wrong with the scene's own way is an error when it is run; in other ways methods take their part.
        let drawn = |name: &&MethodName| way == asked.own || method::takes(**name, &scene);
        let mut curves: Vec<Curve> =
            methods.iter().filter(drawn).map(|name| curve(asked, way, &scene, *name)).collect();
        if curves.is_empty() {
            return Ok(curves);
        }
        let variants: Vec<MethodSettings> = curves.iter().map(|curve| curve.settings.method.clone()).collect();
        let mut runner = Runner::new(Some(checked), scene.clone(), String::new());
        for &step in &self.steps {
            runner.vary(|settings| with_step(settings, &own_settings, step));
            let effort = Effort { warmups: usize::from(self.repeats > 0), repeats: self.repeats, reference: false };
            let sampling = runner.scene().settings.sampling.clone();
            let measured = runner.measure(&variants, effort, &|_| {})?;
            let clock = Clock::on(checked.device.info.is_cpu(), checked.device.info.timestamp_valid_bits > 0);
            let surfaces = surface_errors(asked, &mut runner, &variants, &measured)?;
            for ((curve, one), surface) in curves.iter_mut().zip(&measured).zip(surfaces) {
                curve.points.push(Point { surface, ..point(step, sampling.samples_per_pass, one, truth, clock)? });
            }
        }
        for curve in &mut curves {
            let errors: Vec<(f64, f64)> = curve.points.iter().filter_map(|p| Some((p.step, p.rmse?))).collect();
            curve.order = fit(&errors);
            curve.surface = surface_orders(&scene, &curve.points);
        }
        Ok(curves)
    }
}

/// So many ways of sampling are run by every method: of a surface, which all of them find alike, the scene's own.
fn for_all(scene: &Scene) -> usize {
    if scene.surface.is_some() { 1 } else { 3 }
}

/// A curve of a scene that is sampled in some way, without points.
pub(super) fn curve(asked: &Asked, way: Way, scene: &Scene, name: MethodName) -> Curve {
    Curve {
        method: name.name().to_owned(),
        variation: way.words(asked.own),
        settings: Settings {
            method: MethodSettings { name, ..scene.settings.method.clone() },
            ..scene.settings.clone()
        },
        points: Vec::new(),
        order: None,
        expected: expected_order(scene),
        remarks: remarks(scene, name, asked.opaque),
        surface: None,
    }
}

/// The errors of the surface in what was measured just now; none of a scene of whose surface nothing is known.
fn surface_errors(
    asked: &Asked,
    runner: &mut Runner,
    variants: &[MethodSettings],
    measured: &[Measured],
) -> Result<Vec<Option<SurfaceError>>> {
    let Some(exact) = asked.surface else { return Ok(vec![None; measured.len()]) };
    let scene = runner.scene();
    let (own, step) = (scene.settings.clone(), scene.settings.sampling.step * scene.field.finest());
    let mut shown = |shows: Shows| {
        runner.vary(|settings| shows_only(settings, shows));
        runner.measure(variants, Effort { warmups: 0, repeats: 0, reference: false }, &|_| {})
    };
    let (places, normals) = (shown(Shows::Position)?, shown(Shows::Normal)?);
    runner.vary(|settings| *settings = own);
    let truth = SurfacePictures { places: &exact.places, normals: &exact.normals, colors: asked.truth };
    let found = places.iter().zip(&normals).zip(measured).map(|((places, normals), colors)| SurfacePictures {
        places: &places.picture,
        normals: &normals.picture,
        colors: &colors.picture,
    });
    Ok(found.map(|found| Some(surface_error(found, truth, step))).collect())
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

/// A picture beside the exact one.
///
/// # Errors
/// When the two have other sizes.
pub(super) fn point(step: f64, samples_per_pass: u32, one: &Measured, truth: &Picture, clock: Clock) -> Result<Point> {
    let error = compare(&one.picture, truth, None)?;
    let finite = |value: f64| value.is_finite().then_some(value);
    let (ms, timed) = Point::times(one.run.timing(clock));
    Ok(Point {
        step,
        samples_per_pass,
        shells: None,
        table: None,
        tolerance: None,
        max: finite(error.max),
        rmse: finite(error.rmse),
        psnr: error.psnr,
        ssim: similarity(&one.picture, truth, one.run.settings.image.background)?,
        ms,
        timed,
        samples: match one.run.fragment_kind() {
            Some(FragmentKind::Sample | FragmentKind::Crossing | FragmentKind::Cell) => one.run.fragments.main,
            _ => one.run.fragments.main.saturating_mul(samples_per_pass.into()),
        },
        pareto: false,
        surface: None,
    })
}
