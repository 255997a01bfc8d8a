//! Arrays that models share until one of them writes, and the three forms in which the table of fields is stored.
//!
//! | form | arrays | for |
//! |---|---|---|
//! | `Arrays`(super::Arrays) | [`Array`]: shared, copied on write | a finished model |
//! | [`Rows`](super::Rows) | `Vec` | a compiler that appends row by row |
//! | [`Draft`](super::Draft) | [`Writer`]: keeps the length, remembers what was before | an edit |
//!
//! ```
//! let text = "<mujoco><worldbody><body name='ball'><freejoint/><geom size='.1'/></body></worldbody></mujoco>";
//! let model = robohive_mjcf::load_str(text)?.model;
//! let ball = model.body("ball").ok_or("no ball")?;
//! let mut heavy = model.clone();
//! assert_eq!(heavy.body_mass.as_ptr(), model.body_mass.as_ptr());
//! heavy.edit(|m| m.body_mass[ball] *= 2.0)?;
//! assert_eq!(heavy.body_mass[ball], 2.0 * model.body_mass[ball]);
//! assert_eq!(heavy.body_pos.as_ptr(), model.body_pos.as_ptr());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::table::{Field, Row, Slice, assign_rows, write_rows};
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut, Index, IndexMut};
use std::slice::SliceIndex;
use std::sync::Arc;

/// A form of storage of the table of fields.
pub trait Form {
    /// Storage of an array of rows `R` that are numbered by `N`.
    type Column<R: Row, N: 'static>;
    /// Storage of a group of settings.
    type Group<G: 'static>;
    /// Storage of the name.
    type Label;
}

/// A form that holds the arrays itself.
pub trait Owned: Form {
    /// An array without rows.
    fn empty<R: Row, N: 'static>() -> Self::Column<R, N>;
}

/// The form of a finished model.
#[derive(Debug)]
pub enum Finished {}

impl Form for Finished {
    type Column<R: Row, N: 'static> = Array<R, N>;
    type Group<G: 'static> = G;
    type Label = String;
}

impl Owned for Finished {
    fn empty<R: Row, N: 'static>() -> Array<R, N> {
        Array::default()
    }
}

/// The form to which rows are appended.
#[derive(Debug)]
pub enum Growing {}

impl Form for Growing {
    type Column<R: Row, N: 'static> = Vec<R>;
    type Group<G: 'static> = G;
    type Label = String;
}

impl Owned for Growing {
    fn empty<R: Row, N: 'static>() -> Vec<R> {
        Vec::new()
    }
}

/// The form that an edit writes.
#[derive(Debug)]
pub struct Drafted<'a>(PhantomData<&'a mut ()>);

impl<'a> Form for Drafted<'a> {
    type Column<R: Row, N: 'static> = Writer<'a, R, N>;
    type Group<G: 'static> = &'a mut G;
    type Label = &'a str;
}

/// An array of a model, read as a slice. Clones share its memory until one of them writes.
///
/// `N` says what numbers its rows, so that an id indexes the arrays of its kind alone: `m.body_pos[body]`.
pub struct Array<R, N> {
    rows: Arc<[R]>,
    /// What the edit under way, if any, replaced; afterwards memory for the next one.
    undo: Option<Box<Undo<R>>>,
    numbered: PhantomData<fn() -> N>,
}

struct Undo<R> {
    /// While `written`, the rows before the edit; else rows of the same number that nobody shares.
    rows: Arc<[R]>,
    written: bool,
}

impl<R: Row, N> Array<R, N> {
    /// The rows to write, those before kept for [`Array::revert`].
    fn draft(&mut self) -> &mut [R] {
        match &mut self.undo {
            Some(undo) if undo.written => {}
            Some(undo) => {
                Arc::make_mut(&mut undo.rows).copy_from_slice(&self.rows);
                std::mem::swap(&mut undo.rows, &mut self.rows);
                undo.written = true;
            }
            None => {
                let copy = Arc::from(&self.rows[..]);
                let rows = std::mem::replace(&mut self.rows, copy);
                self.undo = Some(Box::new(Undo { rows, written: true }));
            }
        }
        Arc::make_mut(&mut self.rows)
    }

