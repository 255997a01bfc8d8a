//! A page for phones and headsets, on the loopback or behind TLS on the local network.

mod message;
mod network;
mod socket;
#[cfg(feature = "tls")]
mod tls;

use super::reach::Reach;
use crate::failure::Failure;
use crate::web::http::{parse, read_head, write_head};
use network::Lock;
use socket::{Again, Socket};
use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

const PAGE: &str = include_str!("page.html");
/// Longest wait for a request.
const PATIENCE: Duration = Duration::from_secs(10);
/// Time between a connection that could not be accepted and the next.
const RETRY: Duration = Duration::from_millis(100);
/// Largest number of connections at once.
const MOST: usize = 16;

/// State that all connections share.
struct Desk {
    open: AtomicUsize,
    socket: Socket,
}

/// The page of a session.
pub struct Page {
    /// Messages of the page, as lines of a headset's log.
    pub lines: OwnedFd,
    /// Its address, with the key of this session.
    pub address: String,
    /// SHA-256 fingerprint of its certificate; `None` on the loopback.
    pub fingerprint: Option<String>,
}

/// Serves the page until the program ends.
///
/// # Errors
/// The port is in use, the build has no TLS for the network, or there is no network.
pub fn serve(reach: Reach) -> Result<Page, Failure> {
    let wanted = match reach {
        Reach::Loopback(port) => (Ipv4Addr::LOCALHOST, port).into(),
        Reach::Network(port) => network::address(port)?,
        Reach::Address(address) => address,
    };
    let failed = |error: io::Error| Failure::new(format!("{wanted}: {error}; use port 0 for a free one"));
    let listener = TcpListener::bind(wanted).map_err(failed)?;
    let place = listener.local_addr().map_err(failed)?;
    let secured = !matches!(reach, Reach::Loopback(_));
    let lock = secured.then(|| Lock::new(place)).transpose()?;
    let (lines, ours) = UnixStream::pair().map_err(failed)?;
    ours.set_nonblocking(true).map_err(failed)?;
    let (scheme, mut hosts) = (if secured { "https" } else { "http" }, vec![place.to_string()]);
    hosts.extend((!secured).then(|| format!("localhost:{}", place.port())));
    let key = key().map_err(failed)?;
    let page = Page {
        lines: ours.into(),
        address: format!("{scheme}://{place}/{key}"),
        fingerprint: lock.as_ref().map(|lock| lock.fingerprint().to_owned()),
    };
    let desk = Desk { open: AtomicUsize::new(0), socket: Socket::new(scheme, hosts, key, lines) };
    let desk = Arc::new(desk);
    let lock = lock.map(Arc::new);
    std::thread::spawn(move || {
        for stream in listener.incoming() {
            let Ok(stream) = stream else {
                // It ended before it was accepted, or the process has no free file descriptor: later ones may have.
                std::thread::sleep(RETRY);
                continue;
            };
            let (desk, lock) = (desk.clone(), lock.clone());
            // A failure is one of this client's connection. It is closed, which the client sees, and what it held expires.
            std::thread::spawn(move || _ = desk.meet(stream, lock.as_deref()));
        }
    });
    Ok(page)
}

/// A random key of 128 bits, in hexadecimal.
fn key() -> io::Result<String> {
    let mut bytes = [0; 16];
    std::fs::File::open("/dev/urandom")?.read_exact(&mut bytes)?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

impl Desk {
    /// Serves a connection, unless there are too many.
    fn meet(&self, stream: TcpStream, lock: Option<&Lock>) -> io::Result<()> {
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.set_write_timeout(Some(PATIENCE))?;
        let others = self.open.fetch_add(1, Ordering::AcqRel);
        let outcome = match lock {
            _ if others >= MOST => Ok(()),
            Some(lock) => lock.accept(stream).and_then(|stream| self.answer(stream)),
            None => self.answer(stream),
        };
        self.open.fetch_sub(1, Ordering::AcqRel);
        outcome
    }

    fn answer(&self, mut stream: impl Read + Write) -> io::Result<()> {
        let head = read_head(&mut stream)?;
        if opens_socket(&head) {
            return self.socket.listen(Again::new(head, stream));
        }
        let (status, kind, text) = match parse(&head, |host| self.socket.is_ours(host)) {
            Ok(request) if request.path.trim_end_matches('/') == self.socket.key => {
                (200, "text/html; charset=utf-8", PAGE)
            }
            Ok(_) => (
                403,
                "text/plain; charset=utf-8",
                "the address lacks the key: open the address that the session printed\n",
            ),
            Err((status, why)) => (status, "text/plain; charset=utf-8", why),
        };
        write_head(&mut stream, status, kind, text.len() as u64)?;
        stream.write_all(text.as_bytes())?;
        stream.flush()
    }
}

/// Whether the first line of a request asks for the WebSocket, at `/KEY/socket`.
fn opens_socket(head: &[u8]) -> bool {
    let line = head.split(|byte| *byte == b'\n').next();
    line.is_some_and(|line| line.windows(8).any(|eight| eight == b"/socket "))
}
