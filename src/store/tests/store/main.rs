//! Stores as a program uses them.

mod hostile;
mod import;
mod interruption;
mod sources;
