//! Rapier as the engine of a `Data`.

use crate::floating::Pace;
use crate::touch;
use crate::world::{Options, World};
use physics::data::{ForeignSnapshot, State, Velocity};
use physics::inertia::mul_inertia_matrix;
use physics::model::{Arrays, Disable, Enable, Integrator, NotSimulated};
use physics::pipeline::error::{BadNumber, StepError};
use physics::pipeline::forward::acceleration_sensors;
use physics::velocity::bias::{RneScratch, rne};
use physics::velocity::com_vel::com_vel;
use physics::{Data, Memory, Model, Stepper};
use rapier3d_f64::prelude::{ColliderHandle, ColliderSet};
use std::sync::Arc;

/// A model under rapier. See the [crate](crate) for who computes what.
#[derive(Clone, Debug)]
pub struct Rapier {
    /// The model as it was when the world was built or brought up to date.
    model: Model,
    /// The same without contacts, for a substep: what moves it is all but contacts.
    free: Model,
    /// That without weight: what is left of the bias force is what rapier computes of it.
    weightless: Model,
    world: World,
    /// The world as it was built.
    fresh: Arc<World>,
    velocity: Velocity,
    scratch: RneScratch,
    bias: Vec<f64>,
    start: State,
    change: Vec<f64>,
    product: Vec<f64>,
}

impl Rapier {
    /// Prepares a model.
    ///
    /// # Errors
    /// The first element that is not simulated.
    pub fn new(m: &Model, options: Options) -> Result<Self, NotSimulated> {
        let world = World::new(m, options)?;
        let (free, weightless) = reduced(m, options);
        Ok(Rapier {
            velocity: Velocity::new(m),
            model: m.clone(),
            free,
            weightless,
            fresh: Arc::new(world.clone()),
            world,
            scratch: RneScratch::default(),
            bias: Vec::new(),
            start: State::default(),
            change: Vec::new(),
            product: Vec::new(),
        })
    }

    /// Its world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Its world, to set how rapier solves.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }

    /// Takes over what a program has changed in the model.
    fn follow(&mut self, m: &Model) -> Result<(), NotSimulated> {
        if m.opt == self.model.opt && m.shares(&self.model) {
            return Ok(());
        }
        if !same_world(m, &self.model) {
            self.world = World::new(m, self.world.options())?;
            self.fresh = Arc::new(self.world.clone());
        }
        self.model = m.clone();
        (self.free, self.weightless) = reduced(m, self.world.options());
        Ok(())
    }

    /// One step of rapier, with all forces but those of contacts computed at its state.
    fn substep(&mut self, d: &mut Data) -> Result<(), StepError> {
        let (began, h) = (d.state.time, self.free.opt.timestep);
        self.start.clone_from(&d.state);
        self.world.follow(&self.model, &d.state);
        physics::step(&self.free, d)?;
        if d.state.time < began {
            // A bad number has been reset, and with it the state that rapier was given.
            return Ok(());
        }
        let pace = self.world.pace(h);
        self.hold(d, pace);
        self.change.clone_from(&d.state.qvel);
        self.world.advance(&self.model, pace);
        self.check(d)?;
        self.world.read(&self.model, pace, &mut d.state);
        for (change, now) in self.change.iter_mut().zip(&d.state.qvel) {
            *change = (now - *change) / h;
        }
        self.product.resize(self.model.nv, 0.0);
        mul_inertia_matrix(&self.model, &d.inertia.M, &self.change, &mut self.product);
        if d.efc.ne > 0 && self.product.iter().any(|force| *force != 0.0) {
            self.yield_to_couplings(d)?;
        }
        self.account(d, h);
        Ok(())
    }

    /// Takes the step again with the forces of contacts as given ones: rapier knows nothing of what couples bodies beyond their
    /// joints, and would tear it apart.
    fn yield_to_couplings(&mut self, d: &mut Data) -> Result<(), StepError> {
        d.state.clone_from(&self.start);
        for (applied, contact) in d.state.qfrc_applied.iter_mut().zip(&self.product) {
            *applied += contact;
        }
        physics::step(&self.free, d)?;
        d.state.qfrc_applied.clone_from(&self.start.qfrc_applied);
        Ok(())
    }

    /// Gives rapier the velocities that all but contacts would make, and the forces under which it keeps them: it would add its
    /// own gyroscopic ones, which are counted already.
    fn hold(&mut self, d: &Data, pace: Pace) {
        let (body, mut sets) = self.world.sets();
        body.set_in_motion(&self.model, &d.state.qvel, pace, &mut sets);
        if !body.has_multibodies() {
            return;
        }
        let floats = body.centripetal(&self.model, &d.state.qvel, &mut self.change);
        com_vel(&self.weightless, &d.state, &d.com, &mut self.velocity);
        self.bias.resize(self.model.nv, 0.0);
        let Rapier { weightless, velocity, scratch, bias, .. } = self;
        rne(weightless, &d.state, &d.com, velocity, None, scratch, bias);
        if floats {
            self.product.resize(self.model.nv, 0.0);
            mul_inertia_matrix(&self.model, &d.inertia.M, &self.change, &mut self.product);
            for (force, counted) in self.bias.iter_mut().zip(&self.product) {
                *force -= counted;
            }
        }
        let (body, mut sets) = self.world.sets();
        body.push(&self.model, &self.bias, &d.kin.xaxis, &mut sets);
    }

