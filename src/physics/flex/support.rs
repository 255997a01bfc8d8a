//! Which flexes are simulated, and how: explicitly, or with their stiffness in the inertia.

use super::metric;
use crate::model::NotSimulated;
use crate::model::flex::Flex;
use crate::model::{Model, ObjType};

/// Largest order of interpolation.
const MAX_ORDER: u32 = 2;

/// Checks once that flexes of these dimensions and orders are simulated.
///
/// # Errors
/// The first feature that is not, with the flex that asks for it.
pub(crate) fn check(m: &Model) -> Result<(), NotSimulated> {
    for flex in Flex::all(m) {
        let refuse = |feature: &str| Err(NotSimulated::of(m.label_of(ObjType::Flex, flex.id), feature));
        if !(1..=3).contains(&m.flex_dim[flex.id]) {
            return refuse("elements of this dimension");
        }
        if m.flex_interp[flex.id].unsigned_abs() > MAX_ORDER {
            return refuse("interpolation of an order above 2");
        }
    }
    Ok(())
}

/// Checks that flexes are simulated with the model's options.
///
/// # Errors
/// What is not, with the flex that asks for it.
pub(crate) fn check_options(m: &Model) -> Result<(), NotSimulated> {
    if metric::allowed(m) {
        return Ok(());
    }
    match Flex::all(m).find(|flex| metric::has_soft_contacts(*flex)) {
        Some(flex) => Err(NotSimulated::of(
            m.label_of(ObjType::Flex, flex.id),
            "passive contacts without the solver `CG`, an implicit integrator and pyramidal cones, or with sleep",
        )),
        None => Ok(()),
    }
}
