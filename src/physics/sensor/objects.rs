//! The elements that a sensor refers to.

use crate::model::{ConstraintType, Model, ObjType};
use crate::stages::Constraints;

/// Element of kind `kind` and index `id` of sensor `i`: the object, or the reference if there is one.
pub(super) fn object(m: &Model, i: usize) -> (ObjType, usize) {
    let kind = ObjType::from_code(m.sensor_objtype[i]).unwrap_or(ObjType::Unknown);
    (kind, usize::try_from(m.sensor_objid[i]).unwrap_or(0))
}

/// Reference element of sensor `i`; `None` when it refers to the world.
pub(super) fn reference(m: &Model, i: usize) -> Option<(ObjType, usize)> {
    let id = usize::try_from(m.sensor_refid[i]).ok()?;
    Some((ObjType::from_code(m.sensor_reftype[i])?, id))
}

/// First limit row of element `id`.
pub(super) fn limit_row(efc: &Constraints, kind: ConstraintType, id: usize) -> Option<usize> {
    (efc.ne + efc.nf..efc.nefc).find(|&r| efc.efc_type[r] == kind.code() && efc.efc_id[r] as usize == id)
}
