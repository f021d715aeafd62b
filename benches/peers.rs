//! How long a picture of a volume takes beside VTK and vispy, in CPU time of the process (all threads) on a device that is a CPU: the same voxels,
//! view, transfer function and step, all in the same minutes. Structures are built before. Every method of ours has the settings that `auto`
//! weighs it with; methods and peers are timed one after the other. Peers run where Python has their packages (`pip install vtk vispy PyOpenGL`).
//!
//! With `--equal-error` steps and T are those that `--error` chooses for the rmse that the peer's picture has at a step of 1, of red, green and
//! blue against the exact integral; where ours has a larger one all the same, a smaller one is asked for.
//!
//! `cargo bench --bench peers [-- [--equal-error] PART-OF-NAME]`, the name being `aneurism, ramp`. Needs a device and `../shared/data`. With
//! PICTURES=FOLDER the pictures of peers are kept there.

use std::path::{Path, PathBuf};
use std::process::Command;

use depthleap::auto::{AutoRecord, DeviceFacts, ErrorChoice, Estimate, choose, settle};
use depthleap::frame::self_check;
use depthleap::measure::runner::{Effort, Runner};
use depthleap::measure::{Checked, CostSource, Picture, Statistics, costs};
use depthleap::part::rows::{Ahead, Method};
use depthleap::scene::settings::{Distance, ErrorNorm, MethodSettings, Settings, Tiles};
use depthleap::scene::transfer::Knot;
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Camera, Scene};
use depthleap::truth::exact::ExactIntegrator;
use depthleap::vulkan::{Device, Instance, pick};
use depthleap::{Result, read};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");
const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers.py");
const VOLUMES: [&str; 5] = ["aneurism", "engine", "engine_256cube", "fuel", "mri_head"];
const TRANSFER_FUNCTIONS: [&str; 3] = ["ramp", "surface", "haze"];
const PEERS: [&str; 3] = ["vtk-fixed", "vtk-gpu", "vispy"];
const RUNS: usize = 5;
const EFFORT: Effort = Effort { warmups: 1, repeats: RUNS, reference: false };

/// Pixels of a side.
const SIZE: u32 = 500;

/// Where the camera stands: degrees, and volume space.
const AZIMUTH: f64 = 30.0;
const ELEVATION: f64 = 20.0;
const DISTANCE: f64 = 1.91;

/// The greatest code of 8 bits.
const CODES: f64 = 255.0;

fn main() -> Result<()> {
    // Cargo adds options of its own.
    let asked = std::env::args().skip(1).find(|argument| !argument.starts_with("--")).unwrap_or_default();
    let equal_error = std::env::args().any(|argument| argument == "--equal-error");
    let instance = Instance::new(false)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    println!("{}, {} {}", info.name, info.driver_name, info.driver_info);
    println!(
        "{SIZE} x {SIZE} pixels, step 1, CPU ms, median of {RUNS} (least to greatest), rmse against the exact integral"
    );
    let device = Device::new(&instance, &info, false)?;
    let checked = Checked { check: self_check(&device)?, device, early_end: None, costs: CostSource::Measured };
    let facts = DeviceFacts { costs: costs::of(&checked)?, ..DeviceFacts::default() };
    for volume in VOLUMES {
        let file = Path::new(DATA).join(format!("{volume}.nrrd"));
        for transfer in TRANSFER_FUNCTIONS {
            let name = format!("{volume}, {transfer}");
            if !name.contains(&asked) {
                continue;
            }
            match file.exists() {
                true if equal_error => {
                    compare_at_equal_error(&checked, &facts, &name, &scene(file.clone(), transfer)?)?
                }
                true => compare(&checked, &facts, &name, &scene(file.clone(), transfer)?)?,
                false => println!("{name}: left out, {} is not there", file.display()),
            }
        }
    }
    Ok(())
}

fn scene(file: PathBuf, transfer: &str) -> Result<Scene> {
    let mut settings = Settings::default();
    settings.volume.path = Some(file);
    settings.transfer.preset = Some(transfer.to_owned());
    settings.image.size = [SIZE; 2];
    settings.camera.eye = Camera::orbit(AZIMUTH, ELEVATION, DISTANCE, settings.camera.fov_y).eye.to_array();
    read::scene(&settings)
}

/// Milliseconds: the median, the least and the greatest.
struct Times([f64; 3]);

impl Times {
    fn median(&self) -> f64 {
        self.0[0]
    }

    fn words(&self) -> String {
        let [median, least, greatest] = self.0;
        format!("{median:.1} ({least:.1} to {greatest:.1})")
    }
}

