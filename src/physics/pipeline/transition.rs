//! Finite-difference derivatives of a step and of inverse dynamics (MuJoCo documentation, API reference,
//! `mjd_transitionFD` and `mjd_inverseFD`). Stages that a nudge cannot change are not evaluated again, and matrix
//! factors are kept as there.
//!
//! ```
//! use robohive_physics::pipeline::transition::inverse_slope;
//! use robohive_physics::Data;
//!
//! let model = robohive_mjcf::load_str(
//!     "<mujoco><worldbody><body><joint axis='0 1 0'/><geom size='.1' pos='1 0 0'/></body></worldbody></mujoco>",
//! )?
//! .model;
//! // The slope of force with acceleration is the inertia.
//! let slope = inverse_slope(&model, &mut Data::new(&model), 1e-6)?;
//! assert!((slope.acceleration[0] - model.dof_M0[0]).abs() < 1e-4 * model.dof_M0[0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::data::{Data, State};
use crate::integration::integrate::{differentiate_pos, integrate_pos};
use crate::model::NotSimulated;
use crate::model::{Integrator, Model};
use crate::pipeline::error::StepError;
use crate::pipeline::forward::Known;
use crate::pipeline::inverse::inverse_after;
use crate::pipeline::step::step_after;

/// Linearisation of one step: `dx' = A dx + B du`, `ds = C dx + D du`. `x` holds changes of position (as velocities),
/// velocity and activation, `n = 2 nv + na`; `u` the controls, `s` the sensor readings. Row-major.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transition {
    /// State from state, `n * n`.
    pub a: Vec<f64>,
    /// State from control, `n * nu`.
    pub b: Vec<f64>,
    /// Sensors from state, `nsensordata * n`.
    pub c: Vec<f64>,
    /// Sensors from control, `nsensordata * nu`. Of centred differences, upstream returns the negative.
    pub d: Vec<f64>,
}

/// State and sensor readings after a step, or differences of them.
struct Outcome {
    qpos: Vec<f64>,
    /// Velocities and activations.
    rates: Vec<f64>,
    sensors: Vec<f64>,
}

impl Outcome {
    fn read(d: &Data) -> Self {
        let mut rates = d.state.qvel.clone();
        rates.extend_from_slice(&d.state.act);
        Outcome { qpos: d.state.qpos.clone(), rates, sensors: d.sensor.sensordata.clone() }
    }

    /// Changes of state and of sensors from `self` to `next`, divided by `h`.
    fn slope(&self, m: &Model, next: &Outcome, h: f64) -> (Vec<f64>, Vec<f64>) {
        let mut state = vec![0.0; m.nv];
        differentiate_pos(m, &self.qpos, &next.qpos, h, &mut state);
        let slope = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (b - a) / h).collect::<Vec<_>>();
        state.extend(slope(&self.rates, &next.rates));
        (state, slope(&self.sensors, &next.sensors))
    }
}

/// What is differentiated at: model, state and inputs, the size of nudges.
struct Centre<'a> {
    m: &'a Model,
    state: State,
    outcome: Outcome,
    eps: f64,
}

impl Centre<'_> {
    /// Steps from the nudged state, reads the outcome, and restores the state.
    fn step(&self, d: &mut Data, known: Known, nudge: impl FnOnce(&mut State)) -> Result<Outcome, StepError> {
        nudge(&mut d.state);
        let result = step_after(self.m, d, known);
        let outcome = Outcome::read(d);
        d.state.clone_from(&self.state);
        result.map(|()| outcome)
    }

    /// Slopes along one nudge, forwards and backwards as far as wanted; zero when both are forbidden.
    fn slope(
        &self,
        d: &mut Data,
        known: Known,
        [forwards, backwards]: [bool; 2],
        nudge: impl Fn(&mut State, f64),
    ) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        let eps = self.eps;
        let plus = if forwards { Some(self.step(d, known, |s| nudge(s, eps))?) } else { None };
        let minus = if backwards { Some(self.step(d, known, |s| nudge(s, -eps))?) } else { None };
        Ok(match (&plus, &minus) {
            (Some(plus), Some(minus)) => minus.slope(self.m, plus, 2.0 * eps),
            (Some(plus), None) => self.outcome.slope(self.m, plus, eps),
            (None, Some(minus)) => minus.slope(self.m, &self.outcome, eps),
            (None, None) => (vec![0.0; 2 * self.m.nv + self.m.na], vec![0.0; self.m.nsensordata]),
        })
    }

    /// Directions in which control `k` may be nudged within its range.
    fn directions(&self, k: usize, centred: bool) -> [bool; 2] {
        let (m, u) = (self.m, self.state.ctrl[k]);
        let [low, high] = m.actuator_ctrlrange[k];
        let inside = |x: f64| !m.actuator_ctrllimited[k] || (low <= x && x <= high);
        let forwards = inside(u) && inside(u + self.eps);
        [forwards, (centred || !forwards) && inside(u) && inside(u - self.eps)]
    }
}

