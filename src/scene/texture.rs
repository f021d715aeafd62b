//! In which format a volume's voxels are kept for a device, and how far an interpolated x may then be off.
//!
//! A texture unit interpolates in a precision of its own: some round R8 to 8 bits after each of three steps, most have
//! weights of 8 fractional bits. What that does to x depends on the range: where few codes of the format fill it, an
//! error of one code is an error of much of x. So the unit is measured once, format by format, and the error is bounded
//! for the volume at hand.

use std::fmt;

use super::settings::{Filter, VolumeTexture};
use super::volume::VoxelType;
use super::{Field, Scene};

/// The formats of texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TexelFormat {
    /// Codes of 8 bits, read as numbers from 0 to 1.
    R8,
    /// Codes of 16 bits, read as numbers from 0 to 1.
    R16,
    R32f,
}

impl TexelFormat {
    pub const ALL: [Self; 3] = [Self::R8, Self::R16, Self::R32f];

    pub fn name(self) -> &'static str {
        match self {
            Self::R8 => "r8",
            Self::R16 => "r16",
            Self::R32f => "r32f",
        }
    }

    /// Bytes of a texel.
    pub fn bytes(self) -> usize {
        match self {
            Self::R8 => 1,
            Self::R16 => 2,
            Self::R32f => 4,
        }
    }
}

/// A bound of what interpolating texels between 0 and 1 may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilterError {
    /// Where neighbours hardly differ.
    pub rounding: f64,
    /// What comes to it for neighbours that differ by 1, as a unit's few bits of weights bring it.
    pub weight: f64,
}

/// What f32 takes from a value by a dozen roundings, relative: texel to number, three interpolations, the way to the
/// transfer function's units.
const F32_ROUNDING: f64 = 1.0 / (1 << 21) as f64;

/// Places of samples that shaders interpolate by themselves are good to so many voxels on each of three axes.
const SHADER_PLACE: f64 = 3.0 / (1 << 22) as f64;

/// Places that a texture unit is given are good to this part of the volume's side on each axis.
const UNIT_PLACE: f64 = 1.0 / (1 << 22) as f64;

/// What a device's texture unit is known to do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureUnit {
    /// The error by [`TexelFormat`]; none where the unit cannot interpolate the format.
    pub errors: [Option<FilterError>; 3],
    /// Whether the errors were measured on a device.
    pub measured: bool,
}

/// Where no device is known: one that interpolates every format in f32.
impl Default for TextureUnit {
    fn default() -> Self {
        Self { errors: [Some(FilterError { rounding: 0.0, weight: 0.0 }); 3], measured: false }
    }
}

/// What of a volume stands in its texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coding {
    /// Codes of 8 or 16 bits as they are.
    Stored,
    /// Codes of 8 bits in 16: c * 257, which stands for the same number.
    Widened,
    /// Codes in 16 bits, those of the values there are times a whole number that lets them fill the format.
    Stretched,
    /// 16 bits spread over the values there are, rounded.
    Spread,
    /// x in f32.
    Float,
}

/// How a volume is kept on a device, and what that means for x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureChoice {
    pub kept: Coding,
    pub format: TexelFormat,
    /// No interpolated x is farther than this from the one interpolated in exact arithmetic; infinite where there is no
    /// such bound.
    pub error: f64,
    /// Whether the bound is that of a device that was measured, not of one that interpolates every format in f32.
    pub measured: bool,
}

impl TextureChoice {
    /// The choice for a scene: what its settings name, or what `auto` becomes on its texture unit.
    pub fn of(scene: &Scene) -> Self {
        let (field, volume) = (&*scene.field, &scene.settings.volume);
        let filter = scene.settings.sampling.filter;
        let choice = |kept: Coding| {
            let format = format_of(field, kept);
            let error = error_of(field, kept, format, filter, &scene.unit);
            Self { kept, format, error, measured: scene.unit.measured || filter != Filter::Hardware }
        };
        if field.is_of_mesh() {
            return choice(Coding::Float);
        }
        match volume.texture {
            VolumeTexture::Native => choice(native(field)),
            VolumeTexture::R16 => choice(Coding::Spread),
            VolumeTexture::R32f => choice(Coding::Float),
            VolumeTexture::Auto => {
                let all: Vec<Self> = lossless(field, filter).iter().map(|kept| choice(*kept)).collect();
                let least = all.iter().map(|choice| choice.error).fold(f64::INFINITY, f64::min);
                // Where none is precise enough, the smallest that is not much worse than the best.
                let enough = volume.precision.max(NOT_MUCH_WORSE * least);
                let first = all.iter().find(|choice| choice.error <= enough);
                *first.unwrap_or(&all[all.len() - 1])
            }
        }
    }