    /// Rapier leaves what is no number where it was, and goes on; a step says so.
    fn check(&self, d: &Data) -> Result<(), StepError> {
        if self.world.physics.quarantine().is_empty() {
            return Ok(());
        }
        let element = "a contact under rapier".to_string();
        Err(StepError::BadQacc(BadNumber { index: 0, element, value: f64::NAN, time: d.state.time }))
    }

    /// Completes accelerations, constraint forces and sensors by what contacts did, as `Data` have them after a step: of the
    /// state that the step began from.
    fn account(&mut self, d: &mut Data, h: f64) {
        let m = &self.model;
        let geom_of = |handle: ColliderHandle, set: &ColliderSet| Some(set.get(handle)?.user_data as usize);
        touch::write(m, &self.world.physics, geom_of, h, &mut d.con, &mut d.efc);
        for ((acceleration, start), now) in d.acc.qacc.iter_mut().zip(&self.start.qvel).zip(&d.state.qvel) {
            *acceleration = (now - start) / h;
        }
        for (force, contact) in d.acc.qfrc_constraint.iter_mut().zip(&self.product) {
            *force += contact;
        }
        d.state.qacc_warmstart.copy_from_slice(&d.acc.qacc);
        if m.nsensor > 0 {
            acceleration_sensors(m, d);
        }
    }
}

impl Stepper for Rapier {
    fn reset(&mut self) {
        self.world = (*self.fresh).clone();
    }

    fn step(&mut self, m: &Model, d: &mut Data) -> Result<(), StepError> {
        self.follow(m)?;
        (0..self.world.options().substeps).try_for_each(|_| self.substep(d))
    }

    fn save(&self) -> Memory {
        Memory::of((self.model.clone(), self.world.clone()))
    }

    fn restore(&mut self, memory: &Memory) -> Result<(), ForeignSnapshot> {
        let (model, world): &(Model, World) = memory.get().ok_or(ForeignSnapshot)?;
        if !world.body.fits(&self.model) {
            return Err(ForeignSnapshot);
        }
        (self.model, self.world) = (model.clone(), world.clone());
        (self.free, self.weightless) = reduced(model, world.options());
        Ok(())
    }

    fn duplicate(&self) -> Box<dyn Stepper> {
        Box::new(self.clone())
    }
}

/// The model without contacts and sleep, for a substep; and that without weight. Rapier moves positions by the velocity at the end
/// of a step, as Euler's method does, so that stands in for Runge-Kutta's.
fn reduced(m: &Model, options: Options) -> (Model, Model) {
    let mut free = m.clone();
    let opt = free.options_mut();
    opt.timestep /= options.substeps as f64;
    opt.disableflags.set(Disable::CONTACT, true);
    opt.enableflags.set(Enable::SLEEP, false);
    if opt.integrator == Integrator::Rk4 {
        opt.integrator = Integrator::Euler;
    }
    let mut weightless = free.clone();
    weightless.options_mut().disableflags.set(Disable::GRAVITY, true);
    (free, weightless)
}

/// Whether two models of the same structure make the same world.
fn same_world(a: &Arrays, b: &Arrays) -> bool {
    a.opt.disableflags == b.opt.disableflags
        && a.opt.enableflags == b.opt.enableflags
        && a.body_pos[..] == b.body_pos[..]
        && a.body_quat[..] == b.body_quat[..]
        && a.body_ipos[..] == b.body_ipos[..]
        && a.body_iquat[..] == b.body_iquat[..]
        && a.body_mass[..] == b.body_mass[..]
        && a.body_inertia[..] == b.body_inertia[..]
        && a.jnt_pos[..] == b.jnt_pos[..]
        && a.jnt_axis[..] == b.jnt_axis[..]
        && a.qpos0[..] == b.qpos0[..]
        && a.dof_armature[..] == b.dof_armature[..]
        && a.actuator_armature[..] == b.actuator_armature[..]
        && a.geom_type[..] == b.geom_type[..]
        && a.geom_pos[..] == b.geom_pos[..]
        && a.geom_quat[..] == b.geom_quat[..]
        && a.geom_size[..] == b.geom_size[..]
        && a.geom_dataid[..] == b.geom_dataid[..]
        && a.geom_contype[..] == b.geom_contype[..]
        && a.geom_conaffinity[..] == b.geom_conaffinity[..]
        && a.geom_condim[..] == b.geom_condim[..]
        && a.geom_priority[..] == b.geom_priority[..]
        && a.geom_friction[..] == b.geom_friction[..]
        && a.hfield_data[..] == b.hfield_data[..]
        && a.mesh_vert[..] == b.mesh_vert[..]
}
