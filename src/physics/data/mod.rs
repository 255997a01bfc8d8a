//! Everything that changes while a model moves, grouped by the stage that writes it.
//!
//! ```
//! use robohive_physics::{Data, step};
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! let mut data = Data::new(&model);
//! step(&model, &mut data)?;
//! assert_eq!(data.time(), model.opt.timestep);
//! assert!(data.state.qvel[0] > 0.0 && data.acc.qacc[0] > 9.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod address;
mod budget;
mod configuration;
mod constraints;
mod scratch;
mod snapshot;
mod stages;
mod warnings;

pub use address::ArrayAddress;
pub use budget::{Demand, OverBudget, StepBudget};
pub use configuration::Configuration;
pub(crate) use configuration::configuration_of;
pub use constraints::{Constraints, Contact, Contacts, Islands, SolverStat, SolverStatistics};
pub use scratch::Scratch;
pub use snapshot::{ForeignSnapshot, Snapshot};
pub use stages::*;
pub use warnings::{Warning, Warnings};

use crate::actuation::history;
use crate::flex::Metric;
use crate::model::{Arrays, Model};
use crate::sleep;
use crate::table::Slice;
use std::fmt;

impl State {
    /// The reference configuration at time zero: zero velocities, activations and inputs, mocap bodies at their model
    /// poses, equality constraints as the model says.
    pub(crate) fn reset(&mut self, m: &Model) {
        self.clear(m);
        self.qpos.copy_from_slice(&m.qpos0);
        history::reset(m, &mut self.history);
        self.eq_active.copy_from_slice(&m.eq_active0);
        for b in 0..m.nbody {
            if let Ok(k) = usize::try_from(m.body_mocapid[b]) {
                self.mocap_pos[k] = m.body_pos[b];
                self.mocap_quat[k] = m.body_quat[b];
            }
        }
        for running in m.plugins().all() {
            running.instance.reset(m, &mut self.plugin_state[running.state.clone()]);
        }
        self.tree_asleep.fill(sleep::MOVED);
        sleep::update(m, self);
    }
}

impl State {
    /// Calls `f(name, count)` for how many elements are awake.
    pub fn visit_counts(&self, f: &mut dyn FnMut(&'static str, usize)) {
        f("ntree_awake", self.ntree_awake);
        f("nbody_awake", self.nbody_awake);
        f("nparent_awake", self.nparent_awake);
        f("nv_awake", self.nv_awake);
    }

    /// The count that [`Self::visit_counts`] calls `name`.
    fn count_mut(&mut self, name: &str) -> Option<&mut usize> {
        Some(match name {
            "ntree_awake" => &mut self.ntree_awake,
            "nbody_awake" => &mut self.nbody_awake,
            "nparent_awake" => &mut self.nparent_awake,
            "nv_awake" => &mut self.nv_awake,
            _ => return None,
        })
    }
}

/// State, stage outputs and scratch memory of one simulation.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// Memory that contacts and constraint rows of one step may take.
    pub budget: StepBudget,
    /// A bad number in a step is reset as MuJoCo does, and counted in `warnings`, instead of an error.
    pub autoreset: bool,
    /// The state has come from elsewhere, with trees that sleep: what stages keep of those is not known.
    pub(crate) unsettled: bool,
    /// What `autoreset` has done.
    pub warnings: Warnings,
    /// Potential and kinetic energy [J].
    pub energy: [f64; 2],
    /// State and inputs.
    pub state: State,
    /// Global poses.
    pub kin: Kinematics,
    /// Centres of mass, motion axes, inertias about them.
    pub com: Com,
    /// Vertices, edges and boxes of flexes.
    pub flex: Flexes,
    /// Stiffness of flexes in the inertia.
    pub metric: Metric,
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
            flex: Flexes::new(m),
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

