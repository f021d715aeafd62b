//! Runs a compute shader of this folder on a list of arguments.

use std::sync::Arc;

use bytemuck::Pod;
use depthleap::shared::Frame;
use depthleap::vulkan::{
    Bound, Buffer, BufferInfo, Commands, ComputePipeline, CopyRegion, DescriptorSet, Device, Image, ImageInfo,
    ImageShape, Place, Scope, vk,
};

use crate::shader::shader;

/// Invocations in a work group of every shader here.
const GROUP: usize = 64;

/// What a shader needs besides its arguments.
#[derive(Default)]
pub struct Setup<'a> {
    pub frame: Option<Frame>,
    pub resources: Vec<(&'a str, Bound<'a>)>,
}

/// A compute shader of this folder, compiled once.
pub struct Evaluator {
    device: Arc<Device>,
    name: String,
    pipeline: ComputePipeline,
}

impl Evaluator {
    pub fn new(device: &Arc<Device>, file: &str, constants: &[(&str, u32)]) -> Self {
        let name = format!("formulas/{file}");
        let pipeline = ComputePipeline::new(device, &name, &shader(&name), constants).unwrap();
        Self { device: device.clone(), name, pipeline }
    }

    /// One `R` for each argument.
    pub fn run<A: Pod, R: Pod>(&self, setup: &Setup, arguments: &[A]) -> Vec<R> {
        // Filled up with the first one to whole work groups.
        let count = arguments.len().next_multiple_of(GROUP);
        let mut padded = arguments.to_vec();
        padded.resize(count, arguments[0]);
        let buffer = |name: &str, size: usize, usage, place| {
            Buffer::new(&self.device, BufferInfo { name: name.to_owned(), size: size as u64, usage, place }).unwrap()
        };
        let (storage, uniform) = (vk::BufferUsageFlags::STORAGE_BUFFER, vk::BufferUsageFlags::UNIFORM_BUFFER);
        let from = buffer("arguments", size_of_val(padded.as_slice()), storage, Place::Upload);
        from.write(0, bytemuck::cast_slice(&padded)).unwrap();
        let to = buffer("results", count * size_of::<R>(), storage, Place::Readback);
        let frame = buffer("frame", size_of::<Frame>(), uniform, Place::Upload);
        frame.write(0, bytemuck::bytes_of(&setup.frame.unwrap_or(bytemuck::Zeroable::zeroed()))).unwrap();

        let mut resources = setup.resources.clone();
        resources.push(("arguments", Bound::Storage(&from)));
        resources.push(("results", Bound::Storage(&to)));
        resources.push(("frame", Bound::Uniform(&frame)));
        let set = DescriptorSet::new(&self.device, &self.name, &self.pipeline.layout, &resources).unwrap();
        run(&self.device, &self.name, |commands| {
            commands.bind_compute(&self.pipeline, &set);
            commands.dispatch([(count / GROUP) as u32, 1, 1]);
        });
        bytemuck::pod_collect_to_vec(&to.read().unwrap()[..arguments.len() * size_of::<R>()])
    }
}

fn run(device: &Arc<Device>, name: &str, record: impl FnOnce(&mut Commands)) {
    let mut commands = Commands::begin(device, &device.graphics, name).unwrap();
    record(&mut commands);
    let recorded = commands.finish().unwrap();
    device.graphics.submit(&recorded, &[]).unwrap().wait().unwrap();
}

/// An image of f32 components, to be read by compute shaders.
pub fn image(device: &Arc<Device>, name: &str, extent: [u32; 3], format: vk::Format, values: &[f32]) -> Image {
    let usage = vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST;
    let info = ImageInfo {
        name: name.to_owned(),
        extent,
        format,
        usage,
        shape: if extent[2] > 1 { ImageShape::Volume } else { ImageShape::Flat },
        shared: false,
    };
    let image = Image::new(device, info).unwrap();
    let bytes: &[u8] = bytemuck::cast_slice(values);
    let usage = vk::BufferUsageFlags::TRANSFER_SRC;
    let info = BufferInfo { name: name.to_owned(), size: bytes.len() as u64, usage, place: Place::Upload };
    let from = Buffer::new(device, info).unwrap();
    from.write(0, bytes).unwrap();
    let write = Scope::new(vk::PipelineStageFlags2::COPY, vk::AccessFlags2::TRANSFER_WRITE);
    let read = Scope::new(vk::PipelineStageFlags2::COMPUTE_SHADER, vk::AccessFlags2::SHADER_READ);
    let to = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
    run(device, name, |commands| {
        commands.image_barrier(&image, Scope::NONE, write, vk::ImageLayout::UNDEFINED, to);
        commands.copy_buffer_to_image(&from, &image, CopyRegion::whole(&image));
        commands.image_barrier(&image, write, read, to, SAMPLED);
    });
    image
}

/// The layout of an [`image`].
pub const SAMPLED: vk::ImageLayout = vk::ImageLayout::SHADER_READ_ONLY_OPTIMAL;

/// Rounding of one f32 operation, relative.
pub const ROUNDING: f64 = 1.0 / (1 << 24) as f64;

pub struct Random(pub u64);

impl Random {
    /// Uniform in [0, 1) (splitmix64).
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// The farthest that results are from their truth, in parts of what is allowed: at most 1 passes. Says which it was.
#[derive(Default)]
pub struct Worst {
    part: f64,
    what: String,
    count: usize,
}

impl Worst {
    pub fn see(&mut self, found: f64, expected: f64, allowed: f64, what: impl FnOnce() -> String) {
        self.count += 1;
        let part = (found - expected).abs() / allowed;
        // Not a number is the worst there is.
        let part = if part.is_nan() { f64::INFINITY } else { part };
        if part > self.part {
            self.part = part;
            self.what = format!("{found} where {expected} +- {allowed:e} is right, for {}", what());
        }
    }

    #[track_caller]
    pub fn assert(&self, at_least: usize) {
        assert!(self.part <= 1.0, "{:.3} of what is allowed: {}", self.part, self.what);
        assert!(self.count >= at_least, "only {} were compared", self.count);
    }

    pub fn fails(&self) -> bool {
        self.part > 1.0
    }
}
