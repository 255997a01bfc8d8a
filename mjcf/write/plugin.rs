//! Plugins.

use super::text::element;
use crate::spec::{PluginConfig, PluginUse, Spec};
use crate::xml::Element;

pub(super) fn extension(spec: &Spec) -> Element {
    let mut out = element("extension");
    // Instances keep their numbers: a plugin is opened again where one of another comes between.
    let mut open = String::new();
    for instance in &spec.plugins {
        if instance.plugin != open || out.children.is_empty() {
            open.clone_from(&instance.plugin);
            let mut plugin = element("plugin");
            plugin.put("plugin", &open);
            out.children.push(plugin);
        }
        let mut child = element("instance");
        child.put("name", &instance.name);
        put_config(&mut child, &instance.config);
        if let Some(plugin) = out.children.last_mut() {
            plugin.children.push(child);
        }
    }
    for extension in &spec.extensions {
        if spec.plugins.iter().all(|instance| instance.plugin != extension.name) {
            let mut plugin = element("plugin");
            plugin.put("plugin", &extension.name);
            out.children.push(plugin);
        }
    }
    out
}

/// The plugin of an element as its child.
pub(super) fn child(used: Option<&PluginUse>) -> Option<Element> {
    let mut out = element("plugin");
    put_use(&mut out, used?);
    Some(out)
}

/// What names the plugin, on an element that stands for one.
pub(super) fn put_use(out: &mut Element, used: &PluginUse) {
    for (name, text) in [("plugin", &used.plugin), ("instance", &used.instance)] {
        if !text.is_empty() {
            out.put(name, text);
        }
    }
    put_config(out, &used.config);
}

fn put_config(out: &mut Element, config: &PluginConfig) {
    for (key, value) in config {
        let mut child = element("config");
        child.put("key", key);
        child.put("value", value);
        out.children.push(child);
    }
}
