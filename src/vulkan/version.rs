//! The version of Vulkan that is needed, and versions in words.

use ash::vk;

/// The version that is needed: synchronization2 and timeline semaphores without extensions.
pub(super) const API_VERSION: u32 = vk::API_VERSION_1_3;

/// A Vulkan version as "1.3.250".
pub(super) fn version_name(version: u32) -> String {
    let [major, minor, patch] =
        [vk::api_version_major(version), vk::api_version_minor(version), vk::api_version_patch(version)];
    format!("{major}.{minor}.{patch}")
}
