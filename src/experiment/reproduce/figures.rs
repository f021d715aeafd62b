//! Pictures like the papers' figures: every built-in scene, its forms on volumes of the user's, and figures that have no
//! other form.

use std::path::Path;

use super::FigureRecord;
use super::data::DataFolder;
use crate::error::Result;
use crate::experiment::Host;
use crate::measure::Checked;
use crate::measure::Picture;
use crate::measure::runner::{Effort, Runner};
use crate::read;
use crate::scene::Settings;
use crate::scene::scenes::{self, BuiltinScene, PaperFigure, SceneOnData};

/// A figure, and its picture where it was drawn.
pub type DrawnFigure = (FigureRecord, Option<Picture>);

/// Every figure, in the order of [`scenes::ALL`] and then of [`scenes::STEGMAIER`]; none is drawn without a device.
///
/// # Errors
/// When a volume cannot be read, or the driver fails.
pub fn draw(checked: Option<&Checked>, data: DataFolder, host: &Host) -> Result<Vec<DrawnFigure>> {
    let mut figures = Vec::new();
    for row in &scenes::ALL {
        figures.push(built_in(checked, row, data, host)?);
        for form in row.on_data {
            figures.push(on_data(checked, &of_scene(row, form), data, host)?);
        }
    }
    for row in &scenes::STEGMAIER {
        figures.push(on_data(checked, row, data, host)?);
    }
    Ok(figures)
}

/// Whether there is the volume of any figure that can be drawn.
pub fn any_volume(data: DataFolder) -> bool {
    let forms = scenes::ALL.iter().flat_map(|row| row.on_data).map(|form| form.file);
    let figures = scenes::STEGMAIER.iter().map(|row| row.file);
    forms.chain(figures).any(|file| data.volume(file).is_ok())
}

/// A form of a built-in scene, as the figure that it is.
fn of_scene(row: &BuiltinScene, form: &SceneOnData) -> PaperFigure {
    let SceneOnData { name, about, file, text } = *form;
    PaperFigure { name, about, source: row.source, file, text }
}

fn built_in(checked: Option<&Checked>, row: &BuiltinScene, data: DataFolder, host: &Host) -> Result<DrawnFigure> {
    let name = format!("builtin:{}", row.name);
    let figure = record(row.name, row.about, row.source);
    let absent = |why: String| Ok((FigureRecord { absent: Some(why), ..figure.clone() }, None));
    if let Some(why) = data.left_out {
        return absent(why.to_owned());
    }
    let Some(checked) = checked else {
        return absent(format!("no volume is there, so that no device was opened; `depthleap render {name}` draws it"));
    };
    let settings = read::settings_of(&name, row.text, Path::new(""))?;
    drawn(checked, figure, &settings, host)
}

fn on_data(checked: Option<&Checked>, row: &PaperFigure, data: DataFolder, host: &Host) -> Result<DrawnFigure> {
    let figure = record(row.name, row.about, row.source);
    let absent = |why: String| Ok((FigureRecord { absent: Some(why), ..figure.clone() }, None));
    match (checked, data.volume(row.file)) {
        (Some(checked), Ok(path)) => {
            let figure = FigureRecord { file: Some(path.display().to_string()), ..figure };
            let settings = read::settings_of(row.file, row.text, data.folder.unwrap_or(Path::new("")))?;
            drawn(checked, figure, &settings, host)
        }
        (_, found) => absent(found.err().unwrap_or_else(|| "no device was opened".to_owned())),
    }
}

fn record(name: &str, about: &str, source: &str) -> FigureRecord {
    FigureRecord {
        scene: name.to_owned(),
        about: about.to_owned(),
        source: source.to_owned(),
        file: None,
        absent: None,
        picture: None,
        run: None,
    }
}

fn drawn(checked: &Checked, figure: FigureRecord, settings: &Settings, host: &Host) -> Result<DrawnFigure> {
    (host.say)(&figure.about);
    let effort = Effort { warmups: 0, repeats: 0, reference: false };
    let mut runner = Runner::new(Some(checked), read::scene(settings)?, figure.about.clone());
    let measured = runner.measure(std::slice::from_ref(&settings.method), effort, &|_| {})?.pop();
    let (run, picture) = measured.map(|one| (one.run, one.picture)).unzip();
    Ok((FigureRecord { run, ..figure }, picture))
}
