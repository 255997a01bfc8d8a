//! The memory of the arrays that a `Spec` asks for, in the model and in the data of one simulation, added up before
//! any is allocated.

use super::log::Log;
use crate::diagnostic::Loc;
use crate::spec::{Body, Spec};
use physics::Data;
use physics::model::{Arrays, JointType, Rows};

/// Elements of one kind: what messages call them, where they stand, and how their number sets sizes.
struct Family {
    what: &'static str,
    count: usize,
    /// In the order of the text; elements that `size` asks for have none.
    places: Vec<Loc>,
    set: fn(&mut Arrays, usize),
}

/// Elements of the tree of bodies, and the sizes that they ask for.
#[derive(Default)]
struct Tree {
    bodies: Vec<Loc>,
    joints: Vec<Loc>,
    geoms: Vec<Loc>,
    sites: Vec<Loc>,
    cameras: Vec<Loc>,
    lights: Vec<Loc>,
    nq: usize,
    nv: usize,
    nmocap: usize,
}

/// Charges the arrays whose sizes follow from the number of elements; `sizes` has the widths of user data. False,
/// with an error at the element that asks for too much, when they are beyond the budget.
pub(super) fn charge(sizes: &Rows, spec: &Spec, log: &mut Log) -> bool {
    let tree = Tree::of(&spec.world);
    let mut m = widths(sizes);
    (m.nq, m.nv, m.nmocap, m.nuserdata) =
        (tree.nq, tree.nv, tree.nmocap, spec.size.nuserdata.max(0) as usize);
    m.na = spec.actuators.iter().map(|a| 1.max(a.actdim.max(0) as usize)).sum();
    m.nnumericdata = spec.numerics.iter().map(|n| n.data.len().max(n.size.max(0) as usize)).sum();
    let families = families(tree, spec);
    let mut before = bytes(&m);
    if !log.charge(spec.size.loc, "joints and user data", before) {
        return false;
    }
    for Family { what, count, places, set } in families.into_iter().filter(|family| family.count > 0) {
        set(&mut m, count);
        let (asked, left) = (bytes(&m) - before, log.budget.left());
        // The element at which the budget is passed.
        let place = places.get(left / (asked / count).max(1)).copied().unwrap_or(spec.size.loc);
        if !log.charge(place, &format!("{count} {what}"), asked) {
            return false;
        }
        before += asked;
    }
    true
}

/// Charges the sparse patterns that follow from the tree of degrees of freedom, actuators and tendons: their sizes
/// and the working memory of their computation.
pub(super) fn charge_patterns(m: &Arrays, spec: &Spec, log: &mut Log) -> bool {
    let mut above = vec![1_usize; m.nv];
    for dof in 0..m.nv {
        if let Ok(parent) = usize::try_from(m.dof_parentid[dof]) {
            above[dof] += above[parent];
        }
    }
    let mut depth = vec![0_usize; m.nbody];
    (1..m.nbody).for_each(|b| depth[b] = depth[m.body_parentid[b] as usize] + 1);
    let longest = above.iter().copied().max().unwrap_or(0);
    let mut p = Arrays { nv: m.nv, nbody: m.nbody, ..widths(&Rows::default()) };
    p.nC = above.iter().sum();
    p.nM = p.nC;
    p.nD = 2 * p.nC;
    let below: usize = (0..m.nv).map(|dof| depth[m.dof_bodyid[dof] as usize] + 1).sum();
    p.nB = below + (0..m.nbody).map(|b| longest.min(6 * depth[b])).sum::<usize>();
    p.nJten = spec.tendons.iter().map(|t| m.nv.min(t.path.len().saturating_mul(longest))).sum();
    p.nJmom = m.nactuator.saturating_mul(m.nv.min((2 * longest).max(6)));
    let patterns = bytes(&p).saturating_mul(2);
    log.charge(spec.world.loc, "patterns of the inertia, tendons and actuators", patterns)
}

