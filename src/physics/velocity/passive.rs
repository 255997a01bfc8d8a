//! Passive forces: springs, dampers, gravity compensation, fluid, adhesion (documentation: Computation,
//! "Passive forces").

use crate::flex::{FlexScratch, Metric, bending, cells, shell, springs, stretch, weights};
use crate::math::Polynomial;
use crate::math::{Vec3, dot, norm, quat_difference, quat_normalize, row, scale, sub};
use crate::model::flex::Flex;
use crate::model::reflected_load::{dof_damping, tendon_damping};
use crate::model::{Capability, PassiveInputs};
use crate::model::{Disable, JointType, Model};
use crate::position::chain::{MergedChain, apply_wrench, com_offset, point_column};
use crate::position::tendon;
use crate::sleep::{Awake, Subset, object, over};
use crate::stages::{
    Com, Configuration, Contact, Contacts, Flexes, Kinematics, Passive, State, Tendons, Velocity,
};
use crate::velocity::fluid;

/// Computes all passive forces and their sum. Disabling both springs and dampers disables every passive force.
pub fn passive(
    m: &Model,
    at: &Configuration,
    con: &Contacts,
    vel: &Velocity,
    (metric, scratch): (&Metric, &mut FlexScratch),
    out: &mut Passive,
) {
    let Configuration { state, kin, com, .. } = *at;
    let awake = Awake::of(m, state);
    let disabled = |flag: Disable| m.opt.disableflags.contains(flag);
    let (springs, dampers) = (!disabled(Disable::SPRING), !disabled(Disable::DAMPER));
    let added = [&mut out.qfrc_spring, &mut out.qfrc_gravcomp, &mut out.qfrc_fluid, &mut out.qfrc_adhesion];
    clear(awake.dofs(m), added);
    if !dampers {
        clear(awake.dofs(m), [&mut out.qfrc_damper]);
    }
    if !springs && !dampers {
        clear(awake.dofs(m), [&mut out.qfrc_passive]);
        return;
    }
    if springs {
        let springs = (0..m.njnt).filter(|&j| !awake.sleeps(m.jnt_bodyid[j] as usize));
        springs.for_each(|j| joint_spring(m, state, j, &mut out.qfrc_spring));
    }
    if dampers {
        over!(awake.dofs(m), |dofs| for dof in dofs {
            let (law, v) = (dof_damping(m, dof), state.qvel[dof]);
            out.qfrc_damper[dof] = if law.is_zero() { 0.0 } else { -v * law.at(v.abs()) };
        });
    }
    if m.nflex > 0 {
        flexes(m, at, vel, [springs, dampers], scratch, out);
    }
    tendons(m, at, vel, springs, dampers, out);
    if metric.is_on() {
        metric.touches.add_forces(con, &mut out.qfrc_spring);
    }
    let compensates = has_gravity_compensation(m);
    if compensates {
        gravity_compensation(m, awake, kin, com, &mut out.qfrc_gravcomp);
    }
    let wet = m.opt.viscosity != 0.0 || m.opt.density != 0.0;
    if wet {
        fluid::fluid(m, awake, kin, com, vel, &mut out.qfrc_fluid);
    }
    if m.flg_adhesion && !disabled(Disable::CONTACT) {
        adhesion(m, com, at.flex, con, scratch, &mut out.qfrc_adhesion);
    }
    over!(awake.dofs(m), |dofs| for dof in dofs {
        let by_actuator = m.jnt_actgravcomp[m.dof_jntid[dof] as usize];
        let mut sum =
            out.qfrc_spring[dof] + out.qfrc_damper[dof] + out.qfrc_fluid[dof] + out.qfrc_adhesion[dof];
        if !by_actuator {
            sum += out.qfrc_gravcomp[dof];
        }
        out.qfrc_passive[dof] = sum;
    });
    if m.nplugin > 0 {
        let inputs = PassiveInputs { m, at: *at, con, vel };
        for (_, running) in m.plugins().with(Capability::Passive) {
            running.instance.passive(&inputs, &mut out.qfrc_passive);
        }
    }
}

/// Clears forces on degrees of freedom.
fn clear<const N: usize>(dofs: Subset, forces: [&mut Vec<f64>; N]) {
    match dofs {
        Subset::All(_) => forces.into_iter().for_each(|f| f.fill(0.0)),
        Subset::Listed(dofs) => {
            forces.into_iter().for_each(|f| dofs.iter().for_each(|&dof| f[dof as usize] = 0.0));
        }
    }
}

/// Elasticity of flexes, then springs and dampers along their edges.
fn flexes(
    m: &Model,
    at: &Configuration,
    vel: &Velocity,
    with: [bool; 2],
    scratch: &mut FlexScratch,
    out: &mut Passive,
) {
    let inputs = stretch::Inputs { kin: at.kin, com: at.com, flexes: at.flex, vel };
    for flex in Flex::all(m).filter(|flex| flex.dim() > 1 && !m.flex_rigid[flex.id]) {
        if flex.is_interpolated() {
            cells::cells(flex, inputs, with, scratch, out);
            shell::shell(flex, inputs, with[0], scratch, out);
        } else {
            bending::bending(flex, at.kin, at.flex, &at.state.qvel, with, out);
            stretch::stretch(flex, inputs, scratch, &mut out.qfrc_spring);
        }
    }
    springs::edge_springs(m, at.flex, vel, with, out);
}

