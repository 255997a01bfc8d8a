//! CyberGloves: serial lines of 115 200 bits a second, 8N1.
//!
//! A command is a letter, and the glove repeats it before its answer, which ends with a zero. `G` asks for one sample, `S` for one after
//! the other until the byte 0x03; a sample has a byte from 1 to 255 for each of 18 or 22 sensors, so that the zero ends it alone. `?` and a letter asks for a
//! setting. Errors are `e` and a letter. Source: the CyberGlove's documentation, and the driver of RoboHive's program Puppet.

use std::fmt;

/// Bits a second.
pub const BAUD: u32 = 115_200;
/// Ends a stream of samples.
pub const STOP: u8 = 0x03;
/// Resets the glove, as a power cycle does.
pub const RESET: u8 = 0x12;
/// Asks for one sample.
pub const SAMPLE: u8 = b'G';
/// Asks for a stream of samples.
pub const STREAM: u8 = b'S';
/// Asks how many sensors there are.
pub const COUNT: [u8; 2] = *b"?S";
/// Most sensors of a glove.
pub const MOST: usize = 22;

/// What the sensors of a glove with 22 measure, in their order. Nothing measures the abduction of the index, from which that of the middle
/// finger is counted. Gloves with 18 lack the outer joints of the four fingers.
pub const SENSORS: [&str; MOST] = [
    "thumb_roll",
    "thumb_inner",
    "thumb_outer",
    "thumb_abduction",
    "index_inner",
    "index_middle",
    "index_outer",
    "middle_inner",
    "middle_middle",
    "middle_outer",
    "middle_abduction",
    "ring_inner",
    "ring_middle",
    "ring_outer",
    "ring_abduction",
    "pinky_inner",
    "pinky_middle",
    "pinky_outer",
    "pinky_abduction",
    "palm_arch",
    "wrist_flexion",
    "wrist_abduction",
];

/// What a glove refuses, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GloveError {
    /// It does not know the command.
    Unknown,
    /// No glove is plugged into the interface.
    Unplugged,
    /// It cannot sample that fast.
    Rate,
    /// Another letter.
    Other(u8),
}

impl GloveError {
    /// The letter after `e`.
    pub fn letter(self) -> u8 {
        match self {
            GloveError::Unknown => b'?',
            GloveError::Unplugged => b'g',
            GloveError::Rate => b's',
            GloveError::Other(letter) => letter,
        }
    }

    fn of(letter: u8) -> Self {
        [GloveError::Unknown, GloveError::Unplugged, GloveError::Rate]
            .into_iter()
            .find(|known| known.letter() == letter)
            .unwrap_or(GloveError::Other(letter))
    }
}

impl fmt::Display for GloveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            GloveError::Unknown => f.write_str("it does not know the command"),
            GloveError::Unplugged => f.write_str("no glove is plugged into the interface"),
            GloveError::Rate => f.write_str("it cannot sample that fast"),
            GloveError::Other(letter) => write!(f, "it reports the error '{}'", letter.escape_ascii()),
        }
    }
}

impl std::error::Error for GloveError {}

/// The command that sets the sample rate \[Hz\]: 115 200 over the rate, and how often that is waited for.
///
/// ```
/// assert_eq!(robohive_protocol::cyberglove::rate(80.0), [b'T', 0x05, 0xA0, 0, 1]);
/// ```
pub fn rate(hertz: f64) -> [u8; 5] {
    let [high, low] =
        ((f64::from(BAUD) / hertz).round().clamp(1.0, f64::from(u16::MAX)) as u16).to_be_bytes();
    [b'T', high, low, 0, 1]
}

/// Something that a glove says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Message {
    /// A sample: what every sensor measures, 1 to 255.
    Sample(Vec<u8>),
    /// How many sensors there are.
    Sensors(u8),
    /// It refuses.
    Error(GloveError),
}

/// A sample on the wire, as the answer to this letter.
pub fn sample(letter: u8, values: &[u8]) -> Vec<u8> {
    let values = values.iter().map(|value| (*value).max(1));
    [letter].into_iter().chain(values).chain([0]).collect()
}

/// Messages out of bytes in pieces of any length.
#[derive(Clone, Debug)]
pub struct Decoder {
    sensors: usize,
    rest: Vec<u8>,
}

