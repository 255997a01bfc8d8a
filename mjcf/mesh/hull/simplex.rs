//! Extents of the point set, the round-off bounds that follow from them, and the first simplex.

use super::Failure;
use super::polytope::{NONE, Polytope};

/// Initial simplices flatter than this (cosine of a dihedral angle) make a narrow hull.
const NARROW_COSINE: f64 = -0.99999999;
/// A simplex whose volume is less than this share of the possible one is searched among all points.
const FLAT_RATIO: f64 = 1.0e-3;

/// Bounds on the error of a distance and the widths derived from it, in input units.
#[derive(Debug, Clone, Default)]
pub(super) struct Tolerances {
    /// Largest extent of the points along an axis.
    pub width: f64,
    /// Error of a point-plane distance.
    pub round: f64,
    /// A facet whose centre is no deeper below a neighbour than this is not convex to it.
    pub center: f64,
    /// A facet is visible to a point this far above it.
    pub visible: f64,
    /// A point is outside this far above a facet.
    pub outside: f64,
    /// Points less than this below a facet are remembered.
    pub near_inside: f64,
    /// Distance a single merge may cause.
    pub one_merge: f64,
    /// Facets merged over more than this keep their centre.
    pub wide: f64,
    /// Pivots smaller than this, per column, are zero.
    pub near_zero: [f64; 3],
}

/// Tolerances, and the points of smallest and largest x, y and z.
fn extents(points: &[[f64; 3]]) -> (Tolerances, [usize; 6]) {
    let mut tol = Tolerances { width: f64::MIN, ..Tolerances::default() };
    let mut extreme = [0; 6];
    let (mut max_abs, mut sum_abs) = (0.0f64, 0.0);
    for axis in 0..3 {
        let (mut least, mut most) = (0, 0);
        for (k, p) in points.iter().enumerate() {
            if points[most][axis] < p[axis] {
                most = k;
            } else if points[least][axis] > p[axis] {
                least = k;
            }
        }
        let (lo, hi) = (points[least][axis], points[most][axis]);
        let reach = hi.max(-lo);
        tol.width = tol.width.max(hi - lo);
        max_abs = max_abs.max(reach);
        sum_abs += reach;
        tol.near_zero[axis] = 80.0 * sum_abs * f64::EPSILON;
        extreme[2 * axis] = least;
        extreme[2 * axis + 1] = most;
    }
    let norm = f64::min(3.0f64.sqrt() * max_abs, sum_abs);
    tol.round = f64::EPSILON * (3.0 * norm * 1.01 + max_abs);
    tol.center = 2.0 * tol.round;
    tol.one_merge = 3.0 * tol.center + tol.round;
    tol.near_inside = tol.one_merge * 5.0;
    tol.visible = tol.center;
    tol.outside = 2.0 * tol.visible;
    tol.wide = tol.outside.max(6.0 * tol.visible);
    (tol, extreme)
}

/// Determinant of the first two coordinates of `a`, `b` relative to `apex`.
fn area(apex: [f64; 3], a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - apex[0]) * (b[1] - apex[1]) - (a[1] - apex[1]) * (b[0] - apex[0])
}

/// Determinant of `a`, `b`, `c` relative to `apex`.
fn volume(apex: [f64; 3], a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|v| [v[0] - apex[0], v[1] - apex[1], v[2] - apex[2]]);
    let minor = |p: [f64; 3], q: [f64; 3]| p[1] * q[2] - p[2] * q[1];
    a[0] * minor(b, c) - b[0] * minor(a, c) + c[0] * minor(a, b)
}

