//! Why a command did not succeed.

use record::RecordError;
use std::fmt;
use std::path::Path;

/// Why a command did not succeed: the text for standard error, unless all is said, and the exit code.
pub struct Failure {
    /// The text for standard error.
    pub message: Option<String>,
    /// The exit code.
    pub code: u8,
}

impl Failure {
    /// The command could not do its work: exit code 1.
    pub fn new(message: impl fmt::Display) -> Self {
        Failure { message: Some(message.to_string()), code: 1 }
    }

    /// The arguments or input files are wrong: exit code 2.
    pub fn usage(message: impl fmt::Display) -> Self {
        Failure { message: Some(message.to_string()), code: 2 }
    }

    /// The output has said why.
    pub fn silent(code: u8) -> Self {
        Failure { message: None, code }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message.as_deref().unwrap_or_default())
    }
}

impl From<RecordError> for Failure {
    /// What the file or the arguments leave open is wrong input; the rest could not be done.
    fn from(error: RecordError) -> Self {
        match error {
            RecordError::Trace(error) => Failure::new(error),
            RecordError::Env(_) | RecordError::Description(_) => Failure::usage(error),
        }
    }
}

/// A file that cannot be written.
pub fn unwritable(path: &Path) -> impl Fn(std::io::Error) -> Failure {
    move |error| Failure::new(format!("{}: {error}", path.display()))
}
