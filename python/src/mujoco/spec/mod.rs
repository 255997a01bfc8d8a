//! `MjSpec`: descriptions of models on their way between Python, which holds and edits the tree of elements, and the
//! reader, the compiler and the writer, which know it as a `Spec`.
//!
//! | file | what |
//! |---|---|
//! | `value.rs` | attributes as Python's values |
//! | `show.rs` | the elements of a `Spec` for Python |
//! | `take.rs`, `parts.rs`, `deformable.rs` | a `Spec` of Python's elements; attributes that are no plain values |
//! | `description.rs` | texts read, trees compiled and written |
//!
//! An element crosses as the dictionary of its attributes with the numbers of its body and frame, and with its place: the
//! description that it was made in, and where that one's text declares it.

mod deformable;
mod description;
mod origin;
mod parts;
mod show;
mod take;
mod value;

pub use description::{Description, actuator_shortcut, orientation, spec_forms};