    /// `r16, 8 bits widened`.
    pub fn name(&self) -> String {
        let how = match self.kept {
            Coding::Stored => "as stored",
            Coding::Widened => "8 bits widened",
            Coding::Stretched => "codes stretched over 16 bits",
            Coding::Spread => "spread over the values",
            Coding::Float => "x itself",
        };
        format!("{}, {how}", self.format.name())
    }
}

/// The map from x (0..1 over the scalar range) to the texture's own value: `scale * x + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureMap {
    pub scale: f64,
    pub offset: f64,
}

impl TextureMap {
    /// Of x itself.
    pub const IDENTITY: Self = Self { scale: 1.0, offset: 0.0 };

    /// The map to texels that are kept in that way.
    pub fn of(field: &Field, kept: Coding) -> Self {
        if field.has_empty_range() && kept != Coding::Spread {
            return Self::IDENTITY;
        }
        let [low, high] = field.range;
        match (kept, code_span(field)) {
            (Coding::Stored | Coding::Widened, Some([least, most])) => {
                Self { scale: (high - low) / (most - least), offset: (low - least) / (most - least) }
            }
            (Coding::Stretched, Some(_)) => {
                let Stretch { least, factor } = Stretch::of(field);
                let unit = f64::from(factor) / f64::from(u16::MAX);
                Self { scale: (high - low) * unit, offset: (low - least) * unit }
            }
            (Coding::Spread, _) => {
                let [low, high] = field.extremes().map(f64::from);
                let span = if high > low { high - low } else { 1.0 };
                Self { scale: 1.0 / span, offset: -low / span }
            }
            // Other types have no codes.
            (Coding::Float | Coding::Stored | Coding::Widened | Coding::Stretched, _) => Self::IDENTITY,
        }
    }

    /// The texture's value of x.
    pub fn value(self, x: f64) -> f64 {
        self.scale * x + self.offset
    }

    /// x of a value of the texture.
    pub fn x(self, value: f64) -> f64 {
        (value - self.offset) / self.scale
    }
}

/// A bound as tables and plans show it.
pub struct Within(pub f64);

impl fmt::Display for Within {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.0.is_finite() { write!(f, "{:.1e}", self.0) } else { f.write_str("no bound") }
    }
}

/// An error that is so many times as large costs less than a format of twice the bytes.
const NOT_MUCH_WORSE: f64 = 2.0;

/// The format that `native` stands for. Codes cannot stand for a volume whose missing voxels became a number that is
/// none of its type.
fn native(field: &Field) -> Coding {
    let coded = codes(field.volume.voxels.voxel_type()).is_some();
    let [low, _] = field.range;
    let replaceable =
        || low.fract() == 0.0 && code_span(field).is_some_and(|[least, most]| least <= low && low <= most);
    if coded && (field.missing == 0 || replaceable()) { Coding::Stored } else { Coding::Float }
}

/// What loses nothing of the volume, the smallest first. Where nothing is interpolated the codes themselves are exact.
fn lossless(field: &Field, filter: Filter) -> Vec<Coding> {
    match (native(field), codes(field.volume.voxels.voxel_type())) {
        (Coding::Stored, _) if filter == Filter::Nearest => vec![Coding::Stored],
        (Coding::Stored, Some(TexelFormat::R8)) => {
            vec![Coding::Stored, Coding::Widened, Coding::Stretched, Coding::Float]
        }
        (Coding::Stored, _) => vec![Coding::Stored, Coding::Stretched, Coding::Float],
        _ => vec![Coding::Float],
    }
}

/// How codes are stretched over 16 bits: a voxel's code is its value less `least`, times `factor`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    pub least: f64,
    pub factor: u16,
}

impl Stretch {
    /// The widest stretch of a volume of whole numbers.
    pub fn of(field: &Field) -> Self {
        let [least, most] = values(field);
        let span = (most - least).clamp(1.0, f64::from(u16::MAX));
        Self { least, factor: (f64::from(u16::MAX) / span) as u16 }
    }
}

/// The least and the greatest value, that of missing voxels among them.
fn values(field: &Field) -> [f64; 2] {
    let low = field.range[0];
    let [least, most] = field.value_extremes().unwrap_or([low; 2]);
    if field.missing > 0 { [least.min(low), most.max(low)] } else { [least, most] }
}

