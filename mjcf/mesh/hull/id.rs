//! Typed ids of facets, vertices and ridges, and the tables and sets they index.

use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

/// A place in a [`Table`] of one kind of item.
pub(super) trait Id: Copy + PartialEq {
    fn new(at: usize) -> Self;
    fn at(self) -> usize;
}

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident,)+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub(super) struct $name(u32);

        impl Id for $name {
            fn new(at: usize) -> Self {
                Self(at as u32)
            }

            fn at(self) -> usize {
                self.0 as usize
            }
        }
    )+};
}

ids! {
    /// A facet; ids of removed facets are given out again.
    FacetId,
    /// A vertex; the greater of two is the newer.
    VertexId,
    /// A ridge, never given out again.
    RidgeId,
}

/// All items of one kind.
#[derive(Debug)]
pub(super) struct Table<I, T> {
    items: Vec<T>,
    id: PhantomData<I>,
}

impl<I: Id, T> Table<I, T> {
    pub(super) fn push(&mut self, item: T) -> I {
        self.items.push(item);
        I::new(self.items.len() - 1)
    }
}

impl<I, T> Default for Table<I, T> {
    fn default() -> Self {
        Self { items: Vec::new(), id: PhantomData }
    }
}

impl<I: Id, T> Index<I> for Table<I, T> {
    type Output = T;

    fn index(&self, id: I) -> &T {
        &self.items[id.at()]
    }
}

impl<I: Id, T> IndexMut<I> for Table<I, T> {
    fn index_mut(&mut self, id: I) -> &mut T {
        &mut self.items[id.at()]
    }
}

/// A set of ids that is emptied in constant time: an id is in it if it carries the current stamp.
#[derive(Debug)]
pub(super) struct Marks<I> {
    stamp: u32,
    stamps: Vec<u32>,
    id: PhantomData<I>,
}

impl<I> Default for Marks<I> {
    fn default() -> Self {
        Self { stamp: 1, stamps: Vec::new(), id: PhantomData }
    }
}

impl<I: Id> Marks<I> {
    pub(super) fn clear(&mut self) {
        self.stamp += 1;
    }

    /// Puts `id` into the set; whether it was not there.
    pub(super) fn add(&mut self, id: I) -> bool {
        if self.stamps.len() <= id.at() {
            self.stamps.resize(id.at() + 1, 0);
        }
        std::mem::replace(&mut self.stamps[id.at()], self.stamp) != self.stamp
    }

    pub(super) fn has(&self, id: I) -> bool {
        self.stamps.get(id.at()) == Some(&self.stamp)
    }

    /// Takes `id` out of the set; whether it was there.
    pub(super) fn remove(&mut self, id: I) -> bool {
        let was_there = self.has(id);
        if was_there {
            self.stamps[id.at()] = 0;
        }
        was_there
    }
}
