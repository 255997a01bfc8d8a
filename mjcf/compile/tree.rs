//! The tree of bodies: compiled nodes in depth-first order, and the arrays they fill.

use super::assets::Assets;
use super::body::{self, BodyNode};
use super::frame::frame_poses;
use super::geom::GeomNode;
use super::joint::{self, JointNode};
use super::lookup::Lookup;
use super::viewpoint::{self, CameraNode, LightNode, SiteNode};
use super::{Log, geom, title};
use crate::spec::{Body, Spec};
use physics::model::Arrays;

/// Compiled bodies; a body follows its parent, subtrees are contiguous.
pub(super) struct Tree<'s> {
    pub bodies: Vec<BodyNode<'s>>,
}

impl<'s> Tree<'s> {
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

/// Compiles every body of the spec.
pub(super) fn compile<'s>(spec: &'s Spec, assets: &Assets, log: &mut Log) -> Tree<'s> {
    let frames: Vec<_> = frame_poses(spec)
        .into_iter()
        .zip(&spec.frames)
        .map(|(pose, frame)| {
            log.check(frame.loc, &title("frame", &frame.name), pose).unwrap_or(super::frame::Pose::IDENTITY)
        })
        .collect();
    let mut tree = Tree { bodies: Vec::new() };
    // Depth-first without recursion: deep models must not exhaust the stack.
    let mut pending: Vec<(&'s Body, usize)> = vec![(&spec.world, 0)];
    while let Some((body, parent)) = pending.pop() {
        let id = tree.bodies.len();
        if id == 0 && !body.joints.is_empty() {
            log.error(body.joints[0].loc, "joint in the world body");
        }
        let node = body::compile(body, id, parent, &tree, spec, assets, &frames, log);
        tree.bodies.push(node);
        pending.extend(body.bodies.iter().rev().map(|child| (child, id)));
    }
    if tree.bodies.len() >= 65534 {
        log.error(spec.world.loc, "more than 65533 bodies");
    }
    tree
}

/// Fills the arrays of bodies and all that is fixed to them.
pub(super) fn fill(m: &mut Arrays, tree: &Tree, spec: &Spec, lookup: &Lookup, log: &mut Log) {
    body::check_moving_mass(tree, log);
    for (id, node) in tree.bodies.iter().enumerate() {
        body::fill(m, node, id, tree, log);
        joint::fill(m, node, id, log);
        body::settle_simple(m, node, id);
        geom::fill(m, node, id, lookup, log);
        viewpoint::fill_sites(m, node, id, lookup, log);
        viewpoint::fill_cameras(m, node, id, lookup, log);
        viewpoint::fill_lights(m, node, id, lookup, log);
    }
    body::fill_hierarchies(m, tree);
    if spec.compiler.settotalmass > 0.0 {
        body::scale_mass(m, spec.compiler.settotalmass);
    }
}
