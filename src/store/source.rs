//! What a source is, told from its content and not from its name.

use crate::error::StoreError;
use crate::folder;
use crate::intake::Intake;
use crate::limits::Counted;
use crate::{tar, zip_archive};
use flate2::bufread::MultiGzDecoder;
use lzma_rust2::XzReader;
use std::fs::{self, File};
use std::io::{self, BufReader, Read, Seek};
use std::path::Path;

/// Memory that unpacking may take, in KiB: twice what the strongest preset of `xz` asks for.
const MAX_MEMORY: u32 = 128 << 10;

/// Takes every file of a source.
///
/// # Errors
/// The source cannot be read, is of no known kind, damaged or hostile.
pub(crate) fn read(source: &Path, intake: &mut Intake<'_>) -> Result<(), StoreError> {
    let unreadable = || StoreError::io(source);
    let wrong = |reason: &str| StoreError::Source { path: source.to_owned(), reason: reason.into() };
    let metadata = fs::metadata(source).map_err(unreadable())?;
    if metadata.is_dir() {
        return folder::read(source, intake);
    }
    if !metadata.is_file() {
        return Err(wrong("neither a folder nor a file"));
    }
    intake.total = metadata.len();
    let mut file = File::open(source).map_err(unreadable())?;
    let mut head = Vec::new();
    file.by_ref().take(tar::BLOCK as u64).read_to_end(&mut head).map_err(unreadable())?;
    file.rewind().map_err(unreadable())?;

    if head.starts_with(b"PK\x03\x04") || head.starts_with(b"PK\x05\x06") {
        return zip_archive::read(file, intake);
    }
    let packed = BufReader::with_capacity(1 << 16, Counted { inner: file, count: intake.position.clone() });
    let count = intake.position.clone();
    if head.starts_with(b"\xfd7zXZ\0") {
        let unpacked = XzReader::new_mem_limit(packed, true, MAX_MEMORY);
        tar::read(&mut intake.bounded(Named("xz", unpacked), Some(count)), intake)
    } else if head.starts_with(b"\x1f\x8b") {
        let unpacked = MultiGzDecoder::new(packed);
        tar::read(&mut intake.bounded(Named("gzip", unpacked), Some(count)), intake)
    } else if <&[u8; tar::BLOCK]>::try_from(&head[..]).is_ok_and(tar::is_header) {
        tar::read(&mut intake.bounded(packed, None), intake)
    } else {
        Err(wrong("neither a folder nor a tar, tar.xz, tar.gz, zip or whl archive, by its first bytes"))
    }
}

/// Says which decoder an error comes from.
struct Named<R>(&'static str, R);

impl<R: Read> Read for Named<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.1.read(buffer).map_err(|error| match error.kind() {
            kind @ (io::ErrorKind::UnexpectedEof | io::ErrorKind::Interrupted) => kind.into(),
            kind => io::Error::new(kind, format!("the {} data is damaged: {error}", self.0)),
        })
    }
}
