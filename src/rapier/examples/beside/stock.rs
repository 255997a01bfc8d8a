//! The same models as rapier's own loader sets them up, in single precision as it does.

use crate::motion::Motion;
use crate::scenes::controls;
use physics::Model;
use physics::model::GeomType;
use rapier3d::prelude::*;
use rapier3d_mjcf::{MjcfLoaderOptions, MjcfMultibodyOptions, MjcfRobot};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// The shape of a geom of a pile.
fn collider(m: &Model, g: usize) -> Option<ColliderBuilder> {
    let [a, b, c] = m.geom_size[g].map(|x| x as f32);
    Some(match GeomType::from_code(m.geom_type[g])? {
        GeomType::Plane => ColliderBuilder::new(SharedShape::halfspace(Vector::Z)),
        GeomType::Box => ColliderBuilder::cuboid(a, b, c),
        GeomType::Sphere => ColliderBuilder::ball(a),
        GeomType::Capsule => ColliderBuilder::capsule_z(b, a),
        _ => return None,
    })
}

/// A pile of free bodies of one geom each, with rapier's own settings and densities, for some steps; the number of contacts at the end.
pub fn pile(m: &Model, steps: usize) -> usize {
    let mut world = PhysicsWorld { gravity: Vector::Z * -9.81, ..PhysicsWorld::default() };
    world.integration_parameters.dt = m.opt.timestep as f32;
    for g in 0..m.ngeom {
        let Some(collider) = collider(m, g) else { continue };
        let collider = collider.density(1000.0).friction(m.geom_friction[g][0] as f32);
        let [x, y, z] = m.body_pos[m.geom_bodyid[g] as usize].map(|x| x as f32);
        if m.geom_bodyid[g] == 0 {
            world.insert_collider(collider, None);
        } else {
            world.insert(RigidBodyBuilder::dynamic().translation(Vector::new(x, y, z)), collider);
        }
    }
    (0..steps).for_each(|_| world.step());
    let manifolds = world.narrow_phase.contact_pairs().flat_map(|pair| pair.solver_manifolds());
    manifolds.map(|manifold| manifold.data.solver_contacts.len()).sum()
}

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
