//! Named rows of numbers: the observation dictionary, and the terms of a reward.

use robot::Keeper;
use std::borrow::Cow;
use std::ops::{Index, Range};

/// One row: what it is called, what it is measured in, and where its values stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    name: Cow<'static, str>,
    unit: &'static str,
    place: Range<usize>,
}

impl Row {
    /// Its key.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What its values are measured in; several units belong to its parts in order.
    pub fn unit(&self) -> &'static str {
        self.unit
    }

    /// How many values it has.
    pub fn len(&self) -> usize {
        self.place.len()
    }

    /// Whether it has no values.
    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }
}

/// A name that is made at run time; rows copy it only in the first round.
#[derive(Clone, Copy, Debug)]
pub struct Name<'a>(pub &'a str);

impl AsRef<str> for Name<'_> {
    fn as_ref(&self) -> &str {
        self.0
    }
}

impl From<Name<'_>> for Cow<'static, str> {
    fn from(name: Name<'_>) -> Self {
        Cow::Owned(name.0.to_string())
    }
}

/// Rows in the order in which they are written, their values one after the other.
///
/// The first round of writing decides names and lengths; later rounds write the same rows in the same order and allocate
/// nothing.
///
/// ```
/// use robohive_env::Rows;
/// let mut rows = Rows::default();
/// for time in [0.0, 0.1] {
///     rows.begin();
///     rows.set("time", "s", [time]);
///     rows.set("tip", "m", [1.0, 2.0, 3.0 * time]);
/// }
/// assert_eq!(rows["tip"][..2], [1.0, 2.0]);
/// assert_eq!(rows.values().len(), 4);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rows {
    rows: Vec<Row>,
    values: Vec<f64>,
    /// Row written next.
    cursor: usize,
    /// What names that are written now begin with.
    prefix: String,
}

/// The rows whose names begin with a prefix, by the rest of their names: what belongs to one agent of several.
#[derive(Clone, Copy, Debug)]
pub struct OwnRows<'a> {
    rows: &'a Rows,
    prefix: &'a str,
}

impl Rows {
    /// Starts a round: the next row written is the first.
    pub fn begin(&mut self) {
        self.cursor = 0;
    }

    /// Writes the next row.
    ///
    /// # Panics
    /// A round writes other rows than the first one: a fault of the task, not of its user.
    pub fn set<N, V>(&mut self, name: N, unit: &'static str, values: V)
    where
        N: AsRef<str> + Into<Cow<'static, str>>,
        V: IntoIterator<Item: std::borrow::Borrow<f64>>,
    {
        use std::borrow::Borrow;
        let values = values.into_iter().map(|value| *value.borrow());
        match self.rows.get(self.cursor) {
            Some(row) => {
                let known = row.name.strip_prefix(&*self.prefix);
                assert_eq!(known, Some(name.as_ref()), "rows are written in the same order every time");
                let mut rest = values;
                for (place, value) in self.values[row.place.clone()].iter_mut().zip(&mut rest) {
                    *place = value;
                }
                debug_assert!(rest.next().is_none(), "{} has a fixed length", row.name);
            }
            None => {
                let start = self.values.len();
                self.values.extend(values);
                let name = if self.prefix.is_empty() {
                    name.into()
                } else {
                    Cow::Owned(format!("{}{}", self.prefix, name.as_ref()))
                };
                self.rows.push(Row { name, unit, place: start..self.values.len() });
            }
        }
        self.cursor += 1;
    }

    /// Writes rows whose names begin with `prefix`; `write` names them without it.
    ///
    /// ```
    /// use robohive_env::Rows;
    /// let mut rows = Rows::default();
    /// rows.within("left_", |rows| rows.set("height", "m", [0.3]));
    /// assert_eq!(rows["left_height"], [0.3]);
    /// assert_eq!(rows.of("left_")["height"], [0.3]);
    /// ```
    pub fn within<T>(&mut self, prefix: &str, write: impl FnOnce(&mut Self) -> T) -> T {
        let before = self.prefix.len();
        self.prefix.push_str(prefix);
        let written = write(self);
        self.prefix.truncate(before);
        written
    }

    /// The rows whose names begin with `prefix`; an empty one is that of all.
    pub fn of<'a>(&'a self, prefix: &'a str) -> OwnRows<'a> {
        OwnRows { rows: self, prefix }
    }

    /// The rows' names, units and lengths, in order.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// All values, row after row.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values of a row.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.place(name).map(|place| &self.values[place])
    }

    /// Where the values of a row stand among all of them.
    pub fn place(&self, name: &str) -> Option<Range<usize>> {
        self.rows.iter().find(|row| row.name == name).map(|row| row.place.clone())
    }

    /// Replaces all values at once, for rows read from a recording.
    ///
    /// # Panics
    /// The number of values differs.
    pub fn assign(&mut self, values: &[f64]) {
        self.values.copy_from_slice(values);
    }

    /// Writes or reads the values of rows that both sides have.
    pub(crate) fn keep(&mut self, keeper: &mut Keeper) {
        keeper.numbers(&mut self.values);
    }

    /// Every row with its values.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (&Row, &[f64])> {
        self.rows.iter().map(|row| (row, &self.values[row.place.clone()]))
    }
}

impl Index<&str> for Rows {
    type Output = [f64];

    /// The values of a row that is known to exist; [`Rows::get`] asks for others.
    fn index(&self, name: &str) -> &[f64] {
        self.get(name).unwrap_or_else(|| panic!("there is no row named {name}"))
    }
}

impl<'a> OwnRows<'a> {
    /// The values of a row that is known to exist, for as long as the rows are there.
    ///
    /// # Panics
    /// There is no such row; [`OwnRows::get`] asks for others.
    #[track_caller]
    pub fn row(self, name: &str) -> &'a [f64] {
        self.get(name).unwrap_or_else(|| panic!("there is no row named {}{name}", self.prefix))
    }

    /// The values of a row.
    pub fn get(self, name: &str) -> Option<&'a [f64]> {
        let named = |row: &&Row| row.name.strip_prefix(self.prefix) == Some(name);
        self.rows.rows.iter().find(named).map(|row| &self.rows.values[row.place.clone()])
    }
}

impl Index<&str> for OwnRows<'_> {
    type Output = [f64];

    /// The values of a row that is known to exist; [`OwnRows::get`] asks for others.
    fn index(&self, name: &str) -> &[f64] {
        self.row(name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_keep_their_places() {
        let mut rows = Rows::default();
        for round in [1.0, 2.0] {
            rows.begin();
            rows.set("a", "m", [round, 2.0 * round]);
            rows.set(String::from("b"), "", [3.0 * round]);
        }
        assert_eq!(rows["a"], [2.0, 4.0]);
        assert_eq!(rows.place("b"), Some(2..3));
        assert_eq!(rows.get("c"), None);
        let units: Vec<_> = rows.iter().map(|(row, values)| (row.name(), row.unit(), values.len())).collect();
        assert_eq!(units, [("a", "m", 2), ("b", "", 1)]);
    }

    #[test]
    #[should_panic(expected = "same order")]
    fn other_rows_are_refused() {
        let mut rows = Rows::default();
        rows.set("a", "", [1.0]);
        rows.begin();
        rows.set("b", "", [1.0]);
    }
}
