//! Iterative linear-quadratic regulators with bounds on the controls: a trajectory is improved by the regulator of its own
//! linearisation, step by step (Tassa, Mansard and Todorov, Control-limited differential dynamic programming, ICRA 2014, without the
//! second derivatives of the dynamics).

use super::NoSolution;
use super::box_program::minimise;
use nalgebra::{DMatrix, DVector};

/// Size of the differences that slopes are made of where a system gives none.
const NUDGE: f64 = 1e-5;
/// Shares of an improvement that are tried.
const SHARES: [f64; 8] = [1.0, 0.6, 0.36, 0.2, 0.1, 0.05, 0.02, 0.005];
/// Regularisation at the beginning.
const START: f64 = 1e-3;
/// Its factor after success and failure.
const FACTOR: f64 = 4.0;
/// What it does not fall below.
const LEAST: f64 = 1e-8;
/// Where no improvement is looked for any more.
const MOST: f64 = 1e8;

/// A system from step to step.
pub trait Dynamics {
    /// Numbers of a state.
    fn states(&self) -> usize;

    /// Numbers of controls.
    fn controls(&self) -> usize;

    /// Writes the state that follows `x` under the controls `u`.
    ///
    /// # Errors
    /// The system cannot go on from there.
    fn step(&mut self, x: &[f64], u: &[f64], next: &mut [f64]) -> Result<(), NoSolution>;

    /// The slopes of the next state with the state and with the controls; centred differences unless a system knows better.
    ///
    /// # Errors
    /// As [`Dynamics::step`].
    fn slopes(&mut self, x: &[f64], u: &[f64]) -> Result<[DMatrix<f64>; 2], NoSolution> {
        let (n, m) = (self.states(), self.controls());
        let both: Vec<f64> = [x, u].concat();
        let mut all = DMatrix::zeros(n, n + m);
        let mut ends = [vec![0.0; n], vec![0.0; n]];
        for column in 0..n + m {
            for (end, sign) in ends.iter_mut().zip([1.0, -1.0]) {
                let mut nudged = both.clone();
                nudged[column] += sign * NUDGE;
                self.step(&nudged[..n], &nudged[n..], end)?;
            }
            for row in 0..n {
                all[(row, column)] = (ends[0][row] - ends[1][row]) / (2.0 * NUDGE);
            }
        }
        Ok([all.columns(0, n).clone_owned(), all.columns(n, m).clone_owned()])
    }
}

/// Costs that are sums of weighted squares: half of each weight times the square of a distance.
#[derive(Clone, Debug, PartialEq)]
pub struct Quadratic {
    /// The state to come to (states).
    pub goal: Vec<f64>,
    /// Weights of the state in every step (states).
    pub running: Vec<f64>,
    /// Weights of the last state (states).
    pub last: Vec<f64>,
    /// Weights of the controls in every step (controls).
    pub effort: Vec<f64>,
}

impl Quadratic {
    fn of_state(&self, weights: &[f64], x: &[f64]) -> f64 {
        let each = weights.iter().zip(x).zip(&self.goal);
        each.map(|((weight, x), goal)| 0.5 * weight * (x - goal) * (x - goal)).sum()
    }

    fn of_controls(&self, u: &[f64]) -> f64 {
        self.effort.iter().zip(u).map(|(weight, u)| 0.5 * weight * u * u).sum()
    }

    fn slope(&self, weights: &[f64], x: &[f64]) -> DVector<f64> {
        let each = weights.iter().zip(x).zip(&self.goal);
        DVector::from_iterator(x.len(), each.map(|((weight, x), goal)| weight * (x - goal)))
    }
}

/// How a trajectory is looked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Ilqr {
    /// What it costs.
    pub cost: Quadratic,
    /// Bounds of each control, the lower one first.
    pub bounds: Vec<[f64; 2]>,
    /// Most improvements.
    pub iterations: usize,
    /// Share of the cost that an improvement must bring for another one to be looked for.
    pub tolerance: f64,
}

/// A trajectory and the feedback along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// States, one more than steps.
    pub states: Vec<Vec<f64>>,
    /// Controls of each step.
    pub controls: Vec<Vec<f64>>,
    /// Feedback of each step, controls by states: `u = controls + gain (x - state)`.
    pub gains: Vec<DMatrix<f64>>,
    /// What it costs.
    pub cost: f64,
}

impl Plan {
    /// Writes the controls of a step for the state that was reached, within bounds.
    pub fn act(&self, step: usize, x: &[f64], bounds: &[[f64; 2]], controls: &mut [f64]) {
        let step = step.min(self.controls.len().saturating_sub(1));
        for (k, control) in controls.iter_mut().enumerate() {
            let away = x.iter().zip(&self.states[step]).enumerate();
            let fed: f64 = away.map(|(i, (x, planned))| self.gains[step][(k, i)] * (x - planned)).sum();
            *control = (self.controls[step][k] + fed).clamp(bounds[k][0], bounds[k][1]);
        }
    }
}

