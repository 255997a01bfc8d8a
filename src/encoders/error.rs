//! What can go wrong with encoders.

use std::fmt;
use std::path::PathBuf;

/// Names of tensors that a message lists.
const LISTED: usize = 8;

/// Why there is no encoder, or no encoding.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum EncoderError {
    /// No encoder has that name.
    UnknownEncoding {
        /// The name.
        name: String,
        /// Names that there are.
        known: Vec<&'static str>,
    },
    /// A picture has no fitting size.
    Picture {
        /// Rows.
        height: usize,
        /// Columns.
        width: usize,
        /// What is wrong.
        reason: String,
    },
    /// The encoder is a network, and was asked for without weights.
    NeedsWeights {
        /// Which.
        encoding: &'static str,
    },
    /// The encoder has no weights, and was asked for with some.
    TakesNoWeights {
        /// Which.
        encoding: &'static str,
    },
    /// The program was built without the feature `networks`.
    NotBuilt {
        /// What was asked for.
        encoding: &'static str,
    },
    /// No folder has the weights.
    NotFound {
        /// Of which encoder.
        encoding: &'static str,
        /// Files that were looked for.
        searched: Vec<PathBuf>,
        /// What to download and where to put it.
        remedy: String,
    },
    /// The file with the weights cannot be read.
    Weights {
        /// The file.
        path: PathBuf,
        /// What is wrong, and with which tensor.
        reason: String,
    },
    /// The file holds the tensors of another network.
    Mismatch {
        /// The file.
        path: PathBuf,
        /// Tensors that the network needs and the file lacks.
        missing: Vec<String>,
        /// Tensors that the file has and the network does not.
        unexpected: Vec<String>,
        /// Tensors of another shape, each with both.
        misshaped: Vec<String>,
    },
}

/// The first names of a list, and how many more there are.
fn listed(names: &[String]) -> String {
    let mut text = names.iter().take(LISTED).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > LISTED {
        text += &format!(" and {} more", names.len() - LISTED);
    }
    text
}

impl fmt::Display for EncoderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            EncoderError::UnknownEncoding { name, known } => {
                write!(f, "there is no encoder {name:?}; there are {}", known.join(", "))
            }
            EncoderError::Picture { height, width, reason } => {
                write!(f, "a picture of {height} x {width} pixels: {reason}")
            }
            EncoderError::NeedsWeights { encoding } => {
                write!(f, "the encoder {encoding} is a network: load it with its weights")
            }
            EncoderError::TakesNoWeights { encoding } => {
                write!(f, "the encoder {encoding} passes pictures as they are, and has no weights to load")
            }
            EncoderError::NotBuilt { encoding } => {
                write!(f, "the encoder {encoding} needs a build with the feature `networks`")
            }
            EncoderError::NotFound { encoding, searched, remedy } => {
                write!(f, "the weights of {encoding} are in none of these files:")?;
                for path in searched {
                    write!(f, "\n  {}", path.display())?;
                }
                write!(f, "\n{remedy}")
            }
            EncoderError::Weights { path, reason } => write!(f, "{}: {reason}", path.display()),
            EncoderError::Mismatch { path, missing, unexpected, misshaped } => {
                write!(f, "{}: the tensors are not those of the network", path.display())?;
                let lists =
                    [("missing", missing), ("unexpected", unexpected), ("of another shape", misshaped)];
                for (what, names) in lists.into_iter().filter(|(_, names)| !names.is_empty()) {
                    write!(f, "; {what}: {}", listed(names))?;
                }
                Ok(())
            }
        }
    }
}

impl std::error::Error for EncoderError {}
