//! Times early ray termination: the same frames with it and without, in turn, from several directions.

use super::data::DataFolder;
use super::rates::{NO_TERMINATION, RateSet, STEGMAIER, TERMINATION, TimingPlan};
use super::rates::{effort, file_of, settings_of, turned};
use super::{ReproducedSet, Variant};
use crate::error::Result;
use crate::experiment::Host;
use crate::measure::Checked;
use crate::measure::abreast::measure_abreast;
use crate::measure::runner::Runner;
use crate::method;
use crate::read;
use crate::scene::Scene;
use crate::scene::settings::Settings;

/// What is chosen in the variants.
const CHOICE: &str = "transfer function";

/// A transfer function, by what it shows.
type TransferChoice = (&'static str, fn(&mut Settings));

/// The transfer functions of early ray termination; the one that is like the paper's is the first.
const TRANSFERS: [TransferChoice; 3] = [
    ("semi-transparent, as in the figure", |s| {
        s.transfer.preset = None;
        s.transfer.points = Some(SEMI_TRANSPARENT.to_vec());
    }),
    ("ramp", |s| s.transfer.preset = Some("ramp".to_owned())),
    ("surface", |s| s.transfer.preset = Some("surface".to_owned())),
];

/// The casting as a haze, what is denser as surfaces: that of the figure `stegmaier-5-volume`.
pub const SEMI_TRANSPARENT: [[f64; 5]; 5] = [
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [0.3, 0.45, 0.4, 0.35, 0.0],
    [0.5, 0.6, 0.55, 0.5, 0.02],
    [0.7, 0.9, 0.75, 0.5, 0.1],
    [1.0, 1.0, 0.9, 0.7, 0.6],
];

/// The volume that the paper states it of.
fn engine() -> &'static RateSet {
    STEGMAIER.told_in().unwrap_or(&STEGMAIER.sets[0])
}

/// The engine, timed where its volume is there and `checked` is a device.
///
/// # Errors
/// When the volume cannot be read, or the driver fails.
pub fn time_termination(
    checked: Option<&Checked>,
    data: DataFolder,
    plan: &TimingPlan,
    host: &Host,
) -> Result<ReproducedSet> {
    let data = plan.of(&STEGMAIER, data);
    let file = file_of(engine(), data);
    let mut column = ReproducedSet {
        name: engine().name.to_owned(),
        source: "Stegmaier05 §7".to_owned(),
        file: file.as_ref().ok().map(|path| path.display().to_string()),
        absent: file.err(),
        picture: None,
        variants: Vec::new(),
    };
    let Some(checked) = checked else { return Ok(column) };
    let transfers = if plan.sweep { &TRANSFERS[..] } else { &TRANSFERS[..1] };
    for (value, change) in transfers {
        let Some(settings) = settings_of(&STEGMAIER, engine(), data, *change) else { break };
        let scene = read::scene(&settings)?;
        let mut runs = Vec::new();
        for direction in 0..plan.directions {
            let of = plan.directions;
            (host.say)(&format!("early ray termination: {value}, direction {} of {of}", direction + 1));
            let mut pair = with_and_without(checked, &turned(&scene, plan, direction, plan.smallest(&STEGMAIER)));
            runs.extend(measure_abreast(&mut pair, effort(plan))?.into_iter().map(|one| one.run));
        }
        column.variants.push(Variant { choice: CHOICE.to_owned(), value: (*value).to_owned(), runs });
    }
    Ok(column)
}

/// The scene by the single pass, with rays that end early and with rays that do not.
fn with_and_without<'a>(checked: &'a Checked, scene: &Scene) -> [Runner<'a>; 2] {
    [TERMINATION, NO_TERMINATION].map(|termination| {
        let mut scene = scene.clone();
        scene.settings.sampling.termination = termination;
        scene.settings.method.name = method::SINGLE_PASS.name();
        Runner::new(Some(checked), scene, engine().name.to_owned())
    })
}
