//! Lengths and moment arms of actuators (documentation: Computation, "Actuation model", transmission).
//!
//! The moment of an actuator is the gradient of its length; it maps scalar force to joint space. Rows are
//! compressed in place, one after the other; entries that are exactly zero are left out where MuJoCo does so.

use crate::math::{
    Mat3, Quat, Vec3, add, column, cross, dot, dot_sparse, mul_mat_t_vec, mul_mat_vec, ops, quat_conj,
    quat_difference, quat_mul, quat_normalize, quat_rotate, quat_to_velocity, rotational, row, scale, sub,
};
use crate::model::{Cone, Disable, JointType, Model, TrnType};
use crate::position::chain::{MergedChain, chain, com_offset, point_column, site_point};
use crate::position::tendon;
use crate::sleep::{Awake, object};
use crate::stages::{
    Com, Configuration, Constraints, Contact, Contacts, Kinematics, State, Tendons, Transmission, Velocity,
};
use std::ops::Range;

/// Computes lengths and moments of all actuators.
pub fn transmission(
    m: &Model,
    at: &Configuration,
    con: &Contacts,
    efc: &Constraints,
    trn: &mut Transmission,
) {
    let awake = Awake::of(m, at.state);
    let mut rows = Rows { trn, out: 0, next: 0 };
    for i in 0..m.nactuator {
        let (first, out) = (m.actuator_trnid[i][0] as usize, m.actuator_outadr[i] as usize);
        rows.begin(out);
        if awake.skips(|state| object::actuator(m, state, i)) {
            rows.skip(m.actuator_outnum[i] as usize);
            continue;
        }
        match TrnType::from_code(m.actuator_trntype[i]) {
            Some(TrnType::Joint) => joint(m, at.state, first, halves(m, out), false, &mut rows),
            Some(TrnType::Jointinparent) => joint(m, at.state, first, halves(m, out), true, &mut rows),
            Some(TrnType::Tendon) => tendon_row(m, at.ten, first, m.actuator_gear[out][0], &mut rows),
            _ => other_kind(m, at, con, efc, i, &mut rows),
        }
    }
    rows.clear_rest();
}

/// Actuator `i`, of a kind other than joint and tendon.
///
/// Not inlined, so that the addresses of its arrays are loaded only where such an actuator exists.
#[inline(never)]
fn other_kind(m: &Model, at: &Configuration, con: &Contacts, efc: &Constraints, i: usize, rows: &mut Rows) {
    let Configuration { state, kin, com, .. } = *at;
    let (first, second) = (m.actuator_trnid[i][0] as usize, usize::try_from(m.actuator_trnid[i][1]).ok());
    let gear = halves(m, rows.out);
    match (TrnType::from_code(m.actuator_trntype[i]), second) {
        (Some(TrnType::Slidercrank), Some(slider)) => {
            let crank = Crank { pin: first, slider, rod: m.actuator_cranklength[i] };
            slider_crank(m, kin, com, &crank, gear[0][0], rows);
        }
        (Some(TrnType::Site), None) => site(m, kin, com, first, gear, rows),
        (Some(TrnType::Site), Some(reference)) => relative_site(m, kin, com, first, reference, gear, rows),
        (Some(TrnType::Body), _) => body_adhesion(m, com, con, efc, first, rows),
        (Some(TrnType::So3), None) => ball_rotation(m, state, first, rows),
        (Some(TrnType::So3), Some(reference)) => site_rotation(m, kin, com, first, reference, rows),
        _ => rows.finish(0.0),
    }
}

/// Gear of output `out`: the part for forces, the part for torques.
fn halves(m: &Model, out: usize) -> [Vec3; 2] {
    let [x, y, z, a, b, c] = m.actuator_gear[out];
    [[x, y, z], [a, b, c]]
}

/// Velocities of all actuators: moments times joint velocities; zero when actuation is disabled. Tendon velocities come
/// first.
pub fn actuator_velocity(m: &Model, state: &State, trn: &Transmission, vel: &mut Velocity) {
    if m.opt.disableflags.contains(Disable::ACTUATION) {
        vel.actuator_velocity.fill(0.0);
        return;
    }
    for i in 0..m.nactuator {
        let first = m.actuator_outadr[i] as usize;
        // With unit gear the moment is the row of the tendon.
        if m.actuator_trntype[i] == TrnType::Tendon.code() && m.actuator_gear[first][0] == 1.0 {
            vel.actuator_velocity[first] = vel.ten_velocity[m.actuator_trnid[i][0] as usize];
            continue;
        }
        for out in first..first + m.actuator_outnum[i] as usize {
            let at = moment_row(trn, out);
            vel.actuator_velocity[out] =
                dot_sparse(&trn.actuator_moment[at.clone()], &trn.moment_colind[at], &state.qvel);
        }
    }
}

