//! Equality rows: connect, weld, coupled joints and tendons, edges and strains of flexes (MuJoCo documentation, Computation,
//! "Equality"; XML reference, `equality`).

use super::friction_loss::tendon_row;
use super::jacobian_rate::jacobian_rates;
use super::rows::{RowKind, is_empty, push};
use super::scratch::ConstraintScratch;
use crate::flex::difference::{BodyPoint, Difference};
use crate::flex::modes::{StrainScratch, StrainedCell};
use crate::flex::{edges as flex_edges, springs};
use crate::math::{Quat, Vec3, add, mul_mat_vec, quat_conj, quat_mul, quat_mul_axis, scale, sub};
use crate::model::flex::Flex;
use crate::model::{ConstraintType, Disable, EqType, Model, ObjType};
use crate::sleep::{Awake, object};
use crate::stages::{Com, Configuration, Constraints, Flexes, Kinematics, Velocity};

/// Appends the rows of every active equality constraint.
pub(super) fn equality(
    m: &Model,
    at: &Configuration,
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    let Configuration { state, kin, com, flex, ten } = *at;
    if m.neq == 0 || m.opt.disableflags.contains(Disable::EQUALITY) {
        return;
    }
    let awake = Awake::of(m, state);
    let wanted = |eq: &usize| state.eq_active[*eq] && !awake.skips(|state| object::equality(m, state, *eq));
    for eq in (0..m.neq).filter(wanted) {
        match EqType::from_code(m.eq_type[eq]) {
            Some(EqType::Connect) => connect(m, kin, com, eq, efc, scratch),
            Some(EqType::Weld) => weld(m, kin, com, eq, efc, scratch),
            Some(EqType::Joint) => {
                let value = |joint: usize| {
                    let at = m.jnt_qposadr[joint] as usize;
                    state.qpos[at] - m.qpos0[at]
                };
                let row = |joint: usize| (&m.jnt_dofadr[joint..=joint], &[1.0][..]);
                coupling(m, eq, value, row, efc, scratch);
            }
            Some(EqType::Tendon) => {
                mark_tendons(m, eq, efc);
                let value = |tendon: usize| ten.ten_length[tendon] - m.tendon_length0[tendon];
                coupling(m, eq, value, |tendon| tendon_row(m, ten, tendon), efc, scratch);
            }
            Some(EqType::Flex) => edges(m, flex, eq, efc),
            Some(EqType::Flexvert) => vertices(m, flex, eq, efc),
            Some(EqType::Flexstrain) => strains(m, kin, com, eq, efc, &mut scratch.strain),
            // The compiler refuses distances.
            Some(EqType::Distance) | None => {}
        }
    }
}

fn row_kind(eq: usize) -> RowKind {
    RowKind { kind: ConstraintType::Equality, id: eq, margin: 0.0, frictionloss: 0.0 }
}

/// The two points that a connect or weld brings together.
fn anchors(m: &Model, kin: &Kinematics, eq: usize) -> [BodyPoint; 2] {
    let ids = [m.eq_obj1id[eq] as usize, m.eq_obj2id[eq] as usize];
    if m.eq_objtype[eq] == ObjType::Site.code() {
        return ids.map(|s| BodyPoint { body: m.site_bodyid[s] as usize, point: kin.site_xpos[s] });
    }
    let data = &m.eq_data[eq];
    let weld = m.eq_type[eq] == EqType::Weld.code();
    let local = |k: usize| -> Vec3 { std::array::from_fn(|i| data[3 * k + i]) };
    let anchor = |k: usize| {
        let (body, of) = (ids[k], if weld { 1 - k } else { k });
        BodyPoint { body, point: add(mul_mat_vec(&kin.xmat[body], local(of)), kin.xpos[body]) }
    };
    [anchor(0), anchor(1)]
}

/// Points of two bodies coincide: three rows.
fn connect(
    m: &Model,
    kin: &Kinematics,
    com: &Com,
    eq: usize,
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    let [a, b] = anchors(m, kin, eq);
    scratch.chain.difference(m, com, b, a, false);
    scratch.values.clear();
    for k in 0..3 {
        scratch.values.extend(scratch.chain.translation.iter().map(|v| v[k]));
    }
    push_block(m, eq, &sub(a.point, b.point), efc, &scratch.chain, &scratch.values);
}

