//! The same models as rapier's own loader sets them up, in single precision as it does.

use crate::motion::Motion;
use crate::scenes::controls;
use physics::Model;
use rapier3d::prelude::*;
use rapier3d_mjcf::{MjcfLoaderOptions, MjcfMultibodyOptions, MjcfRobot};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Loads a model. What the loader says of those it refuses is about files of this machine.
pub fn load(path: &Path) -> Result<MjcfRobot, String> {
    let options = MjcfLoaderOptions { skip_plane_geoms: false, ..MjcfLoaderOptions::default() };
    // The loader panics on some files.
    let loaded = catch_unwind(AssertUnwindSafe(|| MjcfRobot::from_file(path, options)));
    match loaded {
        Ok(Ok((robot, _))) => Ok(robot),
        Ok(Err(_)) => Err("does not load".into()),
        Err(_) => Err("panics".into()),
    }
}

/// Moves it for some steps, and returns where the named bodies were.
pub fn simulate(path: &Path, m: &Model, names: &[(String, usize)], steps: usize) -> Result<Motion, String> {
    let robot = load(path)?;
    let moved = catch_unwind(AssertUnwindSafe(|| advance(robot, m, names, steps)));
    moved.map_err(|_| "panics".to_owned())
}

fn advance(robot: MjcfRobot, m: &Model, names: &[(String, usize)], steps: usize) -> Motion {
    let mut world = PhysicsWorld { gravity: robot.gravity, ..PhysicsWorld::default() };
    world.integration_parameters.dt = m.opt.timestep as f32;
    let PhysicsWorld { bodies, colliders, multibody_joints, impulse_joints, .. } = &mut world;
    let handles = robot.clone().insert_using_multibody_joints(
        bodies,
        colliders,
        multibody_joints,
        impulse_joints,
        MjcfMultibodyOptions::empty(),
    );
    if let Some(key) = robot.keyframes.first() {
        handles.apply_keyframe(bodies, multibody_joints, &robot, key);
    }
    let hooks = handles.contact_hooks(&robot);
    let of = |name: &String| {
        let index = robot.body_name_to_idx.get(name)?;
        handles.bodies[*index].as_ref().map(|found| found.body)
    };
    let found: Vec<_> = names.iter().map(|(name, _)| of(name)).collect();
    let mut control = vec![0.0; m.nu];
    let mut motion = Motion::new();
    for step in 0..steps {
        controls(m, step as f64 * m.opt.timestep, &mut control);
        let single: Vec<f32> = control.iter().map(|&x| x as f32).collect();
        handles.apply_controls_multibody(&mut world.bodies, &mut world.multibody_joints, &single);
        handles.apply_gravity_compensation(&mut world.bodies, &robot, world.gravity);
        world.step_with_events(&hooks, &());
        let place = |handle: &Option<RigidBodyHandle>| {
            let at = handle.map_or(Vector::NAN, |handle| world.bodies[handle].translation());
            [at.x, at.y, at.z].map(f64::from)
        };
        motion.push(found.iter().map(place).collect());
    }
    motion
}
