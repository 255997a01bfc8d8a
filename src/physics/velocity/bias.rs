//! Inverse dynamics by recursive Newton-Euler: the force that makes given accelerations, and without them the bias
//! force of gravity, Coriolis and centrifugal effects (Featherstone 2008, section 5.3; Computation, "bias forces").

use crate::inertia::tendon_armature;
use crate::math::{
    Spatial, add_scaled, cross_force, dot, linear, mul_inertia, norm, scale, spatial, spatial_dot, sub,
};
use crate::model::NotSimulated;
use crate::model::{Disable, Model, ObjType, WrapType, bounds::MINVAL};
use crate::position::chain::{MergedChain, com_offset, point_column};
use crate::position::frame::Frame;
use crate::position::jacobian::point_column_rate;
use crate::position::tendon;
use crate::sleep::{Awake, object, over};
use crate::stages::{Com, Kinematics, State, Tendons, Velocity};
use crate::velocity::com_vel::{add_motion, dofs};

/// Working memory of recursive Newton-Euler: one entry a body.
#[derive(Clone, Debug, Default)]
pub struct RneScratch {
    acceleration: Vec<Spatial>,
    force: Vec<Spatial>,
}

/// Computes `qfrc_bias`, tendon armature included.
pub fn bias(
    m: &Model,
    state: &State,
    kin: &Kinematics,
    com: &Com,
    ten: &Tendons,
    vel: &mut Velocity,
    scratch: &mut RneScratch,
) {
    let mut force = std::mem::take(&mut vel.qfrc_bias);
    rne(m, state, com, vel, None, scratch, &mut force);
    tendon_bias(m, state, kin, com, ten, vel, &mut force);
    vel.qfrc_bias = force;
}

/// Acceleration of the world: minus gravity, so that weight needs no force of its own.
pub fn world_acceleration(m: &Model) -> Spatial {
    if m.opt.disableflags.contains(Disable::GRAVITY) {
        [0.0; 6]
    } else {
        spatial([0.0; 3], scale(m.opt.gravity, -1.0))
    }
}

/// Force that body `b` needs to accelerate by `acceleration` at velocity `cvel[b]`.
pub fn body_force(com: &Com, vel: &Velocity, b: usize, acceleration: &Spatial) -> Spatial {
    let mut force = mul_inertia(&com.cinert[b], acceleration);
    let gyroscopic = cross_force(&vel.cvel[b], &mul_inertia(&com.cinert[b], &vel.cvel[b]));
    for i in 0..6 {
        force[i] += gyroscopic[i];
    }
    force
}

/// Computes `M qacc + bias` into `out`; without `qacc` the bias alone.
pub fn rne(
    m: &Model,
    state: &State,
    com: &Com,
    vel: &Velocity,
    qacc: Option<&[f64]>,
    scratch: &mut RneScratch,
    out: &mut [f64],
) {
    let RneScratch { acceleration, force } = scratch;
    acceleration.resize(m.nbody, [0.0; 6]);
    force.resize(m.nbody, [0.0; 6]);
    acceleration[0] = world_acceleration(m);
    force[0] = [0.0; 6];
    let awake = Awake::of(m, state);
    over!(awake.bodies(m), |bodies| for b in bodies.skip(1) {
        let mut a = acceleration[m.body_parentid[b] as usize];
        add_motion(&vel.cdof_dot, &state.qvel, dofs(m, b), &mut a);
        if let Some(qacc) = qacc {
            add_motion(&com.cdof, qacc, dofs(m, b), &mut a);
        }
        force[b] = body_force(com, vel, b, &a);
        acceleration[b] = a;
    });
    // What fixed bodies carry moves nothing.
    over!(awake.bodies(m), |bodies| for b in bodies.rev() {
        let parent = m.body_parentid[b] as usize;
        if parent > 0 {
            let child = force[b];
            for i in 0..6 {
                force[parent][i] += child[i];
            }
        }
    });
    over!(awake.dofs(m), |dofs| for dof in dofs {
        out[dof] = spatial_dot(&com.cdof[dof], &force[m.dof_bodyid[dof] as usize]);
    });
}

