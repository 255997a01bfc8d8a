//! Files that appear under their name only when they are complete.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::error::VideoError;

/// Most unfinished files beside one target, left by killed processes or written at the same time.
const MOST: u32 = 1000;

/// A file written as `.NAME.N.unfinished` beside its target. [`finish`](Self::finish) renames it; dropped before
/// that, it is removed. A killed process leaves only the hidden unfinished file.
#[derive(Debug)]
pub(crate) struct UnfinishedFile {
    file: File,
    target: PathBuf,
    /// Empty once renamed.
    unfinished: Option<PathBuf>,
}

impl UnfinishedFile {
    /// Creates the unfinished file; the target is untouched until it is finished.
    pub(crate) fn create(target: &Path) -> Result<Self, VideoError> {
        let Some(name) = target.file_name() else {
            return Err(VideoError::NotAFile { path: target.to_owned() });
        };
        if fs::metadata(target).is_ok_and(|found| !found.is_file()) {
            return Err(VideoError::NotAFile { path: target.to_owned() });
        }
        // A link stays a link: what it points to is replaced.
        let target = fs::canonicalize(target).unwrap_or_else(|_| target.to_owned());
        let mut error = None;
        for number in 0..MOST {
            let mut hidden = std::ffi::OsString::from(".");
            hidden.push(name);
            hidden.push(format!(".{number}.unfinished"));
            let unfinished = target.with_file_name(hidden);
            match OpenOptions::new().write(true).create_new(true).open(&unfinished) {
                Ok(file) => return Ok(UnfinishedFile { file, target, unfinished: Some(unfinished) }),
                Err(taken) if taken.kind() == io::ErrorKind::AlreadyExists => error = Some(taken),
                Err(refused) => return Err(VideoError::Io { path: target, error: refused }),
            }
        }
        let error = error.unwrap_or_else(|| io::ErrorKind::AlreadyExists.into());
        Err(VideoError::Io { path: target, error })
    }

    /// Gives the complete file its name, replacing a file of that name.
    pub(crate) fn finish(mut self) -> Result<(), VideoError> {
        self.file.flush().map_err(VideoError::io(&self.target))?;
        if let Some(unfinished) = &self.unfinished {
            fs::rename(unfinished, &self.target).map_err(VideoError::io(&self.target))?;
            self.unfinished = None;
        }
        Ok(())
    }
}

impl Write for UnfinishedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for UnfinishedFile {
    fn seek(&mut self, position: SeekFrom) -> io::Result<u64> {
        self.file.seek(position)
    }
}

impl Drop for UnfinishedFile {
    fn drop(&mut self) {
        if let Some(unfinished) = &self.unfinished {
            // A drop has nobody to report to; what stays has a name that says so.
            let _ = fs::remove_file(unfinished);
        }
    }
}

/// Writes a whole file that is complete in memory.
pub(crate) fn write_whole(target: &Path, bytes: &[u8]) -> Result<(), VideoError> {
    let mut file = UnfinishedFile::create(target)?;
    file.write_all(bytes).map_err(VideoError::io(target))?;
    file.finish()
}
