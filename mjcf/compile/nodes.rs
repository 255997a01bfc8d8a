//! The tree of bodies while it is compiled: elements with poses, sizes and masses settled, before they become rows.

use super::frame::Pose;
use super::inertia::MassPart;
use crate::spec::{Body, Camera, Geom, Joint, Light, Site, joint_dimensions};
use physics::math::Vec3;

/// Compiled bodies; a body follows its parent, subtrees are contiguous.
pub(super) struct Tree<'s> {
    pub bodies: Vec<BodyNode<'s>>,
}

impl<'s> Tree<'s> {
    /// The body that moves body `id`: itself, or the one that it is welded to.
    pub(super) fn weld_root(&self, id: usize) -> usize {
        let mut id = id;
        while !self.bodies[id].is_weld_root() {
            id = self.bodies[id].parent;
        }
        id
    }

    pub(super) fn joints(&self) -> impl Iterator<Item = &JointNode<'s>> {
        self.bodies.iter().flat_map(|b| b.joints.iter())
    }

    pub(super) fn geoms(&self) -> impl Iterator<Item = &GeomNode<'s>> {
        self.bodies.iter().flat_map(|b| b.geoms.iter())
    }

    pub(super) fn sites(&self) -> impl Iterator<Item = &SiteNode<'s>> {
        self.bodies.iter().flat_map(|b| b.sites.iter())
    }

    pub(super) fn cameras(&self) -> impl Iterator<Item = &CameraNode<'s>> {
        self.bodies.iter().flat_map(|b| b.cameras.iter())
    }

    pub(super) fn lights(&self) -> impl Iterator<Item = &LightNode<'s>> {
        self.bodies.iter().flat_map(|b| b.lights.iter())
    }
}

/// A compiled body; poses are in the parent's frame, the inertial pose in the body's.
pub(super) struct BodyNode<'s> {
    pub spec: &'s Body,
    pub parent: usize,
    pub pose: Pose,
    /// Pose in the world at `qpos0`.
    pub world: Pose,
    pub inertial: Pose,
    pub mass: f64,
    pub inertia: Vec3,
    pub joints: Vec<JointNode<'s>>,
    pub geoms: Vec<GeomNode<'s>>,
    pub sites: Vec<SiteNode<'s>>,
    pub cameras: Vec<CameraNode<'s>>,
    pub lights: Vec<LightNode<'s>>,
    /// What `fusestatic` leaves behind in the hierarchy of the body.
    pub former: FormerTrees<'s>,
    pub is_world: bool,
}

/// Traces of the hierarchies that a body had before bodies were fused into it.
#[derive(Default)]
pub(super) struct FormerTrees<'s> {
    /// For each index of a node, the geom of the last leaf that stood there.
    pub leaves: Vec<Option<&'s Geom>>,
    /// How many bodies with a hierarchy were fused into this one while it had one: as many nodes are spare.
    pub spare: usize,
}

impl<'s> BodyNode<'s> {
    /// Name; the world is always called so.
    pub(super) fn name(&self) -> &'s str {
        if self.is_world { "world" } else { &self.spec.name }
    }

    /// Whether the body moves, by joints or as a mocap body, apart from its parent.
    pub(super) fn is_weld_root(&self) -> bool {
        self.is_world || !self.joints.is_empty() || self.spec.mocap
    }

    /// The body as a part of its parent.
    pub(super) fn as_part(&self) -> MassPart {
        MassPart { mass: self.mass, inertia: self.inertia, pose: self.pose.then(&self.inertial) }
    }

    /// Degrees of freedom.
    pub(super) fn dofs(&self) -> usize {
        self.joints.iter().map(|j| joint_dimensions(j.spec.kind).1).sum()
    }
}

/// A joint in the frame of its body, angles in radians.
pub(super) struct JointNode<'s> {
    pub spec: &'s Joint,
    pub pos: Vec3,
    pub axis: Vec3,
    pub limited: bool,
    pub range: [f64; 2],
    pub actfrclimited: bool,
    pub reference: f64,
    pub springref: f64,
}

/// A geom in the frame of its body.
pub(super) struct GeomNode<'s> {
    pub spec: &'s Geom,
    pub pose: Pose,
    pub size: Vec3,
    pub aabb: [f64; 6],
    pub rbound: f64,
    pub mass: f64,
    pub inertia: Vec3,
    /// Id of the mesh or height field the geom consists of or was fitted to, -1 for none.
    pub dataid: i32,
    /// Material: the geom's own, else its mesh's.
    pub material: String,
    pub surfacevel: [f64; 6],
    pub fluid: [f64; 12],
}

impl GeomNode<'_> {
    /// Whether the geom may collide without a pair that names it: a leaf of its body's hierarchy.
    pub(super) fn collides(&self) -> bool {
        self.spec.contype != 0 || self.spec.conaffinity != 0
    }
}

/// A site in the frame of its body.
pub(super) struct SiteNode<'s> {
    pub spec: &'s Site,
    pub pose: Pose,
    pub size: Vec3,
}

/// A camera in the frame of its body.
pub(super) struct CameraNode<'s> {
    pub spec: &'s Camera,
    pub pose: Pose,
    pub intrinsic: [f32; 4],
    pub fovy: f64,
}

/// A light in the frame of its body.
pub(super) struct LightNode<'s> {
    pub spec: &'s Light,
    pub pos: Vec3,
    pub dir: Vec3,
}