/// Non-zeros of moment row `out`: degree of freedom and moment arm.
pub fn moment(trn: &Transmission, out: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
    let at = moment_row(trn, out);
    trn.moment_colind[at.clone()].iter().map(|&dof| dof as usize).zip(trn.actuator_moment[at].iter().copied())
}

/// Positions of moment row `out` in the compressed arrays.
fn moment_row(trn: &Transmission, out: usize) -> Range<usize> {
    let start = trn.moment_rowadr[out] as usize;
    start..start + trn.moment_rownnz[out] as usize
}

/// Writer of the compressed moment rows.
struct Rows<'a> {
    trn: &'a mut Transmission,
    out: usize,
    next: usize,
}

impl Rows<'_> {
    /// Starts the row of output `out`.
    fn begin(&mut self, out: usize) {
        self.out = out;
        self.trn.moment_rowadr[out] = self.next as i32;
    }

    fn push(&mut self, dof: usize, value: f64) {
        self.trn.moment_colind[self.next] = dof as i32;
        self.trn.actuator_moment[self.next] = value;
        self.next += 1;
    }

    fn push_nonzero(&mut self, dof: usize, value: f64) {
        if value != 0.0 {
            self.push(dof, value);
        }
    }

    /// Ends the row.
    fn finish(&mut self, length: f64) {
        self.trn.actuator_length[self.out] = length;
        self.trn.moment_rownnz[self.out] = self.next as i32 - self.trn.moment_rowadr[self.out];
    }

    /// Leaves rows empty, and their lengths as they were.
    fn skip(&mut self, count: usize) {
        for out in self.out..self.out + count {
            self.trn.moment_rowadr[out] = self.next as i32;
            self.trn.moment_rownnz[out] = 0;
        }
    }

    /// Zeroes the room that sparser rows left over.
    fn clear_rest(self) {
        self.trn.moment_colind[self.next..].fill(0);
        self.trn.actuator_moment[self.next..].fill(0.0);
    }

    /// Ends a row whose entries were pushed in decreasing order.
    fn finish_reversed(&mut self, length: f64) {
        let start = self.trn.moment_rowadr[self.out] as usize;
        self.trn.moment_colind[start..self.next].reverse();
        self.trn.actuator_moment[start..self.next].reverse();
        self.finish(length);
    }
}

/// Unit quaternion stored in `qpos` at `adr`.
fn joint_quat(state: &State, adr: usize) -> Quat {
    quat_normalize([state.qpos[adr], state.qpos[adr + 1], state.qpos[adr + 2], state.qpos[adr + 3]])
}

fn joint(m: &Model, state: &State, id: usize, gear: [Vec3; 2], in_parent: bool, rows: &mut Rows) {
    let (qpos, dof) = (m.jnt_qposadr[id] as usize, m.jnt_dofadr[id] as usize);
    let in_joint_frame = |axis: Vec3, q: Quat| if in_parent { quat_rotate(quat_conj(q), axis) } else { axis };
    match JointType::from_code(m.jnt_type[id]) {
        Some(JointType::Slide | JointType::Hinge) => {
            rows.push(dof, gear[0][0]);
            rows.finish(state.qpos[qpos] * gear[0][0]);
        }
        Some(JointType::Ball) => {
            let q = joint_quat(state, qpos);
            let axis = in_joint_frame(gear[0], q);
            (0..3).for_each(|k| rows.push(dof + k, axis[k]));
            rows.finish(dot(quat_to_velocity(q, 1.0), axis));
        }
        Some(JointType::Free) => {
            let axis = in_joint_frame(gear[1], joint_quat(state, qpos + 3));
            (0..3).for_each(|k| rows.push(dof + k, gear[0][k]));
            (0..3).for_each(|k| rows.push(dof + 3 + k, axis[k]));
            rows.finish(0.0);
        }
        None => rows.finish(0.0),
    }
}

/// A slider crank: the sites of its pin and its slider, and the length of the rod between them \[m\].
struct Crank {
    pin: usize,
    slider: usize,
    rod: f64,
}