/// A method of ours, measured.
struct Ours {
    method: &'static Method,
    words: String,
    times: Times,
    picture: Picture,
}

impl Ours {
    /// Against the exact integral.
    fn rmse(&self, exact: &[[f64; 4]]) -> f64 {
        rmse(self.picture.pixels.iter().map(|[r, g, b, _]| [*r, *g, *b].map(f64::from)), exact)
    }
}

/// A peer, measured.
struct Theirs {
    times: Times,
    picture: Vec<[u8; 3]>,
}

impl Theirs {
    /// Against the exact integral.
    fn rmse(&self, exact: &[[f64; 4]]) -> f64 {
        rmse(self.picture.iter().map(|rgb| rgb.map(|c| f64::from(c) / CODES)), exact)
    }

    fn line(&self, peer: &str, exact: &[[f64; 4]]) -> String {
        format!("  {peer:<48} {:<24} rmse {:.1e}", self.times.words(), self.rmse(exact))
    }
}

fn compare(checked: &Checked, facts: &DeviceFacts, name: &str, scene: &Scene) -> Result<()> {
    println!("\n{name}");
    let exact = exact(scene)?;
    let mut asked = scene.clone();
    // What is built is not counted.
    asked.settings.method.frames = u32::MAX;
    let record = choose(&asked, facts)?;
    let ours = ours(checked, scene, name, &record, record.weighed.len())?;
    for one in &ours {
        println!("  {:<48} {:<24} rmse {:.1e}", one.words, one.times.words(), one.rmse(&exact));
    }
    for peer in PEERS {
        match run_peer(scene, peer, name) {
            Ok(theirs) => println!("{}; {}", theirs.line(peer, &exact), ratios(&ours, &theirs)),
            Err(why) => println!("  {peer}: {why}"),
        }
    }
    Ok(())
}

/// How often a smaller error is asked for where the look has promised too much, which knows nothing of how a texture unit interpolates; and
/// how much smaller than what was missed.
const TRIES: usize = 5;
const SMALLER: f64 = 0.95;

/// Methods that are measured, the best by their estimates.
const MEASURED: usize = 3;

fn compare_at_equal_error(checked: &Checked, facts: &DeviceFacts, name: &str, scene: &Scene) -> Result<()> {
    println!("\n{name}");
    let exact = exact(scene)?;
    for peer in PEERS {
        let theirs = match run_peer(scene, peer, name) {
            Ok(theirs) => theirs,
            Err(why) => {
                println!("  {peer}: {why}");
                continue;
            }
        };
        println!("{}", theirs.line(peer, &exact));
        let mut bound = theirs.rmse(&exact);
        for _ in 0..TRIES {
            let mut chosen = scene.clone();
            chosen.settings.method.frames = u32::MAX;
            (chosen.settings.sampling.error, chosen.settings.sampling.error_norm) = (Some(bound), ErrorNorm::Rmse);
            let record = match settle(&mut chosen, facts) {
                Ok(Some(record)) => record,
                Ok(None) => break,
                Err(why) => {
                    println!("    {why}");
                    break;
                }
            };
            let ours = ours(checked, &chosen, name, &record, MEASURED)?;
            println!("    {}", record.error.iter().map(ErrorChoice::words).collect::<String>());
            for one in &ours {
                println!("    {:<46} {:<24} rmse {:.1e}", one.words, one.times.words(), one.rmse(&exact));
            }
            // A device may lack the forms of all of them.
            let Some(worst) = ours.iter().map(|one| one.rmse(&exact)).reduce(f64::max) else { break };
            if worst <= theirs.rmse(&exact) {
                println!("    {}", ratios(&ours, &theirs));
                break;
            }
            bound *= SMALLER * theirs.rmse(&exact) / worst;
        }
    }
    Ok(())
}

fn exact(scene: &Scene) -> Result<Vec<[f64; 4]>> {
    let rays = scene.camera.rays(scene.settings.image.size)?;
    Ok(ExactIntegrator::of(scene).picture(&rays, scene.settings.image.size))
}

/// How much of a peer's time the best of ours takes, and the best that is not made for one view.
fn ratios(ours: &[Ours], theirs: &Theirs) -> String {
    let for_a_view = |one: &&Ours| matches!(one.method.ahead, Ahead::Distances(Distance::Optimal | Distance::Cone));
    let best = ours.first().map(|one| one.times.median());
    let of_any_view = ours.iter().find(|one| !for_a_view(one)).map(|one| one.times.median());
    let ratio = |ours: Option<f64>| ours.map_or("-".to_owned(), |ms| format!("{:.2}", ms / theirs.times.median()));
    format!("the best of ours takes {} of it, without a structure for each view {}", ratio(best), ratio(of_any_view))
}

