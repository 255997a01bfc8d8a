//! `extension`, and `plugin` inside the elements that use one.

use super::Bind::*;
use super::{ElementType, Kind, Row, Space, any, leaf, required, row, section};
use crate::spec::{Extension, PluginInstance, PluginUse};

/// `extension`.
pub static EXTENSION: ElementType = section("extension", "Plugins that the model uses", &[any(&DECLARATION)]);
static DECLARATION: ElementType =
    leaf("plugin", "A plugin, with instances that elements refer to", &[&EXTENSION_ROWS])
        .children(&[any(&INSTANCE)]);
static INSTANCE: ElementType =
    leaf("instance", "An instance with attributes of its own", &[&INSTANCE_ROWS]).children(&[any(&CONFIG)]);
/// `config`.
pub static CONFIG: ElementType = leaf("config", "An attribute of a plugin", &[&CONFIG_ROWS]);
/// `plugin` inside an element.
pub static PLUGIN: ElementType =
    leaf("plugin", "The plugin of the element: an instance by name, or one of its own", &[&USE_ROWS])
        .children(&[any(&CONFIG)]);

/// Attributes of `plugin` in `extension`.
pub static EXTENSION_ROWS: [Row<Extension>; 1] =
    [required("plugin", Text(|e| &mut e.name), "name of the plugin")];

/// Attributes of `instance`.
pub static INSTANCE_ROWS: [Row<PluginInstance>; 1] =
    [required("name", Name(Space::Plugin, |i| &mut i.name), "name that elements refer to")];

/// Attributes of `plugin` inside an element.
pub static USE_ROWS: [Row<PluginUse>; 2] = [
    row("plugin", Text(|p| &mut p.plugin), "name of the plugin"),
    row("instance", Ref(Space::Plugin, |p| &mut p.instance), "name of an instance"),
];

static CONFIG_ROWS: [Row<()>; 2] = [
    required("key", Own(Kind::Text), "name of the attribute"),
    required("value", Own(Kind::Text), "text of the attribute"),
];
