//! What `auto` becomes on a device.

use std::cell::RefCell;

use super::checked::Checked;
use super::costs;
use super::facts::facts;
use crate::auto::{AutoRecord, DeviceFacts, is_asked, settle as settle_for};
use crate::error::Result;
use crate::scene::Scene;
use crate::scene::settings::Settings;

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
    pub fn settle(&self, scene: &mut Scene, on: Option<&Checked>) -> Result<Option<AutoRecord>> {
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

fn settle(scene: &mut Scene, on: Option<&Checked>) -> Result<Option<AutoRecord>> {
    if !is_asked(&scene.settings) {
        return Ok(None);
    }
    let of_device = |checked: &Checked| {
        let mut facts = facts(scene, checked);
        facts.costs = costs::of(checked)?;
        Ok(facts)
    };
    let facts: Option<DeviceFacts> = on.map(of_device).transpose()?;
    settle_for(scene, &facts.unwrap_or_default())
}
