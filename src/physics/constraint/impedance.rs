//! Impedance, stiffness and damping of rows, and with them the regularisation `R` and its inverse `D`
//! (MuJoCo documentation, Modeling, "Solver parameters").

use super::diagonal::block_length;
use crate::math::dense::norm_slice;
use crate::math::ops;
use crate::model::bounds::{MAXIMP, MINIMP, MINVAL};
use crate::model::{ConstraintType, Disable, EqType, Model};
use crate::stages::{Constraints, Contact, Contacts};

/// `solref` in place of one whose entries have mixed signs.
const DEFAULT_SOLREF: [f64; 2] = [0.02, 1.0];

/// Computes `efc_KBIP`, `efc_R`, `efc_D` and the `mu` of frictional contacts, then makes `efc_diagA` agree with `R`.
pub(super) fn impedance(m: &Model, con: &mut Contacts, efc: &mut Constraints) {
    for column in [&mut efc.efc_R, &mut efc.efc_D] {
        column.clear();
        column.resize(efc.nefc, 0.0);
    }
    efc.efc_KBIP.clear();
    efc.efc_KBIP.resize(efc.nefc, [0.0; 4]);
    let mut i = 0;
    while i < efc.nefc {
        let length = block_length(m, con, efc, i);
        block(m, con, efc, i, length);
        i += length;
    }
}

/// Sets all of it for the `length` rows of one constraint. Opposite edges of a pyramid share every number.
fn block(m: &Model, con: &mut Contacts, efc: &mut Constraints, first: usize, length: usize) {
    let kind = ConstraintType::from_code(efc.efc_type[first]);
    let SolverParameters { solref, solreffriction, solimp } = solver_parameters(m, con, efc, first, kind);
    let (imp, slope) = curve(&solimp, violation(m, efc, first, length), efc.efc_margin[first]);
    let [k, b] = spring_damper(solref, solimp[1]);
    let friction = matches!(kind, Some(ConstraintType::FrictionDof | ConstraintType::FrictionTendon));
    let rows = first..first + length;
    efc.efc_KBIP[rows.clone()].fill([if friction { 0.0 } else { k }, b, imp, slope]);
    let regularisation = |diagonal: f64| ((1.0 - imp) * diagonal / imp).max(MINVAL);
    let r = &mut efc.efc_R[rows.clone()];
    match kind {
        Some(ConstraintType::ContactPyramidal) => {
            let contact = &mut con.contact[efc.efc_id[first] as usize];
            let normal = regularisation(efc.efc_diagA[first]);
            set_friction(m, contact, normal);
            let edge = 2.0 * contact.mu * contact.mu * normal;
            r.fill(edge);
            efc.efc_D[rows.clone()].fill(1.0 / edge);
            efc.efc_diagA[rows].fill(edge * imp / (1.0 - imp));
            return;
        }
        Some(ConstraintType::ContactElliptic) => {
            let contact = &mut con.contact[efc.efc_id[first] as usize];
            let friction = contact.friction;
            r[0] = regularisation(efc.efc_diagA[first]);
            r[1] = set_friction(m, contact, r[0]);
            for j in 1..length - 1 {
                r[j + 1] = r[1] * friction[0] * friction[0] / (friction[j] * friction[j]);
            }
            let [_, b] =
                spring_damper(if solreffriction == [0.0; 2] { solref } else { solreffriction }, solimp[1]);
            efc.efc_KBIP[first + 1..rows.end].fill([0.0, b, imp, slope]);
        }
        _ => r.iter_mut().zip(&efc.efc_diagA[rows.clone()]).for_each(|(r, a)| *r = regularisation(*a)),
    }
    for i in rows {
        efc.efc_D[i] = 1.0 / efc.efc_R[i];
        efc.efc_diagA[i] = efc.efc_R[i] * imp / (1.0 - imp);
    }
}

/// Sets `mu` of the regularised cone of a contact whose normal has regularisation `normal`, so that friction is
/// `impratio` times as firm; returns the regularisation of the first tangent.
fn set_friction(m: &Model, contact: &mut Contact, normal: f64) -> f64 {
    let tangential = normal / m.opt.impratio.max(MINVAL);
    contact.mu = contact.friction[0] * (tangential / normal).sqrt();
    tangential
}

/// Stiffness and damping: from time constant and damping ratio when positive, else given directly with a minus sign.
fn spring_damper(solref: [f64; 2], width: f64) -> [f64; 2] {
    let [r0, r1] = solref;
    [
        if r0 > 0.0 {
            1.0 / (width * width * r0 * r0 * r1 * r1).max(MINVAL)
        } else {
            -r0 / (width * width).max(MINVAL)
        },
        if r1 > 0.0 { 2.0 / (width * r0).max(MINVAL) } else { -r1 / width.max(MINVAL) },
    ]
}

/// What the impedance curve is evaluated at: the distance, or its norm for constraints of several dimensions.
fn violation(m: &Model, efc: &Constraints, first: usize, length: usize) -> f64 {
    let several = efc.efc_type[first] == ConstraintType::Equality.code()
        && matches!(
            EqType::from_code(m.eq_type[efc.efc_id[first] as usize]),
            Some(EqType::Weld | EqType::Connect)
        );
    if several { norm_slice(&efc.efc_pos[first..first + length]) } else { efc.efc_pos[first] }
}

