//! Time derivative of the Jacobians of two points times the velocity: the accelerations that points have by moving alone.

use crate::flex::difference::BodyPoint;
use crate::math::{Vec3, add, rotational, scale};
use crate::model::Model;
use crate::position::chain::{MergedChain, com_offset};
use crate::position::jacobian::{axis_rate, point_column_rate};
use crate::stages::{Configuration, Velocity};

/// Acceleration of a point and angular acceleration of its body.
pub(super) struct PointRate {
    pub translation: Vec3,
    pub rotation: Vec3,
}

/// The rates of two points. Terms are added up as MuJoCo adds them: in four lanes, by degree of freedom where it stores full
/// rows, else by position among those that move either body.
pub(super) fn jacobian_rates(
    m: &Model,
    at: &Configuration,
    vel: &Velocity,
    points: [BodyPoint; 2],
    movers: &mut Vec<(usize, [bool; 2])>,
) -> [PointRate; 2] {
    let (com, qvel, sparse) = (at.com, &at.state.qvel, m.is_sparse());
    movers.clear();
    movers.extend(MergedChain::new(m, points[0].body, points[1].body));
    let terms = if sparse { movers.len() } else { m.nv };
    [0, 1].map(|side| {
        let BodyPoint { body, point } = points[side];
        let offset = com_offset(m, com, body, point);
        let (mut translation, mut rotation) = (Sum::of(terms), Sum::of(terms));
        let ascending = movers.iter().rev().enumerate();
        for (position, &(dof, _)) in ascending.filter(|(_, (_, moves))| moves[side]) {
            let place = if sparse { position } else { dof };
            let column = point_column_rate(m, com, vel, body, dof, offset);
            translation.add(place, scale(column, qvel[dof]));
            rotation.add(place, scale(rotational(&axis_rate(m, com, vel, dof)), qvel[dof]));
        }
        PointRate { translation: translation.total(sparse), rotation: rotation.total(sparse) }
    })
}

/// A sum of vectors in four lanes, with up to three that fill no lanes at its end.
struct Sum {
    whole: usize,
    lanes: [Vec3; 4],
    rest: [Vec3; 3],
}

impl Sum {
    fn of(terms: usize) -> Self {
        Sum { whole: terms & !3, lanes: [[0.0; 3]; 4], rest: [[0.0; 3]; 3] }
    }

    fn add(&mut self, place: usize, term: Vec3) {
        let slot = match place.checked_sub(self.whole) {
            Some(left) => &mut self.rest[left],
            None => &mut self.lanes[place & 3],
        };
        *slot = add(*slot, term);
    }

    /// The remainder that fills no lanes is added one by one for compressed rows, and in one sum for full rows.
    fn total(&self, sparse: bool) -> Vec3 {
        let [a, b, c, d] = self.lanes;
        let lanes = add(add(a, c), add(b, d));
        let [x, y, z] = self.rest;
        if sparse { add(add(add(lanes, x), y), z) } else { add(lanes, add(add(x, y), z)) }
    }
}
