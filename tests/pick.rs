//! Which device is used; needs none.

use depthleap::vulkan::{DeviceInfo, DeviceKind, pick, vk};

fn device(index: usize, name: &str, kind: DeviceKind, unusable: Option<&str>) -> DeviceInfo {
    DeviceInfo {
        index,
        name: name.to_owned(),
        kind,
        api_version: "1.3.0".to_owned(),
        driver_name: String::new(),
        driver_info: String::new(),
        driver_version: String::new(),
        depth_bounds: false,
        occlusion_precise: false,
        pipeline_statistics: false,
        conditional_rendering: false,
        timestamp_period: 1.0,
        timestamp_valid_bits: 0,
        queue_families: Vec::new(),
        max_image_3d: 1,
        max_image_2d: 1,
        max_viewport: [1; 2],
        sub_pixel_bits: 8,
        max_storage_buffer: 1,
        max_texel_buffer: 1,
        max_vertex_number: 1,
        memory_bytes: 1,
        unusable: unusable.map(str::to_owned),
        physical: vk::PhysicalDevice::null(),
    }
}

/// One of each kind, the best of them out of use, two alike.
fn desk() -> Vec<DeviceInfo> {
    vec![
        device(0, "llvmpipe", DeviceKind::Cpu, None),
        device(1, "Arc A380", DeviceKind::Integrated, None),
        device(2, "GeForce 6800", DeviceKind::Discrete, Some("speaks Vulkan 1.0, 1.3 is needed")),
        device(3, "GeForce 4090", DeviceKind::Discrete, None),
        device(4, "GeForce 4090", DeviceKind::Discrete, None),
    ]
}

#[track_caller]
fn picked(wanted: Option<&str>) -> (usize, String) {
    let (info, reason) = pick(&desk(), wanted).unwrap();
    (info.index, reason)
}

#[track_caller]
fn refused(devices: &[DeviceInfo], wanted: Option<&str>, parts: &[&str]) {
    let text = pick(devices, wanted).unwrap_err().to_string();
    for part in parts {
        assert!(text.contains(part), "{part:?} is missing in: {text}");
    }
}

#[test]
fn first_usable_device_of_the_best_kind_is_picked() {
    assert_eq!(picked(None), (3, "the first discrete device of 4 usable ones".to_owned()));
    let (info, reason) = pick(&desk()[..1], None).unwrap();
    assert_eq!((info.index, reason.as_str()), (0, "the only usable device"));
}

#[test]
fn index_picks_that_device() {
    assert_eq!(picked(Some("1")), (1, "index 1 was asked for".to_owned()));
    assert_eq!(picked(Some(" 4 ")).0, 4);
}

#[test]
fn part_of_the_name_picks_in_any_case() {
    assert_eq!(picked(Some("LLVM")), (0, "its name contains \"LLVM\"".to_owned()));
    assert_eq!(picked(Some(" arc a380 ")), (1, "that is its name".to_owned()));
}

#[test]
fn a_number_is_an_index_and_nothing_else() {
    refused(&desk(), Some("4090"), &["no device has that index", "0 llvmpipe"]);
    refused(&desk()[1..2], Some("3"), &["no device has that index", "1 Arc A380"]);
    refused(&desk(), Some("99999999999999999999999"), &["no device has that index"]);
}

#[test]
fn a_name_that_fits_several_devices_is_refused() {
    refused(&desk(), Some("geforce"), &["3 devices have that in their name", "3 GeForce 4090", "by its index"]);
    // Two have the whole name.
    refused(&desk(), Some("GeForce 4090"), &["2 devices have that in their name"]);
}

#[test]
fn refusal_lists_what_is_there_and_why_it_is_out() {
    let list = ["0 llvmpipe", "1 Arc A380", "2 GeForce 6800 (unusable: speaks Vulkan 1.0, 1.3 is needed)"];
    refused(&desk(), Some("Radeon"), &[&list[..], &["device \"Radeon\"", "no device has that name"]].concat());
    refused(&desk(), Some("2"), &[&list[..], &["that device cannot be used", "choose another"]].concat());
    refused(&desk(), Some("force 6800"), &["that device cannot be used"]);
    refused(&desk(), Some("  "), &["no device has that name"]);
    refused(&desk()[2..3], None, &["no usable device", "install a Vulkan 1.3 driver"]);
    refused(&[], None, &["no device found", "install a driver"]);
}
