//! A page for phones and headsets, on the loopback or behind TLS on the local network, and the poses that it sends over a WebSocket.

mod message;
#[cfg(feature = "tls")]
mod tls;

use super::reach::Reach;
use crate::failure::Failure;
use crate::web::http::{read_for, write_head};
use message::Messages;
use std::fmt::Write as _;
use std::io::{self, Cursor, Read, Write};
use std::net::{Ipv4Addr, SocketAddr, TcpListener, TcpStream, UdpSocket};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tungstenite::protocol::WebSocketConfig;

const PAGE: &str = include_str!("page.html");
/// Longest wait for a request.
const PATIENCE: Duration = Duration::from_secs(10);
/// Bytes of the longest message.
const LONGEST: usize = 4096;
/// Bytes of the longest head of a request.
const HEAD: usize = 8192;
/// Largest number of connections at once.
const MOST: usize = 16;

/// State that all connections share.
struct Desk {
    /// Scheme, and hosts with the port, of this page.
    scheme: &'static str,
    hosts: Vec<String>,
    open: AtomicUsize,
    key: String,
    lines: UnixStream,
    taken: AtomicBool,
    began: Instant,
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
        Reach::Network(port) => network(port)?,
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
    let (open, taken) = (AtomicUsize::new(0), AtomicBool::new(false));
    let desk = Arc::new(Desk { scheme, hosts, open, key, lines, taken, began: Instant::now() });
    let lock = lock.map(Arc::new);
    std::thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let (desk, lock) = (desk.clone(), lock.clone());
            // A closed connection is not an error.
            std::thread::spawn(move || desk.meet(stream, lock.as_deref()).unwrap_or_default());
        }
    });
    Ok(page)
}

/// This machine's address on its network. No packet is sent.
fn network(port: u16) -> Result<SocketAddr, Failure> {
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
use tls::Identity as Lock;

/// Placeholder for TLS in builds without it.
#[cfg(not(feature = "tls"))]
enum Lock {}

#[cfg(not(feature = "tls"))]
impl Lock {
    fn new(_: SocketAddr) -> Result<Self, Failure> {
        Err(Failure::usage(
            "this build has no TLS, which browsers require on a network: build with --features tls, or use --device phone and `adb reverse`",
        ))
    }

    fn fingerprint(&self) -> &str {
        match *self {}
    }

    fn accept(&self, _: TcpStream) -> io::Result<TcpStream> {
        match *self {}
    }
}

/// A stream whose first bytes have already been read.
struct Again<S> {
    first: Cursor<Vec<u8>>,
    stream: S,
}

impl<S: Read> Read for Again<S> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        match self.first.read(bytes)? {
            0 => self.stream.read(bytes),
            count => Ok(count),
        }
    }
}

impl<S: Write> Write for Again<S> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

/// A random key of 128 bits, in hexadecimal.
fn key() -> io::Result<String> {
    let mut bytes = [0; 16];
    std::fs::File::open("/dev/urandom")?.read_exact(&mut bytes)?;
    let mut text = String::new();
    bytes.iter().for_each(|byte| write!(text, "{byte:02x}").unwrap_or_default());
    Ok(text)
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
        let mut first = Vec::new();
        let mut piece = [0; 1024];
        while !first.windows(4).any(|four| four == b"\r\n\r\n") && first.len() < HEAD {
            match stream.read(&mut piece)? {
                0 => break,
                count => first.extend_from_slice(&piece[..count]),
            }
        }
        let line = first.split(|byte| *byte == b'\n').next().unwrap_or_default();
        let listens = String::from_utf8_lossy(line).contains("/socket ");
        let mut stream = Again { first: Cursor::new(first), stream };
        if listens {
            return self.listen(stream);
        }
        let is_ours = |host: &str| self.hosts.iter().any(|ours| ours.eq_ignore_ascii_case(host));
        let (status, kind, text) = match read_for(&mut stream, is_ours) {
            Ok(request) if request.path.trim_end_matches('/') == self.key => {
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

    /// Reads the messages of a page until it disconnects; a second page is refused.
    #[expect(clippy::result_large_err, reason = "the handshake of tungstenite asks for it")]
    fn listen(&self, stream: impl Read + Write) -> io::Result<()> {
        let config = WebSocketConfig::default().max_message_size(Some(LONGEST)).max_frame_size(Some(LONGEST));
        let check = |request: &Request, response: Response| {
            if self.admits(request) { Ok(response) } else { Err(forbidden()) }
        };
        let Ok(mut socket) = tungstenite::accept_hdr_with_config(stream, check, Some(config)) else {
            return Ok(());
        };
        if !self.taken.swap(true, Ordering::AcqRel) {
            let mut messages = Messages::default();
            while let Ok(message) = socket.read() {
                let line = message
                    .to_text()
                    .ok()
                    .and_then(|text| messages.line(text, self.began.elapsed().as_secs_f64()));
                if let Some(line) = line {
                    (&self.lines).write_all(line.as_bytes())?;
                }
            }
            self.taken.store(false, Ordering::Release);
        }
        Ok(())
    }

    /// Whether a request comes from our page, with the key.
    fn admits(&self, request: &Request) -> bool {
        let header = |name: &str| request.headers().get(name).and_then(|value| value.to_str().ok());
        let host = header("host").filter(|host| self.hosts.iter().any(|ours| ours == host));
        let ours = |origin: &str| host.is_some_and(|host| origin == format!("{}://{host}", self.scheme));
        let origin = header("origin").is_none_or(ours);
        host.is_some() && origin && request.uri().path() == format!("/{}/socket", self.key)
    }
}

fn forbidden() -> ErrorResponse {
    let mut refusal = ErrorResponse::new(None);
    *refusal.status_mut() = tungstenite::http::StatusCode::FORBIDDEN;
    refusal
}
