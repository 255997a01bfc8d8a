//! Drivers by the type of interface that a config names.

use super::{Device, Fault};
use crate::config::DeviceConfig;
use std::collections::BTreeMap;

/// Makes a device that is not yet connected.
type Constructor = Box<dyn Fn(&DeviceConfig) -> Result<Box<dyn Device>, Fault> + Send + Sync>;

/// Drivers by the `type` of an interface.
///
/// ```
/// use robohive_robot::{Registry, Replay, Units};
///
/// let mut registry = Registry::default();
/// registry.register("log", |_| Ok(Box::new(Replay::new([], Units::Hardware))));
/// assert_eq!(registry.kinds().collect::<Vec<_>>(), ["log"]);
/// ```
#[derive(Default)]
pub struct Registry {
    constructors: BTreeMap<String, Constructor>,
}

impl Registry {
    /// Drives interfaces of type `kind` with what `constructor` makes; replaces an earlier driver of that type.
    pub fn register(
        &mut self,
        kind: impl Into<String>,
        constructor: impl Fn(&DeviceConfig) -> Result<Box<dyn Device>, Fault> + Send + Sync + 'static,
    ) {
        self.constructors.insert(kind.into(), Box::new(constructor));
    }

    /// Types that there are drivers for, sorted.
    pub fn kinds(&self) -> impl Iterator<Item = &str> {
        self.constructors.keys().map(String::as_str)
    }

    /// A device of this type; `None` when nothing drives it.
    pub(crate) fn device(&self, kind: &str, config: &DeviceConfig) -> Option<Result<Box<dyn Device>, Fault>> {
        Some(self.constructors.get(kind)?(config))
    }
}
