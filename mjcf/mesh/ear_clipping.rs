//! Simple polygons to triangles by clipping ears (Meisters 1975), in the order of the corners.
//!
//! An ear is a corner whose triangle with the two corners after it turns as the polygon does and holds no other
//! corner. The search for ears starts at the first corner, so a convex polygon becomes a fan. A start that was refused is
//! tried again only when its triangle changed or the corner that stood in it is gone, and corners in a triangle are
//! found by descending a tree of boxes: many-sided polygons take time nearly proportional to their corners.

use std::collections::BTreeSet;

type Point = [f32; 2];

/// Corners of a polygon that are not cut off yet, as a ring.
struct Ring {
    next: Vec<usize>,
    previous: Vec<usize>,
    /// The first corner in the order of the polygon.
    head: usize,
    len: usize,
}

impl Ring {
    fn new(len: usize) -> Self {
        let next = (1..len).chain([0]).collect();
        let previous = [len - 1].into_iter().chain(0..len - 1).collect();
        Ring { next, previous, head: 0, len }
    }

    fn remove(&mut self, corner: usize) {
        let (before, after) = (self.previous[corner], self.next[corner]);
        self.next[before] = after;
        self.previous[after] = before;
        self.len -= 1;
        if self.head == corner {
            self.head = after;
        }
    }

    /// A corner and the two after it.
    fn triple(&self, start: usize) -> [usize; 3] {
        let second = self.next[start];
        [start, second, self.next[second]]
    }
}

/// Cuts the polygon of `points`, at least three, into triangles of its corners. What is left when no ear is
/// found, in a polygon that crosses itself, is dropped. So is what the first ear leaves of five corners and more when
/// its search was over with that ear, which begins at the last corner: the reference counts the tries before it looks
/// at their outcome.
pub(super) fn triangulate(points: &[Point], mut emit: impl FnMut([usize; 3])) {
    let mut ring = Ring::new(points.len());
    if ring.len > 3 {
        let area: f32 = (0..ring.len).map(|k| sector(points[k], points[ring.next[k]])).sum();
        clip_ears(points, area, &mut ring, &mut emit);
    }
    if ring.len == 3 {
        emit(ring.triple(ring.head));
    }
}

/// Emits ears until three corners or no ears are left; returns how many corners were tested against triangles.
fn clip_ears(points: &[Point], area: f32, ring: &mut Ring, emit: &mut impl FnMut([usize; 3])) -> usize {
    let mut standing = Standing::new(points);
    let mut untried: BTreeSet<usize> = (0..points.len()).collect();
    let mut refused_for: Vec<Vec<usize>> = vec![Vec::new(); points.len()];
    let mut from = 0;
    while ring.len > 3 {
        let Some(start) = untried.range(from..).next().or_else(|| untried.first()).copied() else { break };
        untried.remove(&start);
        from = start;
        let ear = ring.triple(start);
        let [a, b, c] = ear.map(|corner| points[corner]);
        if turn(a, b, c) * area < 0.0 {
            continue;
        }
        if let Some(other) = standing.find_inside(points, ear) {
            refused_for[other].push(start);
            continue;
        }
        emit(ear);
        let [_, cut, after] = ear;
        let found_by_the_last_try = ring.len == points.len() && start + 1 == points.len();
        // The search goes on at the same place in the list of corners, which is the next corner where the list
        // lost its first.
        from = if ring.head == cut { after } else { start };
        ring.remove(cut);
        if found_by_the_last_try {
            break;
        }
        standing.remove(cut);
        untried.remove(&cut);
        untried.extend([start, ring.previous[start]]);
        let ring_holds = |corner: &usize| ring.next[ring.previous[*corner]] == *corner;
        untried.extend(std::mem::take(&mut refused_for[cut]).into_iter().filter(ring_holds));
    }
    standing.tested
}

/// Signed area of the triangle of the origin and an edge, rounded as in the reference: of a tiny polygon far from the
/// origin the sign of the sum depends on it.
fn sector(a: Point, b: Point) -> f32 {
    (a[0] * b[1] - a[1] * b[0]) * 0.5
}

/// Twice the signed area of the triangle `a b c`.
fn turn(a: Point, b: Point, c: Point) -> f32 {
    (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
}

/// Whether a horizontal ray from the point crosses the triangle's outline an odd number of times.
fn inside(p: Point, triangle: [Point; 3]) -> bool {
    let mut odd = false;
    for k in 0..3 {
        let (a, b) = (triangle[k], triangle[(k + 2) % 3]);
        if (a[1] > p[1]) != (b[1] > p[1]) && p[0] < (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]) + a[0] {
            odd = !odd;
        }
    }
    odd
}

/// Corners of a leaf of the tree.
const LEAF: usize = 8;