/// Force of the spring of joint `j`: towards `qpos_spring`, along the shortest rotation for ball and free joints.
fn joint_spring(m: &Model, state: &State, j: usize, qfrc: &mut [f64]) {
    let law = Polynomial { linear: m.jnt_stiffness[j], poly: m.jnt_stiffnesspoly[j] };
    if law.is_zero() {
        return;
    }
    let (q, v) = (m.jnt_qposadr[j] as usize, m.jnt_dofadr[j] as usize);
    let mut pull = |at: usize, deflection: Vec3| {
        let force = scale(deflection, -law.at(norm(deflection)));
        (0..3).for_each(|k| qfrc[at + k] += force[k]);
    };
    match JointType::from_code(m.jnt_type[j]) {
        Some(JointType::Free) => {
            pull(v, shift(m, state, q));
            pull(v + 3, turn(m, state, q + 3));
        }
        Some(JointType::Ball) => pull(v, turn(m, state, q)),
        Some(JointType::Slide | JointType::Hinge) | None => {
            let x = state.qpos[q] - m.qpos_spring[q];
            qfrc[v] = -x * law.at(x);
        }
    }
}

/// Displacement of the free joint with position at `q` from its spring reference.
pub(crate) fn shift(m: &Model, state: &State, q: usize) -> Vec3 {
    std::array::from_fn(|k| state.qpos[q + k] - m.qpos_spring[q + k])
}

/// Rotation vector from the spring reference to the quaternion at `q`.
pub(crate) fn turn(m: &Model, state: &State, q: usize) -> Vec3 {
    let now = quat_normalize(std::array::from_fn(|k| state.qpos[q + k]));
    quat_difference(now, std::array::from_fn(|k| m.qpos_spring[q + k]))
}

/// How far tendon `t` is outside the range of lengths in which its spring is slack.
pub(crate) fn tendon_stretch(m: &Model, ten: &Tendons, t: usize) -> f64 {
    let (length, [lower, upper]) = (ten.ten_length[t], m.tendon_lengthspring[t]);
    if length > upper {
        length - upper
    } else if length < lower {
        length - lower
    } else {
        0.0
    }
}

fn tendons(m: &Model, at: &Configuration, vel: &Velocity, springs: bool, dampers: bool, out: &mut Passive) {
    let (ten, awake) = (at.ten, Awake::of(m, at.state));
    for t in (0..m.ntendon).filter(|&t| awake.has_awake(|state| object::tendon(m, state, t))) {
        let stiffness = Polynomial { linear: m.tendon_stiffness[t], poly: m.tendon_stiffnesspoly[t] };
        let (x, v) = (tendon_stretch(m, ten, t), vel.ten_velocity[t]);
        let spring = if springs { -x * stiffness.at(x) } else { 0.0 };
        let damper = if dampers { -v * tendon_damping(m, t).at(v.abs()) } else { 0.0 };
        if spring == 0.0 && damper == 0.0 {
            continue;
        }
        for k in tendon::row(m, t) {
            let dof = m.ten_J_colind[k] as usize;
            out.qfrc_spring[dof] += ten.ten_J[k] * spring;
            out.qfrc_damper[dof] += ten.ten_J[k] * damper;
        }
    }
}

/// True when gravity is on and some body compensates for it.
pub(crate) fn has_gravity_compensation(m: &Model) -> bool {
    m.flg_gravcomp && !m.opt.disableflags.contains(Disable::GRAVITY) && norm(m.opt.gravity) != 0.0
}

/// Force that carries the share `body_gravcomp` of each body's weight.
fn gravity_compensation(m: &Model, awake: Awake, kin: &Kinematics, com: &Com, qfrc: &mut [f64]) {
    for b in 1..m.nbody {
        if m.body_gravcomp[b] != 0.0 && !awake.sleeps(b) {
            let force = scale(m.opt.gravity, -(m.body_mass[b] * m.body_gravcomp[b]));
            apply_wrench(m, com, b, kin.xipos[b], force, [0.0; 3], qfrc);
        }
    }
}

/// Constant attraction of adhesive contacts along their normals.
fn adhesion(
    m: &Model,
    com: &Com,
    flexes: &Flexes,
    con: &Contacts,
    scratch: &mut FlexScratch,
    qfrc: &mut [f64],
) {
    for c in con.contact.iter().filter(|c| c.adhesion != 0.0 && c.exclude <= 1) {
        let Some(bodies) = weights::single_bodies(m, c) else {
            weighted_adhesion(m, com, flexes, c, scratch, qfrc);
            continue;
        };
        let offsets = bodies.map(|b| com_offset(m, com, b, c.pos));
        for (dof, moves) in MergedChain::new(m, bodies[0], bodies[1]) {
            let at = |end: usize| if moves[end] { point_column(com, dof, offsets[end]) } else { [0.0; 3] };
            qfrc[dof] += dot(row(&c.frame, 0), sub(at(1), at(0))) * -c.adhesion;
        }
    }
}

/// Attraction of a contact with an element of a flex, which several bodies share.
fn weighted_adhesion(
    m: &Model,
    com: &Com,
    flexes: &Flexes,
    c: &Contact,
    scratch: &mut FlexScratch,
    qfrc: &mut [f64],
) {
    let (bodies, sum) = scratch.of_contact();
    sum.of_contact(m, com, flexes, c, bodies);
    for (&dof, &column) in sum.dof.iter().zip(&sum.translation) {
        qfrc[dof as usize] += dot(row(&c.frame, 0), column) * -c.adhesion;
    }
}
