//! A model's bodies, joints and shapes in rapier's sets: inserts them, sets their positions and velocities, and reads them back.

use crate::convert::{array, pose, quaternion, rotation, vector};
use crate::floating::{Floating, Pace};
use crate::groups::{Group, Groups, Motion};
use crate::links::{Link, Links, Tree};
use crate::rules::{self, Geoms};
use crate::shapes::touching_shapes;
use physics::Model;
use physics::data::State;
use physics::math::Quat;
use physics::model::{JointType, NotSimulated};
use rapier3d_f64::math::{Pose, Rotation, Vector};
use rapier3d_f64::prelude::{
    ColliderBuilder, ColliderHandle, ColliderSet, MassProperties, MultibodyJoint, MultibodyJointSet,
    RigidBody, RigidBodySet,
};
use std::sync::Arc;

/// A model's bodies in rapier's sets.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub groups: Groups,
    pub links: Links,
    /// Collider of each geom; `None` where the geom touches nothing.
    pub colliders: Vec<Option<ColliderHandle>>,
    /// Geom of each collider.
    pub geoms: Arc<Geoms>,
    /// Floating groups at the start of the step under way.
    start: Vec<Option<Floating>>,
}

/// Rapier's sets.
pub(crate) struct Sets<'a> {
    pub bodies: &'a mut RigidBodySet,
    pub colliders: &'a mut ColliderSet,
    pub multibodies: &'a mut MultibodyJointSet,
}

impl Body {
    /// Inserts a model at its reference configuration.
    ///
    /// # Errors
    /// The first element that is not simulated.
    pub fn insert(m: &Model, sets: &mut Sets<'_>) -> Result<Self, NotSimulated> {
        crate::refuse::check(m)?;
        let groups = Groups::new(m);
        let shapes: Vec<_> = touching_shapes(m).collect::<Result<_, _>>()?;
        let links = Links::insert(m, &groups, sets.bodies, sets.multibodies)?;
        let plainly = rules::mixes_plainly(m);
        let colliders = shapes.into_iter().map(|shape| {
            let shape = shape?;
            let mut collider = ColliderBuilder::new(shape.shape)
                .mass_properties(MassProperties::default())
                .position(groups.in_rigid_body(shape.body) * shape.pose)
                .build();
            let decides = m.npair == 0 && m.nexclude == 0 && !has_relatives(&groups, shape.body);
            rules::prepare(m, shape.geom, decides, plainly, &mut collider);
            Some(match groups.of_body[shape.body] {
                Some(k) => sets.colliders.insert_with_parent(collider, links.handles[k], sets.bodies),
                None => sets.colliders.insert(collider),
            })
        });
        let colliders: Vec<Option<ColliderHandle>> = colliders.collect();
        let geoms = colliders.iter().enumerate().filter_map(|(g, handle)| Some(((*handle)?, g))).collect();
        let start = vec![None; groups.all.len()];
        let mut body = Body { groups, links, colliders, geoms: Arc::new(geoms), start };
        // Masses of rigid bodies come from their additional mass properties; colliders have no density.
        for &handle in &body.links.handles {
            if let Some(rigid) = sets.bodies.get_mut(handle) {
                rigid.recompute_mass_properties_from_colliders(sets.colliders);
            }
        }
        body.place(m, &State::new(m), &m.qpos0, sets);
        Ok(body)
    }

    /// Sets the poses of bodies from `qpos`, and of mocap bodies from the state.
    pub fn place(&mut self, m: &Model, state: &State, qpos: &[f64], sets: &mut Sets<'_>) {
        for (group, &handle) in self.groups.all.iter().zip(&self.links.handles) {
            let at = match group.motion {
                Motion::Jointed => continue,
                Motion::Mocap => match usize::try_from(m.body_mocapid[group.body]) {
                    Ok(k) if norm(state.mocap_quat[k]) > 0.0 => pose(state.mocap_pos[k], state.mocap_quat[k]),
                    _ => pose(m.body_pos[group.body], m.body_quat[group.body]),
                },
                Motion::Alone | Motion::Floating => {
                    let q = &qpos[free_joint(m, group.body).0..][..7];
                    let turned = rotation([q[3], q[4], q[5], q[6]]);
                    Pose::from_parts(Vector::new(q[0], q[1], q[2]), turned) * group.frame()
                }
            };
            if let Some(rigid) = sets.bodies.get_mut(handle) {
                rigid.set_position(at, true);
            }
        }
        for tree in &self.links.trees {
            let Some(multibody) = tree.multibody_mut(sets.multibodies) else { continue };
            for link in &tree.links {
                if let Some(place) = multibody.link_mut(link.id) {
                    place.joint = at(m, link, &place.joint, qpos);
                }
            }
            multibody.forward_kinematics(sets.bodies, true);
            multibody.update_rigid_bodies(sets.bodies, true);
        }
    }

