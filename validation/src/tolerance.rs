//! How far a number may be from what it should be, in one place, each with the reason for its size.
//!
//! Bars say what the tables of `results` and the command call alike, on every model. Tolerances are what the tests ask of
//! the models of this repository: 10 to 100 times the largest difference that is measured, which `cargo xtask tolerances`
//! prints and checks. Results have the same bits everywhere, so the margin is for changes of the order of operations.

use physics::Model;
use std::fmt;

/// A bound on a difference.
#[derive(Debug)]
pub struct Tolerance {
    /// Name in the table of measurements.
    pub name: &'static str,
    /// The largest difference that passes.
    pub bound: f64,
}

impl Tolerance {
    const fn new(name: &'static str, bound: f64) -> Self {
        Tolerance { name, bound }
    }

    /// True for differences within the bound; never for one that is not a number.
    pub fn allows(&self, difference: f64) -> bool {
        difference <= self.bound
    }

    /// A gauge that has measured nothing.
    pub const fn gauge(&'static self) -> Gauge {
        Gauge { tolerance: self, worst: None }
    }
}

/// True for models whose contacts resist slip more than penetration (`impratio` above 1), as most hands and legs ask for.
/// Their Hessians are that much worse conditioned, and so is rounding that goes through them.
pub fn friction_is_stiff(m: &Model) -> bool {
    m.opt.impratio > 1.0
}

/// The largest difference that a test has measured under one tolerance; printed when the test is done.
#[derive(Debug)]
pub struct Gauge {
    tolerance: &'static Tolerance,
    worst: Option<f64>,
}

impl Gauge {
    /// Takes a measured difference.
    ///
    /// # Panics
    /// The tolerance does not allow it; the message begins with `what`.
    #[track_caller]
    pub fn take(&mut self, difference: f64, what: impl fmt::Display) {
        let Tolerance { name, bound } = self.tolerance;
        assert!(self.tolerance.allows(difference), "{what}: {difference:e} is beyond {name}, {bound:e}");
        self.worst = Some(self.worst.map_or(difference, |worst| worst.max(difference)));
    }
}

impl Drop for Gauge {
    fn drop(&mut self) {
        if let Some(worst) = self.worst {
            println!("measured {} {worst:e} of {:e}", self.tolerance.name, self.tolerance.bound);
        }
    }
}

/// Bar of compiled arrays, in which integers are equal. Floats: libraries round transcendental functions differently, and
/// inertias sum thousands of mesh triangles in the order of our own code; both stay near 1e-13.
pub const COMPILE_RELATIVE: f64 = 1e-9;
/// Components that are zero up to rounding are compared absolutely; model quantities are of order one in SI units.
pub const COMPILE_ABSOLUTE: f64 = 1e-12;
/// Bar of one stage with upstream injected: a few hundred roundings of 1e-16 and one division by a pivot.
pub const STAGE_BAR: f64 = 1e-10;
/// Share of a field's largest component, or of the component's own scale, below which it counts as noise of cancellation.
pub const NOISE_FLOOR: f64 = 1e-3;
/// Bar of a whole forward pass: the solver stops at a relative improvement of 1e-8, so equal decisions leave rounding
/// amplified by the condition number of the Hessian.
pub const QACC: f64 = 1e-8;
/// Bar of one step from a re-synchronised state: position changes are `qacc` times the square of the time step.
pub const STEP: f64 = 1e-9;
/// A rollout follows MuJoCo when it stays within this factor of MuJoCo's divergence from its own twin, started
/// 1e-12 away: our roundings differ in every step, the twin's only in the first.
pub const TWIN_FACTOR: f64 = 10.0;
/// Or within this many metres or radians: 500 steps of rounding noise on a model that does not amplify it.
pub const ROLLOUT_ABSOLUTE: f64 = 1e-9;
/// Bar of contacts, distances and rays, geometry injected: metres and unit vectors, tens of operations in another order.
/// The largest difference in three million placements is 3e-11.
pub const CONTACT_BAR: f64 = 1e-9;
/// Contact parameters are sums of two products.
pub const CONTACT_PARAMETER: f64 = 1e-12;
/// Bar of the excess of our solver's cost over MuJoCo's, relative: sums of a few hundred terms of one sign.
pub const COST_BAR: f64 = 1e-10;
/// Share of problems in which the solver's iteration counts agree within one: rounding may decide the last.
pub const ITERATIONS_SHARE: f64 = 0.95;
/// Share of problems in which every iteration has MuJoCo's statistics: rounding decides states near a cone's surface.
pub const STATISTICS_SHARE: f64 = 0.95;
/// Improvement, gradient and slope of one iteration: of the size of the solver's tolerance, 1e-8, near the end, where they
/// are what cancellation left.
pub const STATISTIC_RELATIVE: f64 = 1e-6;
/// What counts as zero among them.
pub const STATISTIC_ABSOLUTE: f64 = 1e-11;

