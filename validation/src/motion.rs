//! Whole forward passes, single re-synchronised steps and free rollouts beside the recorded ones.

use crate::compare::{Worst, compare, of_largest};
use crate::reference::{Reference, ReferenceError};
use crate::tolerance::{QACC, ROLLOUT_ABSOLUTE, STEP, TWIN_FACTOR};
use physics::{Data, Model};

/// Share of touching states that must agree.
pub const TOUCHING_SHARE: f64 = 0.95;

/// Forward passes of the recorded states.
pub struct ForwardReport {
    /// Recorded states, and those with contacts.
    pub states: usize,
    /// States in which MuJoCo has a contact.
    pub touching: usize,
    /// States whose `qacc` agrees.
    pub agreeing: usize,
    /// Touching states whose `qacc` agrees.
    pub touching_agreeing: usize,
    /// States whose contact count equals MuJoCo's.
    pub equal_contacts: usize,
    /// The worst `qacc` of all states, with its state.
    pub worst: Option<(usize, Worst)>,
    /// First failure of our own forward pass.
    pub failure: Option<String>,
}

impl ForwardReport {
    /// The share of agreeing states reaches the bar, among touching ones where there are any.
    pub fn agrees(&self) -> bool {
        match self.touching {
            0 => self.agreeing == self.states,
            n => self.touching_agreeing as f64 >= TOUCHING_SHARE * n as f64,
        }
    }
}

/// Runs our forward pass on every recorded state and compares `qacc` in units of its largest component.
///
/// # Errors
/// The reference lacks an array.
pub fn compare_forward(m: &Model, reference: &Reference) -> Result<ForwardReport, ReferenceError> {
    let mut d = Data::new(m);
    let mut report = ForwardReport {
        states: reference.states()?,
        touching: 0,
        agreeing: 0,
        touching_agreeing: 0,
        equal_contacts: 0,
        worst: None,
        failure: None,
    };
    for row in 0..report.states {
        reference.set_state(&mut d, m, row)?;
        if let Err(error) = physics::forward(m, &mut d) {
            report.failure.get_or_insert(error.to_string());
            continue;
        }
        let touching = reference.state_row("forward", "ncon", row)?;
        let touching = touching.first().map_or(0, |&count| count as usize);
        let worst = compare("qacc", &d.acc.qacc, &reference.forward("qacc", row)?, of_largest);
        let agrees = worst.error <= QACC;
        report.touching += usize::from(touching > 0);
        report.agreeing += usize::from(agrees);
        report.touching_agreeing += usize::from(agrees && touching > 0);
        report.equal_contacts += usize::from(d.con.contact.len() == touching);
        if report.worst.as_ref().is_none_or(|(_, w)| worst.error > w.error) {
            report.worst = Some((row, worst));
        }
    }
    Ok(report)
}

/// Single steps, each from MuJoCo's recorded state.
pub struct StepReport {
    /// Steps compared.
    pub steps: usize,
    /// Steps whose positions agree.
    pub agreeing: usize,
    /// Largest difference of any position after one step \[m, rad\], and its step.
    pub worst: (f64, usize),
}

/// Steps along the recorded rollout, taking positions, velocities and activations from it before every step; the
/// solver starts from our own last acceleration.
///
/// # Errors
/// The reference lacks an array.
pub fn compare_steps(m: &Model, reference: &Reference) -> Result<StepReport, ReferenceError> {
    let (qpos, steps) = reference.rows("rollout.qpos", m.nq)?;
    let ctrl = rows_along(reference, "rollout.ctrl", m.nu, steps)?;
    let qvel = rows_along(reference, "rollout.qvel", m.nv, steps)?;
    let act = rows_along(reference, "rollout.act", m.na, steps)?;
    let row = |values: &[f64], width: usize, row: usize| values[row * width..(row + 1) * width].to_vec();
    let mut d = Data::new(m);
    if m.nkey > 0 {
        d.reset_to_key(m, 0).map_err(|_| ReferenceError::Shape("key_qpos".into()))?;
    }
    // The first step is not compared: it brings its control into the histories.
    d.state.ctrl = row(&ctrl, m.nu, 0);
    let begun = physics::step(m, &mut d);
    let mut report = StepReport { steps: steps.saturating_sub(1), agreeing: 0, worst: (0.0, 0) };
    for step in 1..steps {
        d.state.qpos = row(&qpos, m.nq, step - 1);
        d.state.qvel = row(&qvel, m.nv, step - 1);
        d.state.act = row(&act, m.na, step - 1);
        d.state.ctrl = row(&ctrl, m.nu, step);
        let difference = match begun.clone().and_then(|()| physics::step(m, &mut d)) {
            Ok(()) => largest_difference(&d.state.qpos, &row(&qpos, m.nq, step)),
            Err(_) => f64::INFINITY,
        };
        report.agreeing += usize::from(difference <= STEP);
        if difference > report.worst.0 {
            report.worst = (difference, step);
        }
    }
    Ok(report)
}