    /// Sets all velocities, at the present poses, for a step of rapier.
    pub fn set_in_motion(&mut self, m: &Model, qvel: &[f64], pace: Pace, sets: &mut Sets<'_>) {
        for k in 0..self.groups.all.len() {
            let (group, handle) = (&self.groups.all[k], self.links.handles[k]);
            let alone = group.motion == Motion::Alone;
            if !alone && group.motion != Motion::Floating {
                continue;
            }
            if let Some(rigid) = sets.bodies.get_mut(handle) {
                let start = Floating { com: group.origin, orientation: group.orientation(rigid), alone };
                self.start[k] = Some(start);
                if alone {
                    let (linear, angular) = start.to_rapier(&qvel[free_joint(m, group.body).1..], pace);
                    rigid.set_linvel(linear, true);
                    rigid.set_angvel(angular, true);
                }
            }
        }
        for tree in &self.links.trees {
            let Some(multibody) = tree.multibody_mut(sets.multibodies) else { continue };
            let mut rates = multibody.generalized_velocity_mut();
            rates.copy_from_slice(&qvel[tree.dofs.clone()]);
            if let Some(start) = tree.root.and_then(|k| self.start[k]) {
                let (linear, angular) = start.to_rapier(&qvel[tree.dofs.clone()], pace);
                rates.as_mut_slice()[..3].copy_from_slice(&array(linear));
                rates.as_mut_slice()[3..6].copy_from_slice(&array(angular));
            }
            for link in tree.links.iter().filter(|link| link.kind == JointType::Ball) {
                let turned = multibody.link(link.id).map_or(Rotation::IDENTITY, |l| l.joint.joint_rot());
                let own = Vector::from_slice(&qvel[tree.dofs.start + link.dof..][..3]);
                let mut rates = multibody.generalized_velocity_mut();
                rates.as_mut_slice()[link.dof..link.dof + 3].copy_from_slice(&array(turned * own));
            }
        }
    }

    /// Centripetal acceleration of the centres of mass of floating roots \[m/s²\], at constant velocity of their origins, as a generalised
    /// acceleration. MuJoCo's and rapier's bias forces differ by its force. Returns false if there is no floating root.
    pub fn centripetal(&self, m: &Model, qvel: &[f64], out: &mut Vec<f64>) -> bool {
        let roots = || self.links.trees.iter().filter_map(|tree| Some((tree, self.start[tree.root?]?)));
        out.clear();
        out.resize(m.nv, 0.0);
        for (tree, start) in roots() {
            let first = tree.dofs.start;
            let angular = start.orientation * Vector::from_slice(&qvel[first + 3..first + 6]);
            let towards = angular.cross(angular.cross(start.orientation * start.com));
            out[first..first + 3].copy_from_slice(&array(towards));
        }
        roots().next().is_some()
    }

    /// Reads positions and velocities after a step of rapier.
    pub fn read(&self, m: &Model, pace: Pace, from: (&RigidBodySet, &MultibodyJointSet), state: &mut State) {
        let (bodies, multibodies) = from;
        for k in 0..self.groups.all.len() {
            if let (Motion::Alone, Some(rigid)) =
                (self.groups.all[k].motion, bodies.get(self.links.handles[k]))
            {
                self.read_floating(m, k, rigid, (rigid.linvel(), rigid.angvel()), pace, state);
            }
        }
        for tree in &self.links.trees {
            let Some(multibody) = tree.multibody(multibodies) else { continue };
            let rates = multibody.generalized_velocity();
            let rates = rates.as_slice();
            if let Some((k, rigid)) = tree.root.and_then(|k| Some((k, bodies.get(self.links.handles[k])?))) {
                let velocities = (Vector::from_slice(&rates[..3]), Vector::from_slice(&rates[3..6]));
                self.read_floating(m, k, rigid, velocities, pace, state);
            }
            for link in &tree.links {
                let Some(place) = multibody.link(link.id) else { continue };
                let (q, v) = (m.jnt_qposadr[link.joint] as usize, tree.dofs.start + link.dof);
                if link.kind == JointType::Ball {
                    let turned = place.joint.joint_rot().normalize();
                    let own = turned.inverse() * Vector::from_slice(&rates[link.dof..link.dof + 3]);
                    state.qpos[q..q + 4].copy_from_slice(&quaternion(turned));
                    state.qvel[v..v + 3].copy_from_slice(&array(own));
                } else {
                    let axis = if link.kind == JointType::Slide { 0 } else { 3 };
                    state.qpos[q] = place.joint.coords()[axis] + m.qpos0[q];
                    state.qvel[v] = rates[link.dof];
                }
            }
        }
    }

    fn read_floating(
        &self,
        m: &Model,
        k: usize,
        rigid: &RigidBody,
        velocities: (Vector, Vector),
        pace: Pace,
        state: &mut State,
    ) {
        let Some(start) = self.start[k] else { return };
        let (q, v) = free_joint(m, self.groups.all[k].body);
        let turned = self.groups.all[k].orientation(rigid).normalize();
        state.qpos[q..q + 3].copy_from_slice(&array(rigid.translation() - turned * start.com));
        state.qpos[q + 3..q + 7].copy_from_slice(&quaternion(turned));
        start.to_qvel(turned, velocities, pace, &mut state.qvel[v..v + 6]);
    }

