//! What is larger than a device allows is refused with its limit.

use std::sync::Arc;

use depthleap::vulkan::Device;

use super::program::Place;
use crate::harness::{Need, Test, share, test};

pub fn tests() -> Vec<Test> {
    vec![
        test("volume beyond the device's limit is refused", volume_beyond_the_limit).needs(Need::Thoroughness),
        test("clip volume beyond the device's limit is refused", clip_volume_beyond_the_limit),
        test("viewport beyond the device's limit is refused", viewport_beyond_the_limit),
    ]
}

fn volume_beyond_the_limit(device: &Arc<Device>) {
    let place = Place::new();
    let side = device.info.max_image_3d + 1;
    place.file("a.raw", vec![7; side as usize]);
    let (size, limit) = (format!("[1, 1, {side}]"), format!("at most {} a side", device.info.max_image_3d));
    let arguments = format!("a.raw --dims 1,1,{side} --type u8 --spacing 1000,1000,1 --azimuth 70 --viewport 24x18");
    place.refused(
        &format!("render {arguments} -o a.png"),
        4,
        &["a.raw", &size, &device.info.name, &limit, "smaller volume"],
    );
    // The second of two scenes is found wrong before the first is run.
    place.file(
        "a.toml",
        format!("[volume]\npath = \"a.raw\"\ndims = [1, 1, {side}]\ntype = \"u8\"\nspacing = [1000, 1000, 1]"),
    );
    place.refused("bench builtin:shells:16 a.toml --azimuth 70 -o out", 4, &["a.raw", &limit]);
    place.done(&format!("render {arguments} --method cpu -o a.npy"));
}

fn clip_volume_beyond_the_limit(device: &Arc<Device>) {
    let place = Place::new();
    let side = device.info.max_image_3d + 1;
    let mut file =
        format!("NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1 1 {side}\nspacings: 1000 1000 1\nencoding: raw\n\n")
            .into_bytes();
    file.extend((0..side).map(|i| i as u8));
    place.file("cut.nrrd", file);
    place.file("a.toml", "[volume]\nbuiltin = \"shells:12\"\n[[clip]]\nvolume = \"cut.nrrd\"\niso = 100\n");
    let limit = format!("at most {} a side", device.info.max_image_3d);
    place.refused(
        "render a.toml --method single-pass --viewport 12x8 -o a.png",
        4,
        &["cut.nrrd", &format!("[1, 1, {side}]"), &device.info.name, &limit, "smaller clip volume"],
    );
    assert!(!place.path().join("a.png").exists());
}

fn viewport_beyond_the_limit(device: &Arc<Device>) {
    let place = Place::new();
    let limit = device.info.max_viewport[0].min(device.info.max_image_2d);
    let sizes = [format!("{}x1", limit + 1), "40000x40000".to_owned(), "65535x65535".to_owned()];
    for size in share(sizes, 0) {
        let parts = [&format!("--viewport) {size}"), &device.info.name, &format!("at most {limit}x")];
        place.refused(&format!("render --viewport {size} -o a.png"), 4, &parts.map(String::as_str));
    }
}