/// Adds the bias that armature along tendons causes: `armature J' (dJ/dt qvel)`.
fn tendon_bias(
    m: &Model,
    state: &State,
    kin: &Kinematics,
    com: &Com,
    ten: &Tendons,
    vel: &Velocity,
    out: &mut [f64],
) {
    let awake = Awake::of(m, state);
    for t in 0..m.ntendon {
        let armature = tendon_armature(m, t);
        if armature == 0.0 || awake.skips(|state| object::tendon(m, state, t)) {
            continue;
        }
        let factor = armature * tendon_rate(m, state, kin, com, vel, t);
        for k in tendon::row(m, t) {
            out[m.ten_J_colind[k] as usize] += factor * ten.ten_J[k];
        }
    }
}

/// `dJ/dt qvel` of tendon `t`, the acceleration of its length at zero `qacc`. Zero for fixed tendons.
///
/// Not inlined, so that the addresses of its arrays are loaded only where tendons have armature.
#[inline(never)]
fn tendon_rate(m: &Model, state: &State, kin: &Kinematics, com: &Com, vel: &Velocity, t: usize) -> f64 {
    let first = m.tendon_adr[t] as usize;
    let last = first + m.tendon_num[t] as usize;
    let mut divisor = 1.0;
    let mut rate = 0.0;
    for w in first..last.saturating_sub(1) {
        if m.wrap_type[w] == WrapType::Pulley.code() {
            divisor = m.wrap_prm[w];
        }
        if m.wrap_type[w] == WrapType::Site.code() && m.wrap_type[w + 1] == WrapType::Site.code() {
            let sites = [m.wrap_objid[w] as usize, m.wrap_objid[w + 1] as usize];
            rate += segment_rate(m, state, kin, com, vel, sites) / divisor;
        }
    }
    rate
}

/// Acceleration, at zero `qacc`, of the distance between two sites.
fn segment_rate(
    m: &Model,
    state: &State,
    kin: &Kinematics,
    com: &Com,
    vel: &Velocity,
    sites: [usize; 2],
) -> f64 {
    let [a, b] = sites.map(|s| m.site_bodyid[s] as usize);
    let [p, q] = sites.map(|s| kin.site_xpos[s]);
    if a == b {
        return 0.0;
    }
    let velocity = |s: usize, body: usize| {
        linear(&Frame { body, pos: kin.site_xpos[s], mat: kin.site_xmat[s] }.velocity(m, com, &vel.cvel))
    };
    let span = sub(q, p);
    let length = norm(span);
    let unit = if length < MINVAL { [1.0, 0.0, 0.0] } else { scale(span, 1.0 / length) };
    let relative = sub(velocity(sites[1], b), velocity(sites[0], a));
    let across = add_scaled(relative, unit, -dot(unit, relative));
    let unit_rate = scale(across, if length > MINVAL { 1.0 / length } else { 0.0 });
    let (offset_a, offset_b) = (com_offset(m, com, a, p), com_offset(m, com, b, q));
    let mut rate = 0.0;
    for (dof, moves) in MergedChain::new(m, a, b) {
        let mut column = [0.0; 3];
        let mut column_rate = [0.0; 3];
        if moves[1] {
            column = point_column(com, dof, offset_b);
            column_rate = point_column_rate(m, com, vel, b, dof, offset_b);
        }
        if moves[0] {
            column = sub(column, point_column(com, dof, offset_a));
            column_rate = sub(column_rate, point_column_rate(m, com, vel, a, dof, offset_a));
        }
        rate += (dot(column_rate, unit) + dot(column, unit_rate)) * state.qvel[dof];
    }
    rate
}

/// Checks once that no tendon with armature wraps around a geom: its bias force is not defined in MuJoCo either.
///
/// # Errors
/// The first such tendon.
pub fn check(m: &Model) -> Result<(), NotSimulated> {
    let wraps = |t: usize| {
        let first = m.tendon_adr[t] as usize;
        m.wrap_type[first..first + m.tendon_num[t] as usize]
            .iter()
            .any(|&w| w == WrapType::Sphere.code() || w == WrapType::Cylinder.code())
    };
    match (0..m.ntendon).find(|&t| tendon_armature(m, t) != 0.0 && wraps(t)) {
        Some(t) => {
            Err(NotSimulated::of(m.label_of(ObjType::Tendon, t), "armature of a tendon that wraps a geom"))
        }
        None => Ok(()),
    }
}
