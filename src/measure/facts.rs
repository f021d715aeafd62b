//! What is known of a device when a method is chosen for it.

use super::checked::Checked;
use crate::auto::{DeviceFacts, MethodFacts};
use crate::frame::{Verdict, culls_late};
use crate::method::METHODS;
use crate::part::rows::Method;
use crate::plan;
use crate::scene::Scene;
use crate::scene::settings::Cull;

/// What is known of a device, of each method by the form that it would have there; of what work costs nothing.
pub(super) fn facts(scene: &Scene, Checked { device, check, .. }: &Checked) -> DeviceFacts {
    let of = |method: &'static Method| {
        let mut scene = scene.clone();
        scene.settings.method.name = method.name();
        // A form that the method has not is refused later, in words.
        let form = plan::form(&scene, check.automatic(method.name())).ok().flatten()?;
        let verdict = check.forms.get(&form);
        let lacking = form.cull == Cull::Bounds && !device.info.depth_bounds;
        let right = matches!(verdict, Some(Verdict::Right));
        let words = || {
            let found = if right { "came out right in its self-check" } else { "is what its self-check leaves" };
            format!("near-neighbor skipping culls by {} here, which {found}", form.name())
        };
        Some(MethodFacts {
            method: method.name,
            unfit: lacking || matches!(verdict, Some(Verdict::Missing(_) | Verdict::Wrong(_))),
            form: method.marks_sections().then(words),
            culls_late: culls_late(device, form),
        })
    };
    let methods = METHODS.into_iter().filter(|method| method.on_device).filter_map(of).collect();
    DeviceFacts { methods, ..DeviceFacts::default() }
}
