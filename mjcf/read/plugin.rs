//! `extension`, and the plugins of elements.

use super::reader::Reader;
use crate::schema::plugin::{EXTENSION_ROWS, INSTANCE_ROWS, USE_ROWS};
use crate::spec::{Extension, PluginConfig, PluginInstance, PluginUse};
use crate::xml::Element;

impl Reader<'_> {
    pub(super) fn extensions(&mut self, section: &Element) {
        for element in section.children_named("plugin") {
            let mut extension = Extension { loc: element.loc, ..Extension::default() };
            self.rows(element, &EXTENSION_ROWS, &mut extension);
            for child in element.children_named("instance") {
                let plugin = extension.name.clone();
                let mut instance = PluginInstance { loc: child.loc, plugin, ..PluginInstance::default() };
                self.rows(child, &INSTANCE_ROWS, &mut instance);
                instance.config = self.plugin_config(child);
                if instance.name.is_empty() {
                    self.error(child.loc, "an instance needs a name: elements refer to it");
                }
                self.spec.plugins.push(instance);
            }
            if self.spec.extensions.iter().all(|known| known.name != extension.name) {
                self.spec.extensions.push(extension);
            }
        }
    }

    /// The plugin that `element`, a `plugin` or what stands for one, names.
    pub(super) fn plugin_use(&mut self, element: &Element) -> PluginUse {
        let mut used = PluginUse { loc: element.loc, ..PluginUse::default() };
        self.rows(element, &USE_ROWS, &mut used);
        used.config = self.plugin_config(element);
        if used.plugin.is_empty() && used.instance.is_empty() {
            self.error(element.loc, "<plugin> needs the attribute 'plugin' or 'instance'");
        }
        if !used.instance.is_empty() && !used.config.is_empty() {
            used.config.clear();
            let why = "<config> is ignored here: the instance has attributes of its own";
            self.warning(element.loc, why);
        }
        used
    }

    /// The plugin among the children of `parent`, if there is one.
    pub(super) fn child_plugin(&mut self, parent: &Element) -> Option<PluginUse> {
        let mut children = parent.children_named("plugin");
        let first = children.next()?;
        if let Some(second) = children.next() {
            self.error(second.loc, format!("<{}> has <plugin> twice", parent.name));
        }
        Some(self.plugin_use(first))
    }

    /// Gives a plugin without an instance one of its own of this name, which all bodies that are made share.
    pub(super) fn shared_plugin(&mut self, mut used: PluginUse, name: String) -> PluginUse {
        if used.instance.is_empty() {
            used.instance.clone_from(&name);
            self.spec.plugins.push(PluginInstance {
                name,
                loc: used.loc,
                plugin: used.plugin.clone(),
                config: std::mem::take(&mut used.config),
                expanded: true,
            });
        }
        used
    }

    fn plugin_config(&mut self, element: &Element) -> PluginConfig {
        let mut config = PluginConfig::new();
        for child in element.children_named("config") {
            let key = child.value("key").unwrap_or_default();
            if config.iter().any(|(known, _)| known == key) {
                self.error(child.loc, format!("<config> sets '{key}' twice"));
            }
            let value = child.value("value").unwrap_or_default();
            if value.trim().is_empty() {
                // MuJoCo takes it for one that is not given, and for a number that is 0.
                let message = format!("<config> gives '{key}' no value: write one, or remove <config>");
                self.error(child.loc, message);
            }
            config.push((key.to_owned(), value.to_owned()));
        }
        config
    }
}
