//! The WebSocket of a page: who may open it, and its messages, which become lines of a headset's log.

use super::message::Messages;
use std::io::{self, Cursor, Read, Write};
use std::os::unix::net::UnixStream;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tungstenite::protocol::WebSocketConfig;

/// Bytes of the longest message.
const LONGEST: usize = 4096;

/// A stream whose first bytes have already been read.
pub struct Again<S> {
    first: Cursor<Vec<u8>>,
    stream: S,
}

impl<S> Again<S> {
    /// The stream that begins with these bytes.
    pub fn new(first: Vec<u8>, stream: S) -> Self {
        Again { first: Cursor::new(first), stream }
    }
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

/// The socket of a session, for one page at a time.
pub struct Socket {
    /// Scheme, and hosts with the port, of the page.
    scheme: &'static str,
    hosts: Vec<String>,
    /// Key of the session.
    pub key: String,
    /// Where the lines go.
    lines: UnixStream,
    taken: AtomicBool,
    began: Instant,
}

impl Socket {
    /// A socket that no page has opened yet.
    pub fn new(scheme: &'static str, hosts: Vec<String>, key: String, lines: UnixStream) -> Self {
        Socket { scheme, hosts, key, lines, taken: AtomicBool::new(false), began: Instant::now() }
    }

    /// Whether a request to this host is one to the page; browsers write it as the address that was printed.
    pub fn is_ours(&self, host: &str) -> bool {
        self.hosts.iter().any(|ours| ours == host)
    }

    /// Reads the messages of a page until it disconnects; a second page is refused.
    #[expect(clippy::result_large_err, reason = "the handshake of tungstenite asks for it")]
    pub fn listen(&self, stream: impl Read + Write) -> io::Result<()> {
        let config = WebSocketConfig::default().max_message_size(Some(LONGEST)).max_frame_size(Some(LONGEST));
        let check = |request: &Request, response: Response| {
            if self.admits(request) { Ok(response) } else { Err(forbidden()) }
        };
        let Ok(mut socket) = tungstenite::accept_hdr_with_config(stream, check, Some(config)) else {
            // Who is refused was told so in the handshake.
            return Ok(());
        };
        if !self.taken.swap(true, Ordering::AcqRel) {
            let mut messages = Messages::default();
            while let Ok(message) = socket.read() {
                // A ping, or a message that is damaged, has no pose.
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
        let host = header("host").filter(|host| self.is_ours(host));
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
