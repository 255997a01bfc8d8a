//! Plugins that a model uses (XML reference: `extension`, and `plugin` inside other elements).

use super::element::elements;

/// Texts of attributes by name, in the order of the file.
pub type PluginConfig = Vec<(String, String)>;

elements! {
    /// A plugin that the model may use; the name is the plugin's own.
    Extension {}
    /// An instance of a plugin that elements refer to by name.
    PluginInstance {
        /// Name of the plugin.
        plugin: String = String::new(),
        /// Attributes.
        config: PluginConfig = Vec::new(),
        /// Made by a `composite`: it gets its number after those that elements declare in place.
        expanded: bool = false,
    }
    /// The plugin of an element: an instance by name, or one of its own. An element that makes its own has no `name`.
    PluginUse {
        /// Name of the plugin.
        plugin: String = String::new(),
        /// Name of the instance, empty for one of its own.
        instance: String = String::new(),
        /// Attributes of an instance of its own.
        config: PluginConfig = Vec::new(),
    }
}
