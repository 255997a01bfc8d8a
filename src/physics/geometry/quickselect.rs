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
    let mut run = 0..items.len();
    while run.len() > SHORT {
        let start = run.start;
        match narrowed(&mut items[run], nth - start, before) {
            Some(part) => run = start + part.start..start + part.end,
            None => return,
        }
    }
    let run = &mut items[run];
    if run.len() == 3 {
        order_three(run, [0, 1, 2], before);
    } else {
        sort_by_selection(run, before);
    }
}

/// Splits a run at a pivot; the part that still holds the `nth` item, `None` once that is in place.
fn narrowed<T>(run: &mut [T], nth: usize, before: &impl Fn(&T, &T) -> bool) -> Option<Range<usize>> {
    let (middle, last) = (run.len() / 2, run.len() - 1);
    let mut moved = order_three(run, [0, middle, last], before);
    let mut right = last;
    if !before(&run[0], &run[middle]) {
        // The first item ties with the pivot: a smaller one takes its place.
        match (1..last).rev().find(|&k| before(&run[k], &run[middle])) {
            Some(smaller) => {
                run.swap(0, smaller);
                (moved, right) = (true, smaller);
            }
            None => return end_of_ties(run, before).filter(|&end| nth >= end).map(|end| end..run.len()),
        }
    }
    let split = partition(run, [1, right], middle, before);
    moved |= split.moved;
    let (at, pivot) = (split.at, split.pivot);
    if at != pivot && before(&run[pivot], &run[at]) {
        run.swap(at, pivot);
        moved = true;
    }
    let (part, checked) = match nth.cmp(&at) {
        Ordering::Equal => return None,
        Ordering::Less => (0..at, 0..at),
        Ordering::Greater => (at + 1..run.len(), at..run.len()),
    };
    // Nothing moved: the run was probably in order.
    let ordered = |part: &[T]| part.windows(2).all(|pair| !before(&pair[1], &pair[0]));
    if !moved && ordered(&run[checked]) { None } else { Some(part) }
}

/// Where a run was split: items before `at` are low.
struct Split {
    at: usize,
    /// Where the pivot is now.
    pivot: usize,
    moved: bool,
}

/// Hoare's partition: two scans from `left` up and from `right` down exchange what stands on the wrong side.
/// `is_low(item, pivot)` tells the sides apart; items at `right` and after are high already.
fn partition<T>(
    run: &mut [T],
    [mut left, mut right]: [usize; 2],
    mut pivot: usize,
    is_low: impl Fn(&T, &T) -> bool,
) -> Split {
    let last = run.len() - 1;
    let mut moved = false;
    while left < right {
        while left < last && is_low(&run[left], &run[pivot]) {
            left += 1;
        }
        right -= 1;
        while right > 0 && !is_low(&run[right], &run[pivot]) {
            right -= 1;
        }
        if left >= right {
            break;
        }
        run.swap(left, right);
        moved = true;
        if pivot == left {
            pivot = right;
        }
        left += 1;
    }
    Split { at: left, pivot, moved }
}

/// Gathers the items that tie with the first, to which none is smaller, and returns where they end; `None` when all do.
fn end_of_ties<T>(run: &mut [T], before: &impl Fn(&T, &T) -> bool) -> Option<usize> {
    let last = run.len() - 1;
    let mut left = 1;
    if !before(&run[0], &run[last]) {
        let greater = (1..last).find(|&k| before(&run[0], &run[k]))?;
        run.swap(greater, last);
        left = greater + 1;
    }
    let ties = |item: &T, first: &T| !before(first, item);
    if left == last { None } else { Some(partition(run, [left, last], 0, ties).at) }
}

/// Orders the items at three places; true when one moved.
fn order_three<T>(run: &mut [T], [x, y, z]: [usize; 3], before: &impl Fn(&T, &T) -> bool) -> bool {
    match [before(&run[y], &run[x]), before(&run[z], &run[y])] {
        [false, false] => return false,
        [true, true] => run.swap(x, z),
        [true, false] => {
            run.swap(x, y);
            if before(&run[z], &run[y]) {
                run.swap(y, z);
            }
        }
        [false, true] => {
            run.swap(y, z);
            if before(&run[y], &run[x]) {
                run.swap(x, y);
            }
        }
    }
    true
}

/// Sorts a short run: the least of the rest comes next.
fn sort_by_selection<T>(run: &mut [T], before: &impl Fn(&T, &T) -> bool) {
    for next in 0..run.len().saturating_sub(1) {
        let least =
            (next + 1..run.len()).fold(next, |least, k| if before(&run[k], &run[least]) { k } else { least });
        run.swap(next, least);
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
