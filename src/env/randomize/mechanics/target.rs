//! What belongs to the physics of a scene, and how it is written into a model.

use super::config::Keeps;
use super::place::{Free, free_joint};
use super::size;
use crate::error::EnvError;
use crate::peak_force::{FORCE_SCALE, PEAK_FORCE};
use crate::randomize::dial::{Target, rotation, three};
use crate::scene::Scene;
use physics::Model;
use physics::math::{add, quat_mul};
use physics::model::{BiasType, Draft, GainType, JointType};

/// What is written, by the number of the element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    Mass(usize),
    Friction(usize),
    Damping(usize),
    FrictionLoss(usize),
    Armature(usize),
    Gain(usize),
    ControlDelay(usize),
    SensorDelay(usize),
    Readings,
    Gravity,
    GeomSize(usize, Keeps),
    BodySize(usize, Keeps),
    Place(usize),
    Shift(usize),
    Yaw(usize),
}

/// Numbers of a gain or bias that its force is proportional to.
pub(super) enum Force {
    /// The first three.
    Affine,
    /// The peak force, or the scale from which it follows.
    Muscle,
}

impl Force {
    /// Of a gain and the bias that belongs to it; `None` where other numbers decide the force as well.
    pub fn of(m: &Model, actuator: usize) -> Option<Force> {
        let bias = BiasType::from_code(m.actuator_biastype[actuator])?;
        match (GainType::from_code(m.actuator_gaintype[actuator])?, bias) {
            (GainType::Fixed | GainType::Affine | GainType::Pid, BiasType::None | BiasType::Affine) => {
                Some(Force::Affine)
            }
            (GainType::Muscle, BiasType::None | BiasType::Muscle) => Some(Force::Muscle),
            _ => None,
        }
    }

    fn grow(&self, factor: f64, parameters: &mut [f64; 10]) {
        match self {
            Force::Affine => parameters[..3].iter_mut().for_each(|number| *number *= factor),
            Force::Muscle if parameters[PEAK_FORCE] < 0.0 => parameters[FORCE_SCALE] *= factor,
            Force::Muscle => parameters[PEAK_FORCE] *= factor,
        }
    }
}

impl Target for Quantity {
    const SETTING: &'static str = "physics_randomization";
    const STREAM: u64 = 2;

