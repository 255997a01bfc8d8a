//! Laws of the forward pass on recorded states: what two ways of computing one thing must agree on.

use super::law::{Bound, Law, LawError};
use crate::reference::Reference;
use crate::solver::CONES;
use crate::tolerance::{
    CONVERGED_INVERSE, CONVERGED_INVERSE_STIFF, CONVERGED_STORAGE, ISLANDS, OUTSIDE, SLOPE, friction_is_stiff,
};
use physics::acceleration::contact_force::contact_force;
use physics::derivative::{BiasSlope, DerivativeInputs, smooth_force_slope};
use physics::model::{BiasType, Cone, ConstraintType, Disable, Jacobian, Solver};
use physics::{Data, Model, StepError};

/// Nudge of velocities for finite differences.
const NUDGE: f64 = 1e-6;
/// States of each model on which slopes are compared: a column costs two forward passes.
const SLOPE_STATES: usize = 1;
/// Most states of a model.
const STATES: usize = 6;

/// Worst numbers so far.
#[derive(Default)]
struct Worst {
    inverse: f64,
    inverse_stiff: f64,
    storage: f64,
    islands: f64,
    pyramids: f64,
    cones: f64,
    friction_loss: f64,
    slope: f64,
    states: usize,
    /// Rows of pyramidal contacts and limits, of dry friction, and elliptic contacts, whose forces were judged.
    judged: [usize; 3],
}

/// Every law of this module, the worst over all states of `references`.
pub(super) fn recorded(on: &str, references: &[Reference]) -> Result<Vec<Law>, LawError> {
    let mut worst = Worst::default();
    for reference in references {
        let mut m = reference.model()?;
        let own = m.opt.clone();
        let rows = reference.states()?;
        for k in 0..STATES.min(rows) {
            let mut d = Data::new(&m);
            reference.set_state(&mut d, &m, k * rows / STATES.min(rows))?;
            worst.take(&mut m, &d)?;
            m.options_mut().clone_from(&own);
            if k < SLOPE_STATES && !has_gaps(&m) {
                worst.slope = worst.slope.max(slope(&m, &mut d)?);
            }
        }
    }
    // A law of forces says nothing where there are none.
    let forces = [&mut worst.pyramids, &mut worst.friction_loss, &mut worst.cones];
    for (measured, _) in forces.into_iter().zip(worst.judged).filter(|(_, judged)| *judged < 100) {
        *measured = f64::INFINITY;
    }
    let on = format!("{} states of {} {on}", worst.states, references.len());
    let law = |law, measured, most| Law::new(law, &on, measured, Bound::Within(most));
    Ok(vec![
        law(
            "inverse dynamics undoes forward dynamics (converged solver, both cones)",
            worst.inverse,
            &CONVERGED_INVERSE,
        ),
        law(
            "the same with friction stiffer than contact (`impratio` above 1)",
            worst.inverse_stiff,
            &CONVERGED_INVERSE_STIFF,
        ),
        law("dense and sparse rows make one acceleration", worst.storage, &CONVERGED_STORAGE),
        law("islands make no difference (converged solver)", worst.islands, &ISLANDS),
        law("pyramidal contacts push", worst.pyramids, &OUTSIDE),
        law("elliptic contact forces stay in their cones", worst.cones, &OUTSIDE),
        law("dry friction stays within its loss", worst.friction_loss, &OUTSIDE),
        law("`qDeriv` is the slope of smooth forces", worst.slope, &SLOPE),
    ])
}

/// True where the slope leaves something out, as upstream: supply limit, heating and bristles of DC motors, elasticity of
/// flexes, and parts of fluid forces on ellipsoids (MuJoCo's slopes of a swimming snake are off by up to 3 % too).
fn has_gaps(m: &Model) -> bool {
    let medium = m.opt.density > 0.0 || m.opt.viscosity > 0.0;
    let swims = medium && m.geom_fluid.iter().any(|fluid| fluid[0] > 0.0);
    m.nflex > 0 || swims || m.actuator_biastype.contains(&BiasType::Dcmotor.code())
}

impl Worst {
    /// Leaves the options of `m` changed.
    fn take(&mut self, m: &mut Model, start: &Data) -> Result<(), LawError> {
        self.states += 1;
        let rows = [Jacobian::Dense, Jacobian::Sparse].map(|storage| {
            m.options_mut().jacobian = storage;
            forward(m, start)
        });
        self.storage = self.storage.max(qacc_difference(rows)?);
        for cone in CONES {
            m.options_mut().cone = cone;
            self.forces(m, &forward(m, start)?);
        }
        (m.options_mut().solver, m.options_mut().noslip_iterations) = (Solver::Newton, 0);
        (m.options_mut().tolerance, m.options_mut().iterations, m.options_mut().ls_iterations) =
            (0.0, 200, 200);
        for cone in CONES {
            m.options_mut().cone = cone;
            let worst = if friction_is_stiff(m) { &mut self.inverse_stiff } else { &mut self.inverse };
            *worst = worst.max(inverse(m, start)?);
        }
        let islands = [false, true].map(|off| {
            m.options_mut().disableflags.set(Disable::ISLAND, off);
            forward(m, start)
        });
        self.islands = self.islands.max(qacc_difference(islands)?);
        Ok(())
    }

