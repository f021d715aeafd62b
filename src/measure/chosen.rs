//! What `auto` becomes on a device.

use std::cell::RefCell;

use crate::auto::{AutoRecord, DeviceFacts, MethodFacts, is_asked, settle as settle_for};
use crate::error::Result;
use crate::frame::{SelfCheck, Verdict, culls_late};
use crate::method::METHODS;
use crate::part::rows::Method;
use crate::plan;
use crate::scene::Scene;
use crate::scene::settings::{Cull, Settings};
use crate::vulkan::Device;

/// What was chosen for the scenes of a run: settings as they were asked for and as they became, and why. An error that is asked for takes
/// a look of its time.
#[derive(Default)]
pub struct Settled(RefCell<Vec<(Settings, Settings, AutoRecord)>>);

impl Settled {
    /// Puts a method and its settings in place of `auto`, and steps that meet an error, once for the same settings; other scenes stay as they
    /// are.
    ///
    /// # Errors
    /// When no method draws the scene, or no step meets the error.
    pub fn settle(&self, scene: &mut Scene, on: Option<(&Device, &SelfCheck)>) -> Result<Option<AutoRecord>> {
        let known = |(asked, ..): &&(Settings, Settings, AutoRecord)| *asked == scene.settings;
        let found = self.0.borrow().iter().find(known).cloned();
        if let Some((_, settings, record)) = found {
            scene.settings = settings;
            return Ok(Some(record));
        }
        let asked = scene.settings.clone();
        let record = settle(scene, on)?;
        let chosen = record.clone().map(|record| (asked, scene.settings.clone(), record));
        self.0.borrow_mut().extend(chosen);
        Ok(record)
    }
}

fn settle(scene: &mut Scene, on: Option<(&Device, &SelfCheck)>) -> Result<Option<AutoRecord>> {
    if !is_asked(&scene.settings) {
        return Ok(None);
    }
    let facts = on.map(|(device, check)| facts(scene, device, check));
    settle_for(scene, &facts.unwrap_or_default())
}

/// What is known of a device, of each method by the form that it would have there.
fn facts(scene: &Scene, device: &Device, check: &SelfCheck) -> DeviceFacts {
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
    DeviceFacts { methods: METHODS.into_iter().filter(|method| method.on_device).filter_map(of).collect() }
}
