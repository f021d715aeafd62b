//! The distances that near-neighbor skipping reads, on the device: built there by compute shaders, or on the host and
//! uploaded. What depends on the volume alone outlives the transfer function, and what depends on both the view.

use std::collections::HashMap;
use std::sync::Arc;

use ash::vk;
use cpu_time::ProcessTime;

use super::build::{self, Given, Job};
use super::pipelines::Pipelines;
use crate::error::Result;
use crate::part::Step;
use crate::part::resource::Resource;
use crate::pass::build as steps;
use crate::scene::Field;
use crate::scene::settings::Distance;
use crate::shared;
use crate::structure::Lookup;
use crate::structure::bundle::Bundles;
use crate::structure::cells::Support;
use crate::structure::grid::{Grid, OCTANTS};
use crate::vulkan::{Buffer, BufferInfo, Device, Image, ImageInfo, Place};

/// Distances on the device and what they cost.
pub struct Built {
    pub lookup: Lookup,
    pub image: Image,
    /// What building them took from the volume on, pipelines not counted: CPU time of the process on a device that is
    /// a CPU, else device time; milliseconds.
    pub ms: f64,
    /// The part of it that every new view takes.
    pub view_ms: f64,
}

/// What the structures of one scene are made from and those that were made.
#[derive(Default)]
pub struct Distances {
    parts: HashMap<PartKey, Part>,
    built: Vec<Built>,
}

/// Side of the cells, whether they are judged by the values of single voxels, and the resource.
type PartKey = (u32, bool, Resource);

/// The key of what lookups of that kind of cells are built from. Ranges are the same for all.
fn part_key(cell: u32, nearest: bool, resource: Resource) -> PartKey {
    (cell, nearest && resource != Resource::CellRange, resource)
}