/// What the way back through a trajectory found: changes of the controls, and gains.
struct Improvement {
    changes: Vec<DVector<f64>>,
    gains: Vec<DMatrix<f64>>,
}

impl Ilqr {
    /// Improves a trajectory that begins in `start` with these controls.
    ///
    /// # Errors
    /// Shapes that do not fit; a system that cannot follow the controls that are given.
    pub fn solve(
        &self,
        system: &mut impl Dynamics,
        start: &[f64],
        controls: Vec<Vec<f64>>,
    ) -> Result<Plan, NoSolution> {
        self.check(system, start, &controls)?;
        let (n, m) = (system.states(), system.controls());
        let gains = vec![DMatrix::zeros(m, n); controls.len()];
        let blank = Plan { states: Vec::new(), controls, gains, cost: f64::INFINITY };
        let mut plan = self.follow(system, start, &blank, None)?;
        let mut damping = START;
        for _ in 0..self.iterations {
            let slopes = plan.states.iter().zip(&plan.controls).map(|(x, u)| system.slopes(x, u));
            let slopes = slopes.collect::<Result<Vec<_>, _>>()?;
            let Some((better, used)) = self.improve(system, &plan, &slopes, damping) else { break };
            let gained = plan.cost - better.cost;
            damping = (used / FACTOR).max(LEAST);
            plan = better;
            if gained <= self.tolerance * plan.cost {
                break;
            }
        }
        Ok(plan)
    }

    /// The first better trajectory, as the damping grows; `None` where there is none.
    fn improve(
        &self,
        system: &mut impl Dynamics,
        plan: &Plan,
        slopes: &[[DMatrix<f64>; 2]],
        mut damping: f64,
    ) -> Option<(Plan, f64)> {
        while damping < MOST {
            if let Some(improvement) = self.backward(plan, slopes, damping) {
                for share in SHARES {
                    let tried = self.follow(system, &plan.states[0], plan, Some((&improvement, share)));
                    if let Ok(tried) = tried.as_ref()
                        && tried.cost < plan.cost
                    {
                        return Some((tried.clone(), damping));
                    }
                }
            }
            damping *= FACTOR;
        }
        None
    }

    /// Where the system goes from `start` along a plan, with a share of an improvement.
    fn follow(
        &self,
        system: &mut impl Dynamics,
        start: &[f64],
        plan: &Plan,
        improvement: Option<(&Improvement, f64)>,
    ) -> Result<Plan, NoSolution> {
        let (mut states, mut controls, mut cost) = (vec![start.to_vec()], Vec::new(), 0.0);
        let mut next = vec![0.0; start.len()];
        for (t, planned) in plan.controls.iter().enumerate() {
            let x = &states[t];
            let mut u = planned.clone();
            if let Some((improvement, share)) = improvement {
                let away =
                    DVector::from_iterator(x.len(), x.iter().zip(&plan.states[t]).map(|(x, old)| x - old));
                let fed = &improvement.gains[t] * away + &improvement.changes[t] * share;
                u.iter_mut().zip(fed.iter()).for_each(|(u, more)| *u += more);
            }
            u.iter_mut().zip(&self.bounds).for_each(|(u, [low, high])| *u = u.clamp(*low, *high));
            cost += self.cost.of_state(&self.cost.running, x) + self.cost.of_controls(&u);
            system.step(x, &u, &mut next)?;
            states.push(next.clone());
            controls.push(u);
        }
        cost += self.cost.of_state(&self.cost.last, &next);
        let gains =
            improvement.map_or_else(|| plan.gains.clone(), |(improvement, _)| improvement.gains.clone());
        if cost.is_finite() {
            Ok(Plan { states, controls, gains, cost })
        } else {
            Err(NoSolution::new("iLQR", "the trajectory leaves all bounds"))
        }
    }

