//! `discardvisual`: geoms that cannot collide and that nothing mentions are dropped, with their meshes and all
//! materials and textures (XML reference, `compiler/discardvisual`).

use super::assets::Assets;
use super::nodes::Tree;
use crate::spec::{Spec, WrapKind};
use physics::model::ObjType;
use std::collections::BTreeSet;

/// Drops visual geoms and assets; ids close up.
pub(super) fn discard_visual(tree: &mut Tree, assets: &mut Assets, spec: &Spec) {
    let mentioned = mentioned(spec, ObjType::Geom);
    for body in &mut tree.bodies {
        body.geoms
            .retain(|g| g.spec.contype != 0 || g.spec.conaffinity != 0 || mentioned.contains(&*g.spec.name));
    }
    let mut kept: BTreeSet<String> = mentioned_meshes(spec);
    kept.extend(tree.geoms().filter(|g| !g.spec.meshname.is_empty()).map(|g| g.spec.meshname.clone()));
    let mut renumbered = Vec::with_capacity(assets.meshes.len());
    let mut next = 0;
    for mesh in &assets.meshes {
        let keep = kept.contains(&mesh.name);
        renumbered.push(if keep { next } else { -1 });
        next += i32::from(keep);
    }
    assets.meshes.retain(|mesh| kept.contains(&mesh.name));
    for body in &mut tree.bodies {
        for geom in &mut body.geoms {
            if !geom.spec.meshname.is_empty() {
                geom.dataid = renumbered[geom.dataid as usize];
            }
            geom.material.clear();
        }
    }
}

fn mentioned_meshes(spec: &Spec) -> BTreeSet<String> {
    mentioned(spec, ObjType::Mesh).into_iter().map(str::to_owned).collect()
}

/// Names that pairs, tendons, sensors and tuples mention.
fn mentioned(spec: &Spec, kind: ObjType) -> BTreeSet<&str> {
    let mut names: BTreeSet<&str> = BTreeSet::new();
    if kind == ObjType::Geom {
        names.extend(spec.pairs.iter().flat_map(|p| [&*p.geomname1, &*p.geomname2]));
        names.extend(spec.tendons.iter().flat_map(|t| &t.path).filter_map(|w| match &w.kind {
            WrapKind::Geom { geom, .. } => Some(&**geom),
            WrapKind::Site { .. } | WrapKind::Joint { .. } | WrapKind::Pulley { .. } => None,
        }));
        let entries = spec.tuples.iter().flat_map(|t| &t.entries);
        names.extend(entries.filter(|e| e.objtype == kind).map(|e| &*e.objname));
    }
    names.extend(spec.sensors.iter().filter(|s| s.objtype == kind).map(|s| &*s.objname));
    names.extend(spec.sensors.iter().filter(|s| s.reftype == kind).map(|s| &*s.refname));
    names.remove("");
    names
}
