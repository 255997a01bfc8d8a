//! Who may come to the page of phones and headsets.

use std::net::SocketAddr;

/// Who may come to the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// This machine, and who has a tunnel to it, at this port.
    Loopback(u16),
    /// The local network behind TLS, at this port of the address that leads there.
    Network(u16),
    /// The same at this address.
    Address(SocketAddr),
}