/// Length is `a·v - √((a·v)² + r² - v·v)` with slider axis `a`, vector `v` from slider to crank, and rod `r`.
fn slider_crank(m: &Model, kin: &Kinematics, com: &Com, parts: &Crank, gear: f64, rows: &mut Rows) {
    let rod = parts.rod;
    let (crank, slider_axis) = (site_point(m, kin, parts.pin), column(&kin.site_xmat[parts.slider], 2));
    let slider = site_point(m, kin, parts.slider);
    let v = sub(crank.1, slider.1);
    let along = dot(v, slider_axis);
    let det = along * along + rod * rod - dot(v, v);
    let (length, by_v, by_axis) = if det <= 0.0 {
        (along, slider_axis, v)
    } else {
        let root = ops::sqrt(det);
        let s = 1.0 - along / root;
        (along - root, add(scale(slider_axis, s), scale(v, 1.0 / root)), scale(v, s))
    };
    let offsets = [com_offset(m, com, crank.0, crank.1), com_offset(m, com, slider.0, slider.1)];
    for (dof, moves) in MergedChain::new(m, crank.0, slider.0) {
        let at = |end: usize| if moves[end] { point_column(com, dof, offsets[end]) } else { [0.0; 3] };
        let turn = if moves[1] { cross(rotational(&com.cdof[dof]), slider_axis) } else { [0.0; 3] };
        let shift = sub(at(0), at(1));
        let entry = (0..3).fold(0.0, |sum, k| sum + (by_axis[k] * turn[k] + by_v[k] * shift[k]));
        if entry != 0.0 {
            rows.push(dof, entry * gear);
        }
    }
    rows.finish_reversed(length * gear);
}

fn tendon_row(m: &Model, ten: &Tendons, id: usize, gear: f64, rows: &mut Rows) {
    let source = tendon::row(m, id);
    let target = rows.next..rows.next + source.len();
    rows.trn.moment_colind[target.clone()].copy_from_slice(&m.ten_J_colind[source.clone()]);
    for (moment, rate) in rows.trn.actuator_moment[target].iter_mut().zip(&ten.ten_J[source.clone()]) {
        *moment = rate * gear;
    }
    rows.next += source.len();
    rows.finish(ten.ten_length[id] * gear);
}

/// A wrench in the frame of a site; such an actuator has no length.
fn site(m: &Model, kin: &Kinematics, com: &Com, id: usize, gear: [Vec3; 2], rows: &mut Rows) {
    let (body, point) = site_point(m, kin, id);
    let [force, torque] = gear.map(|g| mul_mat_vec(&kin.site_xmat[id], g));
    let offset = com_offset(m, com, body, point);
    for dof in chain(m, body) {
        let entry = dot(point_column(com, dof, offset), force) + dot(rotational(&com.cdof[dof]), torque);
        rows.push_nonzero(dof, entry);
    }
    rows.finish_reversed(0.0);
}

/// Position and rotation of a site in the frame of a reference site. Degrees of freedom that move both do not
/// change them.
fn relative_site(
    m: &Model,
    kin: &Kinematics,
    com: &Com,
    id: usize,
    reference: usize,
    gear: [Vec3; 2],
    rows: &mut Rows,
) {
    let (site, base) = (site_point(m, kin, id), site_point(m, kin, reference));
    let frame = &kin.site_xmat[reference];
    let [force, torque] = gear.map(|g| mul_mat_vec(frame, g));
    let [shifts, turns] = gear.map(|g| g != [0.0; 3]);
    let mut length = 0.0;
    if shifts {
        length += dot(mul_mat_t_vec(frame, sub(site.1, base.1)), gear[0]);
    }
    if turns {
        length += dot(quat_difference(site_quat(m, kin, id), site_quat(m, kin, reference)), gear[1]);
    }
    let offsets = [com_offset(m, com, site.0, site.1), com_offset(m, com, base.0, base.1)];
    let mut entries = |dof: usize, end: usize, sign: f64| {
        let mut entry = 0.0;
        if shifts {
            entry += dot(scale(point_column(com, dof, offsets[end]), sign), force);
        }
        if turns {
            entry += dot(scale(rotational(&com.cdof[dof]), sign), torque);
        }
        rows.push_nonzero(dof, entry);
    };
    for (dof, end) in exclusive_dofs(m, site.0, base.0) {
        entries(dof, end, if end == 0 { 1.0 } else { -1.0 });
    }
    rows.finish_reversed(length);
}

/// Degrees of freedom that move only one of two bodies, and which.
fn exclusive_dofs(m: &Model, first: usize, second: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
    MergedChain::new(m, first, second)
        .take_while(|(_, moves)| !(moves[0] && moves[1]))
        .map(|(dof, moves)| (dof, usize::from(moves[1])))
}

