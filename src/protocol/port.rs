//! What carries bytes between a driver and its device.

use std::io;

/// A serial line, a connection or a socket, with the clock that its timeouts run on.
///
/// A driver that sees its device through this trait alone runs on a real port in real time, and on a simulated one in
/// virtual time, without knowing which.
pub trait Port: Send {
    /// Sends all of `bytes`; one datagram where the port carries datagrams.
    ///
    /// # Errors
    /// The device is gone, or does not take bytes in time.
    fn send(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Receives what there is, waiting at most `timeout` \[s\] for the first byte; returns how many bytes came, 0 when
    /// none did. Of a datagram that is longer than `buffer` the rest is lost.
    ///
    /// # Errors
    /// The device is gone: [`io::ErrorKind::UnexpectedEof`] when it closed the connection.
    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize>;

    /// Drops what has arrived and was not received.
    ///
    /// # Errors
    /// The device is gone.
    fn discard(&mut self) -> io::Result<()>;

    /// Seconds since some moment in the past; never less than before.
    fn now(&self) -> f64;

    /// Returns after `seconds`.
    fn wait(&mut self, seconds: f64);
}

impl<P: Port + ?Sized> Port for Box<P> {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        (**self).send(bytes)
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
        (**self).receive(buffer, timeout)
    }

    fn discard(&mut self) -> io::Result<()> {
        (**self).discard()
    }

    fn now(&self) -> f64 {
        (**self).now()
    }

    fn wait(&mut self, seconds: f64) {
        (**self).wait(seconds);
    }
}
