//! The attributes of one instance, as a model declares them.

use std::fmt;

/// What is wrong with the attributes of an instance, or with the elements that use it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AttributeError(String);

impl fmt::Display for AttributeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for AttributeError {}

impl From<String> for AttributeError {
    fn from(message: String) -> Self {
        AttributeError(message)
    }
}

impl From<&str> for AttributeError {
    fn from(message: &str) -> Self {
        AttributeError(message.to_owned())
    }
}

/// Texts of the attributes of an instance, by name; empty where the model says nothing.
#[derive(Clone, Debug)]
pub struct Config<'a> {
    names: &'a [&'a str],
    values: Vec<&'a str>,
}

impl<'a> Config<'a> {
    /// The attributes `names` of a plugin in `bytes`: one text each in order of declaration, ended by a zero byte. What is
    /// not there is empty.
    pub fn new(names: &'a [&'a str], bytes: &'a [u8]) -> Self {
        let mut texts = bytes.split(|&b| b == 0).map(|text| std::str::from_utf8(text).unwrap_or_default());
        Config { names, values: names.iter().map(|_| texts.next().unwrap_or_default()).collect() }
    }

    /// The text of an attribute; empty when the model does not give it.
    pub fn text(&self, name: &str) -> &'a str {
        self.names.iter().position(|n| *n == name).map_or("", |i| self.values[i])
    }

    /// The number that an attribute gives.
    ///
    /// # Errors
    /// Its text is no number, or one beyond 1e100.
    pub fn number(&self, name: &str) -> Result<Option<f64>, AttributeError> {
        let text = self.text(name).trim();
        if text.is_empty() {
            return Ok(None);
        }
        number(text).map(Some).ok_or_else(|| {
            format!("attribute '{name}' is '{text}': write one number, at most {LARGEST:e} in magnitude")
                .into()
        })
    }

    /// The numbers that an attribute lists.
    ///
    /// # Errors
    /// One of its words is no number, or one beyond 1e100.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, AttributeError> {
        let text = self.text(name);
        let read = |word| {
            number(word).ok_or_else(|| {
                format!("attribute '{name}': '{word}' is no number up to {LARGEST:e} in magnitude").into()
            })
        };
        text.split_ascii_whitespace().map(read).collect()
    }
}

/// Largest magnitude of a number, as of those of a model's other elements.
const LARGEST: f64 = 1e100;

fn number(text: &str) -> Option<f64> {
    text.parse::<f64>().ok().filter(|x| x.abs() <= LARGEST)
}