/// The corners that are not cut off, in a complete binary tree of boxes; the children of box `k` are `2k + 1` and
/// `2k + 2`.
struct Standing {
    boxes: Vec<Bounds>,
    /// Corners that stand in each box.
    count: Vec<u32>,
    /// Corners sorted by leaf.
    corners: Vec<usize>,
    /// Box of the leaf of each corner, until it is cut off.
    leaf_of: Vec<Option<usize>>,
    leaves: usize,
    pending: Vec<usize>,
    /// Corners tested against triangles.
    tested: usize,
}

/// Extent of a set of points.
#[derive(Clone, Copy)]
struct Bounds {
    min: [f64; 2],
    max: [f64; 2],
}

impl Standing {
    fn new(points: &[Point]) -> Self {
        let leaves = points.len().div_ceil(LEAF).next_power_of_two();
        let mut tree = Standing {
            boxes: vec![Bounds::of(&[], points); 2 * leaves - 1],
            count: vec![0; 2 * leaves - 1],
            corners: (0..points.len()).collect(),
            leaf_of: vec![None; points.len()],
            leaves,
            pending: Vec::new(),
            tested: 0,
        };
        for node in 0..tree.boxes.len() {
            let range = tree.range(node);
            let middle = (node + 1 < leaves).then(|| tree.range(2 * node + 2).start - range.start);
            let corners = &mut tree.corners[range.clone()];
            let bounds = Bounds::of(corners, points);
            tree.boxes[node] = bounds;
            tree.count[node] = corners.len() as u32;
            match middle {
                None => corners.iter().for_each(|&corner| tree.leaf_of[corner] = Some(node)),
                Some(middle) if middle < corners.len() => {
                    let axis = usize::from(bounds.max[1] - bounds.min[1] > bounds.max[0] - bounds.min[0]);
                    corners
                        .select_nth_unstable_by(middle, |&i, &j| points[i][axis].total_cmp(&points[j][axis]));
                }
                Some(_) => {}
            }
        }
        tree
    }

    /// Places of the corners of a box in `corners`.
    fn range(&self, node: usize) -> std::ops::Range<usize> {
        let level = (node + 1).ilog2();
        let (first, width) = ((1 << level) - 1, self.leaves >> level);
        let place = |leaf: usize| leaf * self.corners.len() / self.leaves;
        place((node - first) * width)..place((node - first + 1) * width)
    }

    fn remove(&mut self, corner: usize) {
        let Some(mut node) = self.leaf_of[corner].take() else { return };
        self.count[node] -= 1;
        while node > 0 {
            node = (node - 1) / 2;
            self.count[node] -= 1;
        }
    }

    /// A standing corner inside the triangle of three others.
    fn find_inside(&mut self, points: &[Point], ear: [usize; 3]) -> Option<usize> {
        let corners = ear.map(|corner| points[corner]);
        let triangle = Triangle::new(corners);
        self.pending.clear();
        self.pending.push(0);
        while let Some(node) = self.pending.pop() {
            if self.count[node] == 0 || triangle.clear_of(&self.boxes[node]) {
                continue;
            }
            if node + 1 < self.leaves {
                self.pending.extend([2 * node + 1, 2 * node + 2]);
                continue;
            }
            for place in self.range(node) {
                let corner = self.corners[place];
                self.tested += 1;
                if self.leaf_of[corner].is_some() && !ear.contains(&corner) && inside(points[corner], corners)
                {
                    return Some(corner);
                }
            }
        }
        None
    }
}

impl Bounds {
    fn of(corners: &[usize], points: &[Point]) -> Self {
        let empty = Bounds { min: [f64::INFINITY; 2], max: [f64::NEG_INFINITY; 2] };
        corners.iter().fold(empty, |b, &corner| {
            let p = points[corner].map(f64::from);
            Bounds {
                min: std::array::from_fn(|k| b.min[k].min(p[k])),
                max: std::array::from_fn(|k| b.max[k].max(p[k])),
            }
        })
    }
}

/// A triangle with room for the rounding of `inside`: it takes a point for one inside only if the point is within
/// `slack` of the triangle in x, and not above or below it.
struct Triangle {
    corners: [[f64; 2]; 3],
    bounds: Bounds,
    slack: f64,
}

impl Triangle {
    fn new(corners: [Point; 3]) -> Self {
        let bounds = Bounds::of(&[0, 1, 2], &corners);
        let corners = corners.map(|p| p.map(f64::from));
        // A dozen roundings relative to the largest coordinate, and one in the subnormal numbers, which the
        // division by the height of an edge enlarges.
        let largest = bounds.min[0].abs().max(bounds.max[0].abs());
        let heights = (0..3).map(|k| (corners[k][1] - corners[(k + 1) % 3][1]).abs()).filter(|&h| h > 0.0);
        let least = heights.fold(f64::INFINITY, f64::min);
        let slack = largest / f64::from(1 << 19) + 1e-44 + 1e-44 / least;
        Triangle { corners, bounds, slack }
    }

    /// No point in the box is inside.
    fn clear_of(&self, b: &Bounds) -> bool {
        let t = &self.bounds;
        b.max[1] < t.min[1]
            || b.min[1] >= t.max[1]
            || b.max[0] < t.min[0] - self.slack
            || b.min[0] > t.max[0] + self.slack
            || (0..3).any(|k| self.beyond_edge(k, b))
    }

