//! Work that may never end: how long it is waited for, and what becomes of a device whose work did not end.
//!
//! Nothing stops a shader that loops for ever but a driver's watchdog, which many drivers lack. Work that was given up may run on, so
//! that all it uses stays as it is until the process goes, and the process has to go without the drivers' own ends, which would wait
//! for that work.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::error::Error;

/// How long the work of a device may take, and what is to be done where it takes longer or the device is lost over it.
#[derive(Clone, Debug, PartialEq)]
pub struct Watch {
    pub limit: Duration,
    /// What is suspected and what to do, as an instruction.
    pub remedy: String,
}

/// Whether the work of any device was given up.
static ANY: AtomicBool = AtomicBool::new(false);

/// What watches over a device.
#[derive(Default)]
pub(super) struct Watched {
    watch: Mutex<Option<Watch>>,
    given_up: AtomicBool,
}

impl Watched {
    pub fn set(&self, watch: Option<Watch>) {
        *self.lock() = watch;
    }

    /// Nanoseconds that the host waits; the greatest number stands for as long as it takes.
    pub fn nanoseconds(&self) -> u64 {
        self.lock().as_ref().map_or(u64::MAX, |watch| u64::try_from(watch.limit.as_nanos()).unwrap_or(u64::MAX))
    }

    /// The error with what is suspected, where anything is.
    pub fn suspected(&self, error: Error) -> Error {
        match &*self.lock() {
            Some(watch) => Error { remedy: watch.remedy.clone(), ..error },
            None => error,
        }
    }

    /// Gives up the work of that name: the error to end with.
    pub fn give_up(&self, name: &str, step: &str) -> Error {
        self.given_up.store(true, Ordering::Relaxed);
        ANY.store(true, Ordering::Relaxed);
        let seconds = self.lock().as_ref().map_or(0.0, |watch| watch.limit.as_secs_f64());
        let problem = format!("did not end within {seconds} s and is given up; {step}");
        self.suspected(Error::device(name, problem, "update the driver, or choose another device"))
    }

    /// Whether work of the device was given up, which may run on.
    pub fn has_given_up(&self) -> bool {
        self.given_up.load(Ordering::Relaxed)
    }

    fn lock(&self) -> MutexGuard<'_, Option<Watch>> {
        self.watch.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Whether the work of any device was given up, so that the process has to end by [`exit_at_once`].
pub fn gave_up() -> bool {
    ANY.load(Ordering::Relaxed)
}

/// Ends the process without what libraries do at its end: threads of a driver that run a shader for ever would be waited for.
pub fn exit_at_once(code: u8) -> ! {
    // SAFETY: it is the C library's, takes any number and does not come back.
    unsafe extern "C" {
        safe fn _exit(code: i32) -> !;
    }
    _exit(code.into())
}

#[cfg(test)]
mod tests {
    use super::{Duration, Error, Watch, Watched};

    fn watched() -> Watched {
        let watched = Watched::default();
        watched.set(Some(Watch { limit: Duration::from_millis(1500), remedy: "look at x.glsl".to_owned() }));
        watched
    }

    #[test]
    fn without_a_watch_the_host_waits_as_long_as_it_takes() {
        assert_eq!(Watched::default().nanoseconds(), u64::MAX);
        assert_eq!(watched().nanoseconds(), 1_500_000_000);
    }

    #[test]
    fn a_lost_device_comes_with_the_suspect() {
        let lost = || Error::device("frame", "was lost", "update the driver");
        assert_eq!(watched().suspected(lost()).remedy, "look at x.glsl");
        assert_eq!(Watched::default().suspected(lost()), lost());
    }
}
