//! A page on the loopback for phones and headsets, and the poses that it sends over a WebSocket.

mod message;

use crate::failure::Failure;
use crate::web::http::{read, write_head};
use message::Messages;
use std::fmt::Write as _;
use std::io::{self, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};
use tungstenite::handshake::server::{ErrorResponse, Request, Response};
use tungstenite::protocol::WebSocketConfig;

const PAGE: &str = include_str!("page.html");
/// How long a browser may take to ask.
const PATIENCE: Duration = Duration::from_secs(10);
/// Longest message.
const LONGEST: usize = 4096;

/// What all connections share.
struct Desk {
    port: u16,
    key: String,
    lines: UnixStream,
    taken: AtomicBool,
    began: Instant,
}

/// Serves the page until the program ends: what its messages become, and its address with the key of this session.
pub fn serve(port: u16) -> Result<(OwnedFd, String), Failure> {
    let failed = |error: io::Error| {
        Failure::new(format!("port {port} of 127.0.0.1: {error}; phone:0 takes a free one"))
    };
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, port)).map_err(failed)?;
    let port = listener.local_addr().map_err(failed)?.port();
    let (lines, ours) = UnixStream::pair().map_err(failed)?;
    ours.set_nonblocking(true).map_err(failed)?;
    let key = key().map_err(failed)?;
    let address = format!("http://127.0.0.1:{port}/{key}");
    let desk = Arc::new(Desk { port, key, lines, taken: AtomicBool::new(false), began: Instant::now() });
    std::thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let desk = desk.clone();
            // A browser that goes away is no error.
            std::thread::spawn(move || desk.answer(stream).unwrap_or_default());
        }
    });
    Ok((ours.into(), address))
}

/// 128 bits that nobody guesses.
fn key() -> io::Result<String> {
    let mut bytes = [0; 16];
    std::fs::File::open("/dev/urandom")?.read_exact(&mut bytes)?;
    let mut text = String::new();
    bytes.iter().for_each(|byte| write!(text, "{byte:02x}").unwrap_or_default());
    Ok(text)
}

impl Desk {
    fn answer(&self, mut stream: TcpStream) -> io::Result<()> {
        stream.set_read_timeout(Some(PATIENCE))?;
        stream.set_write_timeout(Some(PATIENCE))?;
        let mut head = [0; 4096];
        let count = stream.peek(&mut head)?;
        let first = head[..count].split(|byte| *byte == b'\n').next().unwrap_or_default();
        if String::from_utf8_lossy(first).contains("/socket ") {
            return self.listen(stream);
        }
        let (status, kind, text) = match read(&mut stream, self.port) {
            Ok(request) if request.path.trim_end_matches('/') == self.key => {
                (200, "text/html; charset=utf-8", PAGE)
            }
            Ok(_) => {
                (403, "text/plain; charset=utf-8", "the address lacks the key that the session has printed\n")
            }
            Err((status, why)) => (status, "text/plain; charset=utf-8", why),
        };
        write_head(&mut stream, status, kind, text.len() as u64)?;
        stream.write_all(text.as_bytes())
    }

    /// Takes messages of a page until it goes; of two the second is refused.
    #[expect(clippy::result_large_err, reason = "the handshake of tungstenite asks for it")]
    fn listen(&self, stream: TcpStream) -> io::Result<()> {
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

    /// Whether a page of ours asks, with the key.
    fn admits(&self, request: &Request) -> bool {
        let hosts = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let header = |name: &str| request.headers().get(name).and_then(|value| value.to_str().ok());
        let host = header("host").filter(|host| hosts.iter().any(|ours| ours == host));
        let ours = |origin: &str| host.is_some_and(|host| origin == format!("http://{host}"));
        let origin = header("origin").is_none_or(ours);
        host.is_some() && origin && request.uri().path() == format!("/{}/socket", self.key)
    }
}

fn forbidden() -> ErrorResponse {
    let mut refusal = ErrorResponse::new(None);
    *refusal.status_mut() = tungstenite::http::StatusCode::FORBIDDEN;
    refusal
}
