//! Buffers, images and copies between them.

use std::sync::Arc;

use depthleap::vulkan::{
    Buffer, BufferInfo, CopyRegion, Device, Image, ImageInfo, ImageShape, Place, Scope, TexelBuffer, texel_bytes, vk,
};

use super::kit::{COPY_READ, COPY_WRITE, buffer, misuse, refused, run, uploaded};
use crate::harness::{Test, tests};

pub fn all() -> Vec<Test> {
    tests![
        buffer_holds_what_was_written,
        buffer_write_beyond_its_end_is_refused,
        buffer_on_the_device_is_out_of_reach,
        buffer_of_no_bytes_is_refused,
        buffer_beyond_the_limit_is_refused,
        texels_that_a_buffer_cannot_hold_are_refused,
        image_holds_what_was_uploaded,
        image_takes_a_region,
        depth_is_copied_to_the_bit,
        image_without_texels_is_refused,
        image_beyond_the_limit_is_refused,
        image_in_a_useless_format_is_refused,
        region_outside_is_refused,
        fill_in_parts_of_words_is_refused,
    ]
}

/// Bytes that differ from their neighbours.
fn pattern(count: u64) -> Vec<u8> {
    (0..count).map(|i| (i * 37 + i / 251) as u8).collect()
}

fn buffer_holds_what_was_written(device: &Arc<Device>) {
    let from = uploaded(device, "from", &pattern(100));
    from.write(96, &[1, 2, 3, 4]).unwrap();
    let middle = buffer(device, "middle", 100, Place::Device);
    let to = buffer(device, "to", 100, Place::Readback);
    run(device, "copy", |commands| {
        commands.copy_buffer(&from, 0, &middle, 0, 100);
        commands.buffer_barrier(&middle, COPY_WRITE, COPY_READ);
        commands.copy_buffer(&middle, 4, &to, 0, 96);
    });
    assert_eq!(to.read().unwrap()[..96], [&pattern(100)[4..96], &[1, 2, 3, 4]].concat());
    assert_eq!(to.bytes(), 100);
}

fn buffer_write_beyond_its_end_is_refused(device: &Arc<Device>) {
    let numbers = uploaded(device, "numbers", &[7; 16]);
    refused(numbers.write(13, &[0; 4]), &["numbers", "4 bytes at 13 do not fit into 16"]);
    refused(numbers.write(u64::MAX, &[0; 4]), &["numbers", "do not fit into 16"]);
    assert_eq!(numbers.read().unwrap(), [7; 16]);
    let other = buffer(device, "other", 16, Place::Readback);
    for (from, to) in [(1, 0), (0, 1), (u64::MAX, 0)] {
        let copied = misuse(device, |commands| commands.copy_buffer(&numbers, from, &other, to, 16));
        refused(copied, &["16 bytes at", "of 16"]);
    }
}

fn buffer_on_the_device_is_out_of_reach(device: &Arc<Device>) {
    let numbers = buffer(device, "numbers", 16, Place::Device);
    refused(numbers.write(0, &[0; 4]), &["numbers", "cannot reach"]);
    refused(numbers.read(), &["numbers", "cannot reach"]);
}

fn new_buffer(device: &Arc<Device>, size: u64, usage: vk::BufferUsageFlags) -> depthleap::Result<Buffer> {
    Buffer::new(device, BufferInfo { name: "wanted".to_owned(), size, usage, place: Place::Device })
}

fn buffer_of_no_bytes_is_refused(device: &Arc<Device>) {
    refused(new_buffer(device, 0, vk::BufferUsageFlags::STORAGE_BUFFER), &["wanted", "0 bytes"]);
    refused(new_buffer(device, 4, vk::BufferUsageFlags::empty()), &["wanted", "usage"]);
}

fn buffer_beyond_the_limit_is_refused(device: &Arc<Device>) {
    let limit = device.info.max_storage_buffer;
    let allowed = format!("allows {:.1} MiB in a storage buffer", limit as f64 / f64::from(1 << 20));
    refused(new_buffer(device, limit + 4, vk::BufferUsageFlags::STORAGE_BUFFER), &["wanted", &allowed]);
}

