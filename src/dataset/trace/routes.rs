//! Rows on their way from the names they are given to the names they are kept under.

use super::column::Column;
use super::layout::{Route, to_robohive, to_roboset};
use crate::npy::Dtype;
use std::collections::BTreeSet;

/// Whether names change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Translation {
    /// They stay.
    None,
    /// From RoboHive's layout to RoboSet's.
    ToRoboSet,
    /// From RoboSet's layout to RoboHive's.
    ToRoboHive,
}

impl Translation {
    /// Where rows of `key` go.
    pub fn routes(self, key: &str, row: &[usize]) -> Vec<Route> {
        match self {
            Translation::None => vec![Route::Whole(key.to_owned())],
            Translation::ToRoboSet => to_roboset(key),
            Translation::ToRoboHive => to_robohive(key, row),
        }
    }
}

/// The rows of one name, all of the same type and shape.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    /// Type in which scalars are kept.
    pub dtype: Dtype,
    /// Shape of one.
    pub row: &'a [usize],
    /// How many.
    pub count: usize,
    /// Their bytes.
    pub bytes: &'a [u8],
}

/// A name that rows are given under.
struct Given {
    key: String,
    dtype: Dtype,
    row: Vec<usize>,
    ways: Vec<Way>,
}

/// A route whose columns are known.
enum Way {
    Whole(usize),
    /// Bytes of the first part, and the columns.
    Split(usize, [usize; 2]),
    /// Which join, and which part.
    Join(usize, usize),
}

/// A column made of the rows of two names; one may be ahead of the other.
struct Join {
    to: String,
    /// Type and numbers of each part.
    parts: [Option<(Dtype, usize)>; 2],
    held: [Vec<u8>; 2],
    column: Option<usize>,
}

/// The columns of a trial, and what leads to them.
pub struct Router {
    translation: Translation,
    given: Vec<Given>,
    /// The name that is expected next: rows come in the same order again and again.
    next: usize,
    joins: Vec<Join>,
    /// The columns, in order of appearance.
    pub columns: Vec<Column>,
    /// Names without a place.
    pub unmapped: BTreeSet<String>,
}

impl Router {
    /// One without columns.
    pub fn new(translation: Translation) -> Self {
        Router {
            translation,
            given: Vec::new(),
            next: 0,
            joins: Vec::new(),
            columns: Vec::new(),
            unmapped: BTreeSet::new(),
        }
    }

    /// Whether names change.
    pub fn translation(&self) -> Translation {
        self.translation
    }

    /// Adds rows that are given under a name.
    ///
    /// # Errors
    /// Their type or shape differs from earlier rows, or the name cannot be kept.
    pub(crate) fn push(&mut self, key: &str, rows: Rows) -> Result<(), String> {
        let at = self.find(key, rows)?;
        self.next = at + 1;
        let Given { dtype, row, ways, .. } = &self.given[at];
        if (*dtype, &row[..]) != (rows.dtype, rows.row) {
            return Err(format!(
                "a row of {} {:?} follows rows of {} {row:?}",
                rows.dtype.name(),
                rows.row,
                dtype.name()
            ));
        }
        for way in ways {
            match *way {
                Way::Whole(column) => self.columns[column].hold(rows.count, rows.bytes),
                Way::Split(first, [low, high]) => {
                    let bytes = self.columns[low].row_bytes() + self.columns[high].row_bytes();
                    for row in rows.bytes.chunks_exact(bytes.max(1)) {
                        self.columns[low].hold(1, &row[..first]);
                        self.columns[high].hold(1, &row[first..]);
                    }
                }
                Way::Join(join, part) => self.joins[join].held[part].extend(rows.bytes),
            }
        }
        let joined: Vec<usize> = ways
            .iter()
            .filter_map(|way| if let Way::Join(join, _) = *way { Some(join) } else { None })
            .collect();
        joined.into_iter().try_for_each(|join| self.join(join))
    }

    /// The number of a name, which becomes known if it is new.
    fn find(&mut self, key: &str, rows: Rows) -> Result<usize, String> {
        if self.given.get(self.next).is_some_and(|given| given.key == key) {
            return Ok(self.next);
        }
        if let Some(at) = self.given.iter().position(|given| given.key == key) {
            return Ok(at);
        }
        let routes = self.translation.routes(key, rows.row);
        if routes.is_empty() {
            self.unmapped.insert(key.to_owned());
        }
        let ways = routes.into_iter().map(|route| self.way(route, rows)).collect::<Result<_, _>>()?;
        self.given.push(Given { key: key.to_owned(), dtype: rows.dtype, row: rows.row.to_vec(), ways });
        Ok(self.given.len() - 1)
    }

