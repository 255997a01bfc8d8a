//! The tree of bodies: compiled nodes in depth-first order, and the arrays they fill.

mod body;
mod fluid;
mod geom;
mod joint;
mod viewpoint;

pub(super) use joint::set_springdampers;

use super::assets::Assets;
use super::frame::{Pose, frame_poses};
use super::hierarchy;
use super::log::{Log, title};
use super::lookup::Lookup;
use super::nodes::Tree;
use super::plugins::Plugins;
use crate::spec::{Body, Spec};
use physics::model::Rows;
use physics::plugin::Capability;

/// Compiles every body of the spec.
pub(super) fn compile<'s>(spec: &'s Spec, assets: &Assets, log: &mut Log) -> Tree<'s> {
    let frames: Vec<_> = frame_poses(spec)
        .into_iter()
        .zip(&spec.frames)
        .map(|(pose, frame)| {
            log.check(frame.loc, &title("frame", &frame.name), pose).unwrap_or(Pose::IDENTITY)
        })
        .collect();
    let mut tree = Tree { bodies: Vec::new() };
    // Depth-first without recursion: deep models must not exhaust the stack.
    let mut pending: Vec<(&'s Body, usize)> = vec![(&spec.world, 0)];
    while let Some((body, parent)) = pending.pop() {
        let id = tree.bodies.len();
        if id == 0 && !body.joints.is_empty() {
            log.error(body.joints[0].loc, "the world does not move: put the joint into a <body>");
        }
        let context = body::Context { tree: &tree, model: spec, assets, frames: &frames };
        let node = body::compile(body, parent, &context, log);
        tree.bodies.push(node);
        pending.extend(body.bodies.iter().rev().map(|child| (child, id)));
    }
    if tree.bodies.len() >= 65534 {
        log.error(spec.world.loc, "more than 65533 bodies");
    }
    tree
}

/// Fills the arrays of bodies and all that is fixed to them.
pub(super) fn fill(
    m: &mut Rows,
    tree: &Tree,
    (spec, plugins): (&Spec, &Plugins),
    lookup: &Lookup,
    log: &mut Log,
) {
    body::check_moving_mass(tree, log);
    for (id, node) in tree.bodies.iter().enumerate() {
        body::fill(m, node, id, tree, log);
        let what = title("body", node.name());
        let passive = (Capability::Passive, &*what);
        m.body_plugin.push(plugins.id(node.spec.plugin.as_ref(), passive, log));
        joint::fill(m, node, id, log);
        body::settle_simple(m, node, id);
        geom::fill(m, node, id, (lookup, plugins), log);
        viewpoint::fill_sites(m, node, id, lookup, log);
        viewpoint::fill_cameras(m, node, id, lookup, log);
        viewpoint::fill_lights(m, node, id, lookup, log);
    }
    hierarchy::fill_bodies(m, tree);
    if spec.compiler.settotalmass > 0.0 {
        body::scale_mass(m, spec.compiler.settotalmass);
    }
}
