//! Quickselect (Hoare 1961, "Algorithm 65: Find") with the median of three as pivot (Singleton 1969).
//!
//! Any selection serves while the order of the items is consistent. Degenerate faces of meshes have coordinates that are not
//! numbers and tie with everything, so that the order is not transitive and the outcome depends on which pairs are compared.
//! Thirteen of 302 robot and test models have such faces, and their compiled hierarchies show where those end up. Pivots,
//! scans and short runs therefore follow the selection of the standard library that MuJoCo is built with.

use std::cmp::Ordering;
use std::ops::Range;

/// Longest run that is sorted instead of split.
const SHORT: usize = 7;

/// Moves the `nth` item into place and all that come before it in front of it.
pub(crate) fn select<T>(items: &mut [T], nth: usize, before: &impl Fn(&T, &T) -> bool) {
    let mut from = 0;
    let mut run = Run { items, before, moved: false };
    while let Some(part) = run.settle(nth - from) {
        from += part.start;
        run = Run { items: &mut run.items[part], before, moved: false };
    }
}

/// A run of items that is put in order.
struct Run<'i, T, B> {
    items: &'i mut [T],
    before: &'i B,
    /// Items have changed places.
    moved: bool,
}

impl<T, B: Fn(&T, &T) -> bool> Run<'_, T, B> {
    fn comes_before(&self, i: usize, j: usize) -> bool {
        (self.before)(&self.items[i], &self.items[j])
    }

    fn exchange(&mut self, i: usize, j: usize) {
        self.items.swap(i, j);
        self.moved = true;
    }

    /// Exchanges two items if the one that should come second comes before the other.
    fn put_in_order(&mut self, first: usize, second: usize) {
        if self.comes_before(second, first) {
            self.exchange(first, second);
        }
    }

    /// Puts the `nth` item into place, or splits the run and returns the part in which that item is.
    fn settle(&mut self, nth: usize) -> Option<Range<usize>> {
        match self.items.len() {
            len if len > SHORT => return self.split(nth),
            3 => self.order_three([0, 1, 2]),
            _ => self.order_all(),
        }
        None
    }

    /// Splits the run at the median of its first, middle and last item. Both scans of the partition then end within the run:
    /// the last item is not before the pivot, and the first one is, or gives way to one that is.
    fn split(&mut self, nth: usize) -> Option<Range<usize>> {
        let len = self.items.len();
        let (middle, last) = (len / 2, len - 1);
        self.order_three([0, middle, last]);
        let mut open = 1..last;
        if !self.comes_before(0, middle) {
            let Some(low) = open.clone().rev().find(|&k| self.comes_before(k, middle)) else {
                // All tie with the first item or come after it.
                return self.gather_ties().filter(|&end| nth >= end).map(|end| end..len);
            };
            self.exchange(0, low);
            open.end = low;
        }
        let (at, pivot) = self.partition(open, middle, |run, k, pivot| run.comes_before(k, pivot));
        if at != pivot {
            self.put_in_order(at, pivot);
        }
        let (part, beside) = match nth.cmp(&at) {
            Ordering::Equal => return None,
            Ordering::Less => (0..at, 0..at),
            Ordering::Greater => (at + 1..len, at..len),
        };
        // A run in which nothing had to move was probably in order.
        if !self.moved && self.is_in_order(beside) { None } else { Some(part) }
    }

    /// Hoare's partition of the `open` places: what stands there on the wrong side is exchanged in pairs, the outermost first.
    /// Places before it are low and places after it high. Returns where the high items begin, and where the pivot is then.
    fn partition(
        &mut self,
        open: Range<usize>,
        mut pivot: usize,
        is_low: impl Fn(&Self, usize, usize) -> bool,
    ) -> (usize, usize) {
        let last = self.items.len() - 1;
        let Range { start: mut left, end: mut right } = open;
        while left < right {
            left = (left..last).find(|&k| !is_low(self, k, pivot)).unwrap_or(last);
            right = (1..right).rev().find(|&k| is_low(self, k, pivot)).unwrap_or(0);
            if left < right {
                self.exchange(left, right);
                pivot = if pivot == left { right } else { pivot };
                left += 1;
            }
        }
        (left, pivot)
    }

    /// Gathers the items that tie with the first one, which none comes before, and returns where they end; `None` when all do.
    fn gather_ties(&mut self) -> Option<usize> {
        let last = self.items.len() - 1;
        let mut from = 1;
        if !self.comes_before(0, last) {
            let greater = (1..last).find(|&k| self.comes_before(0, k))?;
            self.exchange(greater, last);
            from = greater + 1;
        }
        (from < last).then(|| self.partition(from..last, 0, |run, k, first| !run.comes_before(first, k)).0)
    }

    fn is_in_order(&self, part: Range<usize>) -> bool {
        part.clone().skip(1).all(|k| !self.comes_before(k, k - 1))
    }

    /// Orders the items at three places. The two neighbouring pairs are compared first; where one of them is exchanged, the
    /// other one is compared again.
    fn order_three(&mut self, [x, y, z]: [usize; 3]) {
        match (self.comes_before(y, x), self.comes_before(z, y)) {
            (false, false) => {}
            (true, true) => self.exchange(x, z),
            (true, false) => {
                self.exchange(x, y);
                self.put_in_order(y, z);
            }
            (false, true) => {
                self.exchange(y, z);
                self.put_in_order(x, y);
            }
        }
    }

    /// Orders all items: the least of the rest comes next, the first of equal ones.
    fn order_all(&mut self) {
        for next in 0..self.items.len().saturating_sub(1) {
            let rest = next + 1..self.items.len();
            let least = rest.fold(next, |least, k| if self.comes_before(k, least) { k } else { least });
            self.items.swap(next, least);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::select;

    /// Values of a fixed sequence; few different ones tie often.
    fn values(count: usize, kinds: u64) -> Vec<u64> {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) % kinds
        };
        (0..count).map(|_| next()).collect()
    }

    #[test]
    fn what_comes_before_the_nth_item_is_not_greater() {
        for (count, kinds) in
            (1..60).flat_map(|n| [(n, 2), (n, 5), (n, 1000)]).chain([(3000, 4), (3000, 1 << 30)])
        {
            let mut sorted = values(count, kinds);
            sorted.sort_unstable();
            for nth in [0, count / 2, count - 1] {
                let mut items = values(count, kinds);
                select(&mut items, nth, &|a, b| a < b);
                assert_eq!(items[nth], sorted[nth], "{count} items of {kinds} kinds, {nth}");
                assert!(items[..nth].iter().all(|x| *x <= items[nth]));
                assert!(items[nth..].iter().all(|x| *x >= items[nth]));
            }
        }
    }

    /// An order that is not transitive must end all the same.
    #[test]
    fn items_that_tie_with_all_others_end_somewhere() {
        let mut items: Vec<(f64, usize)> = values(500, 50)
            .iter()
            .enumerate()
            .map(|(i, &x)| (if x < 5 { f64::NAN } else { x as f64 }, i))
            .collect();
        let before = |a: &(f64, usize), b: &(f64, usize)| {
            if (a.0 - b.0).abs() > 0.0 { a.0 < b.0 } else { a.1 < b.1 }
        };
        select(&mut items, 250, &before);
        let mut places: Vec<usize> = items.iter().map(|item| item.1).collect();
        places.sort_unstable();
        assert!(places.iter().enumerate().all(|(i, &place)| i == place), "an item was lost");
    }
}
