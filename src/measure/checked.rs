//! A device that was looked at, and what it is refused for.

use std::sync::Arc;

use clap::ValueEnum;

use crate::error::{Error, Result};
use crate::frame::{EarlyEnd, SelfCheck, Verdict};
use crate::part::form::Form;
use crate::scene::settings::Cull;
use crate::vulkan::Device;

/// A device that was looked at before it is used.
#[derive(Clone)]
pub struct Checked {
    pub device: Arc<Device>,
    pub check: SelfCheck,
    /// How frames end early, where the user says so.
    pub early_end: Option<EarlyEnd>,
    /// What `auto` takes work to cost there.
    pub costs: CostSource,
}

/// Where what work costs on a device is known from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum CostSource {
    /// Frames that are timed there once, which takes some seconds, and kept in the cache
    #[default]
    Measured,
    /// Frames that are timed now, in place of those that were kept
    Again,
    /// The constants that were fitted on lavapipe of Mesa 22.3, alike everywhere
    Fitted,
}

pub(crate) fn no_device() -> Error {
    Error::device("method", "needs a device, and none is open", "open one, or use --method cpu")
}

/// A form that the device has not is refused; one that it does wrongly is run and named.
pub(crate) fn refuse_missing(checked: &Checked, form: Option<Form>) -> Result<()> {
    let missing = form.and_then(|form| match checked.check.forms.get(&form) {
        Some(Verdict::Missing(what)) => Some((form, what)),
        None if form.cull == Cull::Bounds && !checked.device.info.depth_bounds => {
            checked.check.forms.iter().find_map(|(_, v)| match v {
                Verdict::Missing(what) => Some((form, what)),
                _ => None,
            })
        }
        _ => None,
    });
    match missing {
        None => Ok(()),
        Some((form, what)) => Err(Error::device(
            format!("--cull {} --mark {} on {}", form.cull_name(), form.mark_name(), checked.device.info.name),
            what,
            "use --cull ztest --mark copy, or leave both to auto, which takes what the device has",
        )),
    }
}
