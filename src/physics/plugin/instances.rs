//! Makes the instances of a model.

use crate::model::{Arrays, Config, Instances, Model, PluginError, Registry, Running};

impl Model {
    /// Makes the instances of the plugins in `registry` that the arrays name, in place of those before.
    ///
    /// # Errors
    /// The first instance that cannot be made; those before stay.
    #[doc(hidden)]
    pub fn start_plugins(&mut self, registry: &Registry) -> Result<(), PluginError> {
        self.plugins = Instances::new(self, registry)?;
        Ok(())
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
        Ok(Instances::of(registry.clone(), list))
    }
}

fn make(m: &Model, registry: &Registry, id: usize) -> Result<Running, String> {
    let slot = m.plugin[id];
    let kind = usize::try_from(slot).ok().and_then(|slot| registry.get(slot));
    let kind = kind.ok_or_else(|| format!("no plugin is registered at place {slot}"))?;
    let config = Config::new(kind.attributes(), attributes(m, id));
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
