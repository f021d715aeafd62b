//! What stays on the device while frames change: the volume, the transfer function, structures, pipelines.

use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;

use super::pipelines::Pipelines;
use super::structures::Structures;
use super::texture::Texels;
use super::upload;
use crate::error::{Error, Result};
use crate::pass::resource::Resource;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::scene::settings::Filter;
use crate::shared;
use crate::structure::Lookup;
use crate::structure::blocks::{self, Blocks};
use crate::structure::grid::DistanceField;
use crate::vulkan::{Buffer, BufferInfo, Device, Image, ImageInfo, Place};

/// Images and buffers of one scene, made when the first plan asks for them.
pub struct Resident {
    device: Arc<Device>,
    images: HashMap<Resource, Image>,
    buffers: HashMap<Resource, Buffer>,
    distances: Vec<(Lookup, Image)>,
    texels: Option<Texels>,
    pub(super) pipelines: Pipelines,
    /// Time to build structures on the device, milliseconds of CPU time.
    pub build_ms: HashMap<Resource, f64>,
}

impl Resident {
    pub fn new(device: &Arc<Device>) -> Self {
        Self {
            device: device.clone(),
            images: HashMap::new(),
            buffers: HashMap::new(),
            distances: Vec::new(),
            texels: None,
            pipelines: Pipelines::new(device),
            build_ms: HashMap::new(),
        }
    }

    pub fn image(&self, resource: Resource) -> Option<&Image> {
        self.images.get(&resource)
    }

    pub fn buffer(&self, resource: Resource) -> Option<&Buffer> {
        self.buffers.get(&resource)
    }

    /// The distances of that kind.
    pub fn distance(&self, lookup: &Lookup) -> Option<&Image> {
        self.distances.iter().find(|(made, _)| made == lookup).map(|(_, image)| image)
    }

    /// Bytes of each resource that the plan reads.
    pub fn bytes(&self, plan: &Plan) -> Vec<(Resource, u64)> {
        let reads = |r: Resource| plan.steps.iter().any(|s| s.accesses.iter().any(|a| a.resource == r));
        let images = self.images.iter().map(|(r, i)| (*r, i.bytes()));
        let buffers = self.buffers.iter().map(|(r, b)| (*r, b.bytes()));
        let distance = plan.distance.and_then(|lookup| self.distance(&lookup));
        let distance = distance.map(|image| (Resource::NearestDistance, image.bytes()));
        images.chain(buffers).filter(|(r, _)| reads(*r)).chain(distance).collect()
    }

    /// Makes what the plan reads and is not there yet.
    ///
    /// # Errors
    /// When the volume is larger than the device allows, or cannot be filtered there.
    pub fn prepare(&mut self, scene: &Scene, plan: &Plan, structures: &Structures) -> Result<()> {
        let reads = |r: Resource| plan.steps.iter().any(|s| s.accesses.iter().any(|a| a.resource == r));
        for resource in
            [Resource::Volume, Resource::Holes, Resource::Transfer, Resource::BlockTable, Resource::BlockRange]
        {
            let there = self.images.contains_key(&resource) || self.buffers.contains_key(&resource);
            if reads(resource) && !there {
                self.make(resource, scene)?;
            }
        }
        if let Some(lookup) = plan.distance.filter(|lookup| self.distance(lookup).is_none())
            && let Some(built) = structures.distance(&lookup)
        {
            let (value, format) = (&built.value, distance_format(&built.value));
            let image = self.upload_image(Resource::NearestDistance, value.grid.cells, format, &value.distances)?;
            self.distances.push((lookup, image));
        }
        Ok(())
    }

    fn make(&mut self, resource: Resource, scene: &Scene) -> Result<()> {
        let field = &scene.field;
        match resource {
            Resource::Volume => {
                let format = self.texels(scene).format;
                check_format(&self.device, format, scene.settings.sampling.filter)?;
                let bytes = std::mem::take(&mut self.texels_mut(scene).bytes);
                let image = self.upload_image(resource, field.dims(), format, &bytes)?;
                self.images.insert(resource, image);
            }
            Resource::Holes => {
                let holes: Vec<u8> = field.holes.iter().flatten().map(|&h| u8::from(h)).collect();
                let image = self.upload_image(resource, field.cells(), vk::Format::R8_UINT, &holes)?;
                self.images.insert(resource, image);
            }
            Resource::Transfer => {
                let pieces = shared::pieces(&self.texels(scene).transfer(&scene.transfer));
                let buffer = Buffer::new(
                    &self.device,
                    BufferInfo {
                        name: resource.name().to_owned(),
                        size: size_of_val(pieces.as_slice()) as u64,
                        usage: vk::BufferUsageFlags::STORAGE_BUFFER,
                        place: Place::Upload,
                    },
                )?;
                buffer.write(0, bytemuck::cast_slice(&pieces))?;
                self.buffers.insert(resource, buffer);
            }
            Resource::BlockTable => {
                let table = blocks::visibility_table(&self.texels(scene).transfer(&scene.transfer));
                let image = self.upload_image(resource, [256, 256, 1], vk::Format::R8_UINT, &table)?;
                self.images.insert(resource, image);
            }
            Resource::BlockRange => {
                let count = Blocks::dims(field).iter().product::<usize>();
                let buffer = Buffer::new(
                    &self.device,
                    BufferInfo {
                        name: resource.name().to_owned(),
                        size: (count * size_of::<[f32; 2]>()) as u64,
                        usage: vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC,
                        place: Place::Device,
                    },
                )?;
                if let Some(volume) = self.images.get(&Resource::Volume) {
                    let ms = upload::build_block_range(&self.device, field, volume, &buffer)?;
                    self.build_ms.insert(resource, ms);
                }
                self.buffers.insert(resource, buffer);
            }
            _ => {}
        }
        Ok(())
    }

    fn texels(&mut self, scene: &Scene) -> &Texels {
        self.texels_mut(scene)
    }

    fn texels_mut(&mut self, scene: &Scene) -> &mut Texels {
        self.texels.get_or_insert_with(|| Texels::new(&scene.field, scene.settings.volume.texture))
    }

    fn upload_image(&self, resource: Resource, extent: [usize; 3], format: vk::Format, bytes: &[u8]) -> Result<Image> {
        let image = Image::new(
            &self.device,
            ImageInfo {
                name: resource.name().to_owned(),
                extent: extent.map(|n| u32::try_from(n).unwrap_or(u32::MAX)),
                format,
                usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
                volume: resource != Resource::BlockTable,
            },
        )?;
        upload::image(&self.device, &image, bytes)?;
        Ok(image)
    }
}

/// A byte a cell, or all octants of a cell in one texel.
fn distance_format(distance: &DistanceField) -> vk::Format {
    if distance.octants == 1 { vk::Format::R8_UINT } else { vk::Format::R32G32_UINT }
}

fn check_format(device: &Device, format: vk::Format, filter: Filter) -> Result<()> {
    let linear = filter == Filter::Hardware;
    let needed = if linear {
        vk::FormatFeatureFlags::SAMPLED_IMAGE_FILTER_LINEAR
    } else {
        vk::FormatFeatureFlags::SAMPLED_IMAGE
    };
    if device.format_supports(format, needed) {
        return Ok(());
    }
    let (problem, remedy) = if linear {
        (format!("cannot interpolate {format:?} volumes"), "use --filter exact, or --texture r16")
    } else {
        (format!("cannot read {format:?} volumes"), "use another --texture")
    };
    Err(Error::device(&device.info.name, problem, remedy))
}
