//! What can be written of a model and its state.

use super::source::Source;
use crate::session::Session;
use crate::text;

/// Something to write: its name, the file that it makes, and the contents.
pub(super) struct Export {
    /// What a menu calls it.
    pub(super) name: &'static str,
    /// The name of the file, if it is free.
    pub(super) file: &'static str,
    /// Its contents.
    ///
    /// # Errors
    /// What cannot be written, and why.
    pub(super) contents: fn(&Source, &Session) -> Result<Vec<u8>, String>,
}

/// All that can be written.
pub(super) const EXPORTS: [Export; 5] = [
    Export {
        name: "Save as MJCF",
        file: "model.xml",
        contents: |source, _| source.mjcf().map(String::into_bytes),
    },
    Export {
        name: "Save compiled",
        file: "model.rhm",
        contents: |_, session| Ok(session.model().to_bytes()),
    },
    Export {
        name: "Print model",
        file: "model.txt",
        contents: |_, session| Ok(text::arrays(session.model(), None).into_bytes()),
    },
    Export {
        name: "Print data",
        file: "data.txt",
        contents: |_, session| Ok(text::arrays(session.model(), Some(session.data())).into_bytes()),
    },
    Export {
        name: "Save kept states",
        file: "keyframes.xml",
        contents: |_, session| match session.kept_keys().len() {
            0 => Err("no states are kept: keep some under Simulation".to_owned()),
            _ => Ok(session.keys_text().into_bytes()),
        },
    },
];
