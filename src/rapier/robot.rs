//! A model among the bodies of another program's rapier.

use crate::body::{Body, Sets};
use crate::convert::array;
use crate::floating::Pace;
use crate::forces::Forces;
use crate::rules::Rules;
use crate::touch::{self, Found};
use physics::model::NotSimulated;
use physics::{Data, Model, StepError};
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{
    ColliderHandle, ColliderSet, ContactModificationContext, IntegrationParameters, MultibodyJointSet,
    NarrowPhase, PairFilterContext, PhysicsHooks, RigidBodyHandle, RigidBodySet, SolverFlags,
};

/// A robot from MJCF, with its muscles, tendons and actuators, in the sets of a program that steps rapier itself.
///
/// Before each step of rapier the program calls [`Robot::before_step`], which advances actuators and muscles and sets the
/// robot's velocities and forces in rapier; after it [`Robot::after_step`], which reads the state back and completes the sensors. Set controls
/// in [`Robot::data`], and also forces of the program on the robot (`qfrc_applied`, `xfrc_applied`): forces set on its rigid
/// bodies are removed. The model's world frame is the program's, and gravity is that of
/// [`Robot::before_step`]. Contacts with other bodies act on the robot, but are not in `data`, whose contacts are between geoms.
///
/// ```
/// use robohive_rapier::rapier::prelude::*;
/// use robohive_rapier::{Hooks, Robot};
///
/// let text = "<mujoco><worldbody><body pos='0 0 1'><joint name='elbow' axis='0 1 0'/><geom size='.05' pos='.3 0 0'/></body>
///     </worldbody><actuator><motor joint='elbow' gear='5'/></actuator></mujoco>";
/// let model = mjcf::load_str(text)?.model;
///
/// let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
/// world.integration_parameters.dt = 0.002;
/// let PhysicsWorld { bodies, colliders, multibody_joints, .. } = &mut world;
/// let mut arm = Robot::insert(&model, bodies, colliders, multibody_joints)?;
/// for _ in 0..100 {
///     arm.data.state.ctrl[0] = -1.0;
///     let PhysicsWorld { gravity, integration_parameters, bodies, multibody_joints, .. } = &mut world;
///     arm.before_step(*gravity, integration_parameters, bodies, multibody_joints)?;
///     world.step_with_events(&Hooks::new(&[&arm], &()), &());
///     let PhysicsWorld { narrow_phase, bodies, multibody_joints, .. } = &world;
///     arm.after_step(narrow_phase, bodies, multibody_joints)?;
/// }
/// assert!(arm.data.state.qpos[0] < -0.05, "the motor lifts the arm");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Robot {
    /// State and inputs, and what follows from them, as after a step of our own pipeline.
    pub data: Data,
    forces: Forces,
    body: Body,
    /// Positions that were last read or placed, to detect changes by the program.
    placed: Vec<f64>,
    pace: Option<Pace>,
}

impl Robot {
    /// Inserts a model at its reference configuration.
    ///
    /// # Errors
    /// The first element that is not simulated.
    pub fn insert(
        m: &Model,
        bodies: &mut RigidBodySet,
        colliders: &mut ColliderSet,
        multibodies: &mut MultibodyJointSet,
    ) -> Result<Self, NotSimulated> {
        let body = Body::insert(m, &mut Sets { bodies, colliders, multibodies })?;
        let data = Data::new(m);
        let placed = data.state.qpos.clone();
        Ok(Robot { data, forces: Forces::new(m, m.opt.timestep), body, placed, pace: None })
    }

    /// The model.
    pub fn model(&self) -> &Model {
        &self.forces.model
    }

    /// The rigid body of a body of the model and those welded to it; `None` for bodies fixed to the world.
    pub fn rigid_body(&self, body: usize) -> Option<RigidBodyHandle> {
        self.body.groups.of_body[body].map(|k| self.body.links.handles[k])
    }

    /// The collider of a geom; `None` where the geom touches nothing.
    pub fn collider(&self, geom: usize) -> Option<ColliderHandle> {
        self.body.colliders[geom]
    }

    /// Prepares a step of rapier with these parameters and this gravity \[m/s²\]; the length of the step may differ from the model's.
    ///
    /// # Errors
    /// As for a step of our own pipeline: a number of the state or of the inputs is not finite, or too large.
    pub fn before_step(
        &mut self,
        gravity: Vector,
        parameters: &IntegrationParameters,
        bodies: &mut RigidBodySet,
        multibodies: &mut MultibodyJointSet,
    ) -> Result<(), StepError> {
        self.pace = None;
        let Robot { data, forces, body, placed, .. } = self;
        // No colliders are needed: they follow their bodies.
        let mut sets = Sets { bodies, colliders: &mut ColliderSet::new(), multibodies };
        if *placed != data.state.qpos {
            body.place(&forces.model, &data.state, &data.state.qpos, &mut sets);
        }
        forces.set_step(parameters.dt, array(gravity));
        if forces.predict(data)? {
            let pace = Pace { dt: parameters.dt, iterations: parameters.num_solver_iterations };
            forces.hold(data, body, &mut sets, pace);
            self.pace = Some(pace);
        }
        Ok(())
    }

    /// Reads the state after the step of rapier, and completes forces and sensors.
    ///
    /// # Errors
    /// As [`Robot::before_step`].
    pub fn after_step(
        &mut self,
        narrow_phase: &NarrowPhase,
        bodies: &RigidBodySet,
        multibodies: &MultibodyJointSet,
    ) -> Result<(), StepError> {
        let Some(pace) = self.pace.take() else { return Ok(()) };
        let Robot { data, forces, body, placed, .. } = self;
        body.read(&forces.model, pace, (bodies, multibodies), &mut data.state);
        placed.clone_from(&data.state.qpos);
        forces.find_contact_force(data)?;
        let found = Found { narrow_phase, bodies, geoms: &body.geoms };
        touch::write(&forces.model, found, pace, data);
        forces.account(data);
        Ok(())
    }
}

/// MuJoCo's rules of contact within each of several robots, and the program's own hooks for all other pairs.
pub struct Hooks<'a> {
    robots: &'a [&'a Robot],
    others: &'a dyn PhysicsHooks,
}

impl<'a> Hooks<'a> {
    /// Hooks for a step of rapier.
    pub fn new(robots: &'a [&'a Robot], others: &'a dyn PhysicsHooks) -> Self {
        Hooks { robots, others }
    }

    /// The rules of the robot to which both colliders belong.
    fn rules(&self, pair: [ColliderHandle; 2]) -> Option<Rules<'a>> {
        let own = |robot: &Robot| pair.iter().all(|handle| robot.body.geoms.contains_key(handle));
        let robot = self.robots.iter().copied().find(|robot| own(robot))?;
        Some(Rules { m: robot.model(), geoms: &robot.body.geoms })
    }
}

impl PhysicsHooks for Hooks<'_> {
    fn filter_contact_pair(&self, at: &PairFilterContext) -> Option<SolverFlags> {
        match self.rules([at.collider1, at.collider2]) {
            Some(rules) => rules.filter_contact_pair(at),
            None => self.others.filter_contact_pair(at),
        }
    }

    fn filter_intersection_pair(&self, at: &PairFilterContext) -> bool {
        self.others.filter_intersection_pair(at)
    }

    fn modify_solver_contacts(&self, at: &mut ContactModificationContext) {
        match self.rules([at.collider1, at.collider2]) {
            Some(rules) => rules.modify_solver_contacts(at),
            None => self.others.modify_solver_contacts(at),
        }
    }
}