    /// Changes and gains of every step, from the last to the first; `None` where the cost is not convex in the controls.
    fn backward(&self, plan: &Plan, slopes: &[[DMatrix<f64>; 2]], damping: f64) -> Option<Improvement> {
        let steps = plan.controls.len();
        let mut slope = self.cost.slope(&self.cost.last, &plan.states[steps]);
        let mut curvature = DMatrix::from_diagonal(&DVector::from_column_slice(&self.cost.last));
        let running = DMatrix::from_diagonal(&DVector::from_column_slice(&self.cost.running));
        let effort = DMatrix::from_diagonal(&DVector::from_column_slice(&self.cost.effort));
        let (mut changes, mut gains) = (Vec::with_capacity(steps), Vec::with_capacity(steps));
        for t in (0..steps).rev() {
            let ([a, b], u) = (&slopes[t], DVector::from_column_slice(&plan.controls[t]));
            let by_state = self.cost.slope(&self.cost.running, &plan.states[t]) + a.transpose() * &slope;
            let by_control = &effort * &u + b.transpose() * &slope;
            let twice_state = &running + a.transpose() * &curvature * a;
            let both = b.transpose() * &curvature * a;
            let twice_control = &effort + b.transpose() * &curvature * b;
            let damped = &twice_control + DMatrix::identity(u.len(), u.len()) * damping;
            let bounds: Vec<_> = self.bounds.iter().zip(u.iter()).map(|([l, h], u)| [l - u, h - u]).collect();
            let (change, free) = minimise(&damped, &by_control, &bounds)?;
            let gain = -free * &both;
            slope = by_state
                + gain.transpose() * (&twice_control * &change + &by_control)
                + both.transpose() * &change;
            curvature = twice_state
                + gain.transpose() * &twice_control * &gain
                + gain.transpose() * &both
                + both.transpose() * &gain;
            curvature = (&curvature + curvature.transpose()) * 0.5;
            changes.push(change);
            gains.push(gain);
        }
        changes.reverse();
        gains.reverse();
        Some(Improvement { changes, gains })
    }

    fn check(&self, system: &impl Dynamics, start: &[f64], controls: &[Vec<f64>]) -> Result<(), NoSolution> {
        let (n, m) = (system.states(), system.controls());
        let of_states = [&self.cost.goal, &self.cost.running, &self.cost.last].map(Vec::len);
        let fits = of_states == [n; 3]
            && start.len() == n
            && self.cost.effort.len() == m
            && self.bounds.len() == m
            && !controls.is_empty()
            && controls.iter().all(|u| u.len() == m);
        let message =
            || format!("the system has {n} states and {m} controls, and a plan has a step at least");
        let ordered = self.bounds.iter().all(|[low, high]| low <= high);
        match (fits, ordered) {
            (true, true) => Ok(()),
            (false, _) => Err(NoSolution::new("iLQR", message())),
            (true, false) => Err(NoSolution::new("iLQR", "the lower bound of a control stands first")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::maths::discrete;

    struct Linear;

    impl Dynamics for Linear {
        fn states(&self) -> usize {
            2
        }

        fn controls(&self) -> usize {
            1
        }

        fn step(&mut self, x: &[f64], u: &[f64], next: &mut [f64]) -> Result<(), NoSolution> {
            next.copy_from_slice(&[x[0] + 0.1 * x[1] + 0.005 * u[0], x[1] + 0.1 * u[0]]);
            Ok(())
        }
    }

    fn ilqr(bound: f64) -> Ilqr {
        let cost =
            Quadratic { goal: vec![0.0; 2], running: vec![1.0; 2], last: vec![1.0; 2], effort: vec![1.0] };
        Ilqr { cost, bounds: vec![[-bound, bound]], iterations: 50, tolerance: 1e-12 }
    }

    /// Far from the end, the gain of a linear system is that of the regulator, and the cost what the regulator says.
    #[test]
    fn of_a_linear_system_it_is_the_regulator() {
        let plan = ilqr(1e6).solve(&mut Linear, &[1.0, 0.0], vec![vec![0.0]; 400]).unwrap();
        let (a, b) = (dmatrix![1.0, 0.1; 0.0, 1.0], dmatrix![0.005; 0.1]);
        let regulator = discrete(&a, &b, &DMatrix::identity(2, 2), &dmatrix![1.0]).unwrap();
        assert!((&plan.gains[0] + &regulator.gain).norm() < 1e-4, "{} {}", plan.gains[0], regulator.gain);
        assert!((2.0 * plan.cost - regulator.to_pay(&[1.0, 0.0])).abs() < 1e-4);
    }

    /// Bounds are kept and used, and a bounded plan costs more.
    #[test]
    fn bounds_are_kept() {
        let free = ilqr(1e6).solve(&mut Linear, &[1.0, 0.0], vec![vec![0.0]; 200]).unwrap();
        let bounded = ilqr(0.2).solve(&mut Linear, &[1.0, 0.0], vec![vec![0.0]; 200]).unwrap();
        assert!(bounded.controls.iter().all(|u| u[0].abs() <= 0.2));
        assert!(bounded.controls.iter().filter(|u| u[0].abs() > 0.199).count() > 5);
        assert!(bounded.cost > free.cost && bounded.states[200][0].abs() < 0.02, "{:?}", bounded.states[200]);
    }

    #[test]
    fn shapes_that_do_not_fit_are_refused() {
        let error = ilqr(1.0).solve(&mut Linear, &[1.0], vec![vec![0.0]; 3]).unwrap_err().to_string();
        assert_eq!(error, "iLQR: the system has 2 states and 1 controls, and a plan has a step at least");
    }
}
