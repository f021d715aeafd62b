//! Random settings: written and read again they are the same to the last bit, and whatever can be planned has numbers that
//! single precision can hold.

mod random;

use depthleap::method;
use depthleap::plan;
use depthleap::read;
use depthleap::scene::range::RangeEnd;
use depthleap::scene::settings::{Accumulate, Alpha, CELLS, Filter, Last, Offset, Settings, VolumeTexture};
use depthleap::scene::volume::Voxels;
use depthleap::scene::{Volume, field::NanPolicy};
use depthleap::shared::Frame;
use random::Random;

/// Scenes that each test makes.
const SCENES: usize = 100_000;

struct Source(Random);

impl Source {
    fn below(&mut self, end: usize) -> usize {
        (self.0.next() * end as f64) as usize
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// A number of any size and sign, now and then one of the ends of what there is.
    fn wild(&mut self) -> f64 {
        match self.below(8) {
            0 => self.pick(&[0.0, -0.0, 1.0, 1e-300, 5e-324, f64::MAX, f64::MIN, 1e30, f64::from(f32::MAX)]),
            1 => 10f64.powf(600.0 * self.0.next() - 300.0) * if self.below(2) == 0 { 1.0 } else { -1.0 },
            _ => 4.0 * self.0.next() - 2.0,
        }
    }

    fn three(&mut self) -> [f64; 3] {
        [self.wild(), self.wild(), self.wild()]
    }

    /// From `low` to `high`, evenly over the digits.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        (low.ln() + (high.ln() - low.ln()) * self.0.next()).exp()
    }

    fn settings(&mut self) -> Settings {
        let mut s = Settings::default();
        let range = [self.wild(), self.wild()];
        s.volume.range = match self.below(3) {
            0 => None,
            1 => Some([range[0].min(range[1]), range[0].max(range[1])].map(RangeEnd::Value)),
            _ => Some([RangeEnd::Percentile(50.0 * self.0.next()), RangeEnd::Percentile(50.0 + 50.0 * self.0.next())]),
        };
        s.volume.nan = self.pick(&[NanPolicy::Replace, NanPolicy::Hole]);
        s.volume.no_data = (0..self.below(3)).map(|_| self.wild()).collect();
        s.volume.texture = self.pick(&[VolumeTexture::Auto, VolumeTexture::Native, VolumeTexture::R16]);
        s.volume.precision = self.between(1e-9, 1.0);
        let mut x = self.wild().min(1e20);
        let points = (0..1 + self.below(6)).map(|_| {
            x += self.0.next();
            [x, self.0.next(), self.0.next(), self.0.next(), self.0.next()]
        });
        s.transfer.points = Some(points.collect());
        s.transfer.reference = self.between(1e-6, 1e6);
        (s.camera.eye, s.camera.target, s.camera.up) = (self.three(), self.three(), self.three());
        s.camera.fov_y = if self.below(2) == 0 { 180.0 * self.0.next() } else { self.between(1e-300, 179.999_999_999) };
        s.image.size = [1 + self.below(40) as u32, 1 + self.below(40) as u32];
        s.image.background = [self.0.next(), self.0.next(), self.0.next()];
        s.image.accumulate = self.pick(&[Accumulate::Rgba32f, Accumulate::Rgba16f, Accumulate::Rgba8]);
        s.sampling.step = self.between(1e-2, 1e6);
        s.sampling.offset = self.pick(&[Offset::Left, Offset::Midpoint]);
        s.sampling.last = self.pick(&[Last::Full, Last::Partial]);
        s.sampling.alpha = self.pick(&[Alpha::Exponential, Alpha::Paper]);
        s.sampling.filter = self.pick(&[Filter::Hardware, Filter::Exact, Filter::Nearest]);
        s.sampling.samples_per_pass = 1 + self.below(64) as u32;
        s.sampling.passes = self.pick(&[0, 0, 0, 1, 7]);
        s.sampling.termination = self.0.next();
        s.method.name = self.pick(&method::METHODS.map(|method| method.name()));
        s.method.cell = self.pick(&CELLS);
        s.method.cone = self.between(0.01, 60.0);
        s
    }
}

#[test]
fn settings_are_read_from_json_as_they_were_written() {
    let mut source = Source(Random(11));
    for _ in 0..SCENES {
        let settings = source.settings();
        let text = serde_json::to_string(&settings).unwrap();
        let read: Settings = serde_json::from_str(&text).unwrap_or_else(|e| panic!("{e}: {text}"));
        assert_eq!(format!("{read:?}"), format!("{settings:?}"), "{text}");
    }
}

#[test]
fn settings_are_read_from_scene_files_as_they_were_written() {
    let mut source = Source(Random(12));
    for _ in 0..SCENES / 20 {
        let settings = source.settings();
        let text = toml::to_string(&settings).unwrap();
        let read: Settings = toml::from_str(&text).unwrap_or_else(|e| panic!("{e}: {text}"));
        assert_eq!(format!("{read:?}"), format!("{settings:?}"), "{text}");
    }
}

#[test]
fn what_can_be_planned_has_numbers_of_single_precision() {
    let mut source = Source(Random(13));
    let (mut planned, mut beyond) = (0, 0);
    for _ in 0..SCENES {
        let settings = source.settings();
        let spacing = [0; 3].map(|_| if source.below(8) == 0 { source.between(1e-30, 1e30) } else { 1.0 });
        let voxels = (0..8).map(|_| source.wild() as f32).collect();
        let Ok(volume) = Volume::new("random", [2; 3], spacing, Voxels::F32(voxels)) else { continue };
        let Ok(scene) = read::scene_of(&settings, |_| Ok(volume)) else { continue };
        let plan = plan::form(&scene, method::papers_form(settings.method.name)).and_then(|f| plan::plan(&scene, f));
        let plan = match plan {
            Ok(plan) => plan,
            Err(error) => {
                beyond += usize::from(error.to_string().contains("single precision"));
                continue;
            }
        };
        planned += 1;
        let corners = plan.view.front.iter().chain(&plan.view.back).flatten();
        assert!(corners.into_iter().all(|c| c.is_finite()), "{settings:?}");
        let region = plan.view.region;
        let frame = Frame::new(&scene, &plan.view.rays, plan.passes, [region.x, region.y]);
        let numbers: &[f32] = bytemuck::cast_slice(std::slice::from_ref(&frame.origin));
        let others = [frame.base, frame.right, frame.down, frame.extent, frame.inverse_extent, frame.voxel_step];
        let all = numbers.iter().chain(others.as_flattened().as_flattened());
        let single =
            [frame.near, frame.inverse_step, frame.offset, frame.termination, frame.exponent, frame.step_voxels];
        assert!(all.chain(&single).all(|n| n.is_finite()), "{settings:?}: {frame:?}");
        assert!(plan.pixel_error >= 0.0 && !plan::warnings(&scene, &plan).iter().any(String::is_empty));
    }
    assert!(planned > SCENES / 10, "only {planned} scenes were planned");
    assert!(beyond > SCENES / 1000, "only {beyond} scenes were beyond single precision");
}
