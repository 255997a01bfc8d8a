//! A value of a pickle, and what it holds.

use super::graph::{Id, Node, Pickle};

/// A value of a pickle. Questions that do not fit its kind answer `None`.
#[derive(Clone, Copy)]
pub struct Value<'p> {
    pickle: &'p Pickle<'p>,
    id: Id,
}

impl Pickle<'_> {
    /// The value that the pickle stands for.
    pub fn root(&self) -> Value<'_> {
        self.value(self.root)
    }

    /// Everything that refers to a value outside the pickle.
    pub fn persistent(&self) -> impl Iterator<Item = Value<'_>> {
        let references =
            self.nodes.iter().enumerate().filter(|(_, node)| matches!(node, Node::Persistent(_)));
        references.map(|(id, _)| self.value(id as Id))
    }

    fn value(&self, id: Id) -> Value<'_> {
        Value { pickle: self, id }
    }
}

impl<'p> Value<'p> {
    fn node(self) -> &'p Node {
        &self.pickle.nodes[self.id as usize]
    }

    /// What it is, for messages.
    pub fn kind(self) -> String {
        match self.node() {
            Node::None => "None".into(),
            Node::Bool(_) => "a bool".into(),
            Node::Int(_) | Node::Long(_) => "an integer".into(),
            Node::Float(_) => "a float".into(),
            Node::Text(_) => "a text".into(),
            Node::Bytes(_) => "bytes".into(),
            Node::List(items) => format!("a list of {}", items.len()),
            Node::Tuple(items) => format!("a tuple of {}", items.len()),
            Node::Set(items) => format!("a set of {}", items.len()),
            Node::Dict(entries) => format!("a dictionary of {}", entries.len()),
            Node::Global([module, name]) => {
                format!("the name {}.{}", self.pickle.text(module), self.pickle.text(name))
            }
            Node::Object(_) => match self.callable() {
                Some((module, name)) => format!("an object of {module}.{name}"),
                None => "an object".into(),
            },
            Node::Persistent(_) => "a reference to a value outside the pickle".into(),
        }
    }

    /// Whether it is `None`.
    pub fn is_none(self) -> bool {
        matches!(self.node(), Node::None)
    }

    /// A truth value.
    pub fn bool(self) -> Option<bool> {
        match self.node() {
            Node::Bool(value) => Some(*value),
            _ => None,
        }
    }

    /// An integer that i64 holds.
    pub fn int(self) -> Option<i64> {
        match self.node() {
            Node::Int(value) => Some(*value),
            _ => None,
        }
    }

    /// An integer that counts something.
    pub fn count(self) -> Option<usize> {
        self.int().and_then(|value| usize::try_from(value).ok())
    }

    /// Little-endian two's complement of an integer that i64 does not hold.
    pub fn long(self) -> Option<&'p [u8]> {
        match self.node() {
            Node::Long(span) => Some(&self.pickle.input[span.clone()]),
            _ => None,
        }
    }

    /// A number.
    pub fn float(self) -> Option<f64> {
        match self.node() {
            Node::Float(value) => Some(*value),
            Node::Int(value) => Some(*value as f64),
            _ => None,
        }
    }

    /// A text.
    pub fn text(self) -> Option<&'p str> {
        match self.node() {
            Node::Text(span) => Some(self.pickle.text(span)),
            _ => None,
        }
    }

    /// Bytes.
    pub fn bytes(self) -> Option<&'p [u8]> {
        match self.node() {
            Node::Bytes(span) => Some(&self.pickle.input[span.clone()]),
            _ => None,
        }
    }

    /// How many items a list, tuple or set has, or were appended to an object.
    pub fn len(self) -> Option<usize> {
        self.ids().map(<[Id]>::len)
    }

    /// Whether it is a list, tuple or set without items.
    pub fn is_empty(self) -> bool {
        self.len() == Some(0)
    }

    /// Items of a list, tuple or set, or those that were appended to an object; none for all else.
    pub fn items(self) -> impl Iterator<Item = Value<'p>> {
        self.ids().unwrap_or_default().iter().map(move |&id| self.pickle.value(id))
    }

    /// The item at a place.
    pub fn item(self, index: usize) -> Option<Value<'p>> {
        self.ids()?.get(index).map(|&id| self.pickle.value(id))
    }

    fn ids(self) -> Option<&'p [Id]> {
        match self.node() {
            Node::List(items) | Node::Tuple(items) | Node::Set(items) => Some(items),
            Node::Object(object) => Some(&object.items),
            _ => None,
        }
    }

    /// Keys and values of a dictionary, or those that were set in an object; none for all else.
    pub fn entries(self) -> impl DoubleEndedIterator<Item = (Value<'p>, Value<'p>)> {
        let entries: &[[Id; 2]] = match self.node() {
            Node::Dict(entries) => entries,
            Node::Object(object) => &object.entries,
            _ => &[],
        };
        entries.iter().map(move |&[key, value]| (self.pickle.value(key), self.pickle.value(value)))
    }

    /// The value that was set last under a key.
    pub fn get(self, key: &str) -> Option<Value<'p>> {
        self.entries().rev().find(|(found, _)| found.text() == Some(key)).map(|(_, value)| value)
    }

    /// Module and name: of a class or function, or of what an object would be made by.
    pub fn callable(self) -> Option<(&'p str, &'p str)> {
        match self.node() {
            Node::Global([module, name]) => Some((self.pickle.text(module), self.pickle.text(name))),
            Node::Object(object) => match &self.pickle.nodes[object.callable as usize] {
                Node::Global([module, name]) => Some((self.pickle.text(module), self.pickle.text(name))),
                _ => None,
            },
            _ => None,
        }
    }

    /// Arguments by which an object would be made, if `module.name` is what would make it.
    pub fn call(self, module: &str, name: &str) -> Option<Value<'p>> {
        match self.node() {
            Node::Object(object) if self.callable() == Some((module, name)) => {
                Some(self.pickle.value(object.arguments))
            }
            _ => None,
        }
    }

    /// What an object would be restored from.
    pub fn state(self) -> Option<Value<'p>> {
        match self.node() {
            Node::Object(object) => object.state.map(|id| self.pickle.value(id)),
            _ => None,
        }
    }

    /// A member of an object: the entry of that name in its state.
    pub fn member(self, name: &str) -> Option<Value<'p>> {
        self.state()?.get(name)
    }

    /// What identifies a value outside the pickle.
    pub fn persistent_id(self) -> Option<Value<'p>> {
        match self.node() {
            Node::Persistent(id) => Some(self.pickle.value(*id)),
            _ => None,
        }
    }
}
