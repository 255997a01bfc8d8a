//! Python pickles, read without being executed (Python documentation: `pickle`, `pickletools`; protocols 2 to 5).
//!
//! A pickle is a program that builds objects. Here it builds a graph of inert [`Value`]s: a class or function that it names
//! stays a name, and what it would call or instantiate becomes an object with that name, its arguments and its state.
//! Nothing is looked up, imported or called, so a pickle from anywhere is as safe to read as any other file. Memory is
//! proportional to the input, and nothing recurses, so neither depth nor cycles can exhaust the stack.
//!
//! ```
//! use robohive_dataset::pickle::Pickle;
//! // pickle.dumps({"n": [1, 2.5]}, protocol=2)
//! let bytes = b"\x80\x02}X\x01\x00\x00\x00n](K\x01G@\x04\x00\x00\x00\x00\x00\x00es.";
//! let pickle = Pickle::parse(bytes)?;
//! let numbers = pickle.root().get("n").unwrap();
//! assert_eq!(numbers.item(0).unwrap().int(), Some(1));
//! assert_eq!(numbers.item(1).unwrap().float(), Some(2.5));
//! # Ok::<(), robohive_dataset::pickle::PickleError>(())
//! ```

mod array;
mod error;
mod graph;
mod input;
mod machine;
mod torch;
mod value;

pub use error::PickleError;
pub use graph::Pickle;
pub use machine::MAX_VALUES;
pub use torch::LegacyStream;
pub use value::Value;
