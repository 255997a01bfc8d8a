//! Single stages of a step by MuJoCo's names, for programs that put a pass together themselves.

use super::call::change;
use super::data::Data;
use super::error::Fault;
use super::model::Model;
use numpy::PyArray1;
use physics::acceleration::rne_post::rne_post_constraint;
use physics::actuation::actuation;
use physics::actuation::transmission::transmission;
use physics::collision::collide;
use physics::constraint::{find_islands, make_constraint, reference};
use physics::data::Configuration;
use physics::flex::flexes;
use physics::inertia::{factor_inertia, make_inertia};
use physics::model::Model as Compiled;
use physics::on_demand::{energy, momentum};
use physics::pipeline::forward::{
    Known, acceleration_sensors, constrained_acceleration, position, position_sensors,
    unconstrained_acceleration, velocity, velocity_sensors,
};
use physics::pipeline::integrate::{Factors, euler, implicit, runge_kutta};
use physics::pipeline::inverse::{compare_with_forward, inverse_after};
use physics::position::{camera, com, kinematics, tendon};
use physics::solver::{constraint_force, force_at};
use physics::velocity::{bias, com_vel, passive};
use pyo3::prelude::*;

/// Runs the stage called `name`.
#[pyfunction]
pub fn stage(py: Python<'_>, m: &Bound<'_, Model>, d: &Bound<'_, Data>, name: &str) -> PyResult<()> {
    change(py, m, d, |m, d| {
        if position_stage(m, d, name)? || motion_stage(m, d, name)? {
            return Ok(());
        }
        Err(Fault::Value(format!("there is no stage {name:?}")))
    })
}

/// Configuration of `$d`; other parts of `$d` may be borrowed at the same time.
macro_rules! configuration {
    ($d:expr) => {
        Configuration { state: &$d.state, kin: &$d.kin, com: &$d.com, flex: &$d.flex, ten: &$d.ten }
    };
}

/// Stages that depend on positions; false when there is none of that name.
fn position_stage(m: &Compiled, d: &mut physics::Data, name: &str) -> Result<bool, Fault> {
    match name {
        "kinematics" => kinematics::kinematics(m, &d.state, &mut d.kin),
        "comPos" => com::com_pos(m, &d.kin, &mut d.com),
        "camlight" => camera::cameras_and_lights(m, &d.com, &mut d.kin),
        "fwdKinematics" => {
            kinematics::kinematics(m, &d.state, &mut d.kin);
            com::com_pos(m, &d.kin, &mut d.com);
            camera::cameras_and_lights(m, &d.com, &mut d.kin);
            flexes(m, &d.kin, &d.com, &mut d.flex, &mut d.scratch.flex);
            tendon::tendon(m, &d.state, &d.kin, &d.com, &mut d.ten);
        }
        "flex" => flexes(m, &d.kin, &d.com, &mut d.flex, &mut d.scratch.flex),
        "tendon" => tendon::tendon(m, &d.state, &d.kin, &d.com, &mut d.ten),
        "makeM" => make_inertia(m, &d.com, &d.ten, &mut d.inertia),
        "factorM" => factor_inertia(m, &mut d.inertia),
        "collision" => collide(m, &d.kin, &d.flex, d.budget, &mut d.scratch.collision, &mut d.con)
            .map_err(physics::StepError::from)?,
        "makeConstraint" => {
            d.budget.check_rows(m, &d.con).map_err(physics::StepError::from)?;
            let at = configuration!(d);
            make_constraint(m, &at, &d.inertia, &mut d.con, &mut d.efc, &mut d.scratch.constraint);
        }
        "island" => find_islands(m, &d.state, &d.con, &d.efc, &mut d.island, &mut d.scratch.island),
        "transmission" => transmission(m, &configuration!(d), &d.con, &d.efc, &mut d.trn),
        "fwdPosition" => position(m, d, &mut ())?,
        "sensorPos" => position_sensors(m, d),
        "energyPos" => d.energy[0] = energy::potential(m, &configuration!(d)),
        _ => return Ok(false),
    }
    Ok(true)
}

