//! What a run is recorded as, part by part.

use serde::{Deserialize, Serialize};

use crate::frame::LayerCounts;
use crate::plan::Plan;
use crate::scene::Effect;
use crate::scene::effect;
use crate::scene::texture::TextureChoice;

/// Fragments or invocations of a frame.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CountsRecord {
    pub main: u64,
    pub intermediate: u64,
    pub main_per_pass: Vec<u64>,
    pub intermediate_per_pass: Vec<u64>,
    /// Of the parts of rays between layers of polygons, front to back; absent where there are no polygons.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub per_layer: Vec<LayerRecord>,
}

/// Fragments of the parts of rays that end at a layer, or behind all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct LayerRecord {
    /// Pixels of the layer at which this part ends; absent where layers have no colours, whose pixels nobody draws.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixels: Option<u64>,
    pub main: u64,
    pub intermediate: u64,
}

impl CountsRecord {
    /// From the counts of each pass, in the order of the passes.
    pub fn of(main_per_pass: Vec<u64>, intermediate_per_pass: Vec<u64>) -> Self {
        let sum = |counts: &[u64]| counts.iter().fold(0_u64, |sum, c| sum.saturating_add(*c));
        Self {
            main: sum(&main_per_pass),
            intermediate: sum(&intermediate_per_pass),
            main_per_pass,
            intermediate_per_pass,
            per_layer: Vec::new(),
        }
    }

    /// The same with what each part of rays between layers has.
    pub fn with_layers(self, layers: &[LayerCounts]) -> Self {
        let record =
            |one: &LayerCounts| LayerRecord { pixels: one.pixels, main: one.main, intermediate: one.intermediate };
        Self { per_layer: layers.iter().map(record).collect(), ..self }
    }
}

/// Milliseconds of each pass, in the order of the passes; medians where repeated.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PassTimes {
    pub main: Vec<f64>,
    pub intermediate: Vec<f64>,
}

/// The lower bound of [Thesis §5.3]'s idea, from an exact search along every ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ideal {
    pub main: u64,
}

/// How far a picture is from the reference, in premultiplied linear RGBA.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorRecord {
    /// Largest difference of a channel, undecided pixels left out. `null` in the file: infinite (a pixel that is
    /// not a number).
    #[serde(with = "null_is_infinite")]
    pub max: f64,
    /// Root of the mean squared difference over all pixels and channels; `null` as above.
    #[serde(with = "null_is_infinite")]
    pub rmse: f64,
    /// Decibel against a peak of 1; `null` where it is infinite (`rmse` 0: equal pictures) or `rmse` is.
    pub psnr: Option<f64>,
    /// Pixels left out of `max`: f32 cannot decide there on which side of a jump or of a box face a sample lies.
    pub undecided: u64,
    /// What the picture was compared with.
    pub reference: String,
}

/// JSON has no infinity.
mod null_is_infinite {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        value.is_finite().then_some(*value).serialize(serializer)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(deserializer)?.unwrap_or(f64::INFINITY))
    }
}

/// A picture of a run, kept beside the results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureRecord {
    /// Place of the run among the runs, from 0.
    pub run: usize,
    /// The PNG file, seen from the folder of the results.
    pub file: String,
    /// What differs from the reference; null where there is none.
    pub difference: Option<DifferenceRecord>,
}

/// A picture of the differences of a run to its reference: grey, the largest of the channels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DifferenceRecord {
    /// The PNG file, as that of the picture.
    pub file: String,
    /// What the differences were multiplied with.
    pub gain: f64,
}

/// How a volume is kept on a device, and what that means for the picture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TextureRecord {
    /// Format and how voxels stand in it.
    pub format: String,
    /// A bound of the error of an interpolated x, as a part of the scalar range; `null` where there is none.
    #[serde(with = "null_is_infinite")]
    pub x_error: f64,
    /// A bound of what the error of x changes of a channel, premultiplied and linear; `null` as above.
    #[serde(with = "null_is_infinite")]
    pub pixel_error: f64,
    /// Whether the bounds are those of a device that was measured; `plan` asks none.
    #[serde(default)]
    pub measured: bool,
}

