//! What an experiment is given by whoever runs it.

use crate::error::Result;
use crate::measure::Checked;

pub struct Host<'a> {
    /// Opens the device, when it is needed.
    pub open: &'a dyn Fn() -> Result<Checked>,
    /// Ends its use; an error where validation said anything.
    pub close: &'a dyn Fn(Checked) -> Result<()>,
    /// Hears what is being done.
    pub say: &'a dyn Fn(&str),
}
