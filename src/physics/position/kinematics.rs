//! Forward kinematics: generalised positions to poses of bodies, joints, geoms and sites in the world
//! (MuJoCo documentation, Computation, "Forward dynamics", position stage).

use crate::math::{
    IDENTITY, Mat3, Quat, Vec3, add, add_scaled, mul_mat_vec, quat_from_axis_angle, quat_mul, quat_normalize,
    quat_rotate, quat_to_mat, sub,
};
use crate::model::{JointType, Model, SameFrame};
use crate::sleep::{self, Awake, over};
use crate::stages::{Kinematics, State};

const UPRIGHT: Mat3 = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Position and orientation of a frame.
#[derive(Clone, Copy)]
struct Pose {
    pos: Vec3,
    quat: Quat,
}

/// Computes all poses except of cameras and lights. Quaternions of joints and mocap bodies need not be normalised: this
/// does it.
pub fn kinematics(m: &Model, state: &State, kin: &mut Kinematics) {
    bodies(m, state, kin);
    attached(m, kin);
}

/// [`kinematics`] of what is awake: wakes the sleeping trees that the user has moved, or pushes.
pub(crate) fn kinematics_of_awake(m: &Model, state: &mut State, kin: &mut Kinematics) {
    if !sleep::is_on(m) {
        sleep::wake::all(m, state);
        return kinematics(m, state, kin);
    }
    world(kin);
    for b in 1..m.nbody {
        let mut pose = body(m, state, b, kin);
        pose.quat = quat_normalize(pose.quat);
        if state.body_awake[b] == 0 && m.body_jntnum[b] > 0 {
            if pose.pos == kin.xpos[b] && pose.quat == kin.xquat[b] {
                continue;
            }
            state.tree_awake[m.body_treeid[b] as usize] = 1;
        }
        put_body(b, pose, kin);
    }
    sleep::wake::by_user(m, state);
    let awake = Awake::of(m, state);
    if awake.is_everything() {
        return attached(m, kin);
    }
    over!(awake.bodies(m), |bodies| bodies.skip(1).for_each(|b| inertial_frame(m, b, kin)));
    let Kinematics { xpos, xquat, xmat, xipos, ximat, geom_xpos, geom_xmat, site_xpos, site_xmat, .. } = kin;
    let frames = BodyFrames { xpos, xquat, xmat, xipos, ximat };
    geoms(m).place_awake(awake, &frames, geom_xpos, geom_xmat);
    sites(m).place_awake(awake, &frames, site_xpos, site_xmat);
}

/// Inertial frames, geoms and sites.
#[inline(always)]
fn attached(m: &Model, kin: &mut Kinematics) {
    for b in 1..m.nbody {
        inertial_frame(m, b, kin);
    }
    let Kinematics { xpos, xquat, xmat, xipos, ximat, geom_xpos, geom_xmat, site_xpos, site_xmat, .. } = kin;
    let frames = BodyFrames { xpos, xquat, xmat, xipos, ximat };
    geoms(m).place(&frames, geom_xpos, geom_xmat);
    sites(m).place(&frames, site_xpos, site_xmat);
}

fn geoms(m: &Model) -> Fixed<'_> {
    Fixed { body: &m.geom_bodyid, same: &m.geom_sameframe, pos: &m.geom_pos, quat: &m.geom_quat }
}

fn sites(m: &Model) -> Fixed<'_> {
    Fixed { body: &m.site_bodyid, same: &m.site_sameframe, pos: &m.site_pos, quat: &m.site_quat }
}

/// Poses of body frames, from the root outward.
fn bodies(m: &Model, state: &State, kin: &mut Kinematics) {
    world(kin);
    for b in 1..m.nbody {
        let pose = body(m, state, b, kin);
        put_body(b, Pose { quat: quat_normalize(pose.quat), ..pose }, kin);
    }
}

fn world(kin: &mut Kinematics) {
    kin.xpos[0] = [0.0; 3];
    kin.xquat[0] = IDENTITY;
    kin.xipos[0] = [0.0; 3];
    kin.xmat[0] = UPRIGHT;
    kin.ximat[0] = UPRIGHT;
}

/// Pose of body `b` from the pose of its parent, the quaternion not normalised; records anchors and axes of its joints.
#[inline(always)]
fn body(m: &Model, state: &State, b: usize, kin: &mut Kinematics) -> Pose {
    let first = m.body_jntadr[b];
    if m.body_jntnum[b] == 1 && m.jnt_type[first as usize] == JointType::Free.code() {
        return free_body(m, state, first as usize, kin);
    }
    let mut pose = resting(m, state, b, kin);
    for j in first..first + m.body_jntnum[b] {
        move_by_joint(m, &state.qpos, j as usize, &mut pose, kin);
    }
    pose
}

#[inline(always)]
fn put_body(b: usize, pose: Pose, kin: &mut Kinematics) {
    kin.xpos[b] = pose.pos;
    kin.xquat[b] = pose.quat;
    kin.xmat[b] = quat_to_mat(pose.quat);
}

/// Pose of a body on free joint `j`, as `qpos` says.
fn free_body(m: &Model, state: &State, j: usize, kin: &mut Kinematics) -> Pose {
    let q = m.jnt_qposadr[j] as usize;
    let pos = [state.qpos[q], state.qpos[q + 1], state.qpos[q + 2]];
    kin.xanchor[j] = pos;
    kin.xaxis[j] = m.jnt_axis[j];
    Pose { pos, quat: joint_quat(&state.qpos, q + 3) }
}

