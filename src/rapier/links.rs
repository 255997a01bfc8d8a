//! A model's bodies and joints among rapier's: what is built, and where it is found again.

use crate::convert::{pose, vector};
use crate::groups::{Group, Groups, Motion, joints};
use physics::Model;
use physics::model::{JointType, NotSimulated, ObjType, dof_armature};
use rapier3d_f64::math::{Matrix, Pose, Rotation, Vector};
use rapier3d_f64::prelude::{
    GenericJoint, GenericJointBuilder, JointAxesMask, Multibody, MultibodyJointSet, RigidBody,
    RigidBodyBuilder, RigidBodyHandle, RigidBodySet,
};

/// A joint of the model as a joint of a multibody, and the body that it moves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Link {
    /// The joint.
    pub joint: usize,
    pub kind: JointType,
    /// The body that it moves: the body itself, or, if it has more joints, an intermediate body without mass.
    pub handle: RigidBodyHandle,
    /// Its parent.
    pub before: RigidBodyHandle,
    /// Its index in the multibody.
    pub id: usize,
    /// First degree of freedom in the multibody.
    pub dof: usize,
}

/// A kinematic tree: a multibody of rapier.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// A body of the multibody, to find it.
    pub handle: RigidBodyHandle,
    /// Its floating root, if it has one.
    pub root: Option<usize>,
    pub links: Vec<Link>,
    /// First degree of freedom in the model, and their number.
    pub dofs: std::ops::Range<usize>,
}

/// All of a model's rigid bodies and multibodies.
#[derive(Clone, Debug)]
pub(crate) struct Links {
    /// Rigid body of each group.
    pub handles: Vec<RigidBodyHandle>,
    pub trees: Vec<Tree>,
}

impl Tree {
    pub fn multibody<'a>(&self, set: &'a MultibodyJointSet) -> Option<&'a Multibody> {
        set.get_multibody(set.rigid_body_link(self.handle)?.multibody)
    }

    pub fn multibody_mut<'a>(&self, set: &'a mut MultibodyJointSet) -> Option<&'a mut Multibody> {
        let index = set.rigid_body_link(self.handle)?.multibody;
        set.get_multibody_mut(index)
    }
}

/// A rigid body without gravity, gyroscopic forces, sleep and limit of rotation.
fn dynamic() -> RigidBodyBuilder {
    RigidBodyBuilder::dynamic()
        .can_sleep(false)
        .gravity_scale(0.0)
        .gyroscopic_forces_enabled(false)
        .allow_fast_rotation(true)
}

impl Links {
    /// Inserts bodies and joints at the model's reference configuration.
    ///
    /// # Errors
    /// A joint that rapier does not accept.
    pub fn insert(
        m: &Model,
        groups: &Groups,
        bodies: &mut RigidBodySet,
        multibodies: &mut MultibodyJointSet,
    ) -> Result<Self, NotSimulated> {
        let handles = groups.all.iter().map(|g| bodies.insert(rigid_body(g))).collect();
        let mut links = Links { handles, trees: Vec::new() };
        let mut tree_of = vec![None; groups.all.len()];
        for (k, group) in groups.all.iter().enumerate() {
            match (group.motion, group.parent) {
                (Motion::Alone | Motion::Mocap, _) => continue,
                (Motion::Floating, _) => {
                    tree_of[k] = Some(links.trees.len());
                    let first = m.body_dofadr[group.body] as usize;
                    let handle = links.handles[k];
                    links.trees.push(Tree {
                        handle,
                        root: Some(k),
                        links: Vec::new(),
                        dofs: first..first + 6,
                    });
                }
                (Motion::Jointed, Some(parent)) => {
                    tree_of[k] = tree_of[parent];
                    let before = links.handles[parent];
                    links.join(m, groups, k, before, tree_of[k], (bodies, multibodies))?;
                }
                (Motion::Jointed, None) => {
                    tree_of[k] = Some(links.trees.len());
                    let ground = bodies.insert(RigidBodyBuilder::fixed());
                    let first = m.body_dofadr[group.body] as usize;
                    links.trees.push(Tree {
                        handle: ground,
                        root: None,
                        links: Vec::new(),
                        dofs: first..first,
                    });
                    links.join(m, groups, k, ground, tree_of[k], (bodies, multibodies))?;
                }
            }
        }
        links.settle(m, bodies, multibodies);
        Ok(links)
    }

