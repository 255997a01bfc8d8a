//! Forward dynamics: the order of all stages (MuJoCo documentation, Computation, "Forward
//! dynamics" and "Simulation pipeline").
//!
//! ```
//! use robohive_physics::{Data, forward};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><geom name='floor' type='plane' size='1 1 1'/><body name='ball' pos='0 0 2'><freejoint/><geom name='ball' size='.1' mass='1'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut data = Data::new(&model);
//! forward(&model, &mut data)?;
//! assert_eq!((data.acc.qacc[2], data.time()), (-9.81, 0.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::acceleration::rne_post::rne_post_constraint;
use crate::actuation::actuation;
use crate::actuation::transmission::{actuator_velocity, transmission};
use crate::collision::filter::{ByType, PairFilter};
use crate::collision::{World, collide_filtered};
use crate::constraint::{find_islands, make_constraint, reference};
use crate::data::{Data, configuration_of};
use crate::flex::{Poses, edge_velocities, flexes};
use crate::inertia::{factor_inertia_of, make_inertia_of, solve, solve_of};
use crate::model::{Enable, Model};
use crate::pipeline::error::StepError;
use crate::pipeline::watch::{Stage, Watch};
use crate::position::camera::cameras_and_lights;
use crate::position::com::com_pos_of;
use crate::position::jacobian::apply_user_wrenches;
use crate::position::kinematics::{kinematics, kinematics_of_awake};
use crate::position::tendon::{tendon, tendon_velocity};
use crate::sensor::{self, AccelerationInputs, Past, PositionInputs, VelocityInputs};
use crate::sleep::{self, Awake, MOVED, Subset, over, update, wake};
use crate::velocity::bias::bias;
use crate::velocity::com_vel::com_vel;
use crate::velocity::passive::passive;
use crate::{on_demand::energy, solver};

/// Computes everything that follows from the state and the inputs, up to accelerations and sensors.
///
/// # Errors
/// Contacts and constraint rows need more memory than `Data::budget`.
pub fn forward(m: &Model, d: &mut Data) -> Result<(), StepError> {
    evaluate(m, d, true, &mut ())
}

/// [`forward`] right after [`step1`](crate::step1), with nothing written in between but inputs: what depends on positions and velocities
/// alone is kept.
pub fn forward_after_step1(m: &Model, d: &mut Data) {
    acceleration(m, d, &mut ());
    acceleration_sensors(m, d);
}

/// What of the last evaluation still holds.
#[doc(hidden)]
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum Known {
    /// Nothing.
    Nothing,
    /// All that depends on positions alone.
    Position,
    /// All that does not depend on inputs.
    Velocity,
}

/// `forward`, with or without sensors.
pub(crate) fn evaluate(
    m: &Model,
    d: &mut Data,
    sensors: bool,
    watch: &mut impl Watch,
) -> Result<(), StepError> {
    evaluate_after(m, d, Known::Nothing, sensors, watch)
}

pub(crate) fn evaluate_after(
    m: &Model,
    d: &mut Data,
    known: Known,
    sensors: bool,
    watch: &mut impl Watch,
) -> Result<(), StepError> {
    position_and_velocity(m, d, known, sensors, watch)?;
    acceleration(m, d, watch);
    if sensors {
        acceleration_sensors(m, d);
        watch.ended(Stage::Sensors);
    }
    Ok(())
}

/// What depends on the state alone and is not known yet, with or without sensors.
pub(crate) fn position_and_velocity(
    m: &Model,
    d: &mut Data,
    known: Known,
    sensors: bool,
    watch: &mut impl Watch,
) -> Result<(), StepError> {
    if known < Known::Position {
        position(m, d, watch)?;
        if sensors {
            position_sensors(m, d);
            watch.ended(Stage::Sensors);
        }
    }
    if known < Known::Velocity {
        velocity(m, d, watch);
        if sensors {
            velocity_sensors(m, d);
            watch.ended(Stage::Sensors);
        }
    }
    Ok(())
}

/// What depends on positions: poses, inertia, contacts, constraint rows, lengths.
///
/// # Errors
/// Contacts and constraint rows need more memory than the budget.
#[doc(hidden)]
pub fn position(m: &Model, d: &mut Data, watch: &mut impl Watch) -> Result<(), StepError> {
    position_of_pairs(m, d, &mut ByType, watch)
}

