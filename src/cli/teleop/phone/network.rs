//! The local network: this machine's address there, and TLS, where the build has it.

use crate::failure::Failure;
#[cfg(not(feature = "tls"))]
use std::io;
#[cfg(not(feature = "tls"))]
use std::net::TcpStream;
use std::net::{Ipv4Addr, SocketAddr, UdpSocket};

/// This machine's address on its network. No packet is sent.
pub fn address(port: u16) -> Result<SocketAddr, Failure> {
    let found = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, 0)).and_then(|socket| {
        // An address reserved for documentation (RFC 5737): the route to it is the route to the network.
        socket.connect((Ipv4Addr::new(192, 0, 2, 1), 9))?;
        socket.local_addr()
    });
    let address = found.map(|found| found.ip()).ok().filter(|ip| !ip.is_loopback() && !ip.is_unspecified());
    address.map(|ip| (ip, port).into()).ok_or_else(|| {
        Failure::new("this machine has no network address; name one by --device phone-lan:ADDRESS:PORT")
    })
}

#[cfg(feature = "tls")]
pub use super::tls::Identity as Lock;

/// Placeholder for TLS in builds without it.
#[cfg(not(feature = "tls"))]
pub enum Lock {}

#[cfg(not(feature = "tls"))]
impl Lock {
    pub fn new(_: SocketAddr) -> Result<Self, Failure> {
        Err(Failure::usage(
            "this build has no TLS, which browsers require on a network: build with --features tls, or use --device phone and `adb reverse`",
        ))
    }

    pub fn fingerprint(&self) -> &str {
        match *self {}
    }

    pub fn accept(&self, _: TcpStream) -> io::Result<TcpStream> {
        match *self {}
    }
}
