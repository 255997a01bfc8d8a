//! Attribute text to values, with MuJoCo's strictness: numbers in the syntax of C's `strtod` without
//! hexadecimal, separated by white space; no number out of range; no NaN.

/// A token that is not what the attribute wants.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextError {
    /// Byte offset of the token in the attribute's value.
    pub offset: usize,
    /// What is wrong with it.
    pub message: String,
}

/// A number type of attributes.
pub(crate) trait Number: Sized {
    /// Reads one token.
    fn read(token: &str) -> Result<Self, String>;

    /// Whether arithmetic with the number overflows: infinite, or so large that a product of a few is.
    fn overflows(&self) -> bool;
}

/// Largest number that enters arithmetic: the product of three stays finite.
pub const LARGEST: f64 = 1e100;

fn finite_or_spelled<T: PartialEq>(token: &str, value: T, overflow: bool, nan: bool) -> Result<T, String> {
    let spelled = token.trim_start_matches(['+', '-']).starts_with(['i', 'I']);
    if nan {
        return Err(format!("'{token}' is not allowed: values must be numbers"));
    }
    if overflow && !spelled {
        return Err(format!("number '{token}' is too large"));
    }
    Ok(value)
}

impl Number for f64 {
    fn read(token: &str) -> Result<f64, String> {
        let x: f64 = token.parse().map_err(|_| format!("'{token}' is not a number"))?;
        finite_or_spelled(token, x, x.is_infinite(), x.is_nan())
    }

    fn overflows(&self) -> bool {
        self.abs() > LARGEST
    }
}

impl Number for f32 {
    fn read(token: &str) -> Result<f32, String> {
        let x: f32 = token.parse().map_err(|_| format!("'{token}' is not a number"))?;
        finite_or_spelled(token, x, x.is_infinite(), x.is_nan())
    }

    fn overflows(&self) -> bool {
        self.is_infinite()
    }
}

impl Number for i32 {
    fn read(token: &str) -> Result<i32, String> {
        let digits = token.strip_prefix(['+', '-']).unwrap_or(token);
        if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
            return Err(format!("'{token}' is not an integer"));
        }
        token.parse().map_err(|_| format!("integer '{token}' is too large"))
    }

    fn overflows(&self) -> bool {
        false
    }
}

/// The words of `text` with their byte offsets.
pub fn words(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.split_ascii_whitespace().map(move |w| (w.as_ptr() as usize - text.as_ptr() as usize, w))
}

/// All numbers of `text`.
pub fn numbers<T: Number>(text: &str) -> Result<Vec<T>, TextError> {
    let read =
        |(offset, word)| T::read(word).map_err(|message| TextError { offset, message: shorten(message) });
    words(text).map(read).collect()
}

/// Messages quote user text; this keeps one within a line.
fn shorten(message: String) -> String {
    match message.char_indices().nth(120) {
        Some((end, _)) => format!("{}…", &message[..end]),
        None => message,
    }
}
