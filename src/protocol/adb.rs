//! The Android Debug Bridge, between a program and the server of this machine that knows the headsets (TCP port 5037).
//!
//! A request is its length as four hexadecimal digits, and its text. The server answers `OKAY`, or `FAIL` and a reason that is
//! written like a request. `host:transport:SERIAL` (or `host:transport-any`) gives the connection to a device; `shell:COMMAND`
//! after it makes it what the command writes. Source: `OVERVIEW.TXT` and `SERVICES.TXT` of the Android Open Source Project.

use std::fmt;

/// Where the server listens.
pub const PORT: u16 = 5037;
/// Longest request, which four digits allow.
const LONGEST: usize = 0xFFFF;
/// Digits of a length, and letters of a status.
const FOUR: usize = 4;

/// What is wrong with what the other end says.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AdbError {
    /// The server refuses, and why.
    Refused(String),
    /// It speaks another protocol: what came instead of a status or a length.
    Foreign(Vec<u8>),
}

impl fmt::Display for AdbError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AdbError::Refused(why) => f.write_str(why),
            AdbError::Foreign(bytes) => {
                write!(f, "what answers is no adb server: it says {:?}", String::from_utf8_lossy(bytes))
            }
        }
    }
}

impl std::error::Error for AdbError {}

/// A text with its length before it; what is longer than a length can say is cut.
pub fn text(text: &str) -> Vec<u8> {
    let bytes = &text.as_bytes()[..text.len().min(LONGEST)];
    [format!("{:04x}", bytes.len()).as_bytes(), bytes].concat()
}

/// The answer that a request is done.
pub const OKAY: [u8; FOUR] = *b"OKAY";

/// The answer that a request is refused.
pub fn fail(why: &str) -> Vec<u8> {
    [&b"FAIL"[..], &text(why)].concat()
}

/// The first text of some bytes and how many it takes; `None` while its end is missing.
///
/// # Errors
/// They begin with no length.
pub fn first_text(bytes: &[u8]) -> Result<Option<(String, usize)>, AdbError> {
    let Some((digits, rest)) = bytes.split_at_checked(FOUR) else { return Ok(None) };
    let length = std::str::from_utf8(digits)
        .ok()
        .filter(|digits| digits.bytes().all(|digit| digit.is_ascii_hexdigit()))
        .and_then(|digits| usize::from_str_radix(digits, 16).ok())
        .ok_or_else(|| AdbError::Foreign(digits.to_vec()))?;
    Ok(rest.get(..length).map(|text| (String::from_utf8_lossy(text).into_owned(), FOUR + length)))
}

/// What a client does next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Next {
    /// It waits for more of the answer.
    Wait,
    /// It sends this.
    Send(Vec<u8>),
    /// The connection is the command's; these are the first bytes that it wrote.
    Begun(Vec<u8>),
}

/// A client on its way to what a command of a device writes.
///
/// ```
/// use robohive_protocol::adb::{Next, Opening};
///
/// let (mut opening, request) = Opening::new(None, "logcat");
/// assert_eq!(request, b"0012host:transport-any");
/// assert_eq!(opening.take(b"OK")?, Next::Wait);
/// assert_eq!(opening.take(b"AY")?, Next::Send(b"000cshell:logcat".to_vec()));
/// assert_eq!(opening.take(b"OKAY04-12")?, Next::Begun(b"04-12".to_vec()));
/// # Ok::<(), robohive_protocol::adb::AdbError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Opening {
    /// The request that is sent when the present one is done.
    then: Option<Vec<u8>>,
    answer: Vec<u8>,
}

impl Opening {
    /// A client of the only device, or of the one with a serial number, and its first request.
    pub fn new(serial: Option<&str>, command: &str) -> (Self, Vec<u8>) {
        let first =
            serial.map_or_else(|| "host:transport-any".into(), |serial| format!("host:transport:{serial}"));
        (Opening { then: Some(text(&format!("shell:{command}"))), answer: Vec::new() }, text(&first))
    }

    /// Takes bytes of the server, in pieces of any length.
    ///
    /// # Errors
    /// It refuses, or speaks another protocol.
    pub fn take(&mut self, bytes: &[u8]) -> Result<Next, AdbError> {
        self.answer.extend_from_slice(bytes);
        let Some((status, rest)) = self.answer.split_at_checked(FOUR) else { return Ok(Next::Wait) };
        match status {
            b"OKAY" => {
                let rest = rest.to_vec();
                self.answer.clear();
                Ok(self.then.take().map_or(Next::Begun(rest), Next::Send))
            }
            b"FAIL" => first_text(rest)?.map_or(Ok(Next::Wait), |(why, _)| Err(AdbError::Refused(why))),
            other => Err(AdbError::Foreign(other.to_vec())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_carry_their_length() {
        assert_eq!(text("host:version"), b"000chost:version");
        assert_eq!(first_text(b"000chost:versionrest"), Ok(Some(("host:version".into(), 16))));
        assert_eq!(first_text(b"0000"), Ok(Some((String::new(), 4))));
        for short in [&b""[..], b"000", b"000c", b"000Chost"] {
            assert_eq!(first_text(short), Ok(None));
        }
        for wrong in [b"GET ", b"+00c", b"\xff000"] {
            assert_eq!(first_text(wrong), Err(AdbError::Foreign(wrong.to_vec())));
        }
        let long = text(&"x".repeat(70_000));
        assert_eq!((&long[..4], long.len()), (&b"ffff"[..], 65_539));
    }

    #[test]
    fn a_device_is_chosen_and_refusals_come_whole() {
        let (mut opening, first) = Opening::new(Some("1WMHH"), "logcat");
        assert_eq!(first, b"0014host:transport:1WMHH");
        let refusal = fail("device '1WMHH' not found");
        assert_eq!(refusal, b"FAIL0018device '1WMHH' not found");
        let (head, tail) = refusal.split_at(10);
        assert_eq!(opening.take(head), Ok(Next::Wait));
        assert_eq!(opening.take(tail), Err(AdbError::Refused("device '1WMHH' not found".into())));
        let (mut opening, _) = Opening::new(None, "logcat");
        let error = opening.take(b"HTTP/1.1 400").unwrap_err().to_string();
        assert!(error.contains("no adb server") && error.contains("HTTP"), "{error}");
    }
}
