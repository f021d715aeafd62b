//! The scene that several commands share: its file or volume, and the options that change its settings. What an option is
//! called and what it sets stands in [`crate::scene::settings`]; an option given on the command line wins over a file.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};

use crate::error::{Error, Result, shown};
use crate::method;
use crate::part::rows::Method;
use crate::projection::{PROJECTIONS, Projection};
use crate::read;
use crate::scene::settings::{
    Find, LeftOpen, MethodName, ProjectionName, Refine, Settings, SettingsOptions, ShellMode, SurfaceSettings,
};
use crate::scene::transfer::DEFAULT_PRESET;
use crate::scene::{builtin, scenes, tetrahedra};

/// What to show, how to sample it, and by which passes: all options that have their key in a scene file.
#[derive(Clone, Debug, Default, Args)]
#[command(mut_arg("kind", |arg| arg.value_parser(projection_parser())))]
pub struct SceneOptions {
    #[command(flatten)]
    pub(super) given: SettingsOptions,
}

impl SceneOptions {
    /// The settings of `scene` (a scene file, a volume, a mesh, `builtin:NAME:SIZE`, the `builtin:NAME` of a scene, or nothing)
    /// under these options.
    ///
    /// # Errors
    /// When a scene file cannot be read, or nothing built in has the name.
    pub fn settings(&self, scene: Option<&OsStr>) -> Result<Settings> {
        let mut settings = Settings::default();
        match scene {
            None => {}
            Some(name) => match (is_scene_file(name), built_in(name)) {
                (true, _) => settings = read::settings(Path::new(name))?,
                (false, Some(name)) => settings = built_in_settings(name)?,
                (false, None) => {
                    let file = PathBuf::from(name);
                    let is_mesh = read::mesh::by_extension(&file).is_some();
                    let key = if is_mesh { &mut settings.volume.mesh } else { &mut settings.volume.path };
                    *key = Some(file);
                }
            },
        }
        self.apply(&mut settings);
        Ok(settings)
    }

    /// The same for a picture that is no comparison: M and look-ups that neither the scene nor an option says are left to `auto`.
    ///
    /// # Errors
    /// As [`SceneOptions::settings`].
    pub fn settings_left_open(&self, scene: Option<&OsStr>) -> Result<Settings> {
        let mut settings = self.settings(scene)?;
        let text = scene.map_or(Ok(None), scene_text)?;
        let said = |section: &str, key: &str| text.as_ref().is_some_and(|text| read::says(text, section, key));
        let (sampling, method) = (&self.given.sampling, &self.given.method);
        let open = LeftOpen {
            samples_per_pass: sampling.samples_per_pass.is_none() && !said("sampling", "samples_per_pass"),
            lookups: method.lookups.is_none() && !said("method", "lookups"),
        };
        open.leave(&mut settings);
        Ok(settings)
    }

    /// Writes the options that were given over `settings`.
    pub fn apply(&self, settings: &mut Settings) {
        self.given.apply(settings);
    }
}

/// Whether a scene is named by its file, not by its volume.
pub fn is_scene_file(name: &OsStr) -> bool {
    name.as_encoded_bytes().ends_with(b".toml")
}

/// Whether a scene says more than its volume: a scene file, or a built-in scene.
pub fn is_whole_scene(name: &OsStr) -> bool {
    is_scene_file(name) || built_in(name).is_some_and(|name| scenes::find(name).is_some())
}

/// What stands behind `builtin:`.
fn built_in(name: &OsStr) -> Option<&str> {
    name.to_str()?.strip_prefix("builtin:")
}

/// The text of a scene file, or of a built-in scene; none where a scene is named by its volume alone.
///
/// # Errors
/// When the file cannot be read.
fn scene_text(name: &OsStr) -> Result<Option<Cow<'static, str>>> {
    match (is_scene_file(name), built_in(name).and_then(scenes::find)) {
        (true, _) => read::text(Path::new(name)).map(|text| Some(text.into())),
        (false, scene) => Ok(scene.map(|scene| scene.text.into())),
    }
}

