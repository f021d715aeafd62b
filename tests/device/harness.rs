//! The harness of tests that need a Vulkan device: one device with the validation layer on for all tests,
//! one test at a time, any validation message fails the test that brought it. What a machine lacks (a device, a
//! feature, `../shared/data`) makes a test *ignored*, with a line that says so: skipped is not passed.
//!
//! `VK_DRIVER_FILES` picks the driver; `tools/test` runs this program once for each driver it knows. At the end it names the
//! tests that took most CPU time, which a busy machine troubles less than time by the clock.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::{Arc, Mutex, Weak};

use depthleap::frame::Resident;
use depthleap::vulkan::{Device, Instance, pick};
use libtest_mimic::{Arguments, Failed, Trial};

/// A test: its name, what it needs besides a device, and what it does.
pub struct Test {
    name: String,
    needs: Vec<Need>,
    run: Run,
}

type Run = Box<dyn FnOnce(&Arc<Device>) -> Result<(), Failed> + Send>;

/// What some machines lack.
#[derive(Clone, Debug)]
pub enum Need {
    DepthBounds,
    Conditional,
    /// The depth bounds test missing: what is refused then.
    NoDepthBounds,
    /// Computing on queues of another family than drawing.
    ComputeFamily,
    /// A file of `../shared/data`.
    Data(&'static str),
    /// One driver, whichever it is.
    AnyDriver,
    /// The time of a driver that others do not stand in for.
    Thoroughness,
    /// A driver whose turn the test of this number is.
    Turn(usize),
    /// A driver that draws every scene in every form.
    EveryForm,
}

/// Tests that need a device and nothing more, each named after its function.
macro_rules! tests {
    ($($test:path),* $(,)?) => {
        vec![$($crate::harness::test(stringify!($test).rsplit("::").next().unwrap_or_default(), $test)),*]
    };
}
pub(crate) use tests;

/// A test that needs a device and nothing more.
pub fn test(name: &str, run: impl FnOnce(&Arc<Device>) + Send + 'static) -> Test {
    let run = Box::new(move |device: &Arc<Device>| {
        run(device);
        Ok(())
    });
    Test { name: name.to_owned(), needs: Vec::new(), run }
}

impl Test {
    /// The test as `module::name`.
    pub fn within(self, module: &str) -> Self {
        Self { name: format!("{module}::{}", self.name), ..self }
    }

    pub fn needs(mut self, need: Need) -> Self {
        self.needs.push(need);
        self
    }
}

/// Set for drivers beside another one, which alone has what is no matter of a driver and takes minutes: real volumes, and what
/// commands make of pictures and counts.
const DRIVER_ONLY: &str = "DEPTHLEAP_DRIVER_ONLY";

/// Set for a driver beside another one that draws scenes in more forms.
const SOME_FORMS: &str = "DEPTHLEAP_SOME_FORMS";

/// Set where every scene of the matrix is to be drawn in every form by every method, which takes long.
const ALL_FORMS: &str = "DEPTHLEAP_ALL_FORMS";

/// Whether tests that go over all forms of many scenes draw each scene in one of them, and another scene in another.
pub fn some_forms() -> bool {
    std::env::var_os(SOME_FORMS).is_some()
}

/// Whether the matrix leaves no form and no loop to the next scene.
pub fn all_forms() -> bool {
    std::env::var_os(ALL_FORMS).is_some() && !some_forms()
}

/// Whether other drivers do more of everything: tests that take minutes here are left to them.
pub fn least() -> bool {
    some_forms() && std::env::var_os(DRIVER_ONLY).is_some()
}

/// Whether another driver takes its share of the methods and views, so that this one, which has every form, takes others.
pub fn beside() -> bool {
    !some_forms() && std::env::var_os(DRIVER_ONLY).is_some()
}

/// One in so many that a driver takes beside another one, which takes others; the rest is left to the next scene.
const SHARE: usize = 4;

/// One in so many that a driver takes where others do more of everything.
const LEAST_SHARE: usize = 12;

/// What this driver takes of `all` views or methods of a scene: all of them or, beside another driver, every fourth one, by `turn` from
/// the first to the fourth on, and the next ones on the other driver; where other drivers do more of everything every twelfth. One
/// at least. Scenes that count their turns have all of them between them.
pub fn share<T>(all: impl IntoIterator<Item = T>, turn: usize) -> Vec<T> {
    let all: Vec<T> = all.into_iter().collect();
    // Where sides take turns too, a method would be drawn from the same ones always.
    let shifted = turn + turn / SHARE;
    let (every, turn) = match () {
        () if least() => (LEAST_SHARE, turn),
        () if beside() => (SHARE, shifted + 1),
        () if some_forms() => (SHARE, shifted),
        () => (1, 0),
    };
    let every = every.min(all.len()).max(1);
    all.into_iter().skip(turn % every).step_by(every).collect()
}

/// A file of `../shared/data`, beside the checkout.
pub fn data(file: &str) -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data")).join(file)
}

