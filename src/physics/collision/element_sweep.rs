//! Elements of one flex that may touch each other: sweep and prune along the longest axis of the flex's box.

use crate::collision::broad_phase::ordered_bits;

/// Pairs of elements that are examined, at most.
const MAX_PAIRS: usize = 1_000_000;

/// Open elements that are compared together.
const LANES: usize = 8;

/// Working memory of the sweep.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sweep {
    /// The elements that take part.
    pub(super) elements: Vec<u32>,
    /// Bodies of the corners of each element; of triangles and lines some are there twice.
    pub(super) bodies: Vec<[i32; 4]>,
    ends: Vec<u64>,
    open: OpenElements,
    /// Elements that may touch.
    pub(super) pairs: Vec<[u32; 2]>,
}

/// Some body is among both: such elements do not touch. Interpolated corners have none, -1.
fn share_body(a: &[i32; 4], b: &[i32; 4]) -> bool {
    let mut shared = false;
    for turn in 0..4 {
        (0..4).for_each(|k| shared |= (a[k] == b[(k + turn) % 4]) & (a[k] >= 0));
    }
    shared
}

impl Sweep {
    /// Fills `pairs` in the order in which boxes begin along the axis, less those with a common body; ends are compared in
    /// single precision.
    pub(super) fn find_pairs(&mut self, boxes: &[[f64; 6]], axis: usize) {
        let Sweep { elements, bodies, ends, open, pairs } = self;
        let most = (elements.len() * elements.len().saturating_sub(1) / 2).min(MAX_PAIRS);
        let key = |x: f64, index: usize| (u64::from(ordered_bits(x as f32)) << 32) | index as u64;
        ends.clear();
        for (i, &e) in elements.iter().enumerate() {
            let aabb = &boxes[e as usize];
            // A box of negative size would end before it begins; nothing touches it.
            if aabb[axis + 3] < 0.0 {
                continue;
            }
            ends.push(key(aabb[axis] - aabb[axis + 3], 2 * i));
            ends.push(key(aabb[axis] + aabb[axis + 3], 2 * i + 1));
        }
        ends.sort_unstable();
        open.clear(elements.len());
        pairs.clear();
        let (others, mut examined) = ([[1, 2], [0, 2], [0, 1]][axis], 0);
        for &end in ends.iter() {
            let index = (end as u32 / 2) as usize;
            if end & 1 == 1 {
                open.remove(index);
                continue;
            }
            let e = elements[index];
            let aabb = &boxes[e as usize];
            let extent = Extent {
                low: others.map(|k| aabb[k] - aabb[k + 3]),
                high: others.map(|k| aabb[k] + aabb[k + 3]),
            };
            open.for_overlapping(&extent, |earlier| {
                let earlier = elements[earlier];
                if examined < most && !share_body(&bodies[earlier as usize], &bodies[e as usize]) {
                    pairs.push([earlier, e]);
                }
                examined += 1;
            });
            if examined >= most {
                return;
            }
            open.push(index, &extent);
        }
    }
}

/// Extent of a box along the two axes that are not swept.
struct Extent {
    low: [f64; 2],
    high: [f64; 2],
}

/// Elements that have begun and not ended, in the order in which they began.
#[derive(Clone, Debug, Default)]
struct OpenElements {
    groups: Vec<Group>,
    /// Place of each element among the groups.
    place: Vec<u32>,
    /// Elements in the groups, and how many of them have ended.
    count: usize,
    ended: usize,
}

/// Some open elements; the extents of those that have ended are empty.
#[derive(Clone, Copy, Debug)]
struct Group {
    low: [[f64; LANES]; 2],
    high: [[f64; LANES]; 2],
    index: [u32; LANES],
}

impl Group {
    const EMPTY: Group =
        Group { low: [[f64::INFINITY; LANES]; 2], high: [[f64::NEG_INFINITY; LANES]; 2], index: [0; LANES] };
}

impl OpenElements {
    fn clear(&mut self, elements: usize) {
        self.groups.clear();
        self.place.clear();
        self.place.resize(elements, 0);
        (self.count, self.ended) = (0, 0);
    }

    fn push(&mut self, index: usize, extent: &Extent) {
        let (at, lane) = (self.count / LANES, self.count % LANES);
        if lane == 0 {
            self.groups.push(Group::EMPTY);
        }
        let group = &mut self.groups[at];
        for k in 0..2 {
            (group.low[k][lane], group.high[k][lane]) = (extent.low[k], extent.high[k]);
        }
        group.index[lane] = index as u32;
        self.place[index] = self.count as u32;
        self.count += 1;
    }

