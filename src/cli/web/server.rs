//! Connections, each answered once by a thread of its own.

use super::http::{media_type, read, write_head};
use super::site::Site;
use crate::failure::Failure;
use std::io::{self, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Most connections at a time.
const CONNECTIONS: usize = 64;
/// How long a browser may take to ask and to read.
const PATIENCE: Duration = Duration::from_secs(20);

/// Answers requests for ever.
pub fn serve(listener: &TcpListener, site: Site) -> Result<(), Failure> {
    let port = listener.local_addr().map_err(Failure::new)?.port();
    let (site, open) = (Arc::new(site), Arc::new(AtomicUsize::new(0)));
    for stream in listener.incoming() {
        // A connection that ended before it was taken.
        let Ok(stream) = stream else { continue };
        let full = open.fetch_add(1, Ordering::Relaxed) >= CONNECTIONS;
        let (site, open) = (site.clone(), open.clone());
        let answering = move || {
            // A browser that goes away is no error.
            let _ = answer(stream, &site, port, full);
            open.fetch_sub(1, Ordering::Relaxed);
        };
        match full {
            true => answering(),
            false => drop(std::thread::spawn(answering)),
        }
    }
    Ok(())
}

fn answer(mut stream: TcpStream, site: &Site, port: u16, full: bool) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    if full {
        return say(&mut stream, 503, "there are too many connections");
    }
    let request = match read(&mut stream, port) {
        Ok(request) => request,
        Err((status, why)) => return refuse(&mut stream, status, why),
    };
    let Some((mut content, length)) = site.open(&request.path) else {
        return refuse(&mut stream, 404, "there is no such file");
    };
    write_head(&mut stream, 200, media_type(&request.path), length)?;
    if !request.head_only {
        io::copy(&mut io::Read::take(&mut content, length), &mut stream)?;
    }
    stream.flush()
}

fn say(stream: &mut TcpStream, status: u16, why: &str) -> io::Result<()> {
    let text = format!("{why}\n");
    write_head(stream, status, "text/plain; charset=utf-8", text.len() as u64)?;
    stream.write_all(text.as_bytes())
}

fn refuse(stream: &mut TcpStream, status: u16, why: &str) -> io::Result<()> {
    say(stream, status, why)?;
    // What was not read would otherwise take the answer with it.
    stream.shutdown(Shutdown::Write)?;
    io::copy(&mut io::Read::take(stream, 1 << 16), &mut io::sink()).map(drop)
}
