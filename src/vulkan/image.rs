//! Images and samplers.

use std::mem::ManuallyDrop;
use std::sync::Arc;

use ash::vk;
use gpu_allocator::MemoryLocation;
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, AllocationScheme};

use super::device::Device;
use super::failure::misuse;
use super::format::{aspect, has_stencil, texel_bytes};
use super::owned::Owned;
use crate::error::{Error, Result};

/// What an image is made from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageInfo {
    pub name: String,
    /// Texels; the last is 1 of a flat one, and the number of layers of one that has layers.
    pub extent: [u32; 3],
    pub format: vk::Format,
    pub usage: vk::ImageUsageFlags,
    pub shape: ImageShape,
    /// Graphics and compute queue may read it at the same time, so that no family owns it.
    pub shared: bool,
}

/// What the sides of an image are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ImageShape {
    /// Two sides.
    Flat,
    /// Three sides, between whose texels a sampler interpolates alike.
    Volume,
    /// Two sides and layers, between which a sampler does not interpolate.
    Layers,
}

/// An image of one level in device memory, with its view.
pub struct Image {
    pub info: ImageInfo,
    pub(super) inner: Arc<ImageInner>,
}

/// What lives as long as anything uses the image.
pub(super) struct ImageInner {
    device: Arc<Device>,
    handle: vk::Image,
    view: vk::ImageView,
    allocation: ManuallyDrop<Allocation>,
}

impl Image {
    /// # Errors
    /// A size beyond the device's limits, a format it cannot use in this way, too little memory.
    pub fn new(device: &Arc<Device>, info: ImageInfo) -> Result<Self> {
        check_limits(device, &info)?;
        let ([width, height, depth], layers) = sides(&info);
        let create = vk::ImageCreateInfo::default()
            .image_type(image_type(&info))
            .format(info.format)
            .extent(vk::Extent3D { width, height, depth })
            .mip_levels(1)
            .array_layers(layers)
            .samples(vk::SampleCountFlags::TYPE_1)
            .tiling(vk::ImageTiling::OPTIMAL)
            .usage(info.usage);
        let families = [device.graphics.family, device.compute.family];
        let create = if info.shared && families[0] != families[1] {
            create.sharing_mode(vk::SharingMode::CONCURRENT).queue_family_indices(&families)
        } else {
            create
        };
        // SAFETY: the limits were checked; on every error what was made so far is destroyed, unused.
        let inner = unsafe {
            let handle = device.check("vkCreateImage", &info.name, device.raw.create_image(&create, None))?;
            match bind(device, &info, handle) {
                Ok((allocation, view)) => {
                    ImageInner { device: device.clone(), handle, view, allocation: ManuallyDrop::new(allocation) }
                }
                Err(error) => {
                    device.raw.destroy_image(handle, None);
                    return Err(error);
                }
            }
        };
        device.name(inner.handle, &info.name);
        device.name(inner.view, &info.name);
        Ok(Self { info, inner: Arc::new(inner) })
    }

    pub fn handle(&self) -> vk::Image {
        self.inner.handle
    }

    /// The view of the whole image, of the depth aspect for depth formats that are sampled.
    pub fn view(&self) -> vk::ImageView {
        self.inner.view
    }

    /// Bytes of the texels, tightly packed: the size of a buffer that holds a copy.
    pub fn bytes(&self) -> u64 {
        packed_bytes(&self.info).unwrap_or_default()
    }
}

impl Drop for ImageInner {
    fn drop(&mut self) {
        // SAFETY: nothing uses the image any more; each part is freed once.
        unsafe {
            self.device.raw.destroy_image_view(self.view, None);
            self.device.raw.destroy_image(self.handle, None);
            self.device.free(ManuallyDrop::take(&mut self.allocation));
        }
    }
}

/// What a view shows: depth where a shader reads it, else stencil too, which a driver may look for in the view of an
/// attachment though it should not.
fn viewed(info: &ImageInfo) -> vk::ImageAspectFlags {
    match has_stencil(info.format) && !info.usage.contains(vk::ImageUsageFlags::SAMPLED) {
        true => vk::ImageAspectFlags::DEPTH | vk::ImageAspectFlags::STENCIL,
        false => aspect(info.format),
    }
}

/// Gives the image memory and a view.
///
/// # Safety
/// `handle` is an image of `device` made from `info` and not bound yet.
unsafe fn bind(device: &Device, info: &ImageInfo, handle: vk::Image) -> Result<(Allocation, vk::ImageView)> {
    let name = &info.name;
    // SAFETY: promised by the caller.
    let requirements = unsafe { device.raw.get_image_memory_requirements(handle) };
    let allocation = device.allocate(&AllocationCreateDesc {
        name,
        requirements,
        location: MemoryLocation::GpuOnly,
        linear: false,
        allocation_scheme: AllocationScheme::GpuAllocatorManaged,
    })?;
    let create = vk::ImageViewCreateInfo::default()
        .image(handle)
        .view_type(match info.shape {
            ImageShape::Flat => vk::ImageViewType::TYPE_2D,
            ImageShape::Volume => vk::ImageViewType::TYPE_3D,
            ImageShape::Layers => vk::ImageViewType::TYPE_2D_ARRAY,
        })
        .format(info.format)
        .subresource_range(whole(viewed(info)));
    // SAFETY: the memory is fresh and meets the requirements; the image is bound before its view is made.
    let view = unsafe {
        let bound = device.raw.bind_image_memory(handle, allocation.memory(), allocation.offset());
        device
            .check("vkBindImageMemory", name, bound)
            .and_then(|()| device.check("vkCreateImageView", name, device.raw.create_image_view(&create, None)))
    };
    match view {
        Ok(view) => Ok((allocation, view)),
        Err(error) => {
            device.free(allocation);
            Err(error)
        }
    }
}

