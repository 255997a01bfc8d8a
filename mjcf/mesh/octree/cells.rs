//! The cells of an octree: splitting, neighbours, balance, and corners that hang between others.

use super::overlap::overlaps;
use std::collections::{HashMap, VecDeque};

/// A cell.
pub(super) struct Cell {
    pub depth: i32,
    /// The cell it is a part of, and which.
    parent: Option<(usize, usize)>,
    /// Its parts, -1 for none.
    pub child: [i32; 8],
    /// Its corners.
    pub corner: [usize; 8],
    /// Minimum, maximum.
    pub aamm: [f64; 6],
}

/// All cells, the whole first.
pub(super) struct Cells {
    pub list: Vec<Cell>,
    /// Places of corners.
    pub corners: Vec<[f64; 3]>,
    by_place: HashMap<[u64; 3], usize>,
}

/// Places nearer than this are one.
const SAME: f64 = 1e-9;

impl Cell {
    fn is_leaf(&self) -> bool {
        self.child[0] == -1
    }

    fn centre(&self) -> [f64; 3] {
        std::array::from_fn(|k| (self.aamm[k] + self.aamm[k + 3]) / 2.0)
    }
}

impl Cells {
    /// Cells within `bounds`, split where they meet triangles.
    pub fn around(triangles: &[[[f64; 3]; 3]], bounds: [f64; 6], max_depth: i32) -> Self {
        let mut cells = Cells { list: Vec::new(), corners: Vec::new(), by_place: HashMap::new() };
        cells.add(0, None, bounds);
        let mut pending = VecDeque::from([(0, (0..triangles.len()).collect::<Vec<_>>())]);
        while let Some((cell, near)) = pending.pop_front() {
            let Cell { depth, aamm, .. } = cells.list[cell];
            let near: Vec<usize> = near.into_iter().filter(|&t| overlaps(&triangles[t], &aamm)).collect();
            if near.is_empty() || depth >= max_depth {
                continue;
            }
            let first = cells.split(cell);
            pending.extend((first..first + 8).map(|part| (part, near.clone())));
        }
        cells.balance();
        cells
    }

    fn add(&mut self, depth: i32, parent: Option<(usize, usize)>, aamm: [f64; 6]) {
        let corner = std::array::from_fn(|i| {
            let place: [f64; 3] = std::array::from_fn(|k| aamm[k + 3 * (i >> k & 1)]);
            // Zero has one key, whatever its sign.
            let key = place.map(|x| (x + 0.0).to_bits());
            *self.by_place.entry(key).or_insert_with(|| {
                self.corners.push(place);
                self.corners.len() - 1
            })
        });
        self.list.push(Cell { depth, parent, child: [-1; 8], corner, aamm });
    }

    /// Splits a leaf into eight, and returns the first.
    fn split(&mut self, cell: usize) -> usize {
        let first = self.list.len();
        let Cell { depth, aamm, .. } = self.list[cell];
        for slot in 0..8 {
            let part = std::array::from_fn(|k| {
                let (axis, upper) = (k % 3, slot >> (k % 3) & 1 == 1);
                if upper == (k >= 3) { aamm[k] } else { (aamm[axis] + aamm[axis + 3]) / 2.0 }
            });
            self.add(depth + 1, Some((cell, slot)), part);
            self.list[cell].child[slot] = (first + slot) as i32;
        }
        first
    }

    /// The smallest cell beyond a face that is at least as large as this one, or the leaf below it next to the face.
    /// Faces are numbered low and high by axis.
    fn neighbour(&self, cell: usize, face: usize) -> Option<usize> {
        let (axis, high) = (face / 2, face % 2);
        let bit = 1 << axis;
        let mut at = cell;
        let mut found = loop {
            let (parent, slot) = self.list[at].parent?;
            if (slot & bit != 0) != (high == 1) {
                break self.list[parent].child[slot ^ bit] as usize;
            }
            at = parent;
        };
        let centre = self.list[cell].centre();
        while !self.list[found].is_leaf() {
            let middle = self.list[found].centre();
            let beside = (0..3).filter(|&k| k != axis && centre[k] > middle[k]);
            let slot = beside.fold(usize::from(high == 0) << axis, |slot, k| slot | 1 << k);
            found = self.list[found].child[slot] as usize;
        }
        Some(found)
    }

    fn leaves(&self) -> Vec<usize> {
        (0..self.list.len()).filter(|&c| self.list[c].is_leaf()).collect()
    }

    /// Splits leaves until neighbours differ by one level at most.
    fn balance(&mut self) {
        loop {
            let mut coarse = Vec::new();
            for leaf in self.leaves() {
                for other in (0..6).filter_map(|face| self.neighbour(leaf, face)) {
                    let (own, its) = (self.list[leaf].depth, self.list[other].depth);
                    coarse.extend((its > own + 1).then_some(leaf));
                    coarse.extend((own > its + 1).then_some(other));
                }
            }
            if coarse.is_empty() {
                return;
            }
            for cell in coarse {
                if self.list[cell].is_leaf() {
                    self.split(cell);
                }
            }
        }
    }

    /// For each corner that lies in the middle of a larger neighbour's edge or face: the corners of that edge or face.
    pub fn hanging(&self) -> Vec<Vec<usize>> {
        let mut out = vec![Vec::new(); self.corners.len()];
        for leaf in self.leaves() {
            for face in 0..6 {
                let Some(other) = self.neighbour(leaf, face) else { continue };
                if self.list[other].depth >= self.list[leaf].depth {
                    continue;
                }
                let (axis, high) = (face / 2, face % 2);
                for i in 0..4 {
                    let slot = high << axis | (i & 1) << ((axis + 1) % 3) | (i >> 1) << ((axis + 2) % 3);
                    let corner = self.list[leaf].corner[slot];
                    if out[corner].is_empty() {
                        out[corner] = self.around_corner(corner, other);
                    }
                }
            }
        }
        out
    }

    /// Corners of the edge or face of `cell` in whose middle a corner lies; none for one of its own corners.
    fn around_corner(&self, corner: usize, cell: usize) -> Vec<usize> {
        let Cell { aamm, corner: own, .. } = &self.list[cell];
        let place = self.corners[corner];
        let low: [bool; 3] = std::array::from_fn(|k| (place[k] - aamm[k]).abs() < SAME);
        let high: [bool; 3] = std::array::from_fn(|k| (place[k] - aamm[k + 3]).abs() < SAME);
        let on = |k: usize| low[k] || high[k];
        let side = |k: usize| usize::from(high[k]) << k;
        match (0..3).filter(|&k| on(k)).count() {
            2 => {
                let free = (0..3).find(|&k| !on(k)).unwrap_or(0);
                let base = side((free + 1) % 3) | side((free + 2) % 3);
                vec![own[base], own[base | 1 << free]]
            }
            1 => {
                let fixed = (0..3).find(|&k| on(k)).unwrap_or(0);
                let (b, c) = ((fixed + 1) % 3, (fixed + 2) % 3);
                (0..4).map(|j| own[side(fixed) | (j & 1) << b | (j >> 1) << c]).collect()
            }
            _ => Vec::new(),
        }
    }
}