/// Frames of two bodies coincide: three rows of position, three of orientation times the torque scale.
fn weld(
    m: &Model,
    kin: &Kinematics,
    com: &Com,
    eq: usize,
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    let [a, b] = anchors(m, kin, eq);
    let torquescale = m.eq_data[eq][10];
    scratch.chain.difference(m, com, b, a, false);
    scratch.values.clear();
    for k in 0..3 {
        scratch.values.extend(scratch.chain.translation.iter().map(|v| v[k]));
    }
    let [target, actual] = weld_frames(m, kin, eq, [a.body, b.body]);
    let inverse = quat_conj(actual);
    let error = quat_mul(inverse, target);
    for r in &mut scratch.chain.rotation {
        *r = scale(half_vector(quat_mul(quat_mul_axis(inverse, *r), target)), torquescale);
    }
    for k in 0..3 {
        scratch.values.extend(scratch.chain.rotation.iter().map(|v| v[k]));
    }
    let (p, r) = (sub(a.point, b.point), scale([error[1], error[2], error[3]], torquescale));
    push_block(m, eq, &[p[0], p[1], p[2], r[0], r[1], r[2]], efc, &scratch.chain, &scratch.values);
}

/// Orientations that a weld makes equal: of the first body moved by the relative pose, and of the second.
fn weld_frames(m: &Model, kin: &Kinematics, eq: usize, bodies: [usize; 2]) -> [Quat; 2] {
    if m.eq_objtype[eq] == ObjType::Site.code() {
        let sites = [m.eq_obj1id[eq] as usize, m.eq_obj2id[eq] as usize];
        [0, 1].map(|k| quat_mul(kin.xquat[bodies[k]], m.site_quat[sites[k]]))
    } else {
        [quat_mul(kin.xquat[bodies[0]], relative_orientation(m, eq)), kin.xquat[bodies[1]]]
    }
}

/// Orientation of the second body in the first that a weld of bodies holds.
fn relative_orientation(m: &Model, eq: usize) -> Quat {
    std::array::from_fn(|i| m.eq_data[eq][6 + i])
}

fn half_vector(q: Quat) -> Vec3 {
    [0.5 * q[1], 0.5 * q[2], 0.5 * q[3]]
}

fn push_block(m: &Model, eq: usize, pos: &[f64], efc: &mut Constraints, chain: &Difference, values: &[f64]) {
    if is_empty(m, values) {
        return;
    }
    for (pos, row) in pos.iter().zip(values.chunks_exact(chain.dof.len())) {
        push(efc, row_kind(eq), *pos, &chain.dof, row);
    }
}

/// A joint or tendon follows a quartic polynomial of another, or keeps a constant: one row. `value` is the offset
/// from the reference configuration, `row` the Jacobian.
fn coupling<'a>(
    m: &Model,
    eq: usize,
    value: impl Fn(usize) -> f64,
    row: impl Fn(usize) -> (&'a [i32], &'a [f64]),
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    let (first, data) = (m.eq_obj1id[eq] as usize, &m.eq_data[eq]);
    let (columns, values) = row(first);
    let Ok(second) = usize::try_from(m.eq_obj2id[eq]) else {
        if !is_empty(m, values) {
            push(efc, row_kind(eq), value(first) - data[0], columns, values);
        }
        return;
    };
    let x = value(second);
    let target = data[1] * x + data[2] * x * x + data[3] * x * x * x + data[4] * x * x * x * x;
    let slope = data[1] + 2.0 * data[2] * x + 3.0 * data[3] * x * x + 4.0 * data[4] * x * x * x;
    let pos = value(first) - data[0] - target;
    merge_rows((columns, values), row(second), -slope, &mut scratch.columns, &mut scratch.values);
    if !is_empty(m, &scratch.values) {
        push(efc, row_kind(eq), pos, &scratch.columns, &scratch.values);
    }
}

/// Sparse sum `a + s b` of rows with increasing columns.
fn merge_rows(
    a: (&[i32], &[f64]),
    b: (&[i32], &[f64]),
    s: f64,
    columns: &mut Vec<i32>,
    values: &mut Vec<f64>,
) {
    columns.clear();
    values.clear();
    let (mut i, mut j) = (0, 0);
    while i < a.0.len() || j < b.0.len() {
        let (ca, cb) = (a.0.get(i).copied().unwrap_or(i32::MAX), b.0.get(j).copied().unwrap_or(i32::MAX));
        columns.push(ca.min(cb));
        let mut value = 0.0;
        if ca <= cb {
            value = a.1[i];
            i += 1;
        }
        if cb <= ca {
            value += b.1[j] * s;
            j += 1;
        }
        values.push(value);
    }
}

/// Appends a row of a flex unless it acts on nothing.
fn push_flex(m: &Model, eq: usize, pos: f64, columns: &[i32], values: &[f64], efc: &mut Constraints) {
    if !is_empty(m, values) {
        push(efc, row_kind(eq), pos, columns, values);
    }
}