    /// Bytes of the arrays of all stages for a model of these sizes, contacts and constraint rows aside.
    pub fn bytes(m: &Arrays) -> usize {
        let stages = [
            State::bytes(m),
            Kinematics::bytes(m),
            Com::bytes(m),
            Flexes::bytes(m),
            Tendons::bytes(m),
            Transmission::bytes(m),
            Inertia::bytes(m),
            Velocity::bytes(m),
            Passive::bytes(m),
            Actuation::bytes(m),
            Acceleration::bytes(m),
            Sensors::bytes(m),
            Implicit::bytes(m),
        ];
        stages.into_iter().fold(0, usize::saturating_add)
    }

    /// Returns to the reference configuration at time zero: zero velocities, activations and inputs, mocap bodies
    /// at their model poses, equality constraints as the model says. Stage outputs keep their last values. Nothing is
    /// allocated.
    pub fn reset(&mut self, m: &Model) {
        self.energy = [0.0; 2];
        self.unsettled = false;
        self.state.reset(m);
        // A model whose trees cannot begin asleep is refused where it is compiled; there they are awake.
        let _ = sleep::rest::begin(m, self);
    }

    /// Resets, then takes time, positions, velocities, activations, mocap poses and controls of keyframe `key`. Nothing
    /// is allocated.
    ///
    /// # Errors
    /// The model has no such keyframe; the data stay as they were.
    pub fn reset_to_key(&mut self, m: &Model, key: usize) -> Result<(), NoKeyframe> {
        if key >= m.nkey {
            return Err(NoKeyframe { key, keyframes: m.nkey });
        }
        self.reset(m);
        let state = &mut self.state;
        state.time = m.key_time[key];
        for (values, keys) in [
            (&mut state.qpos[..], &m.key_qpos[..]),
            (&mut state.qvel, &m.key_qvel),
            (&mut state.act, &m.key_act),
            (&mut state.ctrl, &m.key_ctrl),
            (state.mocap_pos.as_flattened_mut(), &m.key_mpos),
            (state.mocap_quat.as_flattened_mut(), &m.key_mquat),
        ] {
            let n = values.len();
            values.copy_from_slice(&keys[key * n..(key + 1) * n]);
        }
        Ok(())
    }

    /// Simulation time [s].
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Calls `f(name, shape, values)` for every array and count, contacts as `contact.dist` and so on.
    pub fn visit(&self, m: &Model, f: &mut dyn FnMut(&'static str, Vec<usize>, Slice<'_>)) {
        f("time", vec![], Slice::F64(&[self.state.time]));
        f("energy", vec![2], Slice::F64(&self.energy));
        self.state.visit_counts(&mut |name, n| f(name, vec![], Slice::I32(&[n as i32])));
        self.state.visit(m, f);
        f("plugin", vec![m.nplugin], Slice::I32(&m.plugin));
        self.kin.visit(m, f);
        self.com.visit(m, f);
        self.flex.visit(m, f);
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
            self.state.time = *t;
            return Some(true);
        }
        if let ([n], true) = (values, ["ne", "nf", "nl", "nefc"].contains(&name)) {
            return Some(self.efc.set_count(name, *n as usize));
        }
        if let [n] = values
            && let Some(count) = self.state.count_mut(name)
        {
            *count = *n as usize;
            return Some(true);
        }
        None.or_else(|| self.state.assign(name, values))
            .or_else(|| self.kin.assign(name, values))
            .or_else(|| self.com.assign(name, values))
            .or_else(|| self.flex.assign(name, values))
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

/// A keyframe that a model does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoKeyframe {
    /// Keyframe asked for.
    pub key: usize,
    /// Keyframes of the model.
    pub keyframes: usize,
}

impl fmt::Display for NoKeyframe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.keyframes {
            0 => write!(f, "keyframe {} does not exist: the model has none", self.key),
            n => write!(f, "keyframe {} does not exist: the model has {n}, numbered from 0", self.key),
        }
    }
}

impl std::error::Error for NoKeyframe {}
