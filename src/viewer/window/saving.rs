//! Where files go that a person asks for: screenshots, states, models.

use std::fs::OpenOptions;
use std::io::{self, Write};

/// Takes a file's wanted name and its content, and says where it went.
pub type Save = Box<dyn FnMut(&str, &[u8]) -> io::Result<String>>;

/// Names that are tried.
const MOST: usize = 10_000;

/// Writes a file into the working folder, under its name or the next free one.
pub fn into_working_folder(name: &str, content: &[u8]) -> io::Result<String> {
    let (stem, ending) = name.rsplit_once('.').unwrap_or((name, ""));
    for number in 0..MOST {
        let chosen = if number == 0 { name.to_owned() } else { format!("{stem}-{number}.{ending}") };
        match OpenOptions::new().write(true).create_new(true).open(&chosen) {
            Ok(mut file) => return file.write_all(content).map(|()| chosen),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(io::Error::new(error.kind(), format!("{chosen}: {error}"))),
        }
    }
    Err(io::Error::other(format!("{name}: there are {MOST} files of this name")))
}
