//! What the loader, drivers and the validation layer say, collected as lines.

use std::ffi::{CStr, c_void};
use std::sync::{Mutex, PoisonError};

use ash::vk;

use super::suppressed::SUPPRESSED;

/// Messages kept; a barrier left out can bring one for every draw.
const MAX_MESSAGES: usize = 1000;

pub(super) type Messages = Mutex<Vec<String>>;

/// Warnings and errors about validity and in general; performance advice is for another tool.
pub(super) fn messenger_info(messages: &Messages) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    use vk::{DebugUtilsMessageSeverityFlagsEXT as Severity, DebugUtilsMessageTypeFlagsEXT as Type};
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(Severity::WARNING | Severity::ERROR)
        .message_type(Type::GENERAL | Type::VALIDATION)
        .pfn_user_callback(Some(collect))
        .user_data(std::ptr::from_ref(messages).cast_mut().cast())
}

unsafe extern "system" fn collect(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    messages: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the specification promises valid callback data; `messages` is the box that `messenger_info` was
    // given, which outlives the instance.
    let (data, messages) = unsafe { (&*data, &*messages.cast::<Messages>()) };
    // SAFETY: strings of the callback data are null or end with a zero.
    let text = |string: *const std::ffi::c_char| match string.is_null() {
        true => String::new(),
        false => unsafe { CStr::from_ptr(string) }.to_string_lossy().into_owned(),
    };
    let id = text(data.p_message_id_name);
    if SUPPRESSED.iter().any(|(suppressed, _)| *suppressed == id) {
        return vk::FALSE;
    }
    let mut line = format!("{id}: {}", text(data.p_message));
    let objects = match data.p_objects.is_null() {
        true => &[],
        // SAFETY: the callback data says how many objects there are.
        false => unsafe { std::slice::from_raw_parts(data.p_objects, data.object_count as usize) },
    };
    let names: Vec<_> =
        objects.iter().map(|object| text(object.p_object_name)).filter(|name| !name.is_empty()).collect();
    if !names.is_empty() {
        line += &format!(" [{}]", names.join(", "));
    }
    let mut messages = messages.lock().unwrap_or_else(PoisonError::into_inner);
    if messages.len() < MAX_MESSAGES {
        messages.push(line);
    }
    vk::FALSE
}