    /// The box lies on the outer side of the line through an edge; on either side of one without an inside.
    fn beyond_edge(&self, k: usize, b: &Bounds) -> bool {
        let [p, q, r] = [0, 1, 2].map(|j| self.corners[(k + j) % 3]);
        let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
        let side = |x: f64, y: f64| dx * (y - p[1]) - dy * (x - p[0]);
        let inner = side(r[0], r[1]);
        let [x0, y0, x1, y1] = [b.min[0], b.min[1], b.max[0], b.max[1]];
        let at = [side(x0, y0), side(x0, y1), side(x1, y0), side(x1, y1)];
        let reach = |c: f64, lo: f64, hi: f64| c.abs() + lo.abs().max(hi.abs());
        let rounding = 1e-14 * (dx.abs() * reach(p[1], y0, y1) + dy.abs() * reach(p[0], x0, x1));
        let slack = dy.abs() * self.slack + rounding;
        inner >= -rounding && at.iter().all(|&s| s < -slack)
            || inner <= rounding && at.iter().all(|&s| s > slack)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangles(points: &[Point]) -> Vec<[usize; 3]> {
        let mut found = Vec::new();
        triangulate(points, |triangle| found.push(triangle));
        found
    }

    /// The definition: every start in turn, every other corner tested; the end after an ear at the last of all.
    fn by_definition(points: &[Point]) -> Vec<[usize; 3]> {
        let mut rest: Vec<usize> = (0..points.len()).collect();
        let ends = rest.iter().map(|&k| [points[k], points[(k + 1) % points.len()]]);
        let area: f32 = ends.map(|[a, b]| 0.5 * turn([0.0; 2], a, b)).sum();
        let (mut found, mut start, mut failed) = (Vec::new(), 0, 0);
        while rest.len() > 3 && failed <= rest.len() {
            let n = rest.len();
            start %= n;
            let ear = [0, 1, 2].map(|k| rest[(start + k) % n]);
            let corners @ [a, b, c] = ear.map(|k| points[k]);
            if turn(a, b, c) * area < 0.0 || (3..n).any(|k| inside(points[rest[(start + k) % n]], corners)) {
                (start, failed) = (start + 1, failed + 1);
                continue;
            }
            found.push(ear);
            rest.remove((start + 1) % n);
            if failed + 1 == points.len() {
                break;
            }
            failed = 0;
        }
        if let [a, b, c] = rest[..] {
            found.push([a, b, c]);
        }
        found
    }

    /// A sequence of numbers in [0, 1) that depends on nothing.
    fn noise(state: &mut u64) -> f32 {
        *state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (*state >> 40) as f32 / (1 << 24) as f32
    }

    #[test]
    fn triangles_are_those_of_the_definition() {
        let state = &mut 1;
        let mut many = 0;
        for case in 0..4000 {
            let n = 4 + case % 60;
            let points: Vec<Point> = (0..n)
                .map(|k| {
                    let angle = std::f32::consts::TAU * k as f32 / n as f32;
                    let radius = 1.0 + noise(state);
                    match case % 5 {
                        // On a circle, stars, on a coarse grid with ties, at random, stars far from the origin.
                        0 => [angle.cos(), angle.sin()],
                        1 => [radius * angle.cos(), radius * angle.sin()],
                        2 => [(5.0 * noise(state)).floor(), (5.0 * noise(state)).floor()],
                        3 => [noise(state), noise(state)],
                        _ => [radius * angle.cos() + 1e5, 1e-3 * radius * angle.sin() - 1e5],
                    }
                })
                .collect();
            let found = triangles(&points);
            assert_eq!(found, by_definition(&points), "case {case}: {points:?}");
            many += usize::from(found.len() == n - 2);
        }
        assert!(many > 2000, "{many} of 4000 polygons were cut up completely");
    }

    #[test]
    fn work_grows_with_the_corners_not_their_square() {
        let shapes: [fn(f32, usize) -> Point; 3] = [
            |angle, _| [angle.cos(), angle.sin()],
            |angle, k| [(1 + k % 2) as f32 * angle.cos(), (1 + k % 2) as f32 * angle.sin()],
            |angle, k| [angle, (k % 2) as f32 + angle * (7.0 - angle)],
        ];
        for (shape, point) in shapes.into_iter().enumerate() {
            let n = 20_000;
            let points: Vec<Point> =
                (0..n).map(|k| point(std::f32::consts::TAU * k as f32 / n as f32, k)).collect();
            let (mut ring, mut cut) = (Ring::new(n), 0);
            let tested = clip_ears(&points, 1.0, &mut ring, &mut |_| cut += 1);
            assert!(cut > n / 2, "shape {shape}: {cut} ears");
            assert!(tested < 200 * n, "shape {shape}: {tested} corners tested");
        }
    }
}
