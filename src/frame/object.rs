//! Resources as objects of a device, made as their rows say.

use std::sync::Arc;

use ash::vk;

use super::build::Bindable;
use super::upload;
use crate::error::{Error, Result};
use crate::part::resource::{Facts, Resource, ResourceKind, Texture};
use crate::resource;
use crate::scene::settings::Filter;
use crate::vulkan::{Buffer, BufferInfo, Device, Image, ImageInfo, Place, TexelBuffer};

/// An image or a buffer; one of texels is a buffer with a view.
pub enum DeviceObject {
    Image(Image),
    Buffer(Buffer),
    Texels(TexelBuffer),
}

impl DeviceObject {
    pub fn image(&self) -> Option<&Image> {
        match self {
            Self::Image(image) => Some(image),
            Self::Buffer(_) | Self::Texels(_) => None,
        }
    }

    pub fn buffer(&self) -> Option<&Buffer> {
        match self {
            Self::Buffer(buffer) | Self::Texels(TexelBuffer { buffer, .. }) => Some(buffer),
            Self::Image(_) => None,
        }
    }

    pub fn bytes(&self) -> u64 {
        match self {
            Self::Image(image) => image.bytes(),
            Self::Buffer(buffer) | Self::Texels(TexelBuffer { buffer, .. }) => buffer.bytes(),
        }
    }

    /// As a build binds it under the name of `resource`.
    pub fn given(&self, resource: Resource) -> Bindable<'_> {
        match self {
            Self::Image(image) => Bindable::Image(image),
            Self::Buffer(buffer) if matches!(resource.of.kind, ResourceKind::Uniform(_)) => Bindable::Uniform(buffer),
            Self::Buffer(buffer) | Self::Texels(TexelBuffer { buffer, .. }) => Bindable::Storage(buffer),
        }
    }
}

/// A resource that the device writes, or copies into.
///
/// # Errors
/// Sizes beyond the device's limits, too little memory.
pub fn empty(device: &Arc<Device>, resource: Resource, facts: &Facts) -> Result<DeviceObject> {
    let bytes = || resource.bytes(facts);
    match &resource.of.kind {
        ResourceKind::Texture(texture) => {
            check_format(device, resource, texture, facts)?;
            image(device, resource, texture, facts).map(DeviceObject::Image)
        }
        _ => buffer(device, resource, bytes(), Place::Device).map(DeviceObject::Buffer),
    }
}

/// A resource with what the host has for it.
///
/// # Errors
/// As [`empty`], and a texture that the device cannot read or interpolate.
pub fn filled(device: &Arc<Device>, resource: Resource, facts: &Facts, bytes: &[u8]) -> Result<DeviceObject> {
    match &resource.of.kind {
        ResourceKind::Texture(texture) => {
            check_format(device, resource, texture, facts)?;
            let image = image(device, resource, texture, facts)?;
            upload::image(device, &image, bytes)?;
            Ok(DeviceObject::Image(image))
        }
        ResourceKind::Texels(format, _) if !facts.view.cells.as_ref().is_some_and(|cells| cells.in_storage) => {
            let (size, usage) = (bytes.len() as u64, vk::BufferUsageFlags::empty());
            let info = BufferInfo { name: resource.numbered(), size, usage, place: Place::Upload };
            let texels = TexelBuffer::new(device, info, *format)?;
            texels.buffer.write(0, bytes)?;
            Ok(DeviceObject::Texels(texels))
        }
        _ => {
            let buffer = buffer(device, resource, bytes.len() as u64, Place::Upload)?;
            buffer.write(0, bytes)?;
            Ok(DeviceObject::Buffer(buffer))
        }
    }
}

fn buffer(device: &Arc<Device>, resource: Resource, size: u64, place: Place) -> Result<Buffer> {
    use vk::BufferUsageFlags as Flags;
    let usage = match resource.of.kind {
        ResourceKind::Vertices(_) => Flags::VERTEX_BUFFER,
        ResourceKind::Polygons(_) if place == Place::Upload => Flags::VERTEX_BUFFER | Flags::INDEX_BUFFER,
        ResourceKind::Polygons(_) => {
            Flags::VERTEX_BUFFER | Flags::INDEX_BUFFER | Flags::STORAGE_BUFFER | Flags::TRANSFER_SRC
        }
        ResourceKind::Uniform(_) => Flags::UNIFORM_BUFFER,
        ResourceKind::Staging(_) => Flags::TRANSFER_SRC | Flags::TRANSFER_DST,
        _ => Flags::STORAGE_BUFFER | Flags::TRANSFER_SRC,
    };
    Buffer::new(device, BufferInfo { name: resource.numbered(), size, usage, place })
}

fn image(device: &Arc<Device>, resource: Resource, texture: &Texture, facts: &Facts) -> Result<Image> {
    use vk::ImageUsageFlags as Flags;
    let info = ImageInfo {
        name: resource.name().to_owned(),
        // Sides beyond 32 bits are beyond every device's limits, which are checked.
        extent: (texture.extent)(facts).map(|side| u32::try_from(side).unwrap_or(u32::MAX)),
        format: (texture.format)(facts),
        usage: Flags::SAMPLED | Flags::TRANSFER_DST | Flags::TRANSFER_SRC,
        shape: texture.shape,
        shared: (texture.shared)(facts),
    };
    Image::new(device, info)
}

fn check_format(device: &Device, resource: Resource, texture: &Texture, facts: &Facts) -> Result<()> {
    let format = (texture.format)(facts);
    let linear = texture.filtered && facts.scene.settings.sampling.filter == Filter::Hardware;
    let needed = if linear {
        vk::FormatFeatureFlags::SAMPLED_IMAGE_FILTER_LINEAR
    } else {
        vk::FormatFeatureFlags::SAMPLED_IMAGE
    };
    if device.format_supports(format, needed) {
        return Ok(());
    }
    let (problem, remedy) = if resource.of.name == resource::GRADIENTS.of.name {
        (format!("cannot interpolate {format:?} gradients"), "use --filter exact, or --gradient-texture rgba16f")
    } else if linear {
        (format!("cannot interpolate {format:?} volumes"), "use --filter exact, or --texture r16")
    } else {
        (format!("cannot read {format:?} textures"), "use another --texture")
    };
    Err(Error::device(&device.info.name, problem, remedy))
}
