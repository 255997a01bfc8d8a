//! Rapier in a Bevy program: its sets, its step, and the poses that others see.

use bevy_app::prelude::*;
use bevy_ecs::prelude::*;
use bevy_transform::prelude::Transform;
use rapier::rapier::prelude::*;
use rapier::{Hooks, Robot};
use std::time::Duration;

/// Time step of the simulation.
pub const STEP: Duration = Duration::from_micros(2500);

/// Rapier's sets.
#[derive(Resource)]
pub struct Physics(pub PhysicsWorld);

/// An entity that is where a collider is.
#[derive(Component)]
pub struct Follows(pub ColliderHandle);

/// A robot among rapier's bodies.
#[derive(Component)]
pub struct Simulated(pub Robot);

/// Order within a step: controls, then rapier, then whatever looks at the outcome.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Phase {
    Control,
    Step,
    Look,
}

/// Steps rapier, with all robots in it, in `FixedUpdate`.
pub struct RapierPlugin;

impl Plugin for RapierPlugin {
    fn build(&self, app: &mut App) {
        let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
        world.integration_parameters.dt = STEP.as_secs_f64();
        app.insert_resource(Physics(world))
            .configure_sets(FixedUpdate, (Phase::Control, Phase::Step, Phase::Look).chain())
            .add_systems(FixedUpdate, (step, show).chain().in_set(Phase::Step));
    }
}

/// One step of rapier, between the two halves of each robot's.
fn step(mut physics: ResMut<Physics>, mut robots: Query<&mut Simulated>) -> Result {
    let world = &mut physics.0;
    for mut robot in &mut robots {
        let PhysicsWorld { gravity, integration_parameters, bodies, multibody_joints, .. } = &mut *world;
        robot.0.before_step(*gravity, integration_parameters, bodies, multibody_joints)?;
    }
    let all: Vec<&Robot> = robots.iter().map(|robot| &robot.0).collect();
    world.step_with_events(&Hooks::new(&all, &()), &());
    for mut robot in &mut robots {
        let PhysicsWorld { narrow_phase, bodies, multibody_joints, .. } = &*world;
        robot.0.after_step(narrow_phase, bodies, multibody_joints)?;
    }
    Ok(())
}

/// Copies poses to where Bevy looks for them, in the single precision that it draws in.
fn show(physics: Res<Physics>, mut all: Query<(&Follows, &mut Transform)>) {
    for (follows, mut transform) in &mut all {
        let pose = physics.0.colliders[follows.0].position();
        transform.translation = pose.translation.as_vec3();
        transform.rotation = pose.rotation.as_quat();
    }
}
