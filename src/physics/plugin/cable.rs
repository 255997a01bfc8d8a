//! `mujoco.elasticity.cable`: bending and twisting of a chain of bodies. Each body turns by a ball or free joint
//! against the one before it.
//!
//! Stress between two neighbours is stiffness times the difference between their curvature and the curvature at rest, per
//! unit of length; with `vmax` \[N m\] its norm colours the geoms in pictures, from blue to red. The half-way frames of the
//! discrete elastic rods of Bergou et al. 2008 are the frames of the bodies here.

use crate::math::{
    IDENTITY, Quat, Vec3, add, dot, norm, ops, quat_conj, quat_difference, quat_mul, quat_rotate,
    quat_to_velocity, rotational, scale, sub,
};
use crate::model::{
    Appearance, AppearanceInputs, AttributeError, Capability, Config, Disable, GeomType, Instance, JointType,
    Model, PassiveInputs, Plugin,
};
use crate::position::chain::chain;
use crate::position::kinematics::kinematics;
use crate::stages::{Kinematics, State};
use std::f64::consts::PI;

/// The plugin.
#[derive(Debug)]
pub(super) struct Cable;

impl Plugin for Cable {
    fn name(&self) -> &str {
        "mujoco.elasticity.cable"
    }

    fn attributes(&self) -> &[&str] {
        &["twist", "bend", "flat", "vmax"]
    }

    fn capabilities(&self) -> &[Capability] {
        &[Capability::Passive]
    }

    fn instance(&self, config: &Config, m: &Model, id: usize) -> Result<Box<dyn Instance>, AttributeError> {
        let modulus = |name| config.number(name).map(Option::unwrap_or_default);
        let material = Material { shear: modulus("twist")?, young: modulus("bend")? };
        let reddest = modulus("vmax")?;
        let flat = config.text("flat") == "true";
        let bodies: Vec<usize> = (1..m.nbody).filter(|&b| m.body_plugin[b] == id as i32).collect();
        let Some(&first) = bodies.first() else {
            return Ok(Box::new(Rod { first: 0, parts: Vec::new(), reddest }));
        };
        if bodies.last() != Some(&(first + bodies.len() - 1)) {
            return Err(
                "the bodies that use the instance must follow each other: give others their own".into()
            );
        }
        if let Some(b) = bodies[1..].iter().find(|&&b| quaternion(m, b).is_none()) {
            return Err(format!(
                "body {b} must turn against the one before it: give it a ball joint, its last"
            )
            .into());
        }
        let kin = at_reference(m);
        let parts =
            bodies.iter().map(|&b| part(m, &kin, b, b > first, flat, &material)).collect::<Result<_, _>>()?;
        Ok(Box::new(Rod { first, parts, reddest }))
    }
}

/// Moduli \[Pa\].
struct Material {
    shear: f64,
    young: f64,
}

/// A chain of bodies.
#[derive(Debug)]
struct Rod {
    first: usize,
    parts: Vec<Part>,
    /// Moment that is shown red \[N m\]; 0 shows none.
    reddest: f64,
}

/// One body of the chain.
#[derive(Debug)]
struct Part {
    /// Stiffness against twist and against bending about y and z \[N m²\].
    stiffness: Vec3,
    /// Distance from the body before it \[m\].
    length: f64,
    /// Rotation against the body before it at rest, as a vector.
    rest: Vec3,
}

/// Poses at `qpos0`, mocap bodies at the origin.
fn at_reference(m: &Model) -> Kinematics {
    let mut state = State::new(m);
    state.qpos.copy_from_slice(&m.qpos0);
    let mut kin = Kinematics::new(m);
    kinematics(m, &state, &mut kin);
    kin
}

fn part(
    m: &Model,
    kin: &Kinematics,
    body: usize,
    follows: bool,
    flat: bool,
    material: &Material,
) -> Result<Part, AttributeError> {
    let geom = usize::try_from(m.body_geomadr[body]).map_err(|_| format!("body {body} has no geom"))?;
    let [twist, about_y, about_z] = section(m, geom);
    let rest = match follows && !flat {
        true => quat_difference(m.body_quat[body], relative(m, &m.qpos0, body)),
        false => [0.0; 3],
    };
    let length = if follows { norm(sub(kin.xpos[body], kin.xpos[body - 1])) } else { 0.0 };
    let stiffness = [twist * material.shear, about_y * material.young, about_z * material.young];
    Ok(Part { stiffness, length, rest })
}

