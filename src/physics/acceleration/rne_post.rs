//! Accelerations of bodies and forces between them after the constraints are solved: what accelerometers and force
//! sensors read (MuJoCo documentation, API reference, `mj_rnePostConstraint`).

use crate::acceleration::contact_force::contact_force;
use crate::math::{Spatial, Vec3, add, cross, mul_mat_t_vec};
use crate::model::{EqType, Model, ObjType};
use crate::position::chain::com_offset;
use crate::position::kinematics::attached_pos;
use crate::stages::{
    Acceleration, Com, Configuration, Constraints, Contact, Contacts, Kinematics, Sensors, State, Velocity,
};
use crate::velocity::bias::{body_force, world_acceleration};
use crate::velocity::com_vel::{add_motion, dofs};

/// Computes `cacc`, `cfrc_ext` and `cfrc_int`.
pub fn rne_post_constraint(
    m: &Model,
    at: &Configuration,
    vel: &Velocity,
    con: &Contacts,
    efc: &Constraints,
    acc: &Acceleration,
    out: &mut Sensors,
) {
    let Configuration { state, kin, com, .. } = *at;
    out.cfrc_ext.fill([0.0; 6]);
    applied(m, state, kin, com, &mut out.cfrc_ext);
    contacts(m, com, con, efc, &mut out.cfrc_ext);
    equalities(m, kin, com, efc, &mut out.cfrc_ext);
    out.cacc[0] = world_acceleration(m);
    out.cfrc_int[0] = [0.0; 6];
    for b in 1..m.nbody {
        let mut a = out.cacc[m.body_parentid[b] as usize];
        add_motion(&vel.cdof_dot, &state.qvel, dofs(m, b), &mut a);
        add_motion(&com.cdof, &acc.qacc, dofs(m, b), &mut a);
        let force = body_force(com, vel, b, &a);
        out.cacc[b] = a;
        out.cfrc_int[b] = std::array::from_fn(|i| force[i] - out.cfrc_ext[b][i]);
    }
    for b in (1..m.nbody).rev() {
        let child = out.cfrc_int[b];
        let parent = &mut out.cfrc_int[m.body_parentid[b] as usize];
        (0..6).for_each(|i| parent[i] += child[i]);
    }
}

/// A force and a torque that act at a point, world frame.
struct Wrench {
    point: Vec3,
    force: Vec3,
    torque: Vec3,
}

/// Adds to body `b` the com-based equivalent of `sign` times a wrench; nothing to the world.
fn push(m: &Model, com: &Com, b: usize, wrench: &Wrench, sign: f64, out: &mut [Spatial]) {
    if b == 0 {
        return;
    }
    let moment = add(wrench.torque, cross(com_offset(m, com, b, wrench.point), wrench.force));
    for i in 0..3 {
        out[b][i] += sign * moment[i];
        out[b][3 + i] += sign * wrench.force[i];
    }
}

/// User wrenches at the centres of mass of bodies.
fn applied(m: &Model, state: &State, kin: &Kinematics, com: &Com, out: &mut [Spatial]) {
    for b in 1..m.nbody {
        let [fx, fy, fz, tx, ty, tz] = state.xfrc_applied[b];
        if state.xfrc_applied[b] != [0.0; 6] {
            let wrench = Wrench { point: kin.xipos[b], force: [fx, fy, fz], torque: [tx, ty, tz] };
            push(m, com, b, &wrench, 1.0, out);
        }
    }
}

/// Wrenches of contacts of geoms, opposite on the two bodies; flexes make none.
fn contacts(m: &Model, com: &Com, con: &Contacts, efc: &Constraints, out: &mut [Spatial]) {
    let counts = |c: &&Contact| c.efc_address >= 0 && c.geom.iter().all(|&g| g >= 0);
    for contact in con.contact.iter().filter(counts) {
        let [f0, f1, f2, t0, t1, t2] = contact_force(m, efc, contact);
        let wrench = Wrench {
            point: contact.pos,
            force: mul_mat_t_vec(&contact.frame, [f0, f1, f2]),
            torque: mul_mat_t_vec(&contact.frame, [t0, t1, t2]),
        };
        for (geom, sign) in contact.geom.into_iter().zip([-1.0, 1.0]) {
            push(m, com, m.geom_bodyid[geom as usize] as usize, &wrench, sign, out);
        }
    }
}

/// Wrenches of connect and weld constraints.
fn equalities(m: &Model, kin: &Kinematics, com: &Com, efc: &Constraints, out: &mut [Spatial]) {
    let mut row = 0;
    while row < efc.ne {
        let e = efc.efc_id[row] as usize;
        let weld = m.eq_type[e] == EqType::Weld.code();
        if !weld && m.eq_type[e] != EqType::Connect.code() {
            row += 1;
            continue;
        }
        let three = |at: usize| [efc.efc_force[at], efc.efc_force[at + 1], efc.efc_force[at + 2]];
        let (force, torque) = (three(row), if weld { three(row + 3) } else { [0.0; 3] });
        for (side, sign) in [1.0, -1.0].into_iter().enumerate() {
            let (b, local) = anchor(m, e, side, weld);
            let wrench = Wrench { point: attached_pos(kin, b, local), force, torque };
            push(m, com, b, &wrench, sign, out);
        }
        row += if weld { 6 } else { 3 };
    }
}

/// Body of one side of connect or weld `e` and the anchor point in its frame.
fn anchor(m: &Model, e: usize, side: usize, weld: bool) -> (usize, Vec3) {
    let object = [m.eq_obj1id[e], m.eq_obj2id[e]][side] as usize;
    if m.eq_objtype[e] != ObjType::Body.code() {
        return (m.site_bodyid[object] as usize, m.site_pos[object]);
    }
    // A weld keeps its second anchor first, a connect its first.
    let at = if (side == 0) == weld { 3 } else { 0 };
    (object, [m.eq_data[e][at], m.eq_data[e][at + 1], m.eq_data[e][at + 2]])
}
