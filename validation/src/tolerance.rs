//! The tolerances, in one place, each with the reason for its size.

/// Integer arrays of a compiled model are equal. Floats: libraries round transcendental functions differently, and
/// inertias sum thousands of mesh triangles in the order of our own code; both stay near 1e-13.
pub const COMPILE_RELATIVE: f64 = 1e-9;
/// Components that are zero up to rounding are compared absolutely; model quantities are of order one in SI units.
pub const COMPILE_ABSOLUTE: f64 = 1e-12;

/// One stage with upstream injected: a few hundred roundings of 1e-16 and one division by a pivot.
pub const STAGE: f64 = 1e-10;

/// Contacts, distances and rays, geometry injected: metres and unit vectors, tens of operations in another order.
pub const CONTACT: f64 = 1e-9;
/// Contact parameters are sums of two products.
pub const CONTACT_PARAMETER: f64 = 1e-12;

/// Whole forward pass: the solver stops at a relative improvement of 1e-8, so equal decisions leave rounding
/// amplified by the condition number of the Hessian.
pub const QACC: f64 = 1e-8;

/// One step from a re-synchronised state: position changes are `qacc` times the square of the time step.
pub const STEP: f64 = 1e-9;

/// A rollout follows MuJoCo when it stays within this factor of MuJoCo's divergence from its own twin, started
/// 1e-12 away: our roundings differ in every step, the twin's only in the first.
pub const TWIN_FACTOR: f64 = 10.0;
/// Or within this many metres or radians: 500 steps of rounding noise on a model that does not amplify it.
pub const ROLLOUT_ABSOLUTE: f64 = 1e-9;

/// Share of a field's largest component, or of the component's own scale, below which it counts as noise of cancellation.
pub const NOISE_FLOOR: f64 = 1e-3;

/// Excess of our solver's cost over MuJoCo's, relative: sums of a few hundred terms of one sign.
pub const COST: f64 = 1e-10;
/// Share of problems in which the solver's iteration counts agree within one: rounding may decide the last.
pub const ITERATIONS_SHARE: f64 = 0.95;

/// Improvement, gradient and slope of one iteration: of the size of the solver's tolerance, 1e-8, near the end, where they
/// are what cancellation left.
pub const STATISTIC_RELATIVE: f64 = 1e-6;
/// What counts as zero among them.
pub const STATISTIC_ABSOLUTE: f64 = 1e-11;