fn texels_that_a_buffer_cannot_hold_are_refused(device: &Arc<Device>) {
    let new = |size, format| {
        let usage = vk::BufferUsageFlags::empty();
        let info = BufferInfo { name: "wanted".to_owned(), size, usage, place: Place::Device };
        TexelBuffer::new(device, info, format).map(|texels| texels.buffer.bytes())
    };
    assert_eq!(new(48, vk::Format::R32G32B32A32_SFLOAT), Ok(48));
    refused(new(0, vk::Format::R32_UINT), &["wanted", "0 bytes"]);
    refused(new(20, vk::Format::R32G32B32A32_SFLOAT), &["wanted", "20 bytes are no texels"]);
    // More than any device numbers.
    refused(new(1 << 33, vk::Format::R8_UNORM), &["wanted", "8589934592 texels", &device.info.name]);
    refused(new(16, vk::Format::D32_SFLOAT), &[&device.info.name, "cannot read D32_SFLOAT from buffers"]);
}

fn new_image(
    device: &Arc<Device>,
    extent: [u32; 3],
    format: vk::Format,
    usage: vk::ImageUsageFlags,
) -> depthleap::Result<Image> {
    let shape = if extent[2] > 1 { ImageShape::Volume } else { ImageShape::Flat };
    Image::new(device, ImageInfo { name: "wanted".to_owned(), extent, format, usage, shape, shared: false })
}

/// Copied, and sampled, since an image that only is copied can have no view.
fn copied() -> vk::ImageUsageFlags {
    vk::ImageUsageFlags::TRANSFER_SRC | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::SAMPLED
}

const TO: vk::ImageLayout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
const FROM: vk::ImageLayout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;

/// The texels of an image that `bytes` were uploaded to.
fn there_and_back(device: &Arc<Device>, image: &Image, bytes: &[u8]) -> Vec<u8> {
    let from = uploaded(device, "from", bytes);
    let to = buffer(device, "to", image.bytes(), Place::Readback);
    run(device, "there and back", |commands| {
        commands.image_barrier(image, Scope::NONE, COPY_WRITE, vk::ImageLayout::UNDEFINED, TO);
        commands.copy_buffer_to_image(&from, image, CopyRegion::whole(image));
        commands.image_barrier(image, COPY_WRITE, COPY_READ, TO, FROM);
        commands.copy_image_to_buffer(image, &to, CopyRegion::whole(image));
    });
    to.read().unwrap()
}

fn image_holds_what_was_uploaded(device: &Arc<Device>) {
    for format in [vk::Format::R8_UNORM, vk::Format::R16_UNORM, vk::Format::R32_SFLOAT, vk::Format::R8G8B8A8_UNORM] {
        for extent in [[5, 3, 1], [5, 3, 7]] {
            let image = new_image(device, extent, format, copied()).unwrap();
            // Sides that are no multiple of anything: rows are packed tightly all the same.
            let bytes = u64::from(extent.iter().product::<u32>()) * texel_bytes(format).unwrap();
            assert_eq!(image.bytes(), bytes);
            assert_eq!(there_and_back(device, &image, &pattern(bytes)), pattern(bytes), "{format:?} {extent:?}");
        }
    }
}

fn image_takes_a_region(device: &Arc<Device>) {
    // Zeros, with 1 2 3 4 written to a square of 2 x 2 at (3, 1):  0 0 0 0 0
    //                                                              0 0 0 1 2
    //                                                              0 0 0 3 4
    let image = new_image(device, [5, 3, 1], vk::Format::R8_UNORM, copied()).unwrap();
    let square = uploaded(device, "square", &[9, 9, 9, 9, 1, 2, 3, 4]);
    let to = buffer(device, "to", 15, Place::Readback);
    let part = CopyRegion { buffer_offset: 4, image_offset: [3, 1, 0], extent: [2, 2, 1], row: 0 };
    run(device, "region", |commands| {
        let clear = Scope::new(vk::PipelineStageFlags2::CLEAR, vk::AccessFlags2::TRANSFER_WRITE);
        commands.image_barrier(&image, Scope::NONE, clear, vk::ImageLayout::UNDEFINED, TO);
        commands.clear_color(&image);
        commands.image_barrier(&image, clear, COPY_WRITE, TO, TO);
        commands.copy_buffer_to_image(&square, &image, part);
        commands.image_barrier(&image, COPY_WRITE, COPY_READ, TO, FROM);
        commands.copy_image_to_buffer(&image, &to, CopyRegion::whole(&image));
    });
    assert_eq!(to.read().unwrap(), [0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 0, 0, 0, 3, 4]);
}

