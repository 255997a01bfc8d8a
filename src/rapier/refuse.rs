//! Refuses models with elements that rapier does not support, by the name of the element, before a world is built.

use physics::Model;
use physics::model::{EqType, JointType, NotSimulated, ObjType, TrnType};

/// A refusal that names an element.
pub(crate) fn of(m: &Model, kind: ObjType, id: usize, what: &str) -> NotSimulated {
    NotSimulated { feature: format!("{what} under rapier"), element: Some(m.label_of(kind, id)) }
}

/// Checks that a model has nothing that this engine does not simulate, shapes apart ([`refusals`](crate::refusals)).
///
/// # Errors
/// The first element that is not supported: a flex, adhesion, a moving surface, a type of equality constraint or joint, or a joint below a
/// mocap body.
pub fn check(m: &Model) -> Result<(), NotSimulated> {
    unsupported(m).next().map_or(Ok(()), Err)
}

/// Every element that is not supported, by kind.
pub(crate) fn unsupported(m: &Model) -> impl Iterator<Item = NotSimulated> {
    let all = |kind, count, what, asks: fn(&Model, usize) -> bool| {
        (0..count).filter(move |&id| asks(m, id)).map(move |id| of(m, kind, id, what))
    };
    let pairs = (0..m.npair).filter(|&p| m.pair_adhesion[p] != 0.0);
    all(ObjType::Flex, m.nflex, "a deformable body", |_, _| true)
        .chain(all(ObjType::Geom, m.ngeom, "adhesion", |m, g| m.geom_adhesion[g] != 0.0))
        .chain(pairs.map(|p| of(m, ObjType::Geom, m.pair_geom1[p] as usize, "an adhesive pair")))
        .chain(all(ObjType::Geom, m.ngeom, "a moving surface", |m, g| m.geom_surfacevel[g] != [0.0; 6]))
        .chain(all(ObjType::Actuator, m.nactuator, "adhesion", |m, i| {
            TrnType::from_code(m.actuator_trntype[i]) == Some(TrnType::Body)
        }))
        .chain(all(ObjType::Equality, m.neq, "this type of equality constraint", |m, e| {
            use EqType::{Connect, Joint, Tendon, Weld};
            !matches!(EqType::from_code(m.eq_type[e]), Some(Connect | Weld | Joint | Tendon))
        }))
        .chain(all(ObjType::Joint, m.njnt, "a joint below a mocap body", |m, j| {
            let parent = m.body_parentid[m.jnt_bodyid[j] as usize] as usize;
            m.body_mocapid[m.body_weldid[parent] as usize] >= 0
        }))
        .chain(all(ObjType::Joint, m.njnt, "this type of joint", |m, j| {
            JointType::from_code(m.jnt_type[j]).is_none()
        }))
}
