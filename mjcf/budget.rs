//! How much memory a text may ask for: what it asks for is added up before it is allocated.

use crate::diagnostic::{Diagnostics, Loc, Sources};

/// Bytes of an element, read from a text or copied, with the node of the tree and the object made of it.
pub(crate) const ELEMENT: usize = 1024;

/// Bytes of an attribute in the tree.
pub(crate) const ATTRIBUTE: usize = 192;

/// What an asset's bytes are.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Content {
    Mesh,
    Texture,
    Hfield,
    Skin,
}

/// Bytes asked for so far.
#[derive(Debug, Clone)]
pub(crate) struct Budget {
    limit: usize,
    asked: usize,
}

impl Budget {
    pub(crate) fn new(limit: usize) -> Self {
        Budget { limit, asked: 0 }
    }

    /// Bytes that may still be asked for.
    pub(crate) fn left(&self) -> usize {
        self.limit - self.asked
    }

    /// Adds `bytes` that `what` asks for.
    ///
    /// # Errors
    /// The sum is beyond the limit; nothing is added.
    pub(crate) fn take(&mut self, what: &str, bytes: usize) -> Result<(), String> {
        if bytes <= self.left() {
            self.asked += bytes;
            return Ok(());
        }
        let megabytes = |bytes: usize| bytes.div_ceil(1_000_000);
        Err(format!(
            "{what}: needs {} MB of memory, {} MB with what stands before, more than the budget of {} MB",
            megabytes(bytes),
            megabytes(bytes.saturating_add(self.asked)),
            self.limit / 1_000_000
        ))
    }

    /// As `take`; the error is reported at `loc` with the way to raise the limit, and false comes back.
    pub(crate) fn charge(
        &mut self,
        sources: &Sources,
        diagnostics: &mut Diagnostics,
        loc: Loc,
        (what, bytes): (&str, usize),
    ) -> bool {
        let result = self.take(what, bytes);
        if let Err(message) = &result {
            diagnostics.error_with(sources, loc, message, Some(ADVICE.into()));
        }
        result.is_ok()
    }
}

/// How to raise the limit.
pub(crate) const ADVICE: &str =
    "if it is meant, raise `memory` in the limits of the `Loader`, or give the command `--memory`";

/// Bytes that the content of a file takes, decoded and in the arrays of the model.
pub(crate) fn decoded(content: Content, bytes: &[u8]) -> usize {
    let pixels = || {
        let word = |at: usize| Some(u32::from_be_bytes(*bytes.get(at..)?.first_chunk()?) as usize);
        word(16)?.checked_mul(word(20)?)
    };
    let png = bytes.starts_with(b"\x89PNG");
    match content {
        Content::Mesh => bytes.len().saturating_mul(4),
        // Up to four channels, or a number of four bytes; in the asset and in the model.
        _ if png => pixels().unwrap_or(usize::MAX).saturating_mul(8),
        Content::Texture | Content::Hfield | Content::Skin => bytes.len().saturating_mul(2),
    }
}
