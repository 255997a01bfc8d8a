//! Zip archives, wheels among them.

use crate::error::StoreError;
use crate::intake::Intake;
use crate::limits::Count;
use std::cell::Cell;
use std::fs::File;
use std::io::BufReader;
use std::rc::Rc;
use zip::ZipArchive;

/// Kinds of files in the upper bits of a Unix mode.
const KIND: u32 = 0o170_000;
const FILE: u32 = 0o100_000;
const FOLDER: u32 = 0o040_000;
const LINK: u32 = 0o120_000;

/// Takes every file of an archive.
///
/// # Errors
/// The archive is damaged or truncated, or an entry is refused.
pub(crate) fn read(file: File, intake: &mut Intake<'_>) -> Result<(), StoreError> {
    let mut archive = ZipArchive::new(BufReader::new(file)).map_err(|error| StoreError::Source {
        path: intake.source.to_owned(),
        reason: format!("a damaged or truncated zip archive: {error}"),
    })?;
    for i in 0..archive.len() {
        let shown = archive.name_for_index(i).unwrap_or("(without name)").to_owned();
        let member = archive.by_index(i).map_err(|error| intake.refused(&shown, error.to_string()))?;
        let path = intake.entry(member.name_raw())?;
        let packed = member.compressed_size();
        match member.unix_mode().map_or(0, |mode| mode & KIND) {
            _ if member.is_dir() => {}
            0 | FILE => {
                let count: Count = Rc::new(Cell::new(packed));
                let mut content = intake.bounded(member, Some(count));
                intake.file(path, &mut content)?;
            }
            LINK => return Err(intake.not_plain(&shown, "a symbolic link")),
            FOLDER => return Err(intake.not_plain(&shown, "a folder with content")),
            _ => return Err(intake.not_plain(&shown, "a device or pipe")),
        }
        intake.position.set(intake.position.get() + packed);
    }
    Ok(())
}
