//! Why plugins are refused.

use std::fmt;

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