    /// How far forces are outside their sets.
    fn forces(&mut self, m: &Model, d: &Data) {
        let force = &d.efc.efc_force;
        let scale = force.iter().fold(f64::MIN_POSITIVE, |s: f64, f| s.max(f.abs()));
        for i in 0..d.efc.nefc {
            match ConstraintType::from_code(d.efc.efc_type[i]) {
                Some(ConstraintType::Equality | ConstraintType::ContactElliptic) | None => {}
                Some(ConstraintType::FrictionDof | ConstraintType::FrictionTendon) => {
                    let excess = (force[i].abs() - d.efc.efc_frictionloss[i]) / scale;
                    self.friction_loss = self.friction_loss.max(excess);
                    self.judged[1] += usize::from(force[i] != 0.0);
                }
                Some(_) => {
                    self.pyramids = self.pyramids.max(-force[i] / scale);
                    self.judged[0] += usize::from(force[i] != 0.0);
                }
            }
        }
        if m.opt.cone == Cone::Elliptic {
            for c in d.con.contact.iter().filter(|c| c.efc_address >= 0) {
                let f = contact_force(m, &d.efc, c);
                let share = |k: usize| if k < c.dim as usize { f[k] / c.friction[k - 1] } else { 0.0 };
                let sideways = (1..6).map(|k| share(k).powi(2)).sum::<f64>().sqrt();
                self.cones = self.cones.max((sideways - (f[0] + c.adhesion)) / scale);
                self.judged[2] += usize::from(sideways > 0.0);
            }
        }
    }
}

fn forward(m: &Model, start: &Data) -> Result<Data, StepError> {
    let mut d = start.clone();
    physics::forward(m, &mut d).map(|()| d)
}

fn qacc_difference([a, b]: [Result<Data, StepError>; 2]) -> Result<f64, LawError> {
    Ok(difference(&a?.acc.qacc, &b?.acc.qacc))
}

/// Largest difference relative to the largest component.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let scale = b.iter().fold(f64::MIN_POSITIVE, |s: f64, x| s.max(x.abs()));
    a.iter().zip(b).fold(0.0, |e: f64, (a, b)| e.max((a - b).abs())) / scale
}

fn inverse(m: &Model, start: &Data) -> Result<f64, LawError> {
    let mut d = forward(m, start)?;
    let applied: Vec<f64> =
        d.state.qfrc_applied.iter().zip(&d.actuation.qfrc_actuator).map(|(a, b)| a + b).collect();
    let forces = [&d.acc.qfrc_constraint, &d.vel.qfrc_bias, &d.passive.qfrc_passive, &applied];
    let scale = forces.into_iter().flatten().fold(f64::MIN_POSITIVE, |s: f64, x| s.max(x.abs()));
    physics::inverse(m, &mut d)?;
    let found = d.implicit.qfrc_inverse.iter().zip(&applied);
    Ok(found.fold(0.0, |e: f64, (a, b)| e.max((a - b).abs())) / scale)
}

/// True where the sum of actuator forces on a joint is clamped: the analytic slope ignores the clamp, as upstream.
fn clamped(m: &Model, d: &Data, dof: usize) -> bool {
    let joint = m.dof_jntid[dof] as usize;
    m.jnt_actfrclimited[joint] && m.jnt_actfrcrange[joint].contains(&d.actuation.qfrc_actuator[dof])
}

/// Difference of the analytic slope of smooth forces by velocity and central differences.
fn slope(m: &Model, d: &mut Data) -> Result<f64, LawError> {
    physics::forward(m, d)?;
    let inputs = DerivativeInputs::from(&*d);
    let mut slope = vec![0.0; m.nD];
    smooth_force_slope(m, &inputs, BiasSlope::Included, &mut Default::default(), &mut slope);
    // Rounding of forces over the nudge is what is left of a slope that is zero.
    let entries = slope.iter().chain(&d.acc.qfrc_smooth);
    let scale = entries.fold(f64::MIN_POSITIVE, |s: f64, x| s.max(x.abs()));
    let mut nudged = d.clone();
    let mut worst = 0.0_f64;
    for j in 0..m.nv {
        let mut force = |step: f64| {
            nudged.state.qvel.copy_from_slice(&d.state.qvel);
            nudged.state.qvel[j] += step;
            physics::forward(m, &mut nudged).map(|()| nudged.acc.qfrc_smooth.clone())
        };
        let (plus, minus) = (force(NUDGE)?, force(-NUDGE)?);
        for i in (0..m.nv).filter(|&i| !clamped(m, d, i)) {
            for k in physics::derivative::row(m, i).filter(|&k| m.D_colind[k] as usize == j) {
                let found = (plus[i] - minus[i]) / (2.0 * NUDGE);
                worst = worst.max((slope[k] - found).abs() / scale);
            }
        }
    }
    Ok(worst)
}