/// Step up to which the early part of a rollout is reported.
pub const EARLY: usize = 100;

/// Positions of a twin that starts on the other side; not every recording has one.
const SECOND_TWIN: &str = "twin.below";

/// A free rollout beside the recorded one.
pub struct RolloutReport {
    /// Steps compared.
    pub steps: usize,
    /// Largest difference of any position up to the last step \[m, rad\].
    pub divergence: f64,
    /// MuJoCo's own divergence from its twin.
    pub twin: f64,
    /// Largest difference of any position up to step [`EARLY`] \[m, rad\].
    pub early: f64,
    /// First step outside the bound, when there is one.
    pub first_outside: Option<usize>,
    /// Largest difference by step.
    pub by_step: Vec<f64>,
    /// Step and text of a failure where MuJoCo has none.
    pub failure: Option<(usize, String)>,
}

impl RolloutReport {
    /// True when the whole rollout stays within the bound.
    pub fn follows(&self) -> bool {
        self.first_outside.is_none() && self.failure.is_none()
    }
}

/// Steps from keyframe 0, or `qpos0`, under the recorded controls. The bound at a step is the twin factor times the
/// largest twin divergence so far, or the absolute one. Bad values are reset where MuJoCo's run has them too.
///
/// # Errors
/// The reference lacks an array.
pub fn compare_rollout(m: &Model, reference: &Reference) -> Result<RolloutReport, ReferenceError> {
    let (theirs, steps) = reference.rows("rollout.qpos", m.nq)?;
    let ctrl = rows_along(reference, "rollout.ctrl", m.nu, steps)?;
    let mut twins = vec![rows_along(reference, "twin.qpos", m.nq, steps)?];
    if reference.archive().names().any(|name| name == SECOND_TWIN) {
        twins.push(rows_along(reference, SECOND_TWIN, m.nq, steps)?);
    }
    let mut d = Data::new(m);
    if m.nkey > 0 {
        d.reset_to_key(m, 0).map_err(|_| ReferenceError::Shape("key_qpos".into()))?;
    }
    let mut report = RolloutReport {
        steps,
        divergence: 0.0,
        twin: 0.0,
        early: 0.0,
        first_outside: None,
        by_step: Vec::new(),
        failure: None,
    };
    d.autoreset =
        reference.archive().require("rollout.bad")?.values.to_f64().first().is_some_and(|&n| n > 0.0);
    for step in 0..steps {
        d.state.ctrl.copy_from_slice(&ctrl[step * m.nu..(step + 1) * m.nu]);
        let outcome = physics::step(m, &mut d);
        if let Err(error) = outcome {
            report.failure = Some((step, error.to_string()));
            break;
        }
        let row = step * m.nq..(step + 1) * m.nq;
        report.divergence = report.divergence.max(largest_difference(&d.state.qpos, &theirs[row.clone()]));
        for twin in &twins {
            report.twin = report.twin.max(largest_difference(&twin[row.clone()], &theirs[row.clone()]));
        }
        report.by_step.push(report.divergence);
        if step < EARLY {
            report.early = report.divergence;
        }
        let bound = ROLLOUT_ABSOLUTE.max(TWIN_FACTOR * report.twin);
        if report.divergence > bound || report.divergence.is_nan() {
            report.first_outside.get_or_insert(step);
        }
    }
    Ok(report)
}

/// An array with one row for each step of a rollout, at least one.
fn rows_along(
    reference: &Reference,
    name: &str,
    width: usize,
    steps: usize,
) -> Result<Vec<f64>, ReferenceError> {
    match reference.rows(name, width)? {
        (values, rows) if rows == steps && rows > 0 => Ok(values),
        _ => Err(ReferenceError::Shape(name.to_owned())),
    }
}

/// Largest difference of two states; numbers that are bad in both do not differ.
fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |worst: f64, (x, y)| match (x.is_finite(), y.is_finite()) {
        (true, true) => worst.max((x - y).abs()),
        (false, false) => worst,
        _ => f64::INFINITY,
    })
}
