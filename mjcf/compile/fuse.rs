//! `fusestatic`: bodies without joints become part of their parents (XML reference, `compiler/fusestatic`).

use super::hierarchy;
use super::inertia::{self, MassPart};
use super::nodes::{BodyNode, GeomNode, Tree};
use crate::spec::Spec;
use physics::model::bounds::MINVAL;
use physics::model::{EqType, ObjType, SensorType, TrnType};
use std::collections::BTreeSet;

/// Fuses static bodies that nothing refers to; ids close up.
pub(super) fn fuse_static(tree: &mut Tree, spec: &Spec) -> Result<(), String> {
    let wanted = referenced_bodies(spec, tree);
    let sensed = sensed_sites(spec);
    let mut remembered = 0;
    let mut id = 1;
    while id < tree.bodies.len() {
        let body = &tree.bodies[id];
        let keeps = body.is_weld_root()
            || (!body.name().is_empty()
                && (wanted.contains(body.name())
                    || body.sites.iter().any(|s| sensed.contains(&*s.spec.name))));
        if keeps {
            id += 1;
        } else {
            fuse(tree, id, &mut remembered)?;
        }
    }
    Ok(())
}

/// Fuses a body into its parent; `remembered` counts the leaves that its hierarchies had meanwhile.
fn fuse(tree: &mut Tree, id: usize, remembered: &mut usize) -> Result<(), String> {
    let body = tree.bodies.remove(id);
    let parent = body.parent;
    for other in &mut tree.bodies[id..] {
        if other.parent == id {
            other.parent = parent;
            other.pose = body.pose.then(&other.pose);
        } else if other.parent > id {
            other.parent -= 1;
        }
    }
    let par = &mut tree.bodies[parent];
    if par.former.leaves.is_empty() {
        hierarchy::remember_leaves(par, remembered);
    }
    let both_collide = [&*par, &body].iter().all(|body| body.geoms.iter().any(GeomNode::collides));
    if parent != 0 && body.mass >= MINVAL {
        add_mass(par, &body)?;
    }
    for mut geom in body.geoms {
        geom.pose = body.pose.then(&geom.pose);
        par.geoms.push(geom);
    }
    for mut site in body.sites {
        site.pose = body.pose.then(&site.pose);
        par.sites.push(site);
    }
    // MuJoCo compiles cameras and lights again after fusing, so they keep the pose of the file.
    par.cameras.extend(body.cameras);
    par.lights.extend(body.lights);
    par.former.spare += body.former.spare + usize::from(both_collide);
    hierarchy::remember_leaves(par, remembered);
    Ok(())
}

fn add_mass(parent: &mut BodyNode, body: &BodyNode) -> Result<(), String> {
    let own = MassPart { mass: parent.mass, inertia: parent.inertia, pose: parent.inertial };
    if let Some(sum) = inertia::fuse(own, body.as_part())? {
        (parent.mass, parent.inertia, parent.inertial) = (sum.mass, sum.inertia, sum.pose);
    }
    Ok(())
}

/// Names of bodies that cameras, lights, skins, excludes, constraints, actuators, sensors or tuples mention.
fn referenced_bodies<'s>(spec: &'s Spec, tree: &Tree<'s>) -> BTreeSet<&'s str> {
    let is_body = |kind: ObjType| matches!(kind, ObjType::Body | ObjType::Xbody);
    let mut names = BTreeSet::new();
    names.extend(tree.cameras().map(|c| &*c.spec.targetbody));
    names.extend(tree.lights().map(|l| &*l.spec.targetbody));
    names.extend(spec.excludes.iter().flat_map(|e| [&*e.bodyname1, &*e.bodyname2]));
    names.extend(spec.skins.iter().flat_map(|s| &s.bones).map(|bone| &*bone.body));
    let welds = spec
        .equalities
        .iter()
        .filter(|e| matches!(e.kind, EqType::Connect | EqType::Weld) && e.objtype != ObjType::Site);
    names.extend(welds.flat_map(|e| [&*e.name1, &*e.name2]));
    names.extend(spec.actuators.iter().filter(|a| a.trntype == TrnType::Body).map(|a| &*a.target));
    names.extend(spec.sensors.iter().filter(|s| is_body(s.objtype)).map(|s| &*s.objname));
    names.extend(spec.sensors.iter().filter(|s| is_body(s.reftype)).map(|s| &*s.refname));
    let entries = spec.tuples.iter().flat_map(|t| &t.entries);
    names.extend(entries.filter(|e| is_body(e.objtype)).map(|e| &*e.objname));
    names
}

/// Sites of force and torque sensors: their body must stay a body.
fn sensed_sites(spec: &Spec) -> BTreeSet<&str> {
    let sensors = spec.sensors.iter();
    sensors
        .filter(|s| matches!(s.kind, SensorType::Force | SensorType::Torque) && s.objtype == ObjType::Site)
        .map(|s| &*s.objname)
        .collect()
}
