//! What stays on the device while frames change: the volume, the transfer function, structures, pipelines.

use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;

use super::distances::{Built, Distances, Pending, Source, distance_image};
use super::pipelines::Pipelines;
use super::structures::{Built as HostBuilt, Structures};
use super::texture::Texels;
use super::upload;
use crate::error::{Error, Result};
use crate::part::resource::Resource;
use crate::plan::Plan;
use crate::scene::Scene;
use crate::scene::settings::Filter;
use crate::shared;
use crate::structure::Lookup;
use crate::structure::blocks::{self, BLOCK};
use crate::structure::cells::Support;
use crate::structure::grid::DistanceField;
use crate::truth::preintegrated::PreintegratedTable;
use crate::vulkan::{Buffer, BufferInfo, Device, Image, ImageInfo, Place};

/// Images and buffers of one scene, made when the first plan asks for them.
pub struct Resident {
    device: Arc<Device>,
    images: HashMap<Resource, Image>,
    buffers: HashMap<Resource, Buffer>,
    distances: Distances,
    pub(super) pipelines: Pipelines,
    /// What building the blocks' ranges took, milliseconds.
    blocks_ms: Option<f64>,
    /// The table whose image and axes are here.
    table: Option<Arc<PreintegratedTable>>,
}

impl Resident {
    pub fn new(device: &Arc<Device>) -> Self {
        Self {
            device: device.clone(),
            images: HashMap::new(),
            buffers: HashMap::new(),
            distances: Distances::default(),
            pipelines: Pipelines::new(device),
            blocks_ms: None,
            table: None,
        }
    }

    pub fn image(&self, resource: Resource) -> Option<&Image> {
        self.images.get(&resource)
    }

    pub fn buffer(&self, resource: Resource) -> Option<&Buffer> {
        match resource {
            // What frames read are the blocks' ranges.
            Resource::CellRange => self.distances.ranges(BLOCK as u32),
            _ => self.buffers.get(&resource),
        }
    }

    /// The distances of that kind.
    pub fn distance(&self, lookup: &Lookup) -> Option<&Image> {
        self.distances.get(lookup).map(|built| &built.image)
    }

    /// The same with what building them took.
    pub fn built(&self, lookup: &Lookup) -> Option<&Built> {
        self.distances.get(lookup)
    }

