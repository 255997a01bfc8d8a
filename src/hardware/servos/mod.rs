//! Servos of any make on a serial bus: a make is its table and its packets ([`protocol::servo`]), and what its parameters say.

mod bus;
mod driver;
mod settings;

pub use driver::Servos;
pub(crate) use settings::Make;
