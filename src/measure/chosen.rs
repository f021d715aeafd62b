//! What `auto` becomes on a device.

use crate::auto::{AutoRecord, DeviceFacts, settle as settle_for};
use crate::error::Result;
use crate::frame::{SelfCheck, Verdict, culls_late};
use crate::method;
use crate::scene::Scene;
use crate::vulkan::Device;

/// Puts a method and its settings in place of `auto`; other scenes stay as they are.
///
/// # Errors
/// When no method draws the scene.
pub fn settle(scene: &mut Scene, on: Option<(&Device, &SelfCheck)>) -> Result<Option<AutoRecord>> {
    if !scene.settings.method.name.is_auto() {
        return Ok(None);
    }
    settle_for(scene, &on.map(|(device, check)| facts(device, check)).unwrap_or_default())
}

/// What is known of a device.
fn facts(device: &Device, check: &SelfCheck) -> DeviceFacts {
    let form = check.automatic(method::NN_OMNI.name());
    let words = form.map(|form| {
        let right = check.forms.get(&form) == Some(&Verdict::Right);
        let verdict = if right { "came out right in its self-check" } else { "is what its self-check leaves" };
        format!("near-neighbor skipping culls by {} here, which {verdict}", form.name())
    });
    DeviceFacts { culls_late: form.and_then(|form| culls_late(device, form)), form: words }
}