/// Orientation that rotational site transmissions measure. The order of the factors is MuJoCo's.
fn site_quat(m: &Model, kin: &Kinematics, id: usize) -> Quat {
    quat_mul(m.site_quat[id], kin.xquat[m.site_bodyid[id] as usize])
}

/// Rotation vector of a ball joint: three outputs.
fn ball_rotation(m: &Model, state: &State, id: usize, rows: &mut Rows) {
    let vector = quat_to_velocity(joint_quat(state, m.jnt_qposadr[id] as usize), 1.0);
    let out = rows.out;
    for k in 0..3 {
        rows.begin(out + k);
        rows.push(m.jnt_dofadr[id] as usize + k, 1.0);
        rows.finish(vector[k]);
    }
}

/// Rotation vector of a site relative to a reference site: three outputs, moments in the frame of the site.
fn site_rotation(m: &Model, kin: &Kinematics, com: &Com, id: usize, reference: usize, rows: &mut Rows) {
    let vector = quat_difference(site_quat(m, kin, id), site_quat(m, kin, reference));
    let bodies = (m.site_bodyid[id] as usize, m.site_bodyid[reference] as usize);
    let out = rows.out;
    for k in 0..3 {
        rows.begin(out + k);
        let axis = column(&kin.site_xmat[id], k);
        for (dof, end) in exclusive_dofs(m, bodies.0, bodies.1) {
            let sign = if end == 0 { 1.0 } else { -1.0 };
            rows.push_nonzero(dof, dot(scale(rotational(&com.cdof[dof]), sign), axis));
        }
        rows.finish_reversed(vector[k]);
    }
}

/// Adhesion: the mean normal Jacobian of a body's contacts, pulling. The row is first spread over all degrees of
/// freedom, for which the model reserves room, then compressed.
fn body_adhesion(m: &Model, com: &Com, con: &Contacts, efc: &Constraints, id: usize, rows: &mut Rows) {
    let spread = &mut rows.trn.actuator_moment[rows.next..rows.next + m.nv];
    spread.fill(0.0);
    let of_body = |c: &&Contact| {
        c.geom.iter().all(|&g| g >= 0) && c.geom.iter().any(|&g| m.geom_bodyid[g as usize] as usize == id)
    };
    let mut count = 0;
    for c in con.contact.iter().filter(of_body).filter(|c| c.exclude == 0) {
        count += 1;
        add_contact_rows(m, c, efc, spread);
    }
    for c in con.contact.iter().filter(of_body).filter(|c| c.exclude == 1) {
        count += 1;
        add_normal(m, com, c, spread);
    }
    let factor = if count == 0 { 0.0 } else { -1.0 / f64::from(count) };
    for dof in 0..m.nv {
        let value = rows.trn.actuator_moment[rows.trn.moment_rowadr[rows.out] as usize + dof] * factor;
        rows.push_nonzero(dof, value);
    }
    rows.finish(0.0);
}

/// Adds the normal of an active contact: its first row, or the mean of its pyramid's edges.
fn add_contact_rows(m: &Model, c: &Contact, efc: &Constraints, sum: &mut [f64]) {
    let first = c.efc_address as usize;
    let (count, weight) = if c.dim == 1 || m.opt.cone == Cone::Elliptic {
        (1, 1.0)
    } else {
        (2 * (c.dim as usize - 1), 0.5 / f64::from(c.dim - 1))
    };
    for r in first..first + count {
        let start = efc.efc_J_rowadr[r] as usize;
        for k in start..start + efc.efc_J_rownnz[r] as usize {
            sum[efc.efc_J_colind[k] as usize] += efc.efc_J[k] * weight;
        }
    }
}

/// Adds the normal Jacobian of a contact that lies in the gap and has no rows.
fn add_normal(m: &Model, com: &Com, c: &Contact, sum: &mut [f64]) {
    let bodies = c.geom.map(|g| m.geom_bodyid[g as usize] as usize);
    let offsets = bodies.map(|b| com_offset(m, com, b, c.pos));
    let normal = row(&c.frame as &Mat3, 0);
    for (dof, moves) in MergedChain::new(m, bodies[0], bodies[1]) {
        let at = |end: usize| if moves[end] { point_column(com, dof, offsets[end]) } else { [0.0; 3] };
        sum[dof] += dot(normal, sub(at(1), at(0)));
    }
}