    fn change(scene: &mut Scene, write: impl FnOnce(&mut Draft<'_>)) -> Result<(), EnvError> {
        Ok(scene.model.edit(write)?)
    }

    fn turns_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Quantity::GeomSize(a, _), Quantity::GeomSize(b, _)) => a == b,
            (Quantity::BodySize(a, _), Quantity::BodySize(b, _)) => a == b,
            _ => self == other,
        }
    }

    fn restore(&self, base: &Model, m: &mut Draft<'_>) {
        match *self {
            Quantity::Mass(body) => size::restore_mass(body, base, m),
            Quantity::Friction(geom) => m.geom_friction[geom] = base.geom_friction[geom],
            Quantity::Damping(joint) => dofs(base, joint).for_each(|dof| {
                m.dof_damping[dof] = base.dof_damping[dof];
                m.dof_dampingpoly[dof] = base.dof_dampingpoly[dof];
            }),
            Quantity::FrictionLoss(joint) => {
                dofs(base, joint).for_each(|dof| m.dof_frictionloss[dof] = base.dof_frictionloss[dof]);
            }
            Quantity::Armature(joint) => {
                dofs(base, joint).for_each(|dof| m.dof_armature[dof] = base.dof_armature[dof]);
            }
            Quantity::Gain(actuator) => {
                m.actuator_gainprm[actuator] = base.actuator_gainprm[actuator];
                m.actuator_biasprm[actuator] = base.actuator_biasprm[actuator];
            }
            Quantity::ControlDelay(actuator) => m.actuator_delay[actuator] = base.actuator_delay[actuator],
            Quantity::SensorDelay(sensor) => m.sensor_delay[sensor] = base.sensor_delay[sensor],
            Quantity::Gravity => m.opt.gravity = base.opt.gravity,
            Quantity::GeomSize(geom, _) => {
                size::restore_geom(geom, base, m);
                size::restore_mass(base.geom_bodyid[geom] as usize, base, m);
            }
            Quantity::BodySize(body, _) => size::restore_body(body, base, m),
            Quantity::Place(body) | Quantity::Shift(body) if free_joint(base, body).is_none() => {
                m.body_pos[body] = base.body_pos[body];
            }
            Quantity::Yaw(body) if free_joint(base, body).is_none() => {
                m.body_quat[body] = base.body_quat[body]
            }
            Quantity::Place(_) | Quantity::Shift(_) | Quantity::Yaw(_) | Quantity::Readings => {}
        }
    }

    fn write(&self, values: &[f64], base: &Model, m: &mut Draft<'_>) {
        let factor = values[0];
        match *self {
            Quantity::Mass(body) => {
                m.body_mass[body] *= factor;
                m.body_inertia[body].iter_mut().for_each(|moment| *moment *= factor);
            }
            Quantity::Friction(geom) => m.geom_friction[geom].iter_mut().for_each(|number| *number *= factor),
            Quantity::Damping(joint) => dofs(base, joint).for_each(|dof| {
                m.dof_damping[dof] *= factor;
                m.dof_dampingpoly[dof].iter_mut().for_each(|number| *number *= factor);
            }),
            Quantity::FrictionLoss(joint) => {
                dofs(base, joint).for_each(|dof| m.dof_frictionloss[dof] *= factor);
            }
            Quantity::Armature(joint) => dofs(base, joint).for_each(|dof| m.dof_armature[dof] *= factor),
            Quantity::Gain(actuator) => {
                let Some(force) = Force::of(base, actuator) else { return };
                force.grow(factor, &mut m.actuator_gainprm[actuator]);
                force.grow(factor, &mut m.actuator_biasprm[actuator]);
            }
            Quantity::ControlDelay(actuator) => m.actuator_delay[actuator] = values[0],
            Quantity::SensorDelay(sensor) => m.sensor_delay[sensor] = values[0],
            Quantity::Gravity => m.opt.gravity = three(values),
            Quantity::GeomSize(geom, keeps) => {
                size::grow_geom(geom, factor, m);
                size::grow_mass(base.geom_bodyid[geom] as usize, factor, keeps, m);
            }
            Quantity::BodySize(body, keeps) => size::grow_body(body, factor, keeps, base, m),
            Quantity::Place(body) if free_joint(base, body).is_none() => {
                m.body_pos[body][..2].copy_from_slice(values);
            }
            Quantity::Shift(body) if free_joint(base, body).is_none() => {
                m.body_pos[body] = add(m.body_pos[body], three(values));
            }
            Quantity::Yaw(body) if free_joint(base, body).is_none() => {
                m.body_quat[body] = quat_mul(rotation([0.0, 0.0, values[0]]), m.body_quat[body]);
            }
            Quantity::Place(_) | Quantity::Shift(_) | Quantity::Yaw(_) | Quantity::Readings => {}
        }
    }
}

impl Quantity {
    /// The body with a free joint that grows.
    pub(super) fn grown(&self, m: &Model) -> Option<Free> {
        let body = match *self {
            Quantity::GeomSize(geom, _) => m.geom_bodyid[geom] as usize,
            Quantity::BodySize(body, _) => body,
            _ => return None,
        };
        Some(Free { body, qpos: free_joint(m, body)? })
    }

    /// Writes where a body with a free joint starts.
    pub(super) fn place(&self, values: &[f64], m: &Model, start: &mut [f64]) {
        let (Quantity::Place(body) | Quantity::Shift(body) | Quantity::Yaw(body)) = *self else { return };
        let Some(first) = free_joint(m, body) else { return };
        let pose = &mut start[first..first + 7];
        match *self {
            Quantity::Place(_) => pose[..2].copy_from_slice(values),
            Quantity::Shift(_) => pose.iter_mut().zip(values).for_each(|(x, shift)| *x += shift),
            _ => {
                let turned = quat_mul(rotation([0.0, 0.0, values[0]]), std::array::from_fn(|k| pose[3 + k]));
                pose[3..].copy_from_slice(&turned);
            }
        }
    }
}

/// The degrees of freedom of a joint.
fn dofs(m: &Model, joint: usize) -> std::ops::Range<usize> {
    let first = m.jnt_dofadr[joint] as usize;
    let count = match JointType::from_code(m.jnt_type[joint]) {
        Some(JointType::Free) => 6,
        Some(JointType::Ball) => 3,
        _ => 1,
    };
    first..first + count
}
