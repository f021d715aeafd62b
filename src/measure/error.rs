//! How far one picture is from another.

use super::picture::Picture;
use super::record::ErrorRecord;
use crate::error::{Error, Result};

/// Differences of premultiplied linear RGBA, channel by channel. A number against NaN or infinity is infinitely far;
/// the same bits, or the same number, are equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureError {
    /// Largest difference of a channel, undecided pixels left out.
    pub max: f64,
    /// Root of the mean squared difference over *all* pixels and channels: what is left out of `max` shows here.
    pub rmse: f64,
    /// 20 log10(1 / rmse) in decibel; `None` where `rmse` is 0 or infinite.
    pub psnr: Option<f64>,
    /// Column and row of the pixel with the largest difference, undecided ones left out; `None` where nothing differs.
    pub worst_pixel: Option<[u32; 2]>,
    /// Pixels with any difference, undecided ones left out.
    pub differing: u64,
    /// Pixels left out.
    pub undecided: u64,
}

impl PictureError {
    /// As the results file has it; `reference` says what the picture was compared with.
    pub fn record(&self, reference: impl Into<String>) -> ErrorRecord {
        ErrorRecord {
            max: self.max,
            rmse: self.rmse,
            psnr: self.psnr,
            undecided: self.undecided,
            reference: reference.into(),
        }
    }
}

/// `skip`: one flag a pixel, true where the pixel is undecided.
///
/// # Errors
/// When the sizes differ, `skip` is of another length, or a picture is inconsistent.
pub fn compare(a: &Picture, b: &Picture, skip: Option<&[bool]>) -> Result<PictureError> {
    same_size(a, b)?;
    if let Some(skip) = skip.filter(|s| s.len() != a.pixels.len()) {
        return Err(Error::usage(
            "pictures",
            format!("have {} pixels, but {} flags say which to leave out", a.pixels.len(), skip.len()),
            "give one flag a pixel",
        ));
    }
    let mut squares = 0.0;
    let (mut max, mut worst, mut differing, mut undecided) = (0.0, None, 0, 0);
    for (i, (p, q)) in a.pixels.iter().zip(&b.pixels).enumerate() {
        let distances: [f64; 4] = std::array::from_fn(|c| distance(p[c], q[c]));
        squares += distances.iter().map(|d| d * d).sum::<f64>();
        if skip.is_some_and(|s| s[i]) {
            undecided += 1;
            continue;
        }
        let largest = distances.into_iter().fold(0.0, f64::max);
        differing += u64::from(largest > 0.0);
        if largest > max {
            (max, worst) = (largest, Some(i as u64));
        }
    }
    let rmse = (squares / (4 * a.pixels.len()) as f64).sqrt();
    let width = u64::from(a.size[0]);
    Ok(PictureError {
        max,
        rmse,
        psnr: (rmse > 0.0 && rmse.is_finite()).then(|| -20.0 * rmse.log10()),
        worst_pixel: worst.map(|i| [(i % width) as u32, (i / width) as u32]),
        differing,
        undecided,
    })
}

/// A picture of the differences for the eye: opaque grey, the largest difference of the four channels times `gain`.
///
/// # Errors
/// As [`compare`].
pub fn difference(a: &Picture, b: &Picture, gain: f64) -> Result<Picture> {
    same_size(a, b)?;
    let grey = |(p, q): (&[f32; 4], &[f32; 4])| {
        let largest = (0..4).map(|c| distance(p[c], q[c])).fold(0.0, f64::max);
        let value = (largest * gain).min(1.0) as f32;
        [value, value, value, 1.0]
    };
    Ok(Picture { size: a.size, pixels: a.pixels.iter().zip(&b.pixels).map(grey).collect() })
}

fn distance(a: f32, b: f32) -> f64 {
    if a == b || a.to_bits() == b.to_bits() {
        return 0.0;
    }
    let d = (f64::from(a) - f64::from(b)).abs();
    if d.is_nan() { f64::INFINITY } else { d }
}

fn same_size(a: &Picture, b: &Picture) -> Result<()> {
    a.check()?;
    b.check()?;
    if a.size != b.size {
        return Err(Error::usage(
            "pictures",
            format!("are {} x {} and {} x {}", a.size[0], a.size[1], b.size[0], b.size[1]),
            "compare pictures of one size",
        ));
    }
    Ok(())
}