fn depth_is_copied_to_the_bit(device: &Arc<Device>) {
    let image = new_image(device, [4, 2, 1], vk::Format::D32_SFLOAT, copied()).unwrap();
    let depths = [0.0, 1.0, 0.5, 0.1, 1.0 / 3.0, 0.25 + f32::EPSILON, 1.0 - f32::EPSILON, f32::MIN_POSITIVE];
    let bytes: Vec<u8> = depths.iter().flat_map(|depth: &f32| depth.to_ne_bytes()).collect();
    assert_eq!(there_and_back(device, &image, &bytes), bytes);
}

fn image_without_texels_is_refused(device: &Arc<Device>) {
    let format = vk::Format::R8_UNORM;
    refused(new_image(device, [4, 0, 1], format, copied()), &["wanted", "[4, 0, 1] texels"]);
    refused(new_image(device, [4, 4, 1], format, vk::ImageUsageFlags::empty()), &["wanted", "usage"]);
    let flat = ImageInfo {
        name: "flat".to_owned(),
        extent: [4, 4, 2],
        format,
        usage: copied(),
        shape: ImageShape::Flat,
        shared: false,
    };
    refused(Image::new(device, flat), &["flat", "[4, 4, 2] texels"]);
}

fn image_beyond_the_limit_is_refused(device: &Arc<Device>) {
    let format = vk::Format::R8_UNORM;
    let limit = device.info.max_image_2d;
    let allowed = format!("{} allows {limit} a side", device.info.name);
    refused(new_image(device, [limit + 1, 1, 1], format, copied()), &["wanted", &allowed, "viewport"]);
    refused(new_image(device, [1, u32::MAX, 1], format, copied()), &["wanted", &allowed]);
    let limit = device.info.max_image_3d;
    let allowed = format!("{} allows {limit} a side", device.info.name);
    refused(new_image(device, [1, 1, limit + 1], format, copied()), &["wanted", &allowed, "volume"]);
}

fn image_in_a_useless_format_is_refused(device: &Arc<Device>) {
    // No device takes depth for a colour attachment.
    let image = new_image(device, [4, 4, 1], vk::Format::D32_SFLOAT, vk::ImageUsageFlags::COLOR_ATTACHMENT);
    refused(image, &["wanted", "D32_SFLOAT", "COLOR_ATTACHMENT"]);
    refused(new_image(device, [4, 4, 1], vk::Format::BC1_RGB_UNORM_BLOCK, copied()), &["wanted", "no known size"]);
}

fn region_outside_is_refused(device: &Arc<Device>) {
    let image = new_image(device, [5, 3, 1], vk::Format::R16_UNORM, copied()).unwrap();
    let texels = uploaded(device, "texels", &[0; 30]);
    let copy = |image_offset, extent, buffer_offset| {
        let region = CopyRegion { buffer_offset, image_offset, extent, row: 0 };
        misuse(device, |commands| commands.copy_buffer_to_image(&texels, &image, region))
    };
    refused(copy([1, 0, 0], [5, 3, 1], 0), &["wanted", "of [5, 3, 1] texels"]);
    refused(copy([u32::MAX, 0, 0], [5, 3, 1], 0), &["wanted", "of [5, 3, 1] texels"]);
    refused(copy([0; 3], [5, 0, 1], 0), &["wanted", "of [5, 3, 1] texels"]);
    refused(copy([0; 3], [5, 3, 1], 2), &["texels", "30 bytes at 2 of 30"]);
}

fn fill_in_parts_of_words_is_refused(device: &Arc<Device>) {
    let numbers = buffer(device, "numbers", 16, Place::Device);
    for (offset, size) in [(2, 4), (0, 6)] {
        let filled = misuse(device, |commands| commands.fill_buffer(&numbers, offset, size, 0));
        refused(filled, &["numbers", "whole words"]);
    }
}
