//! A robot of MJCF in a program's own rapier, and bodies of that program that touch it.

use physics::{Data, Model};
use robohive_rapier::rapier::prelude::*;
use robohive_rapier::{Hooks, Robot};

const ARM: &str = "<mujoco><option timestep='.002'/>
    <worldbody><body pos='0 0 1'><joint name='shoulder' axis='0 1 0' range='-90 90' damping='.5'/>
    <geom type='capsule' fromto='0 0 0 .4 0 0' size='.04'/>
    <body pos='.4 0 0'><joint name='elbow' axis='0 1 0' range='-120 20' damping='.2'/>
    <geom type='capsule' fromto='0 0 0 .3 0 0' size='.03'/><site name='hand' pos='.2 0 .03'/></body>
    <site name='origin' pos='.1 0 .06'/></body></worldbody>
    <tendon><spatial name='biceps'><site site='origin'/><site site='hand'/></spatial></tendon>
    <actuator><muscle name='biceps' tendon='biceps' force='400' lengthrange='.2 .55'/></actuator>
    <sensor><actuatorfrc actuator='biceps'/></sensor></mujoco>";

fn arm() -> Model {
    mjcf::load_str(ARM).unwrap().model
}

fn world() -> PhysicsWorld {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.dt = 0.002;
    world.integration_parameters.num_solver_iterations = 1;
    world
}

fn insert(world: &mut PhysicsWorld, m: &Model) -> Robot {
    Robot::insert(m, &mut world.bodies, &mut world.colliders, &mut world.multibody_joints).unwrap()
}

fn step(world: &mut PhysicsWorld, robots: &mut [Robot]) {
    for robot in &mut *robots {
        let PhysicsWorld { gravity, integration_parameters, bodies, multibody_joints, .. } = world;
        robot.before_step(*gravity, integration_parameters, bodies, multibody_joints).unwrap();
    }
    let all: Vec<_> = robots.iter().collect();
    world.step_with_events(&Hooks::new(&all, &()), &());
    for robot in robots {
        let PhysicsWorld { narrow_phase, bodies, multibody_joints, .. } = &*world;
        robot.after_step(narrow_phase, bodies, multibody_joints).unwrap();
    }
}

#[test]
fn muscles_move_it_as_under_our_pipeline() {
    let m = arm();
    let mut world = world();
    let mut robots = [insert(&mut world, &m)];
    let mut own = Data::new(&m);
    for _ in 0..300 {
        own.state.ctrl[0] = 0.7;
        robots[0].data.state.ctrl[0] = 0.7;
        physics::step(&m, &mut own).unwrap();
        step(&mut world, &mut robots);
    }
    let found = &robots[0].data;
    assert!(own.state.act[0] > 0.6 && own.state.qpos[1] < -0.2, "{:?}", own.state.qpos);
    for (a, b) in own.state.qpos.iter().zip(&found.state.qpos) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    assert!((own.sensor.sensordata[0] - found.sensor.sensordata[0]).abs() < 1e-6);
    let hand = world.bodies[robots[0].rigid_body(2).unwrap()].position();
    assert!((hand.translation.z - found.kin.xpos[2][2]).abs() < 0.01);
}

#[test]
fn bodies_of_the_program_touch_it() {
    let m = arm();
    let mut world = world();
    world.gravity = Vector::ZERO;
    let (ball, _) = world.insert(
        RigidBodyBuilder::dynamic().translation(Vector::new(0.2, 0.0, 1.2)).linvel(Vector::Z * -2.0),
        ColliderBuilder::ball(0.05).density(500.0),
    );
    let mut robots = [insert(&mut world, &m)];
    let momentum = world.bodies[ball].mass() * 2.0;
    for _ in 0..80 {
        step(&mut world, &mut robots);
    }
    let found = &robots[0].data;
    assert!(found.state.qpos[0] > 0.02 && found.state.qvel[0] > 0.1, "{:?}", found.state.qpos);
    let left = world.bodies[ball].mass() * -world.bodies[ball].linvel().z;
    assert!(left < 0.9 * momentum, "the arm held the ball off: {left} of {momentum}");
    assert!(found.con.contact.is_empty(), "a contact of geoms is between geoms");
}

#[test]
fn two_robots_and_their_own_rules_share_a_world() {
    let m = arm();
    let mut world = world();
    world.gravity = Vector::ZERO;
    let mut robots = [insert(&mut world, &m), insert(&mut world, &m)];
    for _ in 0..20 {
        step(&mut world, &mut robots);
    }
    // Both stand in the same place, and push each other apart; upper arm and forearm of one are parent and child, and do not.
    let off = |robot: &Robot| robot.data.state.qvel.iter().fold(0.0, |sum: f64, v| sum.max(v.abs()));
    let pairs = world.narrow_phase.contact_pairs().filter(|pair| pair.has_any_active_contact());
    let own = |pair: &ContactPair, robot: &Robot| {
        [0, 1].iter().all(|&g| [pair.collider1, pair.collider2].contains(&robot.collider(g).unwrap()))
    };
    let found: Vec<_> = pairs.collect();
    assert!(!found.is_empty() && found.iter().all(|pair| !robots.iter().any(|robot| own(pair, robot))));
    assert!(robots.iter().all(|robot| off(robot).is_finite()));
}

#[test]
fn a_state_that_a_program_writes_is_taken() {
    let m = arm();
    let mut world = world();
    let mut robots = [insert(&mut world, &m)];
    step(&mut world, &mut robots);
    robots[0].data.state.qpos[0] = 0.5;
    robots[0].data.state.qvel.fill(0.0);
    step(&mut world, &mut robots);
    assert!((robots[0].data.state.qpos[0] - 0.5).abs() < 1e-3);
    robots[0].data.state.qvel[0] = f64::NAN;
    let PhysicsWorld { gravity, integration_parameters, bodies, multibody_joints, .. } = &mut world;
    let said = robots[0].before_step(*gravity, integration_parameters, bodies, multibody_joints);
    assert!(said.unwrap_err().to_string().contains("shoulder"));
}
