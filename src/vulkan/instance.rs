//! The Vulkan loader, the instance, and what the validation layer said.

use std::ffi::CStr;
use std::sync::{Arc, PoisonError};

use ash::{ext, vk};

use super::diagnosis::diagnosed;
use super::failure::failed;
use super::messages::{Messages, messenger_info};
use super::version::{API_VERSION, version_name};
use crate::error::{Error, Result};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

/// A loaded Vulkan instance. Lives until the last device made from it is gone.
pub struct Instance {
    pub raw: ash::Instance,
    debug_utils: bool,
    messenger: Option<(ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    /// Boxed: the driver holds its address while the instance lives.
    messages: Box<Messages>,
    /// Holds the library; dropped last.
    pub(super) entry: ash::Entry,
}

impl Instance {
    /// Loads the system's Vulkan loader. With `validate` the Khronos validation layer is on, synchronization
    /// validation included, and its messages are collected.
    ///
    /// # Errors
    /// No loader, a loader older than Vulkan 1.3, or `validate` without the layer.
    pub fn new(validate: bool) -> Result<Arc<Self>> {
        // SAFETY: loading runs the initialisers of the system's own loader; there is no other way to reach Vulkan.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| {
            Error::device(
                "Vulkan loader",
                format!("libvulkan cannot be loaded ({error})"),
                "install it (Debian: libvulkan1, and mesa-vulkan-drivers for a driver)",
            )
        })?;
        // SAFETY: the loader has been loaded; the call takes nothing.
        let version = unsafe { entry.try_enumerate_instance_version() }
            .map_err(|code| failed("vkEnumerateInstanceVersion", "Vulkan loader", code))?
            .unwrap_or(vk::API_VERSION_1_0);
        if version < API_VERSION {
            return Err(Error::device(
                "Vulkan loader",
                format!("speaks Vulkan {}, 1.3 is needed", version_name(version)),
                "install a newer one (Debian: libvulkan1 of release 12 or later)",
            ));
        }

        let mut layers = Vec::new();
        if validate {
            // SAFETY: as above.
            let present = unsafe { entry.enumerate_instance_layer_properties() }
                .map_err(|code| failed("vkEnumerateInstanceLayerProperties", "Vulkan loader", code))?;
            if !present.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER)) {
                return Err(Error::device(
                    "validation",
                    "the layer VK_LAYER_KHRONOS_validation is not installed",
                    "install it (Debian: vulkan-validationlayers) or run without validation",
                ));
            }
            layers.push(VALIDATION_LAYER);
        }

        let from_loader = extensions(&entry, None).map_err(|error| diagnosed(&entry, error))?;
        let from_layer = if validate { extensions(&entry, Some(VALIDATION_LAYER))? } else { Vec::new() };
        let has = |name: &CStr| from_loader.iter().chain(&from_layer).any(|extension| extension.as_c_str() == name);
        let debug_utils = has(ext::debug_utils::NAME);
        let validation_features = validate && has(ext::validation_features::NAME);
        if validate && !(debug_utils && validation_features) {
            return Err(Error::device(
                "validation",
                "the installed layer cannot report messages or has no synchronization validation",
                "install another version (Debian: vulkan-validationlayers)",
            ));
        }
        let mut names = Vec::new();
        for (on, name) in [(debug_utils, ext::debug_utils::NAME), (validation_features, ext::validation_features::NAME)]
        {
            if on {
                names.push(name.as_ptr());
            }
        }

        let messages: Box<Messages> = Box::default();
        let application = vk::ApplicationInfo::default()
            .application_name(c"depthleap")
            .engine_name(c"depthleap")
            .api_version(API_VERSION);
        let layers: Vec<_> = layers.iter().map(|name| name.as_ptr()).collect();
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&names);
        let mut messenger_info = messenger_info(&messages);
        let sync = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&sync);
        if validate {
            info = info.push_next(&mut messenger_info).push_next(&mut features);
        }
        // SAFETY: layers and extensions were enumerated above; everything `info` points to outlives the call, and
        // `messages` the instance.
        let raw = unsafe { entry.create_instance(&info, None) }
            .map_err(|code| diagnosed(&entry, failed("vkCreateInstance", "Vulkan instance", code)))?;

        let mut instance = Self { raw, debug_utils, messenger: None, messages, entry };
        if validate {
            let debug = ext::debug_utils::Instance::new(&instance.entry, &instance.raw);
            // SAFETY: the extension is on; the callback's data lives as long as the instance.
            let messenger = unsafe {
                debug.create_debug_utils_messenger(&super::messages::messenger_info(&instance.messages), None)
            }
            .map_err(|code| failed("vkCreateDebugUtilsMessengerEXT", "Vulkan instance", code))?;
            instance.messenger = Some((debug, messenger));
        }
        Ok(Arc::new(instance))
    }

    /// Warnings and errors collected so far, each with its id and the names of the objects it is about. Empty
    /// without validation.
    pub fn messages(&self) -> Vec<String> {
        self.messages.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Whether the validation layer is on.
    pub fn validates(&self) -> bool {
        self.messenger.is_some()
    }

    /// Whether objects can be named and commands labelled.
    pub(super) fn debug_utils(&self) -> bool {
        self.debug_utils
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: devices hold the instance, so none is left; the messenger goes before its instance.
        unsafe {
            if let Some((debug, messenger)) = self.messenger.take() {
                debug.destroy_debug_utils_messenger(messenger, None);
            }
            self.raw.destroy_instance(None);
        }
    }
}

fn extensions(entry: &ash::Entry, layer: Option<&CStr>) -> Result<Vec<std::ffi::CString>> {
    // SAFETY: the loader has been loaded and the layer, if any, was enumerated.
    let found = unsafe { entry.enumerate_instance_extension_properties(layer) }
        .map_err(|code| failed("vkEnumerateInstanceExtensionProperties", "Vulkan loader", code))?;
    Ok(found.iter().filter_map(|one| one.extension_name_as_c_str().ok().map(CStr::to_owned)).collect())
}
