//! A raw handle with its owner's duty.

use std::any::Any;
use std::sync::Arc;

use super::device::Device;

/// Whatever a recording has to keep alive.
pub(super) type Kept = Arc<dyn Any + Send + Sync>;

/// How one kind of handle is destroyed.
type Destroy<T> = fn(&ash::Device, T);

/// A handle that is destroyed with its last owner, before the device it was made on.
pub(super) struct Owned<T: Copy> {
    pub raw: T,
    pub device: Arc<Device>,
    destroy: Destroy<T>,
}

impl<T: Copy> Owned<T> {
    /// Takes over `raw`; `destroy` is called once, when nothing uses the handle any more.
    pub fn new(device: &Arc<Device>, raw: T, destroy: Destroy<T>) -> Arc<Self> {
        Arc::new(Self { raw, device: device.clone(), destroy })
    }
}

impl<T: Copy> Drop for Owned<T> {
    fn drop(&mut self) {
        (self.destroy)(&self.device.raw, self.raw);
    }
}