/// [`position`] with contacts of those pairs of geoms that `filter` admits.
///
/// # Errors
/// As [`position`].
#[doc(hidden)]
pub fn position_of_pairs(
    m: &Model,
    d: &mut Data,
    filter: &mut impl PairFilter,
    watch: &mut impl Watch,
) -> Result<(), StepError> {
    if d.unsettled {
        settle(m, d)?;
    }
    let (s, sleeps) = (&mut d.scratch, sleep::is_on(m));
    if sleeps || d.state.ntree_awake < m.ntree {
        kinematics_of_awake(m, &mut d.state, &mut d.kin);
    } else {
        kinematics(m, &d.state, &mut d.kin);
    }
    let awake = Awake::of(m, &d.state);
    com_pos_of(m, awake, &d.kin, &mut d.com);
    cameras_and_lights(m, &d.com, &mut d.kin);
    flexes(m, &d.kin, &d.com, &mut d.flex, &mut s.flex);
    watch.ended(Stage::Kinematics);
    tendon(m, &d.state, &d.kin, &d.com, &mut d.ten);
    if sleeps {
        wake::by_tendons(m, &d.ten, &mut d.state);
    }
    watch.ended(Stage::Tendons);
    let awake = Awake::of(m, &d.state);
    make_inertia_of(m, awake, &d.com, &d.ten, &mut d.inertia);
    factor_inertia_of(m, awake, &mut d.inertia);
    watch.ended(Stage::Inertia);
    let world = World { m, kin: &d.kin, flexes: &d.flex };
    collide_filtered(world, &d.state, filter, d.budget, &mut s.collision, &mut d.con)?;
    if sleeps {
        if wake::by_contacts(m, &d.con, &mut d.state) {
            collide_filtered(world, &d.state, filter, d.budget, &mut s.collision, &mut d.con)?;
        }
        wake::by_equalities(m, &mut d.state);
    }
    d.budget.check_rows(m, &d.con)?;
    watch.ended(Stage::Collision);
    let at = configuration_of!(d);
    make_constraint(m, &at, &d.inertia, &mut d.con, &mut d.efc, &mut s.constraint);
    watch.ended(Stage::Constraint);
    find_islands(m, &d.state, &d.con, &d.efc, &mut d.island, &mut s.island);
    d.budget.check_solver(m, &d.con, &d.efc, &d.island)?;
    watch.ended(Stage::Islands);
    transmission(m, &at, &d.con, &d.efc, &mut d.trn);
    watch.ended(Stage::Transmission);
    if m.nflex > 0 {
        d.metric.build(
            m,
            Poses { kin: &d.kin, com: &d.com },
            &d.inertia,
            &mut d.con,
            &mut d.flex,
            &mut d.scratch.flex,
        );
    }
    Ok(())
}

/// Computes what stages keep of sleeping trees, where a state has come from elsewhere.
///
/// # Errors
/// As [`forward`].
fn settle(m: &Model, d: &mut Data) -> Result<(), StepError> {
    d.unsettled = false;
    let asleep = d.state.tree_asleep.clone();
    d.state.tree_asleep.fill(MOVED);
    update(m, &mut d.state);
    let result = forward(m, d);
    d.state.tree_asleep = asleep;
    update(m, &mut d.state);
    result
}

/// What depends on velocities too: passive and bias forces, and the acceleration that constraints ask for.
#[doc(hidden)]
pub fn velocity(m: &Model, d: &mut Data, watch: &mut impl Watch) {
    if m.nflex > 0 {
        edge_velocities(m, &d.state, &d.flex, &mut d.vel.flexedge_velocity);
    }
    tendon_velocity(m, &d.state, &d.ten, &mut d.vel.ten_velocity);
    actuator_velocity(m, &d.state, &d.trn, &mut d.vel);
    com_vel(m, &d.state, &d.com, &mut d.vel);
    let flexes = (&d.metric, &mut d.scratch.flex);
    passive(m, &configuration_of!(d), &d.con, &d.vel, flexes, &mut d.passive);
    if d.metric.is_on() {
        d.metric.set_shift(m, Poses { kin: &d.kin, com: &d.com }, &d.flex, &d.state.qvel);
    }
    reference(m, &configuration_of!(d), &d.vel, &d.con, &mut d.efc, &mut d.scratch.constraint);
    bias(m, &d.state, &d.kin, &d.com, &d.ten, &mut d.vel, &mut d.scratch.rne);
    watch.ended(Stage::Velocity);
}

/// What depends on inputs too: actuation, and accelerations without and with constraints.
pub(crate) fn acceleration(m: &Model, d: &mut Data, watch: &mut impl Watch) {
    actuation(m, &d.state, &d.trn, &d.vel, &d.passive, &mut d.actuation);
    watch.ended(Stage::Actuation);
    unconstrained_acceleration(m, d);
    watch.ended(Stage::Acceleration);
    constrained_acceleration(m, d);
    watch.ended(Stage::Solver);
}

