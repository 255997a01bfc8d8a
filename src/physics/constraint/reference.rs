//! Velocity of rows and the acceleration they ask for: a spring-damper on the violation (MuJoCo documentation,
//! Computation, "Constraint model": `a* = -b v - k r`).

use super::equality::subtract_jacobian_rate;
use super::rows::mul_jacobian;
use super::scratch::ConstraintScratch;
use crate::math::{add, add_scaled, cross, mul_mat_vec, sub};
use crate::model::{Cone, Model};
use crate::stages::{Configuration, Constraints, Contact, Contacts, Kinematics, Velocity};

/// Computes `efc_vel` and `efc_aref`.
pub fn reference(
    m: &Model,
    at: &Configuration,
    vel: &Velocity,
    con: &Contacts,
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    let Configuration { state, kin, .. } = *at;
    let mut velocity = std::mem::take(&mut efc.efc_vel);
    mul_jacobian(m, efc, &state.qvel, &mut velocity);
    efc.efc_vel = velocity;
    if m.flg_surfacevel {
        add_surface_velocity(m, kin, con, efc);
    }
    efc.efc_aref.clear();
    efc.efc_aref.extend((0..efc.nefc).map(|i| {
        let [k, b, imp, _] = efc.efc_KBIP[i];
        -b * efc.efc_vel[i] - k * imp * (efc.efc_pos[i] - efc.efc_margin[i])
    }));
    if m.flg_adhesion {
        add_adhesion(m, con, efc);
    }
    subtract_jacobian_rate(m, at, vel, efc, scratch);
}

/// Moving surfaces (conveyors) add their relative velocity to contact rows: tangents and spin only.
fn add_surface_velocity(m: &Model, kin: &Kinematics, con: &Contacts, efc: &mut Constraints) {
    for contact in con.contact.iter().filter(|c| c.efc_address >= 0) {
        let Some(speed) = surface_velocity(m, kin, contact) else { continue };
        let (first, dim) = (contact.efc_address as usize, contact.dim as usize);
        if dim == 1 || m.opt.cone == Cone::Elliptic {
            for j in 0..dim {
                efc.efc_vel[first + j] += speed[j];
            }
        } else {
            for k in 1..dim {
                let along = contact.friction[k - 1] * speed[k];
                efc.efc_vel[first + 2 * (k - 1)] += along;
                efc.efc_vel[first + 2 * (k - 1) + 1] -= along;
            }
        }
    }
}

/// Relative surface velocity in the contact frame (normal, tangents, spin, rolling), with what does not act on
/// contact rows set to zero; `None` when neither surface moves.
fn surface_velocity(m: &Model, kin: &Kinematics, contact: &Contact) -> Option<[f64; 6]> {
    let (mut linear, mut angular, mut moves) = ([0.0; 3], [0.0; 3], false);
    for (geom, sign) in contact.geom.iter().zip([-1.0, 1.0]) {
        let Ok(geom) = usize::try_from(*geom) else { continue };
        let local = &m.geom_surfacevel[geom];
        if *local == [0.0; 6] {
            continue;
        }
        moves = true;
        let rotate = |k: usize| mul_mat_vec(&kin.geom_xmat[geom], [local[k], local[k + 1], local[k + 2]]);
        let (v, w) = (rotate(0), rotate(3));
        let at_point = add(v, cross(w, sub(contact.pos, kin.geom_xpos[geom])));
        linear = add_scaled(linear, at_point, sign);
        angular = add_scaled(angular, w, sign);
    }
    let (v, w) = (mul_mat_vec(&contact.frame, linear), mul_mat_vec(&contact.frame, angular));
    moves.then_some([0.0, v[1], v[2], w[0], 0.0, 0.0])
}

/// Adhesive contacts pull: the reference of their normal is raised by the acceleration the adhesive force causes.
fn add_adhesion(m: &Model, con: &Contacts, efc: &mut Constraints) {
    for contact in con.contact.iter().filter(|c| c.adhesion != 0.0 && c.efc_address >= 0) {
        let (first, dim) = (contact.efc_address as usize, contact.dim as usize);
        let rows = if dim == 1 || m.opt.cone == Cone::Elliptic { 1 } else { 2 * (dim - 1) };
        let share = contact.adhesion / rows as f64;
        for i in first..first + rows {
            efc.efc_aref[i] += efc.efc_R[i] * share;
        }
    }
}
