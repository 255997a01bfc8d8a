//! The entries of a table, read by their keys, with messages that say where the text is wrong.

use super::devices::HardwareId;
use super::error::{ConfigError, Source};
use super::node::{Content, Key, Node};
use physics::math::Legible;
use physics::model::Suggestions;
use std::collections::BTreeMap;

pub(super) type Outcome<T> = Result<T, ConfigError>;

/// The entries of a table that are not read yet.
pub(super) struct Fields<'a> {
    pub(super) source: &'a Source<'a>,
    /// Whose they are, for messages.
    pub(super) owner: String,
    pub(super) at: usize,
    entries: Vec<(Key, Node)>,
}

impl<'a> Fields<'a> {
    /// The entries of `node`, which must be a table with no keys but `known`.
    pub(super) fn new(
        source: &'a Source<'a>,
        owner: &str,
        node: Node,
        known: &[&'static str],
    ) -> Outcome<Self> {
        let fields = Fields::any(source, owner, node)?;
        for (key, _) in &fields.entries {
            if !known.contains(&key.name.as_str()) {
                let near = Suggestions::default().nearest(&key.name, known.iter().copied());
                let hint = near.map_or_else(
                    || format!("it may have {}", known.join(", ")),
                    |near| format!("did you mean '{near}'?"),
                );
                return Err(
                    source.error(key.at, format!("{owner} has an unknown key '{}'; {hint}", key.name))
                );
            }
        }
        Ok(fields)
    }

    /// The entries of `node`, which must be a table, with whatever keys.
    pub(super) fn any(source: &'a Source<'a>, owner: &str, node: Node) -> Outcome<Self> {
        let (at, kind) = (node.at, node.kind());
        let Content::Table(entries) = node.content else {
            return Err(source.error(at, format!("{owner} is {kind}, not a table")));
        };
        Ok(Fields { source, owner: owner.to_owned(), at, entries })
    }

    /// Every entry as a number.
    pub(super) fn numbers(&self) -> Outcome<BTreeMap<String, f64>> {
        let number = |(key, node): &(Key, Node)| Ok((key.name.clone(), self.finite(&key.name, node)?));
        self.entries.iter().map(number).collect()
    }

    /// Where the key is in the text.
    pub(super) fn place(&self, key: &str) -> Option<usize> {
        self.entries.iter().find(|(found, _)| found.name == key).map(|(found, _)| found.at)
    }

    pub(super) fn take(&mut self, key: &str) -> Option<Node> {
        let place = self.entries.iter().position(|(found, _)| found.name == key)?;
        Some(self.entries.swap_remove(place).1)
    }

    pub(super) fn missing(&self, key: &str) -> ConfigError {
        self.source.error(self.at, format!("{} has no '{key}'", self.owner))
    }

    pub(super) fn wrong(&self, at: usize, key: &str, message: &str) -> ConfigError {
        self.source.error(at, format!("'{key}' of {} {message}", self.owner))
    }

    pub(super) fn list(&mut self, key: &str) -> Outcome<Vec<Node>> {
        let Some(node) = self.take(key) else { return Ok(Vec::new()) };
        let kind = node.kind();
        match node.content {
            Content::List(items) => Ok(items),
            _ => Err(self.wrong(node.at, key, &format!("is {kind}, not a list"))),
        }
    }

    pub(super) fn text(&mut self, key: &str) -> Outcome<Option<String>> {
        let Some(node) = self.take(key) else { return Ok(None) };
        let kind = node.kind();
        match node.content {
            Content::Text(text) => Ok(Some(text)),
            _ => Err(self.wrong(node.at, key, &format!("is {kind}, not a text"))),
        }
    }

    /// The name, which from here on says in messages whose fields these are.
    pub(super) fn name(&mut self) -> Outcome<String> {
        let name = self.text("name")?.ok_or_else(|| self.missing("name"))?;
        self.owner = format!("{} ('{name}')", self.owner);
        Ok(name)
    }

    pub(super) fn finite(&self, key: &str, node: &Node) -> Outcome<f64> {
        let value = match node.content {
            Content::Integer(value) => value as f64,
            Content::Number(value) => value,
            _ => return Err(self.wrong(node.at, key, &format!("is {}, not a number", node.kind()))),
        };
        if !value.is_finite() {
            return Err(self.wrong(node.at, key, &format!("is {value}; it must be finite")));
        }
        Ok(value)
    }

    pub(super) fn number(&mut self, key: &str) -> Outcome<Option<f64>> {
        self.take(key).map(|node| self.finite(key, &node)).transpose()
    }

    pub(super) fn noise(&mut self) -> Outcome<f64> {
        let Some(node) = self.take("noise") else { return Ok(0.0) };
        let noise = self.finite("noise", &node)?;
        if noise < 0.0 {
            return Err(self.wrong(node.at, "noise", "is negative"));
        }
        Ok(noise)
    }

    pub(super) fn scale(&mut self) -> Outcome<f64> {
        let Some(node) = self.take("scale") else { return Ok(1.0) };
        let scale = self.finite("scale", &node)?;
        if scale == 0.0 {
            return Err(self.wrong(node.at, "scale", "is 0, which nothing can be scaled back from"));
        }
        Ok(scale)
    }

    pub(super) fn hardware(&mut self, place: usize) -> Outcome<HardwareId> {
        let Some(node) = self.take("hdr_id") else { return Ok(HardwareId::Number(place as i64)) };
        let kind = node.kind();
        match node.content {
            Content::Integer(number) => Ok(HardwareId::Number(number)),
            Content::Text(name) => Ok(HardwareId::Name(name)),
            _ => Err(self.wrong(node.at, "hdr_id", &format!("is {kind}, not a whole number or a name"))),
        }
    }

    pub(super) fn range(&mut self, key: &str) -> Outcome<Option<[f64; 2]>> {
        let Some(node) = self.take(key) else { return Ok(None) };
        let (at, kind) = (node.at, node.kind());
        let Content::List(items) = node.content else {
            return Err(self.wrong(at, key, &format!("is {kind}, not a pair of numbers")));
        };
        let [low, high] = items.as_slice() else {
            return Err(self.wrong(at, key, &format!("has {} numbers, not 2", items.len())));
        };
        let (low, high) = (self.finite(key, low)?, self.finite(key, high)?);
        if low > high {
            return Err(self.wrong(
                at,
                key,
                &format!("begins at {}, above its end {}", Legible(low), Legible(high)),
            ));
        }
        Ok(Some([low, high]))
    }

    pub(super) fn required_range(&mut self, key: &str) -> Outcome<[f64; 2]> {
        self.range(key)?.ok_or_else(|| self.missing(key))
    }
}
