//! The flight recorder: the last minutes of a device, in a file that a killed process leaves complete.
//!
//! The file is a ring of records of one size, each with a number and a checksum, written one by one: what the system has
//! taken survives the process. [`read`] sorts them by number and leaves out the one that was being overwritten.

use protocol::crc;
use robot::Fault;
use std::fs::{File, OpenOptions};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

const MAGIC: [u8; 8] = *b"RHFLIGHT";
const HEADER: usize = 32;
/// Number, time, kind, length, checksum.
const PREFIX: usize = 8 + 8 + 1 + 1 + 2;
/// Bytes of a record for a text or for values, at least.
const TEXT: usize = 108;
/// Size of the ring.
const BYTES: u64 = 32 << 20;

/// What happened.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// Values that the device gave, in its units.
    Reading(&'a [f64]),
    /// Commands that it was sent, in its units.
    Command(&'a [f64]),
    /// What went wrong.
    Fault(&'a Fault),
    /// Anything else worth knowing.
    Note(&'a str),
}

/// A record as it is read back.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Its place among all records.
    pub number: u64,
    /// Seconds since the device was connected.
    pub time: f64,
    /// What happened.
    pub what: What,
}

/// What happened, as it is read back.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// Values that the device gave.
    Reading(Vec<f64>),
    /// Commands that it was sent.
    Command(Vec<f64>),
    /// What went wrong, in words.
    Fault(String),
    /// Anything else.
    Note(String),
}

/// Writes a ring of records. It allocates nothing after it was made.
#[derive(Debug)]
pub struct Recorder {
    file: File,
    path: PathBuf,
    record: Vec<u8>,
    capacity: u64,
    written: u64,
}

impl Recorder {
    /// A new file in `folder` for a device with so many sensors and actuators; an older one of this device is kept beside
    /// it under a name that ends in `.previous`.
    ///
    /// # Errors
    /// The file cannot be made.
    pub fn create(folder: &Path, device: &str, sensors: usize, actuators: usize) -> io::Result<Recorder> {
        std::fs::create_dir_all(folder).map_err(named(folder))?;
        let name: String = device.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
        let path = folder.join(format!("{name}.flight"));
        if path.exists() {
            std::fs::rename(&path, folder.join(format!("{name}.flight.previous"))).map_err(named(&path))?;
        }
        let mut file = OpenOptions::new().write(true).create_new(true).open(&path).map_err(named(&path))?;
        let size = PREFIX + TEXT.max(8 * sensors.max(actuators));
        let capacity = BYTES / size as u64;
        let mut header = [0; HEADER];
        header[..8].copy_from_slice(&MAGIC);
        header[8..16].copy_from_slice(&(size as u64).to_le_bytes());
        header[16..24].copy_from_slice(&capacity.to_le_bytes());
        file.write_all(&header).map_err(named(&path))?;
        Ok(Recorder { file, path, record: vec![0; size], capacity, written: 0 })
    }

    /// Where it writes.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a record over the oldest. What does not fit into a record is cut.
    ///
    /// # Errors
    /// The disk is full, or gone.
    pub fn record(&mut self, time: f64, event: Event<'_>) -> io::Result<()> {
        let room = self.record.len() - PREFIX;
        self.record[PREFIX..].fill(0);
        let values = |values: &[f64], record: &mut [u8]| {
            let count = values.len().min(room / 8);
            for (place, value) in record[PREFIX..].chunks_exact_mut(8).zip(values) {
                place.copy_from_slice(&value.to_le_bytes());
            }
            count
        };
        let text = |text: &mut dyn FnMut(&mut &mut [u8]) -> io::Result<()>, record: &mut [u8]| {
            let mut left = &mut record[PREFIX..];
            // A text that is too long fills the record and ends there.
            text(&mut left).unwrap_or_default();
            room - left.len()
        };
        let (kind, length) = match event {
            Event::Reading(read) => (0, values(read, &mut self.record)),
            Event::Command(sent) => (1, values(sent, &mut self.record)),
            Event::Fault(fault) => (2, text(&mut |out| write!(out, "{fault}"), &mut self.record)),
            Event::Note(note) => (3, text(&mut |out| out.write_all(note.as_bytes()), &mut self.record)),
        };
        self.record[..8].copy_from_slice(&self.written.to_le_bytes());
        self.record[8..16].copy_from_slice(&time.to_le_bytes());
        self.record[16] = kind;
        self.record[17] = length.min(255) as u8;
        self.record[18..20].fill(0);
        let sum = crc::buypass(0, &self.record);
        self.record[18..20].copy_from_slice(&sum.to_le_bytes());
        let place = HEADER as u64 + self.written % self.capacity * self.record.len() as u64;
        self.file.seek(SeekFrom::Start(place))?;
        self.file.write_all(&self.record)?;
        self.written += 1;
        Ok(())
    }
}

/// An error that says which file it is about.
fn named(path: &Path) -> impl Fn(io::Error) -> io::Error {
    move |error| io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}

/// Reads the records of a file in the order in which they were written.
///
/// # Errors
/// The file cannot be read, is not a flight recorder's, or has records of which none is whole.
pub fn read(path: &Path) -> io::Result<Vec<Entry>> {
    let mut bytes = Vec::new();
    File::open(path).and_then(|mut file| file.read_to_end(&mut bytes)).map_err(named(path))?;
    let number =
        |at: usize| bytes.get(at..at + 8).map(|b| u64::from_le_bytes(b.try_into().unwrap_or_default()));
    let size = number(8).filter(|_| bytes.starts_with(&MAGIC)).and_then(|size| usize::try_from(size).ok());
    let size = size.filter(|size| (PREFIX + TEXT..1 << 20).contains(size)).ok_or_else(|| {
        let message = format!("{} is not a file of a flight recorder", path.display());
        io::Error::new(io::ErrorKind::InvalidData, message)
    })?;
    let records = bytes[HEADER.min(bytes.len())..].chunks_exact(size);
    let count = records.len();
    // The process may have died while it wrote one: that is left out.
    let mut entries: Vec<_> = records.filter_map(entry).collect();
    if entries.is_empty() && count > 0 {
        let message = format!("{} is damaged: none of its {count} records is whole", path.display());
        return Err(io::Error::new(io::ErrorKind::InvalidData, message));
    }
    entries.sort_by_key(|entry| entry.number);
    Ok(entries)
}

/// The entry in a record; `None` if it was not written to its end.
fn entry(record: &[u8]) -> Option<Entry> {
    let mut plain = record.to_vec();
    plain[18..20].fill(0);
    if crc::buypass(0, &plain).to_le_bytes() != record[18..20] {
        return None;
    }
    let length = usize::from(record[17]);
    let payload = &record[PREFIX..];
    let values = || -> Option<Vec<f64>> {
        let bytes = payload.get(..8 * length)?;
        Some(bytes.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap_or_default())).collect())
    };
    let text = || payload.get(..length).map(|text| String::from_utf8_lossy(text).into_owned());
    Some(Entry {
        number: u64::from_le_bytes(record[..8].try_into().ok()?),
        time: f64::from_le_bytes(record[8..16].try_into().ok()?),
        what: match record[16] {
            0 => What::Reading(values()?),
            1 => What::Command(values()?),
            2 => What::Fault(text()?),
            3 => What::Note(text()?),
            _ => return None,
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ring_keeps_the_newest_and_leaves_out_a_torn_record() {
        let folder = std::env::temp_dir().join(format!("robohive-flight-{}", std::process::id()));
        let mut recorder = Recorder::create(&folder, "left arm", 2, 20).unwrap();
        recorder.capacity = 5;
        recorder.record(0.0, Event::Fault(&Fault::Stale(12))).unwrap();
        for k in 1..8 {
            recorder.record(f64::from(k), Event::Reading(&[f64::from(k), -1.5])).unwrap();
        }
        recorder.record(8.0, Event::Command(&[0.25; 20])).unwrap();
        let path = recorder.path().to_owned();
        let numbers = |entries: &[Entry]| entries.iter().map(|entry| entry.number).collect::<Vec<_>>();
        let entries = read(&path).unwrap();
        assert_eq!(numbers(&entries), [4, 5, 6, 7, 8]);
        assert_eq!(entries[1].what, What::Reading(vec![5.0, -1.5]));
        assert_eq!(entries[4], Entry { number: 8, time: 8.0, what: What::Command(vec![0.25; 20]) });

        // The process died in the middle of record 9.
        let mut bytes = std::fs::read(&path).unwrap();
        let size = PREFIX + 160;
        bytes[HEADER + 4 * size] = 9;
        std::fs::write(&path, &bytes).unwrap();
        assert_eq!(numbers(&read(&path).unwrap()), [5, 6, 7, 8]);
        bytes[HEADER..].fill(1);
        std::fs::write(&path, &bytes).unwrap();
        let said = read(&path).unwrap_err().to_string();
        assert!(said.ends_with("left_arm.flight is damaged: none of its 5 records is whole"), "{said}");
        std::fs::write(&path, b"RHFLIGHX").unwrap();
        assert!(read(&path).unwrap_err().to_string().contains("left_arm.flight is not a file of"));
        std::fs::remove_dir_all(folder).unwrap();
    }
}