/// The settings of a built-in scene, or of a built-in volume alone.
///
/// # Errors
/// When `spec` names neither.
fn built_in_settings(spec: &str) -> Result<Settings> {
    if let Some(scene) = scenes::find(spec) {
        return read::settings_of(&format!("builtin:{}", scene.name), scene.text, Path::new(""));
    }
    let name = spec.split_once(':').map_or(spec, |(name, _)| name);
    let is_mesh = tetrahedra::builtin::MESHES.iter().any(|mesh| mesh.name == name);
    if !is_mesh {
        builtin::find(name).map_err(|e| {
            let meshes = tetrahedra::builtin::MESHES.each_ref().map(|mesh| mesh.name).join(", ");
            let known = scenes::ALL.map(|scene| scene.name).join(", ");
            Error {
                remedy: format!("{}; of the meshes {meshes}; or of the scenes, which take no size: {known}", e.remedy),
                ..e
            }
        })?;
    }
    let mut settings = Settings::default();
    settings.volume.builtin = Some(spec.to_owned());
    Ok(settings)
}

/// What a scene is called in tables: the file without its folder, or the built-in volume, with the number of its meshes, of its
/// clip meshes, of its clip planes, of its clip volumes and of its lights, whether it has an environment and a background, whether
/// it refracts, and its effect.
pub fn scene_name(settings: &Settings) -> String {
    let volume = &settings.volume;
    let file = volume
        .path
        .as_deref()
        .or(volume.mesh.as_deref())
        .and_then(Path::file_stem)
        .map(|s| s.to_string_lossy().into_owned());
    let built_in = || volume.builtin.clone().unwrap_or_else(|| builtin::DEFAULT.to_owned());
    let transfer = &settings.transfer;
    let surfaces = settings.surface.asked();
    let tf = match (&transfer.preset, &transfer.file) {
        _ if !surfaces.is_empty() => surface_name(settings),
        _ if settings.shells.mode.is_some() => shells_name(settings),
        (Some(name), _) => name.clone(),
        (None, Some(file)) => file.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default(),
        (None, None) if transfer.points.is_some() => "points".to_owned(),
        (None, None) => DEFAULT_PRESET.to_owned(),
    };
    let number = |n: usize, one: &str, more: &str| match n {
        0 => None,
        1 => Some(one.to_owned()),
        n => Some(format!("{n} {more}")),
    };
    let meshes = number(settings.meshes.len(), "a mesh", "meshes");
    let planes = settings.clips.iter().filter(|clip| clip.plane.is_some()).count();
    let clips = settings.clips.iter().filter(|clip| clip.is_mesh()).count();
    let volumes = number(settings.clips.len() - planes - clips, "a clip volume", "clip volumes");
    let clips = number(clips, "a clip mesh", "clip meshes");
    let planes = number(planes, "a clip plane", "clip planes");
    let lights = number(settings.lights.len(), "a light", "lights");
    let environment = settings.environment.image.is_some() || settings.environment.builtin.is_some();
    let around = environment.then(|| "an environment".to_owned());
    let refracts = settings.effects.refraction.is_some().then(|| "refraction".to_owned());
    let behind = settings.effects.behind.is_some().then(|| "a background".to_owned());
    let effect = settings.effects.file.as_deref().and_then(Path::file_stem);
    let effect = effect.map(|stem| format!("the effect {}", stem.to_string_lossy()));
    let geometry: Vec<String> =
        [meshes, clips, planes, volumes, lights, around, refracts, behind, effect].into_iter().flatten().collect();
    let with = if geometry.is_empty() { "" } else { " with " };
    // A name may hold what a terminal obeys.
    let volume = file.unwrap_or_else(built_in);
    shown(&format!("{volume}{with}{}, {tf}", geometry.join(" and ")).replace('\n', "\\n"))
}

/// What the iso-surfaces of a scene are called: `iso 120`, with how they are found where that is not the usual way.
fn surface_name(settings: &Settings) -> String {
    let asked = settings.surface.asked();
    let name = match &asked[..] {
        [one] => format!("iso {}", one.iso),
        several => format!("{} iso-surfaces", several.len()),
    };
    name + &how_found(&settings.surface)
}

