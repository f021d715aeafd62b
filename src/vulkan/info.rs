//! What the devices of this machine can do.

use std::ffi::CStr;

use ash::{ext, vk};
use serde::{Serialize, Serializer};

use super::diagnosis::diagnosed;
use super::failure::{failed, no_device};
use super::instance::Instance;
use super::version::{API_VERSION, version_name};
use crate::error::Result;

/// NVIDIA packs its driver version in its own way.
const NVIDIA: u32 = 0x10de;

/// What kind of device it is, in the order in which they are preferred.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum DeviceKind {
    Discrete,
    Integrated,
    Virtual,
    Cpu,
    Other,
}

/// A family of queues.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct QueueFamily {
    #[serde(serialize_with = "flags_as_text")]
    pub flags: vk::QueueFlags,
    pub count: u32,
    /// 0: no timestamps on these queues.
    pub timestamp_valid_bits: u32,
}

/// A device and those of its features and limits that matter here.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DeviceInfo {
    /// Position in the loader's list.
    pub index: usize,
    pub name: String,
    pub kind: DeviceKind,
    /// "1.3.250".
    pub api_version: String,
    pub driver_name: String,
    pub driver_info: String,
    pub driver_version: String,
    pub depth_bounds: bool,
    pub occlusion_precise: bool,
    pub pipeline_statistics: bool,
    pub conditional_rendering: bool,
    /// Nanoseconds a tick.
    pub timestamp_period: f32,
    /// Of the graphics family; 0: no timestamps.
    pub timestamp_valid_bits: u32,
    pub queue_families: Vec<QueueFamily>,
    /// Texels a side.
    pub max_image_3d: u32,
    /// Texels a side.
    pub max_image_2d: u32,
    /// Pixels, width and height.
    pub max_viewport: [u32; 2],
    /// The rasteriser moves corners to a raster of 2^-bits pixels; at least 4.
    pub sub_pixel_bits: u32,
    /// Bytes.
    pub max_storage_buffer: u64,
    /// Texels of a buffer.
    pub max_texel_buffer: u32,
    /// The greatest number of a vertex that triangles share.
    pub max_vertex_number: u32,
    /// Bytes of the device's own memory.
    pub memory_bytes: u64,
    /// Why this device cannot be used; `None` when it can.
    pub unusable: Option<String>,
    #[serde(skip)]
    pub physical: vk::PhysicalDevice,
}

impl DeviceInfo {
    /// Whether the CPU does a device's work: its time is then that of the process.
    pub fn is_cpu(&self) -> bool {
        self.kind == DeviceKind::Cpu
    }
}

impl Instance {
    /// All devices the loader knows, usable or not.
    ///
    /// # Errors
    /// The loader cannot list them, which is also how it says that there is no driver at all, or there is none.
    pub fn devices(&self) -> Result<Vec<DeviceInfo>> {
        // SAFETY: the instance is alive.
        let found = unsafe { self.raw.enumerate_physical_devices() }
            .map_err(|code| diagnosed(&self.entry, failed("vkEnumeratePhysicalDevices", "Vulkan instance", code)))?;
        if found.is_empty() {
            return Err(diagnosed(&self.entry, no_device()));
        }
        found.into_iter().enumerate().map(|(index, physical)| describe(&self.raw, index, physical)).collect()
    }
}

impl DeviceInfo {
    /// The family for graphics: one that computes too, if there is one.
    pub(super) fn graphics_family(&self) -> Option<usize> {
        let has = |wanted| self.queue_families.iter().position(|family| family.flags.contains(wanted));
        has(vk::QueueFlags::GRAPHICS | vk::QueueFlags::COMPUTE).or_else(|| has(vk::QueueFlags::GRAPHICS))
    }

    /// A family that computes and does not draw.
    pub(super) fn compute_family(&self) -> Option<usize> {
        self.queue_families.iter().position(|family| {
            family.flags.contains(vk::QueueFlags::COMPUTE) && !family.flags.contains(vk::QueueFlags::GRAPHICS)
        })
    }
}

