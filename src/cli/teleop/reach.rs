//! The address at which the page for phones and headsets is served.

use std::net::SocketAddr;

/// The address at which the page is served.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reach {
    /// The loopback address at this port: for this machine, and through tunnels.
    Loopback(u16),
    /// This machine's address on the local network at this port, behind TLS.
    Network(u16),
    /// This address, behind TLS.
    Address(SocketAddr),
}
