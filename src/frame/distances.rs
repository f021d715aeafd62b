//! The distances that near-neighbor skipping reads, on the device: built there by compute shaders, or on the host and
//! uploaded. What depends on the volume alone outlives the transfer function, and what depends on both the view.

use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;
use cpu_time::ProcessTime;

use super::build::{self, Given, Job};
use super::pipelines::Pipelines;
use crate::error::{Error, Result};
use crate::pass::Step;
use crate::pass::build as steps;
use crate::pass::resource::Resource;
use crate::scene::Field;
use crate::scene::settings::Distance;
use crate::shared;
use crate::structure::Lookup;
use crate::structure::cells::Support;
use crate::structure::grid::{Grid, OCTANTS};
use crate::vulkan::{Buffer, BufferInfo, Device, Image, ImageInfo, Place};

/// Distances on the device and what they cost.
pub struct Built {
    pub lookup: Lookup,
    pub image: Image,
    /// CPU time of the process on a device that is a CPU, else device time; milliseconds.
    pub ms: f64,
}

/// What the structures of one scene are made from and those that were made.
#[derive(Default)]
pub struct Distances {
    /// By side of the cells and resource.
    parts: HashMap<(u32, Resource), Buffer>,
    built: Vec<Built>,
}

/// What builds read of the scene.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    pub field: &'a Field,
    pub volume: &'a Image,
    pub holes: Option<&'a Image>,
    /// Where the transfer function shows anything, in the texture's values.
    pub support: &'a Support,
}

/// A build that is under way.
pub struct Pending {
    pub lookup: Lookup,
    pub job: Job,
    image: Image,
    /// Lives as long as the job.
    _buffers: Vec<Buffer>,
}

impl Distances {
    /// The distances of that kind, where they were built.
    pub fn get(&self, lookup: &Lookup) -> Option<&Built> {
        self.built.iter().find(|built| built.lookup == *lookup)
    }

    /// Ranges of the values in cells of that side.
    pub fn ranges(&self, cell: u32) -> Option<&Buffer> {
        self.parts.get(&(cell, Resource::CellRange))
    }

    /// Takes distances that were made elsewhere.
    pub fn put(&mut self, built: Built) {
        self.built.push(built);
    }

    /// Forgets what depends on the transfer function.
    pub fn forget_transfer(&mut self) {
        self.parts.retain(|(_, resource), _| *resource == Resource::CellRange);
        self.built.clear();
    }

    /// Forgets what was made for a view.
    pub fn forget_view(&mut self) {
        self.built.retain(|built| built.lookup.view.is_none());
    }

    /// Builds the ranges of cells of that side, where they are not there; milliseconds.
    ///
    /// # Errors
    /// As [`Distances::build`].
    pub fn build_ranges(
        &mut self,
        device: &Arc<Device>,
        pipelines: &mut Pipelines,
        source: Source,
        cell: u32,
    ) -> Result<f64> {
        let grid = Grid::new(source.field, cell);
        self.run_parts(device, pipelines, source, &grid, &[steps::cell_range(&grid)])
    }

    /// Builds distances on the device and waits for them.
    ///
    /// # Errors
    /// Buffers beyond the device's limits, too little memory, or what the driver reports.
    pub fn build(
        &mut self,
        device: &Arc<Device>,
        pipelines: &mut Pipelines,
        source: Source,
        lookup: &Lookup,
    ) -> Result<()> {
        let begin = ProcessTime::now();
        let mut pending = self.begin(device, pipelines, source, lookup)?;
        pending.job.run(&[])?;
        let cpu_ms = begin.elapsed().as_secs_f64() * 1e3;
        self.finish(device, pending, cpu_ms)
    }

    /// Records a build; what it needs of volume and transfer function is built first.
    ///
    /// # Errors
    /// As [`Distances::build`].
    pub fn begin(
        &mut self,
        device: &Arc<Device>,
        pipelines: &mut Pipelines,
        source: Source,
        lookup: &Lookup,
    ) -> Result<Pending> {
        let grid = Grid::new(source.field, lookup.cell);
        let octants = if lookup.distance == Distance::Directional { OCTANTS } else { 1 };
        let list = match lookup.distance {
            Distance::Omni => steps::omni(&grid, Resource::NearestDistance),
            Distance::Directional => steps::directional(&grid),
            Distance::Optimal | Distance::Cone => steps::bundle(&grid),
        };
        let mut first = Vec::new();
        if grid.cell > 1 {
            first.push(steps::cell_range(&grid));
        }
        first.push(steps::interesting(&grid, source.field.holes.is_some()));
        if lookup.view.is_some() {
            first.extend(steps::widen(&grid));
        }
        self.run_parts(device, pipelines, source, &grid, &first)?;
        if lookup.view.is_some() {
            let omni = Lookup { distance: Distance::Omni, view: None, ..*lookup };
            if self.get(&omni).is_none() {
                self.build(device, pipelines, source, &omni)?;
            }
        }
        let image = distance_image(device, &grid, octants, lookup.view.is_none())?;
        let mut buffers = self.transient(device, &grid, octants, &list)?;
        if let Some(view) = &lookup.view {
            let bundle = shared::Bundle::new(&grid, source.field, view);
            buffers.push((Resource::Bundle, filled(device, Resource::Bundle, bytemuck::bytes_of(&bundle), true)?));
        }
        let omni = self.get(&Lookup { distance: Distance::Omni, view: None, ..*lookup });
        let given = |resource: Resource| match resource {
            Resource::NearestDistance => Some(Given::Image(&image)),
            Resource::OmniDistance => omni.map(|built| Given::Image(&built.image)),
            Resource::Bundle => find(&buffers, resource).map(Given::Uniform),
            _ => find(&buffers, resource).or_else(|| self.parts.get(&(lookup.cell, resource))).map(Given::Storage),
        };
        let job = Job::new(device, lookup.distance.name(), &list, pipelines, &given)?;
        Ok(Pending { lookup: *lookup, job, image, _buffers: buffers.into_iter().map(|(_, buffer)| buffer).collect() })
    }

