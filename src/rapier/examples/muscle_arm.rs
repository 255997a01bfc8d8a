//! A program of rapier with bodies of its own, and among them an arm out of MJCF that a muscle moves: it throws a ball off a
//! table.
//!
//! ```sh
//! cargo run -p robohive-rapier --example muscle_arm
//! ```

use robohive_rapier::rapier::prelude::*;
use robohive_rapier::{Hooks, Robot};
use std::error::Error;

const ARM: &str = "
<mujoco>
  <worldbody>
    <site name='origin' pos='-.1 0 .95'/>
    <body name='arm' pos='0 0 1'>
      <joint name='shoulder' axis='0 1 0' range='-10 100' damping='.3'/>
      <geom type='capsule' fromto='0 0 -.05 0 0 -.45' size='.03' mass='1.2'/>
      <site name='insertion' pos='-.03 0 -.2'/>
    </body>
  </worldbody>
  <tendon>
    <spatial name='triceps'><site site='origin'/><site site='insertion'/></spatial>
  </tendon>
  <actuator>
    <muscle name='triceps' tendon='triceps' force='600' lengthrange='.1 .35'/>
  </actuator>
</mujoco>";

fn main() -> Result<(), Box<dyn Error>> {
    // The program's own world: a table, and a ball on it.
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.dt = 0.002;
    world.insert(
        RigidBodyBuilder::fixed().translation(Vector::new(-0.4, 0.0, 0.45)),
        ColliderBuilder::cuboid(0.35, 0.3, 0.02),
    );
    let (ball, _) = world.insert(
        RigidBodyBuilder::dynamic().translation(Vector::new(-0.09, 0.0, 0.51)),
        ColliderBuilder::ball(0.04).density(500.0),
    );

    // The arm, from text; its geoms touch the program's bodies as colliders do.
    let model = mjcf::load_str(ARM)?.model;
    let PhysicsWorld { bodies, colliders, multibody_joints, .. } = &mut world;
    let mut arm = Robot::insert(&model, bodies, colliders, multibody_joints)?;

    for step in 0..500 {
        // The muscle is excited after a tenth of a second; its activation follows.
        arm.data.state.ctrl[0] = if step < 50 { 0.0 } else { 1.0 };
        let PhysicsWorld { gravity, integration_parameters, bodies, multibody_joints, .. } = &mut world;
        arm.before_step(*gravity, integration_parameters, bodies, multibody_joints)?;
        world.step_with_events(&Hooks::new(&[&arm], &()), &());
        let PhysicsWorld { narrow_phase, bodies, multibody_joints, .. } = &world;
        arm.after_step(narrow_phase, bodies, multibody_joints)?;
        if step % 50 == 49 {
            let (angle, activation) = (arm.data.state.qpos[0].to_degrees(), arm.data.state.act[0]);
            let at = world.bodies[ball].translation();
            println!(
                "{:.1} s: shoulder {angle:6.1} degrees, activation {activation:.2}, ball at x {:6.2} z {:5.2} m",
                arm.data.time(),
                at.x,
                at.z
            );
        }
    }
    let thrown = world.bodies[ball].translation();
    if thrown.x > -0.2 {
        return Err(format!("the ball is still at {thrown}").into());
    }
    Ok(())
}