/// A buffer and what filling it took, milliseconds.
struct Part {
    buffer: Buffer,
    ms: f64,
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
        self.part(cell, false, Resource::CellRange)
    }

    /// Takes distances that were made elsewhere.
    pub fn put(&mut self, built: Built) {
        self.built.push(built);
    }

    /// Forgets what depends on the transfer function.
    pub fn forget_transfer(&mut self) {
        self.parts.retain(|(_, _, resource), _| *resource == Resource::CellRange);
        self.built.clear();
    }

    /// Forgets what was made for other views than these.
    pub fn keep_views(&mut self, kept: &[Lookup]) {
        self.built.retain(|built| built.lookup.view.is_none() || kept.contains(&built.lookup));
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
        self.build_parts(device, pipelines, source, &grid, false, &[steps::cell_range(&grid)])?;
        Ok(self.ms(cell, false, Resource::CellRange).unwrap_or(0.0))
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
        let mut pending = self.begin(device, pipelines, source, lookup)?;
        let ms = timed(device, &mut pending.job)?;
        self.finish(device, pending, ms)
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
        let octants = octants(lookup.distance);
        let list = match lookup.distance {
            Distance::Omni => steps::omni(&grid, Resource::NearestDistance),
            Distance::Directional => steps::directional(&grid),
            Distance::Optimal | Distance::Cone => steps::bundle(&grid),
        };
        let mut first = steps::cells(&grid, source.field, lookup);
        if lookup.view.is_some() {
            first.extend(steps::widen(&grid));
        }
        self.build_parts(device, pipelines, source, &grid, lookup.nearest, &first)?;
        if lookup.view.is_some() {
            let omni = Lookup { distance: Distance::Omni, view: None, ..*lookup };
            if self.get(&omni).is_none() {
                self.build(device, pipelines, source, &omni)?;
            }
        }
        let image = distance_image(device, &grid, octants, lookup.view.is_none())?;
        let mut buffers = self.transient(device, lookup, &grid, &list)?;
        if let Some(view) = &lookup.view {
            let bundle = shared::Bundle::from(&Bundles::new(&grid, source.field, view));
            buffers.push((Resource::Bundle, filled(device, Resource::Bundle, bytemuck::bytes_of(&bundle), true)?));
        }
        let omni = self.get(&Lookup { distance: Distance::Omni, view: None, ..*lookup });
        let given = |resource: Resource| match resource {
            Resource::NearestDistance => Some(Given::Image(&image)),
            Resource::OmniDistance => omni.map(|built| Given::Image(&built.image)),
            Resource::Bundle => find(&buffers, resource).map(Given::Uniform),
            _ => find(&buffers, resource)
                .or_else(|| self.part(lookup.cell, lookup.nearest, resource))
                .map(Given::Storage),
        };
        let job = Job::new(device, lookup.distance.name(), &list, pipelines, &given)?;
        Ok(Pending { lookup: *lookup, job, image, _buffers: buffers.into_iter().map(|(_, buffer)| buffer).collect() })
    }

    /// Takes a finished build over for frames; `ms` is what its job took.
    ///
    /// # Errors
    /// What the driver reports.
    pub fn finish(&mut self, device: &Arc<Device>, pending: Pending, ms: f64) -> Result<()> {
        if let Some(last) = pending.job.last() {
            build::acquire(device, &pending.image, last)?;
        }
        let Pending { lookup, image, .. } = pending;
        let omni = lookup.view.and_then(|_| self.get(&Lookup { distance: Distance::Omni, view: None, ..lookup }));
        // The omni structure's time has the cells' in it already.
        let widen: f64 =
            [Resource::Wide2, Resource::Wide4].iter().filter_map(|r| self.ms(lookup.cell, lookup.nearest, *r)).sum();
        let cells: f64 = [Resource::CellRange, Resource::Interesting]
            .iter()
            .filter_map(|r| self.ms(lookup.cell, lookup.nearest, *r))
            .sum();
        let before = omni.map_or(cells, |omni| omni.ms + widen);
        let view_ms = if lookup.view.is_some() { ms } else { 0.0 };
        self.built.push(Built { lookup, image, ms: before + ms, view_ms });
        Ok(())
    }

    fn part(&self, cell: u32, nearest: bool, resource: Resource) -> Option<&Buffer> {
        self.parts.get(&part_key(cell, nearest, resource)).map(|part| &part.buffer)
    }

    fn ms(&self, cell: u32, nearest: bool, resource: Resource) -> Option<f64> {
        self.parts.get(&part_key(cell, nearest, resource)).map(|part| part.ms)
    }

    /// Runs those of `list` whose results are not there, and keeps these.
    fn build_parts(
        &mut self,
        device: &Arc<Device>,
        pipelines: &mut Pipelines,
        source: Source,
        grid: &Grid,
        nearest: bool,
        list: &[Step],
    ) -> Result<()> {
        let cell = grid.cell as u32;
        let support = filled(device, Resource::Support, bytemuck::cast_slice(&source.support.closed()), false)?;
        for step in list {
            let Some(resource) = written(step).find(|r| self.part(cell, nearest, *r).is_none()) else { continue };
            let buffer = storage(device, resource, steps::bytes(grid, 1, resource))?;
            let given = |wanted: Resource| match wanted {
                Resource::Volume => Some(Given::Image(source.volume)),
                Resource::Holes => source.holes.map(Given::Image),
                Resource::Support => Some(Given::Storage(&support)),
                _ if wanted == resource => Some(Given::Storage(&buffer)),
                _ => self.part(cell, nearest, wanted).map(Given::Storage),
            };
            let mut job = Job::new(device, &step.name, std::slice::from_ref(step), pipelines, &given)?;
            let ms = timed(device, &mut job)?;
            self.parts.insert(part_key(cell, nearest, resource), Part { buffer, ms });
        }
        Ok(())
    }

    /// Buffers that a build needs meanwhile.
    fn transient(
        &self,
        device: &Arc<Device>,
        lookup: &Lookup,
        grid: &Grid,
        list: &[Step],
    ) -> Result<Vec<(Resource, Buffer)>> {
        let octants = octants(lookup.distance);
        let mut made: Vec<(Resource, Buffer)> = Vec::new();
        for resource in list.iter().flat_map(|step| step.accesses.iter()).map(|access| access.resource) {
            let there = find(&made, resource).is_some() || self.part(lookup.cell, lookup.nearest, resource).is_some();
            let bytes = steps::bytes(grid, octants, resource);
            if !there && bytes > 0 {
                made.push((resource, storage(device, resource, bytes)?));
            }
        }
        Ok(made)
    }
}

/// Octants that a structure tells apart.
fn octants(distance: Distance) -> usize {
    if distance == Distance::Directional { OCTANTS } else { 1 }
}

/// Runs a job; its time as [`Built`] has it.
fn timed(device: &Device, job: &mut Job) -> Result<f64> {
    let begin = ProcessTime::now();
    job.run(&[])?;
    let cpu = begin.elapsed().as_secs_f64() * 1e3;
    Ok(if device.info.is_cpu() { cpu } else { job.device_ms()?.unwrap_or(cpu) })
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
    let octants = octants(lookup.distance);
    let largest = steps::steps(field, lookup)
        .iter()
        .flat_map(|step| step.accesses.iter())
        .map(|access| steps::bytes(&grid, octants, access.resource))
        .max();
    largest.unwrap_or(0) <= device.info.max_storage_buffer
}

/// The texture that frames read; `shared` where builds read it too.
pub fn distance_image(device: &Arc<Device>, grid: &Grid, octants: usize, shared: bool) -> Result<Image> {
    let side = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
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