/// The device under test, with validation.
pub fn open(single_queue: bool) -> depthleap::Result<Arc<Device>> {
    let instance = Instance::new(true)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    Device::new(&instance, &info, single_queue)
}

/// What frames on the device under test are drawn with, between one test and the next: drivers take most of the tests' time to
/// compile pipelines, which many scenes share.
static KEPT: Mutex<Kept> = Mutex::new(Kept { device: Weak::new(), resident: None, users: 0 });

/// Users of the same pipelines at the most. All of a driver's pipelines together take more memory than a machine may have: 12 GB
/// on lavapipe 22.3.
const MOST_USERS: usize = 8;

struct Kept {
    /// The device under test.
    device: Weak<Device>,
    /// Pipelines, and nothing of a scene; none while a test has them.
    resident: Option<Resident>,
    /// How often they were given back.
    users: usize,
}

/// Pipelines of earlier tests, where no other test has them and the device is the one under test; else none yet.
pub fn lent(device: &Arc<Device>) -> Resident {
    let mut kept = KEPT.lock().expect("no test holds it");
    let known = Weak::as_ptr(&kept.device) == Arc::as_ptr(device);
    kept.resident.take_if(|_| known).unwrap_or_else(|| Resident::new(device))
}

/// Takes pipelines of the device back, for later tests.
pub fn give_back(device: &Arc<Device>, mut resident: Resident) {
    resident.forget_scene();
    let mut kept = KEPT.lock().expect("no test holds it");
    if Weak::as_ptr(&kept.device) == Arc::as_ptr(device) {
        kept.users = (kept.users + 1) % MOST_USERS;
        kept.resident = (kept.users > 0).then_some(resident);
    }
}

/// Messages of a test that are printed.
const MESSAGES: usize = 3;

/// Runs `test` and fails it when validation of its device said anything meanwhile.
pub fn judged(device: &Arc<Device>, test: impl FnOnce(&Arc<Device>) -> Result<(), Failed>) -> Result<(), Failed> {
    let before = device.instance().messages().len();
    let result = test(device);
    let messages = device.instance().messages();
    match messages.get(before..) {
        Some([]) | None => result,
        Some(new) => {
            let first = new[..new.len().min(MESSAGES)].join("\n");
            Err(Failed::from(format!("validation says, {} times:\n{first}", new.len())))
        }
    }
}

/// Tests named at the end, those that took longest.
const SLOWEST: usize = 8;

/// Groups of tests that took less than this part of all are not named.
const LARGE: f64 = 0.03;

/// Tests that took less are not worth a line, in seconds.
const SLOW: f64 = 2.0;

/// Seconds of CPU time that each test took.
static TIMES: Mutex<Vec<(f64, String)>> = Mutex::new(Vec::new());

/// Runs the tests.
pub fn run(tests: Vec<Test>) -> ExitCode {
    let mut arguments = Arguments::from_args();
    // CPU drivers take all cores for one frame, and messages belong to the test that runs.
    arguments.test_threads = Some(1);
    let device = open(false);
    match &device {
        Ok(device) => {
            let info = &device.info;
            eprintln!("device under test: {}, {} {}", info.name, info.driver_name, info.driver_info);
            if !all_forms() {
                eprintln!(
                    "LEFT TO OTHER SCENES: two of three forms of a method, and every other loop, in the matrix ({ALL_FORMS})"
                );
            }
            if beside() {
                eprintln!(
                    "LEFT TO ANOTHER DRIVER: two of three methods and sides of a scene, and every other test of two ({DRIVER_ONLY})"
                );
            }
            if some_forms() {
                eprintln!(
                    "LEFT TO ANOTHER DRIVER: all forms of a method in one scene; here another one in each ({SOME_FORMS})"
                );
            }
        }
        Err(error) => eprintln!("NO DEVICE UNDER TEST, every test of this program is skipped: {error}"),
    }
    if let Ok(device) = &device {
        KEPT.lock().expect("no test has begun").device = Arc::downgrade(device);
    }
    let mut skipped = BTreeMap::new();
    let trials = tests.into_iter().map(|test| trial(test, device.as_ref().ok(), &mut skipped)).collect();
    for (missing, names) in &skipped {
        eprintln!("SKIPPED for want of {missing}: {}", names.join(", "));
    }
    let conclusion = libtest_mimic::run(&arguments, trials);
    say_slowest();
    if conclusion.num_ignored > 0 {
        eprintln!("{} test(s) SKIPPED, for the reasons above", conclusion.num_ignored);
    }
    KEPT.lock().expect("no test holds it").resident = None;
    match device.map_or_else(|_| Vec::new(), closed) {
        messages if messages.is_empty() => conclusion.exit_code(),
        messages => {
            eprintln!("FAILED: when the device was closed, validation says:\n{}", messages.join("\n"));
            ExitCode::FAILURE
        }
    }
}