    fn remove(&mut self, index: usize) {
        let place = self.place[index] as usize;
        let group = &mut self.groups[place / LANES];
        group.low[0][place % LANES] = f64::INFINITY;
        group.high[0][place % LANES] = f64::NEG_INFINITY;
        self.ended += 1;
        if self.ended > LANES && 2 * self.ended > self.count {
            self.compact();
        }
    }

    /// Moves the elements that are still open together.
    fn compact(&mut self) {
        let count = std::mem::take(&mut self.count);
        self.ended = 0;
        for place in 0..count {
            let (group, lane) = (self.groups[place / LANES], place % LANES);
            if group.low[0][lane] != f64::INFINITY {
                let (to, to_lane) = (self.count / LANES, self.count % LANES);
                let target = &mut self.groups[to];
                for k in 0..2 {
                    (target.low[k][to_lane], target.high[k][to_lane]) =
                        (group.low[k][lane], group.high[k][lane]);
                }
                target.index[to_lane] = group.index[lane];
                self.place[group.index[lane] as usize] = self.count as u32;
                self.count += 1;
            }
        }
        self.groups.truncate(self.count.div_ceil(LANES));
        if let (Some(last), filled @ 1..) = (self.groups.last_mut(), self.count % LANES) {
            last.low[0][filled..].fill(f64::INFINITY);
            last.high[0][filled..].fill(f64::NEG_INFINITY);
        }
    }

    /// Calls `f` with every open element that overlaps `extent`, in order.
    fn for_overlapping(&self, extent: &Extent, mut f: impl FnMut(usize)) {
        for group in &self.groups {
            let mut apart = [false; LANES];
            for k in 0..2 {
                let (low, high) = (extent.low[k], extent.high[k]);
                for lane in 0..LANES {
                    apart[lane] |= (group.low[k][lane] > high) | (low > group.high[k][lane]);
                }
            }
            if apart != [true; LANES] {
                let near = group.index.iter().zip(apart).filter(|(_, apart)| !apart);
                near.for_each(|(&index, _)| f(index as usize));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes whose centres and sizes look random. Each is an element with its own body, except that every fifth shares the body
    /// of the element before it.
    fn sweep(count: usize) -> (Sweep, Vec<[f64; 6]>) {
        let number = |k: usize| ((k * 2_654_435_761) % 1009) as f64 / 1009.0;
        let boxes = (0..count)
            .map(|e| std::array::from_fn(|k| number(6 * e + k + 1) * if k < 3 { 3.0 } else { 0.193_217_5 }))
            .collect();
        let bodies = (0..count).map(|e| [if e % 5 == 4 { e - 1 } else { e } as i32; 4]).collect();
        (Sweep { elements: (0..count as u32).collect(), bodies, ..Sweep::default() }, boxes)
    }

    #[test]
    fn boxes_of_negative_size_touch_nothing() {
        let (mut sweep, mut boxes) = sweep(40);
        boxes.iter_mut().step_by(3).for_each(|aabb| (3..6).for_each(|k| aabb[k] = -aabb[k]));
        sweep.find_pairs(&boxes, 0);
        assert!(!sweep.pairs.is_empty() && sweep.pairs.iter().flatten().all(|e| e % 3 != 0));
    }

    #[test]
    fn every_overlap_is_found_once() {
        let (mut sweep, boxes) = sweep(300);
        for axis in 0..3 {
            sweep.find_pairs(&boxes, axis);
            let overlap = |a: usize, b: usize| {
                (0..3).all(|k| (boxes[a][k] - boxes[b][k]).abs() <= boxes[a][k + 3] + boxes[b][k + 3])
            };
            let mut expected = Vec::new();
            for a in 0..300 {
                for b in (a + 1..300).filter(|&b| !(b % 5 == 4 && a == b - 1) && overlap(a, b)) {
                    expected.push([a as u32, b as u32]);
                }
            }
            let mut found = sweep.pairs.clone();
            found.iter_mut().for_each(|pair| pair.sort_unstable());
            found.sort_unstable();
            assert!(expected.len() > 100);
            assert!(found == expected, "axis {axis}: {} pairs, not {}", found.len(), expected.len());
        }
    }
}
