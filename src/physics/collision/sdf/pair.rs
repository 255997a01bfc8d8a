//! A field and another shape: descent from points spread over the common part of their boxes.
//!
//! Let `a` and `b` be the distances of the two shapes. The shapes meet where `max(a, b) ≤ 0`, so a point of contact is found by
//! making that small. Its slope belongs to one of the shapes alone, and steps along it jump between the two surfaces. Therefore
//! the walk first descends on `a + b + |max(a, b)|`, whose slope has a part of both shapes: outside of one of them this is
//! `a + b + max(a, b)`, inside both it is `min(a, b)`. One step on `max(a, b)` follows.
//!
//! A step goes along the steepest descent `-g`. The first of the lengths 1, 1/2, 1/4 … is taken at which the height `f` has
//! fallen by a fixed part of what its slope promises, `f(x - t g) ≤ f(x) - c t g·g` (Armijo, Minimization of Functions Having
//! Lipschitz Continuous First Partial Derivatives, 1966; Nocedal and Wright, Numerical Optimization, algorithm 3.1).

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

/// A point and its distances from both shapes.
#[derive(Clone, Copy)]
struct Place {
    /// The point in the frame of each shape.
    point: [Vec3; 2],
    distance: [f64; 2],
}

/// What a walk makes small.
#[derive(Clone, Copy)]
enum Goal {
    /// `a + b + |max(a, b)|`: least where both shapes are deep.
    Collision,
    /// `max(a, b)`: negative where the shapes overlap.
    Intersection,
}

impl Goal {
    fn height(self, place: &Place) -> f64 {
        let [a, b] = place.distance;
        let outer = larger(a, b);
        match self {
            Goal::Collision => a + b + outer.abs(),
            Goal::Intersection => outer,
        }
    }
}

impl Both<'_> {
    fn place(&self, x: Vec3) -> Place {
        let y = self.across.point(x);
        Place { point: [x, y], distance: [self.first.at(x), self.second.at(y)] }
    }

    /// The gradient of one shape's distance, in the frame of the first.
    fn gradient_of(&self, shape: usize, place: &Place) -> Vec3 {
        match shape {
            0 => self.first.gradient(place.point[0]),
            _ => mul_mat_t_vec(&self.across.turn, self.second.gradient(place.point[1])),
        }
    }

    fn gradient(&self, goal: Goal, place: &Place) -> Vec3 {
        let [a, b] = place.distance;
        let outer = if a > b { 0 } else { 1 };
        match goal {
            Goal::Intersection => self.gradient_of(outer, place),
            Goal::Collision => {
                let each = [0, 1].map(|shape| self.gradient_of(shape, place));
                let both: Vec3 = std::array::from_fn(|k| each[0][k] + each[1][k]);
                add_scaled(both, each[outer], if larger(a, b) > 0.0 { 1.0 } else { -1.0 })
            }
        }
    }

    /// Normal of the surface of equal distances.
    fn midsurface_normal(&self, place: &Place) -> Vec3 {
        let [first, second] = [0, 1].map(|shape| normalize(self.gradient_of(shape, place)).0);
        normalize(sub(first, second)).0
    }

    /// Goes downhill, in `steps` steps at most. One that leads up is the last: no length of it led down far enough.
    fn descend(&self, goal: Goal, start: Place, steps: i32) -> Place {
        let mut here = start;
        for _ in 0..steps {
            let Some(next) = self.step(goal, &here) else { break };
            let rises = goal.height(&here) < goal.height(&next);
            here = next;
            if rises {
                break;
            }
        }
        here
    }

    /// One step of the walk; `None` where the gradient is no number or beyond bounds.
    fn step(&self, goal: Goal, here: &Place) -> Option<Place> {
        /// The part `c` of the promised fall that is enough.
        const SHARE: f64 = 0.1;
        /// A length below this is taken whatever it leads to.
        const SHORTEST: f64 = 1e-4;
        let gradient = self.gradient(goal, here);
        if !gradient.iter().all(|g| g.abs() <= MAXVAL) {
            return None;
        }
        let (height, steepness) = (goal.height(here), dot(gradient, gradient));
        let lengths = std::iter::successors(Some(1.0), |t| (*t > SHORTEST).then_some(0.5 * t));
        let mut end = None;
        for t in lengths {
            let there = self.place(add_scaled(here.point[0], gradient, -t));
            // A height that is not a number is not too high: the search ends there.
            let too_high = goal.height(&there) - height > -SHARE * t * steepness;
            end = Some(there);
            if !too_high {
                break;
            }
        }
        end
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
        let start = both.place(back.point(own.point(start)));
        let deep = both.descend(Goal::Collision, start, m.opt.sdf_iterations);
        let Some(end) = both.step(Goal::Intersection, &deep) else { continue };
        // Fields that are no true distances can lead outside of both: then the depth is positive, and nothing is added.
        points.add(end.point[0], Goal::Intersection.height(&end), || both.midsurface_normal(&end));
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