impl Default for Decoder {
    /// A decoder for 22 sensors, until the glove says otherwise.
    fn default() -> Self {
        Decoder { sensors: MOST, rest: Vec::new() }
    }
}

impl Decoder {
    /// Takes bytes.
    pub fn feed(&mut self, bytes: &[u8]) {
        self.rest.extend_from_slice(bytes);
    }

    /// The next message; what is damaged is left out, and so are echoes.
    pub fn next_message(&mut self) -> Option<Message> {
        loop {
            let (message, length) = match *self.rest.as_slice() {
                [b'?', b'S', count, 0, ..] => {
                    if count == 18 || count == 22 {
                        self.sensors = usize::from(count);
                    }
                    (Some(Message::Sensors(count)), 4)
                }
                [b'?', b'S', ..] | [b'?'] if self.rest.len() < 4 => return None,
                [b'e', letter, ..] => (Some(Message::Error(GloveError::of(letter))), 2),
                [b'e'] => return None,
                [SAMPLE | STREAM, ref values @ ..] => {
                    let end = values.iter().take(self.sensors + 1).position(|value| *value == 0);
                    match end {
                        Some(end) if end == self.sensors => {
                            (Some(Message::Sample(values[..end].to_vec())), end + 2)
                        }
                        None if values.len() <= self.sensors => return None,
                        // A zero that comes too early or too late: a byte is missing, or one too many.
                        Some(end) => (None, end + 2),
                        None => (None, 1),
                    }
                }
                [_, ..] => (None, 1),
                [] => return None,
            };
            self.rest.drain(..length);
            if message.is_some() {
                return message;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decoded(pieces: &[&[u8]]) -> Vec<Message> {
        let mut decoder = Decoder::default();
        let mut all = Vec::new();
        for piece in pieces {
            decoder.feed(piece);
            all.extend(std::iter::from_fn(|| decoder.next_message()));
        }
        all
    }

    #[test]
    fn samples_come_out_of_any_pieces_and_whole() {
        let values: Vec<u8> = (1..=22).map(|k| if k % 7 == 0 { b'S' } else { k * 9 }).collect();
        let line = [sample(STREAM, &values), sample(SAMPLE, &[0; 22])].concat();
        assert_eq!((line.len(), line[0], line[23], line[24]), (48, b'S', 0, b'G'));
        let expected = [Message::Sample(values), Message::Sample(vec![1; 22])];
        for size in 1..9 {
            assert_eq!(decoded(&line.chunks(size).collect::<Vec<_>>()), expected, "{size}");
        }
    }

    #[test]
    fn a_damaged_sample_does_not_hide_the_next() {
        let good: Vec<u8> = (100..122).collect();
        let line = sample(STREAM, &good);
        let short = [&line[..9], &line[10..]].concat();
        let long = [&line[..9], &line[8..]].concat();
        let whole = Message::Sample(good);
        assert_eq!(decoded(&[&short, &line]), std::slice::from_ref(&whole));
        assert_eq!(decoded(&[&long, &line, &line]).last(), Some(&whole));
        // The end of a sample that had begun before anybody listened.
        assert_eq!(decoded(&[&line[5..], &line]), [whole]);
    }

    #[test]
    fn counts_and_errors_are_understood() {
        let small = sample(SAMPLE, &[7; 18]);
        let said = [&b"?S\x12\0"[..], &small, b"e?", b"eg", b"es", b"ex"].concat();
        let error = Message::Error;
        let expected = [
            Message::Sensors(18),
            Message::Sample(vec![7; 18]),
            error(GloveError::Unknown),
            error(GloveError::Unplugged),
            error(GloveError::Rate),
            error(GloveError::Other(b'x')),
        ];
        assert_eq!(decoded(&said.chunks(1).collect::<Vec<_>>()), expected);
        assert!(GloveError::Unplugged.to_string().contains("no glove is plugged"));
        let mut names = SENSORS.to_vec();
        assert!(!names.contains(&"index_abduction") && names.contains(&"middle_abduction"));
        names.dedup();
        assert_eq!(
            names.iter().filter(|name| !name.ends_with("outer") || **name == "thumb_outer").count(),
            18
        );
    }
}
