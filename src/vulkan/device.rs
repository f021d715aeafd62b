//! The device, its queues and its memory.

use std::ffi::CString;
use std::mem::ManuallyDrop;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use ash::{ext, vk};
use gpu_allocator::vulkan::{Allocation, AllocationCreateDesc, Allocator, AllocatorCreateDesc};
use gpu_allocator::{AllocationSizes, AllocatorDebugSettings};

use super::failure::{failed, lost};
use super::features::{DeviceUse, wanted_features};
use super::info::DeviceInfo;
use super::instance::Instance;
use super::marks::Marks;
use super::queue::Queue;
use super::watch::{Watch, Watched};
use crate::error::{Error, Result};

/// Blocks of memory start at this size and double, so that a small frame does not claim the usual 256 MiB.
const FIRST_BLOCK: u64 = 16 << 20;
const LARGEST_BLOCK: u64 = 256 << 20;

/// A device with the features that exist of those this program can use.
pub struct Device {
    pub info: DeviceInfo,
    pub used: DeviceUse,
    pub raw: ash::Device,
    pub graphics: Queue,
    pub compute: Queue,
    pub(super) limits: vk::PhysicalDeviceLimits,
    pub(super) max_allocation: u64,
    pub(super) features: vk::PhysicalDeviceFeatures,
    pub(super) conditional: Option<ext::conditional_rendering::Device>,
    pub(super) debug: Option<ext::debug_utils::Device>,
    pub(super) cache: vk::PipelineCache,
    pub(super) marks: ManuallyDrop<Marks>,
    pub(super) watched: Watched,
    /// Names since a trace was begun; none where nobody asked for one.
    trace: Mutex<Option<Vec<String>>>,
    allocator: ManuallyDrop<Mutex<Allocator>>,
    instance: Arc<Instance>,
}

impl Device {
    /// Opens the device. `single_queue`: see [`DeviceUse`].
    ///
    /// # Errors
    /// As [`Device::open`].
    pub fn new(instance: &Arc<Instance>, info: &DeviceInfo, single_queue: bool) -> Result<Arc<Self>> {
        Self::open(instance, info, DeviceUse { single_queue, robust: false })
    }

    /// Opens the device.
    ///
    /// # Errors
    /// A device that cannot be used (with the reason), or a failing driver.
    pub fn open(instance: &Arc<Instance>, info: &DeviceInfo, used: DeviceUse) -> Result<Arc<Self>> {
        let DeviceUse { single_queue, robust } = used;
        let raw_instance = &instance.raw;
        if let Some(reason) = &info.unusable {
            return Err(Error::device(&info.name, reason, "choose another device"));
        }
        let graphics_family = info
            .graphics_family()
            .ok_or_else(|| Error::device(&info.name, "has no graphics queue", "choose another"))?;
        let (compute_family, compute_index): (usize, u32) = match info.compute_family() {
            _ if single_queue => (graphics_family, 0),
            Some(family) => (family, 0),
            None if info.queue_families[graphics_family].count > 1 => (graphics_family, 1),
            None => (graphics_family, 0),
        };

        let priorities = [1.0, 1.0];
        let mut queues =
            vec![vk::DeviceQueueCreateInfo::default().queue_family_index(graphics_family as u32).queue_priorities(
                &priorities[..1 + if compute_family == graphics_family { compute_index as usize } else { 0 }],
            )];
        if compute_family != graphics_family {
            queues.push(
                vk::DeviceQueueCreateInfo::default()
                    .queue_family_index(compute_family as u32)
                    .queue_priorities(&priorities[..1]),
            );
        }
        let features = wanted_features(raw_instance, info, robust);
        let mut v12 = vk::PhysicalDeviceVulkan12Features::default().timeline_semaphore(true);
        // Every device that speaks Vulkan 1.3 has it.
        let mut v13 = vk::PhysicalDeviceVulkan13Features::default().synchronization2(true).robust_image_access(robust);
        let mut conditional = vk::PhysicalDeviceConditionalRenderingFeaturesEXT::default().conditional_rendering(true);
        let mut features2 =
            vk::PhysicalDeviceFeatures2::default().features(features).push_next(&mut v12).push_next(&mut v13);
        let mut extensions = Vec::new();
        if info.conditional_rendering {
            extensions.push(ext::conditional_rendering::NAME.as_ptr());
            features2 = features2.push_next(&mut conditional);
        }
        let create = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&extensions)
            .push_next(&mut features2);
        // SAFETY: families, queue counts, extensions and features were all read from this physical device.
        let raw = unsafe { raw_instance.create_device(info.physical, &create, None) }
            .map_err(|code| failed("vkCreateDevice", &info.name, code))?;

