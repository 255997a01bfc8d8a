//! A value of a config with its place in the text: what both parsers make and the schema reads.

use super::value::Value;
use std::collections::BTreeMap;

/// A value at a byte of the text.
#[derive(Debug)]
pub(super) struct Node {
    pub(super) at: usize,
    pub(super) content: Content,
}

/// What stands there.
#[derive(Debug)]
pub(super) enum Content {
    None,
    Bool(bool),
    Integer(i64),
    Number(f64),
    Text(String),
    List(Vec<Node>),
    /// Keys with their places, each once, in the order of the text.
    Table(Vec<(Key, Node)>),
}

/// A key of a table.
#[derive(Debug)]
pub(super) struct Key {
    pub(super) at: usize,
    pub(super) name: String,
}

impl Node {
    /// What the value is, for messages.
    pub(super) fn kind(&self) -> &'static str {
        match self.content {
            Content::None => "None",
            Content::Bool(_) => "a truth value",
            Content::Integer(_) | Content::Number(_) => "a number",
            Content::Text(_) => "a text",
            Content::List(_) => "a list",
            Content::Table(_) => "a table",
        }
    }

    /// The value without places.
    pub(super) fn into_value(self) -> Value {
        match self.content {
            Content::None => Value::None,
            Content::Bool(value) => Value::Bool(value),
            Content::Integer(value) => Value::Integer(value),
            Content::Number(value) => Value::Number(value),
            Content::Text(value) => Value::Text(value),
            Content::List(items) => Value::List(items.into_iter().map(Node::into_value).collect()),
            Content::Table(entries) => Value::Table(
                entries
                    .into_iter()
                    .map(|(key, value)| (key.name, value.into_value()))
                    .collect::<BTreeMap<_, _>>(),
            ),
        }
    }
}