/// The only level, with all layers.
pub(super) fn whole(aspect: vk::ImageAspectFlags) -> vk::ImageSubresourceRange {
    let layers = vk::REMAINING_ARRAY_LAYERS;
    vk::ImageSubresourceRange::default().aspect_mask(aspect).level_count(1).layer_count(layers)
}

/// Texels along the sides of an image's layers, and how many there are of these.
fn sides(info: &ImageInfo) -> ([u32; 3], u32) {
    let [width, height, last] = info.extent;
    match info.shape {
        ImageShape::Flat | ImageShape::Volume => (info.extent, 1),
        ImageShape::Layers => ([width, height, 1], last),
    }
}

fn image_type(info: &ImageInfo) -> vk::ImageType {
    match info.shape {
        ImageShape::Volume => vk::ImageType::TYPE_3D,
        ImageShape::Flat | ImageShape::Layers => vk::ImageType::TYPE_2D,
    }
}

fn packed_bytes(info: &ImageInfo) -> Option<u64> {
    let texel = texel_bytes(info.format)?;
    info.extent.iter().try_fold(texel, |bytes, &side| bytes.checked_mul(side.into()))
}

fn check_limits(device: &Device, info: &ImageInfo) -> Result<()> {
    let ImageInfo { name, extent, format, usage, shape, shared: _ } = info;
    let ([width, height, depth], layers) = sides(info);
    if extent.contains(&0) || (*shape == ImageShape::Flat && depth != 1) || usage.is_empty() {
        return Err(misuse(name, format!("{extent:?} texels, usage {usage:?}: no such image")));
    }
    if packed_bytes(info).is_none() {
        return Err(misuse(name, format!("{extent:?} texels of {format:?} have no known size")));
    }
    let size = format!("{width} x {height} x {} texels", extent[2]);
    let (limit, remedy) = match shape {
        ImageShape::Volume => (device.info.max_image_3d, "use a smaller volume, or a device with a higher limit"),
        ImageShape::Flat => (device.info.max_image_2d, "use a smaller viewport, or a device with a higher limit"),
        ImageShape::Layers => (device.info.max_image_2d, "use a smaller volume, or a device with a higher limit"),
    };
    if [width, height, depth].iter().any(|&side| side > limit) {
        return Err(Error::device(name, format!("{size}, {} allows {limit} a side", device.info.name), remedy));
    }
    let limits = device.image_limits(*format, image_type(info), *usage).map_err(|code| match code {
        vk::Result::ERROR_FORMAT_NOT_SUPPORTED => Error::device(
            name,
            format!("{} cannot use {format:?} images for {usage:?}", device.info.name),
            "choose another format or another device",
        ),
        code => super::failure::failed("vkGetPhysicalDeviceImageFormatProperties", name, code),
    })?;
    let most = limits.max_extent;
    if layers > limits.max_array_layers {
        let problem = format!("{layers} layers of {format:?}, {} allows {}", device.info.name, limits.max_array_layers);
        return Err(Error::device(name, problem, remedy));
    }
    if width > most.width || height > most.height || depth > most.depth {
        let allowed = format!("{} x {} x {}", most.width, most.height, most.depth);
        let problem = format!("{size} of {format:?}, {} allows {allowed}", device.info.name);
        return Err(Error::device(name, problem, remedy));
    }
    Ok(())
}

/// How images are read: clamped to their edge, level 0.
pub struct Sampler {
    pub name: String,
    pub linear: bool,
    pub(super) owned: Arc<Owned<vk::Sampler>>,
}

impl Sampler {
    /// Interpolates when `linear`, else takes the nearest texel.
    pub fn new(device: &Arc<Device>, name: &str, linear: bool) -> Result<Self> {
        let filter = if linear { vk::Filter::LINEAR } else { vk::Filter::NEAREST };
        let edge = vk::SamplerAddressMode::CLAMP_TO_EDGE;
        let create = vk::SamplerCreateInfo::default()
            .mag_filter(filter)
            .min_filter(filter)
            .mipmap_mode(vk::SamplerMipmapMode::NEAREST)
            .address_mode_u(edge)
            .address_mode_v(edge)
            .address_mode_w(edge);
        // SAFETY: the device is alive.
        let raw = device.check("vkCreateSampler", name, unsafe { device.raw.create_sampler(&create, None) })?;
        device.name(raw, name);
        // SAFETY of the destroyer: called once, when nothing uses the sampler any more.
        let owned = Owned::new(device, raw, |device, raw| unsafe { device.destroy_sampler(raw, None) });
        Ok(Self { name: name.into(), linear, owned })
    }
}
