//! What the folders of robots list.

use workshop::Mesh;

/// A mesh: the name of its file, without the ending, and what makes it.
pub(crate) type Shape = (&'static str, fn() -> Mesh);
