//! Turning an object in hand until it points like its target: the rows, the reward and the start that such tasks share.

use crate::rotation::{cosine, norm};
use crate::rows::Rows;
use crate::suite::muscle::effort;
use crate::task::{Verdict, View};
use physics::math::{Vec3, sub};

/// Beyond this distance \[m\] from its place the object has been dropped.
const DROPPED: f64 = 0.075;
/// Cosines of the angle to the target above which the object points like it, roughly and well.
const ALIGNED: [f64; 2] = [0.9, 0.95];
/// Angle \[rad\] of the forearm that turns the palm up.
const PALM_UP: f64 = -1.5;
/// Joints of the object, behind the hand's.
pub const OBJECT_JOINTS: usize = 6;

/// Terms of the reward with their weights.
pub const WEIGHTS: [(&str, f64); 5] =
    [("pos_align", 1.0), ("rot_align", 1.0), ("act_reg", 5.0), ("drop", 5.0), ("bonus", 10.0)];

/// Where the object is and points, and where it should.
#[derive(Clone, Copy, Debug)]
pub struct Placement {
    /// Position of the object \[m\].
    pub position: Vec3,
    /// Its place \[m\].
    pub place: Vec3,
    /// Direction of the object's axis.
    pub axis: Vec3,
    /// Direction of the target's axis.
    pub target: Vec3,
}

/// The hand open with the palm up; the object as it is.
pub fn open_hand(qpos: &mut [f64]) {
    let hand = qpos.len() - OBJECT_JOINTS;
    qpos[..hand].fill(0.0);
    qpos[0] = PALM_UP;
}

/// Writes the rows of hand and object.
pub fn observe(view: &View<'_>, placement: Placement, rows: &mut Rows) {
    let Placement { position, place, axis, target } = placement;
    let state = &view.data.state;
    let (hand, object) = (view.model.nq - OBJECT_JOINTS, view.model.nv - OBJECT_JOINTS);
    rows.set("hand_jnt", "rad", &state.qpos[..hand]);
    rows.set("obj_pos", "m", position);
    rows.set("obj_des_pos", "m", place);
    rows.set("obj_vel", "m, rad", state.qvel[object..].iter().map(|velocity| velocity * view.dt));
    rows.set("obj_rot", "", axis);
    rows.set("obj_des_rot", "", target);
    rows.set("obj_err_pos", "m", sub(position, place));
    rows.set("obj_err_rot", "", sub(axis, target));
}

/// Writes the terms.
pub fn reward(rows: &Rows, terms: &mut Rows) -> Verdict {
    let distance = norm(&rows["obj_err_pos"]);
    let alignment = cosine(&rows["obj_rot"], &rows["obj_des_rot"]);
    let dropped = distance > DROPPED;
    let held = |threshold| f64::from(alignment > threshold && distance < DROPPED);
    terms.set("pos_align", "m", [-distance]);
    terms.set("rot_align", "", [alignment]);
    terms.set("act_reg", "", [-effort(rows)]);
    terms.set("drop", "", [-f64::from(dropped)]);
    terms.set("bonus", "", [held(ALIGNED[0]) + 5.0 * held(ALIGNED[1])]);
    Verdict { sparse: alignment - distance, solved: alignment > ALIGNED[1] && !dropped, done: dropped }
}