/// Stages that depend on velocities, forces and accelerations; false when there is none of that name.
fn motion_stage(m: &Compiled, d: &mut physics::Data, name: &str) -> Result<bool, Fault> {
    match name {
        "comVel" => com_vel::com_vel(m, &d.state, &d.com, &mut d.vel),
        "passive" => {
            let at = configuration!(d);
            passive::passive(m, &at, &d.con, &d.vel, (&d.metric, &mut d.scratch.flex), &mut d.passive);
        }
        "referenceConstraint" => {
            let at = configuration!(d);
            reference(m, &at, &d.vel, &d.con, &mut d.efc, &mut d.scratch.constraint);
        }
        "fwdVelocity" => velocity(m, d, &mut ()),
        "sensorVel" => velocity_sensors(m, d),
        "energyVel" => {
            d.energy[1] = energy::kinetic(m, &d.state, &d.inertia, &mut Vec::new());
        }
        "subtreeVel" => momentum::subtree_momentum(m, &d.state, &d.kin, &d.com, &d.vel, &mut d.sensor),
        "fwdActuation" => actuation(m, &d.state, &d.trn, &d.vel, &d.passive, &mut d.actuation),
        "fwdAcceleration" => unconstrained_acceleration(m, d),
        "fwdConstraint" => constrained_acceleration(m, d),
        "invConstraint" => constraint_force(m, &d.con, &mut d.efc, &mut d.acc, &mut d.scratch.solver),
        "sensorAcc" => acceleration_sensors(m, d),
        "rnePostConstraint" => {
            rne_post_constraint(m, &configuration!(d), &d.vel, &d.con, &d.efc, &d.acc, &mut d.sensor);
        }
        "compareFwdInv" => compare_with_forward(m, d)?,
        "Euler" => euler(m, d, Factors::Fresh),
        "implicit" => implicit(m, d, Factors::Fresh),
        "RungeKutta" => runge_kutta(m, d, &mut ())?,
        _ => return Ok(false),
    }
    Ok(true)
}

/// Forces that bodies need at the present velocity, and, where asked for, acceleration.
#[pyfunction]
pub fn newton_euler<'py>(
    py: Python<'py>,
    m: &Bound<'py, Model>,
    d: &Bound<'py, Data>,
    with_acceleration: bool,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let forces = change(py, m, d, |m, d| {
        let mut forces = vec![0.0; m.nv];
        let qacc = with_acceleration.then_some(&d.acc.qacc[..]);
        bias::rne(m, &d.state, &d.com, &d.vel, qacc, &mut d.scratch.rne, &mut forces);
        Ok(forces)
    })?;
    Ok(PyArray1::from_vec(py, forces))
}

/// Inverse dynamics without the stages before `skipstage` (`mjtStage`), with or without sensors.
#[pyfunction]
pub fn inverse_skip(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    skipstage: i64,
    sensors: bool,
) -> PyResult<()> {
    let known = match skipstage {
        ..=0 => Known::Nothing,
        1 => Known::Position,
        2.. => Known::Velocity,
    };
    change(py, m, d, |m, d| Ok(inverse_after(m, d, known, sensors)?))
}

/// Constraint forces and states at these residuals, one a row.
#[pyfunction]
pub fn forces_at(
    py: Python<'_>,
    m: &Bound<'_, Model>,
    d: &Bound<'_, Data>,
    residual: Vec<f64>,
) -> PyResult<()> {
    change(py, m, d, |_, d| {
        if residual.len() != d.efc.nefc {
            return Err(Fault::Value(format!("{} residuals of {} rows", residual.len(), d.efc.nefc)));
        }
        force_at(&residual, &d.con, &mut d.efc, &mut d.acc, &mut d.scratch.solver);
        Ok(())
    })
}
