//! HDF5 files: the part of the format that recordings of episodes need.
//!
//! Read are the files that h5py writes by default, those of libver="latest" whose groups are small and whose datasets have
//! fixed lengths, and our own; chunks may be shuffled, deflated and carry Fletcher's checksum. Every address, length and
//! count is checked against the file before memory is taken. Written are files that can be read at
//! every moment while they grow ([`append`]).

pub mod append;
pub mod dataset;
pub mod datatype;
pub mod encode;
pub mod error;
pub mod file;
pub mod filter;

mod bytes;
mod checksum;
mod group;
mod header;
mod heap;
mod index;
mod lock;
