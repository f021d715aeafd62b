//! What a case is, and how one is written down.

use crate::error::Result;
use crate::math::opacity::corrected_opacity;
use crate::method;
use crate::read;
use crate::scene::settings::{Filter, Last, MethodName, Settings, VolumeTexture};
use crate::scene::{Scene, Volume};

/// A scene that something may go wrong with.
pub struct StabilityCase {
    pub group: &'static str,
    pub name: String,
    pub settings: Settings,
    /// Voxels that no built-in volume has.
    pub volume: Option<Volume>,
    pub expect: Expect,
    pub tolerance: Tolerance,
    /// Methods it is for; all where there are none.
    pub methods: Vec<MethodName>,
}

/// The picture a case must give.
pub enum Expect {
    /// A medium of one colour and opacity along the whole ray, or along its first so many steps (Beer's law).
    Beer { color: [f64; 3], opacity: f64, steps: Option<f64> },
    /// A pixel's value where the volume's box covers it.
    Constant([f64; 4]),
    /// The exact emission-absorption integral.
    Exact,
    /// The same samples summed up in f64, where the samples themselves are what is asked for.
    Sum,
    /// Nothing at all, with not a single pass.
    Nothing,
    /// The picture, by the same samples in f64, of this volume in place of the case's own.
    SumOf(Volume),
    /// An error whose text has this in it, and no picture.
    Refused(&'static str),
}

/// How far a channel may be from what is expected, and why.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    pub absolute: f64,
    /// Of what is expected.
    pub relative: f64,
    pub reason: &'static str,
}

/// Some hundred samples, each rounded to f32 a few times.
pub const ROUNDING: Tolerance =
    Tolerance { absolute: 1e-7, relative: 5e-5, reason: "some hundred roundings to f32, and those of a ray's length" };

/// What the samples give is a matter of their sum alone.
pub const SAME_SUM: Tolerance =
    Tolerance { absolute: 2e-5, relative: 0.0, reason: "the same sum, rounded to f32 after each sample" };

/// Width and height of pictures where nothing else is asked for; odd, so that there is a ray through the middle.
const SIZE: [u32; 2] = [23, 19];

/// Colour of the media that obey Beer's law.
pub const COLOR: [f64; 3] = [0.8, 0.6, 0.3];

impl StabilityCase {
    /// Whether it is for a method: one of its own where it names some, and one that takes its scene, unless that is to be refused.
    pub fn is_for(&self, method: MethodName, scene: Option<&Scene>) -> bool {
        let named = self.methods.is_empty() || self.methods.contains(&method);
        let refused = matches!(self.expect, Expect::Refused(_));
        named && (refused || scene.is_none_or(|scene| method::takes(method, scene)))
    }

    /// A built-in volume, interpolated exactly, with a short last sample and no early termination; looked at from above
    /// one of its corners.
    pub fn new(group: &'static str, name: impl Into<String>, builtin: &str) -> Self {
        let mut settings = Settings::default();
        settings.volume.builtin = Some(builtin.to_owned());
        settings.volume.texture = VolumeTexture::R32f;
        settings.image.size = SIZE;
        settings.camera.eye = [0.8974, 0.6533, 1.5544];
        settings.sampling.samples_per_pass = 4;
        settings.sampling.filter = Filter::Exact;
        settings.sampling.last = Last::Partial;
        settings.sampling.termination = 1.0;
        Self {
            group,
            name: name.into(),
            settings,
            volume: None,
            expect: Expect::Sum,
            tolerance: SAME_SUM,
            methods: Vec::new(),
        }
    }

    /// A medium of one opacity a reference length, which Beer's law is known for.
    pub fn medium(group: &'static str, name: impl Into<String>, builtin: &str, opacity: f64) -> Self {
        let [r, g, b] = COLOR;
        Self::new(group, name, builtin)
            .points(&[[0.5, r, g, b, opacity]])
            .expect(Expect::Beer { color: COLOR, opacity, steps: None }, ROUNDING)
    }

    /// Its own voxels.
    pub fn voxels(mut self, volume: Volume) -> Self {
        self.volume = Some(volume);
        self
    }

    /// A transfer function by its points [x, red, green, blue, opacity].
    pub fn points(mut self, points: &[[f64; 5]]) -> Self {
        self.settings.transfer.points = Some(points.to_vec());
        self
    }

    pub fn preset(mut self, name: &str) -> Self {
        self.settings.transfer.points = None;
        self.settings.transfer.preset = Some(name.to_owned());
        self
    }

    /// Changes the settings.
    pub fn with(mut self, change: impl FnOnce(&mut Settings)) -> Self {
        change(&mut self.settings);
        self
    }

    pub fn expect(mut self, expect: Expect, tolerance: Tolerance) -> Self {
        (self.expect, self.tolerance) = (expect, tolerance);
        self
    }

    pub fn by(mut self, methods: &[MethodName]) -> Self {
        self.methods = methods.to_vec();
        self
    }

    /// # Errors
    /// When the scene is refused.
    pub fn scene(&self) -> Result<Scene> {
        match &self.volume {
            None => read::scene(&self.settings),
            Some(volume) => read::scene_of(&self.settings, |_| Ok(volume.clone())),
        }
    }
}

/// The pixel of a medium of one colour, by the length of its ray in what is left of the box.
pub fn beer(scene: &Scene, [column, row]: [u32; 2], color: [f64; 3], opacity: f64, steps: Option<f64>) -> [f64; 4] {
    let Ok(rays) = scene.camera.rays(scene.settings.image.size) else { return [0.0; 4] };
    let ray = rays.of(column, row);
    let Some((enter, leave)) = scene.interval(&ray, rays.near) else {
        return [0.0; 4];
    };
    let step = scene.settings.sampling.step;
    let all = (leave - enter) * ray.direction.length() / (step * scene.field.finest());
    if all <= scene.settings.sampling.offset.steps() {
        // Too short for a sample in the middle of its first step.
        return [0.0; 4];
    }
    let inside = steps.map_or(all, |steps| all.min(steps));
    let alpha = corrected_opacity(opacity, inside * step / scene.transfer.reference);
    let [r, g, b] = color.map(|c| c * alpha);
    [r, g, b, alpha]
}

impl Expect {
    pub fn words(&self) -> &'static str {
        match self {
            Self::Beer { .. } => "Beer's law",
            Self::Constant(_) => "a closed form",
            Self::Exact => "the exact integral",
            Self::Sum => "the same samples in f64",
            Self::Nothing => "nothing, and no pass",
            Self::SumOf(_) => "the same samples in f64, of voxels that were replaced",
            Self::Refused(_) => "to be refused",
        }
    }
}
