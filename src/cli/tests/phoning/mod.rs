//! A scripted page of a phone, on any stream.

use dataset::trace::TraceReader;
use record::Recorded;
use std::io::{ErrorKind, Read, Result, Write};
use std::path::Path;
use std::time::{Duration, Instant};
use tungstenite::{Message, WebSocket};

/// The status line of the answer to a request.
pub fn status(stream: &mut (impl Read + Write), path: &str, host: &str) -> Result<String> {
    write!(stream, "GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n")?;
    let mut answer = Vec::new();
    match stream.read_to_end(&mut answer) {
        // TLS that was not closed: what was read is what counts.
        Err(error) if error.kind() != ErrorKind::UnexpectedEof => return Err(error),
        _ => {}
    }
    Ok(String::from_utf8_lossy(&answer).lines().next().unwrap_or_default().to_owned())
}

/// A page that sends the pose of a phone, which sinks by 0.1 m a second.
pub struct Page<S> {
    socket: WebSocket<S>,
    began: Instant,
    sent: u32,
}

impl<S: Read + Write> Page<S> {
    pub fn new(socket: WebSocket<S>) -> Self {
        Page { socket, began: Instant::now(), sent: 0 }
    }

    /// Sends a number of messages with these buttons held.
    pub fn hold(&mut self, buttons: &str, messages: u32) {
        for _ in 0..messages {
            let time = self.began.elapsed().as_secs_f64();
            let text = format!(
                "{{\"seq\":{},\"time\":{time},\"pose\":[0,{},0,0,0,0,1],\"tracked\":true,\"buttons\":[{buttons}]}}",
                self.sent,
                -0.1 * time
            );
            self.sent += 1;
            self.socket.send(Message::text(text)).unwrap();
            std::thread::sleep(Duration::from_millis(17));
        }
    }
}

/// Asserts that the first episode of a recording has three steps at least.
pub fn assert_recorded(file: &Path) {
    let recorded = Recorded::read(&TraceReader::open(file).unwrap(), "Trial0").unwrap();
    assert!(recorded.actions.row(2).is_some());
}
