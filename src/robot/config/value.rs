//! A parameter that a config hands to a driver.

use std::collections::BTreeMap;

/// A parameter of an interface.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Python's `None`; TOML has no word for it.
    None,
    /// A truth value.
    Bool(bool),
    /// A whole number.
    Integer(i64),
    /// Any other number.
    Number(f64),
    /// Text.
    Text(String),
    /// A list or a tuple.
    List(Vec<Value>),
    /// A dictionary.
    Table(BTreeMap<String, Value>),
}
