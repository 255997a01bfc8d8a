//! Plugins: the instances that elements declare in place get numbers, attributes become bytes, and what a plugin must tell
//! before the model exists is asked for.
//!
//! Instances are numbered in this order: those with names, of meshes, of actuators, of sensors, of the tree of bodies, made by
//! composites.

use super::log::{Log, title};
use super::values::bounded;
use crate::diagnostic::Loc;
use crate::spec::{Body, PluginConfig, PluginInstance, PluginUse, Spec};
use physics::model::Rows;
use physics::plugin::{Capability, Config, Plugin, Registry};
use std::collections::BTreeMap;
use std::sync::Arc;

/// All instances of a model.
pub(super) struct Plugins {
    pub list: Vec<Compiled>,
    /// Ids by the address of the element that declares an instance in place.
    in_place: BTreeMap<*const PluginUse, usize>,
    by_name: BTreeMap<String, usize>,
}

/// One instance.
pub(super) struct Compiled {
    pub name: String,
    pub loc: Loc,
    slot: usize,
    kind: Arc<dyn Plugin>,
    /// Texts of the attributes in order of declaration, each ended by a zero byte.
    bytes: Vec<u8>,
}

impl Compiled {
    /// The plugin and the attributes of the instance.
    pub(super) fn config(&self) -> (&dyn Plugin, Config<'_>) {
        (&*self.kind, Config::new(self.kind.attributes(), &self.bytes))
    }
}

/// What is declared in place, in the order of numbers.
fn declared_in_place(spec: &Spec) -> Vec<&PluginUse> {
    let mut all: Vec<&PluginUse> = spec.meshes.iter().filter_map(|m| m.plugin.as_ref()).collect();
    all.extend(spec.actuators.iter().filter_map(|a| a.plugin.as_ref()));
    all.extend(spec.sensors.iter().filter_map(|s| s.plugin.as_ref()));
    let mut pending: Vec<&Body> = vec![&spec.world];
    while let Some(body) = pending.pop() {
        all.extend(&body.plugin);
        all.extend(body.geoms.iter().filter_map(|g| g.plugin.as_ref()));
        pending.extend(body.bodies.iter().rev());
    }
    all.retain(|used| used.instance.is_empty());
    all
}

/// Checks plugins and attributes against `registry`.
pub(super) fn compile(spec: &Spec, registry: &Registry, log: &mut Log) -> Plugins {
    for extension in &spec.extensions {
        if registry.slot(&extension.name).is_none() {
            let near = log.diagnostics.nearest(&extension.name, registry.names());
            let advice = match near {
                Some(near) => format!("did you mean '{near}'?"),
                None => "plugins of your own are registered with the loader".to_owned(),
            };
            let message = format!("there is no plugin '{}'", extension.name);
            log.error_with(extension.loc, message, Some(advice));
        }
    }
    let mut plugins = Plugins { list: Vec::new(), in_place: BTreeMap::new(), by_name: BTreeMap::new() };
    let named = |expanded: bool| spec.plugins.iter().filter(move |p| p.expanded == expanded);
    named(false).for_each(|instance| plugins.add_named(instance, spec, registry, log));
    for used in declared_in_place(spec) {
        if let Some(mut one) = instance((&used.plugin, &used.config, used.loc), spec, registry, log) {
            one.name.clone_from(&used.name);
            plugins.in_place.insert(used, plugins.list.len());
            plugins.list.push(one);
        }
    }
    named(true).for_each(|instance| plugins.add_named(instance, spec, registry, log));
    plugins
}

