//! What follows from the reference configuration `qpos0`: lengths, inverse weights, statistics, offsets of cameras and
//! lights, anchors of equality constraints.

use super::flex_reference;
use super::inverse_weight::set_inverse_weights;
use super::statistic;
use crate::actuation::transmission;
use crate::data::{Com, Data, Inertia, Kinematics, State, Tendons, Transmission, configuration_of};
use crate::inertia;
use crate::math::{
    add, mul_inertia, mul_mat_t_vec, mul_mat_vec, quat_conj, quat_mul, quat_normalize, spatial_dot, sub,
};
use crate::model::bounds::MINVAL;
use crate::model::reflected_load::Driven;
use crate::model::{Arrays, EqType, GainType, Model, ObjType};
use crate::position::{camera, com, kinematics, tendon};

/// Sets all that follows from poses and inertia at `qpos0`; trees and sparsity are those of the model.
pub(crate) fn set_constants(m: &mut Model) {
    let mut d = Data {
        ten: Tendons::new(m),
        trn: Transmission::new(m),
        inertia: Inertia::new(m),
        ..poses_at_reference(m)
    };
    joint_inertia(m.derived_mut(), &d);
    tendon::tendon(m, &d.state, &d.kin, &d.com, &mut d.ten);
    inertia::make_inertia(m, &d.com, &d.ten, &mut d.inertia);
    inertia::factor_inertia(m, &mut d.inertia);
    transmission::transmission(m, &configuration_of!(d), &d.con, &d.efc, &mut d.trn);
    set_inverse_weights(m, &d);
    let edges = flex_reference::lengths(m, &d.kin);
    let arrays = m.derived_mut();
    arrays.flexedge_length0.update(&edges);
    arrays.tendon_length0.update(&d.ten.ten_length);
    arrays.actuator_length0.update(&d.trn.actuator_length);
    offsets(arrays, &d);
    damping_ratios(arrays, &d);
    statistic::set_geometry(arrays, &d.kin);
    statistic::set_inertia(arrays, &d.inertia);
    spring_lengths(m, &mut d);
}

/// Sets what follows from poses at `qpos0` alone: statistics of sizes, offsets and anchors.
pub(crate) fn set_pose_constants(m: &mut Model) {
    let d = poses_at_reference(m);
    let arrays = m.derived_mut();
    offsets(arrays, &d);
    statistic::set_geometry(arrays, &d.kin);
}

/// Poses and centres of mass at `qpos0`; cameras and lights where they are fixed, which tracking ones need.
fn poses_at_reference(m: &Model) -> Data {
    let (state, kin, com) = (State::new(m), Kinematics::new(m), Com::new(m));
    let mut d = Data { state, kin, com, ..Data::default() };
    d.state.reset(m);
    kinematics::kinematics(m, &d.state, &mut d.kin);
    com::com_pos(m, &d.kin, &mut d.com);
    camera::fixed_cameras_and_lights(m, &mut d.kin);
    d
}

/// Anchors of equality constraints, and how cameras and lights stand to what they track.
fn offsets(m: &mut Arrays, d: &Data) {
    equality_anchors(m, d);
    camera_and_light_offsets(m, d);
}

/// `dof_M0`: diagonal of the joint-space inertia without tendon armature.
fn joint_inertia(m: &mut Arrays, d: &Data) {
    let mut crb = d.com.cinert.clone();
    for b in (1..m.nbody).rev() {
        let parent = m.body_parentid[b] as usize;
        if parent > 0 {
            for k in 0..10 {
                crb[parent][k] += crb[b][k];
            }
        }
    }
    let diagonal = |v: usize| {
        let momentum = mul_inertia(&crb[m.dof_bodyid[v] as usize], &d.com.cdof[v]);
        let armature = m.dof_armature[v] + Driven::Joint(m.dof_jntid[v] as usize).armature(m);
        armature + spatial_dot(&d.com.cdof[v], &momentum)
    };
    let diagonals: Vec<f64> = (0..m.nv).map(diagonal).collect();
    m.dof_M0.update(&diagonals);
}

