//! The robot: from MJCF into the program's rapier, and its gait.

use crate::physics::{Follows, Phase, Physics, STEP, Simulated};
use bevy_app::prelude::*;
use bevy_ecs::prelude::*;
use bevy_transform::prelude::Transform;
use rapier::Robot;
use rapier::rapier::prelude::*;
use teleop::{Mapping, Trot};

/// Steps of the simulation in a tick of the gait.
const TICK: usize = 10;
/// Time before the robot sets off \[s\].
const STANDS: f64 = 0.5;

/// What walks a robot.
#[derive(Component)]
pub struct Gait {
    trot: Trot,
    controls: Vec<f64>,
    ticks: usize,
}

/// Puts the robot into the world, and walks it.
pub struct QuadrupedPlugin;

impl Plugin for QuadrupedPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, insert).add_systems(FixedUpdate, walk.in_set(Phase::Control));
    }
}

/// Inserts the robot, its floor included, and an entity for each of its colliders.
fn insert(mut commands: Commands, mut physics: ResMut<Physics>) -> Result {
    let text = assets::text("quadruped/quadruped.xml").ok_or("no quadruped")?;
    let model = mjcf::load_str(text)?.model;
    let PhysicsWorld { bodies, colliders, multibody_joints, .. } = &mut physics.0;
    let mut robot = Robot::insert(&model, bodies, colliders, multibody_joints)?;
    robot.data.reset_to_key(&model, 0)?;
    let trot = Trot::of(&model, &robot.data, Mapping::default().base)?;
    let controls = robot.data.state.ctrl.clone();
    commands.spawn_batch(
        (0..model.ngeom)
            .filter_map(|geom| robot.collider(geom))
            .map(|handle| (Follows(handle), Transform::IDENTITY))
            .collect::<Vec<_>>(),
    );
    commands.spawn((Simulated(robot), Gait { trot, controls, ticks: 0 }));
    Ok(())
}

/// Stands, then trots ahead.
fn walk(mut robots: Query<(&mut Simulated, &mut Gait)>) {
    for (mut robot, mut gait) in &mut robots {
        let Gait { trot, controls, ticks } = &mut *gait;
        if ticks.is_multiple_of(TICK) {
            let ahead = if robot.0.data.time() < STANDS { 0.0 } else { 1.0 };
            let dt = TICK as f64 * STEP.as_secs_f64();
            trot.step(robot.0.model(), &robot.0.data, [ahead, 0.0, 0.0], dt, controls);
        }
        *ticks += 1;
        robot.0.data.state.ctrl.copy_from_slice(controls);
    }
}
