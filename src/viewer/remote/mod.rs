//! A window in a process of its own: what a program and its window say to each other over a pair of pipes.
//!
//! The program is at one end with a [`Client`], the window at the other with a [`Link`]. Time goes by in the program, which
//! sends states ([`Client::sync`]) to a session that follows; or in the window, which returns the last state when it closes.
//! Back come the camera and the options that a person has changed, hands on bodies, moved controls, and keys.
//!
//! | part | what it does |
//! |---|---|
//! | `wire` | values as bytes, messages as frames |
//! | `numbers`, `edits`, `state`, `sight`, `items`, `overlay` | what crosses: arrays, changes of a model, states, cameras, items, figures |
//! | `message` | all messages |
//! | `post` | what has arrived: the latest of each kind |
//! | `client` | the program's side |
//! | `link` | the window's side |
//!
//! Each side greets with [`PROTOCOL`], and refuses another one. A message is its length, eight bytes, and at most
//! [`LONGEST`] bytes; what is none ends the link with a message, as a process that dies does. A side that is slow holds no more
//! than the latest state, model and overlays, and a thousand keys.

mod client;
mod edits;
mod items;
mod link;
mod message;
mod numbers;
mod overlay;
mod post;
mod sight;
mod state;
mod wire;

pub use client::{Client, NoViewer};
pub use edits::Edit;
pub use link::{Link, Refused};
pub use message::{Grasp, Opening, Order, Report, TurnedSight};
pub use numbers::Numbers;
pub use overlay::{Bytes, Figure, Image, Line, Place, Text};
pub use post::{Orders, Post, Reports};
pub use sight::{OptionCodes, Sight};
pub use state::StateCopy;
pub use wire::{LONGEST, WireError};

/// The greeting of both sides. Processes of one installation have the same.
pub const PROTOCOL: &str = concat!("robohive viewer 1, ", env!("CARGO_PKG_VERSION"));