/// Acceleration without constraints, of the forces of actuators, springs, users and inertia.
#[doc(hidden)]
#[inline]
pub fn unconstrained_acceleration(m: &Model, d: &mut Data) {
    let awake = Awake::of(m, &d.state).dofs(m);
    over!(awake, |dofs| for dof in dofs {
        d.acc.qfrc_smooth[dof] = d.passive.qfrc_passive[dof] - d.vel.qfrc_bias[dof]
            + d.state.qfrc_applied[dof]
            + d.actuation.qfrc_actuator[dof];
    });
    apply_user_wrenches(m, &d.kin, &d.com, &d.state.xfrc_applied, &mut d.acc.qfrc_smooth);
    match awake {
        Subset::All(_) => {
            d.acc.qacc_smooth.copy_from_slice(&d.acc.qfrc_smooth);
            if d.metric.is_on() {
                let poses = Poses { kin: &d.kin, com: &d.com };
                d.metric.accelerate(m, poses, &d.flex, &d.inertia, &mut d.acc.qacc_smooth);
            } else {
                solve(m, &d.inertia, &mut d.acc.qacc_smooth);
            }
        }
        Subset::Listed(dofs) => {
            for dof in dofs.iter().map(|&dof| dof as usize) {
                d.acc.qacc_smooth[dof] = d.acc.qfrc_smooth[dof];
            }
            solve_of(m, dofs, &d.inertia.qLD, &d.inertia.qLDiagInv, &mut d.acc.qacc_smooth);
        }
    }
}

/// What depends on velocities and inputs, with sensors, where positions have not changed.
pub(crate) fn after_position(m: &Model, d: &mut Data) {
    velocity(m, d, &mut ());
    velocity_sensors(m, d);
    acceleration(m, d, &mut ());
    acceleration_sensors(m, d);
}

/// Forces of the constraints, and the acceleration with them.
#[doc(hidden)]
#[inline]
pub fn constrained_acceleration(m: &Model, d: &mut Data) {
    let poses = Poses { kin: &d.kin, com: &d.com };
    let inputs = solver::SolverInputs {
        m,
        state: &d.state,
        inertia: &d.inertia,
        effective: d.metric.is_on().then(|| d.metric.effective(m, poses, &d.flex, &d.inertia)),
        con: &d.con,
        island: &d.island,
    };
    solver::solve(inputs, &mut d.efc, &mut d.acc, &mut d.solver, &mut d.scratch.solver);
}

#[doc(hidden)]
pub fn position_sensors(m: &Model, d: &mut Data) {
    let inputs = PositionInputs {
        state: &d.state,
        kin: &d.kin,
        com: &d.com,
        flex: &d.flex,
        ten: &d.ten,
        trn: &d.trn,
        inertia: &d.inertia,
        efc: &d.efc,
    };
    let past = Past { state: &d.state };
    sensor::position_sensors(m, &inputs, past, &mut d.scratch.sensor, &mut d.sensor);
    let on = m.opt.enableflags.contains(Enable::ENERGY);
    d.energy = [if on { energy::potential(m, &configuration_of!(d)) } else { 0.0 }, 0.0];
}

#[doc(hidden)]
pub fn velocity_sensors(m: &Model, d: &mut Data) {
    let inputs =
        VelocityInputs { state: &d.state, kin: &d.kin, com: &d.com, trn: &d.trn, vel: &d.vel, efc: &d.efc };
    let past = Past { state: &d.state };
    sensor::velocity_sensors(m, &inputs, past, &mut d.scratch.sensor, &mut d.sensor);
    if m.opt.enableflags.contains(Enable::ENERGY) {
        d.energy[1] = energy::kinetic(m, &d.state, &d.inertia, &mut d.scratch.sensor.momentum);
    }
}

#[doc(hidden)]
pub fn acceleration_sensors(m: &Model, d: &mut Data) {
    if sensor::needs_body_forces(m) {
        rne_post_constraint(m, &configuration_of!(d), &d.vel, &d.con, &d.efc, &d.acc, &mut d.sensor);
    }
    let inputs = AccelerationInputs {
        state: &d.state,
        kin: &d.kin,
        com: &d.com,
        con: &d.con,
        efc: &d.efc,
        vel: &d.vel,
        actuation: &d.actuation,
    };
    let past = Past { state: &d.state };
    sensor::acceleration_sensors(m, &inputs, past, &mut d.scratch.sensor, &mut d.sensor);
}
