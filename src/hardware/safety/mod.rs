//! What stands between a command and a device.

pub(crate) mod limits;
pub(crate) mod lock;
pub(crate) mod motion;
pub(crate) mod watchdog;
