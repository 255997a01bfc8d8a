//! Servos of any make on a serial bus: a make has a control table and packets ([`protocol::servo`]), and parameters of its own.

mod bus;
mod driver;
mod line;
mod settings;

pub use driver::Servos;
pub(crate) use settings::Make;
