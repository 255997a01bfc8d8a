//! Keys from the bytes that a terminal sends: characters and escape sequences, and where it speaks the kitty keyboard protocol
//! (<https://sw.kovidgoyal.net/kitty/keyboard-protocol>) every press and release.

use crate::event::{Button, Event, Key, Lost};

/// Asks whether the terminal speaks the protocol; every terminal answers the second question.
pub const QUESTION: &str = "\x1b[?u\x1b[c";
/// Turns it on (escape codes for all keys, with repetitions and releases), and reports when the window loses the keyboard.
pub const TURN_ON: &str = "\x1b[>11u\x1b[?1004h";
/// Turns it off again.
pub const TURN_OFF: &str = "\x1b[?1004l\x1b[<u";

/// Time after which an escape character is the key, and no beginning of a sequence \[s\].
const ALONE: f64 = 0.03;
/// Longest sequence.
const LONGEST: usize = 64;
/// Bit of Ctrl among the modifiers.
const CTRL: u32 = 4;

/// What the terminal said of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It reports releases when it is asked to.
    Releases,
    /// It has answered everything: it does not speak the protocol unless it has said so before.
    Done,
}

/// Decodes what a terminal sends.
#[derive(Debug, Default)]
pub struct Keyboard {
    /// Bytes of what is not whole yet.
    rest: Vec<u8>,
    /// When the last of them came \[s\].
    since: f64,
    answers: Vec<Answer>,
}

/// What stands at the beginning of some bytes, and how many of them it takes.
enum Found {
    Event(usize, Event),
    Answer(usize, Answer),
    Nothing(usize),
    Incomplete,
}

impl Keyboard {
    /// Takes bytes that came at `now` \[s\].
    pub fn feed(&mut self, bytes: &[u8], now: f64, events: &mut Vec<Event>) {
        self.rest.extend_from_slice(bytes);
        self.since = now;
        while !self.rest.is_empty() {
            let taken = match first(&self.rest) {
                Found::Event(taken, event) => {
                    events.push(event);
                    taken
                }
                Found::Answer(taken, answer) => {
                    self.answers.push(answer);
                    taken
                }
                Found::Nothing(taken) => taken,
                Found::Incomplete if self.rest.len() > LONGEST => self.rest.len(),
                Found::Incomplete => return,
            };
            self.rest.drain(..taken);
        }
    }

    /// Says at `now` \[s\] that an escape character that nothing followed is the key.
    pub fn settle(&mut self, now: f64, events: &mut Vec<Event>) {
        if self.rest.first() == Some(&0x1b) && now - self.since >= ALONE {
            if self.rest.len() == 1 {
                events.push(press(Key::Escape));
            }
            self.rest.clear();
        }
    }

    /// What the terminal has said of itself since the last call.
    pub fn answers(&mut self) -> Vec<Answer> {
        std::mem::take(&mut self.answers)
    }
}

fn press(key: Key) -> Event {
    Event::Press(Button::Key(key))
}

fn first(bytes: &[u8]) -> Found {
    match bytes {
        [0x1b] => Found::Incomplete,
        [0x1b, b'[', rest @ ..] => sequence(rest),
        [0x1b, b'O'] => Found::Incomplete,
        [0x1b, b'O', last, ..] => arrow(*last).map_or(Found::Nothing(3), |key| Found::Event(3, press(key))),
        [0x1b, 0x1b, ..] => Found::Event(1, press(Key::Escape)),
        // Alt and a key.
        [0x1b, ..] => Found::Nothing(2),
        [0x03, ..] => Found::Event(1, press(Key::Interrupt)),
        [b'\r' | b'\n', ..] => Found::Event(1, press(Key::Enter)),
        [b'\t', ..] => Found::Event(1, press(Key::Tab)),
        [0x7f | 0x08, ..] => Found::Event(1, press(Key::Backspace)),
        [0..0x20, ..] => Found::Nothing(1),
        _ => character(bytes),
    }
}

/// A character in UTF-8.
fn character(bytes: &[u8]) -> Found {
    let length = match bytes[0] {
        0..0x80 => 1,
        0xc2..0xe0 => 2,
        0xe0..0xf0 => 3,
        0xf0..0xf5 => 4,
        _ => return Found::Nothing(1),
    };
    let Some(whole) = bytes.get(..length) else { return Found::Incomplete };
    let c = std::str::from_utf8(whole).ok().and_then(|text| text.chars().next());
    c.map_or(Found::Nothing(1), |c| Found::Event(length, press(Key::Char(c.to_ascii_lowercase()))))
}

fn arrow(last: u8) -> Option<Key> {
    Some(match last {
        b'A' => Key::Up,
        b'B' => Key::Down,
        b'C' => Key::Right,
        b'D' => Key::Left,
        b'H' => Key::Home,
        b'F' => Key::End,
        _ => return None,
    })
}

