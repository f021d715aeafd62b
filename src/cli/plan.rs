//! `depthleap plan`: the passes a scene needs, and what is left out.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::{Serialize, Serializer};

use super::options::{SceneOptions, method_or_auto_parser, scene_name};
use super::output;
use crate::auto::{AutoRecord, DeviceFacts, settle};
use crate::measure::record::TextureRecord;
use crate::measure::write::{is_standard_output, write_json, write_standard_output};
use crate::method;
use crate::part::resource::Resource;
use crate::part::{Constant, Step};
use crate::plan::{self, LeftOut};
use crate::read;
use crate::scene::Scene;
use crate::scene::settings::MethodName;

/// The passes a scene needs, and what is left out; needs no GPU
///
/// `--cull auto` and `--mark auto` stand for the papers' own forms here, and `--texture auto` for a device that interpolates
/// in single precision, since no device is asked.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  depthleap plan fuel.nrrd --method rc-block
  depthleap plan --method nn-omni --cull ztest --json plan.json
  depthleap plan scene.toml --json - | jq .passes")]
pub struct PlanCommand {
    /// Scene file (.toml), volume file, mesh file, builtin:NAME:SIZE or a built-in scene [default: builtin:shells:64]
    #[arg(value_name = "SCENE|VOLUME")]
    scene: Option<OsString>,
    /// Render method [default: auto]
    #[arg(long, value_name = "NAME", value_parser = method_or_auto_parser())]
    method: Option<MethodName>,
    /// Write the plan as JSON too; for - to standard output, instead of the text
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    scene_options: SceneOptions,
}

#[derive(Serialize)]
struct PlanJson<'a> {
    version: u32,
    scene: String,
    method: &'static str,
    cull: Option<&'static str>,
    mark: Option<&'static str>,
    passes: u32,
    /// x, y, width, height in pixels.
    region: [u32; 4],
    steps: StepsJson<'a>,
    /// What frames draw into.
    targets: Vec<ResourceJson>,
    /// All that steps read or write, in bytes on a device.
    resources: Vec<ResourceJson>,
    /// Of all that the frame itself reads or writes.
    bytes: u64,
    left_out: &'a [LeftOut],
    /// How the volume is kept, where it is read, with bounds of the errors of x and of a channel.
    texture: Option<TextureRecord>,
    /// What `auto` has chosen, for a device of which nothing is known.
    auto: Option<AutoRecord>,
    warnings: Vec<String>,
}

/// Steps that are made as they are written: a long frame has very many.
struct StepsJson<'a>(&'a [Step]);

#[derive(Serialize)]
struct StepJson<'a> {
    name: &'a str,
    group: &'static str,
    reads: Vec<&'static str>,
    writes: Vec<&'static str>,
    shader: Option<String>,
    constants: &'a [Constant],
}

impl Serialize for StepsJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(StepJson::of))
    }
}

impl<'a> StepJson<'a> {
    fn of(step: &'a Step) -> Self {
        let names = |writes: bool| {
            step.accesses.iter().filter(|a| a.usage.writes() == writes).map(|a| a.resource.name()).collect()
        };
        let shader = step.work.shader().map(|shader| shader.to_string());
        let constants = step.work.constants();
        Self { name: &step.name, group: step.group.name(), reads: names(false), writes: names(true), shader, constants }
    }
}

#[derive(Serialize)]
struct ResourceJson {
    name: &'static str,
    bytes: u64,
}

impl PlanCommand {
    pub fn run(&self) -> crate::Result<()> {
        let outputs: Vec<&Path> = self.json.iter().map(PathBuf::as_path).collect();
        output::check(&outputs)?;
        let mut settings = self.scene_options.settings_left_open(self.scene.as_deref())?;
        settings.method.name = self.method.unwrap_or(settings.method.name);
        let mut scene = read::scene(&settings)?;
        let auto = settle(&mut scene, &DeviceFacts::default())?;
        let form = plan::form(&scene, method::papers_form(scene.settings.method.name))?;
        let plan = plan::plan(&scene, form)?;
        let warnings = plan::warnings(&scene, &plan);
        let name = scene_name(&settings);
        output::say("note", &name, &plan::notes(&scene));
        output::say("warning", &name, &warnings);
        let text = text(&scene, &plan, auto.as_ref());
        if let Some(file) = &self.json {
            write_json(file, &to_json(&scene, &plan, auto, warnings))?;
            if is_standard_output(file) {
                return Ok(());
            }
        }
        write_standard_output(text.as_bytes())
    }
}

fn text(scene: &Scene, plan: &plan::Plan, auto: Option<&AutoRecord>) -> String {
    let (settings, region) = (&scene.settings, plan.view.region);
    let form = plan.form.map_or_else(String::new, |f| format!(", {}", f.name()));
    let mut text = format!(
        "{}: {}{form}, {} main pass{} of {} samples, {} x {} pixels of {} x {}\n",
        scene_name(settings),
        settings.method.name.name(),
        plan.passes,
        if plan.passes == 1 { "" } else { "es" },
        settings.sampling.samples_per_pass,
        region.width,
        region.height,
        settings.image.size[0],
        settings.image.size[1],
    );
    let chosen = auto.iter().flat_map(|auto| auto.sentences());
    for line in chosen.chain(plan.lines()) {
        text.push_str(&line);
        text.push('\n');
    }
    text
}

fn to_json<'a>(scene: &Scene, plan: &'a plan::Plan, auto: Option<AutoRecord>, warnings: Vec<String>) -> PlanJson<'a> {
    let (facts, of_frame) = (plan.facts(scene), plan.resources_of(plan.frame()));
    let resources: Vec<(Resource, u64)> = plan.resources().into_iter().map(|r| (r, r.bytes(&facts))).collect();
    let json = |(resource, bytes): &(Resource, u64)| ResourceJson { name: resource.name(), bytes: *bytes };
    let region = plan.view.region;
    PlanJson {
        version: crate::measure::record::FORMAT,
        scene: scene_name(&scene.settings),
        method: scene.settings.method.name.name(),
        cull: plan.form.map(|f| f.cull_name()),
        mark: plan.form.map(|f| f.mark_name()),
        passes: plan.passes,
        region: [region.x, region.y, region.width, region.height],
        steps: StepsJson(&plan.steps),
        targets: resources.iter().filter(|(r, _)| r.is_target()).map(json).collect(),
        resources: resources.iter().map(json).collect(),
        bytes: resources.iter().filter(|(r, _)| of_frame.contains(r)).map(|(_, bytes)| bytes).sum(),
        left_out: &plan.left_out,
        texture: TextureRecord::of(plan),
        auto,
        warnings,
    }
}