fn describe(raw: &ash::Instance, index: usize, physical: vk::PhysicalDevice) -> Result<DeviceInfo> {
    // SAFETY: `physical` belongs to this instance, here and below.
    let (properties, features, families, memory) = unsafe {
        (
            raw.get_physical_device_properties(physical),
            raw.get_physical_device_features(physical),
            raw.get_physical_device_queue_family_properties(physical),
            raw.get_physical_device_memory_properties(physical),
        )
    };
    let limits = &properties.limits;
    let mut info = DeviceInfo {
        index,
        name: text(properties.device_name_as_c_str()),
        kind: match properties.device_type {
            vk::PhysicalDeviceType::DISCRETE_GPU => DeviceKind::Discrete,
            vk::PhysicalDeviceType::INTEGRATED_GPU => DeviceKind::Integrated,
            vk::PhysicalDeviceType::VIRTUAL_GPU => DeviceKind::Virtual,
            vk::PhysicalDeviceType::CPU => DeviceKind::Cpu,
            _ => DeviceKind::Other,
        },
        api_version: version_name(properties.api_version),
        driver_name: String::new(),
        driver_info: String::new(),
        driver_version: driver_version(properties.vendor_id, properties.driver_version),
        depth_bounds: features.depth_bounds == vk::TRUE,
        occlusion_precise: features.occlusion_query_precise == vk::TRUE,
        pipeline_statistics: features.pipeline_statistics_query == vk::TRUE,
        conditional_rendering: false,
        timestamp_period: limits.timestamp_period,
        timestamp_valid_bits: 0,
        queue_families: families
            .iter()
            .map(|family| QueueFamily {
                flags: family.queue_flags,
                count: family.queue_count,
                timestamp_valid_bits: family.timestamp_valid_bits,
            })
            .collect(),
        max_image_3d: limits.max_image_dimension3_d,
        max_image_2d: limits
            .max_image_dimension2_d
            .min(limits.max_framebuffer_width)
            .min(limits.max_framebuffer_height),
        max_viewport: limits.max_viewport_dimensions,
        sub_pixel_bits: limits.sub_pixel_precision_bits,
        max_storage_buffer: limits.max_storage_buffer_range.into(),
        max_texel_buffer: limits.max_texel_buffer_elements,
        max_vertex_number: limits.max_draw_indexed_index_value,
        memory_bytes: memory
            .memory_heaps_as_slice()
            .iter()
            .filter(|heap| heap.flags.contains(vk::MemoryHeapFlags::DEVICE_LOCAL))
            .map(|heap| heap.size)
            .sum(),
        unusable: None,
        physical,
    };
    if properties.api_version < API_VERSION {
        info.unusable = Some(format!("speaks Vulkan {}, 1.3 is needed", info.api_version));
        return Ok(info);
    }
    describe_1_3(raw, &mut info)?;
    match info.graphics_family() {
        Some(graphics) => info.timestamp_valid_bits = info.queue_families[graphics].timestamp_valid_bits,
        None => info.unusable = Some("has no graphics queue".into()),
    }
    Ok(info)
}

/// What can only be asked of a driver that speaks Vulkan 1.3.
fn describe_1_3(raw: &ash::Instance, info: &mut DeviceInfo) -> Result<()> {
    // SAFETY: the physical device belongs to this instance.
    let extensions = unsafe { raw.enumerate_device_extension_properties(info.physical) }
        .map_err(|code| failed("vkEnumerateDeviceExtensionProperties", &info.name, code))?;
    let conditional_named =
        extensions.iter().any(|one| one.extension_name_as_c_str() == Ok(ext::conditional_rendering::NAME));

    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    let mut v12 = vk::PhysicalDeviceVulkan12Features::default();
    let mut v13 = vk::PhysicalDeviceVulkan13Features::default();
    let mut conditional = vk::PhysicalDeviceConditionalRenderingFeaturesEXT::default();
    let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut v12).push_next(&mut v13);
    if conditional_named {
        features = features.push_next(&mut conditional);
    }
    // SAFETY: the device speaks 1.3, so it knows every structure in the chains.
    unsafe {
        raw.get_physical_device_properties2(info.physical, &mut properties);
        raw.get_physical_device_features2(info.physical, &mut features);
    }
    info.driver_name = text(driver.driver_name_as_c_str());
    info.driver_info = text(driver.driver_info_as_c_str());
    info.conditional_rendering = conditional.conditional_rendering == vk::TRUE;
    if v12.timeline_semaphore != vk::TRUE {
        info.unusable = Some("lacks the feature timelineSemaphore".into());
    } else if v13.synchronization2 != vk::TRUE {
        info.unusable = Some("lacks the feature synchronization2".into());
    }
    Ok(())
}

fn text(bytes: Result<&CStr, std::ffi::FromBytesUntilNulError>) -> String {
    bytes.map(|text| text.to_string_lossy().into_owned()).unwrap_or_default()
}

fn driver_version(vendor: u32, version: u32) -> String {
    match vendor {
        NVIDIA => format!("{}.{}.{}", version >> 22, version >> 14 & 0xff, version >> 6 & 0xff),
        _ => version_name(version),
    }
}

fn flags_as_text<S: Serializer>(flags: &vk::QueueFlags, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&format!("{flags:?}"))
}