/// What validation says when a device goes: about objects that are left, for one.
pub fn closed(device: Arc<Device>) -> Vec<String> {
    let instance = device.instance().clone();
    let before = instance.messages().len();
    drop(device);
    instance.messages().split_off(before)
}

/// The trial of a test; one that is skipped is named among those that lack the same.
fn trial(test: Test, device: Option<&Arc<Device>>, skipped: &mut BTreeMap<String, Vec<String>>) -> Trial {
    let Test { name, needs, run } = test;
    let missing = match device {
        None => Some("a device".to_owned()),
        Some(device) => needs.iter().find_map(|need| lacks(need, device)),
    };
    let Some(device) = device.filter(|_| missing.is_none()).cloned() else {
        let missing = missing.unwrap_or_default();
        skipped.entry(missing.clone()).or_default().push(name.clone());
        return Trial::test(name, move || Err(Failed::from(format!("needs {missing}")))).with_ignored_flag(true);
    };
    Trial::test(name.clone(), move || {
        let before = cpu_seconds();
        let result = judged(&device, run);
        let took = cpu_seconds().zip(before).map_or(0.0, |(after, before)| after - before);
        TIMES.lock().expect("no test holds it").push((took, name));
        result
    })
}

fn say_slowest() {
    let mut times = std::mem::take(&mut *TIMES.lock().expect("no test holds it"));
    times.sort_by(|a, b| b.0.total_cmp(&a.0));
    let all: f64 = times.iter().map(|(seconds, _)| seconds).sum();
    eprintln!("{all:.0} s of CPU time in tests, most of it in");
    for (seconds, name) in times.iter().filter(|(seconds, _)| *seconds >= SLOW).take(SLOWEST) {
        eprintln!("{seconds:6.1} s {name}");
    }
    // Groups of tests: the first two parts of their names.
    let mut groups: BTreeMap<String, f64> = BTreeMap::new();
    for (seconds, name) in &times {
        *groups.entry(name.split("::").take(2).collect::<Vec<_>>().join("::")).or_default() += seconds;
    }
    let large: Vec<String> = groups
        .iter()
        .filter(|(_, seconds)| **seconds >= LARGE * all)
        .map(|(name, seconds)| format!("{name} {seconds:.0}"))
        .collect();
    eprintln!("groups that took most, in seconds: {}", large.join(", "));
}

/// CPU time of this process and of the programs it has started and waited for; none where the system does not say so.
fn cpu_seconds() -> Option<f64> {
    // What Linux counts by for every program, whatever its kernel does.
    const TICKS_PER_SECOND: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // Behind the name in brackets, which may have spaces: the 14th to 17th fields, user and system, its own and of children.
    let (_, fields) = stat.rsplit_once(')')?;
    let ticks = fields.split_whitespace().skip(11).take(4).map(|field| field.parse::<f64>().ok());
    Some(ticks.sum::<Option<f64>>()? / TICKS_PER_SECOND)
}

fn lacks(need: &Need, device: &Device) -> Option<String> {
    match need {
        Need::DepthBounds => (!device.info.depth_bounds).then(|| "a device with the depth bounds test".to_owned()),
        Need::Conditional => {
            (!device.info.conditional_rendering).then(|| "a driver with conditional rendering".to_owned())
        }
        Need::NoDepthBounds => device.info.depth_bounds.then(|| "a device without the depth bounds test".to_owned()),
        Need::ComputeFamily => (device.compute.family == device.graphics.family)
            .then(|| "a device that computes on queues of another family".to_owned()),
        Need::Thoroughness => {
            least().then(|| format!("what takes minutes, which {SOME_FORMS} and {DRIVER_ONLY} leave to another driver"))
        }
        Need::Turn(number) => {
            let (every, mine) = match () {
                () if least() => (4, 0),
                () if beside() => (2, 1),
                () if some_forms() => (2, 0),
                () => (1, 0),
            };
            (number % every != mine).then(|| format!("its turn on this driver ({SOME_FORMS}, {DRIVER_ONLY})"))
        }
        Need::EveryForm => {
            some_forms().then(|| format!("a driver that draws in every form: {SOME_FORMS} leaves it to another one"))
        }
        Need::Data(_) if std::env::var_os(DRIVER_ONLY).is_some() => {
            Some(format!("real volumes, which {DRIVER_ONLY} leaves to another driver"))
        }
        Need::AnyDriver => std::env::var_os(DRIVER_ONLY)
            .map(|_| format!("one driver, whichever it is: {DRIVER_ONLY} leaves it to another one")),
        Need::Data(file) => {
            let path = data(file);
            (!path.is_file()).then(|| format!("{}, which is not there", path.display()))
        }
    }
}
