//! Result codes of Vulkan as errors that name the call and the object.

use ash::vk;

use crate::error::Error;

/// The error of a call that failed on the object of that name.
pub(super) fn failed(call: &str, object: &str, code: vk::Result) -> Error {
    Error::device(object, format!("{call} failed with VK_{code:?}"), remedy(code))
}

/// The error of a device that was lost while it worked at `step`.
pub(super) fn lost(call: &str, object: &str, step: &str) -> Error {
    let code = vk::Result::ERROR_DEVICE_LOST;
    Error::device(object, format!("{call} failed with VK_{code:?}; {step}"), remedy(code))
}

/// The error of a call into this layer that contradicts itself: a fault of the caller, not of the user's input.
pub(super) fn misuse(object: &str, problem: impl ToString) -> Error {
    Error::check(object, problem, "correct the pass that declares it")
}

fn remedy(code: vk::Result) -> &'static str {
    match code {
        vk::Result::ERROR_OUT_OF_DEVICE_MEMORY | vk::Result::ERROR_OUT_OF_HOST_MEMORY => {
            "ask for smaller images, or close what else uses the memory"
        }
        vk::Result::ERROR_DEVICE_LOST => {
            "split the work into shorter passes (a watchdog may have ended it), or update the driver"
        }
        vk::Result::ERROR_INITIALIZATION_FAILED | vk::Result::ERROR_INCOMPATIBLE_DRIVER => {
            "install a Vulkan 1.3 driver (Debian: mesa-vulkan-drivers)"
        }
        _ => "update the driver, or choose another device",
    }
}

/// That there is nothing to choose from.
pub(super) fn no_device() -> Error {
    Error::device(
        "Vulkan",
        "no device found",
        "install a driver (Debian: mesa-vulkan-drivers has one that runs on the CPU)",
    )
}
