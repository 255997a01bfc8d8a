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

/// How rapier is asked to solve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Options {
    /// Steps of rapier in a time step, each with forces of its own.
    pub substeps: usize,
    /// Iterations of rapier's solver in a step, itself divided into as many, while anything is near enough to touch; otherwise
    /// one, which keeps motion without contacts equal to our pipeline's. By default four where bodies are free, which lets them
    /// stack, and one where joints connect them: there more cost four times as much, and follow MuJoCo no better.
    pub iterations: Option<usize>,
    /// Whether fast bodies are stopped at what they would pass through. MuJoCo has nothing of the kind.
    pub continuous: bool,
    /// Whether contacts of pairs that barely moved are kept from step to step: faster, and less exact.
    pub recycling: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { substeps: 1, iterations: None, continuous: false, recycling: false }
    }
}

impl Options {
    /// Steps of rapier in a time step.
    #[must_use]
    pub fn with_substeps(mut self, substeps: usize) -> Self {
        self.substeps = substeps.max(1);
        self
    }

    /// Iterations of rapier's solver while anything is near.
    #[must_use]
    pub fn with_iterations(mut self, iterations: usize) -> Self {
        self.iterations = Some(iterations.max(1));
        self
    }

    /// Whether fast bodies are stopped at what they would pass through.
    #[must_use]
    pub fn with_continuous(mut self, continuous: bool) -> Self {
        self.continuous = continuous;
        self
    }

    /// Whether contacts of pairs that barely moved are kept.
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
    /// Positions as they were last read or placed, to see what a program has written.
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
        // MuJoCo's contacts begin at zero distance; rapier has to see them a step ahead.
        parameters.normalized_prediction_distance = 0.002;
        let mut sets = Sets {
            bodies: &mut physics.bodies,
            colliders: &mut physics.colliders,
            multibodies: &mut physics.multibody_joints,
        };
        let body = Body::insert(m, &mut sets)?;
        Ok(World { physics, body, placed: Vec::new(), mocap: Vec::new(), options })
    }

    /// Rapier's own world, to look at.
    pub fn physics(&self) -> &PhysicsWorld {
        &self.physics
    }

    /// How rapier solves: what [`Options`] do not say. The length of a step and the number of its parts are set at every step.
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

    /// Follows what a program has written into positions.
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

    /// How the next step of rapier, of `dt` seconds, is divided: motion without contacts needs no division.
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
            // Both pipelines are working memory.
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
