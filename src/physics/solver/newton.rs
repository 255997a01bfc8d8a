//! Newton's method on the primal cost, with exact line search and rank-one updates of the Hessian's factor
//! (MuJoCo documentation, Computation, "Algorithms", "Newton").

use super::primal::Primal;
use crate::model::Model;
use crate::stages::SolverStat;

/// Minimises the cost; returns the number of iterations and the entries of the factors used.
///
/// Nothing is done when the start is already good: the cost is within tolerance of its minimum (by the duality gap,
/// `½ gᵀ M⁻¹ g`, or the Newton decrement, `½ gᵀ H⁻¹ g`) and the gradient is below tolerance.
pub(super) fn newton(m: &Model, p: &mut Primal, stats: &mut Vec<SolverStat>) -> (i32, usize) {
    let tolerance = m.opt.tolerance;
    let flat = p.gradient() < tolerance;
    if flat {
        p.precondition_inertia();
        if p.decrement() < tolerance {
            return (0, p.problem.jacobian.len());
        }
    }
    p.hessian.begin(&p.problem);
    p.hessian.factorize(&p.problem, &p.state, &p.jar);
    p.precondition_hessian();
    if flat && p.decrement() < tolerance {
        return (0, p.hessian.nonzeros(&p.problem));
    }
    let mut iterations = 0;
    while iterations < m.opt.iterations {
        p.descend();
        let Some(improvement) = p.step(m, None) else { break };
        p.hessian.follow(&p.problem, &p.old_state, &p.state, &p.jar);
        iterations += 1;
        let gradient = p.gradient();
        stats.push(p.statistics(improvement, gradient, p.hessian.updates));
        let small = improvement > 0.0 && improvement < tolerance;
        if small || gradient < tolerance {
            break;
        }
        p.precondition_hessian();
        if p.decrement() < tolerance {
            break;
        }
    }
    (iterations, p.hessian.nonzeros(&p.problem))
}
