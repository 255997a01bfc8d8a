//! Forward kinematics: generalised positions to poses of bodies, joints, geoms and sites in the world
//! (MuJoCo documentation, Computation, "Forward dynamics", position stage).

use crate::data::{Kinematics, State};
use crate::math::{
    IDENTITY, Mat3, Quat, Vec3, add, add_scaled, mul_mat_vec, quat_from_axis_angle, quat_mul, quat_normalize,
    quat_rotate, quat_to_mat, sub,
};
use crate::model::{JointType, Model, SameFrame};

const UPRIGHT: Mat3 = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];

/// Position and orientation of a frame.
#[derive(Clone, Copy)]
struct Pose {
    pos: Vec3,
    quat: Quat,
}

/// Computes all poses but those of cameras and lights. Quaternions of joints and mocap bodies need not be
/// normalised: they are on use.
pub fn kinematics(m: &Model, state: &State, kin: &mut Kinematics) {
    bodies(m, state, kin);
    inertial_frames(m, kin);
    let Kinematics { xpos, xquat, xmat, xipos, ximat, geom_xpos, geom_xmat, site_xpos, site_xmat, .. } = kin;
    let frames = BodyFrames { xpos, xquat, xmat, xipos, ximat };
    let geoms = Fixed { body: &m.geom_bodyid, same: &m.geom_sameframe, pos: &m.geom_pos, quat: &m.geom_quat };
    let sites = Fixed { body: &m.site_bodyid, same: &m.site_sameframe, pos: &m.site_pos, quat: &m.site_quat };
    geoms.place(&frames, geom_xpos, geom_xmat);
    sites.place(&frames, site_xpos, site_xmat);
}

/// Poses of body frames, from the root outward.
fn bodies(m: &Model, state: &State, kin: &mut Kinematics) {
    kin.xpos[0] = [0.0; 3];
    kin.xquat[0] = IDENTITY;
    kin.xipos[0] = [0.0; 3];
    kin.xmat[0] = UPRIGHT;
    kin.ximat[0] = UPRIGHT;
    for b in 1..m.nbody {
        let first = m.body_jntadr[b];
        let pose = if m.body_jntnum[b] == 1 && m.jnt_type[first as usize] == JointType::Free.code() {
            free_body(m, state, first as usize, kin)
        } else {
            let mut pose = resting(m, state, b, kin);
            for j in first..first + m.body_jntnum[b] {
                move_by_joint(m, &state.qpos, j as usize, &mut pose, kin);
            }
            pose
        };
        kin.xpos[b] = pose.pos;
        kin.xquat[b] = quat_normalize(pose.quat);
        kin.xmat[b] = quat_to_mat(kin.xquat[b]);
    }
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

/// Centres of mass and principal axes of inertia.
fn inertial_frames(m: &Model, kin: &mut Kinematics) {
    for b in 1..m.nbody {
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
            let b = b as usize;
            let same = SameFrame::from_code(i32::from(same));
            *xpos = match same {
                Some(SameFrame::Body) => at.xpos[b],
                Some(SameFrame::Inertia) => at.xipos[b],
                _ => add(mul_mat_vec(&at.xmat[b], *pos), at.xpos[b]),
            };
            match same {
                Some(SameFrame::Body | SameFrame::Bodyrot) => *xmat = at.xmat[b],
                Some(SameFrame::Inertia | SameFrame::Inertiarot) => *xmat = at.ximat[b],
                Some(SameFrame::None) | None => *xmat = quat_to_mat(quat_mul(at.xquat[b], *quat)),
            }
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
