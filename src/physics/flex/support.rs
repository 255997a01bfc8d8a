//! Which flexes are simulated, and how: explicitly, or with their stiffness in the inertia.

use super::{Flex, held};
use crate::model::{Cone, Enable, Integrator, Model, ObjType, Solver};
use crate::pipeline::error::NotSimulated;

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
    let refuse =
        |flex: Flex, feature: &str| Err(NotSimulated::of(m.label_of(ObjType::Flex, flex.id), feature));
    if is_implicit(m) {
        match Flex::all(m).find(|flex| joins_inertia(*flex)) {
            Some(flex) => refuse(
                flex,
                "elasticity that is implicit in positions (solver `CG` with an implicit integrator; use `Newton`)",
            ),
            None => Ok(()),
        }
    } else {
        match Flex::all(m).find(|flex| has_passive_contacts(*flex)) {
            Some(flex) => refuse(flex, "passive contacts"),
            None => Ok(()),
        }
    }
}

/// Stiffness of flexes is added to the inertia where some flex asks for that.
fn is_implicit(m: &Model) -> bool {
    m.opt.solver == Solver::Cg
        && matches!(m.opt.integrator, Integrator::Implicit | Integrator::Implicitfast)
        && m.opt.cone != Cone::Elliptic
        && !m.opt.enableflags.contains(Enable::SLEEP)
}

fn has_passive_contacts(flex: Flex) -> bool {
    !flex.m.flex_rigid[flex.id] && flex.m.flex_passive[flex.id] != 0
}

/// A flex that resists deformation or touches softly.
fn joins_inertia(flex: Flex) -> bool {
    let m = flex.m;
    if m.flex_rigid[flex.id] {
        return false;
    }
    let stretches = flex.stiffness().is_some();
    has_passive_contacts(flex)
        || if flex.is_interpolated() {
            stretches && m.flex_edgeequality[flex.id] != held::STRAINS
        } else {
            flex.dim() == 2 && flex.bending().is_some() || flex.dim() >= 2 && stretches
        }
}
