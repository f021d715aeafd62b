//! Frame time against the number of depth layers [Thesis ch. 6]: the volume is drawn once a layer, and what that costs depends on
//! whether rays that have nothing to do behind a layer are skipped.
//!
//! CPU time of the process, as in the bench `frame`, and the fragments. Methods take turns. Needs a device.

use depthleap::frame::self_check;
use depthleap::measure::runner::{Effort, Runner};
use depthleap::measure::{Checked, CostSource};
use depthleap::method;
use depthleap::read;
use depthleap::scene::Camera;
use depthleap::scene::settings::{MeshSettings, MethodName, MethodSettings, PartialSegments, Settings};
use depthleap::vulkan::{Device, Instance, pick};

/// Azimuth, elevation (degrees) and distance of the rotated view.
const VIEW: [f64; 3] = [30.0, 20.0, 1.91];
const METHODS: [MethodName; 3] = [method::RC_ERT.name(), method::NN_OMNI.name(), method::NN_OPTIMAL.name()];
/// Where segments that end at a surface are drawn [Thesis ch. 6 §2.2, §7].
const PLACES: [PartialSegments; 2] = [PartialSegments::Within, PartialSegments::Apart];
const EFFORT: Effort = Effort { warmups: 2, repeats: 9, reference: false };
/// A sphere has two layers.
const SPHERES: u32 = 4;

fn main() -> depthleap::Result<()> {
    let instance = Instance::new(false)?;
    let (info, _) = pick(&instance.devices()?, None)?;
    println!("{}, {} {}; shells:128, {SPHERES} spheres in each other", info.name, info.driver_name, info.driver_info);
    let device = Device::new(&instance, &info, false)?;
    let checked = Checked { check: self_check(&device)?, device, early_end: None, costs: CostSource::Fitted };
    println!(
        "{:>6}  {:<7} {:<12} {:>20} {:>7} {:>12} {:>14}",
        "layers", "partial", "method", "CPU ms (MAD)", "to none", "main", "intermediate"
    );
    let mut none = [f64::NAN; METHODS.len()];
    // Without a layer nothing ends at a surface.
    let cases = (0..=2 * SPHERES).flat_map(|layers| PLACES.map(|place| (layers, place)));
    for (layers, place) in cases.filter(|(layers, place)| *layers > 0 || *place == PartialSegments::Within) {
        let methods = METHODS.map(|name| MethodSettings { name, ..MethodSettings::default() });
        let mut runner = Runner::new(Some(&checked), read::scene(&scene(layers, place))?, "shells:128".to_owned());
        for (i, one) in runner.measure(&methods, EFFORT, &|_| {})?.into_iter().enumerate() {
            let run = &one.run;
            let cpu = run.host.cpu.map_or(f64::NAN, |time| time.value);
            let mad = run.host.cpu.and_then(|time| time.stats).map_or(f64::NAN, |stats| stats.mad);
            if layers == 0 {
                none[i] = cpu;
            }
            println!(
                "{layers:>6}  {:<7} {:<12} {cpu:>12.1} ({mad:>5.1}) {:>7.2} {:>12} {:>14}",
                format!("{place:?}").to_lowercase(),
                run.method,
                cpu / none[i],
                run.fragments.main,
                run.fragments.intermediate
            );
        }
    }
    Ok(())
}

/// Transparent spheres, of which the nearest `layers` surfaces are drawn; none of them for 0.
fn scene(layers: u32, place: PartialSegments) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:128".to_owned());
    let [azimuth, elevation, distance] = VIEW;
    settings.camera.eye = Camera::orbit(azimuth, elevation, distance, settings.camera.fov_y).eye.to_array();
    if layers > 0 {
        (settings.layers.most, settings.layers.partial) = (layers, place);
        settings.meshes = (1..=SPHERES)
            .map(|i| MeshSettings {
                builtin: Some("sphere".to_owned()),
                opacity: 0.1,
                scale: 0.2 * f64::from(i),
                ..MeshSettings::default()
            })
            .collect();
    }
    settings
}
