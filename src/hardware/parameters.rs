//! Parameters of an interface, as a driver reads them.

use robot::{DeviceConfig, Fault, Value};
use std::collections::BTreeMap;

/// The entries of a device's interface that no driver has read yet. What is left when a driver has read all it knows is an
/// error, so that a misspelt key is not ignored.
#[derive(Clone, Debug)]
pub struct Parameters {
    left: BTreeMap<String, Value>,
    known: Vec<&'static str>,
}

fn refused(key: &str, why: &str) -> Fault {
    Fault::Refused(format!("the parameter '{key}' of its interface {why}"))
}

impl Parameters {
    /// Those of a device.
    pub fn new(config: &DeviceConfig) -> Parameters {
        Parameters { left: config.interface.parameters.clone(), known: Vec::new() }
    }

    fn take(&mut self, key: &'static str) -> Option<Value> {
        self.known.push(key);
        self.left.remove(key).filter(|value| *value != Value::None)
    }

    /// A text.
    ///
    /// # Errors
    /// The value is something else.
    pub fn text(&mut self, key: &'static str) -> Result<Option<String>, Fault> {
        match self.take(key) {
            None => Ok(None),
            Some(Value::Text(text)) => Ok(Some(text)),
            Some(_) => Err(refused(key, "is not a text")),
        }
    }

    /// Yes or no.
    ///
    /// # Errors
    /// The value is something else.
    pub fn flag(&mut self, key: &'static str, otherwise: bool) -> Result<bool, Fault> {
        match self.take(key) {
            None => Ok(otherwise),
            Some(Value::Bool(value)) => Ok(value),
            Some(_) => Err(refused(key, "is not true or false")),
        }
    }

    /// One of several words, the first of which is what stands for none; returns its place.
    ///
    /// # Errors
    /// The value is something else.
    pub fn choice(&mut self, key: &'static str, words: &[&str]) -> Result<usize, Fault> {
        let Some(word) = self.text(key)? else { return Ok(0) };
        words
            .iter()
            .position(|known| *known == word)
            .ok_or_else(|| refused(key, &format!("is '{word}'; there are {}", words.join(", "))))
    }

    /// A number within bounds, or `otherwise`.
    ///
    /// # Errors
    /// The value is something else.
    pub fn number(&mut self, key: &'static str, otherwise: f64, bounds: [f64; 2]) -> Result<f64, Fault> {
        let value = match self.take(key) {
            None => return Ok(otherwise),
            Some(Value::Integer(value)) => value as f64,
            Some(Value::Number(value)) => value,
            Some(_) => return Err(refused(key, "is not a number")),
        };
        let [low, high] = bounds;
        if (low..=high).contains(&value) {
            Ok(value)
        } else {
            Err(refused(key, &format!("is {value}; it must be from {low} to {high}")))
        }
    }

    /// A whole number, which RoboHive's configs also write as a text.
    ///
    /// # Errors
    /// The value is something else.
    pub fn whole(&mut self, key: &'static str, otherwise: i32) -> Result<i32, Fault> {
        let number = match self.take(key) {
            None => return Ok(otherwise),
            Some(Value::Integer(number)) => i32::try_from(number).ok(),
            Some(Value::Text(text)) => text.trim().parse().ok(),
            Some(_) => None,
        };
        number.ok_or_else(|| refused(key, "is not a whole number"))
    }

    /// A list of numbers.
    ///
    /// # Errors
    /// The value is something else.
    pub fn numbers(&mut self, key: &'static str) -> Result<Option<Vec<f64>>, Fault> {
        let Some(value) = self.take(key) else { return Ok(None) };
        let Value::List(items) = value else { return Err(refused(key, "is not a list of numbers")) };
        let number = |item: &Value| match item {
            Value::Integer(value) => Ok(*value as f64),
            Value::Number(value) => Ok(*value),
            _ => Err(refused(key, "is not a list of numbers")),
        };
        items.iter().map(number).collect::<Result<_, _>>().map(Some)
    }

    /// Takes keys that the original's drivers have and these do not need.
    pub fn skip(&mut self, keys: &[&'static str]) {
        for key in keys {
            self.left.remove(*key);
        }
    }

    /// Nothing may be left.
    ///
    /// # Errors
    /// A key that the driver does not know, with those that it does.
    pub fn finish(self) -> Result<(), Fault> {
        match self.left.keys().next() {
            None => Ok(()),
            Some(key) => Err(refused(key, &format!("is not known; there are {}", self.known.join(", ")))),
        }
    }
}