/// A control sequence, `rest` being what follows its introduction.
fn sequence(rest: &[u8]) -> Found {
    let Some(end) = rest.iter().position(|byte| (0x40..0x7f).contains(byte)) else {
        return Found::Incomplete;
    };
    let (taken, last) = (end + 3, rest[end]);
    let Ok(text) = std::str::from_utf8(&rest[..end]) else { return Found::Nothing(taken) };
    if text.starts_with('?') {
        return match last {
            b'u' => Found::Answer(taken, Answer::Releases),
            b'c' => Found::Answer(taken, Answer::Done),
            _ => Found::Nothing(taken),
        };
    }
    let mut parts = text.split(';').map(|part| part.split(':').map(|number| number.parse::<u32>().ok()));
    let number = parts.next().and_then(|mut numbers| numbers.next().flatten());
    let mut second = parts.next().into_iter().flatten();
    let modifiers = second.next().flatten().unwrap_or(1).saturating_sub(1);
    let released = second.next().flatten() == Some(3);
    if last == b'O' && text.is_empty() {
        return Found::Event(taken, Event::Lost(Lost::Keyboard));
    }
    let key = match (last, number) {
        (b'u', Some(code)) => coded(code, modifiers),
        (b'~', Some(3)) => Some(Key::Delete),
        (b'~', Some(5)) => Some(Key::PageUp),
        (b'~', Some(6)) => Some(Key::PageDown),
        (last, _) => arrow(last),
    };
    let event = |key| if released { Event::Release(Button::Key(key)) } else { press(key) };
    key.map_or(Found::Nothing(taken), |key| Found::Event(taken, event(key)))
}

/// The key of a code of the protocol.
fn coded(code: u32, modifiers: u32) -> Option<Key> {
    Some(match code {
        27 => Key::Escape,
        13 => Key::Enter,
        9 => Key::Tab,
        127 => Key::Backspace,
        99 if modifiers & CTRL != 0 => Key::Interrupt,
        // Keys without a character have codes of the private use area.
        57344..=63743 => return None,
        code => Key::Char(char::from_u32(code)?.to_ascii_lowercase()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(bytes: &[u8]) -> Vec<Event> {
        let mut events = Vec::new();
        Keyboard::default().feed(bytes, 0.0, &mut events);
        events
    }

    fn release(key: Key) -> Event {
        Event::Release(Button::Key(key))
    }

    #[test]
    fn plain_terminals_send_characters_and_arrows() {
        let keys = decoded(b"dA\x1b[A\x1b[D\x1bOB\r\x7f\x03\x1b[3~\x1b[5~ \xc3\xa4\x01");
        let expected = [
            Key::Char('d'),
            Key::Char('a'),
            Key::Up,
            Key::Left,
            Key::Down,
            Key::Enter,
            Key::Backspace,
            Key::Interrupt,
            Key::Delete,
            Key::PageUp,
            Key::Char(' '),
            Key::Char('ä'),
        ];
        assert_eq!(keys, expected.map(press));
    }

    #[test]
    fn the_protocol_tells_releases() {
        let bytes = b"\x1b[100;1:1u\x1b[100;1:2u\x1b[100;1:3u\x1b[1;1:1A\x1b[1;1:3A\x1b[27u\x1b[99;5u\x1b[57441;2u\x1b[13;1:3u\x1b[O";
        let d = Key::Char('d');
        let expected = [
            press(d),
            press(d),
            release(d),
            press(Key::Up),
            release(Key::Up),
            press(Key::Escape),
            press(Key::Interrupt),
            release(Key::Enter),
            Event::Lost(Lost::Keyboard),
        ];
        assert_eq!(decoded(bytes), expected);
    }

    #[test]
    fn pieces_of_any_length_decode_alike() {
        let bytes = b"d\x1b[A\x1b[100;1:3u\xc3\xa4\x1b[?1u\x1b[?62;4cq";
        let whole = decoded(bytes);
        for size in 1..bytes.len() {
            let (mut keyboard, mut events) = (Keyboard::default(), Vec::new());
            bytes.chunks(size).for_each(|piece| keyboard.feed(piece, 0.0, &mut events));
            assert_eq!(
                (&events, keyboard.answers()),
                (&whole, vec![Answer::Releases, Answer::Done]),
                "{size}"
            );
        }
    }

    #[test]
    fn escape_is_a_key_when_nothing_follows() {
        let (mut keyboard, mut events) = (Keyboard::default(), Vec::new());
        keyboard.feed(b"\x1b", 1.0, &mut events);
        keyboard.settle(1.01, &mut events);
        assert!(events.is_empty());
        keyboard.settle(1.04, &mut events);
        assert_eq!(events, [press(Key::Escape)]);
        keyboard.feed(b"d", 2.0, &mut events);
        assert_eq!(events.len(), 2);
    }

    #[test]
    fn no_bytes_are_too_strange() {
        // A sequence that never ends, bytes that are no UTF-8, and what comes after them.
        let (mut keyboard, mut events) = (Keyboard::default(), Vec::new());
        keyboard.feed(&[&b"\x1b["[..], &[b'1'; 200]].concat(), 0.0, &mut events);
        keyboard.feed(b"d", 0.0, &mut events);
        assert_eq!(events, [press(Key::Char('d'))]);
        assert_eq!(decoded(b"\xff\xc3(x"), [press(Key::Char('(')), press(Key::Char('x'))]);
        for a in 0..=255_u8 {
            for b in [0, 0x1b, b'[', b'?', b';', b':', 0x7e, 0xff] {
                let (mut keyboard, mut events) = (Keyboard::default(), Vec::new());
                keyboard.feed(&[0x1b, b'[', a, b, a, 0x1b, b, a], 0.0, &mut events);
                keyboard.settle(9.0, &mut events);
            }
        }
    }
}