/// Finds the plugin of an instance and lays out its attributes.
fn instance(
    (plugin, config, loc): (&str, &PluginConfig, Loc),
    spec: &Spec,
    registry: &Registry,
    log: &mut Log,
) -> Option<Compiled> {
    if spec.extensions.iter().all(|extension| extension.name != plugin) {
        let message = format!("plugin '{plugin}' is not declared");
        let advice = format!("add <extension><plugin plugin=\"{plugin}\"/></extension>");
        log.error_with(loc, message, Some(advice));
        return None;
    }
    // What is declared and not registered has been reported.
    let slot = registry.slot(plugin)?;
    let kind = registry.get(slot)?.clone();
    for (key, value) in config {
        if !kind.attributes().contains(&&**key) {
            let near = log.diagnostics.nearest(key, kind.attributes().iter().copied());
            let advice = near.map(|near| format!("did you mean '{near}'?"));
            log.error_with(loc, format!("plugin '{plugin}' has no attribute '{key}'"), advice);
            return None;
        }
        if value.contains('\0') {
            log.error(loc, format!("attribute '{key}' of plugin '{plugin}' holds a zero byte"));
            return None;
        }
    }
    let mut bytes = Vec::new();
    for attribute in kind.attributes() {
        let given = config.iter().find(|(key, _)| key == attribute);
        bytes.extend(given.map_or("", |(_, value)| value).bytes());
        bytes.push(0);
    }
    if kind.attributes().is_empty() {
        bytes.push(0);
    }
    Some(Compiled { name: String::new(), loc, slot, kind, bytes })
}

impl Plugins {
    fn add_named(&mut self, named: &PluginInstance, spec: &Spec, registry: &Registry, log: &mut Log) {
        let found = instance((&named.plugin, &named.config, named.loc), spec, registry, log);
        if self.by_name.contains_key(&named.name) {
            log.error(named.loc, format!("repeated name: {}", title("plugin instance", &named.name)));
        }
        if let Some(mut one) = found {
            one.name.clone_from(&named.name);
            self.by_name.insert(named.name.clone(), self.list.len());
            self.list.push(one);
        }
    }

    /// Id of the instance that an element uses, which must have a capability; -1, with an error, when it is missing.
    pub(super) fn id(
        &self,
        used: Option<&PluginUse>,
        (capability, what): (Capability, &str),
        log: &mut Log,
    ) -> i32 {
        let Some(used) = used else { return -1 };
        match self.find(used, capability, log) {
            Ok(id) => id as i32,
            Err(message) => {
                if let Some((message, advice)) = message {
                    log.error_with(used.loc, format!("{what}: {message}"), advice);
                }
                -1
            }
        }
    }

    /// The instance that an element uses; `None` for an error that has been reported.
    fn find(
        &self,
        used: &PluginUse,
        capability: Capability,
        log: &mut Log,
    ) -> Result<usize, Option<(String, Option<String>)>> {
        let id = if used.instance.is_empty() {
            self.in_place.get(&std::ptr::from_ref(used)).copied().ok_or(None)?
        } else {
            self.by_name.get(&used.instance).copied().ok_or_else(|| {
                let near = log.diagnostics.nearest(&used.instance, self.by_name.keys().map(String::as_str));
                let advice = near.map(|near| format!("did you mean '{near}'?"));
                Some((format!("there is no plugin instance '{}'", used.instance), advice))
            })?
        };
        let (kind, _) = self.list[id].config();
        let name = kind.name();
        if !used.plugin.is_empty() && used.plugin != name {
            let message =
                format!("instance '{}' is one of '{name}', not of '{}'", used.instance, used.plugin);
            return Err(Some((message, Some("remove the attribute 'plugin', or correct it".into()))));
        }
        if !kind.capabilities().contains(&capability) {
            let message = match capability {
                Capability::Actuator => format!("plugin '{name}' drives no actuators"),
                Capability::Sensor => format!("plugin '{name}' reads no sensors"),
                Capability::Sdf => format!("plugin '{name}' is no signed distance field"),
                _ => format!("plugin '{name}' makes no passive forces"),
            };
            return Err(Some((message, None)));
        }
        Ok(id)
    }

    /// Appends the rows of the instances.
    pub(super) fn fill(&self, m: &mut Rows, log: &mut Log) {
        for one in &self.list {
            let (kind, config) = one.config();
            let what = title("plugin instance", &one.name);
            let states = kind
                .states(&config)
                .map_err(|error| error.to_string())
                .and_then(|n| bounded((m.npluginstate + n) as i64, "its state").map(|_| n));
            let states = log.check(one.loc, &what, states).unwrap_or_default();
            m.plugin.push(one.slot as i32);
            m.plugin_stateadr.push(m.npluginstate as i32);
            m.plugin_statenum.push(states as i32);
            m.npluginstate += states;
            m.plugin_attradr.push(m.plugin_attr.len() as i32);
            m.plugin_attr.extend(&one.bytes);
        }
    }
}