    /// Takes a finished build over for frames.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn finish(&mut self, device: &Arc<Device>, pending: Pending, cpu_ms: f64) -> Result<()> {
        if let Some(last) = pending.job.last() {
            build::acquire(device, &pending.image, last)?;
        }
        let ms = if device.info.is_cpu() { cpu_ms } else { pending.job.device_ms()?.unwrap_or(cpu_ms) };
        self.built.push(Built { lookup: pending.lookup, image: pending.image, ms });
        Ok(())
    }

    /// Runs those of `list` whose results are not there, and keeps these; milliseconds.
    fn run_parts(
        &mut self,
        device: &Arc<Device>,
        pipelines: &mut Pipelines,
        source: Source,
        grid: &Grid,
        list: &[Step],
    ) -> Result<f64> {
        let cell = grid.cell as u32;
        let missing: Vec<Step> =
            list.iter().filter(|step| written(step).any(|r| !self.parts.contains_key(&(cell, r)))).cloned().collect();
        if missing.is_empty() {
            return Ok(0.0);
        }
        for resource in missing.iter().flat_map(written) {
            let buffer = storage(device, resource, steps::bytes(grid, 1, resource))?;
            self.parts.insert((cell, resource), buffer);
        }
        let support = filled(device, Resource::Support, bytemuck::cast_slice(&source.support.closed()), false)?;
        let given = |resource: Resource| match resource {
            Resource::Volume => Some(Given::Image(source.volume)),
            Resource::Holes => source.holes.map(Given::Image),
            Resource::Support => Some(Given::Storage(&support)),
            _ => self.parts.get(&(cell, resource)).map(Given::Storage),
        };
        let begin = ProcessTime::now();
        let mut job = Job::new(device, "interesting", &missing, pipelines, &given)?;
        job.run(&[])?;
        let cpu = begin.elapsed().as_secs_f64() * 1e3;
        Ok(if device.info.is_cpu() { cpu } else { job.device_ms()?.unwrap_or(cpu) })
    }

    /// Buffers that a build needs meanwhile.
    fn transient(
        &self,
        device: &Arc<Device>,
        grid: &Grid,
        octants: usize,
        list: &[Step],
    ) -> Result<Vec<(Resource, Buffer)>> {
        let mut made: Vec<(Resource, Buffer)> = Vec::new();
        for resource in list.iter().flat_map(|step| &step.accesses).map(|access| access.resource) {
            let there = find(&made, resource).is_some() || self.parts.contains_key(&(grid.cell as u32, resource));
            let bytes = steps::bytes(grid, octants, resource);
            if !there && bytes > 0 {
                made.push((resource, storage(device, resource, bytes)?));
            }
        }
        Ok(made)
    }
}

fn written(step: &Step) -> impl Iterator<Item = Resource> + '_ {
    step.accesses.iter().filter(|a| a.usage.writes()).map(|a| a.resource)
}

fn find(buffers: &[(Resource, Buffer)], resource: Resource) -> Option<&Buffer> {
    buffers.iter().find(|(of, _)| *of == resource).map(|(_, buffer)| buffer)
}

/// Whether the device takes the buffers of a build; a volume too large for them is built on the host.
pub fn fits(device: &Device, field: &Field, lookup: &Lookup) -> bool {
    let grid = Grid::new(field, lookup.cell);
    let octants = if lookup.distance == Distance::Directional { OCTANTS } else { 1 };
    let largest = steps::steps(field, lookup)
        .iter()
        .flat_map(|step| &step.accesses)
        .map(|access| steps::bytes(&grid, octants, access.resource))
        .max();
    largest.unwrap_or(0) <= device.info.max_storage_buffer
}

/// The texture that frames read; `shared` where builds read it too.
pub fn distance_image(device: &Arc<Device>, grid: &Grid, octants: usize, shared: bool) -> Result<Image> {
    let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    if octants != 1 && octants != OCTANTS {
        return Err(Error::device(&device.info.name, format!("{octants} octants"), "use 1 or 8"));
    }
    let info = ImageInfo {
        name: Resource::NearestDistance.name().to_owned(),
        extent: grid.cells.map(side),
        // A byte a cell, or all octants of a cell in one texel.
        format: if octants == 1 { vk::Format::R8_UINT } else { vk::Format::R32G32_UINT },
        usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC,
        volume: true,
        shared,
    };
    Image::new(device, info)
}

fn storage(device: &Arc<Device>, resource: Resource, bytes: u64) -> Result<Buffer> {
    let usage = vk::BufferUsageFlags::STORAGE_BUFFER | vk::BufferUsageFlags::TRANSFER_SRC;
    Buffer::new(device, BufferInfo { name: resource.name().to_owned(), size: bytes, usage, place: Place::Device })
}

fn filled(device: &Arc<Device>, resource: Resource, bytes: &[u8], uniform: bool) -> Result<Buffer> {
    let usage = if uniform { vk::BufferUsageFlags::UNIFORM_BUFFER } else { vk::BufferUsageFlags::STORAGE_BUFFER };
    let info = BufferInfo { name: resource.name().to_owned(), size: bytes.len() as u64, usage, place: Place::Upload };
    let buffer = Buffer::new(device, info)?;
    buffer.write(0, bytes)?;
    Ok(buffer)
}
