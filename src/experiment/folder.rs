//! A folder of results: the JSON of an experiment, the pictures beside it, and the pages that are made of both, as often
//! as one likes.

use std::cell::RefCell;
use std::io::Cursor;
use std::path::{Component, Path, PathBuf};

use crate::error::{Error, Result};
use crate::measure::picture::{Picture, PictureFormat};
use crate::measure::write::{create_folder, write_atomically};
use crate::read;
use crate::report::html::{Pictures, Png};
use crate::scene::Settings;

/// The folder of the pictures, within that of the results.
const PICTURES: &str = "pictures";

/// A file's name is cut after so many characters; longer ones are refused by some file systems.
const LONGEST_NAME: usize = 80;

/// The largest file that is taken for a picture, bytes: as much as one of 16384 x 16384 pixels of three bytes.
const LARGEST_PICTURE: u64 = 3 << 28;

/// How the pages of an experiment are made of its JSON.
pub struct Pages {
    /// The file of the results.
    pub json: &'static str,
    pub make: fn(&KeptResults) -> Result<Vec<Page>>,
}

/// What was kept of an experiment.
pub struct KeptResults<'a> {
    pub folder: &'a Path,
    /// The file of the results, for errors.
    pub name: String,
    pub text: String,
    pub pictures: Pictures<'a>,
}

/// A file that is made of results.
pub struct Page {
    /// Within the folder.
    pub name: String,
    pub text: String,
}

impl Page {
    pub fn new(name: impl Into<String>, text: String) -> Self {
        Self { name: name.into(), text }
    }
}

/// What was written.
pub struct Written {
    /// The pages for readers, without plots and rows.
    pub reports: Vec<PathBuf>,
    /// Pictures that the results name and that are not there, with the reason.
    pub missing: Vec<String>,
}

/// Makes the pages of all of `experiments` that have left results in `folder`, and writes them once all are made.
///
/// # Errors
/// When results cannot be read, a plot cannot be drawn, or a file cannot be written.
pub fn write_pages(folder: &Path, experiments: &[&Pages]) -> Result<Written> {
    let missing = RefCell::new(Vec::new());
    let pictures = |file: &str| {
        picture(folder, file).inspect_err(|why| {
            let line = format!("{file}: {why}");
            let mut missing = missing.borrow_mut();
            if !missing.contains(&line) {
                missing.push(line);
            }
        })
    };
    let mut pages = Vec::new();
    for experiment in experiments {
        let path = folder.join(experiment.json);
        let kept =
            KeptResults { folder, name: path.display().to_string(), text: read::text(&path)?, pictures: &pictures };
        pages.extend((experiment.make)(&kept)?);
    }
    let mut reports = Vec::new();
    for Page { name, text } in pages {
        let path = folder.join(&name);
        write_atomically(&path, text.as_bytes())?;
        reports.extend(name.ends_with(".html").then_some(path));
    }
    Ok(Written { reports, missing: missing.take() })
}

/// Keeps a picture in `folder` over `background` (linear RGB), under a name made of `words`; gives the file's name there.
///
/// # Errors
/// When the picture is inconsistent, or cannot be written.
pub fn keep_picture(folder: &Path, words: &[&str], picture: &Picture, background: [f64; 3]) -> Result<String> {
    create_folder(&folder.join(PICTURES))?;
    let file = format!("{PICTURES}/{}.png", file_name(words));
    let of_file = |e: Error| Error { input: format!("picture {file}"), ..e };
    let png = picture.encode(PictureFormat::Png, background).map_err(of_file)?;
    write_atomically(&folder.join(&file), &png)?;
    Ok(file)
}

/// Words as the name of a file that every system takes: lower-case letters of ASCII, digits and hyphens.
pub fn file_name(words: &[&str]) -> String {
    let mut name = String::new();
    for c in words.join(" ").chars() {
        match c.to_ascii_lowercase() {
            c if c.is_ascii_alphanumeric() => name.push(c),
            _ if name.ends_with('-') => {}
            _ => name.push('-'),
        }
    }
    let name: String = name.trim_matches('-').chars().take(LONGEST_NAME).collect();
    name.trim_end_matches('-').to_owned()
}

/// A picture of `folder`, or why there is none. Names that lead out of the folder are not followed.
fn picture(folder: &Path, file: &str) -> std::result::Result<Png, String> {
    let path = Path::new(file);
    if !path.components().all(|part| matches!(part, Component::Normal(_))) {
        return Err("its name leads out of the folder".to_owned());
    }
    let path = folder.join(path);
    let unreadable = |e: std::io::Error| match e.kind() {
        std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
        _ => format!("it cannot be read ({e})"),
    };
    let about = std::fs::metadata(&path).map_err(unreadable)?;
    if !about.is_file() || about.len() > LARGEST_PICTURE {
        return Err("it is not the file of a picture".to_owned());
    }
    let bytes = std::fs::read(&path).map_err(unreadable)?;
    let reader = image::ImageReader::with_format(Cursor::new(&bytes), image::ImageFormat::Png);
    let (width, height) = reader.into_dimensions().map_err(|e| format!("it is not a PNG file ({e})"))?;
    Ok(Png { bytes, size: [width, height] })
}

/// `settings` as a file in `folder` has them: relative paths are relative to it, as in a scene file.
pub fn settings_in(folder: &Path, mut settings: Settings) -> Settings {
    for file in settings.paths() {
        if file.is_relative() {
            *file = seen_from(folder, file).unwrap_or_else(|| file.clone());
        }
    }
    settings
}

/// The way from `folder` to `file`, both of which exist.
fn seen_from(folder: &Path, file: &Path) -> Option<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let (from, to) = (folder.canonicalize().ok()?, file.canonicalize().ok()?);
    let shared = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    let up = from.components().skip(shared).map(|_| Path::new("..").as_os_str());
    let down = to.components().skip(shared).map(|c| c.as_os_str());
    Some(up.chain(down).collect())
}
