//! Elements of one flex that may touch each other: sweep and prune along the longest axis of the flex's box.

use super::{World, element, is_active};
use crate::collision::CollisionScratch;
use crate::collision::broad_phase::ordered_bits;
use crate::data::Contacts;

/// Pairs of elements that are examined, at most.
const MAX_PAIRS: usize = 1_000_000;

/// Working memory of the sweep.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sweep {
    elements: Vec<u32>,
    ends: Vec<u64>,
    open: Vec<u32>,
    pairs: Vec<[u32; 2]>,
}

/// Contacts between elements of a flex.
pub(super) fn own_elements(at: World, f: usize, scratch: &mut CollisionScratch, con: &mut Contacts) {
    let flex = at.flex(f);
    let mut sweep = std::mem::take(&mut scratch.sweep);
    sweep.elements.clear();
    sweep.elements.extend((0..flex.elements().len()).filter(|&e| is_active(flex, e)).map(|e| e as u32));
    let root = &at.flexes.bvh_aabb_dyn[at.m.flex_bvhadr[f] as usize - at.m.nbvhstatic];
    sweep.find_pairs(at.boxes(f), longest_axis(root));
    for pair in &sweep.pairs {
        if !scratch.has_room(con) {
            break;
        }
        element::with_element(at, [f, f], pair.map(|e| e as usize), scratch, con);
    }
    scratch.sweep = sweep;
}

/// Longest axis of a box (centre, half sizes); of equal ones the last.
fn longest_axis(aabb: &[f64; 6]) -> usize {
    let [_, _, _, x, y, z] = *aabb;
    match () {
        () if x > y && x > z => 0,
        () if y > z => 1,
        () => 2,
    }
}

impl Sweep {
    /// Fills `pairs` in the order in which boxes begin along the axis; ends are compared in single precision.
    fn find_pairs(&mut self, boxes: &[[f64; 6]], axis: usize) {
        let most = (self.elements.len() * self.elements.len().saturating_sub(1) / 2).min(MAX_PAIRS);
        let low = |e: u32, k: usize| boxes[e as usize][k] - boxes[e as usize][k + 3];
        let high = |e: u32, k: usize| boxes[e as usize][k] + boxes[e as usize][k + 3];
        let key = |x: f64, index: usize| (u64::from(ordered_bits(x as f32)) << 32) | index as u64;
        self.ends.clear();
        for (i, &e) in self.elements.iter().enumerate() {
            self.ends.push(key(low(e, axis), 2 * i));
            self.ends.push(key(high(e, axis), 2 * i + 1));
        }
        self.ends.sort_unstable();
        self.open.clear();
        self.pairs.clear();
        let others = [[1, 2], [0, 2], [0, 1]][axis];
        for &end in &self.ends {
            let index = end as u32;
            let element = self.elements[(index / 2) as usize];
            if index % 2 == 1 {
                self.open.retain(|&e| e != element);
                continue;
            }
            for &earlier in &self.open {
                let apart =
                    |k: usize| low(earlier, k) > high(element, k) || low(element, k) > high(earlier, k);
                if !others.into_iter().any(apart) {
                    self.pairs.push([earlier, element]);
                    if self.pairs.len() >= most {
                        return;
                    }
                }
            }
            self.open.push(element);
        }
    }
}