    fn way(&mut self, route: Route, rows: Rows) -> Result<Way, String> {
        let flat = |at: usize| match *rows.row {
            [width] if width >= at => Ok(width),
            _ => Err(format!("rows of shape {:?} have no parts of {at} and more numbers", rows.row)),
        };
        Ok(match route {
            Route::Whole(to) => Way::Whole(self.column(to, rows.dtype, rows.row)?),
            Route::Split { at, to: [low, high] } => {
                let width = flat(at)?;
                let columns =
                    [self.column(low, rows.dtype, &[at])?, self.column(high, rows.dtype, &[width - at])?];
                Way::Split(at * rows.dtype.bytes(), columns)
            }
            Route::Join { to, part } => {
                let width = flat(0)?;
                let join = self.joins.iter().position(|join| join.to == to).unwrap_or_else(|| {
                    let held = [Vec::new(), Vec::new()];
                    self.joins.push(Join { to, parts: [None, None], held, column: None });
                    self.joins.len() - 1
                });
                self.joins[join].parts[part] = Some((rows.dtype, width));
                Way::Join(join, part)
            }
        })
    }

    /// A new column.
    fn column(&mut self, key: String, dtype: Dtype, row: &[usize]) -> Result<usize, String> {
        check_key(&key, self.columns.iter().map(|column| &column.key[..]))?;
        self.columns.push(Column::new(key, dtype, row.to_vec()));
        Ok(self.columns.len() - 1)
    }

    /// Puts together the rows that have both parts.
    fn join(&mut self, number: usize) -> Result<(), String> {
        let join = &self.joins[number];
        let [Some((first, low)), Some((second, high))] = join.parts else { return Ok(()) };
        if first != second {
            return Err(format!("its other part is {}, this one {}", first.name(), second.name()));
        }
        let column = match join.column {
            Some(column) => column,
            None => self.column(join.to.clone(), first, &[low + high])?,
        };
        let join = &mut self.joins[number];
        join.column = Some(column);
        let widths = [low, high].map(|width| width * first.bytes());
        let rows = |part: usize| join.held[part].len().checked_div(widths[part]);
        let whole = rows(0).into_iter().chain(rows(1)).min().unwrap_or(0);
        for row in 0..whole {
            let part = |part: usize| &join.held[part][row * widths[part]..(row + 1) * widths[part]];
            self.columns[column].hold(1, &[part(0), part(1)].concat());
        }
        for part in 0..2 {
            join.held[part].drain(..whole * widths[part]);
        }
        Ok(())
    }

    /// Says what keeps the trial from being complete.
    ///
    /// # Errors
    /// A name has other rows than the others, or one of two that belong together is missing.
    pub fn check(&self) -> Result<(), (String, String)> {
        if let Some(join) = self.joins.iter().find(|join| join.held.iter().any(|held| !held.is_empty())) {
            return Err((join.to.clone(), "one of the two names that it is made of has fewer rows".into()));
        }
        let Some(first) = self.columns.first() else { return Ok(()) };
        match self.columns.iter().find(|column| column.rows != first.rows) {
            Some(other) => {
                let message = format!("{} rows, where {:?} has {}", other.rows, first.key, first.rows);
                Err((other.key.clone(), message))
            }
            None => Ok(()),
        }
    }
}

/// Refuses keys that no file can hold beside `others`.
pub(crate) fn check_key<'a>(key: &str, others: impl Iterator<Item = &'a str>) -> Result<(), String> {
    if key.split('/').any(|name| name.is_empty() || name == "." || name.len() > crate::hdf5::encode::MAX_NAME)
    {
        return Err("a key is names with / between them; a name is not empty and not a single point".into());
    }
    let below =
        |inner: &str, outer: &str| inner.strip_prefix(outer).is_some_and(|rest| rest.starts_with('/'));
    for other in others {
        if other == key {
            return Err(format!("two names are kept as {key:?}"));
        }
        if below(other, key) || below(key, other) {
            return Err(format!("{key:?} and {other:?} cannot both be datasets"));
        }
    }
    Ok(())
}
