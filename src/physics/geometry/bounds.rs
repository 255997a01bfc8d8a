//! The bounds by which collision skips geoms and bodies, derived from shapes, poses, margins and contact types.

use super::hierarchy::{self, Bvh, Leaf};
use super::shape;
use crate::arrays::{Arrays, GeomType};

/// What an edit changed of the geoms.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChangedGeoms {
    /// Geoms with another type, size, mesh or height field.
    pub shapes: Vec<usize>,
    /// Bodies with a geom whose shape, pose, margin or contact type changed, or with another inertial frame, ascending.
    pub bodies: Vec<usize>,
}

/// Recomputes the bounds of the geoms and bodies that changed. The number of nodes of the hierarchies follows from which
/// geoms may collide.
pub(crate) fn set_bounds(m: &mut Arrays, changed: &ChangedGeoms) {
    for &g in &changed.shapes {
        let (aabb, radius) = geom_bounds(m, g);
        m.geom_aabb.update_row(g, aabb);
        m.geom_rbound.update_row(g, radius);
    }
    for &b in &changed.bodies {
        let geoms = || geoms(m, b);
        let margin = geoms().fold(0.0, |most: f64, g| most.max(m.geom_margin[g] + m.geom_gap[g]));
        let contype = geoms().fold(0, |bits, g| bits | m.geom_contype[g]);
        let conaffinity = geoms().fold(0, |bits, g| bits | m.geom_conaffinity[g]);
        m.body_margin.update_row(b, margin);
        m.body_contype.update_row(b, contype);
        m.body_conaffinity.update_row(b, conaffinity);
    }
    let trees: Vec<_> = changed.bodies.iter().map(|&b| (b, body_tree(m, b))).collect();
    if trees.iter().all(|(b, tree)| tree.depth.len() == m.body_bvhnum[*b] as usize) {
        trees.iter().for_each(|(b, tree)| replace_tree(m, *b, tree));
    } else {
        rebuild_trees(m);
    }
}

/// Geoms of a body.
fn geoms(m: &Arrays, body: usize) -> std::ops::Range<usize> {
    let first = m.body_geomadr[body].max(0) as usize;
    first..first + m.body_geomnum[body] as usize
}

/// Bounding box in the geom frame, and radius about its origin.
fn geom_bounds(m: &Arrays, g: usize) -> ([f64; 6], f64) {
    let (size, data) = (m.geom_size[g], usize::try_from(m.geom_dataid[g]).ok());
    match (GeomType::from_code(m.geom_type[g]), data) {
        (Some(GeomType::Hfield), Some(hfield)) => {
            let size = m.hfield_size[hfield];
            (shape::hfield_box(size), shape::hfield_radius(size))
        }
        (Some(GeomType::Mesh | GeomType::Sdf), Some(mesh)) => mesh_bounds(m, mesh),
        (kind, _) => {
            let kind = kind.unwrap_or(GeomType::None);
            (shape::bounding_box(kind, size), shape::bounding_radius(kind, size))
        }
    }
}

/// Bounds of the vertices of a mesh.
fn mesh_bounds(m: &Arrays, mesh: usize) -> ([f64; 6], f64) {
    let first = m.mesh_vertadr[mesh] as usize;
    let vertices = &m.mesh_vert[first..first + m.mesh_vertnum[mesh] as usize];
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for vertex in vertices {
        for k in 0..3 {
            low[k] = low[k].min(vertex[k].into());
            high[k] = high[k].max(vertex[k].into());
        }
    }
    let reach = std::array::from_fn(|k| low[k].abs().max(high[k].abs()));
    let aabb = std::array::from_fn(|k| match k {
        0..3 => (high[k] + low[k]) / 2.0,
        _ => (high[k - 3] - low[k - 3]) / 2.0,
    });
    (aabb, shape::bounding_radius(GeomType::Mesh, reach))
}

/// Hierarchy over the geoms of a body that may collide, in its inertial frame.
fn body_tree(m: &Arrays, body: usize) -> Bvh {
    let leaves: Vec<Leaf> = geoms(m, body)
        .map(|g| Leaf {
            id: g as i32,
            pos: m.geom_pos[g],
            quat: Some(m.geom_quat[g]),
            aabb: m.geom_aabb[g],
            collides: m.geom_contype[g] != 0 || m.geom_conaffinity[g] != 0,
        })
        .collect();
    hierarchy::build(&leaves, m.body_ipos[body], m.body_iquat[body])
}

/// Replaces the body's tree by another with the same number of nodes.
fn replace_tree(m: &mut Arrays, body: usize, tree: &Bvh) {
    for node in 0..tree.depth.len() {
        let at = m.body_bvhadr[body] as usize + node;
        m.bvh_depth.update_row(at, tree.depth[node]);
        m.bvh_child.update_row(at, tree.child[node]);
        m.bvh_nodeid.update_row(at, tree.nodeid[node]);
        m.bvh_aabb.update_row(at, tree.aabb[node]);
    }
}

/// Builds the trees of all bodies and puts the trees of meshes behind them.
fn rebuild_trees(m: &mut Arrays) {
    let mut all = Bvh::default();
    let (mut address, mut number) = (Vec::new(), Vec::new());
    for body in 0..m.nbody {
        let tree = body_tree(m, body);
        address.push(if tree.depth.is_empty() { -1 } else { all.depth.len() as i32 });
        number.push(tree.depth.len() as i32);
        all.extend(&tree);
    }
    let before: i32 = m.body_bvhnum.iter().sum();
    let shift = all.depth.len() as i32 - before;
    let rest = before as usize..;
    all.depth.extend(&m.bvh_depth[rest.clone()]);
    all.child.extend(&m.bvh_child[rest.clone()]);
    all.nodeid.extend(&m.bvh_nodeid[rest.clone()]);
    all.aabb.extend(&m.bvh_aabb[rest]);
    (m.nbvh, m.nbvhstatic) = (all.depth.len(), all.depth.len());
    (m.bvh_depth, m.bvh_child) = (all.depth.into(), all.child.into());
    (m.bvh_nodeid, m.bvh_aabb) = (all.nodeid.into(), all.aabb.into());
    (m.body_bvhadr, m.body_bvhnum) = (address.into(), number.into());
    m.mesh_bvhadr =
        m.mesh_bvhadr.iter().map(|&first| if first < 0 { first } else { first + shift }).collect();
}