    /// Connects a group to its parent, by a joint of the multibody for each of the model's joints.
    ///
    /// # Errors
    /// A joint that rapier does not accept.
    fn join(
        &mut self,
        m: &Model,
        groups: &Groups,
        k: usize,
        mut before: RigidBodyHandle,
        tree: Option<usize>,
        (bodies, multibodies): (&mut RigidBodySet, &mut MultibodyJointSet),
    ) -> Result<(), NotSimulated> {
        let body = groups.all[k].body;
        let parent = m.body_parentid[body] as usize;
        let mut base = groups.in_rigid_body(parent) * pose(m.body_pos[body], m.body_quat[body]);
        let all = joints(m, body);
        let refusal = |j: usize| crate::refuse::of(m, ObjType::Joint, j, "this joint");
        for j in all.clone() {
            let (handle, within) = if j + 1 == all.end {
                (self.handles[k], groups.all[k].frame().inverse())
            } else {
                (bodies.insert(dynamic()), Pose::IDENTITY)
            };
            let kind = JointType::from_code(m.jnt_type[j]).ok_or_else(|| refusal(j))?;
            let inserted = multibodies.insert(before, handle, joint(m, j, kind, [base, within]), true);
            let (_, id) = inserted.and_then(|h| multibodies.get(h)).ok_or_else(|| refusal(j))?;
            let tree = &mut self.trees[tree.ok_or_else(|| refusal(j))?];
            let dof = m.jnt_dofadr[j] as usize - tree.dofs.start;
            tree.links.push(Link { joint: j, kind, handle, before, id, dof });
            tree.dofs.end = m.jnt_dofadr[j] as usize + if kind == JointType::Ball { 3 } else { 1 };
            before = handle;
            base = Pose::IDENTITY;
        }
        Ok(())
    }

    /// Sets the armature of joints, and removes rapier's default damping of 0.1 N m s of every rotation: damping, springs,
    /// dry friction and limits are in the forces that the model's own stages compute.
    fn settle(&self, m: &Model, bodies: &mut RigidBodySet, multibodies: &mut MultibodyJointSet) {
        for tree in &self.trees {
            let Some(multibody) = tree.multibody_mut(multibodies) else { continue };
            multibody.set_self_contacts_enabled(true);
            multibody.forward_kinematics(bodies, true);
            multibody.damping_mut().fill(0.0);
            multibody.frictions_mut().fill(0.0);
            for (armature, dof) in multibody.armature_mut().iter_mut().zip(tree.dofs.clone()) {
                *armature = dof_armature(m, dof);
            }
        }
    }
}

fn rigid_body(group: &Group) -> RigidBody {
    let builder = match group.motion {
        Motion::Mocap => RigidBodyBuilder::kinematic_position_based(),
        Motion::Alone | Motion::Floating | Motion::Jointed => {
            dynamic().additional_mass_properties(group.mass)
        }
    };
    builder.build()
}

/// A joint between the body before it and the body that it moves, with the poses of the model's body, unmoved, in both.
fn joint(m: &Model, j: usize, kind: JointType, [base, within]: [Pose; 2]) -> GenericJoint {
    let place = Pose::from_parts(vector(m.jnt_pos[j]), axes(kind, vector(m.jnt_axis[j])));
    let locked = match kind {
        JointType::Hinge => JointAxesMask::FREE_REVOLUTE_AXES,
        JointType::Slide => JointAxesMask::FREE_PRISMATIC_AXES,
        JointType::Ball | JointType::Free => JointAxesMask::FREE_SPHERICAL_AXES,
    };
    GenericJointBuilder::new(!locked).local_frame1(base * place).local_frame2(within * place).build()
}

/// Orientation of a joint's frame, whose x axis rapier's hinges and slides move along.
fn axes(kind: JointType, axis: Vector) -> Rotation {
    if matches!(kind, JointType::Ball | JointType::Free) {
        return Rotation::IDENTITY;
    }
    let x = axis.normalize();
    let (y, z) = x.any_orthonormal_pair();
    let right_handed = if x.cross(y).dot(z) > 0.0 { z } else { -z };
    Rotation::from_mat3(&Matrix::from_cols(x, y, right_handed)).normalize()
}
