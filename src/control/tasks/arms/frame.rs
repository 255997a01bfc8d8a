//! Frames in the world: of tools, of things, and of one in the other.

use physics::Data;
use physics::elements::{BodyId, SiteId};
use physics::math::{Quat, Vec3, add, mat_to_quat, quat_conj, quat_mul, quat_rotate, scale, sub};

/// Where something is and how it is turned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Position \[m\].
    pub place: Vec3,
    /// Orientation.
    pub turn: Quat,
}

impl Frame {
    /// A site's.
    pub fn of_site(data: &Data, site: SiteId) -> Self {
        Frame {
            place: data.kin.site_xpos[site.index()],
            turn: mat_to_quat(&data.kin.site_xmat[site.index()]),
        }
    }

    /// A body's.
    pub fn of_body(data: &Data, body: BodyId) -> Self {
        Frame { place: data.kin.xpos[body.index()], turn: data.kin.xquat[body.index()] }
    }

    /// The frame that is `inner` in this one.
    pub fn with(&self, inner: &Frame) -> Self {
        Frame { place: self.point(inner.place), turn: quat_mul(self.turn, inner.turn) }
    }

    /// A point of this frame in the world.
    pub fn point(&self, place: Vec3) -> Vec3 {
        add(self.place, quat_rotate(self.turn, place))
    }

    /// This frame in `outer`.
    pub fn within(&self, outer: &Frame) -> Self {
        let back = quat_conj(outer.turn);
        Frame { place: quat_rotate(back, sub(self.place, outer.place)), turn: quat_mul(back, self.turn) }
    }

    /// The same, moved along a direction of the world.
    pub fn moved(&self, way: Vec3) -> Self {
        Frame { place: add(self.place, way), turn: self.turn }
    }

    /// The frame that a share of the way, on a straight line and by one turn, leads to `end`.
    pub fn towards(&self, end: &Frame, share: f64) -> Self {
        let way = sub(end.place, self.place);
        let turn = physics::math::quat_difference(end.turn, self.turn);
        Frame {
            place: add(self.place, scale(way, share)),
            turn: physics::math::quat_integrate(self.turn, turn, share),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::math::{distance, quat_from_axis_angle};

    fn near(a: &Frame, b: &Frame) -> bool {
        let same = a.turn.iter().zip(b.turn).map(|(a, b)| a * b).sum::<f64>().abs();
        distance(a.place, b.place) < 1e-12 && (same - 1.0).abs() < 1e-12
    }

    #[test]
    fn frames_are_put_into_each_other_and_taken_out() {
        let hand = Frame { place: [0.3, -0.2, 1.1], turn: quat_from_axis_angle([0.0, 0.6, 0.8], 1.2) };
        let thing = Frame { place: [0.5, 0.1, 0.9], turn: quat_from_axis_angle([1.0, 0.0, 0.0], -0.4) };
        assert!(near(&hand.with(&thing.within(&hand)), &thing));
        assert!(near(&hand.towards(&thing, 0.0), &hand));
        assert!(near(&hand.towards(&thing, 1.0), &thing));
        let half = hand.towards(&thing, 0.5);
        assert!(near(&half.towards(&thing, 1.0), &thing) && !near(&half, &hand));
    }
}
