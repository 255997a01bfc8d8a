//! Contacts of a triangle with radius: against a ball, a capsule, a box.

use crate::collision::{PreContact, Shape};
use crate::math::{Vec3, add, add_scaled, cross, dot, mul_mat_t_vec, mul_mat_vec, normalize, scale, sub};
use crate::model::bounds::MINVAL;

/// A triangle and the radius around it.
#[derive(Clone, Copy)]
pub(super) struct Triangle {
    pub corners: [Vec3; 3],
    pub radius: f64,
}

/// Sign of the area of a triangle in the plane.
fn turn([p, q, r]: [[f64; 2]; 3]) -> i32 {
    let area = (p[0] - r[0]) * (q[1] - r[1]) - (q[0] - r[0]) * (p[1] - r[1]);
    i32::from(area > 0.0) - i32::from(area < 0.0)
}

/// Point of a segment in the plane nearest to `p`, and its distance.
fn on_segment(p: [f64; 2], [u, v]: [[f64; 2]; 2]) -> ([f64; 2], f64) {
    let (along, to) = ([v[0] - u[0], v[1] - u[1]], [p[0] - u[0], p[1] - u[1]]);
    let inner = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let length2 = inner(along, along);
    let share = inner(along, to) / if length2 > MINVAL { length2 } else { MINVAL };
    let point = if share <= 0.0 {
        u
    } else if share >= 1.0 {
        v
    } else {
        [u[0] + along[0] * share, u[1] + along[1] * share]
    };
    let gap = [point[0] - p[0], point[1] - p[1]];
    (point, inner(gap, gap).sqrt())
}

impl Triangle {
    /// A ball: the nearest point of the triangle decides.
    pub fn ball(&self, centre: Vec3, radius: f64, margin: f64) -> Option<PreContact> {
        let reach = margin + radius + self.radius;
        let [origin, second, third] = self.corners;
        let [to, a, b] = [centre, second, third].map(|p| sub(p, origin));
        let (normal, _) = normalize(cross(a, b));
        let height = dot(normal, to);
        if height.abs() > reach {
            return None;
        }
        let nearest = nearest_point([a, b], normal, add_scaled(to, normal, -height));
        let (direction, gap) = normalize(sub(nearest, to));
        if gap > reach {
            return None;
        }
        let dist = gap - radius - self.radius;
        let pos = add_scaled(centre, direction, radius + dist / 2.0);
        Some(PreContact { dist, pos, normal: direction, tangent: [0.0; 3] })
    }

    /// A capsule: its ends against the triangle, then the corners against its segment.
    pub fn capsule(&self, capsule: &Shape, margin: f64, out: &mut Vec<PreContact>) {
        let [radius, half, _] = capsule.size;
        let ends = [-half, half].map(|x| add_scaled(capsule.pos, capsule.axis(), x));
        for end in ends {
            out.extend(self.ball(end, radius, margin));
        }
        let along = sub(ends[1], ends[0]);
        for corner in self.corners {
            let share = dot(sub(corner, ends[0]), along) / (4.0 * half * half);
            if share <= MINVAL || share >= 1.0 - MINVAL {
                continue;
            }
            let nearest = add_scaled(ends[0], along, share);
            let (normal, gap) = normalize(sub(corner, nearest));
            if gap > radius + self.radius + margin {
                continue;
            }
            let sum = add_scaled(add(nearest, corner), normal, radius - self.radius);
            let dist = gap - radius - self.radius;
            out.push(PreContact { dist, pos: scale(sum, 0.5), normal, tangent: [0.0; 3] });
        }
    }

    /// A box: the triangle's corners against its faces, then its corners against the triangle.
    pub fn cuboid(&self, cuboid: &Shape, margin: f64, out: &mut Vec<PreContact>) {
        for corner in self.corners {
            out.extend(self.corner_in_box(corner, cuboid, margin));
        }
        for i in 0..8 {
            let side = |k: usize| if i & (1 << k) != 0 { cuboid.size[k] } else { -cuboid.size[k] };
            let corner = add(mul_mat_vec(&cuboid.mat, [side(0), side(1), side(2)]), cuboid.pos);
            out.extend(self.ball(corner, 0.0, margin));
        }
    }

    fn corner_in_box(&self, corner: Vec3, cuboid: &Shape, margin: f64) -> Option<PreContact> {
        let local = mul_mat_t_vec(&cuboid.mat, sub(corner, cuboid.pos));
        let beyond: Vec3 = std::array::from_fn(|k| local[k].abs() - cuboid.size[k]);
        let axis = (1..3).fold(0, |best, k| if beyond[k] > beyond[best] { k } else { best });
        let dist = beyond[axis] - self.radius;
        let outside = |k: usize| local[k].abs() > cuboid.size[k] + margin + self.radius;
        if dist > margin || (0..3).any(outside) {
            return None;
        }
        let mut out = [0.0; 3];
        out[axis] = if local[axis] > 0.0 { 1.0 } else { -1.0 };
        let normal = mul_mat_vec(&cuboid.mat, out);
        let pos = add_scaled(corner, normal, -(self.radius + dist * 0.5));
        Some(PreContact { dist, pos, normal, tangent: [0.0; 3] })
    }
}

/// Point of the triangle (origin, a, b) nearest to `p` in its plane.
fn nearest_point([a, b]: [Vec3; 2], normal: Vec3, p: Vec3) -> Vec3 {
    let (x, length) = normalize(a);
    let (y, _) = normalize(cross(normal, a));
    let flat = |v: Vec3| [dot(x, v), dot(y, v)];
    let corners = [[0.0, 0.0], [length, 0.0], flat(b)];
    let q = flat(p);
    let edges = [0, 1, 2].map(|k| [corners[k], corners[(k + 1) % 3]]);
    let turns = edges.map(|[u, v]| turn([q, u, v]));
    if turns[0] == turns[1] && turns[1] == turns[2] {
        return p;
    }
    let [first, second, third] = edges.map(|edge| on_segment(q, edge));
    let (at, _) = if first.1 < second.1 && first.1 < third.1 {
        first
    } else if second.1 < third.1 {
        second
    } else {
        third
    };
    add_scaled(scale(x, at[0]), y, at[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::distance;

    const FLAT: Triangle = Triangle { corners: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], radius: 0.01 };

    /// Distance of a point from the triangle, from a fine grid of its points.
    fn sampled(p: Vec3) -> f64 {
        let steps = 400;
        let point = |i: usize, j: usize| [i as f64 / steps as f64, j as f64 / steps as f64, 0.0];
        (0..=steps)
            .flat_map(|i| (0..=steps - i).map(move |j| distance(p, point(i, j))))
            .fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_ball_touches_the_nearest_point_of_a_triangle() {
        for centre in
            [[0.2, 0.3, 0.1], [-0.1, 0.5, 0.05], [0.7, 0.8, -0.1], [1.2, -0.1, 0.0], [-0.2, -0.2, 0.3]]
        {
            let found = FLAT.ball(centre, 0.1, 1.0).unwrap();
            assert!((found.dist - (sampled(centre) - 0.11)).abs() < 1e-3, "{centre:?} {found:?}");
            // The point is halfway between the surfaces, along the normal from the ball.
            let between = add_scaled(centre, found.normal, 0.1 + 0.5 * found.dist);
            assert!(distance(between, found.pos) < 1e-15);
        }
        assert_eq!(FLAT.ball([0.2, 0.2, 0.5], 0.1, 0.0), None);
    }
}