/// Torsion constant and second moments of area of the cross section of a geom \[m⁴\]; zero for shapes without one.
fn section(m: &Model, geom: usize) -> Vec3 {
    let size = m.geom_size[geom];
    let power = ops::pow;
    match GeomType::from_code(m.geom_type[geom]) {
        Some(GeomType::Cylinder | GeomType::Capsule) => {
            let fourth = PI * power(size[0], 4.0);
            [fourth / 2.0, fourth / 4.0, fourth / 4.0]
        }
        Some(GeomType::Box) => {
            let (h, w) = (size[1], size[2]);
            let (a, b) = (h.max(w), h.min(w));
            let slender = 16.0 / 3.0 - 3.36 * b / a * (1.0 - power(b, 4.0) / power(a, 4.0) / 12.0);
            [
                a * power(b, 3.0) * slender,
                power(2.0 * w, 3.0) * 2.0 * h / 12.0,
                power(2.0 * h, 3.0) * 2.0 * w / 12.0,
            ]
        }
        _ => [0.0; 3],
    }
}

/// Place in `qpos` of the quaternion of the last joint of `body`.
fn quaternion(m: &Model, body: usize) -> Option<usize> {
    let first = usize::try_from(m.body_jntadr[body]).ok()?;
    let last = first + m.body_jntnum[body] as usize - 1;
    let at = m.jnt_qposadr[last] as usize;
    match JointType::from_code(m.jnt_type[last])? {
        JointType::Ball => Some(at),
        JointType::Free => Some(at + 3),
        JointType::Slide | JointType::Hinge => None,
    }
}

/// The quaternion of the last joint of `body`.
fn relative(m: &Model, qpos: &[f64], body: usize) -> Quat {
    let found = quaternion(m, body).and_then(|at| qpos.get(at..)?.first_chunk());
    found.copied().unwrap_or(IDENTITY)
}

impl Part {
    /// Moment of the bond to the body before, turned by `quat` against it.
    fn moment(&self, quat: Quat) -> Vec3 {
        let curvature = quat_to_velocity(quat, 1.0);
        std::array::from_fn(|k| -self.stiffness[k] * (curvature[k] - self.rest[k]) / self.length)
    }
}

/// Rotation of `body` against the one before it.
fn turn(m: &Model, qpos: &[f64], body: usize) -> Quat {
    quat_mul(m.body_quat[body], relative(m, qpos, body))
}

/// Blue, cyan, green, yellow and red, evenly from 0 to `reddest`.
fn rainbow(x: f64, reddest: f64) -> [f64; 3] {
    let place = 4.0 * x.max(0.0).min(reddest) / reddest;
    if place < 1.0 {
        [0.0, place, 1.0]
    } else if place < 2.0 {
        [0.0, 1.0, 2.0 - place]
    } else if place < 3.0 {
        [place - 2.0, 1.0, 0.0]
    } else {
        [1.0, 4.0 - place, 0.0]
    }
}

impl Rod {
    /// Moment of the bond between part `k` and the one before it, in the frame of that; zero for the first part.
    fn bond(&self, m: &Model, qpos: &[f64], k: usize) -> Vec3 {
        let disabled = |flag: Disable| m.opt.disableflags.contains(flag);
        if k == 0 || disabled(Disable::SPRING) && disabled(Disable::DAMPER) {
            return [0.0; 3];
        }
        let quat = turn(m, qpos, self.first + k);
        quat_rotate(quat_conj(quat), self.parts[k].moment(quat))
    }
}

impl Instance for Rod {
    fn appearance(&self, inputs: &AppearanceInputs, out: &mut Appearance) {
        if self.reddest == 0.0 {
            return;
        }
        let (m, qpos) = (inputs.m, &inputs.at.state.qpos);
        let last = self.parts.len().saturating_sub(1);
        for k in 0..self.parts.len() {
            // Ends show their only bond.
            let [before, after] = [k.max(1).min(last), (k + 1).min(last)].map(|k| self.bond(m, qpos, k));
            let strength = norm(scale(add(before, after), 0.5));
            let geom = m.body_geomadr[self.first + k] as usize;
            let [r, g, b] = rainbow(strength, self.reddest).map(|x| x as f32);
            out.colour_geom(geom, [r, g, b, m.geom_rgba[geom][3]]);
        }
    }

    fn passive(&self, inputs: &PassiveInputs, qfrc: &mut [f64]) {
        let PassiveInputs { m, at, .. } = *inputs;
        let turn = |body: usize| turn(m, &at.state.qpos, body);
        for (k, part) in self.parts.iter().enumerate() {
            if part.stiffness == [0.0; 3] {
                continue;
            }
            let body = self.first + k;
            let mut torque = [0.0; 3];
            if k > 0 {
                let quat = turn(body);
                torque = add(torque, quat_rotate(quat_conj(quat), part.moment(quat)));
            }
            if let Some(next) = self.parts.get(k + 1) {
                torque = sub(torque, next.moment(turn(body + 1)));
            }
            let torque = quat_rotate(at.kin.xquat[body], torque);
            for dof in chain(m, body) {
                qfrc[dof] += dot(rotational(&at.com.cdof[dof]), torque);
            }
        }
    }
}
