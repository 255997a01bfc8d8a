//! How far long work has come.

/// How far an import or a verification has come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Progress {
    /// Bytes done, of an archive as it lies on the disk.
    pub done: u64,
    /// Bytes to do.
    pub total: u64,
}

/// Told after every file how far the work has come.
pub type Watch<'a> = &'a mut dyn FnMut(Progress);