/// Compiled arrays, in units of the bar: last bits of sines and of sums over triangles.
pub static COMPILE: Tolerance = Tolerance::new("COMPILE", 1e-4);
/// One stage with upstream injected: sums in another order, divided by a pivot.
pub static STAGE: Tolerance = Tolerance::new("STAGE", 2e-13);
/// The same on models of other repositories, whose chains are longer.
pub static STAGE_ELSEWHERE: Tolerance = Tolerance::new("STAGE_ELSEWHERE", 1e-11);
/// Contacts, distances and rays of random placements: one rounding of a coordinate of order one.
pub static CONTACT: Tolerance = Tolerance::new("CONTACT", 2e-14);
/// Acceleration of a whole pass: rounding of the stages, through the Hessian.
pub static OWN_QACC: Tolerance = Tolerance::new("OWN_QACC", 5e-14);
/// Positions after one step from a recorded state: last bits of positions of order one.
pub static OWN_STEP: Tolerance = Tolerance::new("OWN_STEP", 2e-14);
/// The same where friction is stiff: the same last bits, through a Hessian whose condition number grows with `impratio`,
/// which is 10 on these models.
pub static OWN_STEP_STIFF: Tolerance = Tolerance::new("OWN_STEP_STIFF", 1e-13);
/// Rollouts of integrators that are implicit in velocity, for as long as the twin stays within [`ROLLOUT_ABSOLUTE`].
pub static IMPLICIT_ROLLOUT: Tolerance = Tolerance::new("IMPLICIT_ROLLOUT", 1e-11);
/// The solver from recorded rows on models of other repositories: its sums are in MuJoCo's order, so that last bits of the
/// rows alone may differ, and go through the Hessian. On own models it is equal.
pub static SOLUTION_ELSEWHERE: Tolerance = Tolerance::new("SOLUTION_ELSEWHERE", 2e-13);
/// Dense and sparse rows, which stop in the same iteration: sums in another order.
pub static STORAGE: Tolerance = Tolerance::new("STORAGE", 2e-13);
/// The same on models of other repositories, which have more rows.
pub static STORAGE_ELSEWHERE: Tolerance = Tolerance::new("STORAGE_ELSEWHERE", 5e-12);
/// Residual of the equation of motion on models whose solvers converge: rounding of the gradient.
pub static STATIONARY: Tolerance = Tolerance::new("STATIONARY", 5e-12);
/// The same where friction is stiff and the solver goes on to its last improvement, with a tolerance of 0: with that of 1e-8
/// it stops one iteration before it has converged.
pub static STATIONARY_STIFF: Tolerance = Tolerance::new("STATIONARY_STIFF", 2e-11);
/// The same on own models that allow the solver fewer iterations than MuJoCo's 100, and may stop short of the solution: the
/// tolerance of 1e-8 at which solvers stop by default.
pub static STATIONARY_LIMITED: Tolerance = Tolerance::new("STATIONARY_LIMITED", 1e-8);
/// The same where a solver stops at its tolerance of 1e-8 in cost, or after its last iteration.
pub static STATIONARY_ELSEWHERE: Tolerance = Tolerance::new("STATIONARY_ELSEWHERE", 1e-5);
/// Solutions of recorded problems with every solver: sums in MuJoCo's order make the same iterates, which stop in the same
/// iteration. What may differ is a few roundings of the largest acceleration, 1e-16 each; the cost of the solution is not
/// above MuJoCo's at all.
pub static PROBLEM: Tolerance = Tolerance::new("PROBLEM", 1e-14);
/// Derivatives of smooth forces, relative to the largest entry: products along the chain of bodies.
pub static DERIVATIVE: Tolerance = Tolerance::new("DERIVATIVE", 1e-12);
/// Forces of inverse dynamics, relative to the largest: one rounding.
pub static INVERSE: Tolerance = Tolerance::new("INVERSE", 1e-14);
/// Linearised steps by finite differences: rounding of 1e-16 over a nudge of 1e-6, amplified by the contacts of one
/// step.
pub static LINEARISED: Tolerance = Tolerance::new("LINEARISED", 2e-6);
/// Slopes of inverse dynamics, by differences too, but of forces that no solver amplifies.
pub static INVERSE_SLOPE: Tolerance = Tolerance::new("INVERSE_SLOPE", 5e-7);
/// Forces of inverse dynamics after forward dynamics, relative to the largest: what the solver's last step leaves.
pub static FORWARD_INVERSE: Tolerance = Tolerance::new("FORWARD_INVERSE", 3e-13);
/// Momentum of one body in free flight, relative: rounding of a thousand steps.
pub static SPIN: Tolerance = Tolerance::new("SPIN", 1e-13);
/// Momentum of a tumbling chain, which RK4 keeps to the fourth power of a step of 10 µs: rounding of its inertias.
pub static MOMENTUM: Tolerance = Tolerance::new("MOMENTUM", 5e-12);
/// Energy kept by RK4 on hinges and slides, relative to the kinetic energy gained: the fourth power of a step of 1
/// ms.
pub static ENERGY: Tolerance = Tolerance::new("ENERGY", 5e-9);
/// The same with rotations in space, where RK4 is of second order.
pub static ENERGY_IN_SPACE: Tolerance = Tolerance::new("ENERGY_IN_SPACE", 5e-7);
/// Applied force from inverse dynamics after a converged solver, relative to the largest force.
pub static CONVERGED_INVERSE: Tolerance = Tolerance::new("CONVERGED_INVERSE", 3e-12);
/// The same where friction is stiff.
pub static CONVERGED_INVERSE_STIFF: Tolerance = Tolerance::new("CONVERGED_INVERSE_STIFF", 1e-11);
/// Acceleration from dense and from sparse rows, relative.
pub static CONVERGED_STORAGE: Tolerance = Tolerance::new("CONVERGED_STORAGE", 5e-13);
/// Acceleration with and without islands, both from a converged solver, relative.
pub static ISLANDS: Tolerance = Tolerance::new("ISLANDS", 5e-13);
/// Force outside its set (friction cone, sign, dry friction), relative to the largest force: rounding of its
/// projection.
pub static OUTSIDE: Tolerance = Tolerance::new("OUTSIDE", 1e-14);
/// Analytic slope beside central differences, relative to the largest entry or smooth force: rounding over the nudge.
pub static SLOPE: Tolerance = Tolerance::new("SLOPE", 2e-8);
/// Sum of the forces on two bodies, relative to one of them: rounding of lever arms.
pub static BALANCE: Tolerance = Tolerance::new("BALANCE", 2e-14);