/// Four points that span a large volume: the extremes in x, then the best of the other extremes.
fn initial_points(
    points: &[[f64; 3]],
    extreme: &[usize; 6],
    tol: &Tolerances,
) -> Result<[usize; 4], Failure> {
    let (mut least, mut most) = (extreme[0], extreme[0]);
    for &p in extreme {
        if points[p][0] > points[most][0] {
            most = p;
        }
        if points[p][0] < points[least][0] {
            least = p;
        }
    }
    if least == most {
        return Err(Failure("all points have the same x"));
    }
    let mut simplex = vec![least, most];
    let mut best = points[most][0] - points[least][0];
    while simplex.len() < 4 {
        let previous = best;
        let zero = 10.0 * tol.near_zero[simplex.len() - 1];
        let size = |p: usize| {
            let at = |k: usize| points[simplex[k]];
            let det = match simplex.len() {
                2 => area(points[p], at(0), at(1)),
                _ => volume(points[p], at(0), at(1), at(2)),
            };
            det.abs()
        };
        best = -1.0;
        let (mut chosen, mut tiny) = (NONE, false);
        for &p in extreme {
            if simplex.contains(&p) || p == chosen {
                continue;
            }
            let det = size(p);
            if det > best {
                (best, chosen, tiny) = (det, p, det < zero);
            }
        }
        let possible = previous * tol.width;
        if chosen == NONE || tiny || (best > 0.0 && best / possible < FLAT_RATIO) {
            for p in 0..points.len() {
                if extreme.contains(&p) || simplex.contains(&p) {
                    continue;
                }
                let det = size(p);
                if det > best {
                    (best, chosen, tiny) = (det, p, det < zero);
                    if !tiny && best > 10.0 * FLAT_RATIO * possible {
                        break;
                    }
                }
            }
        }
        if chosen == NONE {
            return Err(Failure("too few points"));
        }
        simplex.push(chosen);
    }
    Ok([simplex[0], simplex[1], simplex[2], simplex[3]])
}

impl<'a> Polytope<'a> {
    /// The first tetrahedron.
    pub(super) fn simplex(points: &'a [[f64; 3]]) -> Result<Self, Failure> {
        let (tol, extreme) = extents(points);
        let corners = initial_points(points, &extreme, &tol)?;
        let mut hull = Self::empty(points, tol);
        let mut vertices: Vec<usize> = corners.iter().map(|&p| hull.new_vertex(p)).collect();
        vertices.reverse();
        vertices.iter().for_each(|&v| hull.append_vertex(v));
        let [a, b, c, d] = [vertices[0], vertices[1], vertices[2], vertices[3]];
        let facets = [[b, c, d], [a, c, d], [a, b, d], [a, b, c]];
        let mut top_oriented = false;
        let facets = facets.map(|corners| {
            top_oriented = !top_oriented;
            hull.new_facet(corners, top_oriented, NONE)
        });
        for &f in &facets {
            hull.facets[f].neighbors = facets.iter().copied().filter(|&n| n != f).collect();
        }
        hull.settle();
        hull.next_facet = hull.first_facet;
        for axis in 0..3 {
            let mut sum = 0.0;
            for &v in &vertices {
                sum += hull.point(v)[axis];
            }
            hull.interior[axis] = sum / 4.0;
        }
        hull.orient_simplex(&facets)?;
        Ok(hull)
    }

    /// Planes of the first facets, all facing away from the interior.
    fn orient_simplex(&mut self, facets: &[usize]) -> Result<(), Failure> {
        let interior = self.interior;
        self.set_plane(facets[0]);
        self.facets[facets[0]].flipped = false;
        if self.distance(interior, facets[0]) > self.tol.round {
            for &f in facets {
                self.facets[f].top_oriented ^= true;
            }
            self.set_plane(facets[0]);
        }
        for &f in &facets[1..] {
            self.set_plane(f);
        }
        for &f in facets {
            self.facets[f].flipped = false;
            if self.distance(interior, f) > self.tol.round {
                for &g in facets {
                    self.facets[g].flipped = false;
                    self.facets[g].top_oriented ^= true;
                    self.orient_outward(g);
                }
                break;
            }
        }
        let mut least = f64::MAX;
        for &f in facets {
            if self.distance(interior, f) >= -self.tol.round {
                return Err(Failure("the initial simplex is flat"));
            }
            for &g in facets.iter().filter(|&&g| g != f) {
                least = least.min(self.cosine(f, g));
            }
        }
        self.narrow = least < NARROW_COSINE;
        Ok(())
    }
}
