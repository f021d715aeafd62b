//! `depthleap accuracy`: error against run time.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args;

use super::open::DeviceOptions;
use super::options::{SceneOptions, is_scene_file, method_parser, scene_name};
use super::output::{Progress, settings_in, write_json};
use crate::error::{Error, Result};
use crate::experiment::accuracy::{
    Accuracy as Found, Curve, FORMAT, Point, csv, expected_order, fit, mark_pareto, page, remarks, step_svg, text,
    time_svg,
};
use crate::measure::compare;
use crate::measure::picture::{Picture, similarity};
use crate::measure::record::Clock;
use crate::measure::runner::{Checked, Effort, Measured, Runner, view_in_words};
use crate::measure::write::{self, write_atomically};
use crate::method;
use crate::provenance::Provenance;
use crate::read;
use crate::reference::exact::ExactIntegrator;
use crate::reference::preintegrated;
use crate::scene::Scene;
use crate::scene::settings::{
    Accumulate, Alpha, Classification, Filter, Last, MethodName, MethodSettings, Offset, Settings, VolumeTexture,
};

/// Error against run time
///
/// Renders a scene by each method with ever shorter steps, and holds each picture against the exact emission-absorption
/// integral in f64: largest error, root mean square, PSNR, SSIM, beside the time of a frame. Fits the order in the step, says
/// why it may differ from theory's, and which method at which step is the fastest within an error of 1/255 and 1/1000.
/// Writes accuracy.json, .csv, .html and two plots as SVG. Unless a scene file or an option says otherwise, pictures have
/// 160x160 pixels and rays end at an opacity of 0.999.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap accuracy builtin:gaussian:64 --tf linear -o out
  depthleap accuracy fuel.nrrd --method rc,nn-omni --steps 2,1,0.5,0.25 -o out
  depthleap accuracy builtin:marschner-lobb:41 --full --viewport 100x100 -o out")]
pub struct Accuracy {
    /// Scene file (.toml), volume file or builtin:NAME:SIZE [default: builtin:shells:64]
    #[arg(value_name = "SCENE|VOLUME")]
    scene: Option<OsString>,
    /// Folder for the files; made where it is missing
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Render methods, with commas between; the ways of sampling that are not the scene's are run by the first of them
    #[arg(long, value_name = "NAME,...", value_delimiter = ',', value_parser = method_parser(), default_values = METHODS.map(MethodName::name))]
    method: Vec<MethodName>,
    /// Steps in voxels, with commas between
    #[arg(long, value_name = "VOXELS,...", value_delimiter = ',', value_parser = method_parser(), default_values = STEPS)]
    steps: Vec<f64>,
    /// Every way of sampling, by every method
    #[arg(long)]
    full: bool,
    /// Frames timed for each picture; 0 measures no times
    #[arg(long, value_name = "N", default_value_t = 3)]
    repeats: usize,
    #[command(flatten)]
    scene_options: SceneOptions,
    #[command(flatten)]
    device: DeviceOptions,
}

const METHODS: [MethodName; 5] = [
    method::RC.name(),
    method::RC_ERT.name(),
    method::RC_BLOCK.name(),
    method::NN_OMNI.name(),
    method::NN_OPTIMAL.name(),
];

const STEPS: [&str; 8] = ["8", "4", "2", "1", "0.5", "0.25", "0.125", "0.0625"];

/// So many ways of sampling are run by every method.
const FOR_ALL: usize = 3;

/// A picture's side where nothing else is said: the exact integral takes its time.
const SIDE: u32 = 160;

/// T where nothing else is said: at the papers' 0.95 nothing but what lies behind is to be seen of the error.
const TERMINATION: f64 = 0.999;

/// How samples are taken and kept.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Way {
    classification: Classification,
    offset: Offset,
    last: Last,
    alpha: Alpha,
    accumulate: Accumulate,
    texture: VolumeTexture,
    filter: Filter,
}

impl Way {
    fn of(settings: &Settings) -> Self {
        let sampling = &settings.sampling;
        Self {
            classification: sampling.classification,
            offset: sampling.offset,
            last: sampling.last,
            alpha: sampling.alpha,
            accumulate: settings.image.accumulate,
            texture: settings.volume.texture,
            filter: sampling.filter,
        }
    }

    fn apply(self, settings: &mut Settings) {
        let sampling = &mut settings.sampling;
        (sampling.offset, sampling.last, sampling.alpha) = (self.offset, self.last, self.alpha);
        (settings.image.accumulate, settings.volume.texture) = (self.accumulate, self.texture);
        (settings.sampling.filter, settings.sampling.classification) = (self.filter, self.classification);
    }

    /// What differs from the scene's own, in words.
    fn words(self, own: Self) -> String {
        let mut words = Vec::new();
        let mut say = |differs: bool, word: String| words.extend(differs.then_some(word));
        let classified = match self.classification {
            Classification::Post => "post-classified",
            Classification::PreIntegrated => "pre-integrated",
        };
        say(self.classification != own.classification, classified.to_owned());
        say(self.offset != own.offset, format!("{:?}", self.offset).to_lowercase());
        say(self.last != own.last, format!("{:?}", self.last).to_lowercase());
        say(self.filter != own.filter, format!("{:?} filter", self.filter).to_lowercase());
        say(self.alpha != own.alpha, format!("{:?} alpha", self.alpha).to_lowercase());
        say(self.accumulate != own.accumulate, format!("{:?}", self.accumulate).to_lowercase());
        say(self.texture != own.texture, format!("{:?} texture", self.texture).to_lowercase());
        words.join(", ")
    }