        let parts = Parts::new(instance, info, &raw, [(graphics_family, 0), (compute_family, compute_index)]);
        let Parts { graphics, compute, cache, marks, allocator } = match parts {
            Ok(parts) => parts,
            Err(error) => {
                // SAFETY: nothing made from the device is left; `Parts` cleans up after itself.
                unsafe { raw.destroy_device(None) };
                return Err(error);
            }
        };
        let mut maintenance3 = vk::PhysicalDeviceMaintenance3Properties::default();
        let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut maintenance3);
        // SAFETY: the physical device belongs to this instance and speaks Vulkan 1.3.
        unsafe { raw_instance.get_physical_device_properties2(info.physical, &mut properties) };
        let limits = properties.properties.limits;
        let device = Arc::new(Self {
            info: info.clone(),
            used,
            graphics,
            compute,
            limits,
            max_allocation: maintenance3.max_memory_allocation_size,
            features,
            conditional: info
                .conditional_rendering
                .then(|| ext::conditional_rendering::Device::new(raw_instance, &raw)),
            debug: instance.debug_utils().then(|| ext::debug_utils::Device::new(raw_instance, &raw)),
            cache,
            marks: ManuallyDrop::new(marks),
            watched: Watched::default(),
            trace: Mutex::new(None),
            allocator: ManuallyDrop::new(Mutex::new(allocator)),
            instance: instance.clone(),
            raw,
        });
        device.name(device.raw.handle(), &info.name);
        device.name(device.graphics.raw(), "graphics queue");
        device.name(device.graphics.timeline(), "graphics queue");
        if device.separate_compute() {
            device.name(device.compute.raw(), "compute queue");
            device.name(device.compute.timeline(), "compute queue");
        }
        device.name(device.marks.buffer, "step marks");
        Ok(device)
    }

    /// Whether compute work has a queue of its own.
    pub fn separate_compute(&self) -> bool {
        (self.compute.family, self.compute.index) != (self.graphics.family, self.graphics.index)
    }

    /// The instance, for its validation messages.
    pub fn instance(&self) -> &Arc<Instance> {
        &self.instance
    }

    /// Whether fragment shaders may write storage buffers and images.
    pub fn fragment_stores(&self) -> bool {
        self.features.fragment_stores_and_atomics == vk::TRUE
    }

    /// Whether images of `format` with optimal tiling can do all of `features`.
    pub fn format_supports(&self, format: vk::Format, features: vk::FormatFeatureFlags) -> bool {
        // SAFETY: the physical device belongs to the instance that is held.
        let properties = unsafe { self.instance.raw.get_physical_device_format_properties(self.info.physical, format) };
        properties.optimal_tiling_features.contains(features)
    }

    /// Whether shaders can read texels of that format from buffers.
    pub(super) fn reads_texels(&self, format: vk::Format) -> bool {
        // SAFETY: the physical device belongs to the instance that is held.
        let properties = unsafe { self.instance.raw.get_physical_device_format_properties(self.info.physical, format) };
        properties.buffer_features.contains(vk::FormatFeatureFlags::UNIFORM_TEXEL_BUFFER)
    }

    /// Begins to note the names of all that is labelled from now on; what was noted before is forgotten.
    pub fn begin_trace(&self) {
        *self.trace.lock().unwrap_or_else(PoisonError::into_inner) = Some(Vec::new());
    }

    /// Notes a name, where a trace was begun; once, where it is that of the last one.
    pub fn trace(&self, name: &str) {
        let mut trace = self.trace.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(names) = trace.as_mut().filter(|names| names.last().is_none_or(|last| last != name)) {
            names.push(name.to_owned());
        }
    }

    /// Ends a trace: the names in their order.
    pub fn end_trace(&self) -> Vec<String> {
        self.trace.lock().unwrap_or_else(PoisonError::into_inner).take().unwrap_or_default()
    }

    /// The names of the steps that [`Commands::step`](super::Commands::step) counts, for the error of a lost device.
    pub fn set_step_names(&self, names: Arc<[String]>) {
        self.marks.set_names(names);
    }

    /// From now on work that takes longer than the watch has it is given up, and a lost device comes with what is suspected; without
    /// one the host waits for as long as it takes.
    pub fn watch(&self, watch: Option<Watch>) {
        self.watched.set(watch);
    }

    /// The length of `ticks`, in milliseconds.
    pub fn ticks_to_ms(&self, ticks: u64) -> f64 {
        ticks as f64 * f64::from(self.info.timestamp_period) * 1e-6
    }

    /// The time from one timestamp to a later one, in milliseconds, over a wrap of the counter too.
    pub fn elapsed_ms(&self, start: u64, end: u64) -> f64 {
        self.ticks_to_ms(end.wrapping_sub(start) & self.timestamp_mask())
    }

    /// The bits of a timestamp that count, on all queues that have timestamps.
    pub(super) fn timestamp_mask(&self) -> u64 {
        let bits = [&self.graphics, &self.compute].map(|queue| queue.timestamp_valid_bits);
        let bits = bits.into_iter().filter(|&bits| bits > 0).min().unwrap_or(0);
        1_u64.checked_shl(bits).map_or(u64::MAX, |end| end - 1)
    }

    /// Waits until all queues are idle.
    pub fn wait_idle(&self) -> Result<()> {
        let _graphics = self.graphics.lock();
        let _compute = (!self.compute.shares(&self.graphics)).then(|| self.compute.lock());
        // SAFETY: no other thread submits, the locks are held.
        self.check("vkDeviceWaitIdle", &self.info.name, unsafe { self.raw.device_wait_idle() })
    }

    /// Names an object for the debugger and for validation messages.
    pub(crate) fn name<H: vk::Handle>(&self, handle: H, name: &str) {
        let Some(debug) = &self.debug else { return };
        let name = c_text(name);
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(handle).object_name(&name);
        // SAFETY: the handle was made from this device and nobody else knows it yet. A name that cannot be set is
        // no reason to stop.
        let _ = unsafe { debug.set_debug_utils_object_name(&info) };
    }

    /// The result of `call` on the object of that name.
    pub(super) fn check<T>(&self, call: &str, object: &str, result: Result<T, vk::Result>) -> Result<T> {
        result.map_err(|code| match code {
            vk::Result::ERROR_DEVICE_LOST => self.watched.suspected(lost(call, object, &self.marks.last_step())),
            code => failed(call, object, code),
        })
    }

    /// Memory for the object `desc` names.
    pub(super) fn allocate(&self, desc: &AllocationCreateDesc<'_>) -> Result<Allocation> {
        let size = desc.requirements.size;
        let remedy = "ask for smaller images or buffers, or close what else uses the memory";
        if size > self.max_allocation {
            let limit = mebibytes(self.max_allocation);
            let problem = format!("needs {} of memory, one allocation is at most {limit}", mebibytes(size));
            return Err(Error::device(desc.name, problem, remedy));
        }
        self.allocator().allocate(desc).map_err(|error| {
            let problem = format!("{} of memory for it could not be had ({error})", mebibytes(size));
            Error::device(desc.name, problem, remedy)
        })
    }

    pub(super) fn free(&self, allocation: Allocation) {
        // An error means that the allocator lost count; the memory then stays until the device goes.
        let _ = self.allocator().free(allocation);
    }

    pub(super) fn image_limits(
        &self,
        format: vk::Format,
        kind: vk::ImageType,
        usage: vk::ImageUsageFlags,
    ) -> Result<vk::ImageFormatProperties, vk::Result> {
        let (tiling, flags) = (vk::ImageTiling::OPTIMAL, vk::ImageCreateFlags::empty());
        let physical = self.info.physical;
        // SAFETY: the physical device belongs to the instance that is held.
        unsafe {
            self.instance.raw.get_physical_device_image_format_properties(physical, format, kind, tiling, usage, flags)
        }
    }

    fn allocator(&self) -> MutexGuard<'_, Allocator> {
        self.allocator.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: every object holds the device, so none is left; what remains is freed in the reverse order of its
        // making, after the queues are idle, and never touched again.
        unsafe {
            let _ = self.raw.device_wait_idle();
            self.raw.destroy_pipeline_cache(self.cache, None);
            self.graphics.destroy(&self.raw);
            if !self.compute.shares(&self.graphics) {
                self.compute.destroy(&self.raw);
            }
            let mut allocator =
                ManuallyDrop::take(&mut self.allocator).into_inner().unwrap_or_else(PoisonError::into_inner);
            ManuallyDrop::take(&mut self.marks).free(&self.raw, &mut allocator);
            drop(allocator);
            self.raw.destroy_device(None);
        }
    }
}

