//! As much of HTTP/1.1 as a static page needs (RFC 9110, RFC 9112).

use std::io::{self, Read, Write};

/// Most bytes of a request's head.
const HEAD: usize = 8 << 10;

/// What is asked for.
#[derive(Debug, PartialEq, Eq)]
pub struct Request {
    /// Whether only the head of the answer is wanted.
    pub head_only: bool,
    /// The path without the slash it begins with, decoded.
    pub path: String,
}

/// Why a request is not answered: the status, and what to say.
pub type Refusal = (u16, &'static str);

/// Reads a request that was sent to `port` of this machine.
pub fn read(source: &mut impl Read, port: u16) -> Result<Request, Refusal> {
    let head = read_head(source).map_err(|_| (408, "the request did not come in time"))?;
    parse(&head, |host| is_this_machine(host, port))
}

/// Reads a request's head up to its empty line, and what comes with it; less where it ends before, or is too long.
pub fn read_head(source: &mut impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut piece = [0; 1024];
    while end(&bytes).is_none() && bytes.len() <= HEAD {
        match source.read(&mut piece)? {
            0 => break,
            count => bytes.extend_from_slice(&piece[..count]),
        }
    }
    Ok(bytes)
}

/// Where a request's head ends.
fn end(bytes: &[u8]) -> Option<usize> {
    bytes.windows(4).position(|four| four == b"\r\n\r\n")
}

/// The request of a head, which was sent to a host that is ours.
pub fn parse(bytes: &[u8], is_ours: impl Fn(&str) -> bool) -> Result<Request, Refusal> {
    let Some(end) = end(bytes) else {
        return Err(if bytes.len() > HEAD {
            (431, "the head of the request is too large")
        } else {
            (400, "the request has no end")
        });
    };
    let head = std::str::from_utf8(&bytes[..end]).map_err(|_| (400, "the request is not UTF-8"))?;
    let mut lines = head.split("\r\n");
    let words: Vec<&str> = lines.next().unwrap_or_default().split(' ').collect();
    let [method, target, version] = words[..] else {
        return Err((400, "the request has no method, path and version"));
    };
    if !version.starts_with("HTTP/1.") {
        return Err((505, "only HTTP/1.1 is understood"));
    }
    let mut hosts = lines
        .filter_map(|line| line.split_once(':'))
        .filter(|(name, _)| name.eq_ignore_ascii_case("host"))
        .map(|(_, value)| value.trim());
    // Other names may lead here from pages of others, whose scripts could then read what is served.
    if !hosts.next().is_some_and(is_ours) || hosts.next().is_some() {
        return Err((403, "only requests to the printed address, or to the loopback address, are answered"));
    }
    let head_only = match method {
        "GET" => false,
        "HEAD" => true,
        _ => return Err((405, "only GET and HEAD are understood")),
    };
    let path = target.split(['?', '#']).next().unwrap_or_default();
    let path = path.strip_prefix('/').ok_or((400, "the path begins with no slash"))?;
    let path = decode(path).ok_or((400, "the path is badly encoded"))?;
    let hostile = |part: &str| part == ".." || part == "." || part.contains(['\\', '\0', ':']);
    if path.split('/').any(hostile) {
        return Err((400, "the path leads elsewhere"));
    }
    Ok(Request { head_only, path })
}

fn is_this_machine(host: &str, port: u16) -> bool {
    let name = host.strip_suffix(&format!(":{port}")).unwrap_or(host);
    name.eq_ignore_ascii_case("localhost")
        || name
            .trim_start_matches('[')
            .trim_end_matches(']')
            .parse::<std::net::IpAddr>()
            .is_ok_and(|ip| ip.is_loopback())
}

/// Without percent encoding; nothing if that is wrong.
fn decode(text: &str) -> Option<String> {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let (digits, after) = rest.split_at_checked(2)?;
        let digits = std::str::from_utf8(digits)
            .ok()
            .filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()))?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        rest = after;
    }
    String::from_utf8(bytes).ok()
}

