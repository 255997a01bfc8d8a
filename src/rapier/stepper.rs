//! Rapier as the engine of a `Data`.

use crate::forces::Forces;
use crate::touch;
use crate::world::{Options, World};
use physics::data::ForeignSnapshot;
use physics::model::{Arrays, NotSimulated};
use physics::pipeline::error::{BadNumber, StepError};
use physics::{Data, Memory, Model, Stepper};
use std::sync::Arc;

/// A model under rapier. See the [crate](crate) for the division of work.
#[derive(Clone, Debug)]
pub struct Rapier {
    forces: Forces,
    world: World,
    /// The initial world.
    fresh: Arc<World>,
}

impl Rapier {
    /// Prepares a model.
    ///
    /// # Errors
    /// The first element that is not simulated.
    pub fn new(m: &Model, options: Options) -> Result<Self, NotSimulated> {
        let world = World::new(m, options)?;
        Ok(Rapier { forces: forces(m, options), fresh: Arc::new(world.clone()), world })
    }

    /// Its world.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// Its world, to set how rapier solves.
    pub fn world_mut(&mut self) -> &mut World {
        &mut self.world
    }

    /// Applies changes of the model by the program.
    ///
    /// # Errors
    /// The first element that is not simulated any more.
    fn follow(&mut self, m: &Model) -> Result<(), NotSimulated> {
        let known = &self.forces.model;
        if m.opt == known.opt && m.shares(known) {
            return Ok(());
        }
        crate::refuse::check(m)?;
        if !same_world(m, known) {
            let parameters = *self.world.parameters_mut();
            self.world = World::new(m, self.world.options())?;
            *self.world.parameters_mut() = parameters;
            self.fresh = Arc::new(self.world.clone());
        }
        self.forces = forces(m, self.world.options());
        Ok(())
    }

    /// One step of rapier, with all forces but those of contacts computed at its state.
    fn substep(&mut self, d: &mut Data) -> Result<(), StepError> {
        let Rapier { forces, world, .. } = self;
        world.follow(&forces.model, &d.state);
        if !forces.predict(d)? {
            return Ok(());
        }
        let pace = world.pace(forces.timestep());
        let (body, mut sets) = world.sets();
        forces.hold(d, body, &mut sets, pace);
        world.advance(&forces.model, pace);
        // Rapier ignores numbers that are not finite, and continues.
        if !world.physics.quarantine().is_empty() {
            let element = "a contact under rapier".to_string();
            let bad = BadNumber { index: 0, element, value: f64::NAN, time: d.state.time };
            return Err(StepError::BadQacc(bad));
        }
        world.read(&forces.model, pace, &mut d.state);
        forces.find_contact_force(d)?;
        touch::write(&forces.model, world.found(), pace, d);
        forces.account(d);
        Ok(())
    }
}

impl Stepper for Rapier {
    fn reset(&mut self) {
        let parameters = *self.world.parameters_mut();
        self.world = (*self.fresh).clone();
        *self.world.parameters_mut() = parameters;
    }

    fn step(&mut self, m: &Model, d: &mut Data) -> Result<(), StepError> {
        self.follow(m)?;
        (0..self.world.options().substeps).try_for_each(|_| self.substep(d))
    }

    fn save(&self) -> Memory {
        Memory::of((self.forces.model.clone(), self.world.clone()))
    }

    fn restore(&mut self, memory: &Memory) -> Result<(), ForeignSnapshot> {
        let (model, world): &(Model, World) = memory.get().ok_or(ForeignSnapshot)?;
        if !world.body.fits(&self.forces.model) {
            return Err(ForeignSnapshot);
        }
        self.forces = forces(model, world.options());
        self.world = world.clone();
        Ok(())
    }

    fn duplicate(&self) -> Box<dyn Stepper> {
        Box::new(self.clone())
    }
}

fn forces(m: &Model, options: Options) -> Forces {
    Forces::new(m, m.opt.timestep / options.substeps as f64)
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
        && a.hfield_size[..] == b.hfield_size[..]
        && a.hfield_data[..] == b.hfield_data[..]
        && a.mesh_vert[..] == b.mesh_vert[..]
}