/// What a device is made of beside its handle.
struct Parts {
    graphics: Queue,
    compute: Queue,
    cache: vk::PipelineCache,
    marks: Marks,
    allocator: Allocator,
}

impl Parts {
    fn new(instance: &Instance, info: &DeviceInfo, raw: &ash::Device, queues: [(usize, u32); 2]) -> Result<Self> {
        let mut allocator = Allocator::new(&AllocatorCreateDesc {
            instance: instance.raw.clone(),
            device: raw.clone(),
            physical_device: info.physical,
            debug_settings: AllocatorDebugSettings::default(),
            buffer_device_address: false,
            allocation_sizes: AllocationSizes::new(FIRST_BLOCK, FIRST_BLOCK)
                .with_max_device_memblock_size(LARGEST_BLOCK)
                .with_max_host_memblock_size(LARGEST_BLOCK),
        })
        .map_err(|error| Error::device(&info.name, error, "choose another device"))?;
        let [graphics, compute] = queues;
        let queue = |(family, index): (usize, u32), slot| {
            Queue::new(raw, family as u32, index, info.queue_families[family].timestamp_valid_bits, slot)
        };
        let marks = Marks::new(raw, &mut allocator)?;
        let graphics_queue = match queue(graphics, 0) {
            Ok(made) => made,
            Err(error) => {
                marks.free(raw, &mut allocator);
                return Err(error);
            }
        };
        let made = match compute == graphics {
            true => Ok(graphics_queue.share()),
            false => queue(compute, 1),
        }
        .and_then(|compute| {
            // SAFETY: the device is alive.
            let cache = unsafe { raw.create_pipeline_cache(&vk::PipelineCacheCreateInfo::default(), None) };
            match cache {
                Ok(cache) => Ok((compute, cache)),
                Err(code) => {
                    if !compute.shares(&graphics_queue) {
                        compute.destroy(raw);
                    }
                    Err(failed("vkCreatePipelineCache", &info.name, code))
                }
            }
        });
        match made {
            Ok((compute, cache)) => Ok(Self { graphics: graphics_queue, compute, cache, marks, allocator }),
            Err(error) => {
                graphics_queue.destroy(raw);
                marks.free(raw, &mut allocator);
                Err(error)
            }
        }
    }
}

/// `text` for Vulkan; what stands after a zero is cut.
pub(super) fn c_text(text: &str) -> CString {
    CString::new(text.split('\0').next().unwrap_or_default()).unwrap_or_default()
}

pub(super) fn mebibytes(bytes: u64) -> String {
    format!("{:.1} MiB", bytes as f64 / f64::from(1 << 20))
}
