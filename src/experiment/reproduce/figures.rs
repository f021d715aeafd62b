//! Pictures like the papers' figures: every built-in scene, and its forms on volumes of the user's.

use std::path::Path;

use super::FigureRecord;
use super::data::volume;
use crate::error::Result;
use crate::experiment::Host;
use crate::measure::Picture;
use crate::measure::runner::{Checked, Effort, Runner};
use crate::read;
use crate::scene::Settings;
use crate::scene::scenes::{self, BuiltinScene, SceneOnData};

/// A figure, and its picture where it was drawn.
pub type DrawnFigure = (FigureRecord, Option<Picture>);

/// Every figure, in the order of [`scenes::ALL`]; none is drawn without a device.
///
/// # Errors
/// When a volume cannot be read, or the driver fails.
pub fn draw(checked: Option<&Checked>, data: Option<&Path>, host: &Host) -> Result<Vec<DrawnFigure>> {
    let mut figures = Vec::new();
    for row in &scenes::ALL {
        figures.push(built_in(checked, row, host)?);
        for form in row.on_data {
            figures.push(on_data(checked, row, form, data, host)?);
        }
    }
    Ok(figures)
}

fn built_in(checked: Option<&Checked>, row: &BuiltinScene, host: &Host) -> Result<DrawnFigure> {
    let name = format!("builtin:{}", row.name);
    let mut figure = record(row.name, row.about, row);
    let Some(checked) = checked else {
        figure.absent =
            Some(format!("nothing was counted, so that no device was opened; `depthleap render {name}` draws it"));
        return Ok((figure, None));
    };
    let settings = read::settings_of(&name, row.text, Path::new(""))?;
    drawn(checked, figure, &settings, host)
}

fn on_data(
    checked: Option<&Checked>,
    row: &BuiltinScene,
    form: &SceneOnData,
    data: Option<&Path>,
    host: &Host,
) -> Result<DrawnFigure> {
    let mut figure = record(form.name, form.about, row);
    match (checked, volume(data, form.file)) {
        (Some(checked), Ok(path)) => {
            figure.file = Some(path.display().to_string());
            let settings = read::settings_of(form.file, form.text, data.unwrap_or(Path::new("")))?;
            drawn(checked, figure, &settings, host)
        }
        (_, found) => {
            figure.absent = Some(found.err().unwrap_or_else(|| "no device was opened".to_owned()));
            Ok((figure, None))
        }
    }
}

fn record(name: &str, about: &str, row: &BuiltinScene) -> FigureRecord {
    FigureRecord {
        scene: name.to_owned(),
        about: about.to_owned(),
        source: row.source.to_owned(),
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
