//! How a device is used, and the features that it is opened with.

use ash::vk;

use super::info::DeviceInfo;

/// How a device is used.
#[derive(Clone, Copy, Debug, Default)]
pub struct DeviceUse {
    /// Compute work shares the graphics queue even where another exists.
    pub single_queue: bool,
    /// Shaders that read beyond a buffer or an image get some value there, and nothing else happens (`robustBufferAccess`,
    /// `robustImageAccess`); it may take time.
    pub robust: bool,
}

/// Those that exist of the features this program can use.
pub(super) fn wanted_features(instance: &ash::Instance, info: &DeviceInfo, robust: bool) -> vk::PhysicalDeviceFeatures {
    // SAFETY: the physical device belongs to this instance.
    let has = unsafe { instance.get_physical_device_features(info.physical) };
    vk::PhysicalDeviceFeatures {
        robust_buffer_access: if robust { has.robust_buffer_access } else { vk::FALSE },
        depth_bounds: has.depth_bounds,
        // Numbers of vertices beyond 2^24.
        full_draw_index_uint32: has.full_draw_index_uint32,
        occlusion_query_precise: has.occlusion_query_precise,
        pipeline_statistics_query: has.pipeline_statistics_query,
        // Attachments that blend beside attachments that are replaced.
        independent_blend: has.independent_blend,
        // Shaders that count their own invocations.
        fragment_stores_and_atomics: has.fragment_stores_and_atomics,
        // One- and two-byte storage images.
        shader_storage_image_extended_formats: has.shader_storage_image_extended_formats,
        shader_storage_image_write_without_format: has.shader_storage_image_write_without_format,
        shader_sampled_image_array_dynamic_indexing: has.shader_sampled_image_array_dynamic_indexing,
        shader_clip_distance: has.shader_clip_distance,
        ..Default::default()
    }
}
