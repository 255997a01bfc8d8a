//! What a compile reads beside the elements.

use crate::files::FileProvider;
use crate::mesh::stored::MeshStore;
use physics::plugin::Registry;

/// What a compile reads beside the elements.
#[derive(Clone, Copy)]
pub(crate) struct Resources<'a> {
    /// Files of assets.
    pub files: &'a dyn FileProvider,
    /// Processed meshes.
    pub meshes: Option<&'a dyn MeshStore>,
    /// Plugins by name.
    pub registry: &'a Registry,
}
