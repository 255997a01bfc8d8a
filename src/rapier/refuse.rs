//! Refuses models with elements that rapier does not support, by the name of the element, before a world is built.

use physics::Model;
use physics::model::{EqType, JointType, NotSimulated, ObjType, TrnType};

/// A refusal that names an element.
pub(crate) fn of(m: &Model, kind: ObjType, id: usize, what: &str) -> NotSimulated {
    NotSimulated { feature: format!("{what} under rapier"), element: Some(m.label_of(kind, id)) }
}

/// Checks that a model has nothing that this engine does not simulate.
///
/// # Errors
/// The first element that is not supported: a flex, adhesion, a moving surface, a type of equality constraint or joint, or a joint below a
/// mocap body.
pub fn check(m: &Model) -> Result<(), NotSimulated> {
    if m.nflex > 0 {
        return Err(of(m, ObjType::Flex, 0, "a deformable body"));
    }
    if let Some(g) = (0..m.ngeom).find(|&g| m.geom_adhesion[g] != 0.0) {
        return Err(of(m, ObjType::Geom, g, "adhesion"));
    }
    if let Some(p) = (0..m.npair).find(|&p| m.pair_adhesion[p] != 0.0) {
        return Err(of(m, ObjType::Geom, m.pair_geom1[p] as usize, "an adhesive pair"));
    }
    if let Some(g) = (0..m.ngeom).find(|&g| m.geom_surfacevel[g] != [0.0; 6]) {
        return Err(of(m, ObjType::Geom, g, "a moving surface"));
    }
    for i in 0..m.nactuator {
        if TrnType::from_code(m.actuator_trntype[i]) == Some(TrnType::Body) {
            return Err(of(m, ObjType::Actuator, i, "adhesion"));
        }
    }
    for e in 0..m.neq {
        let kind = EqType::from_code(m.eq_type[e]);
        if !matches!(kind, Some(EqType::Connect | EqType::Weld | EqType::Joint | EqType::Tendon)) {
            return Err(of(m, ObjType::Equality, e, "this type of equality constraint"));
        }
    }
    for j in 0..m.njnt {
        let b = m.jnt_bodyid[j] as usize;
        let above = m.body_weldid[m.body_parentid[b] as usize] as usize;
        if m.body_mocapid[above] >= 0 {
            return Err(of(m, ObjType::Joint, j, "a joint below a mocap body"));
        }
        if JointType::from_code(m.jnt_type[j]).is_none() {
            return Err(of(m, ObjType::Joint, j, "this type of joint"));
        }
    }
    Ok(())
}