    /// An edit that is neither settled nor reverted wrote the array.
    pub(crate) fn is_written(&self) -> bool {
        self.undo.as_ref().is_some_and(|undo| undo.written)
    }

    /// The rows before the edit under way.
    pub(crate) fn before(&self) -> &[R] {
        match &self.undo {
            Some(undo) if undo.written => &undo.rows,
            _ => &self.rows,
        }
    }

    /// The array before the edit under way.
    pub(crate) fn previous(&self) -> Self {
        match &self.undo {
            Some(undo) if undo.written => Self::of(Arc::clone(&undo.rows)),
            _ => self.clone(),
        }
    }

    /// Accepts what an edit wrote; its memory is kept for the next edit.
    pub(crate) fn settle(&mut self) {
        if let Some(undo) = self.undo.as_mut().filter(|undo| undo.written) {
            undo.written = false;
            if Arc::get_mut(&mut undo.rows).is_none() {
                undo.rows = Arc::from(&self.rows[..]);
            }
        }
    }

    /// Takes back what an edit wrote.
    pub(crate) fn revert(&mut self) {
        if let Some(undo) = self.undo.as_mut().filter(|undo| undo.written) {
            undo.written = false;
            std::mem::swap(&mut undo.rows, &mut self.rows);
        }
    }

    /// Replaces the rows by others of the same number, and only copies shared memory when they differ.
    pub(crate) fn update(&mut self, rows: &[R]) {
        if self.rows[..] != *rows {
            self.copy_from_slice(rows);
        }
    }

    /// Replaces one row, and only copies shared memory when it differs.
    pub(crate) fn update_row(&mut self, index: usize, row: R) {
        if self.rows[index] != row {
            self.make_mut()[index] = row;
        }
    }

    fn make_mut(&mut self) -> &mut [R] {
        Arc::make_mut(&mut self.rows)
    }
}

impl<R, N> Array<R, N> {
    /// Takes over rows. Not inlined, since a model fills hundreds of arrays in one function.
    #[inline(never)]
    pub(super) fn fill(&mut self, rows: Vec<R>) {
        *self = Self::from(rows);
    }

    fn of(rows: Arc<[R]>) -> Self {
        Array { rows, undo: None, numbered: PhantomData }
    }
}

impl<R, N> Clone for Array<R, N> {
    fn clone(&self) -> Self {
        Self::of(Arc::clone(&self.rows))
    }
}

impl<R, N> Default for Array<R, N> {
    fn default() -> Self {
        Self::of(Arc::default())
    }
}

impl<R: fmt::Debug, N> fmt::Debug for Array<R, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.rows.fmt(f)
    }
}

impl<R, N> From<Vec<R>> for Array<R, N> {
    fn from(rows: Vec<R>) -> Self {
        Self::of(rows.into())
    }
}

impl<R, N> FromIterator<R> for Array<R, N> {
    fn from_iter<I: IntoIterator<Item = R>>(rows: I) -> Self {
        Self::of(rows.into_iter().collect())
    }
}

impl<R, N> Deref for Array<R, N> {
    type Target = [R];

    fn deref(&self) -> &[R] {
        &self.rows
    }
}

impl<R: Row, N> DerefMut for Array<R, N> {
    fn deref_mut(&mut self) -> &mut [R] {
        self.make_mut()
    }
}

impl<'a, R, N> IntoIterator for &'a Array<R, N> {
    type Item = &'a R;
    type IntoIter = std::slice::Iter<'a, R>;

    fn into_iter(self) -> Self::IntoIter {
        self.rows.iter()
    }
}