/// What is made of shells; how many there are says a note on their triangles.
fn shells_name(settings: &Settings) -> String {
    let shells = &settings.shells;
    match shells.mode {
        Some(ShellMode::Max) | None => "greatest emission".to_owned(),
        Some(ShellMode::Sum) => "sum of emissions".to_owned(),
        Some(ShellMode::Surface) => {
            let mut levels = shells.shell_levels.clone();
            levels.sort_by(f64::total_cmp);
            levels.dedup();
            let numbered = (1..).zip(&levels);
            let outermost = numbered.into_iter().find(|(number, _)| !shells.disabled.contains(number));
            let name = outermost.map_or("outermost shell".to_owned(), |(_, level)| format!("shell at {level}"));
            name + &how_found(&settings.surface)
        }
    }
}

/// How surfaces are found, where that is not as usual.
fn how_found(surface: &SurfaceSettings) -> String {
    let mut words = String::new();
    if surface.find == Find::Range {
        words += " as a range";
    }
    match surface.refine {
        Refine::None => words += ", not refined",
        Refine::Linear => {}
        Refine::Exact => words += ", to the root",
    }
    words
}

/// The names of methods, each with what it is.
pub(super) fn method_parser() -> impl TypedValueParser<Value = MethodName> {
    PossibleValuesParser::new(method::METHODS.map(value_of)).try_map(|name| name.parse::<MethodName>())
}

/// The same with the choice among them.
pub(super) fn method_or_auto_parser() -> impl TypedValueParser<Value = MethodName> {
    PossibleValuesParser::new(names_with_auto().collect::<Vec<_>>()).try_map(|name| name.parse::<MethodName>())
}

fn names_with_auto() -> impl Iterator<Item = PossibleValue> {
    let about = "What a look at the scene finds to take the least time, with M, look-ups and cell [not in the papers]";
    let auto = PossibleValue::new(MethodName::AUTO.name()).help(about);
    std::iter::once(auto).chain(method::METHODS.map(value_of))
}

/// Methods that are asked for by one word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum AskedMethods {
    /// Every one that runs on a device.
    All,
    One(MethodName),
}

impl AskedMethods {
    pub(super) fn names(&self) -> Vec<MethodName> {
        let on_device = || method::METHODS.into_iter().filter(|method| method.on_device);
        match self {
            Self::All => on_device().map(Method::name).collect(),
            Self::One(name) => vec![*name],
        }
    }
}

/// The word for every method.
const ALL: &str = "all";

/// The names of methods, `auto`, and the word for every method that draws the scene.
pub(super) fn asked_methods_parser() -> impl TypedValueParser<Value = AskedMethods> {
    let every = PossibleValue::new(ALL).help("Every method that runs on a device, where it draws the scene");
    let names = std::iter::once(every).chain(names_with_auto());
    PossibleValuesParser::new(names.collect::<Vec<_>>()).try_map(|name| match name.as_str() {
        ALL => Ok(AskedMethods::All),
        name => name.parse().map(AskedMethods::One),
    })
}

fn value_of(method: &Method) -> PossibleValue {
    PossibleValue::new(method.name).help(format!("{} [{}]", method.about, method.source))
}

/// The names of projections, each with what it is.
fn projection_parser() -> impl TypedValueParser<Value = ProjectionName> {
    let value = |row: &Projection| PossibleValue::new(row.name).help(format!("{} [{}]", row.about, row.source));
    PossibleValuesParser::new(PROJECTIONS.map(value)).try_map(|name| name.parse::<ProjectionName>())
}

/// Every method that is shown for a scene when none is asked for.
pub const BENCH_METHODS: [MethodName; 8] = [
    method::RC.name(),
    method::RC_ERT.name(),
    method::RC_BLOCK.name(),
    method::NN_OMNI.name(),
    method::NN_DIRECTIONAL.name(),
    method::NN_CONE.name(),
    method::NN_OPTIMAL.name(),
    method::NN_OPTIMAL_FUSED.name(),
];