    /// The scene's own way and the two of the second order, and one change of each other kind.
    fn some(own: Self) -> Vec<Self> {
        let post = Self { classification: Classification::Post, ..own };
        let second = Self { offset: Offset::Midpoint, last: Last::Partial, ..post };
        let left = Self { offset: Offset::Left, ..second };
        let between = Self { classification: Classification::PreIntegrated, ..left };
        let exact = |way: Self| Self { filter: Filter::Exact, ..way };
        let mut ways = vec![
            own,
            second,
            between,
            exact(left),
            exact(second),
            exact(between),
            Self { alpha: Alpha::Paper, ..own },
            Self { accumulate: Accumulate::Rgba16f, ..exact(second) },
            Self { accumulate: Accumulate::Rgba8, ..exact(second) },
            Self { texture: VolumeTexture::R16, ..second },
            Self { texture: VolumeTexture::R32f, ..second },
        ];
        let mut seen = Vec::new();
        ways.retain(|way| {
            !seen.contains(way) && {
                seen.push(*way);
                true
            }
        });
        ways
    }

    fn all(own: Self) -> Vec<Self> {
        let (post, between) = (Classification::Post, Classification::PreIntegrated);
        let mut ways = vec![own];
        for (classification, offset) in [(post, Offset::Left), (post, Offset::Midpoint), (between, Offset::Left)] {
            for last in [Last::Full, Last::Partial] {
                for alpha in [Alpha::Exponential, Alpha::Paper] {
                    for accumulate in [Accumulate::Rgba32f, Accumulate::Rgba16f, Accumulate::Rgba8] {
                        for texture in [VolumeTexture::Native, VolumeTexture::R16, VolumeTexture::R32f] {
                            for filter in [Filter::Hardware, Filter::Exact] {
                                let way = Self { classification, offset, last, alpha, accumulate, texture, filter };
                                ways.extend((way != own).then_some(way));
                            }
                        }
                    }
                }
            }
        }
        ways
    }
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

impl Accuracy {
    pub fn run(&self) -> Result<()> {
        write::check_folder(&self.output)?;
        let mut settings = self.scene_options.settings(self.scene.as_deref())?;
        let of_a_file = self.scene.as_deref().is_some_and(is_scene_file);
        if self.scene_options.given.image.size.is_none() && !of_a_file {
            settings.image.size = [SIDE; 2];
        }
        if self.scene_options.given.sampling.termination.is_none() && !of_a_file {
            settings.sampling.termination = TERMINATION;
        }
        if self.method.iter().any(|method| !method::find(*method).is_some_and(|row| row.on_device)) {
            let remedy = "leave it out; every picture is held against the exact integral";
            return Err(Error::usage("--method cpu", "is the sum in f64, which has no frame time", remedy));
        }
        for step in &self.steps {
            let mut stepped = settings.clone();
            with_step(&mut stepped, &settings, *step);
            stepped.check()?;
        }
        let scene = read::scene(&settings)?;
        let checked = self.device.open()?;
        let progress = Progress::new();
        let provenance = Provenance::now(FORMAT);
        progress.say("exact integral");
        let truth = exact(&scene)?;
        let opaque = f64::from(truth.pixels.iter().map(|p| p[3]).fold(0.0, f32::max)) > settings.sampling.termination;
        let own = Way::of(&settings);
        let asked = Asked { checked: &checked, scene: &scene, own, truth: &truth, opaque };
        let mut ways = if self.full { Way::all(own) } else { Way::some(own) };
        // Some scenes cannot be classified by a table; one that asks for it is refused.
        ways.retain(|way| {
            let mut scene = scene.clone();
            way.apply(&mut scene.settings);
            *way == own || preintegrated::check(&scene).is_ok()
        });
        let mut curves = Vec::new();
        for (i, way) in ways.iter().enumerate() {
            let methods = if self.full || i < FOR_ALL { &self.method[..] } else { &self.method[..1] };
            progress.say(&format!("{} of {} ways of sampling", i + 1, ways.len()));
            curves.extend(self.curves(&asked, *way, methods)?);
        }
        mark_pareto(&mut curves);
        drop(progress);
        let info = checked.device.info.clone();
        self.device.close(checked)?;
        let found = Found {
            provenance,
            scene: scene_name(&settings),
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
        };
        self.write(found)
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

    fn write(&self, mut found: Found) -> Result<()> {
        write::create_folder(&self.output)?;
        found.settings = settings_in(&self.output, found.settings.clone());
        for curve in &mut found.curves {
            curve.settings = settings_in(&self.output, curve.settings.clone());
        }
        write_json(&self.output.join("accuracy.json"), &found)?;
        write_atomically(&self.output.join("accuracy.csv"), csv(&found)?.as_bytes())?;
        for (name, svg) in [("error-time.svg", time_svg(&found)?), ("error-step.svg", step_svg(&found)?)] {
            if let Some(svg) = svg {
                write_atomically(&self.output.join(name), svg.as_bytes())?;
            }
        }
        let report = self.output.join("accuracy.html");
        write_atomically(&report, page(&found)?.as_bytes())?;
        write::write_standard_output(format!("{}\nReport: {}\n", text(&found), report.display()).as_bytes())
    }
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