/// The second anchor of connects, and anchor and relative pose of welds that give none.
fn equality_anchors(m: &mut Arrays, d: &Data) {
    let kin = &d.kin;
    for i in 0..m.neq {
        let (first, second) = (m.eq_obj1id[i] as usize, m.eq_obj2id[i].max(0) as usize);
        let by_site = m.eq_objtype[i] == ObjType::Site.code();
        let mut data = m.eq_data[i];
        let anchor = [data[0], data[1], data[2]];
        match EqType::from_code(m.eq_type[i]) {
            Some(EqType::Connect) if by_site => data = [0.0; 11],
            Some(EqType::Connect) => {
                let world = add(mul_mat_vec(&kin.xmat[first], anchor), kin.xpos[first]);
                let local = mul_mat_t_vec(&kin.xmat[second], sub(world, kin.xpos[second]));
                data[3..6].copy_from_slice(&local);
            }
            Some(EqType::Weld) if !by_site => {
                let given = [data[6], data[7], data[8], data[9]];
                if given != [0.0; 4] {
                    data[6..10].copy_from_slice(&quat_normalize(given));
                } else {
                    let world = add(mul_mat_vec(&kin.xmat[second], anchor), kin.xpos[second]);
                    let local = mul_mat_t_vec(&kin.xmat[first], sub(world, kin.xpos[first]));
                    data[3..6].copy_from_slice(&local);
                    let relative = quat_mul(quat_conj(kin.xquat[first]), kin.xquat[second]);
                    data[6..10].copy_from_slice(&relative);
                }
            }
            _ => continue,
        }
        m.eq_data.update_row(i, data);
    }
}

fn camera_and_light_offsets(m: &mut Arrays, d: &Data) {
    let (kin, com) = (&d.kin, &d.com.subtree_com);
    let tracked = |body: i32, target: i32| if target >= 0 { target as usize } else { body as usize };
    for i in 0..m.ncam {
        let (body, target) = (m.cam_bodyid[i], m.cam_targetbodyid[i]);
        m.cam_pos0.update_row(i, sub(kin.cam_xpos[i], kin.xpos[body as usize]));
        m.cam_poscom0.update_row(i, sub(kin.cam_xpos[i], com[tracked(body, target)]));
        m.cam_mat0.update_row(i, kin.cam_xmat[i]);
    }
    for i in 0..m.nlight {
        let (body, target) = (m.light_bodyid[i], m.light_targetbodyid[i]);
        m.light_pos0.update_row(i, sub(kin.light_xpos[i], kin.xpos[body as usize]));
        m.light_poscom0.update_row(i, sub(kin.light_xpos[i], com[tracked(body, target)]));
        m.light_dir0.update_row(i, kin.light_xdir[i]);
    }
}

/// True when the damping term of actuator `i` is a damping ratio: positive, and of a position servo.
pub(crate) fn has_damping_ratio(m: &Arrays, i: usize) -> bool {
    let pid = m.actuator_gaintype[i] == GainType::Pid.code();
    let (kp, bias) = (m.actuator_gainprm[i][0], m.actuator_biasprm[i]);
    (pid || kp == -bias[1]) && bias[2] > 0.0
}

/// Damping ratios become the matching damping (XML reference, `position/dampratio`).
fn damping_ratios(m: &mut Arrays, d: &Data) {
    for i in (0..m.nactuator).filter(|&i| has_damping_ratio(m, i)).collect::<Vec<_>>() {
        let mut mass = 0.0;
        for (dof, moment) in transmission::moment(&d.trn, m.actuator_outadr[i] as usize) {
            if moment * moment > MINVAL {
                mass += m.dof_M0[dof] / (moment * moment);
            }
        }
        let pid = m.actuator_gaintype[i] == GainType::Pid.code();
        let bias = m.actuator_biasprm[i];
        let stiffness = if pid { -bias[1] } else { m.actuator_gainprm[i][0] };
        m.actuator_biasprm[i][2] = -(bias[2] * 2.0 * (stiffness * mass).sqrt());
    }
}

/// Tendon rest lengths given as -1 take the length at `qpos_spring`.
fn spring_lengths(m: &mut Model, d: &mut Data) {
    d.state.qpos.copy_from_slice(&m.qpos_spring);
    kinematics::kinematics(m, &d.state, &mut d.kin);
    com::com_pos(m, &d.kin, &mut d.com);
    tendon::tendon(m, &d.state, &d.kin, &d.com, &mut d.ten);
    let m = m.derived_mut();
    for i in 0..m.ntendon {
        if m.tendon_lengthspring[i] == [-1.0; 2] {
            m.tendon_lengthspring[i] = [d.ten.ten_length[i]; 2];
        }
    }
}
