//! Cameras and lights: poses in the world, fixed to a body, tracking it, or looking at a target (MuJoCo
//! documentation, XML reference, `camera/mode`).

use crate::math::{Mat3, Vec3, add, cross, normalize, quat_rotate, sub};
use crate::model::{Model, TrackMode};
use crate::position::kinematics::{attached_mat, attached_pos};
use crate::stages::{Com, Kinematics};

/// Computes poses of cameras and lights from poses of bodies.
pub fn cameras_and_lights(m: &Model, com: &Com, kin: &mut Kinematics) {
    for c in 0..m.ncam {
        camera(m, com, c, kin);
    }
    for l in 0..m.nlight {
        light(m, com, l, kin);
    }
}

/// The same as if all cameras and lights were fixed to their bodies.
pub fn fixed_cameras_and_lights(m: &Model, kin: &mut Kinematics) {
    for c in 0..m.ncam {
        fixed_camera(m, c, kin);
    }
    for l in 0..m.nlight {
        let (pos, dir) = fixed_light(m, l, kin);
        kin.light_xpos[l] = pos;
        kin.light_xdir[l] = normalize(dir).0;
    }
}

fn fixed_camera(m: &Model, c: usize, kin: &mut Kinematics) {
    let b = m.cam_bodyid[c] as usize;
    kin.cam_xpos[c] = attached_pos(kin, b, m.cam_pos[c]);
    kin.cam_xmat[c] = attached_mat(kin, b, m.cam_quat[c]);
}

/// Position and direction.
#[inline]
fn fixed_light(m: &Model, l: usize, kin: &Kinematics) -> (Vec3, Vec3) {
    let b = m.light_bodyid[l] as usize;
    (attached_pos(kin, b, m.light_pos[l]), quat_rotate(kin.xquat[b], m.light_dir[l]))
}

fn camera(m: &Model, com: &Com, c: usize, kin: &mut Kinematics) {
    let b = m.cam_bodyid[c] as usize;
    fixed_camera(m, c, kin);
    match TrackMode::from_code(m.cam_mode[c]) {
        Some(TrackMode::Track) => {
            kin.cam_xmat[c] = m.cam_mat0[c];
            kin.cam_xpos[c] = add(kin.xpos[b], m.cam_pos0[c]);
        }
        Some(TrackMode::Trackcom) => {
            kin.cam_xmat[c] = m.cam_mat0[c];
            kin.cam_xpos[c] = add(com.subtree_com[b], m.cam_poscom0[c]);
        }
        Some(mode @ (TrackMode::Targetbody | TrackMode::Targetbodycom)) => {
            if let Some(target) = target(kin, com, mode, m.cam_targetbodyid[c]) {
                kin.cam_xmat[c] = looking_along(sub(kin.cam_xpos[c], target));
            }
        }
        Some(TrackMode::Fixed) | None => {}
    }
}

fn light(m: &Model, com: &Com, l: usize, kin: &mut Kinematics) {
    let b = m.light_bodyid[l] as usize;
    let (mut pos, mut dir) = fixed_light(m, l, kin);
    match TrackMode::from_code(m.light_mode[l]) {
        Some(TrackMode::Track) => {
            dir = m.light_dir0[l];
            pos = add(kin.xpos[b], m.light_pos0[l]);
        }
        Some(TrackMode::Trackcom) => {
            dir = m.light_dir0[l];
            pos = add(com.subtree_com[b], m.light_poscom0[l]);
        }
        Some(mode @ (TrackMode::Targetbody | TrackMode::Targetbodycom)) => {
            if let Some(target) = target(kin, com, mode, m.light_targetbodyid[l]) {
                dir = sub(target, pos);
            }
        }
        Some(TrackMode::Fixed) | None => {}
    }
    kin.light_xpos[l] = pos;
    kin.light_xdir[l] = normalize(dir).0;
}

/// Point to look at: the frame or the subtree centre of mass of the target body.
fn target(kin: &Kinematics, com: &Com, mode: TrackMode, body: i32) -> Option<Vec3> {
    let b = usize::try_from(body).ok()?;
    Some(if mode == TrackMode::Targetbody { kin.xpos[b] } else { com.subtree_com[b] })
}

/// Camera orientation with the z axis along `back` and a horizontal x axis.
fn looking_along(back: Vec3) -> Mat3 {
    let z = normalize(back).0;
    let x = normalize(cross([0.0, 0.0, 1.0], z)).0;
    let y = normalize(cross(z, x)).0;
    [x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]]
}
