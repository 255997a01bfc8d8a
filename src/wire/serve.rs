//! A bench in real time, for programs that open serial ports and sockets.

use crate::bench::LinkId;
use crate::virtual_port::Shared;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fd::{AsFd, BorrowedFd, OwnedFd};
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};
use std::fs::OpenOptions;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Longest datagram, and most bytes taken at once.
const ROOM: usize = 65_536;
/// Longest sleep, after which a request to stop is seen \[s\].
const NAP: f64 = 0.05;

/// A pseudo-terminal: what writes to its path reaches the device, as on a serial port.
pub struct Terminal {
    master: OwnedFd,
    path: PathBuf,
    /// Held open, so that the line stays when a driver closes it.
    _slave: OwnedFd,
}

impl Terminal {
    /// Opens one.
    ///
    /// # Errors
    /// The system has none to give.
    pub fn open() -> io::Result<Terminal> {
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&master)?;
        unlockpt(&master)?;
        let name = ptsname(&master, Vec::new())?;
        let path = PathBuf::from(name.to_string_lossy().into_owned());
        let slave: OwnedFd = OpenOptions::new().read(true).write(true).open(&path)?.into();
        let mut settings = tcgetattr(&slave)?;
        settings.make_raw();
        tcsetattr(&slave, OptionalActions::Now, &settings)?;
        fcntl_setfl(&master, fcntl_getfl(&master)? | OFlags::NONBLOCK)?;
        Ok(Terminal { master, path, _slave: slave })
    }

    /// What a driver opens.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// The outer end of a link.
pub enum End {
    /// A serial line.
    Terminal(Terminal),
    /// A server, for one connection at a time.
    Tcp(TcpListener, Option<TcpStream>),
    /// A socket that answers whoever spoke last.
    Udp(UdpSocket, Option<SocketAddr>),
}

impl End {
    /// A server at this address.
    ///
    /// # Errors
    /// The address is taken or not ours.
    pub fn tcp(address: SocketAddr) -> io::Result<End> {
        let listener = TcpListener::bind(address)?;
        listener.set_nonblocking(true)?;
        Ok(End::Tcp(listener, None))
    }

    /// A socket at this address, which speaks to `peer` until somebody else speaks to it.
    ///
    /// # Errors
    /// The address is taken or not ours.
    pub fn udp(address: SocketAddr, peer: Option<SocketAddr>) -> io::Result<End> {
        let socket = UdpSocket::bind(address)?;
        socket.set_nonblocking(true)?;
        Ok(End::Udp(socket, peer))
    }

    /// Where drivers find it.
    pub fn address(&self) -> String {
        match self {
            End::Terminal(terminal) => terminal.path().display().to_string(),
            End::Tcp(listener, _) => listener.local_addr().map_or_else(|e| e.to_string(), |a| a.to_string()),
            End::Udp(socket, _) => socket.local_addr().map_or_else(|e| e.to_string(), |a| a.to_string()),
        }
    }

    fn descriptor(&self) -> BorrowedFd<'_> {
        match self {
            End::Terminal(terminal) => terminal.master.as_fd(),
            End::Tcp(_, Some(stream)) => stream.as_fd(),
            End::Tcp(listener, None) => listener.as_fd(),
            End::Udp(socket, _) => socket.as_fd(),
        }
    }

    /// What came, if anything did.
    fn take(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            End::Terminal(terminal) => Ok(rustix::io::read(&terminal.master, buffer)?),
            End::Tcp(listener, stream @ None) => {
                let (accepted, _) = listener.accept()?;
                accepted.set_nonblocking(true)?;
                accepted.set_nodelay(true)?;
                *stream = Some(accepted);
                Err(ErrorKind::WouldBlock.into())
            }
            End::Tcp(_, slot) => {
                let Some(stream) = slot else { return Ok(0) };
                let read = stream.read(buffer);
                if matches!(read, Ok(0)) {
                    *slot = None;
                }
                read
            }
            End::Udp(socket, peer) => {
                let (count, from) = socket.recv_from(buffer)?;
                *peer = Some(from);
                Ok(count)
            }
        }
    }

    /// Sends what a device says; where nobody listens it is lost, as on a wire.
    fn give(&mut self, bytes: &[u8]) -> io::Result<()> {
        match self {
            End::Terminal(terminal) => {
                let mut left = bytes;
                while !left.is_empty() {
                    left = &left[rustix::io::write(&terminal.master, left)?..];
                }
                Ok(())
            }
            End::Tcp(_, stream) => stream.as_mut().map_or(Ok(()), |stream| stream.write_all(bytes)),
            End::Udp(socket, peer) => peer.map_or(Ok(()), |peer| socket.send_to(bytes, peer).map(drop)),
        }
    }
}

/// Serves the links of a bench until `stop`, the bench's time passing as the clock's does. A bench that falls behind (physics
/// that takes longer than what it simulates) does not catch up: its time then passes more slowly.
///
/// # Errors
/// The system refuses to wait for the links.
pub fn serve(bench: &Shared, ends: &mut [(LinkId, End)], stop: &AtomicBool) -> io::Result<()> {
    let lock = || -> MutexGuard<'_, _> { bench.lock().unwrap_or_else(PoisonError::into_inner) };
    let mut buffer = vec![0; ROOM];
    let (mut start, mut base) = (Instant::now(), lock().time());
    while !stop.load(Ordering::Relaxed) {
        let mut bench = lock();
        let now = base + start.elapsed().as_secs_f64();
        if now - bench.time() > 1.0 {
            (start, base) = (Instant::now(), bench.time());
            continue;
        }
        bench.advance(now);
        for (link, end) in ends.iter_mut() {
            while let Some(bytes) = bench.receive(*link, ROOM) {
                // A terminal that nobody reads is full: what does not fit is lost, as on a wire.
                end.give(&bytes).or_else(ignore_absence)?;
            }
        }
        let due = ends.iter().filter_map(|(link, _)| bench.due(*link)).fold(f64::INFINITY, f64::min);
        let next = bench.plant().next().min(due);
        drop(bench);
        let wait = (next - (base + start.elapsed().as_secs_f64())).clamp(0.0, NAP);
        let mut descriptors: Vec<_> =
            ends.iter().map(|(_, end)| PollFd::from_borrowed_fd(end.descriptor(), PollFlags::IN)).collect();
        let wait = Timespec::try_from(Duration::from_secs_f64(wait)).map_err(io::Error::other)?;
        match poll(&mut descriptors, Some(&wait)) {
            Ok(_) | Err(rustix::io::Errno::INTR) => {}
            Err(error) => return Err(error.into()),
        }
        drop(descriptors);
        for (link, end) in ends.iter_mut() {
            match end.take(&mut buffer) {
                Ok(count) if count > 0 => lock().send(*link, &buffer[..count]),
                Ok(_) => {}
                Err(error) => ignore_absence(error)?,
            }
        }
    }
    Ok(())
}

/// Whether an error says no more than that nobody is there, or nothing.
fn ignore_absence(error: io::Error) -> io::Result<()> {
    match error.kind() {
        ErrorKind::WouldBlock
        | ErrorKind::Interrupted
        | ErrorKind::ConnectionReset
        | ErrorKind::ConnectionRefused
        | ErrorKind::BrokenPipe => Ok(()),
        // A terminal without a reader.
        _ if error.raw_os_error() == Some(5) => Ok(()),
        _ => Err(error),
    }
}
