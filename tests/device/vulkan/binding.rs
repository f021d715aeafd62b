//! Descriptor sets, layouts, push constants, specialization constants.

use std::sync::Arc;

use depthleap::glsl;
use depthleap::vulkan::{
    Bound, Buffer, ComputePipeline, CopyRegion, DescriptorSet, Device, Image, ImageInfo, ImageShape, Place, Sampler,
    Scope, ShaderModule, vk,
};

use super::canvas::Canvas;
use super::kit::{COMPUTE, COPY_READ, COPY_WRITE, buffer, misuse, refused, run, uploaded, words};
use crate::harness::{Test, tests};
use crate::shader::shader;

pub fn all() -> Vec<Test> {
    tests![
        missing_binding_is_refused_by_name,
        binding_of_another_kind_is_refused_by_name,
        array_takes_its_resources_in_order,
        names_that_shaders_do_not_have_are_ignored,
        set_of_another_layout_is_refused,
        stages_that_contradict_each_other_are_refused,
        second_descriptor_set_is_refused,
        shader_of_the_wrong_stage_is_refused,
        unknown_constant_is_refused,
        constant_is_specialized,
        too_few_push_constants_are_refused,
        padding_after_push_constants_is_left_out,
    ]
}

fn counter(device: &Arc<Device>, constants: &[(&str, u32)]) -> ComputePipeline {
    ComputePipeline::new(device, "counter", &shader("vulkan/count.comp"), constants).unwrap()
}

fn bound(device: &Arc<Device>, pipeline: &ComputePipeline, numbers: &Buffer) -> DescriptorSet {
    let resources = [("numbers", Bound::Storage(numbers))];
    DescriptorSet::new(device, "numbers of counter", &pipeline.layout, &resources).unwrap()
}

