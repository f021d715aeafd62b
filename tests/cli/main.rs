//! The command line where no device is needed: no test here finds a driver, so that what passes is decided before one is
//! looked for.

mod effects;
mod input;
mod options;
mod output;
mod polygons;
mod program;
mod report;
mod shells;
mod volume;

use program::Place;

const SMALL: &str = "render builtin:shells:16 --viewport 12x8 --method cpu";

/// A place without any Vulkan driver.
fn driverless() -> Place {
    let mut place = Place::new();
    place.driverless = true;
    place
}
