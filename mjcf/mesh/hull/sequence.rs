//! The orders of facets and vertices: settled items, then items of the current step.

use super::id::{FacetId, Id};

/// Neighbours of an item in its sequence.
#[derive(Debug, Clone, Copy)]
struct Link<I> {
    before: Option<I>,
    after: Option<I>,
}

/// Distinct ids in an order, as a doubly linked list: the settled ones, then the fresh ones. Every change
/// takes constant time.
#[derive(Debug)]
pub(super) struct Sequence<I> {
    links: Vec<Link<I>>,
    first: Option<I>,
    last: Option<I>,
    first_fresh: Option<I>,
    len: usize,
}

impl<I> Default for Sequence<I> {
    fn default() -> Self {
        Self { links: Vec::new(), first: None, last: None, first_fresh: None, len: 0 }
    }
}

impl<I: Id> Sequence<I> {
    pub(super) fn len(&self) -> usize {
        self.len
    }

    pub(super) fn after(&self, id: I) -> Option<I> {
        self.links[id.at()].after
    }

    pub(super) fn first(&self) -> Option<I> {
        self.first
    }

    pub(super) fn first_fresh(&self) -> Option<I> {
        self.first_fresh
    }

    /// All ids from `start` on; none if that is `None`.
    pub(super) fn from(&self, start: Option<I>) -> impl Iterator<Item = I> + '_ {
        std::iter::successors(start, |&at| self.after(at))
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = I> + '_ {
        self.from(self.first)
    }

    pub(super) fn fresh(&self) -> impl Iterator<Item = I> + '_ {
        self.from(self.first_fresh)
    }

    /// Adds an id that is not in the sequence at the end, as a fresh one.
    pub(super) fn push(&mut self, id: I) {
        self.insert_before(id, None);
        self.first_fresh = self.first_fresh.or(Some(id));
    }

    /// Adds an id that is not in the sequence in front of `next`, at the end if that is `None`.
    fn insert_before(&mut self, id: I, next: Option<I>) {
        let before = match next {
            Some(next) => self.links[next.at()].before,
            None => self.last,
        };
        if self.links.len() <= id.at() {
            self.links.resize(id.at() + 1, Link { before: None, after: None });
        }
        self.links[id.at()] = Link { before, after: next };
        match before {
            Some(before) => self.links[before.at()].after = Some(id),
            None => self.first = Some(id),
        }
        match next {
            Some(next) => self.links[next.at()].before = Some(id),
            None => self.last = Some(id),
        }
        self.len += 1;
    }

    /// Takes an id out of the sequence.
    pub(super) fn remove(&mut self, id: I) {
        let Link { before, after } = self.links[id.at()];
        match before {
            Some(before) => self.links[before.at()].after = after,
            None => self.first = after,
        }
        match after {
            Some(after) => self.links[after.at()].before = before,
            None => self.last = before,
        }
        if self.first_fresh == Some(id) {
            self.first_fresh = after;
        }
        self.len -= 1;
    }

    /// Makes all fresh ids settled.
    pub(super) fn settle(&mut self) {
        self.first_fresh = None;
    }
}

/// The facets in order, with a cursor at the first settled one whose points may still have to be added.
/// A cursor behind the last settled facet goes to the first fresh one when the fresh ones settle.
#[derive(Debug, Default)]
pub(super) struct Agenda {
    order: Sequence<FacetId>,
    cursor: Option<FacetId>,
}

impl Agenda {
    pub(super) fn order(&self) -> &Sequence<FacetId> {
        &self.order
    }

    pub(super) fn cursor(&self) -> Option<FacetId> {
        self.cursor
    }

    pub(super) fn push(&mut self, facet: FacetId) {
        self.order.push(facet);
    }

    pub(super) fn remove(&mut self, facet: FacetId) {
        if self.cursor == Some(facet) {
            let after = self.order.after(facet);
            self.cursor = after.filter(|_| after != self.order.first_fresh());
        }
        self.order.remove(facet);
    }

    /// Moves the cursor over the facet it is at.
    pub(super) fn advance(&mut self) {
        self.cursor = self.cursor.and_then(|facet| self.order.after(facet));
    }

    /// Moves the cursor to the first facet.
    pub(super) fn rewind(&mut self) {
        self.cursor = self.order.first();
    }

    /// Moves a facet to the cursor, in front of the one that was there. There are no fresh facets.
    pub(super) fn promote(&mut self, facet: FacetId) {
        self.remove(facet);
        self.order.insert_before(facet, self.cursor);
        self.cursor = Some(facet);
    }

    pub(super) fn settle(&mut self) {
        self.cursor = self.cursor.or(self.order.first_fresh());
        self.order.settle();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(sequence: &Sequence<FacetId>) -> Vec<usize> {
        sequence.iter().map(Id::at).collect()
    }

    /// Random changes against a plain list.
    #[test]
    fn sequence_is_a_list() {
        let (mut sequence, mut list, mut settled) = (Sequence::default(), Vec::new(), 0);
        let mut state = 1u64;
        for _ in 0..2000 {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let id = (state >> 33) as usize % 20;
            match list.iter().position(|&x| x == id) {
                Some(at) => {
                    sequence.remove(FacetId::new(id));
                    list.remove(at);
                    settled -= usize::from(at < settled);
                }
                None => {
                    sequence.push(FacetId::new(id));
                    list.push(id);
                }
            }
            if state >> 60 == 0 {
                sequence.settle();
                settled = list.len();
            }
            assert_eq!(ids(&sequence), list);
            assert_eq!(sequence.fresh().map(Id::at).collect::<Vec<_>>(), list[settled..]);
            assert_eq!(sequence.len(), list.len());
        }
    }

    #[test]
    fn cursor_survives_changes() {
        let facets: [FacetId; 5] = std::array::from_fn(FacetId::new);
        let mut agenda = Agenda::default();
        facets[..3].iter().for_each(|&facet| agenda.push(facet));
        agenda.settle();
        assert_eq!(agenda.cursor(), Some(facets[0]), "the first of those that settled");
        agenda.remove(facets[0]);
        assert_eq!(agenda.cursor(), Some(facets[1]), "the next takes the place of a removed one");
        agenda.advance();
        agenda.push(facets[3]);
        agenda.remove(facets[2]);
        assert_eq!(agenda.cursor(), None, "fresh facets wait until they settle");
        agenda.push(facets[4]);
        agenda.settle();
        assert_eq!(agenda.cursor(), Some(facets[3]));
        agenda.promote(facets[1]);
        assert_eq!(agenda.cursor(), Some(facets[1]));
        assert_eq!(ids(agenda.order()), [1, 3, 4]);
        agenda.promote(facets[4]);
        agenda.rewind();
        assert_eq!((agenda.cursor(), ids(agenda.order())), (Some(facets[4]), vec![4, 1, 3]));
    }
}