    /// Whether the model has the same numbers of bodies and geoms.
    pub fn fits(&self, m: &Model) -> bool {
        self.groups.of_body.len() == m.nbody && self.colliders.len() == m.ngeom
    }

    /// Whether rapier's own gyroscopic forces have to be cancelled.
    pub fn has_multibodies(&self) -> bool {
        !self.links.trees.is_empty()
    }

    /// Applies generalised forces as wrenches: each joint's on the body that it moves, and the opposite on its parent.
    pub fn push(&self, m: &Model, forces: &[f64], axes: &[[f64; 3]], sets: &mut Sets<'_>) {
        for tree in &self.links.trees {
            tree.release(sets.bodies);
            if let Some(k) = tree.root {
                self.push_root(k, &forces[tree.dofs.start..], sets);
            }
            for link in &tree.links {
                let force = &forces[tree.dofs.start + link.dof..];
                let along = vector(axes[link.joint]);
                match link.kind {
                    JointType::Hinge => link.twist(along * force[0], sets.bodies),
                    JointType::Slide => link.pull(along * force[0], sets.bodies),
                    JointType::Ball | JointType::Free => {
                        let frame = self.orientation(m, link, sets.bodies);
                        link.twist(frame * Vector::from_slice(&force[..3]), sets.bodies);
                    }
                }
            }
        }
    }

    fn push_root(&self, k: usize, force: &[f64], sets: &mut Sets<'_>) {
        if let Some(rigid) = sets.bodies.get_mut(self.links.handles[k]) {
            let turned = self.groups.all[k].orientation(rigid);
            let (linear, own) = (Vector::from_slice(&force[..3]), Vector::from_slice(&force[3..6]));
            let arm = turned * self.groups.all[k].origin;
            rigid.add_force(linear, false);
            rigid.add_torque(turned * own - arm.cross(linear), false);
        }
    }

    /// Orientation of the body that a ball joint moves.
    fn orientation(&self, m: &Model, link: &Link, bodies: &RigidBodySet) -> Rotation {
        let group = self.groups.of_body[m.jnt_bodyid[link.joint] as usize];
        let last =
            group.and_then(|k| Some(self.groups.all[k].orientation(bodies.get(self.links.handles[k])?)));
        last.unwrap_or(Rotation::IDENTITY)
    }
}

impl Group {
    /// Orientation of the model's body.
    fn orientation(&self, rigid: &RigidBody) -> Rotation {
        *rigid.rotation() * self.axes.inverse()
    }
}

impl Tree {
    /// Removes all forces from its bodies.
    fn release(&self, bodies: &mut RigidBodySet) {
        let handles = std::iter::once(self.handle).chain(self.links.iter().map(|link| link.handle));
        for handle in handles {
            if let Some(rigid) = bodies.get_mut(handle) {
                rigid.reset_forces(false);
                rigid.reset_torques(false);
            }
        }
    }
}

impl Link {
    fn twist(&self, torque: Vector, bodies: &mut RigidBodySet) {
        for (handle, torque) in [(self.handle, torque), (self.before, -torque)] {
            if let Some(rigid) = bodies.get_mut(handle) {
                rigid.add_torque(torque, false);
            }
        }
    }

    /// A force through the centre of mass of what the joint moves.
    fn pull(&self, force: Vector, bodies: &mut RigidBodySet) {
        let Some(point) = bodies.get(self.handle).map(RigidBody::center_of_mass) else { return };
        for (handle, force) in [(self.handle, force), (self.before, -force)] {
            if let Some(rigid) = bodies.get_mut(handle) {
                rigid.add_force_at_point(force, point, false);
            }
        }
    }
}

/// Whether bodies of the same tree may touch, so that contact types alone do not decide about contacts.
fn has_relatives(groups: &Groups, body: usize) -> bool {
    let Some(k) = groups.of_body[body] else { return false };
    groups.all[k].parent.is_some() || groups.all.iter().any(|g| g.parent == Some(k))
}

/// First position and degree of freedom of a body's free joint.
fn free_joint(m: &Model, body: usize) -> (usize, usize) {
    let j = m.body_jntadr[body] as usize;
    (m.jnt_qposadr[j] as usize, m.jnt_dofadr[j] as usize)
}

/// A joint at a position.
fn at(m: &Model, link: &Link, present: &MultibodyJoint, qpos: &[f64]) -> MultibodyJoint {
    let mut joint = MultibodyJoint::new(present.data, false);
    let q = m.jnt_qposadr[link.joint] as usize;
    match link.kind {
        JointType::Hinge | JointType::Slide => joint.apply_displacement(&[qpos[q] - m.qpos0[q]]),
        JointType::Ball | JointType::Free => {
            let turned = rotation([qpos[q], qpos[q + 1], qpos[q + 2], qpos[q + 3]]);
            joint.apply_displacement(&array(turned.to_scaled_axis()));
        }
    }
    joint
}

fn norm(q: Quat) -> f64 {
    q.iter().map(|x| x * x).sum()
}
