//! What a source may ask for, so that a hostile archive ends in an error.

use std::cell::Cell;
use std::fmt;
use std::io::{self, Read};
use std::rc::Rc;

/// Unpacked bytes that are free of the ratio: the smallest archives are mostly padding.
const SLACK: u64 = 8 << 20;

/// Bounds of what an import reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Limits {
    /// Unpacked bytes of all entries together, those that are skipped included.
    pub bytes: u64,
    /// Entries, folders included.
    pub files: u64,
    /// Unpacked bytes for each byte of an archive, beyond the first 8 MiB.
    pub ratio: u64,
    /// Bytes of a path.
    pub path: u64,
    /// Folders in a path, the file itself included.
    pub depth: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { bytes: 4 << 30, files: 200_000, ratio: 250, path: 512, depth: 32 }
    }
}

impl Limits {
    /// Unpacked bytes of all entries together.
    #[must_use]
    pub fn with_bytes(mut self, bytes: u64) -> Self {
        self.bytes = bytes;
        self
    }

    /// Entries, folders included.
    #[must_use]
    pub fn with_files(mut self, files: u64) -> Self {
        self.files = files;
        self
    }

    /// Unpacked bytes for each byte of an archive, beyond the first 8 MiB.
    #[must_use]
    pub fn with_ratio(mut self, ratio: u64) -> Self {
        self.ratio = ratio;
        self
    }

    /// Bytes of a path.
    #[must_use]
    pub fn with_path(mut self, path: u64) -> Self {
        self.path = path;
        self
    }

    /// Folders in a path, the file itself included.
    #[must_use]
    pub fn with_depth(mut self, depth: u64) -> Self {
        self.depth = depth;
        self
    }

    /// Sets the limit called `name`; false when there is none.
    pub fn set(&mut self, name: &str, value: u64) -> bool {
        let limit = match name {
            "bytes" => &mut self.bytes,
            "files" => &mut self.files,
            "ratio" => &mut self.ratio,
            "path" => &mut self.path,
            "depth" => &mut self.depth,
            _ => return false,
        };
        *limit = value;
        true
    }
}

/// A limit that was passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Exceeded {
    pub limit: &'static str,
    pub value: u64,
}

impl fmt::Display for Exceeded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "more than the limit {}={} allows", self.limit, self.value)
    }
}

impl std::error::Error for Exceeded {}

/// A number of bytes that readers share.
pub(crate) type Count = Rc<Cell<u64>>;

/// Counts what is read.
pub(crate) struct Counted<R> {
    pub inner: R,
    pub count: Count,
}

impl<R: Read> Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let n = self.inner.read(buffer)?;
        self.count.set(self.count.get() + n as u64);
        Ok(n)
    }
}

/// Fails once more is read than the limits allow; the error holds an [`Exceeded`].
pub(crate) struct Bounded<R> {
    pub inner: R,
    pub limits: Limits,
    /// Unpacked bytes of the whole import.
    pub unpacked: Count,
    /// Bytes of the archive that this reader's bytes came from; none without compression.
    pub packed: Option<Count>,
    /// Bytes that went through this reader.
    pub own: u64,
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let n = self.inner.read(buffer)?;
        self.own += n as u64;
        self.unpacked.set(self.unpacked.get().saturating_add(n as u64));
        let exceeded = |limit, value| Err(io::Error::other(Exceeded { limit, value }));
        let Limits { bytes, ratio, .. } = self.limits;
        if self.unpacked.get() > bytes {
            return exceeded("bytes", bytes);
        }
        let packed = self.packed.as_ref().map(|packed| packed.get().saturating_mul(ratio));
        if packed.is_some_and(|allowed| self.own > allowed.saturating_add(SLACK)) {
            return exceeded("ratio", ratio);
        }
        Ok(n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounded(limits: Limits, packed: u64, length: usize) -> io::Result<usize> {
        let (unpacked, packed) = (Count::default(), Rc::new(Cell::new(packed)));
        let inner = io::repeat(0).take(length as u64);
        let mut reader = Bounded { inner, limits, unpacked, packed: Some(packed), own: 0 };
        reader.read_to_end(&mut Vec::new())
    }

    #[test]
    fn what_is_within_the_limits_passes() {
        let limits = Limits { bytes: 20 << 20, ..Limits::default() };
        assert_eq!(bounded(limits, 1 << 20, 20 << 20).unwrap(), 20 << 20);
    }

    #[test]
    fn bytes_and_ratio_are_bounded() {
        let name = |error: io::Error| error.into_inner().unwrap().downcast::<Exceeded>().unwrap().limit;
        let limits = Limits { bytes: 1000, ..Limits::default() };
        assert_eq!(name(bounded(limits, 1 << 20, 1001).unwrap_err()), "bytes");
        let limits = Limits { ratio: 10, ..Limits::default() };
        assert_eq!(bounded(limits, 100, (8 << 20) + 1000).unwrap(), (8 << 20) + 1000);
        assert_eq!(name(bounded(limits, 100, (8 << 20) + 1001).unwrap_err()), "ratio");
    }

    #[test]
    fn limits_are_set_by_name() {
        let mut limits = Limits::default();
        for name in ["bytes", "files", "ratio", "path", "depth"] {
            assert!(limits.set(name, 7), "{name}");
        }
        assert_eq!(limits, Limits { bytes: 7, files: 7, ratio: 7, path: 7, depth: 7 });
        assert!(!limits.set("time", 7));
    }
}
