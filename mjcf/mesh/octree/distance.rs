//! Signed distance from a mesh: the nearest triangle by its hierarchy of boxes, the sign from its side.

use crate::vector::{cross, dot, normalize, sub};
use physics::geometry::hierarchy::Bvh;

/// A mesh with the hierarchy of its triangles.
pub(super) struct Surface<'a> {
    pub triangles: &'a [[[f64; 3]; 3]],
    pub hierarchy: &'a Bvh,
}

/// The nearest point so far.
struct Nearest {
    squared: f64,
    triangle: Option<usize>,
    /// Coordinates along the two edges from the first corner.
    at: [f64; 2],
}

impl Surface<'_> {
    /// Distance of `p`, negative behind the triangle nearest to it.
    pub fn distance(&self, p: [f64; 3]) -> f64 {
        let mut nearest = Nearest { squared: 1e20, triangle: None, at: [0.0; 2] };
        self.descend(0, p, &mut nearest);
        let distance = nearest.squared.sqrt();
        let Some(triangle) = nearest.triangle else { return distance };
        let [a, b, c] = self.triangles[triangle];
        let (u, v) = (sub(b, a), sub(c, a));
        let mut normal = cross(u, v);
        let closest: [f64; 3] = std::array::from_fn(|k| a[k] + nearest.at[0] * u[k] + nearest.at[1] * v[k]);
        let outward = dot(sub(p, closest), normal);
        let length = normalize(&mut normal);
        if outward > 1e-12 * length * distance { distance } else { -distance }
    }

    fn descend(&self, node: usize, p: [f64; 3], nearest: &mut Nearest) {
        let bvh = self.hierarchy;
        // At or beyond the nearest, and nothing else: a distance that is no number goes on.
        if squared_distance_to_box(p, &bvh.aabb[node]) >= nearest.squared {
            return;
        }
        let [left, right] = bvh.child[node];
        if (left, right) == (-1, -1) {
            let Ok(triangle) = usize::try_from(bvh.nodeid[node]) else { return };
            let (squared, at) = nearest_in_triangle(p, &self.triangles[triangle]);
            if squared < nearest.squared {
                *nearest = Nearest { squared, triangle: Some(triangle), at };
            }
            return;
        }
        for child in [left, right] {
            if let Ok(child) = usize::try_from(child) {
                self.descend(child, p, nearest);
            }
        }
    }
}

fn squared_distance_to_box(p: [f64; 3], aabb: &[f64; 6]) -> f64 {
    let mut sum = 0.0;
    for k in 0..3 {
        let (low, high) = (aabb[k] - aabb[k + 3], aabb[k] + aabb[k + 3]);
        let outside = if p[k] < low {
            low - p[k]
        } else if p[k] > high {
            p[k] - high
        } else {
            continue;
        };
        sum += outside * outside;
    }
    sum
}

/// Squared distance of the nearest point of a triangle, and its coordinates along the edges from the first corner
/// (Ericson 2005, section 5.1.5).
fn nearest_in_triangle(p: [f64; 3], [a, b, c]: &[[f64; 3]; 3]) -> (f64, [f64; 2]) {
    let (ab, ac) = (sub(*b, *a), sub(*c, *a));
    let squared = |from: [f64; 3]| {
        let d = sub(p, from);
        dot(d, d)
    };
    let along =
        |from: &[f64; 3], edge: [f64; 3], t: f64| squared(std::array::from_fn(|k| from[k] + t * edge[k]));
    let ap = sub(p, *a);
    let (d1, d2) = (dot(ab, ap), dot(ac, ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (squared(*a), [0.0, 0.0]);
    }
    let bp = sub(p, *b);
    let (d3, d4) = (dot(ab, bp), dot(ac, bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (squared(*b), [1.0, 0.0]);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let u = d1 / (d1 - d3);
        return (along(a, ab, u), [u, 0.0]);
    }
    let cp = sub(p, *c);
    let (d5, d6) = (dot(ab, cp), dot(ac, cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (squared(*c), [0.0, 1.0]);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let v = d2 / (d2 - d6);
        return (along(a, ac, v), [0.0, v]);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (along(b, sub(*c, *b), w), [1.0 - w, w]);
    }
    let scale = 1.0 / (va + vb + vc);
    let (u, v) = (vb * scale, vc * scale);
    (squared(std::array::from_fn(|k| a[k] + u * ab[k] + v * ac[k])), [u, v])
}
