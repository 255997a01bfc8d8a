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
mod no_keyframe;
mod scratch;
mod snapshot;
mod warnings;

pub(crate) use crate::stages::configuration_of;
pub use crate::stages::{
    Acceleration, Actuation, Com, Configuration, Constraints, Contact, Contacts, Demand, Flexes, Implicit,
    Inertia, Islands, Kinematics, OverBudget, Passive, Sensors, SolverStat, SolverStatistics, State,
    StepBudget, Tendons, Transmission, Velocity,
};
pub use address::ArrayAddress;
pub use no_keyframe::NoKeyframe;
pub use scratch::Scratch;
pub(crate) use scratch::{IntegrateScratch, Rates};
pub use snapshot::{ForeignSnapshot, Snapshot};
pub use warnings::{Warning, Warnings};

use crate::caches::origin::Origin;
use crate::derivative::{DerivativeInputs, inputs_of};
use crate::flex::Metric;
use crate::model::{Arrays, Model};
use crate::table::Slice;

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
    /// The structure of the model that the data were made for.
    pub(crate) origin: Origin,
    /// What `autoreset` has done.
    pub warnings: Warnings,
    /// Potential and kinetic energy \[J\].
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

    /// Simulation time \[s\].
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

impl<'a> From<&'a Data> for Configuration<'a> {
    fn from(d: &'a Data) -> Self {
        configuration_of!(d)
    }
}

impl<'a> From<&'a Data> for DerivativeInputs<'a> {
    fn from(d: &'a Data) -> Self {
        inputs_of!(d)
    }
}
