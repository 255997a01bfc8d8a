//! What leaves pairs out: sleep, contact types, a program.

mod pairs;
mod sleeping;

pub use pairs::{ByType, Decided, PairFilter};
pub(crate) use sleeping::SleepFilter;