impl TextureRecord {
    /// Of a plan that reads the volume.
    pub fn of(plan: &Plan) -> Option<Self> {
        let of = |texture: TextureChoice| Self {
            format: texture.name(),
            x_error: texture.error,
            pixel_error: plan.pixel_error,
            measured: texture.measured,
        };
        plan.texture.map(of)
    }
}

/// The user's effect that samples and surfaces went through.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct EffectRecord {
    /// The file, without its folder.
    pub file: String,
    /// SHA-256 of its text, in hexadecimal digits.
    pub hash: String,
}

impl EffectRecord {
    pub fn of(effect: &Effect) -> Self {
        Self { file: effect.file().to_owned(), hash: effect.hash.clone() }
    }

    /// `tint.glsl (SHA-256 0123456789ab)`.
    pub fn words(&self) -> String {
        effect::words(&self.file, &self.hash)
    }
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeftOutRecord {
    pub what: String,
    pub why: String,
}

/// One frame of an orbit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OrbitFrame {
    pub frame: usize,
    /// How far the camera has turned about its `up` axis through its target, degrees.
    pub turned: f64,
    /// The structure it read: `omni`, `directional`, `optimal`, `cone`; none for methods that read none.
    pub structure: Option<String>,
    /// Frames since the one whose view the structure was made for; none where it is for every view.
    pub age: Option<i64>,
    /// Fragments.
    pub main: u64,
    pub intermediate: u64,
    /// Wall and CPU time of the frame, milliseconds.
    pub frame_ms: f64,
    pub cpu_ms: f64,
    /// Wall time of slices of a build between this frame and the next, milliseconds; 0 with a queue of its own.
    pub build_ms: f64,
    /// The axis of the stack of 2D textures that slices were taken from: `x`, `y`, `z`; none for other methods.
    #[serde(default)]
    pub stack: Option<String>,
    /// How far the picture is from that of the frame before; none of the first frame.
    #[serde(default)]
    pub change: Option<ChangeRecord>,
}

/// How far neighbouring pictures of an orbit are from each other, in premultiplied linear RGBA.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChangeRecord {
    /// Largest difference of a channel.
    pub largest: f64,
    /// Root of the mean squared difference over all pixels and channels.
    pub rms: f64,
}

/// What times are compared by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Clock {
    /// CPU time of the process: the device is a CPU.
    Cpu,
    /// Timestamps of the device.
    Gpu,
    /// Wall time of a frame: the device has no timestamps.
    Wall,
}

impl Clock {
    pub fn words(self) -> &'static str {
        match self {
            Self::Cpu => "time is CPU time of the process, the device being a CPU",
            Self::Gpu => "time is the device's",
            Self::Wall => "time is wall time of a frame, the device having no timestamps",
        }
    }

    /// The best there is on a device.
    pub fn on(cpu: bool, timestamps: bool) -> Self {
        match (cpu, timestamps) {
            (true, _) => Self::Cpu,
            (_, true) => Self::Gpu,
            _ => Self::Wall,
        }
    }
}

/// Parts of what `rc-ert` takes; below 0 where a method takes more.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Saved {
    /// The run compared with: `rc-ert`, and its form of culling and marking.
    pub against: String,
    /// Of all fragments, those of main and of intermediate passes; null for loops, whose fragments are rays.
    pub fragments: Option<f64>,
    /// Of the time of a frame; null where it was not timed.
    pub time: Option<f64>,
    pub clock: Option<Clock>,
}

impl Saved {
    /// *Culling efficiency*: the part of the fragments saved that became time saved, 1 where all of it did. None where
    /// no fragments were saved.
    pub fn efficiency(&self) -> Option<f64> {
        self.fragments.filter(|fragments| *fragments > 0.0).and_then(|fragments| Some(self.time? / fragments))
    }
}