/// The best methods by their estimates, so many, with the settings that they were weighed with, by rising time. Those are left out that this
/// device lacks a form of.
fn ours(checked: &Checked, scene: &Scene, name: &str, record: &AutoRecord, count: usize) -> Result<Vec<Ours>> {
    let mut runner = Runner::new(Some(checked), scene.clone(), name.to_owned());
    let mut ours = Vec::new();
    for estimate in record.weighed.iter().take(count) {
        let Ok(method) = estimate.method.parse() else { continue };
        let method = MethodSettings {
            name: method,
            lookups: estimate.lookups,
            cell: estimate.cell,
            tiles: if record.tiles { Tiles::Live } else { Tiles::All },
            ..scene.settings.method.clone()
        };
        runner.vary(|settings| settings.sampling.samples_per_pass = estimate.samples_per_pass);
        // A form that this device lacks is not measured.
        if runner.check(std::slice::from_ref(&method)).is_err() {
            continue;
        }
        for one in runner.measure(&[method], EFFORT, &|_| {})? {
            let Some(Statistics { min, max, .. }) = one.run.host.cpu.and_then(|time| time.stats) else { continue };
            let median = one.run.host.cpu.map_or(f64::NAN, |time| time.value);
            ours.push(Ours {
                method: one.method,
                words: words(estimate),
                times: Times([median, min, max]),
                picture: one.picture,
            });
        }
    }
    ours.sort_by(|a, b| a.times.median().total_cmp(&b.times.median()));
    Ok(ours)
}

fn words(estimate: &Estimate) -> String {
    let Estimate { method, samples_per_pass, lookups, cell, .. } = estimate;
    format!("{method} (M {samples_per_pass}, look-ups {lookups}, cell {cell})")
}

fn rmse(picture: impl Iterator<Item = [f64; 3]>, exact: &[[f64; 4]]) -> f64 {
    let squares = picture.zip(exact).flat_map(|(ours, exact)| (0..3).map(move |c| (ours[c] - exact[c]).powi(2)));
    (squares.sum::<f64>() / (3 * exact.len()) as f64).sqrt()
}

/// Draws with a peer.
fn run_peer(scene: &Scene, peer: &str, name: &str) -> std::result::Result<Theirs, String> {
    let Voxels::U8(voxels) = &scene.field.volume.voxels else { return Err("takes bytes alone".to_owned()) };
    let folder = tempfile::tempdir().map_err(|e| e.to_string())?;
    let kept = std::env::var_os("PICTURES").map_or_else(|| folder.path().to_owned(), PathBuf::from);
    let [file, told] = ["voxels", "scene.json"].map(|name| folder.path().join(name));
    let picture = kept.join(format!("{}-{peer}.npy", name.replace(", ", "-")));
    let [low, high] = scene.field.range;
    let point = |knot: &Knot| {
        let [r, g, b] = knot.color;
        [low + knot.x * (high - low), r, g, b, knot.opacity]
    };
    let finest = scene.field.finest();
    let Camera { eye, target, up, fov_y, .. } = scene.camera;
    let words = serde_json::json!({
        "file": file, "dims": scene.field.dims(), "voxel": scene.field.voxel().to_array(),
        "points": scene.transfer.knots().iter().map(point).collect::<Vec<_>>(), "size": SIZE,
        "eye": eye.to_array(), "target": target.to_array(), "up": up.to_array(), "fov": fov_y,
        "unit": scene.transfer.reference * finest, "step": scene.settings.sampling.step * finest, "runs": RUNS, "out": picture,
    });
    std::fs::write(&file, voxels).and_then(|()| std::fs::write(&told, words.to_string())).map_err(|e| e.to_string())?;
    let said = Command::new("python3").arg(SCRIPT).arg(told).arg(peer).output();
    let said = said.map_err(|e| format!("python3 cannot be started ({e})"))?;
    if !said.status.success() {
        return Err("python3 has no such package, or it failed".to_owned());
    }
    let times = String::from_utf8_lossy(&said.stdout);
    let times: Vec<f64> =
        times.lines().last().unwrap_or_default().split(' ').filter_map(|word| word.parse().ok()).collect();
    let [median, least, greatest] = times[..] else { return Err("says no times".to_owned()) };
    let bytes = std::fs::read(picture).map_err(|e| e.to_string())?;
    let pixels = &bytes[bytes.len().saturating_sub(3 * (SIZE * SIZE) as usize)..];
    let picture = pixels.chunks_exact(3).map(|rgb| [rgb[0], rgb[1], rgb[2]]).collect();
    Ok(Theirs { times: Times([median, least, greatest]), picture })
}
