//! The plugins that a program knows.

use super::{Capability, Plugin, cable, pid, sdf, touch_grid};
use crate::model::Stage;
use std::fmt;
use std::sync::{Arc, OnceLock};

/// Plugins by name. The numbers in [`Arrays::plugin`](crate::model::Arrays) are places in it; the default has MuJoCo's
/// own.
#[derive(Clone, Debug)]
pub struct Registry {
    plugins: Arc<Vec<Arc<dyn Plugin>>>,
}

/// Why a plugin was not registered.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RegistryError {
    /// Another one has the name.
    Taken(String),
    /// The name is empty, or it or an attribute holds a zero byte.
    Name(String),
    /// It has sensors and names no stage to read them in.
    Stage(String),
}

impl fmt::Display for RegistryError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RegistryError::Taken(name) => write!(f, "a plugin '{name}' is registered already"),
            RegistryError::Name(name) => {
                write!(f, "plugin '{name}': its name and attributes must be texts without zero bytes")
            }
            RegistryError::Stage(name) => {
                write!(f, "plugin '{name}' has sensors: its stage must be Pos, Vel or Acc")
            }
        }
    }
}

impl std::error::Error for RegistryError {}

impl Default for Registry {
    fn default() -> Self {
        static BUILT_IN: OnceLock<Registry> = OnceLock::new();
        BUILT_IN.get_or_init(built_in).clone()
    }
}

/// MuJoCo's plugins, in the order in which its Python package registers them.
fn built_in() -> Registry {
    let plugins: Vec<Arc<dyn Plugin>> = vec![
        Arc::new(pid::Pid),
        Arc::new(cable::Cable),
        Arc::new(touch_grid::TouchGrid),
        Arc::new(sdf::Bolt),
        Arc::new(sdf::Bowl),
        Arc::new(sdf::Gear),
        Arc::new(sdf::Nut),
        Arc::new(sdf::Torus),
    ];
    Registry { plugins: Arc::new(plugins) }
}

impl Registry {
    /// Adds a plugin.
    ///
    /// # Errors
    /// Its name is taken, or its declaration makes no sense.
    pub fn register(&mut self, plugin: impl Plugin + 'static) -> Result<(), RegistryError> {
        let name = plugin.name().to_owned();
        if self.slot(&name).is_some() {
            return Err(RegistryError::Taken(name));
        }
        if name.is_empty() || name.contains('\0') || plugin.attributes().iter().any(|a| a.contains('\0')) {
            return Err(RegistryError::Name(name));
        }
        if plugin.capabilities().contains(&Capability::Sensor) && plugin.stage() == Stage::None {
            return Err(RegistryError::Stage(name));
        }
        Arc::make_mut(&mut self.plugins).push(Arc::new(plugin));
        Ok(())
    }

    /// The place of the plugin called `name`.
    pub fn slot(&self, name: &str) -> Option<usize> {
        self.plugins.iter().position(|p| p.name() == name)
    }

    /// The plugin at a place.
    pub fn get(&self, slot: usize) -> Option<&Arc<dyn Plugin>> {
        self.plugins.get(slot)
    }

    /// The names of all plugins.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.plugins.iter().map(|p| p.name())
    }
}
