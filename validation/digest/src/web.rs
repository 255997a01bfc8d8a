//! What a WebAssembly module offers: each hash by its number.
#![allow(unsafe_code)]

use crate::names;

/// Number of hashes.
#[unsafe(no_mangle)]
pub extern "C" fn count() -> u32 {
    names().count() as u32
}

/// The hash with this number; 0 when it cannot be computed.
#[unsafe(no_mangle)]
pub extern "C" fn hash(number: u32) -> u64 {
    crate::hash(number as usize, 1).unwrap_or(0)
}
