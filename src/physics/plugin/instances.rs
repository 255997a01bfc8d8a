//! The instances of a model.

use super::{Capability, Config, Instance, Plugin, Registry};
use crate::model::{Arrays, Model};
use std::fmt;
use std::sync::Arc;

/// The plugins of a model at work, one an instance.
#[derive(Clone, Debug, Default)]
pub(crate) struct Instances {
    registry: Registry,
    list: Arc<Vec<Running>>,
}

/// An instance, its kind, and where its state is.
#[derive(Debug)]
pub(crate) struct Running {
    pub kind: Arc<dyn Plugin>,
    pub instance: Box<dyn Instance>,
    pub state: std::ops::Range<usize>,
}

/// Why the plugins of a model cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PluginError {
    /// The instance.
    pub instance: usize,
    /// What is wrong with it.
    pub message: String,
}

impl fmt::Display for PluginError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "plugin instance {}: {}", self.instance, self.message)
    }
}

impl std::error::Error for PluginError {}

impl Running {
    /// Whether it can be asked for `capability`.
    pub fn can(&self, capability: Capability) -> bool {
        self.kind.capabilities().contains(&capability)
    }
}

impl Instances {
    /// Makes the instances of `m` of the plugins in `registry`.
    ///
    /// # Errors
    /// The first instance that cannot be made.
    pub fn new(m: &Model, registry: &Registry) -> Result<Self, PluginError> {
        let mut list = Vec::with_capacity(m.nplugin);
        for id in 0..m.nplugin {
            list.push(make(m, registry, id).map_err(|message| PluginError { instance: id, message })?);
        }
        Ok(Instances { registry: registry.clone(), list: Arc::new(list) })
    }

    /// The plugins that slots count.
    pub fn registry(&self) -> &Registry {
        &self.registry
    }

    /// Names of the kinds of all instances.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.list.iter().map(|running| running.kind.name())
    }

    /// The instances with a capability, with their numbers.
    pub fn with(&self, capability: Capability) -> impl Iterator<Item = (usize, &Running)> {
        self.list.iter().enumerate().filter(move |(_, running)| running.can(capability))
    }

    /// All instances.
    pub fn all(&self) -> &[Running] {
        &self.list
    }

    /// Instance `id`.
    pub fn get(&self, id: i32) -> Option<&Running> {
        self.list.get(usize::try_from(id).ok()?)
    }
}

fn make(m: &Model, registry: &Registry, id: usize) -> Result<Running, String> {
    let slot = m.plugin[id];
    let kind = usize::try_from(slot).ok().and_then(|slot| registry.get(slot));
    let kind = kind.ok_or_else(|| format!("no plugin is registered at place {slot}"))?;
    let config = Config::new(&**kind, attributes(m, id));
    let states = kind.states(&config).map_err(|error| error.to_string())?;
    if i32::try_from(states) != Ok(m.plugin_statenum[id]) {
        return Err(format!("'{}' keeps {states} numbers, not {}", kind.name(), m.plugin_statenum[id]));
    }
    let instance =
        kind.instance(&config, m, id).map_err(|message| format!("'{}': {message}", kind.name()))?;
    let first = m.plugin_stateadr[id] as usize;
    Ok(Running { kind: kind.clone(), instance, state: first..first + states })
}

/// The texts of the attributes of instance `id`.
fn attributes(m: &Arrays, id: usize) -> &[u8] {
    &m.plugin_attr[m.plugin_attradr[id] as usize..]
}