    /// The distances as the device has them, a byte a cell and octant; none where they were not built.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn read_distances(&self, lookup: &Lookup) -> Result<Option<Vec<u8>>> {
        self.distance(lookup).map(|image| upload::read_sampled(&self.device, image)).transpose()
    }

    /// Whether the ranges of cells of that side are there, which depend on the volume alone.
    pub fn ranges_are_there(&self, cell: u32) -> bool {
        self.distances.ranges(cell).is_some()
    }

    /// Forgets what depends on the transfer function: the next plan's scene may have another one.
    pub fn forget_transfer(&mut self) {
        self.buffers.remove(&Resource::Transfer);
        self.buffers.remove(&Resource::GreyTransfer);
        self.images.remove(&Resource::BlockTable);
        self.table = None;
        self.distances.forget_transfer();
    }

    /// Forgets the scene; pipelines stay, which the next one may draw with too.
    pub fn forget_scene(&mut self) {
        let pipelines = std::mem::replace(&mut self.pipelines, Pipelines::new(&self.device));
        *self = Self { pipelines, ..Self::new(&self.device) };
    }

    /// Begins to build distances on the device; see [`super::Background`].
    ///
    /// # Errors
    /// As [`Resident::prepare`].
    pub fn begin(&mut self, scene: &Scene, lookup: &Lookup) -> Result<Pending> {
        self.with_source(scene, |distances, device, pipelines, source| {
            distances.begin(device, pipelines, source, lookup)
        })
    }

    /// Takes over what was begun and has ended; `ms` is what it took.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn finish(&mut self, pending: Pending, ms: f64) -> Result<()> {
        self.distances.finish(&self.device, pending, ms)
    }

    /// Forgets distances that were made for other views than these.
    pub fn keep_views(&mut self, kept: &[Lookup]) {
        self.distances.keep_views(kept);
    }

    /// Bytes of each resource that the plan reads.
    pub fn bytes(&self, plan: &Plan) -> Vec<(Resource, u64)> {
        let reads = |r: Resource| plan.steps.iter().any(|s| s.accesses.iter().any(|a| a.resource == r));
        let images = self.images.iter().map(|(r, i)| (*r, i.bytes()));
        let ranges = self.buffer(Resource::CellRange).map(|b| (Resource::CellRange, b));
        let buffers = self.buffers.iter().map(|(r, b)| (*r, b)).chain(ranges).map(|(r, b)| (r, b.bytes()));
        let distance = plan.distance.and_then(|lookup| self.distance(&lookup));
        let distance = distance.map(|image| (Resource::NearestDistance, image.bytes()));
        images.chain(buffers).filter(|(r, _)| reads(*r)).chain(distance).collect()
    }

    /// Makes what the plan reads and is not there yet. Distances that `structures` holds are taken from there, others
    /// are built on the device.
    ///
    /// # Errors
    /// When the volume is larger than the device allows, or cannot be filtered there.
    pub fn prepare(&mut self, scene: &Scene, plan: &Plan, structures: &Structures) -> Result<()> {
        let reads = |r: Resource| plan.steps.iter().any(|s| s.accesses.iter().any(|a| a.resource == r));
        for resource in
            [Resource::Volume, Resource::Holes, Resource::Transfer, Resource::GreyTransfer, Resource::BlockTable]
        {
            let there = self.images.contains_key(&resource) || self.buffers.contains_key(&resource);
            if reads(resource) && !there {
                self.make(resource, scene)?;
            }
        }
        if reads(Resource::Preintegrated)
            && let Some(table) = structures.table(scene)
        {
            self.take_table(scene, table)?;
        }
        if reads(Resource::BlockTable) && self.buffer(Resource::CellRange).is_none() {
            let ms = self.with_source(scene, |distances, device, pipelines, source| {
                distances.build_ranges(device, pipelines, source, BLOCK as u32)
            })?;
            self.blocks_ms = Some(ms);
        }
        let Some(lookup) = plan.distance.filter(|lookup| self.distance(lookup).is_none()) else { return Ok(()) };
        match structures.distance(&lookup) {
            Some(built) => self.take(&lookup, built),
            None => {
                self.pipelines.prepare(&plan.steps)?;
                self.with_source(scene, |distances, device, pipelines, source| {
                    distances.build(device, pipelines, source, &lookup)
                })
            }
        }
    }

    /// Uploads a table of pre-integrated classification, unless it is the one that is here.
    fn take_table(&mut self, scene: &Scene, table: Arc<PreintegratedTable>) -> Result<()> {
        if self.table.as_ref().is_some_and(|there| Arc::ptr_eq(there, &table)) {
            return Ok(());
        }
        let extent = [table.nodes, table.nodes, 1];
        let bytes = bytemuck::cast_slice(&table.texels);
        let image = self.upload_image(Resource::Preintegrated, extent, vk::Format::R32G32B32A32_SFLOAT, bytes)?;
        self.images.insert(Resource::Preintegrated, image);
        let texels = Texels::of(scene);
        let pieces = shared::axis_pieces(&table, |x| texels.scale * x + texels.offset);
        self.upload_buffer(Resource::Axis, bytemuck::cast_slice(&pieces))?;
        self.table = Some(table);
        Ok(())
    }

    /// Uploads distances that were built on the host.
    fn take(&mut self, lookup: &Lookup, host: &HostBuilt<DistanceField>) -> Result<()> {
        let value = &host.value;
        let image = distance_image(&self.device, &value.grid, value.octants, lookup.view.is_none())?;
        upload::image(&self.device, &image, &value.bytes)?;
        self.distances.put(Built {
            lookup: *lookup,
            image,
            ms: host.cpu_ms,
            view_ms: if lookup.view.is_some() { host.cpu_ms } else { 0.0 },
        });
        Ok(())
    }

    /// Milliseconds that building what the plan looks up took.
    pub fn build_ms(&self, plan: &Plan) -> Option<f64> {
        let distance = plan.distance.and_then(|lookup| self.distances.get(&lookup)).map(|built| built.ms);
        let reads = |r: Resource| plan.steps.iter().any(|s| s.accesses.iter().any(|a| a.resource == r));
        let blocks = if reads(Resource::BlockTable) { self.blocks_ms } else { None };
        distance.or(blocks)
    }

    /// Does something with the distances and what they are built from.
    fn with_source<T>(
        &mut self,
        scene: &Scene,
        build: impl FnOnce(&mut Distances, &Arc<Device>, &mut Pipelines, Source) -> Result<T>,
    ) -> Result<T> {
        for resource in [Resource::Volume, Resource::Holes] {
            let needed = resource == Resource::Volume || scene.field.holes.is_some();
            if needed && !self.images.contains_key(&resource) {
                self.make(resource, scene)?;
            }
        }
        let support = Support::of(&Texels::of(scene).shown(scene));
        let Some(volume) = self.images.get(&Resource::Volume) else {
            return Err(Error::device(&self.device.info.name, "has no volume to build from", "report this bug"));
        };
        let source =
            Source { field: &scene.field, volume, holes: self.images.get(&Resource::Holes), support: &support };
        build(&mut self.distances, &self.device, &mut self.pipelines, source)
    }

    fn make(&mut self, resource: Resource, scene: &Scene) -> Result<()> {
        let field = &scene.field;
        match resource {
            Resource::Volume => {
                let texels = Texels::of(scene);
                check_format(&self.device, texels.format(), scene.settings.sampling.filter)?;
                let image = self.upload_image(resource, field.dims(), texels.format(), texels.bytes())?;
                self.images.insert(resource, image);
            }
            Resource::Holes => {
                let holes: Vec<u8> = field.holes.iter().flatten().map(|&h| u8::from(h)).collect();
                let image = self.upload_image(resource, field.cells(), vk::Format::R8_UINT, &holes)?;
                self.images.insert(resource, image);
            }
            Resource::Transfer | Resource::GreyTransfer => {
                let pieces = shared::pieces(&Texels::of(scene).transfer(&scene.transfer));
                let rows = shared::rows(&pieces, resource == Resource::GreyTransfer);
                self.upload_buffer(resource, bytemuck::cast_slice(&rows))?;
            }
            Resource::BlockTable => {
                let table = blocks::visibility_table(&Texels::of(scene).shown(scene));
                let image = self.upload_image(resource, [256, 256, 1], vk::Format::R8_UINT, &table)?;
                self.images.insert(resource, image);
            }
            _ => {}
        }
        Ok(())
    }

    fn upload_buffer(&mut self, resource: Resource, bytes: &[u8]) -> Result<()> {
        let buffer = Buffer::new(
            &self.device,
            BufferInfo {
                name: resource.name().to_owned(),
                size: bytes.len() as u64,
                usage: vk::BufferUsageFlags::STORAGE_BUFFER,
                place: Place::Upload,
            },
        )?;
        buffer.write(0, bytes)?;
        self.buffers.insert(resource, buffer);
        Ok(())
    }

    fn upload_image(&self, resource: Resource, extent: [usize; 3], format: vk::Format, bytes: &[u8]) -> Result<Image> {
        let flat = matches!(resource, Resource::BlockTable | Resource::Preintegrated);
        let image = Image::new(
            &self.device,
            ImageInfo {
                name: resource.name().to_owned(),
                extent: extent.map(|n| u32::try_from(n).unwrap_or(u32::MAX)),
                format,
                usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST,
                volume: !flat,
                shared: !flat,
            },
        )?;
        upload::image(&self.device, &image, bytes)?;
        Ok(image)
    }
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