/// Edges of a flex keep their length: a row for each.
fn edges(m: &Model, flexes: &Flexes, eq: usize, efc: &mut Constraints) {
    for e in springs::moving_edges(Flex { m, id: m.eq_obj1id[eq] as usize }) {
        let (at, pos) = (flex_edges::row(m, e), flexes.flexedge_length[e] - m.flexedge_length0[e]);
        push_flex(m, eq, pos, &m.flexedge_J_colind[at.clone()], &flexes.flexedge_J[at], efc);
    }
}

/// A sheet is not strained at its vertices: two rows for each.
fn vertices(m: &Model, flexes: &Flexes, eq: usize, efc: &mut Constraints) {
    let (columns, values) = (m.flexvert_J_colind.as_flattened(), flexes.flexvert_J.as_flattened());
    for v in (Flex { m, id: m.eq_obj1id[eq] as usize }).vertices() {
        for k in 0..2 {
            let start = m.flexvert_J_rowadr[v][k] as usize;
            let at = start..start + m.flexvert_J_rownnz[v][k] as usize;
            push_flex(m, eq, flexes.flexvert_length[v][k], &columns[at.clone()], &values[at], efc);
        }
    }
}

/// A cell of an interpolated flex is not strained: a row for each mode of deformation.
fn strains(
    m: &Model,
    kin: &Kinematics,
    com: &Com,
    eq: usize,
    efc: &mut Constraints,
    memory: &mut StrainScratch,
) {
    if let Some(cell) = StrainedCell::new(m, eq) {
        cell.rows(kin, com, memory, |pos, columns, values| push_flex(m, eq, pos, columns, values, efc));
    }
}

/// Notes the constraint in `tendon_efcadr` of tendons that no earlier one has claimed.
fn mark_tendons(m: &Model, eq: usize, efc: &mut Constraints) {
    for tendon in [m.eq_obj1id[eq], m.eq_obj2id[eq]] {
        if tendon >= 0 && efc.tendon_efcadr[tendon as usize] == -1 {
            efc.tendon_efcadr[tendon as usize] = eq as i32;
        }
    }
}

/// Subtracts from the reference acceleration of connect and weld rows the acceleration `dJ/dt qvel` that their
/// points have by moving alone.
pub(super) fn subtract_jacobian_rate(
    m: &Model,
    at: &Configuration,
    vel: &Velocity,
    efc: &mut Constraints,
    scratch: &mut ConstraintScratch,
) {
    let kin = at.kin;
    let mut row = 0;
    while row < efc.ne {
        let eq = efc.efc_id[row] as usize;
        match EqType::from_code(m.eq_type[eq]) {
            Some(EqType::Connect | EqType::Weld) => {}
            _ => {
                row += 1;
                continue;
            }
        }
        let points = anchors(m, kin, eq);
        let [first, second] = jacobian_rates(m, at, vel, points, &mut scratch.movers);
        for k in 0..3 {
            efc.efc_aref[row + k] -= first.translation[k] - second.translation[k];
        }
        row += 3;
        if m.eq_type[eq] == EqType::Weld.code() {
            let rate =
                weld_rate(m, kin, vel, eq, points.map(|p| p.body), sub(first.rotation, second.rotation));
            for k in 0..3 {
                efc.efc_aref[row + k] -= rate[k];
            }
            row += 3;
        }
    }
}

/// Product rule over the orientation Jacobian of a weld, `½ q̄₁ (J₀ - J₁) q₀`, times the velocity;
/// `turn` is the rate of `J₀ - J₁` times the velocity.
fn weld_rate(m: &Model, kin: &Kinematics, vel: &Velocity, eq: usize, bodies: [usize; 2], turn: Vec3) -> Vec3 {
    let [target, actual] = weld_frames(m, kin, eq, bodies);
    let omega = bodies.map(|b| crate::math::rotational(&vel.cvel[b]));
    let relative = sub(omega[0], omega[1]);
    let rate = |q: Quat, w: Vec3| quat_mul([0.0, w[0], w[1], w[2]], q).map(|x| 0.5 * x);
    let (inverse, inverse_rate) = (quat_conj(actual), quat_conj(rate(actual, omega[1])));
    let target_rate = if m.eq_objtype[eq] == ObjType::Site.code() {
        rate(target, omega[0])
    } else {
        quat_mul(rate(kin.xquat[bodies[0]], omega[0]), relative_orientation(m, eq))
    };
    let product = |q, v, p| quat_mul(quat_mul_axis(q, v), p);
    let terms = [
        product(inverse_rate, relative, target),
        product(inverse, turn, target),
        product(inverse, relative, target_rate),
    ];
    let sum = |k: usize| 0.5 * (terms[0][k] + terms[1][k] + terms[2][k]) * m.eq_data[eq][10];
    [sum(1), sum(2), sum(3)]
}
