//! All forces except contact forces, in a form that rapier accepts: velocities for its step, and wrenches that hold them constant.

use crate::body::{Body, Sets};
use crate::floating::Pace;
use physics::data::{State, Velocity};
use physics::inertia::mul_inertia_matrix;
use physics::model::{Disable, Enable, Integrator};
use physics::pipeline::forward::acceleration_sensors;
use physics::velocity::bias::{RneScratch, rne};
use physics::velocity::com_vel::com_vel;
use physics::{Data, Model, StepError};

/// A model's own stages around a step of rapier.
#[derive(Clone, Debug)]
pub(crate) struct Forces {
    /// The model.
    pub model: Model,
    /// The same without contacts and sleep: what moves it is all but contacts. Rapier moves positions by the velocity at the end of
    /// a step, as Euler's method does, so that stands in for Runge-Kutta's.
    free: Model,
    /// That without weight: what is left of the bias force is what rapier computes of it.
    weightless: Model,
    velocity: Velocity,
    scratch: RneScratch,
    start: State,
    force: Vec<f64>,
    change: Vec<f64>,
    product: Vec<f64>,
}

impl Forces {
    /// For steps of `timestep` seconds.
    pub fn new(m: &Model, timestep: f64) -> Self {
        let mut free = m.clone();
        let opt = free.options_mut();
        opt.timestep = timestep;
        opt.disableflags.set(Disable::CONTACT, true);
        opt.enableflags.set(Enable::SLEEP, false);
        if opt.integrator == Integrator::Rk4 {
            opt.integrator = Integrator::Euler;
        }
        let mut weightless = free.clone();
        weightless.options_mut().disableflags.set(Disable::GRAVITY, true);
        Forces {
            model: m.clone(),
            free,
            weightless,
            velocity: Velocity::new(m),
            scratch: RneScratch::default(),
            start: State::default(),
            force: Vec::new(),
            change: Vec::new(),
            product: Vec::new(),
        }
    }

    /// The length of a step, and the acceleration of gravity.
    pub fn timestep(&self) -> f64 {
        self.free.opt.timestep
    }

    /// Sets the length of a step \[s\], and the acceleration of gravity \[m/s²\].
    pub fn set_step(&mut self, timestep: f64, gravity: [f64; 3]) {
        for m in [&mut self.free, &mut self.weightless] {
            m.options_mut().timestep = timestep;
            m.options_mut().gravity = gravity;
        }
    }

    /// Computes the step without contacts. Returns false if the step had a bad number and reset the state.
    ///
    /// # Errors
    /// As `physics::step`.
    pub fn predict(&mut self, d: &mut Data) -> Result<bool, StepError> {
        self.start.clone_from(&d.state);
        physics::step(&self.free, d)?;
        Ok(d.state.time > self.start.time)
    }

    /// Gives rapier the velocities of the end of the step, and the forces that keep them constant: they cancel its own
    /// gyroscopic forces, which are already included.
    pub fn hold(&mut self, d: &Data, body: &mut Body, sets: &mut Sets<'_>, pace: Pace) {
        body.set_in_motion(&self.model, &d.state.qvel, pace, sets);
        if body.has_multibodies() {
            let floats = body.centripetal(&self.model, &d.state.qvel, &mut self.change);
            com_vel(&self.weightless, &d.state, &d.com, &mut self.velocity);
            self.force.resize(self.model.nv, 0.0);
            let Forces { weightless, velocity, scratch, force, .. } = self;
            rne(weightless, &d.state, &d.com, velocity, None, scratch, force);
            if floats {
                self.product.resize(self.model.nv, 0.0);
                mul_inertia_matrix(&self.model, &d.inertia.M, &self.change, &mut self.product);
                for (force, counted) in self.force.iter_mut().zip(&self.product) {
                    *force -= counted;
                }
            }
            body.push(&self.model, &self.force, &d.kin.xaxis, sets);
        }
        self.change.clone_from(&d.state.qvel);
    }

    /// Computes the contact forces from the change of velocity in rapier's step. Where equality constraints couple
    /// bodies, repeats the step with these forces as given ones: rapier does not have the constraints, and would violate them.
    ///
    /// # Errors
    /// As `physics::step`.
    pub fn find_contact_force(&mut self, d: &mut Data) -> Result<(), StepError> {
        let h = self.timestep();
        for (change, now) in self.change.iter_mut().zip(&d.state.qvel) {
            *change = (now - *change) / h;
        }
        self.product.resize(self.model.nv, 0.0);
        mul_inertia_matrix(&self.model, &d.inertia.M, &self.change, &mut self.product);
        if d.efc.ne > 0 && self.product.iter().any(|force| *force != 0.0) {
            d.state.clone_from(&self.start);
            for (applied, contact) in d.state.qfrc_applied.iter_mut().zip(&self.product) {
                *applied += contact;
            }
            physics::step(&self.free, d)?;
            d.state.qfrc_applied.clone_from(&self.start.qfrc_applied);
        }
        Ok(())
    }

    /// Adds the effect of contacts to accelerations, constraint forces and sensors, which after a step are those of the
    /// state from which the step began.
    pub fn account(&mut self, d: &mut Data) {
        let h = self.timestep();
        for ((acceleration, start), now) in d.acc.qacc.iter_mut().zip(&self.start.qvel).zip(&d.state.qvel) {
            *acceleration = (now - start) / h;
        }
        for (force, contact) in d.acc.qfrc_constraint.iter_mut().zip(&self.product) {
            *force += contact;
        }
        d.state.qacc_warmstart.copy_from_slice(&d.acc.qacc);
        if self.model.nsensor > 0 {
            acceleration_sensors(&self.model, d);
        }
    }
}