/// A value of a link, percent encoded.
pub fn encode(text: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~/".contains(&byte);
    text.bytes().map(|b| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") }).collect()
}

/// The type of a file by the end of its name.
pub fn media_type(path: &str) -> &'static str {
    match path.rsplit_once('.').map_or("html", |(_, end)| end) {
        "html" => "text/html; charset=utf-8",
        "js" | "mjs" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "wasm" => "application/wasm",
        "json" => "application/json",
        "xml" | "urdf" => "text/xml",
        "txt" | "md" | "ts" | "obj" => "text/plain; charset=utf-8",
        "png" => "image/png",
        "svg" => "image/svg+xml",
        _ => "application/octet-stream",
    }
}

/// Writes the head of an answer.
pub fn write_head(sink: &mut impl Write, status: u16, kind: &str, length: u64) -> io::Result<()> {
    let reason = match status {
        200 => "OK",
        404 => "Not Found",
        405 => "Method Not Allowed",
        503 => "Service Unavailable",
        _ => "Refused",
    };
    let allow = if status == 405 { "allow: GET, HEAD\r\n" } else { "" };
    write!(
        sink,
        "HTTP/1.1 {status} {reason}\r\ncontent-type: {kind}\r\ncontent-length: {length}\r\n{allow}cache-control: no-cache\r\n\
         x-content-type-options: nosniff\r\ncross-origin-resource-policy: same-origin\r\nconnection: close\r\n\r\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(line: &str, host: &str) -> Result<Request, u16> {
        let text = format!("{line}\r\nHost: {host}\r\nAccept: */*\r\n\r\n");
        read(&mut text.as_bytes(), 8080).map_err(|(status, _)| status)
    }

    #[test]
    fn requests_are_read() {
        let path = |path: &str| Ok(Request { head_only: false, path: path.into() });
        assert_eq!(asked("GET / HTTP/1.1", "localhost:8080"), path(""));
        assert_eq!(asked("GET /a%20b/c.js?x#y HTTP/1.1", "127.0.0.1:8080"), path("a b/c.js"));
        assert_eq!(asked("GET /%C3%A9 HTTP/1.1", "[::1]:8080"), path("é"));
        assert_eq!(asked("HEAD /x HTTP/1.0", "LOCALHOST"), Ok(Request { head_only: true, path: "x".into() }));
    }

    #[test]
    fn others_are_refused() {
        for (line, status) in [
            ("GET /../x HTTP/1.1", 400),
            ("GET /%2e%2e/x HTTP/1.1", 400),
            ("GET /..%5cx HTTP/1.1", 400),
            ("GET /c:/x HTTP/1.1", 400),
            ("GET /a%00 HTTP/1.1", 400),
            ("GET /%ff HTTP/1.1", 400),
            ("GET /%4 HTTP/1.1", 400),
            ("GET /%+1 HTTP/1.1", 400),
            ("GET x HTTP/1.1", 400),
            ("GET /", 400),
            ("POST / HTTP/1.1", 405),
            ("GET / HTTP/2", 505),
        ] {
            assert_eq!(asked(line, "localhost:8080"), Err(status), "{line}");
        }
        for host in
            ["evil.example", "evil.example:8080", "localhost.evil.example", "10.0.0.1:8080", "localhost:81"]
        {
            assert_eq!(asked("GET / HTTP/1.1", host), Err(403), "{host}");
        }
        let twice = "GET / HTTP/1.1\r\nHost: localhost\r\nHost: evil.example\r\n\r\n";
        assert_eq!(read(&mut twice.as_bytes(), 8080).map_err(|(status, _)| status), Err(403));
        let long = format!("GET /{} HTTP/1.1\r\n", "a".repeat(2 * HEAD));
        assert_eq!(read(&mut long.as_bytes(), 8080).map_err(|(status, _)| status), Err(431));
    }

    #[test]
    fn links_are_encoded() {
        assert_eq!(encode("open/a b&c.xml"), "open/a%20b%26c.xml");
        assert_eq!(decode(&encode("é#?%")).as_deref(), Some("é#?%"));
    }
}
