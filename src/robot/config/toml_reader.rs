//! TOML text as nodes.

use super::error::{ConfigError, Source};
use super::node::{Content, Key, Node};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The document as a table.
pub(super) fn parse(source: &Source) -> Result<Node, ConfigError> {
    let document = DeTable::parse(source.text).map_err(|error| {
        let at = error.span().map_or(0, |span| span.start);
        source.error(at, error.message())
    })?;
    let at = document.span().start;
    table(source, at, document.into_inner())
}

fn table(source: &Source, at: usize, entries: DeTable) -> Result<Node, ConfigError> {
    let mut read = Vec::with_capacity(entries.len());
    for (key, value) in entries {
        let key = Key { at: key.span().start, name: key.into_inner().into_owned() };
        read.push((key, node(source, value)?));
    }
    // The parser sorts keys by name.
    read.sort_by_key(|(key, _)| key.at);
    Ok(Node { at, content: Content::Table(read) })
}

fn node(source: &Source, value: Spanned<DeValue>) -> Result<Node, ConfigError> {
    let at = value.span().start;
    let content = match value.into_inner() {
        DeValue::String(text) => Content::Text(text.into_owned()),
        DeValue::Integer(number) => Content::Integer(
            i64::from_str_radix(number.as_str(), number.radix())
                .map_err(|_| source.error(at, "an integer beyond 64 bits"))?,
        ),
        DeValue::Float(number) => Content::Number(
            number.as_str().parse().map_err(|_| source.error(at, "a number that cannot be read"))?,
        ),
        DeValue::Boolean(value) => Content::Bool(value),
        DeValue::Datetime(_) => return Err(source.error(at, "a date, of which a robot has no use")),
        DeValue::Array(items) => {
            Content::List(items.into_iter().map(|item| node(source, item)).collect::<Result<_, _>>()?)
        }
        DeValue::Table(entries) => return table(source, at, entries),
    };
    Ok(Node { at, content })
}