struct SolverParameters {
    solref: [f64; 2],
    solreffriction: [f64; 2],
    solimp: [f64; 5],
}

/// Parameters of the element that made row `i`, made consistent.
fn solver_parameters(
    m: &Model,
    con: &Contacts,
    efc: &Constraints,
    i: usize,
    kind: Option<ConstraintType>,
) -> SolverParameters {
    let id = efc.efc_id[i] as usize;
    let (mut solref, mut solreffriction, mut solimp) = match kind {
        Some(
            ConstraintType::ContactFrictionless
            | ConstraintType::ContactPyramidal
            | ConstraintType::ContactElliptic,
        ) => {
            let c = &con.contact[id];
            (c.solref, c.solreffriction, c.solimp)
        }
        _ => {
            let (solref, solimp) = element_parameters(m, id, kind);
            (*solref, [0.0; 2], *solimp)
        }
    };
    let mixed = |r: [f64; 2]| (r[0] > 0.0) != (r[1] > 0.0);
    if mixed(solref) {
        solref = DEFAULT_SOLREF;
    }
    if mixed(solreffriction) {
        solreffriction = [0.0; 2];
    }
    if !m.opt.disableflags.contains(Disable::REFSAFE) {
        for r in [&mut solref, &mut solreffriction] {
            if r[0] > 0.0 {
                r[0] = r[0].max(2.0 * m.opt.timestep);
            }
        }
    }
    for k in [0, 1, 3] {
        solimp[k] = solimp[k].clamp(MINIMP, MAXIMP);
    }
    solimp[2] = solimp[2].max(0.0);
    solimp[4] = solimp[4].max(1.0);
    SolverParameters { solref, solreffriction, solimp }
}

/// `solref` and `solimp` of the element that makes rows of `kind`, which is not a contact.
///
/// Not inlined, so that the addresses of two arrays are loaded instead of ten.
#[inline(never)]
fn element_parameters(m: &Model, id: usize, kind: Option<ConstraintType>) -> (&[f64; 2], &[f64; 5]) {
    match kind {
        Some(ConstraintType::FrictionDof) => (&m.dof_solref[id], &m.dof_solimp[id]),
        Some(ConstraintType::FrictionTendon) => (&m.tendon_solref_fri[id], &m.tendon_solimp_fri[id]),
        Some(ConstraintType::LimitJoint) => (&m.jnt_solref[id], &m.jnt_solimp[id]),
        Some(ConstraintType::LimitTendon) => (&m.tendon_solref_lim[id], &m.tendon_solimp_lim[id]),
        _ => (&m.eq_solref[id], &m.eq_solimp[id]),
    }
}

/// Impedance and its derivative at distance `pos`: a sigmoid of two power segments that meet at the midpoint.
fn curve(solimp: &[f64; 5], pos: f64, margin: f64) -> (f64, f64) {
    let [least, most, width, midpoint, exponent] = *solimp;
    if least == most || width <= MINVAL {
        return (0.5 * (least + most), 0.0);
    }
    let signed = (pos - margin) / width;
    let (x, sign) = if signed < 0.0 { (-signed, -1.0) } else { (signed, 1.0) };
    if x >= 1.0 || x <= 0.0 {
        return (if x >= 1.0 { most } else { least }, 0.0);
    }
    let (y, slope) = if exponent == 1.0 {
        (x, 1.0)
    } else if x <= midpoint {
        let a = 1.0 / power(midpoint, exponent - 1.0);
        (a * power(x, exponent), exponent * a * power(x, exponent - 1.0))
    } else {
        let b = 1.0 / power(1.0 - midpoint, exponent - 1.0);
        (1.0 - b * power(1.0 - x, exponent), exponent * b * power(1.0 - x, exponent - 1.0))
    };
    (least + y * (most - least), slope * sign * (most - least) / width)
}

/// `a` to the power `b`, exact for the usual powers 1 and 2.
fn power(a: f64, b: f64) -> f64 {
    if b == 1.0 {
        a
    } else if b == 2.0 {
        a * a
    } else {
        ops::pow(a, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curve_is_continuous_and_its_slope_is_its_derivative() {
        let solimp = [0.8, 0.97, 0.01, 0.3, 3.0];
        for pos in [-0.012, -0.008, -0.003, -0.001, 0.002, 0.0029, 0.0031, 0.007] {
            let h = 1e-8;
            let (value, slope) = curve(&solimp, pos, 0.0);
            let difference = (curve(&solimp, pos + h, 0.0).0 - curve(&solimp, pos - h, 0.0).0) / (2.0 * h);
            assert!((0.8..=0.97).contains(&value));
            assert!((slope - difference).abs() < 1e-3, "{pos}: {slope} {difference}");
        }
        assert_eq!(curve(&solimp, 0.0, 0.0), (0.8, 0.0));
        assert_eq!(curve(&solimp, -0.02, 0.0), (0.97, 0.0));
    }

    #[test]
    fn spring_and_damper_are_critical_at_ratio_one() {
        let [k, b] = spring_damper([0.02, 1.0], 0.9);
        assert!((b * b / (4.0 * k) - 1.0).abs() < 1e-12);
        assert_eq!(spring_damper([-100.0, -5.0], 1.0), [100.0, 5.0]);
    }
}
