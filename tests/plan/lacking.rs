//! Scenes that each lack one thing a frame may have.

use depthleap::method;
use depthleap::part::Group;
use depthleap::part::resource::Resource;
use depthleap::resource;
use depthleap::scene::Settings;

/// What a plan has less for it.
#[derive(Clone, Copy, Debug)]
pub enum Less {
    Resource(Resource),
    Group(Group),
    Passes,
    Pixels,
    Everything,
}

/// A scene that needs all of near-neighbor skipping: colours, empty space, rays that end.
pub fn settings(change: impl Fn(&mut Settings)) -> Settings {
    let mut settings = Settings::default();
    settings.volume.builtin = Some("shells:32".to_owned());
    settings.transfer.points =
        Some(vec![[0.0, 0.2, 0.4, 1.0, 0.0], [0.25, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.5]]);
    settings.image.size = [61, 49];
    settings.camera.eye = [0.8974, 0.6533, 1.5544];
    settings.sampling.samples_per_pass = 4;
    settings.sampling.termination = 0.9;
    change(&mut settings);
    if settings.transfer.preset.is_some() {
        settings.transfer.points = None;
    }
    settings
}

type Change = fn(&mut Settings);

fn preset(s: &mut Settings, name: &str) {
    s.transfer.preset = Some(name.to_owned());
}

/// More points than few, without colours: where there are few, colours or none are as many bytes.
fn greys(s: &mut Settings) {
    let point = |i: u32| {
        let x = f64::from(i) / 19.0;
        [x, x, x, x, if x < 0.25 { 0.0 } else { 0.5 * x }]
    };
    s.transfer.points = Some((0..20).map(point).collect());
}

pub const SCENES: [(&str, Change, Less); 20] = [
    ("no colours", greys, Less::Resource(resource::TRANSFER)),
    (
        "no colours, fused",
        |s| (greys(s), s.method.name = method::NN_OMNI_FUSED.name()).1,
        Less::Resource(resource::TRANSFER),
    ),
    (
        "no colours, without skipping",
        |s| (greys(s), s.method.name = method::RC.name()).1,
        Less::Resource(resource::TRANSFER),
    ),
    (
        "nothing to skip",
        |s| s.transfer.points = Some(vec![[0.5, 0.9, 0.5, 0.1, 0.3]]),
        Less::Resource(resource::NEAREST_DISTANCE),
    ),
    (
        "nothing to skip, fused",
        |s| {
            s.method.name = method::NN_OMNI_FUSED.name();
            s.transfer.points = Some(vec![[0.5, 0.9, 0.5, 0.1, 0.3]]);
        },
        Less::Resource(resource::NEAREST_DISTANCE),
    ),
    (
        "nothing to skip, octants",
        |s| {
            s.method.name = method::NN_DIRECTIONAL.name();
            s.transfer.points = Some(vec![[0.5, 0.9, 0.5, 0.1, 0.3]]);
        },
        Less::Resource(resource::NEAREST_DISTANCE),
    ),
    (
        "no empty blocks",
        |s| {
            s.method.name = method::RC_BLOCK.name();
            s.transfer.points = Some(vec![[0.5, 0.9, 0.5, 0.1, 0.3]]);
        },
        Less::Resource(resource::block_ranges()),
    ),
    ("nothing to skip and no ray that ends", |s| preset(s, "haze"), Less::Group(Group::Intermediate)),
    (
        "nothing to skip and no ray that ends, fused",
        |s| (preset(s, "haze"), s.method.name = method::NN_OMNI_FUSED.name()).1,
        Less::Group(Group::Intermediate),
    ),
    (
        "nothing to skip and no ray that ends, blocks",
        |s| (preset(s, "haze"), s.method.name = method::RC_BLOCK.name()).1,
        Less::Group(Group::Intermediate),
    ),
    (
        "no ray that ends",
        |s| (s.method.name = method::RC_ERT.name(), s.sampling.termination = 1.0).1,
        Less::Resource(resource::STORED),
    ),
    (
        "no opacity to end a ray",
        |s| {
            s.method.name = method::RC_ERT.name();
            s.transfer.points = Some(vec![[0.0, 0.2, 0.4, 1.0, 0.0], [1.0, 1.0, 0.5, 0.1, 0.01]]);
        },
        Less::Group(Group::Intermediate),
    ),
    ("long rays", |s| s.camera.eye = [0.0, 0.0, 3.0], Less::Passes),
    ("far away", |s| s.camera.eye = [3.0, 2.5, 8.0], Less::Pixels),
    ("a corner of the box", |s| s.camera.target = [-0.75, -0.75, 0.0], Less::Pixels),
    (
        "a corner of the box, fused",
        |s| {
            s.method.name = method::NN_OMNI_FUSED.name();
            s.camera.target = [-0.75, -0.75, 0.0];
        },
        Less::Pixels,
    ),
    (
        "a flat volume",
        |s| {
            s.volume.builtin = Some("shells:32x32x2".to_owned());
            s.camera.eye = [0.0, 1.9, 0.4];
        },
        Less::Pixels,
    ),
    (
        "a narrow picture of a far volume",
        |s| {
            s.image.size = [8, 96];
            s.camera.eye = [0.0, 0.0, 6.0];
        },
        Less::Pixels,
    ),
    ("nothing in sight", |s| s.camera.target = [0.0, 0.0, 9.0], Less::Everything),
    ("nothing in front", |s| (s.camera.eye, s.camera.target) = ([0.0, 0.0, -3.0], [0.0, 0.0, -9.0]), Less::Everything),
];
