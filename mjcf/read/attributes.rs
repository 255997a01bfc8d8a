//! Rows of the tables applied to the attributes of one element.

use super::reader::Reader;
use crate::diagnostic::Loc;
use crate::schema::text::{LARGEST, Number, TextError, numbers, words};
use crate::schema::{BOOL, Bind, Row, Words};
use crate::xml::{Attribute, Element};

impl Reader<'_> {
    /// Reads the attributes of `rows` that `element` has into `target`.
    pub(crate) fn rows<T>(&mut self, element: &Element, rows: &[Row<T>], target: &mut T) {
        for row in rows {
            if let Some(attribute) = element.attribute(row.name) {
                self.bind(element, attribute, &row.bind, target);
            }
        }
    }

    /// The same inside a default class: names, and rows that classes may not set, are skipped.
    pub(super) fn default_rows<T>(&mut self, element: &Element, rows: &[Row<T>], target: &mut T) {
        for row in rows.iter().filter(|r| r.in_defaults && !matches!(r.bind, Bind::Name(..))) {
            if let Some(attribute) = element.attribute(row.name) {
                self.bind(element, attribute, &row.bind, target);
            }
        }
    }

    fn bind<T>(&mut self, element: &Element, attribute: &Attribute, bind: &Bind<T>, target: &mut T) {
        match *bind {
            Bind::Real(field) => self.fill(element, attribute, 1, std::slice::from_mut(field(target))),
            Bind::Reals { min, field } => self.fill(element, attribute, min, field(target)),
            Bind::Quat(field) => {
                let quat = field(target);
                self.fill(element, attribute, 4, quat);
                if *quat == [0.0; 4] {
                    self.error(attribute.value_loc, "a quaternion cannot be zero");
                }
            }
            Bind::Turn(way, field) => {
                let values = self.exactly::<f64>(element, attribute, way.length());
                if let Some(orientation) = values.and_then(|t| way.read(&t)) {
                    *field(target) = Some(orientation);
                }
            }
            Bind::Six(field) => {
                let values = self.exactly::<f64>(element, attribute, 6);
                if let Some(six) = values.and_then(|t| t.first_chunk().copied()) {
                    *field(target) = Some(six);
                }
            }
            Bind::RealList(field) => self.list(element, attribute, field(target)),
            Bind::Single(field) => self.fill(element, attribute, 1, std::slice::from_mut(field(target))),
            Bind::Singles(field) => {
                let field = field(target);
                self.fill(element, attribute, field.len(), field);
            }
            Bind::SingleList(field) => self.list(element, attribute, field(target)),
            Bind::Int(field) => self.fill(element, attribute, 1, std::slice::from_mut(field(target))),
            Bind::Ints(field) => {
                let field = field(target);
                self.fill(element, attribute, field.len(), field);
            }
            Bind::IntList(field) => self.list(element, attribute, field(target)),
            Bind::Bool(field) => {
                if let Some(code) = self.keyword(element, attribute, BOOL) {
                    *field(target) = code == 1;
                }
            }
            Bind::Keyword { words, assign } => {
                if let Some(code) = self.keyword(element, attribute, words) {
                    assign(target, code);
                }
            }
            Bind::Flags { words, field } => {
                if let Some(codes) = self.keywords(element, attribute, words) {
                    *field(target) = codes.iter().fold(0, |all, code| all | code);
                }
            }
            Bind::NameList(field) => {
                *field(target) = words(&attribute.value).map(|(_, word)| word.to_owned()).collect();
            }
            Bind::Text(field) | Bind::Name(_, field) | Bind::Ref(_, field) | Bind::ObjRef(_, field) => {
                field(target).clone_from(&attribute.value);
            }
            // The element's own reader takes these.
            Bind::Own(_) => {}
        }
    }

    /// All numbers of an attribute; `None` when it is blank, which counts as absent, or faulty.
    pub(super) fn numbers<T: Number>(&mut self, element: &Element, attribute: &Attribute) -> Option<Vec<T>> {
        let read = numbers(&attribute.value).and_then(|values| match overflowing(attribute, &values) {
            Some(error) => Err(error),
            None => Ok(values),
        });
        match read {
            Ok(values) => (!values.is_empty()).then_some(values),
            Err(TextError { offset, message }) => {
                let loc = Loc { offset: attribute.value_loc.offset + offset as u32, ..attribute.value_loc };
                self.error(loc, format!("attribute '{}' of <{}>: {message}", attribute.name, element.name));
                None
            }
        }
    }

    fn exactly<T: Number>(
        &mut self,
        element: &Element,
        attribute: &Attribute,
        length: usize,
    ) -> Option<Vec<T>> {
        self.between(element, attribute, length, length)
    }

    /// The numbers of an attribute when there are `min` to `max` of them.
    pub(super) fn between<T: Number>(
        &mut self,
        element: &Element,
        attribute: &Attribute,
        min: usize,
        max: usize,
    ) -> Option<Vec<T>> {
        let values = self.numbers::<T>(element, attribute)?;
        if (min..=max).contains(&values.len()) {
            return Some(values);
        }
        let wanted = match (min, max) {
            (1, 1) => "one number".to_string(),
            (min, max) if min == max => format!("{max} numbers"),
            (min, max) => format!("{min} to {max} numbers"),
        };
        let found = values.len();
        let message =
            format!("attribute '{}' of <{}> takes {wanted}, not {found}", attribute.name, element.name);
        self.error(attribute.value_loc, message);
        None
    }

    fn fill<T: Number + Copy>(
        &mut self,
        element: &Element,
        attribute: &Attribute,
        min: usize,
        field: &mut [T],
    ) {
        if let Some(values) = self.between::<T>(element, attribute, min, field.len()) {
            field[..values.len()].copy_from_slice(&values);
        }
    }

    fn list<T: Number>(&mut self, element: &Element, attribute: &Attribute, field: &mut Vec<T>) {
        if let Some(values) = self.numbers::<T>(element, attribute) {
            *field = values;
        }
    }

    /// The code of a keyword attribute.
    pub(super) fn keyword(&mut self, element: &Element, attribute: &Attribute, words: Words) -> Option<i32> {
        self.word(element, attribute, attribute.value_loc, &attribute.value, words)
    }

    /// The codes of an attribute with several keywords, none of them twice.
    pub(super) fn keywords(
        &mut self,
        element: &Element,
        attribute: &Attribute,
        list: Words,
    ) -> Option<Vec<i32>> {
        let mut codes = Vec::new();
        for (offset, word) in words(&attribute.value) {
            let loc = Loc { offset: attribute.value_loc.offset + offset as u32, ..attribute.value_loc };
            let code = self.word(element, attribute, loc, word, list)?;
            if codes.contains(&code) {
                self.error(loc, format!("keyword '{word}' stands twice in '{}'", attribute.name));
                return None;
            }
            codes.push(code);
        }
        (!codes.is_empty()).then_some(codes)
    }

    fn word(
        &mut self,
        element: &Element,
        attribute: &Attribute,
        loc: Loc,
        word: &str,
        list: Words,
    ) -> Option<i32> {
        if let Some((_, code)) = list.iter().find(|(w, _)| *w == word) {
            return Some(*code);
        }
        let advice = match self.expansion.diagnostics.nearest(word, list.iter().map(|(w, _)| *w)) {
            Some(near) => format!("did you mean '{near}'?"),
            None => format!("one of {}", list.iter().map(|(w, _)| *w).collect::<Vec<_>>().join(", ")),
        };
        let shown: String = word.chars().take(60).collect();
        let message = format!("attribute '{}' of <{}> cannot be '{shown}'", attribute.name, element.name);
        self.error_with(loc, message, Some(advice));
        None
    }
}

/// The first number that physics cannot compute with. Ranges and cut-offs say with an infinite number that there
/// is no bound; user data are not computed with.
fn overflowing<T: Number>(attribute: &Attribute, values: &[T]) -> Option<TextError> {
    let name = &*attribute.name;
    if name.ends_with("range") || matches!(name, "cutoff" | "user" | "data") {
        return None;
    }
    let (_, (offset, word)) = values.iter().zip(words(&attribute.value)).find(|(x, _)| x.overflows())?;
    let message = format!("number '{word}' is too large: at most {LARGEST:e} in magnitude");
    Some(TextError { offset, message })
}