/// The format of a type's own codes.
fn codes(voxel_type: VoxelType) -> Option<TexelFormat> {
    match voxel_type {
        VoxelType::U8 | VoxelType::I8 => Some(TexelFormat::R8),
        VoxelType::U16 | VoxelType::I16 => Some(TexelFormat::R16),
        _ => None,
    }
}

/// The values that the least and the greatest code of the volume's type stand for.
pub fn code_span(field: &Field) -> Option<[f64; 2]> {
    match field.volume.voxels.voxel_type() {
        VoxelType::U8 => Some([0.0, f64::from(u8::MAX)]),
        VoxelType::I8 => Some([f64::from(i8::MIN), f64::from(i8::MAX)]),
        VoxelType::U16 => Some([0.0, f64::from(u16::MAX)]),
        VoxelType::I16 => Some([f64::from(i16::MIN), f64::from(i16::MAX)]),
        _ => None,
    }
}

fn format_of(field: &Field, kept: Coding) -> TexelFormat {
    match kept {
        Coding::Stored => codes(field.volume.voxels.voxel_type()).unwrap_or(TexelFormat::R32f),
        Coding::Widened | Coding::Stretched | Coding::Spread => TexelFormat::R16,
        Coding::Float => TexelFormat::R32f,
    }
}

/// A bound of the error of an interpolated x.
fn error_of(field: &Field, kept: Coding, format: TexelFormat, filter: Filter, unit: &TextureUnit) -> f64 {
    // x is 0 in every texel.
    if field.has_empty_range() {
        return 0.0;
    }
    let [low, high] = field.extremes().map(f64::from);
    let width = field.range[1] - field.range[0];
    // How much of x a texel's numbers from 0 to 1 span, the part of that its largest number takes, and what making it lost.
    let (span, top, made) = match (kept, code_span(field)) {
        (Coding::Stored | Coding::Widened, Some([least, most])) => {
            ((most - least) / width, (values(field)[1] - least) / (most - least), 0.0)
        }
        (Coding::Stretched, Some(_)) => {
            (f64::from(u16::MAX) / (f64::from(Stretch::of(field).factor) * width), 1.0, 0.0)
        }
        (Coding::Spread, _) => (high - low, 1.0, (high - low) * 0.5 / f64::from(u16::MAX)),
        _ => (low.abs().max(high.abs()), 1.0, 0.0),
    };
    let interpolated =
        interpolation(field, format, filter, unit).map_or(f64::INFINITY, |FilterError { rounding, weight }| {
            (rounding + F32_ROUNDING * top) * span + if weight > 0.0 { weight * field.contrast() } else { 0.0 }
        });
    let error = made + interpolated;
    if error.is_nan() { f64::INFINITY } else { error }
}

/// What interpolating a volume's texels may be off, places included; none where the texture unit cannot.
fn interpolation(field: &Field, format: TexelFormat, filter: Filter, unit: &TextureUnit) -> Option<FilterError> {
    let side = field.dims().into_iter().max().unwrap_or(1) as f64;
    match filter {
        Filter::Nearest => Some(FilterError { rounding: 0.0, weight: 0.0 }),
        Filter::Exact => Some(FilterError { rounding: 0.0, weight: SHADER_PLACE }),
        Filter::Hardware => unit.errors[format as usize]
            .map(|unit| FilterError { weight: unit.weight + 3.0 * UNIT_PLACE * side, ..unit }),
    }
}

impl Scene {
    /// What comes to the error of an interpolated x where places are off by so much on each axis, in texture coordinates.
    pub fn error_of_places(&self, off: f64) -> f64 {
        let voxels = 3.0 * off * self.field.dims().into_iter().max().unwrap_or(1) as f64;
        if voxels > 0.0 { voxels * self.field.contrast() } else { 0.0 }
    }

    /// A bound of the error of an interpolated x that samples take from beside their gradients, in codes of 8 bits where `codes`, of
    /// which a number from 0 to 1 spans so much of x; besides what making these lost.
    pub(super) fn error_beside_gradients(&self, codes: bool, span: f64) -> f64 {
        // Units do to four channels what they do to one, and halves are interpolated as numbers of single precision.
        let format = if codes { TexelFormat::R8 } else { TexelFormat::R32f };
        let (field, filter) = (&self.field, self.settings.sampling.filter);
        interpolation(field, format, filter, &self.unit).map_or(f64::INFINITY, |FilterError { rounding, weight }| {
            (rounding + F32_ROUNDING) * span + weight * field.contrast()
        })
    }
}
