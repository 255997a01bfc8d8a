//! Everything that changes while a model moves, grouped by the stage that writes it.

mod configuration;
mod constraints;
mod scratch;
mod stages;

pub use configuration::Configuration;
pub(crate) use configuration::configuration_of;
pub use constraints::{Constraints, Contact, Contacts, Islands, SolverStat, SolverStatistics};
pub use scratch::Scratch;
pub use stages::*;

use crate::actuation::history;
use crate::model::Model;
use crate::table::Slice;

/// State, stage outputs and scratch memory of one simulation.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// Simulation time [s].
    pub time: f64,
    /// Potential and kinetic energy [J].
    pub energy: [f64; 2],
    /// State and inputs.
    pub state: State,
    /// Global poses.
    pub kin: Kinematics,
    /// Centres of mass, motion axes, inertias about them.
    pub com: Com,
    /// Tendon paths.
    pub ten: Tendons,
    /// Actuator lengths and moments.
    pub trn: Transmission,
    /// Joint-space inertia.
    pub inertia: Inertia,
    /// Contacts.
    pub con: Contacts,
    /// Constraint rows.
    pub efc: Constraints,
    /// Constraint islands.
    pub island: Islands,
    /// Velocities and bias force.
    pub vel: Velocity,
    /// Passive forces.
    pub passive: Passive,
    /// Actuator forces.
    pub actuation: Actuation,
    /// Accelerations and constraint force.
    pub acc: Acceleration,
    /// Sensor readings.
    pub sensor: Sensors,
    /// Factors of implicit integration.
    pub implicit: Implicit,
    /// Solver statistics.
    pub solver: SolverStatistics,
    /// Working memory.
    pub scratch: Scratch,
}

impl Data {
    /// Data of `m` at its reference configuration, derived quantities zero.
    pub fn new(m: &Model) -> Self {
        let mut d = Data {
            state: State::new(m),
            kin: Kinematics::new(m),
            com: Com::new(m),
            ten: Tendons::new(m),
            trn: Transmission::new(m),
            inertia: Inertia::new(m),
            vel: Velocity::new(m),
            passive: Passive::new(m),
            actuation: Actuation::new(m),
            acc: Acceleration::new(m),
            sensor: Sensors::new(m),
            implicit: Implicit::new(m),
            ..Data::default()
        };
        d.reset(m);
        d
    }

    /// Returns to the reference configuration at time zero: zero velocities, activations and inputs, mocap bodies
    /// at their model poses, equality constraints as the model says. Stage outputs keep their last values.
    pub fn reset(&mut self, m: &Model) {
        self.time = 0.0;
        self.energy = [0.0; 2];
        self.state = State::new(m);
        self.state.qpos.copy_from_slice(&m.qpos0);
        history::reset(m, &mut self.state.history);
        self.state.eq_active.copy_from_slice(&m.eq_active0);
        for b in 0..m.nbody {
            if let Ok(k) = usize::try_from(m.body_mocapid[b]) {
                self.state.mocap_pos[k] = m.body_pos[b];
                self.state.mocap_quat[k] = m.body_quat[b];
            }
        }
    }

    /// Resets, then takes time, positions, velocities, activations, mocap poses and controls of keyframe `key`.
    ///
    /// # Errors
    /// The number of keyframes, when `key` is not below it.
    pub fn reset_to_key(&mut self, m: &Model, key: usize) -> Result<(), usize> {
        if key >= m.nkey {
            return Err(m.nkey);
        }
        self.reset(m);
        let row = |values: &[f64], n: usize| values[key * n..(key + 1) * n].to_vec();
        self.time = m.key_time[key];
        self.state.qpos = row(&m.key_qpos, m.nq);
        self.state.qvel = row(&m.key_qvel, m.nv);
        self.state.act = row(&m.key_act, m.na);
        self.state.ctrl = row(&m.key_ctrl, m.nu);
        self.state.mocap_pos.as_flattened_mut().copy_from_slice(&row(&m.key_mpos, 3 * m.nmocap));
        self.state.mocap_quat.as_flattened_mut().copy_from_slice(&row(&m.key_mquat, 4 * m.nmocap));
        Ok(())
    }

    /// Calls `f(name, shape, values)` for every array and count, contacts as `contact.dist` and so on.
    pub fn visit(&self, m: &Model, f: &mut dyn FnMut(&'static str, Vec<usize>, Slice<'_>)) {
        f("time", vec![], Slice::F64(&[self.time]));
        f("energy", vec![2], Slice::F64(&self.energy));
        self.state.visit(m, f);
        self.kin.visit(m, f);
        self.com.visit(m, f);
        self.ten.visit(m, f);
        self.trn.visit(m, f);
        self.inertia.visit(m, f);
        self.con.visit(f);
        self.efc.visit(f);
        self.efc.visit_counts(&mut |name, n| f(name, vec![], Slice::I32(&[n as i32])));
        self.island.visit(f);
        self.island.visit_counts(&mut |name, n| f(name, vec![], Slice::I32(&[n as i32])));
        self.vel.visit(m, f);
        self.passive.visit(m, f);
        self.actuation.visit(m, f);
        self.acc.visit(m, f);
        self.sensor.visit(m, f);
        self.implicit.visit(m, f);
        f("solver_niter", vec![self.solver.solver_niter.len()], Slice::I32(&self.solver.solver_niter));
        f("solver_fwdinv", vec![2], Slice::F64(&self.solver.solver_fwdinv));
    }

    /// Overwrites the array called `name`, as validation does to inject upstream values; `None` when there is none,
    /// `Some(false)` when the length does not fit.
    pub fn assign(&mut self, name: &str, values: &[f64]) -> Option<bool> {
        if let ("time", [t]) = (name, values) {
            self.time = *t;
            return Some(true);
        }
        if let ([n], true) = (values, ["ne", "nf", "nl", "nefc"].contains(&name)) {
            return Some(self.efc.set_count(name, *n as usize));
        }
        None.or_else(|| self.state.assign(name, values))
            .or_else(|| self.kin.assign(name, values))
            .or_else(|| self.com.assign(name, values))
            .or_else(|| self.ten.assign(name, values))
            .or_else(|| self.trn.assign(name, values))
            .or_else(|| self.inertia.assign(name, values))
            .or_else(|| self.con.assign(name, values))
            .or_else(|| self.efc.assign(name, values))
            .or_else(|| self.island.assign(name, values))
            .or_else(|| self.vel.assign(name, values))
            .or_else(|| self.passive.assign(name, values))
            .or_else(|| self.actuation.assign(name, values))
            .or_else(|| self.acc.assign(name, values))
            .or_else(|| self.sensor.assign(name, values))
            .or_else(|| self.implicit.assign(name, values))
    }
}
