//! A field and another shape: descent from points spread over the common part of their boxes.

use super::distance::Distance;
use super::order::{larger, smaller};
use super::{Points, Transfer, halton};
use crate::collision::scratch::ConvexScratch;
use crate::collision::shape::PreContact;
use crate::math::{Vec3, add_scaled, dot, mat_to_quat, mul_mat_t_vec, normalize, sub};
use crate::model::Model;
use crate::model::bounds::MAXVAL;
use crate::stages::Kinematics;

/// Two distances seen from the frame of the first.
struct Both<'a> {
    first: Distance<'a>,
    second: Distance<'a>,
    /// From the frame of the first to that of the second.
    across: Transfer,
}

/// What descent makes small.
#[derive(Clone, Copy)]
enum Goal {
    /// Sum of the distances and of the larger one's size: least where both shapes are deep.
    Collision,
    /// The larger distance.
    Intersection,
}

impl Both<'_> {
    fn distances(&self, x: Vec3) -> [f64; 2] {
        [self.first.at(x), self.second.at(self.across.point(x))]
    }

    fn second_gradient(&self, x: Vec3) -> Vec3 {
        mul_mat_t_vec(&self.across.turn, self.second.gradient(self.across.point(x)))
    }

    fn value(&self, goal: Goal, x: Vec3) -> f64 {
        let [a, b] = self.distances(x);
        match goal {
            Goal::Collision => a + b + larger(a, b).abs(),
            Goal::Intersection => larger(a, b),
        }
    }

    fn gradient(&self, goal: Goal, x: Vec3) -> Vec3 {
        let [a, b] = self.distances(x);
        match goal {
            Goal::Collision => {
                let slopes = [self.first.gradient(x), self.second_gradient(x)];
                let sum: Vec3 = std::array::from_fn(|k| slopes[0][k] + slopes[1][k]);
                let sign = if larger(a, b) > 0.0 { 1.0 } else { -1.0 };
                add_scaled(sum, slopes[if a > b { 0 } else { 1 }], sign)
            }
            Goal::Intersection if a > b => self.first.gradient(x),
            Goal::Intersection => self.second_gradient(x),
        }
    }

    /// Normal of the surface of equal distances.
    fn midsurface_normal(&self, x: Vec3) -> Vec3 {
        let (first, second) = (normalize(self.first.gradient(x)).0, normalize(self.second_gradient(x)).0);
        normalize(sub(first, second)).0
    }

    /// Goes downhill from `x` for a number of steps, and returns the value where it ends (Nocedal and Wright, algorithm
    /// 3.1).
    fn descend(&self, goal: Goal, x: &mut Vec3, steps: i32) -> f64 {
        const DECREASE: f64 = 0.1;
        const SHORTER: f64 = 0.5;
        const SHORTEST: f64 = 1e-4;
        let mut value = MAXVAL;
        for _ in 0..steps {
            let gradient = self.gradient(goal, *x);
            if gradient.iter().any(|g| g.is_nan() || g.abs() > MAXVAL) {
                return MAXVAL;
            }
            let start = *x;
            let before = self.value(goal, start);
            let mut length = 2.0;
            let mut wanted = -DECREASE * length * dot(gradient, gradient);
            loop {
                length *= SHORTER;
                wanted *= SHORTER;
                *x = add_scaled(start, gradient, -length);
                value = self.value(goal, *x);
                // Comparisons with what is not a number end the search.
                let goes_on = length > SHORTEST && value - before > wanted;
                if !goes_on {
                    break;
                }
            }
            if before < value {
                return value;
            }
        }
        value
    }
}

/// Contacts of a shape and a field, the second geom.
pub(crate) fn two_fields(
    m: &Model,
    kin: &Kinematics,
    g1: usize,
    g2: usize,
    _margin: f64,
    scratch: &mut ConvexScratch,
    out: &mut Vec<PreContact>,
) {
    let (Some(first), Some(second)) = (Distance::of(m, g2), Distance::of(m, g1)) else { return };
    let [pose1, pose2] = [g1, g2].map(|g| (kin.geom_xpos[g], mat_to_quat(&kin.geom_xmat[g])));
    let across = Transfer::new(pose2, pose1);
    let Some((low, high)) = common_box(&m.geom_aabb[g1], &m.geom_aabb[g2], &across) else { return };
    let (own, back) = (Transfer::new(pose1, pose1), Transfer::new(pose1, pose2));
    let both = Both { first, second, across };
    let mut points = Points::new(pose2, &mut scratch.field.known, out);
    for i in 0..m.opt.sdf_initpoints.max(0) as usize {
        let spread = [halton(i, 2), halton(i, 3), halton(i, 5)];
        let start: Vec3 = std::array::from_fn(|k| low[k] + (high[k] - low[k]) * spread[k]);
        let mut x = back.point(own.point(start));
        both.descend(Goal::Collision, &mut x, m.opt.sdf_iterations);
        // Fields that are no true distances can end outside of both.
        let depth = both.descend(Goal::Intersection, &mut x, 1);
        points.add(x, depth, || both.midsurface_normal(x));
    }
}

/// The common part of two boxes in the frame of the first; `to_first` leads there from the second.
fn common_box(first: &[f64; 6], second: &[f64; 6], to_first: &Transfer) -> Option<(Vec3, Vec3)> {
    let corner = |aabb: &[f64; 6], i: usize| -> Vec3 {
        std::array::from_fn(|k| if i >> k & 1 == 1 { aabb[k] + aabb[k + 3] } else { aabb[k] - aabb[k + 3] })
    };
    let bounds = |place: &dyn Fn(usize) -> Vec3| {
        let (mut low, mut high) = ([MAXVAL; 3], [-MAXVAL; 3]);
        for corner in (0..8).map(place) {
            for k in 0..3 {
                low[k] = smaller(low[k], corner[k]);
                high[k] = larger(high[k], corner[k]);
            }
        }
        (low, high)
    };
    let (low1, high1) = bounds(&|i| corner(first, i));
    let (low2, high2) = bounds(&|i| to_first.point(corner(second, i)));
    let low: Vec3 = std::array::from_fn(|k| larger(low1[k], low2[k]));
    let high: Vec3 = std::array::from_fn(|k| smaller(high1[k], high2[k]));
    (0..3).all(|k| high[k] >= low[k]).then_some((low, high))
}
