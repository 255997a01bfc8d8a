//! A world of rapier made from a model.

use crate::body::{Body, Sets};
use crate::floating::Pace;
use crate::rules::Rules;
use crate::touch::Found;
use physics::Model;
use physics::data::State;
use physics::model::NotSimulated;
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{ColliderHandle, IntegrationParameters, PhysicsPipeline, PhysicsWorld};
use std::fmt;

/// Solver settings of rapier.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Steps of rapier in a time step; forces are computed for each.
    pub substeps: usize,
    /// Solver iterations in a step of rapier, each of which is a part of the step, while there are contacts; otherwise
    /// one, which keeps motion without contacts equal to that of our pipeline. By default four for free bodies, which stabilises
    /// stacks, and one for models with joints, to save time.
    pub iterations: Option<usize>,
    /// Continuous collision detection: whether fast bodies stop at obstacles that they would pass through. MuJoCo has none.
    pub continuous: bool,
    /// Whether contacts of pairs that barely moved are reused in the next step: faster, and less accurate.
    pub recycling: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { substeps: 1, iterations: None, continuous: false, recycling: false }
    }
}

impl Options {
    /// Sets the steps of rapier in a time step, at least 1.
    #[must_use]
    pub fn with_substeps(mut self, substeps: usize) -> Self {
        self.substeps = substeps.max(1);
        self
    }

    /// Sets the solver iterations while there are contacts, at least 1.
    #[must_use]
    pub fn with_iterations(mut self, iterations: usize) -> Self {
        self.iterations = Some(iterations.max(1));
        self
    }

    /// Sets continuous collision detection.
    #[must_use]
    pub fn with_continuous(mut self, continuous: bool) -> Self {
        self.continuous = continuous;
        self
    }

    /// Sets whether contacts of pairs that barely moved are reused.
    #[must_use]
    pub fn with_recycling(mut self, recycling: bool) -> Self {
        self.recycling = recycling;
        self
    }
}

/// A world of rapier with the bodies, joints and shapes of a model in it.
///
/// It has no gravity of its own: weight is among the forces that the model's own stages compute.
pub struct World {
    pub(crate) physics: PhysicsWorld,
    pub(crate) body: Body,
    /// Positions that were last read or placed, to detect changes by the program.
    placed: Vec<f64>,
    mocap: Vec<f64>,
    options: Options,
}

impl World {
    /// Builds the world at the model's reference configuration.
    ///
    /// # Errors
    /// The first element that is not simulated.
    pub fn new(m: &Model, options: Options) -> Result<Self, NotSimulated> {
        let mut physics = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        let parameters = &mut physics.integration_parameters;
        parameters.normalized_max_linear_velocity = f64::MAX;
        parameters.max_ccd_substeps = usize::from(options.continuous);
        parameters.contact_recycling = options.recycling;
        parameters.contact_clustering = false;
        // MuJoCo's contacts begin at zero distance; rapier has to predict them a step earlier.
        parameters.normalized_prediction_distance = 0.002;
        let mut sets = Sets {
            bodies: &mut physics.bodies,
            colliders: &mut physics.colliders,
            multibodies: &mut physics.multibody_joints,
        };
        let body = Body::insert(m, &mut sets)?;
        Ok(World { physics, body, placed: Vec::new(), mocap: Vec::new(), options })
    }

    /// Rapier's own world, read-only.
    pub fn physics(&self) -> &PhysicsWorld {
        &self.physics
    }

    /// Solver parameters beyond [`Options`]. The length of a step and the number of iterations are overwritten at every step.
    pub fn parameters_mut(&mut self) -> &mut IntegrationParameters {
        &mut self.physics.integration_parameters
    }

    /// The collider of a geom; `None` where the geom touches nothing.
    pub fn collider(&self, geom: usize) -> Option<ColliderHandle> {
        self.body.colliders[geom]
    }

    pub(crate) fn options(&self) -> Options {
        self.options
    }

    pub(crate) fn sets(&mut self) -> (&mut Body, Sets<'_>) {
        let PhysicsWorld { bodies, colliders, multibody_joints, .. } = &mut self.physics;
        (&mut self.body, Sets { bodies, colliders, multibodies: multibody_joints })
    }

    /// Applies changes of positions by the program.
    pub(crate) fn follow(&mut self, m: &Model, state: &State) {
        let mocap = [state.mocap_pos.as_flattened(), state.mocap_quat.as_flattened()];
        let same = self.placed == state.qpos && self.mocap.iter().eq(mocap.iter().copied().flatten());
        if !same {
            let (body, mut sets) = self.sets();
            body.place(m, state, &state.qpos, &mut sets);
            self.placed.clone_from(&state.qpos);
            self.mocap = mocap.concat();
        }
    }

    /// Length \[s\] and iterations of the next step of rapier: without contacts, one iteration.
    pub(crate) fn pace(&self, dt: f64) -> Pace {
        let near = self.physics.narrow_phase.contact_pairs().any(|pair| !pair.manifolds().is_empty());
        let most = self.options.iterations.unwrap_or(if self.body.has_multibodies() { 1 } else { 4 });
        Pace { dt, iterations: if near { most } else { 1 } }
    }

    /// One step of rapier.
    pub(crate) fn advance(&mut self, m: &Model, pace: Pace) {
        self.physics.integration_parameters.dt = pace.dt;
        self.physics.integration_parameters.num_solver_iterations = pace.iterations;
        self.physics.step_with_events(&Rules { m, geoms: &self.body.geoms }, &());
    }

    /// Its contacts.
    pub(crate) fn found(&self) -> Found<'_> {
        let PhysicsWorld { narrow_phase, bodies, .. } = &self.physics;
        Found { narrow_phase, bodies, geoms: &self.body.geoms }
    }

    /// Reads the state back.
    pub(crate) fn read(&mut self, m: &Model, pace: Pace, state: &mut State) {
        let PhysicsWorld { bodies, multibody_joints, .. } = &self.physics;
        self.body.read(m, pace, (bodies, multibody_joints), state);
        self.placed.clone_from(&state.qpos);
    }
}

impl Clone for World {
    fn clone(&self) -> Self {
        let p = &self.physics;
        let physics = PhysicsWorld {
            gravity: p.gravity,
            integration_parameters: p.integration_parameters,
            // The pipeline has no state.
            physics_pipeline: PhysicsPipeline::new(),
            islands: p.islands.clone(),
            broad_phase: p.broad_phase.clone(),
            narrow_phase: p.narrow_phase.clone(),
            bodies: p.bodies.clone(),
            colliders: p.colliders.clone(),
            impulse_joints: p.impulse_joints.clone(),
            multibody_joints: p.multibody_joints.clone(),
            ccd_solver: p.ccd_solver.clone(),
            ..PhysicsWorld::default()
        };
        World {
            physics,
            body: self.body.clone(),
            placed: self.placed.clone(),
            mocap: self.mocap.clone(),
            options: self.options,
        }
    }
}

impl fmt::Debug for World {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bodies = self.physics.bodies.len();
        f.debug_struct("World")
            .field("bodies", &bodies)
            .field("options", &self.options)
            .finish_non_exhaustive()
    }
}
