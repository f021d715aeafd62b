//! What `auto` becomes on a device.

use super::runner::Checked;
use crate::auto::{AutoRecord, DeviceFacts, settle as settle_for};
use crate::error::Result;
use crate::frame::{Verdict, culls_late};
use crate::method;
use crate::scene::Scene;

/// Puts a method and its settings in place of `auto`; other scenes stay as they are.
///
/// # Errors
/// When no method draws the scene.
pub fn settle(scene: &mut Scene, checked: Option<&Checked>) -> Result<Option<AutoRecord>> {
    if !scene.settings.method.name.is_auto() {
        return Ok(None);
    }
    settle_for(scene, &checked.map(facts).unwrap_or_default())
}

/// What is known of a device.
fn facts(checked: &Checked) -> DeviceFacts {
    let form = checked.check.automatic(method::NN_OMNI.name());
    let words = form.map(|form| {
        let right = checked.check.forms.get(&form) == Some(&Verdict::Right);
        let verdict = if right { "came out right in its self-check" } else { "is what its self-check leaves" };
        format!("near-neighbor skipping culls by {} here, which {verdict}", form.name())
    });
    DeviceFacts { culls_late: form.and_then(|form| culls_late(&checked.device, form)), form: words }
}