/// Linearises one step of `d` by nudges of size `eps`, one-sided or centred. State and inputs of `d` are kept.
///
/// # Errors
/// The integrator is Runge-Kutta, or a step fails.
pub fn transition(m: &Model, d: &mut Data, eps: f64, centred: bool) -> Result<Transition, StepError> {
    check_differences(m)?;
    let state = d.state.clone();
    step_after(m, d, Known::Nothing)?;
    let centre = Centre { m, state, outcome: Outcome::read(d), eps };
    d.state.clone_from(&centre.state);
    let n = 2 * m.nv + m.na;
    let mut out = Transition {
        a: vec![0.0; n * n],
        b: vec![0.0; n * m.nu],
        c: vec![0.0; m.nsensordata * n],
        d: vec![0.0; m.nsensordata * m.nu],
    };
    for k in 0..m.nu {
        let directions = centre.directions(k, centred);
        let (state, sensors) = centre.slope(d, Known::Velocity, directions, |s, h| s.ctrl[k] += h)?;
        set_column(&mut out.b, m.nu, k, &state);
        set_column(&mut out.d, m.nu, k, &sensors);
    }
    let both = [true, centred];
    for i in 0..n {
        let (v, a) = (i.wrapping_sub(m.nv), i.wrapping_sub(2 * m.nv));
        let (state, sensors) = if i >= 2 * m.nv {
            centre.slope(d, Known::Velocity, both, |s, h| s.act[a] += h)?
        } else if i >= m.nv {
            centre.slope(d, Known::Position, both, |s, h| s.qvel[v] += h)?
        } else {
            centre.slope(d, Known::Nothing, both, |s, h| nudge_position(m, s, i, h))?
        };
        set_column(&mut out.a, n, i, &state);
        set_column(&mut out.c, n, i, &sensors);
    }
    Ok(out)
}

fn check_differences(m: &Model) -> Result<(), StepError> {
    if m.nhistory > 0 {
        return Err(NotSimulated::feature("finite differences of models with delays").into());
    }
    if m.opt.integrator == Integrator::Rk4 {
        return Err(NotSimulated::feature("finite differences of the integrator RK4").into());
    }
    Ok(())
}

fn nudge_position(m: &Model, state: &mut State, dof: usize, h: f64) {
    let mut direction = vec![0.0; m.nv];
    direction[dof] = 1.0;
    integrate_pos(m, &mut state.qpos, &direction, h);
}

fn set_column(matrix: &mut [f64], width: usize, column: usize, values: &[f64]) {
    for (row, value) in matrix.chunks_exact_mut(width).zip(values) {
        row[column] = *value;
    }
}

/// Derivatives of `qfrc_inverse`, each `nv * nv`: row `i` holds the change of all forces with coordinate `i`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InverseSlope {
    /// With respect to position.
    pub position: Vec<f64>,
    /// With respect to velocity.
    pub velocity: Vec<f64>,
    /// With respect to acceleration.
    pub acceleration: Vec<f64>,
}

/// Differentiates inverse dynamics at `qacc` by one-sided nudges of size `eps`. State and `qacc` of `d` are kept.
///
/// # Errors
/// The integrator is Runge-Kutta, slip is removed after the solver, or the model uses what is not simulated.
pub fn inverse_slope(m: &Model, d: &mut Data, eps: f64) -> Result<InverseSlope, StepError> {
    check_differences(m)?;
    if m.opt.noslip_iterations > 0 {
        return Err(
            NotSimulated::feature("finite differences of inverse dynamics with removal of slip").into()
        );
    }
    inverse_after(m, d, Known::Nothing, false)?;
    let centre = d.implicit.qfrc_inverse.clone();
    let mut out = InverseSlope::default();
    let append = |rows: &mut Vec<f64>, d: &Data| {
        rows.extend(d.implicit.qfrc_inverse.iter().zip(&centre).map(|(f, f0)| (f - f0) / eps));
    };
    for i in 0..m.nv {
        let kept = d.acc.qacc[i];
        d.acc.qacc[i] += eps;
        let result = inverse_after(m, d, Known::Velocity, false);
        append(&mut out.acceleration, d);
        d.acc.qacc[i] = kept;
        result?;
    }
    for i in 0..m.nv {
        let kept = d.state.qvel[i];
        d.state.qvel[i] += eps;
        let result = inverse_after(m, d, Known::Position, false);
        append(&mut out.velocity, d);
        d.state.qvel[i] = kept;
        result?;
    }
    let kept = d.state.qpos.clone();
    for i in 0..m.nv {
        nudge_position(m, &mut d.state, i, eps);
        let result = inverse_after(m, d, Known::Nothing, false);
        append(&mut out.position, d);
        d.state.qpos.copy_from_slice(&kept);
        result?;
    }
    Ok(out)
}