/// A texture of one texel.
fn texel(device: &Arc<Device>, name: &str, value: f32) -> Image {
    let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
    let (format, extent) = (vk::Format::R32_SFLOAT, [1; 3]);
    let image = Image::new(
        device,
        ImageInfo { name: name.to_owned(), extent, format, usage, shape: ImageShape::Flat, shared: false },
    )
    .unwrap();
    let bytes = uploaded(device, "texel", &value.to_ne_bytes());
    let (to, read) = (vk::ImageLayout::TRANSFER_DST_OPTIMAL, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
    run(device, "texel", |commands| {
        commands.image_barrier(&image, Scope::NONE, COPY_WRITE, vk::ImageLayout::UNDEFINED, to);
        commands.copy_buffer_to_image(&bytes, &image, CopyRegion::whole(&image));
        commands.image_barrier(&image, COPY_WRITE, COMPUTE, to, read);
    });
    image
}

fn missing_binding_is_refused_by_name(device: &Arc<Device>) {
    let pipeline = counter(device, &[]);
    let other = buffer(device, "other", 4, Place::Device);
    let set = DescriptorSet::new(device, "set of counter", &pipeline.layout, &[("others", Bound::Storage(&other))]);
    refused(set, &["set of counter", "numbers takes 1 resources, 0 of that name are given", "others"]);
    let twice = [("numbers", Bound::Storage(&other)); 2];
    let set = DescriptorSet::new(device, "set of counter", &pipeline.layout, &twice);
    refused(set, &["set of counter", "numbers takes 1 resources, 2 of that name are given"]);
}

fn binding_of_another_kind_is_refused_by_name(device: &Arc<Device>) {
    let pipeline = counter(device, &[]);
    let image = texel(device, "image", 1.0);
    let sampler = Sampler::new(device, "nearest", false).unwrap();
    let sampled = Bound::Sampled(&image, &sampler, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
    let set = DescriptorSet::new(device, "set of counter", &pipeline.layout, &[("numbers", sampled)]);
    refused(set, &["set of counter", "numbers is STORAGE_BUFFER, COMBINED_IMAGE_SAMPLER is given"]);
    let numbers = buffer(device, "numbers", 4, Place::Device);
    let uniform = [("numbers", Bound::Uniform(&numbers))];
    let set = DescriptorSet::new(device, "set of counter", &pipeline.layout, &uniform);
    refused(set, &["set of counter", "numbers is STORAGE_BUFFER, UNIFORM_BUFFER is given"]);
}

fn array_takes_its_resources_in_order(device: &Arc<Device>) {
    let pipeline = ComputePipeline::new(device, "summer", &shader("vulkan/textures.comp"), &[]).unwrap();
    let (two, three) = (texel(device, "two", 2.0), texel(device, "three", 3.0));
    let sampler = Sampler::new(device, "nearest", false).unwrap();
    let total = buffer(device, "total", 4, Place::Readback);
    let read = |image| Bound::Sampled(image, &sampler, vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL);
    let sum = ("total", Bound::Storage(&total));
    let resources = [("textures", read(&two)), sum, ("textures", read(&three))];
    let set = DescriptorSet::new(device, "set of summer", &pipeline.layout, &resources).unwrap();
    run(device, "sum", |commands| {
        commands.bind_compute(&pipeline, &set);
        commands.dispatch([1; 3]);
    });
    assert_eq!(f32::from_bits(words(&total.read().unwrap())[0]), 2.0 + 10.0 * 3.0);
    let set = DescriptorSet::new(device, "set of summer", &pipeline.layout, &[sum, ("textures", read(&two))]);
    refused(set, &["textures takes 2 resources, 1 of that name are given"]);
}

fn names_that_shaders_do_not_have_are_ignored(device: &Arc<Device>) {
    let pipeline = counter(device, &[]);
    let numbers = buffer(device, "numbers", 4, Place::Device);
    let resources = [("numbers", Bound::Storage(&numbers)), ("others", Bound::Storage(&numbers))];
    DescriptorSet::new(device, "set of counter", &pipeline.layout, &resources).unwrap();
}

fn set_of_another_layout_is_refused(device: &Arc<Device>) {
    let pipeline = counter(device, &[]);
    let range = cell_range();
    let other = ComputePipeline::new(device, "cell_range", &range, &[]).unwrap();
    let numbers = buffer(device, "numbers", 4, Place::Device);
    let set = bound(device, &pipeline, &numbers);
    refused(misuse(device, |commands| commands.bind_compute(&other, &set)), &["cell_range", "numbers of counter"]);
}

/// A shader of the program.
fn cell_range() -> ShaderModule {
    let shader = glsl::Shader::new("structure/cell_range.comp", []);
    ShaderModule::new(shader.file, &glsl::module(&shader).unwrap()).unwrap()
}

fn stages_that_contradict_each_other_are_refused(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [4, 4]);
    let made = canvas.pipeline_of(device, &shader("vulkan/numbers.vert"), &shader("vulkan/numbers.frag"));
    refused(made, &["numbers.frag declares numbers (COMBINED_IMAGE_SAMPLER x 1)", "numbers (STORAGE_BUFFER x 1)"]);
}

fn second_descriptor_set_is_refused(device: &Arc<Device>) {
    let made = ComputePipeline::new(device, "second", &shader("vulkan/second_set.comp"), &[]);
    refused(made, &["second", "numbers of vulkan/second_set.comp is in set 1"]);
}

fn shader_of_the_wrong_stage_is_refused(device: &Arc<Device>) {
    let canvas = Canvas::new(device, [4, 4]);
    let (compute, fragment) = (shader("vulkan/count.comp"), shader("vulkan/color.frag"));
    let made = canvas.pipeline_of(device, &compute, &fragment);
    refused(made, &["count.comp is a COMPUTE shader in the place of VERTEX"]);
    let made = ComputePipeline::new(device, "drawn", &fragment, &[]);
    refused(made, &["drawn", "color.frag is a FRAGMENT shader in the place of COMPUTE"]);
}

fn unknown_constant_is_refused(device: &Arc<Device>) {
    let made = ComputePipeline::new(device, "counter", &shader("vulkan/count.comp"), &[("FACTORS", 2)]);
    refused(made, &["counter", "no shader has a constant \"FACTORS\"", "there are: FACTOR"]);
}

/// The numbers 1, 10, 100 after one dispatch.
fn counted(device: &Arc<Device>, constants: &[(&str, u32)], push: &[u8]) -> Vec<u32> {
    let pipeline = counter(device, constants);
    let numbers = uploaded(device, "numbers", bytemuck::cast_slice(&[1_u32, 10, 100]));
    let to = buffer(device, "to", 12, Place::Readback);
    let set = bound(device, &pipeline, &numbers);
    run(device, "count", |commands| {
        commands.bind_compute(&pipeline, &set);
        commands.push(&pipeline.layout, push);
        commands.dispatch([1; 3]);
        commands.buffer_barrier(&numbers, COMPUTE, COPY_READ);
        commands.copy_buffer(&numbers, 0, &to, 0, 12);
    });
    words(&to.read().unwrap())
}

fn constant_is_specialized(device: &Arc<Device>) {
    let five = 5_u32.to_ne_bytes();
    assert_eq!(counted(device, &[], &five), [6, 15, 105], "the constant's own value is 1");
    assert_eq!(counted(device, &[("FACTOR", 7)], &five), [12, 75, 705]);
}

fn too_few_push_constants_are_refused(device: &Arc<Device>) {
    let pipeline = counter(device, &[]);
    let pushed = misuse(device, |commands| commands.push(&pipeline.layout, &[0; 3]));
    refused(pushed, &["counter", "3 bytes of push constants, the shaders take 4"]);
}

fn padding_after_push_constants_is_left_out(device: &Arc<Device>) {
    let padded: Vec<u8> = [5_u32, 1000, 1000].iter().flat_map(|word| word.to_ne_bytes()).collect();
    assert_eq!(counted(device, &[], &padded), [6, 15, 105]);
}