impl Tree {
    fn of(world: &Body) -> Self {
        let mut tree = Tree::default();
        let mut pending = vec![world];
        while let Some(body) = pending.pop() {
            tree.bodies.push(body.loc);
            tree.nmocap += usize::from(body.mocap);
            for joint in &body.joints {
                let (nq, nv) = match joint.kind {
                    JointType::Free => (7, 6),
                    JointType::Ball => (4, 3),
                    JointType::Slide | JointType::Hinge => (1, 1),
                };
                (tree.nq, tree.nv) = (tree.nq + nq, tree.nv + nv);
                tree.joints.push(joint.loc);
            }
            tree.geoms.extend(body.geoms.iter().map(|e| e.loc));
            tree.sites.extend(body.sites.iter().map(|e| e.loc));
            tree.cameras.extend(body.cameras.iter().map(|e| e.loc));
            tree.lights.extend(body.lights.iter().map(|e| e.loc));
            pending.extend(body.bodies.iter().rev());
        }
        tree
    }
}

/// Every kind of element whose number sets sizes, keyframes last: their rows are as long as the state.
fn families(tree: Tree, spec: &Spec) -> Vec<Family> {
    let family = |what, places: Vec<Loc>, set| Family { what, count: places.len(), places, set };
    macro_rules! list {
        ($field:ident) => {
            spec.$field.iter().map(|e| e.loc).collect()
        };
    }
    let wraps = spec.tendons.iter().flat_map(|t| t.path.iter().map(|w| w.loc)).collect();
    let keys = spec.keys.len().max(spec.size.nkey.max(0) as usize) + spec.kept_keys.len();
    vec![
        family("bodies", tree.bodies, |m, n| m.nbody = n),
        family("joints", tree.joints, |m, n| m.njnt = n),
        // A tree of boxes has two nodes a geom.
        family("geoms", tree.geoms, |m, n| (m.ngeom, m.nbvh, m.nbvhstatic) = (n, 2 * n, 2 * n)),
        family("sites", tree.sites, |m, n| m.nsite = n),
        family("cameras", tree.cameras, |m, n| m.ncam = n),
        family("lights", tree.lights, |m, n| m.nlight = n),
        family("materials", list!(materials), |m, n| m.nmat = n),
        family("contact pairs", list!(pairs), |m, n| m.npair = n),
        family("excludes", list!(excludes), |m, n| m.nexclude = n),
        family("equality constraints", list!(equalities), |m, n| m.neq = n),
        family("tendons", list!(tendons), |m, n| m.ntendon = n),
        family("elements of tendon paths", wraps, |m, n| m.nwrap = n),
        family("actuators", list!(actuators), |m, n| (m.nactuator, m.nu, m.nout) = (n, n, n)),
        family("sensors", list!(sensors), |m, n| (m.nsensor, m.nsensordata) = (n, 3 * n)),
        family("custom arrays", list!(numerics), |m, n| m.nnumeric = n),
        family("custom texts", list!(texts), |m, n| m.ntext = n),
        family("tuples", list!(tuples), |m, n| m.ntuple = n),
        Family { what: "keyframes", count: keys, places: list!(keys), set: |m, n| m.nkey = n },
    ]
}

/// Sizes with only the widths of user data set.
fn widths(m: &Rows) -> Arrays {
    Arrays {
        nuser_body: m.nuser_body,
        nuser_jnt: m.nuser_jnt,
        nuser_geom: m.nuser_geom,
        nuser_site: m.nuser_site,
        nuser_cam: m.nuser_cam,
        nuser_tendon: m.nuser_tendon,
        nuser_actuator: m.nuser_actuator,
        nuser_sensor: m.nuser_sensor,
        ..Arrays::default()
    }
}

/// Bytes of the arrays of a model and of its data, by the sizes set.
fn bytes(m: &Arrays) -> usize {
    m.bytes().saturating_add(Data::bytes(m))
}
