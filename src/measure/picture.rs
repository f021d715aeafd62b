//! A float picture and its files.

use std::io::{self, Cursor};
use std::path::Path;

use image::{ExtendedColorType, ImageEncoder, ImageError};
use npyz::WriterBuilder;

use super::write::{is_standard_output, write_atomically, write_standard_output};
use crate::error::{Error, Result};

/// Premultiplied linear RGBA, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height.
    pub size: [u32; 2],
    /// width * height of them, row by row.
    pub pixels: Vec<[f32; 4]>,
}

/// The kinds of picture files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// 8 bits a channel, sRGB, over a background.
    Png,
    /// OpenEXR, 32-bit float RGBA as it is.
    Exr,
    /// NumPy, float32 `[height][width][4]` as it is.
    Npy,
}

impl PictureFormat {
    /// By the extension. `-` is standard output as PNG; `-.png`, `-.exr` and `-.npy` name its format.
    ///
    /// # Errors
    /// When the extension names none of them.
    pub fn of(path: &Path) -> Result<Self> {
        if path.as_os_str() == "-" {
            return Ok(Self::Png);
        }
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            Some("npy") => Ok(Self::Npy),
            Some(other) => Err(Error::usage(
                path.display(),
                format!("has the extension `.{other}`, which is not a picture format written here"),
                "end it in .png, .exr or .npy",
            )),
            None => Err(Error::usage(
                path.display(),
                "has no extension to tell its format",
                "end it in .png, .exr or .npy, or give - for a PNG on standard output",
            )),
        }
    }
}

/// Structural similarity (SSIM) of two pictures as 8-bit grey over a background: 1 where they are equal. None where a
/// picture is smaller than the windows it is made of.
///
/// # Errors
/// When a picture is inconsistent, or their sizes differ.
pub fn similarity(a: &Picture, b: &Picture, background: [f64; 3]) -> Result<Option<f64>> {
    /// Pixels of a side of the library's windows.
    const WINDOW: u32 = 8;
    if a.size.iter().chain(&b.size).any(|side| *side < WINDOW) {
        return Ok(None);
    }
    let grey = |picture: &Picture| {
        picture.check()?;
        let rgb: Vec<u8> = picture.pixels.iter().flat_map(|p| over_background(*p, background)).collect();
        let image = image::RgbImage::from_raw(picture.size[0], picture.size[1], rgb).unwrap_or_default();
        Ok(image::DynamicImage::ImageRgb8(image).to_luma8())
    };
    let found = image_compare::gray_similarity_structure(&image_compare::Algorithm::MSSIMSimple, &grey(a)?, &grey(b)?);
    let found = found
        .map_err(|e| Error::usage("pictures", format!("cannot be compared ({e})"), "compare pictures of one size"))?;
    Ok(Some(found.score))
}

impl Picture {
    /// # Errors
    /// When a side is 0 or `pixels` are not width * height.
    pub fn new(size: [u32; 2], pixels: Vec<[f32; 4]>) -> Result<Self> {
        let picture = Self { size, pixels };
        picture.check()?;
        Ok(picture)
    }

    /// # Errors
    /// As [`Picture::new`]; the fields are open.
    pub fn check(&self) -> Result<()> {
        let [width, height] = self.size;
        let expected = u64::from(width) * u64::from(height);
        if expected == 0 || expected != self.pixels.len() as u64 {
            return Err(Error::usage(
                "picture",
                format!("has {} pixels for a size of {width} x {height}", self.pixels.len()),
                "give width * height pixels, at least one",
            ));
        }
        Ok(())
    }

    /// Writes a file of the format its name tells, or standard output; `background` (linear RGB) shows in PNG only.
    ///
    /// # Errors
    /// When the format is unknown, the picture is inconsistent, or the place cannot be written.
    pub fn write(&self, path: &Path, background: [f64; 3]) -> Result<()> {
        let format = PictureFormat::of(path)?;
        let bytes = self.encode(format, background)?;
        if is_standard_output(path) { write_standard_output(&bytes) } else { write_atomically(path, &bytes) }
    }

    /// The bytes of such a file.
    ///
    /// # Errors
    /// When the picture is inconsistent or its encoder refuses it.
    pub fn encode(&self, format: PictureFormat, background: [f64; 3]) -> Result<Vec<u8>> {
        self.check()?;
        match format {
            PictureFormat::Png => self.png(background).map_err(|e| refused("PNG", e)),
            PictureFormat::Exr => self.exr().map_err(|e| refused("EXR", e)),
            PictureFormat::Npy => self.npy().map_err(|e| refused("NPY", e)),
        }
    }

    fn png(&self, background: [f64; 3]) -> Result<Vec<u8>, ImageError> {
        let rgb: Vec<u8> = self.pixels.iter().flat_map(|p| over_background(*p, background)).collect();
        let mut bytes = Vec::new();
        image::codecs::png::PngEncoder::new(&mut bytes).write_image(
            &rgb,
            self.size[0],
            self.size[1],
            ExtendedColorType::Rgb8,
        )?;
        Ok(bytes)
    }

    fn exr(&self) -> Result<Vec<u8>, ImageError> {
        let mut bytes = Cursor::new(Vec::new());
        image::codecs::openexr::OpenExrEncoder::new(&mut bytes).write_image(
            bytemuck::cast_slice(&self.pixels),
            self.size[0],
            self.size[1],
            ExtendedColorType::Rgba32F,
        )?;
        Ok(bytes.into_inner())
    }

    fn npy(&self) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let shape = [u64::from(self.size[1]), u64::from(self.size[0]), 4];
        let mut writer = npyz::WriteOptions::new().default_dtype().shape(&shape).writer(&mut bytes).begin_nd()?;
        writer.extend(self.pixels.iter().flatten())?;
        writer.finish()?;
        Ok(bytes)
    }
}

fn refused(format: &str, e: impl std::fmt::Display) -> Error {
    Error::output("picture", format!("cannot be written as {format} ({e})"), "choose another format or a smaller size")
}

/// sRGB of a premultiplied linear pixel over a linear background.
fn over_background(pixel: [f32; 4], background: [f64; 3]) -> [u8; 3] {
    let through = 1.0 - f64::from(pixel[3]);
    std::array::from_fn(|c| (srgb(f64::from(pixel[c]) + through * background[c]) * 255.0 + 0.5) as u8)
}

/// The sRGB transfer curve (IEC 61966-2-1), clamped to [0, 1].
fn srgb(linear: f64) -> f64 {
    let x = linear.clamp(0.0, 1.0);
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}
