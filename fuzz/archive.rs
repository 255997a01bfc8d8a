//! The kept inputs of one target in one file: a tar archive as POSIX.1-1988 has it (ustar), members in the order of their
//! names, without times or owners, so that equal inputs make equal bytes.

use std::collections::BTreeMap;
use std::path::Path;

/// Inputs by name.
pub type Inputs = BTreeMap<String, Vec<u8>>;

/// Headers and contents fill whole blocks of this size in bytes.
const BLOCK: usize = 512;
/// Where a header has the name of its member, its length in octal digits, and the sum of its own bytes.
const NAME: std::ops::Range<usize> = 0..100;
const LENGTH: std::ops::Range<usize> = 124..136;
const SUM: std::ops::Range<usize> = 148..156;

/// Reads an archive.
///
/// # Errors
/// The file cannot be read or is no archive.
pub fn open(path: &Path) -> Result<Inputs, String> {
    let bytes = std::fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    unpack(&bytes).ok_or_else(|| format!("{}: not an archive of inputs", path.display()))
}

/// The members of an archive; none where it is damaged.
pub fn unpack(bytes: &[u8]) -> Option<Inputs> {
    let mut inputs = Inputs::new();
    let mut rest = bytes;
    while *rest.first()? != 0 {
        let (header, content) = rest.split_at_checked(BLOCK)?;
        let name = std::str::from_utf8(&header[NAME]).ok()?.trim_end_matches('\0').to_owned();
        if octal(&header[SUM])? != sum(header) {
            return None;
        }
        let length = octal(&header[LENGTH])?;
        inputs.insert(name, content.get(..length)?.to_vec());
        rest = content.get(length.next_multiple_of(BLOCK)..)?;
    }
    Some(inputs)
}

/// The archive of `inputs`.
///
/// # Panics
/// A name is longer than a header has room for.
pub fn pack(inputs: &Inputs) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (name, content) in inputs {
        let mut header = [0; BLOCK];
        header[NAME][..name.len()].copy_from_slice(name.as_bytes());
        header[100..107].copy_from_slice(b"0000644");
        header[LENGTH][..11].copy_from_slice(format!("{:011o}", content.len()).as_bytes());
        header[156] = b'0';
        header[257..265].copy_from_slice(b"ustar\x0000");
        let sum = format!("{:06o}\0 ", sum(&header));
        header[SUM].copy_from_slice(sum.as_bytes());
        bytes.extend(header);
        bytes.extend(content);
        bytes.resize(bytes.len().next_multiple_of(BLOCK), 0);
    }
    // Two empty blocks are the end.
    bytes.resize(bytes.len() + 2 * BLOCK, 0);
    bytes
}

/// The sum of a header's bytes; the bytes of the sum itself count as spaces.
fn sum(header: &[u8]) -> usize {
    let counted = header.iter().enumerate().map(|(i, &byte)| if SUM.contains(&i) { b' ' } else { byte });
    counted.map(usize::from).sum()
}

fn octal(field: &[u8]) -> Option<usize> {
    let digits = std::str::from_utf8(field).ok()?.trim_matches(['\0', ' ']);
    usize::from_str_radix(digits, 8).ok()
}
