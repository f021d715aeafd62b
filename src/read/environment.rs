//! Pictures of what is around the volume: PNG, Radiance HDR and OpenEXR, by what a file begins with.

use std::io::Cursor;
use std::path::Path;

use glam::DQuat;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};

use super::exr_header;
use crate::error::{Error, Result};
use crate::scene::builtin::nearest;
use crate::scene::environment::Picture;
use crate::scene::limits::BRIGHTEST;
use crate::scene::settings::{ENVIRONMENTS, EnvironmentSettings, Mapping};
use crate::scene::{Environment, Polygons};

/// Texels of a picture at the most, across and down.
pub const MOST_TEXELS: [u32; 2] = [8192, 4096];

/// Bytes of a file at the most: twice what the largest picture has in single precision.
const MOST_BYTES: u64 = 1 << 30;

/// Bytes that a decoder may take for itself and its texels.
const MOST_DECODED: u64 = 1 << 30;

/// The environment that `settings` ask for, none where they ask for none; its path is taken as it stands. `turn` leads from the axes
/// of the volume, and of the polygons, to volume space.
///
/// # Errors
/// When both a file and a built-in environment are given, the name is unknown, the mapping is not that of what is built in, or
/// the file is not a picture that can be taken.
pub fn environment(settings: &EnvironmentSettings, polygons: &Polygons, turn: DQuat) -> Result<Option<Environment>> {
    let (mapping, reflectivity) = (settings.mapping, settings.reflectivity);
    let mut warnings = Vec::new();
    let picture = match (&settings.image, &settings.builtin) {
        (None, None) => return Ok(None),
        (Some(_), Some(_)) => {
            return Err(Error::usage("environment", "has both image and builtin", "keep one of them"));
        }
        (Some(path), None) => {
            let picture = picture(path)?;
            warnings.extend((mapping == Mapping::Latlong).then(|| stretched(path, picture.size)).flatten());
            picture
        }
        (None, Some(name)) => {
            let picture = builtin(name, polygons, turn)?;
            if mapping != Mapping::Latlong {
                return Err(Error::usage(
                    "environment.mapping (--mapping sphere)",
                    format!("is given for the built-in environment `{name}`, whose picture is latlong"),
                    "leave it out, or give a file",
                ));
            }
            let alone = name == "polygons" && polygons.opaque().is_empty();
            warnings.extend(alone.then(|| {
                "the environment `polygons` shows opaque meshes, of which the scene has none: surfaces reflect the sky alone".to_owned()
            }));
            picture
        }
    };
    Ok(Some(Environment { picture, mapping, reflectivity, turn, warnings }))
}

fn builtin(name: &str, polygons: &Polygons, turn: DQuat) -> Result<Picture> {
    match name {
        "sky" => Ok(Picture::of_sky()),
        "polygons" => Ok(Picture::of_polygons(polygons, turn)),
        _ => {
            let near = nearest(name, ENVIRONMENTS).map_or(String::new(), |n| format!("did you mean `{n}`? "));
            let remedy = format!("{near}choose one of {}, or give a file", ENVIRONMENTS.join(", "));
            let problem = format!("`{}` is not a built-in environment", name.escape_debug());
            Err(Error::usage("environment.builtin", problem, remedy))
        }
    }
}

/// That a latlong picture is not twice as wide as high.
fn stretched(path: &Path, [width, height]: [usize; 2]) -> Option<String> {
    (width != 2 * height).then(|| {
        format!(
            "the environment {} has {width} x {height} texels, and a latlong picture is twice as wide as high: what surfaces \
             reflect is stretched; give another one, or --mapping sphere for a mirror ball",
            path.display()
        )
    })
}

/// The picture in a file, in linear light: numbers of PNG are sRGB, others are taken as they are. Alpha is left out.
///
/// # Errors
/// When the file cannot be read, is not a picture of a known format, too large, cut off, or has a number that no light has.
pub fn picture(path: &Path) -> Result<Picture> {
    let bad = |problem: String, remedy: &str| Error::input(path.display(), problem, remedy);
    let (_, length) = super::open(path)?;
    if length > MOST_BYTES {
        return Err(bad(format!("has {length} bytes"), &format!("give a picture of up to {MOST_BYTES} bytes")));
    }
    let bytes = super::bytes(path)?;
    let format = match image::guess_format(&bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Hdr | ImageFormat::OpenExr)) => format,
        _ => {
            let remedy = "give PNG, Radiance HDR (beginning with #?RADIANCE) or OpenEXR";
            return Err(bad("is not a picture of a known format".to_owned(), remedy));
        }
    };
    if format == ImageFormat::OpenExr {
        let remedy = format!("give a flat picture of red, green and blue, of up to {}", within());
        exr_header::check(&bytes, MOST_TEXELS).map_err(|problem| bad(problem, &remedy))?;
    }
    let decoded = decoded(path, &bytes, format)?;
    let size = [decoded.width(), decoded.height()].map(|n| n as usize);
    let texels = if format == ImageFormat::Png { of_srgb(decoded) } else { of_linear(decoded) };
    match texels.iter().position(|texel| !texel.iter().all(|c| (0.0..=BRIGHTEST).contains(&f64::from(*c)))) {
        Some(at) => {
            let place = format!("column {} of row {}, counted from 0", at % size[0], at / size[0]);
            let problem = format!("has the texel {:?} in {place}", texels[at]);
            Err(bad(problem, &format!("give a picture of numbers from 0 to {BRIGHTEST}")))
        }
        None => Ok(Picture { size, texels }),
    }
}

/// How large a picture may be, in words.
fn within() -> String {
    format!("{} x {} texels", MOST_TEXELS[0], MOST_TEXELS[1])
}

/// Decodes a picture, once its size is known to be one that is taken.
fn decoded(path: &Path, bytes: &[u8], format: ImageFormat) -> Result<DynamicImage> {
    let broken = |e: image::ImageError| {
        let remedy = format!("give a whole picture of up to {}", within());
        Error::input(path.display(), format!("cannot be read as a picture ({e})"), remedy)
    };
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(MOST_TEXELS[0]), Some(MOST_TEXELS[1]));
    limits.max_alloc = Some(MOST_DECODED);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(broken)?;
    let (width, height) = decoder.dimensions();
    if !(1..=MOST_TEXELS[0]).contains(&width) || !(1..=MOST_TEXELS[1]).contains(&height) {
        let problem = format!("has {width} x {height} texels");
        return Err(Error::input(path.display(), problem, format!("give a picture of 1 x 1 to {}", within())));
    }
    DynamicImage::from_decoder(decoder).map_err(broken)
}

fn of_linear(decoded: DynamicImage) -> Vec<[f32; 3]> {
    decoded.into_rgb32f().pixels().map(|pixel| pixel.0).collect()
}

fn of_srgb(decoded: DynamicImage) -> Vec<[f32; 3]> {
    let linear: Vec<f32> = (0..=u16::MAX).map(|code| linear_of(f64::from(code) / f64::from(u16::MAX)) as f32).collect();
    decoded.into_rgb16().pixels().map(|pixel| pixel.0.map(|code| linear[usize::from(code)])).collect()
}

/// The inverse of the sRGB transfer curve (IEC 61966-2-1).
fn linear_of(srgb: f64) -> f64 {
    if srgb <= 0.040_45 { srgb / 12.92 } else { ((srgb + 0.055) / 1.055).powf(2.4) }
}
