//! Elements to attributes by the rows of the schema: what an element says beyond a base.

use super::text::{integers, number, numbers};
use crate::schema::{Bind, Row};
use crate::xml::Element;

/// Appends the attributes in which `value` differs from `base`, and those that must be present.
pub(super) fn put_rows<T: Clone + PartialEq>(out: &mut Element, rows: &[Row<T>], value: &T, base: &T) {
    put_some(out, rows, value, base, &|_| true);
}

/// The same for the attributes that `wanted` chooses.
pub(super) fn put_some<T: Clone + PartialEq>(
    out: &mut Element,
    rows: &[Row<T>],
    value: &T,
    base: &T,
    wanted: &dyn Fn(&str) -> bool,
) {
    let (mut own, mut common) = (Scratch::new(value), Scratch::new(base));
    for row in rows.iter().filter(|row| wanted(row.name)) {
        if let Some(text) = own.text(&row.bind)
            && (row.required || common.text(&row.bind).as_deref() != Some(&*text))
        {
            out.put(row.name, text);
        }
    }
    // The reader takes an orientation in one form, and the alternative counts.
    if ["axisangle", "xyaxes", "zaxis", "euler"].iter().any(|name| out.has(name)) {
        out.attributes.retain(|a| a.name != "quat");
    }
}

/// Rows lend fields for writing, and make optional ones when asked; a copy takes that.
struct Scratch<'a, T> {
    value: &'a T,
    copy: T,
}

impl<'a, T: Clone + PartialEq> Scratch<'a, T> {
    fn new(value: &'a T) -> Self {
        Scratch { value, copy: value.clone() }
    }

    /// What `read` finds; `None` when the field had to be made first.
    fn lend<R>(&mut self, read: impl FnOnce(&mut T) -> R) -> Option<R> {
        let found = read(&mut self.copy);
        if self.copy == *self.value {
            return Some(found);
        }
        self.copy = self.value.clone();
        None
    }

    /// The text of an attribute; `None` where the element says nothing.
    fn text(&mut self, bind: &Bind<T>) -> Option<String> {
        match *bind {
            Bind::Real(field) => self.lend(|t| number(*field(t))),
            Bind::Reals { field, .. } => self.lend(|t| numbers(field(t))),
            Bind::Quat(field) => self.lend(|t| numbers(field(t))),
            Bind::Turn(way, field) => {
                self.lend(|t| field(t).as_ref().and_then(|turn| way.numbers(turn).map(numbers)))?
            }
            Bind::Six(field) => self.lend(|t| field(t).map(|six| numbers(&six)))?,
            Bind::RealList(field) => self.lend(|t| numbers(field(t))).filter(|text| !text.is_empty()),
            Bind::Single(field) => self.lend(|t| number(*field(t))),
            Bind::Singles(field) => self.lend(|t| numbers(field(t))),
            Bind::SingleList(field) => self.lend(|t| numbers(field(t))).filter(|text| !text.is_empty()),
            Bind::Int(field) => self.lend(|t| field(t).to_string()),
            Bind::Ints(field) => self.lend(|t| integers(field(t))),
            Bind::IntList(field) => self.lend(|t| integers(field(t))).filter(|text| !text.is_empty()),
            Bind::Bool(field) => self.lend(|t| field(t).to_string()),
            Bind::Keyword { words, assign } => {
                let stays = |(_, code): &&(&str, i32)| self.lend(|t| assign(t, *code)).is_some();
                words.iter().find(stays).map(|(word, _)| (*word).to_owned())
            }
            Bind::Flags { words, field } => {
                let bits = self.lend(|t| *field(t))?;
                let set = words.iter().filter(|(_, bit)| bits & bit != 0);
                Some(set.map(|(word, _)| *word).collect::<Vec<_>>().join(" ")).filter(|text| !text.is_empty())
            }
            Bind::NameList(field) => self.lend(|t| field(t).join(" ")).filter(|text| !text.is_empty()),
            Bind::Text(field) | Bind::Name(_, field) | Bind::Ref(_, field) | Bind::ObjRef(_, field) => {
                self.lend(|t| field(t).clone())
            }
            Bind::Own(_) => None,
        }
    }
}