/// Pose of body `b` before its joints move it: fixed in its parent, or given by mocap.
#[inline(always)]
fn resting(m: &Model, state: &State, b: usize, kin: &Kinematics) -> Pose {
    let local = match usize::try_from(m.body_mocapid[b]) {
        Ok(k) => Pose { pos: state.mocap_pos[k], quat: quat_normalize(state.mocap_quat[k]) },
        Err(_) => Pose { pos: m.body_pos[b], quat: m.body_quat[b] },
    };
    match m.body_parentid[b] as usize {
        0 => local,
        p => Pose {
            pos: add(mul_mat_vec(&kin.xmat[p], local.pos), kin.xpos[p]),
            quat: quat_mul(kin.xquat[p], local.quat),
        },
    }
}

/// Records anchor and axis of joint `j`, then moves the body by it.
#[inline(always)]
fn move_by_joint(m: &Model, qpos: &[f64], j: usize, pose: &mut Pose, kin: &mut Kinematics) {
    let q = m.jnt_qposadr[j] as usize;
    let axis = quat_rotate(pose.quat, m.jnt_axis[j]);
    let anchor = add(quat_rotate(pose.quat, m.jnt_pos[j]), pose.pos);
    kin.xaxis[j] = axis;
    kin.xanchor[j] = anchor;
    let turn = match JointType::from_code(m.jnt_type[j]) {
        Some(JointType::Ball) => joint_quat(qpos, q),
        Some(JointType::Hinge) => quat_from_axis_angle(m.jnt_axis[j], qpos[q] - m.qpos0[q]),
        // A free joint is alone on its body and never comes here.
        Some(JointType::Slide | JointType::Free) | None => {
            pose.pos = add_scaled(pose.pos, axis, qpos[q] - m.qpos0[q]);
            return;
        }
    };
    pose.quat = quat_mul(pose.quat, turn);
    pose.pos = sub(anchor, quat_rotate(pose.quat, m.jnt_pos[j]));
}

/// Unit quaternion kept at `qpos[q..q + 4]`.
fn joint_quat(qpos: &[f64], q: usize) -> Quat {
    quat_normalize([qpos[q], qpos[q + 1], qpos[q + 2], qpos[q + 3]])
}

/// Centre of mass and principal axes of inertia of body `b`.
#[inline(always)]
fn inertial_frame(m: &Model, b: usize, kin: &mut Kinematics) {
    let same = SameFrame::from_code(i32::from(m.body_sameframe[b]));
    kin.xipos[b] = match same {
        Some(SameFrame::Body) => kin.xpos[b],
        _ => attached_pos(kin, b, m.body_ipos[b]),
    };
    kin.ximat[b] = match same {
        Some(SameFrame::Body | SameFrame::Bodyrot) => kin.xmat[b],
        _ => attached_mat(kin, b, m.body_iquat[b]),
    };
}

/// Poses of all bodies and of their inertial frames.
struct BodyFrames<'a> {
    xpos: &'a [Vec3],
    xquat: &'a [Quat],
    xmat: &'a [Mat3],
    xipos: &'a [Vec3],
    ximat: &'a [Mat3],
}

/// Frames of one family that are fixed in bodies: the body, which of its frames each coincides with, and the pose
/// in the body.
struct Fixed<'a> {
    body: &'a [i32],
    same: &'a [u8],
    pos: &'a [Vec3],
    quat: &'a [Quat],
}

impl Fixed<'_> {
    /// Computes the poses of all in the world.
    fn place(&self, at: &BodyFrames, xpos: &mut [Vec3], xmat: &mut [Mat3]) {
        let local = self.pos.iter().zip(self.quat);
        let world = xpos.iter_mut().zip(xmat);
        for (((&b, &same), (pos, quat)), (xpos, xmat)) in
            self.body.iter().zip(self.same).zip(local).zip(world)
        {
            at.place(b as usize, same, (pos, quat), (xpos, xmat));
        }
    }

    /// Computes the poses of those on bodies that may have moved.
    fn place_awake(&self, awake: Awake, at: &BodyFrames, xpos: &mut [Vec3], xmat: &mut [Mat3]) {
        for (i, &b) in self.body.iter().enumerate().filter(|(_, b)| awake.moves(**b as usize)) {
            let local = (&self.pos[i], &self.quat[i]);
            at.place(b as usize, self.same[i], local, (&mut xpos[i], &mut xmat[i]));
        }
    }
}

impl BodyFrames<'_> {
    /// World pose of a frame that is fixed in body `b`.
    #[inline(always)]
    fn place(&self, b: usize, same: u8, local: (&Vec3, &Quat), world: (&mut Vec3, &mut Mat3)) {
        let ((pos, quat), (xpos, xmat)) = (local, world);
        let same = SameFrame::from_code(i32::from(same));
        *xpos = match same {
            Some(SameFrame::Body) => self.xpos[b],
            Some(SameFrame::Inertia) => self.xipos[b],
            _ => add(mul_mat_vec(&self.xmat[b], *pos), self.xpos[b]),
        };
        match same {
            Some(SameFrame::Body | SameFrame::Bodyrot) => *xmat = self.xmat[b],
            Some(SameFrame::Inertia | SameFrame::Inertiarot) => *xmat = self.ximat[b],
            Some(SameFrame::None) | None => *xmat = quat_to_mat(quat_mul(self.xquat[b], *quat)),
        }
    }
}

/// World position of a point fixed in body `b`.
pub fn attached_pos(kin: &Kinematics, b: usize, local: Vec3) -> Vec3 {
    add(mul_mat_vec(&kin.xmat[b], local), kin.xpos[b])
}

/// World orientation of a frame fixed in body `b`.
pub fn attached_mat(kin: &Kinematics, b: usize, local: Quat) -> Mat3 {
    quat_to_mat(quat_mul(kin.xquat[b], local))
}
