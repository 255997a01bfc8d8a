//! A bench in real time, for programs that open serial ports and sockets.

use crate::bench::{Bench, LinkId};
use crate::virtual_port::Shared;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fd::{AsFd, BorrowedFd, OwnedFd};
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};
use std::fs::OpenOptions;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{IpAddr, SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Longest datagram, and most bytes taken at once.
const ROOM: usize = 65_536;
/// Longest sleep, after which a request to stop is seen \[s\].
const NAP: f64 = 0.05;
/// Longest time for which the bench's time waits for a driver.
const PATIENCE: Duration = Duration::from_millis(500);
/// Least time that is simulated at once, if that much has passed \[s\].
const SLICE: f64 = 1e-4;

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
    /// A server, for one connection at a time: another is closed at once.
    Tcp(TcpListener, Option<TcpStream>),
    /// A socket that answers whoever spoke last, or the port that the device's client has announced.
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
            End::Tcp(_, None) => Err(ErrorKind::WouldBlock.into()),
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

impl End {
    /// Takes a connection; where there is one already, another is closed at once. Returns whether there is a new one.
    fn accept(&mut self) -> io::Result<bool> {
        let End::Tcp(listener, stream) = self else { return Ok(false) };
        let accepted = match listener.accept() {
            Ok((accepted, _)) => accepted,
            Err(error) => return ignore_absence(error).map(|()| false),
        };
        if stream.is_some() {
            return Ok(false);
        }
        accepted.set_nonblocking(true)?;
        accepted.set_nodelay(true)?;
        *stream = Some(accepted);
        Ok(true)
    }

    /// Where the client of a server is.
    fn client(&self) -> Option<IpAddr> {
        let End::Tcp(_, Some(stream)) = self else { return None };
        stream.peer_addr().ok().map(|address| address.ip())
    }

    fn open(&self) -> bool {
        matches!(self, End::Tcp(_, Some(_)))
    }
}

/// Tells every socket for datagrams at which port its device's client waits for them.
fn find_peers(bench: &Bench, ends: &mut [(LinkId, End)]) {
    for at in 0..ends.len() {
        let link = ends[at].0;
        let Some(port) = bench.announced(link) else { continue };
        let servers = ends.iter().filter(|(other, _)| bench.same_device(link, *other));
        let client = servers.filter_map(|(_, end)| end.client()).next();
        if let (End::Udp(_, peer), Some(client)) = (&mut ends[at].1, client) {
            *peer = Some(SocketAddr::new(client, port));
        }
    }
}

/// Lets time pass until `now`, where nothing happens before: what has come begins its way on the line then, and not when the
/// wait for it began.
fn wake(bench: &mut Bench, now: f64) {
    if !bench.expects() && now < bench.next_event().min(bench.plant().next()) {
        bench.advance(now);
    }
}

/// Takes what came for the devices: connections, their ends, and bytes.
fn take_all(bench: &Shared, ends: &mut [(LinkId, End)], buffer: &mut [u8]) -> io::Result<()> {
    let lock = || bench.lock().unwrap_or_else(PoisonError::into_inner);
    for (link, end) in ends.iter_mut() {
        let open = end.open();
        match end.take(buffer) {
            Ok(count) if count > 0 => lock().send(*link, &buffer[..count]),
            Ok(_) => {}
            Err(error) => {
                if error.kind() == ErrorKind::ConnectionReset
                    && let End::Tcp(_, stream) = end
                {
                    *stream = None;
                }
                ignore_absence(error)?;
            }
        }
        if open && !end.open() {
            lock().set_connected(*link, false);
        }
        // After the end of the connection before, which may have come just now.
        if end.accept()? {
            lock().set_connected(*link, true);
        }
        // A device that hung up, or a fault that cut the line.
        if let End::Tcp(_, stream @ Some(_)) = end
            && !lock().connected(*link)
        {
            *stream = None;
        }
    }
    Ok(())
}

/// Serves the links of a bench until `stop`, the bench's time passing as the clock's does. A bench that falls behind (physics
/// that takes longer than what it simulates) does not catch up: its time then passes more slowly.
///
/// # Errors
/// The system refuses to wait for the links.
pub fn serve(bench: &Shared, ends: &mut [(LinkId, End)], stop: &AtomicBool) -> io::Result<()> {
    let lock = || -> MutexGuard<'_, Bench> { bench.lock().unwrap_or_else(PoisonError::into_inner) };
    let mut buffer = vec![0; ROOM];
    let (mut start, mut base) = (Instant::now(), lock().time());
    let mut asked = None;
    while !stop.load(Ordering::Relaxed) {
        let mut bench_now = lock();
        if !bench_now.expects() {
            asked = None;
        } else if asked.get_or_insert_with(Instant::now).elapsed() < PATIENCE {
            (start, base) = (Instant::now(), bench_now.time());
        }
        let now = base + start.elapsed().as_secs_f64();
        if now - bench_now.time() > 1.0 {
            (start, base) = (Instant::now(), bench_now.time());
            continue;
        }
        // One event after the other, so that what a device says goes out before the next is simulated.
        let next = bench_now.next_event().min(bench_now.plant().next()).max(bench_now.time() + SLICE);
        let now = now.min(next).max(bench_now.time());
        bench_now.advance(now);
        find_peers(&bench_now, ends);
        for (link, end) in ends.iter_mut() {
            while let Some(bytes) = bench_now.receive(*link, ROOM) {
                // A terminal that nobody reads is full: what does not fit is lost, as on a wire.
                end.give(&bytes).or_else(ignore_absence)?;
            }
        }
        let due = ends.iter().filter_map(|(link, _)| bench_now.due(*link)).fold(f64::INFINITY, f64::min);
        let next = bench_now.plant().next().min(due).min(bench_now.next_event());
        drop(bench_now);
        let wait = (next - (base + start.elapsed().as_secs_f64())).clamp(0.0, NAP);
        let mut descriptors: Vec<_> =
            ends.iter().map(|(_, end)| PollFd::from_borrowed_fd(end.descriptor(), PollFlags::IN)).collect();
        let wait = Timespec::try_from(Duration::from_secs_f64(wait)).map_err(io::Error::other)?;
        match poll(&mut descriptors, Some(&wait)) {
            Ok(_) | Err(rustix::io::Errno::INTR) => {}
            Err(error) => return Err(error.into()),
        }
        drop(descriptors);
        wake(&mut lock(), base + start.elapsed().as_secs_f64());
        take_all(bench, ends, &mut buffer)?;
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
