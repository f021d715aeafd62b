//! Names, and that validation sees mistakes: each is made on an instance of its own, whose messages are not the
//! harness's.

use std::sync::Arc;

use depthleap::vulkan::{Commands, Device, Place};

use super::kit::{FILL, buffer, misuse, refused, run};
use crate::harness::{Test, closed, judged, open, tests};

pub fn all() -> Vec<Test> {
    tests![
        missing_barrier_is_seen_and_names_the_buffer,
        harness_fails_a_test_that_brings_a_message,
        harness_passes_a_test_that_brings_none,
        objects_left_behind_are_seen,
        errors_name_the_object,
        names_with_zero_bytes_are_cut,
    ]
}

/// Two fills of one buffer: the second has to wait for the first.
fn fill_twice(device: &Arc<Device>, with_barrier: bool) {
    let numbers = buffer(device, "filled twice", 64, Place::Device);
    run(device, "fill twice", |commands| {
        commands.fill_buffer(&numbers, 0, 64, 1);
        if with_barrier {
            commands.buffer_barrier(&numbers, FILL, FILL);
        }
        commands.fill_buffer(&numbers, 0, 64, 2);
    });
}

fn missing_barrier_is_seen_and_names_the_buffer(_: &Arc<Device>) {
    let device = open(false).unwrap();
    fill_twice(&device, true);
    assert_eq!(device.instance().messages(), [""; 0]);
    fill_twice(&device, false);
    let messages = device.instance().messages();
    assert!(messages.iter().any(|m| m.contains("WRITE-AFTER-WRITE") && m.contains("filled twice")), "{messages:?}");
}

fn harness_fails_a_test_that_brings_a_message(_: &Arc<Device>) {
    let device = open(false).unwrap();
    let failed = judged(&device, |device| {
        fill_twice(device, false);
        Ok(())
    });
    let text = failed.err().and_then(|failed| failed.message().map(str::to_owned)).unwrap_or_default();
    assert!(text.contains("WRITE-AFTER-WRITE"), "{text:?}");
}

fn harness_passes_a_test_that_brings_none(_: &Arc<Device>) {
    let device = open(false).unwrap();
    fill_twice(&device, false);
    let passed = judged(&device, |device| {
        fill_twice(device, true);
        Ok(())
    });
    assert!(passed.is_ok(), "messages from before the test count");
}

fn objects_left_behind_are_seen(_: &Arc<Device>) {
    let device = open(false).unwrap();
    assert_eq!(closed(device), [""; 0]);
    // Objects of this layer keep their device, so that only a raw handle can be left behind.
    let device = open(false).unwrap();
    // SAFETY: the description is complete, and nothing uses the handle.
    let left = unsafe { device.raw.create_fence(&Default::default(), None) };
    assert!(left.is_ok());
    let said = closed(device);
    assert!(said.iter().any(|message| message.contains("VkFence")), "{said:?}");
}

fn errors_name_the_object(device: &Arc<Device>) {
    let numbers = buffer(device, "named buffer", 4, Place::Device);
    refused(numbers.write(0, &[0; 4]), &["named buffer", "Device"]);
    refused(misuse(device, |commands| commands.fill_buffer(&numbers, 0, 8, 0)), &["named buffer"]);
}

fn names_with_zero_bytes_are_cut(device: &Arc<Device>) {
    let name = "before\0after";
    buffer(device, name, 4, Place::Device);
    let mut commands = Commands::begin(device, &device.graphics, name).unwrap();
    commands.label_begin(name);
    commands.label_end();
    commands.finish().unwrap();
}
