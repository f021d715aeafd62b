//! Opening the device a command runs on, and closing it: what validation said decides how the program ends.

use std::sync::Arc;

use clap::{Args, ValueEnum};

use crate::error::{Error, Result};
use crate::frame::{self, self_check};
use crate::measure::{Checked, CostSource};
use crate::vulkan::{Device, DeviceUse, Instance, pick};

/// Which device, and how it is used.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Device")]
pub struct DeviceOptions {
    /// Device by its index (a whole number) or by a part of its name that no other has, see `depthleap info` [default:
    /// discrete before integrated before CPU]
    #[arg(long, value_name = "INDEX|NAME")]
    device: Option<String>,
    /// Switch the validation layer on, synchronization validation included; a message ends the run with an error
    #[arg(long)]
    validate: bool,
    /// Use one queue for everything, even where there are more
    #[arg(long)]
    single_queue: bool,
    /// How passes that nobody takes part in are left out [default: conditional where the driver has it, else readback]
    #[arg(long, value_name = "WAY")]
    early_end: Option<EarlyEndArgument>,
    /// Compile the shaders from this folder, laid out like glsl/ [default: those built in]
    #[arg(long, value_name = "DIR")]
    glsl: Option<std::path::PathBuf>,
    /// What auto takes work to cost on the device
    #[arg(long, value_name = "FROM", default_value = "measured")]
    costs: CostSource,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum EarlyEndArgument {
    /// Conditional rendering: the device decides
    Conditional,
    /// The count of rays left is read back between batches
    Readback,
    /// Every pass runs, as in the papers
    Never,
}

impl DeviceOptions {
    /// Picks and opens the device; `robust`: see [`DeviceUse`].
    ///
    /// # Errors
    /// When there is no loader, layer or device that will do.
    pub fn open_unchecked(&self, robust: bool) -> Result<Arc<Device>> {
        if let Some(folder) = &self.glsl {
            crate::glsl::set_directory(folder.clone())?;
        }
        let instance = Instance::new(self.validate)?;
        let (info, _) = pick(&instance.devices()?, self.device.as_deref())?;
        Device::open(&instance, &info, DeviceUse { single_queue: self.single_queue, robust })
    }

    /// Picks, opens and checks the device.
    ///
    /// # Errors
    /// As [`DeviceOptions::open_unchecked`].
    pub fn open(&self) -> Result<Checked> {
        self.open_for(false)
    }

    /// The same for scenes with an effect, which may read what is not there.
    ///
    /// # Errors
    /// As [`DeviceOptions::open`].
    pub fn open_for(&self, effect: bool) -> Result<Checked> {
        let device = self.open_unchecked(effect)?;
        let info = &device.info;
        let early_end = self.early_end.map(|way| match way {
            EarlyEndArgument::Conditional => frame::EarlyEnd::Conditional,
            EarlyEndArgument::Readback => frame::EarlyEnd::ReadBack,
            EarlyEndArgument::Never => frame::EarlyEnd::Never,
        });
        if early_end == Some(frame::EarlyEnd::Conditional) && !info.conditional_rendering {
            return Err(Error::device(
                format!("--early-end conditional on {}", info.name),
                "the driver has no conditional rendering",
                "use --early-end readback",
            ));
        }
        let check = self_check(&device)?;
        Ok(Checked { device, check, early_end, costs: self.costs })
    }

    /// Ends the use of a device.
    ///
    /// # Errors
    /// When the validation layer said anything.
    pub fn close(&self, checked: Checked) -> Result<()> {
        let instance = checked.device.instance().clone();
        drop(checked);
        Self::judge(&instance)
    }

    /// What the validation layer said, once all is freed.
    ///
    /// # Errors
    /// When it said anything.
    pub fn judge(instance: &Instance) -> Result<()> {
        let messages = instance.messages();
        match messages.first() {
            None => Ok(()),
            Some(first) => Err(Error::check(
                "validation layer",
                format!("{} message(s), the first: {first}", messages.len()),
                "this is a bug in depthleap or in the shaders that were changed; please report it with the command line",
            )),
        }
    }
}