impl<R: PartialEq, N, S: AsRef<[R]> + ?Sized> PartialEq<S> for Array<R, N> {
    fn eq(&self, other: &S) -> bool {
        self.rows[..] == *other.as_ref()
    }
}

impl<R: PartialEq, N> PartialEq<Array<R, N>> for Vec<R> {
    fn eq(&self, other: &Array<R, N>) -> bool {
        self[..] == other.rows[..]
    }
}

impl<R, N> AsRef<[R]> for Array<R, N> {
    fn as_ref(&self) -> &[R] {
        &self.rows
    }
}

/// What an array of rows `R`, numbered by `N`, can be indexed by: numbers, ranges, ids of its kind of element.
pub trait Place<R, N> {
    /// A row, or a slice of rows.
    type Output: ?Sized;
    /// What is there.
    fn of(self, rows: &[R]) -> &Self::Output;
    /// What is there, to write.
    fn of_mut(self, rows: &mut [R]) -> &mut Self::Output;
}

impl<R, N, I: SliceIndex<[R]>> Place<R, N> for I {
    type Output = I::Output;

    fn of(self, rows: &[R]) -> &I::Output {
        &rows[self]
    }

    fn of_mut(self, rows: &mut [R]) -> &mut I::Output {
        &mut rows[self]
    }
}

impl<R, N, I: Place<R, N>> Index<I> for Array<R, N> {
    type Output = I::Output;

    fn index(&self, place: I) -> &I::Output {
        place.of(&self.rows)
    }
}

impl<R: Row, N, I: Place<R, N>> IndexMut<I> for Array<R, N> {
    fn index_mut(&mut self, place: I) -> &mut I::Output {
        place.of_mut(self.make_mut())
    }
}

/// An array that an edit may write: the numbers, not how many.
pub struct Writer<'a, R, N>(pub(super) &'a mut Array<R, N>);

impl<R: fmt::Debug, N> fmt::Debug for Writer<'_, R, N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<R, N> Deref for Writer<'_, R, N> {
    type Target = [R];

    fn deref(&self) -> &[R] {
        &self.0.rows
    }
}

impl<R: Row, N> DerefMut for Writer<'_, R, N> {
    fn deref_mut(&mut self) -> &mut [R] {
        self.0.draft()
    }
}

impl<R, N, I: Place<R, N>> Index<I> for Writer<'_, R, N> {
    type Output = I::Output;

    fn index(&self, place: I) -> &I::Output {
        place.of(&self.0.rows)
    }
}

impl<R: Row, N, I: Place<R, N>> IndexMut<I> for Writer<'_, R, N> {
    fn index_mut(&mut self, place: I) -> &mut I::Output {
        place.of_mut(self.0.draft())
    }
}

impl<R: Row, N> Field for Array<R, N> {
    fn scalars(&self) -> Slice<'_> {
        R::scalars(&self.rows)
    }
    fn allocate(&mut self, rows: usize, width: usize) {
        *self = (0..rows * width).map(|_| R::ZERO).collect();
    }
    fn assign(&mut self, values: &[f64]) -> bool {
        if values.len() == self.rows.len() * R::COLUMNS {
            return assign_rows(self.make_mut(), values);
        }
        let whole = values.len().is_multiple_of(R::COLUMNS);
        if whole {
            *self = values.chunks_exact(R::COLUMNS).map(R::from_f64).collect();
        }
        whole
    }
    fn write(&mut self, first: usize, bytes: &[u8]) {
        write_rows(&mut self.make_mut()[first..], bytes);
    }
    const COLUMNS: usize = R::COLUMNS;
    const ROW_BYTES: usize = R::BYTES;
}

impl<R: Row, N> Writer<'_, R, N> {
    /// Overwrites all scalars; false, with nothing written, when there are more or fewer.
    pub(crate) fn assign(&mut self, values: &[f64]) -> bool {
        values.len() == self.0.rows.len() * R::COLUMNS && assign_rows(self.0.draft(), values)
    }
}
