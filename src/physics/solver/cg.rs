//! Nonlinear conjugate gradients on the primal cost, preconditioned with the inertia (Hager and Zhang 2005).

use super::primal::Primal;
use crate::flex::Effective;
use crate::math::dense::{dot_slice, norm_slice};
use crate::model::Model;
use crate::model::bounds::MINVAL;
use crate::stages::SolverStat;

/// Hager and Zhang's bound on how far a direction may turn back.
const ETA: f64 = 0.01;

/// Minimises the cost; returns the number of iterations and the Jacobian's entries.
pub(super) fn conjugate_gradient(
    m: &Model,
    effective: Option<Effective>,
    p: &mut Primal,
    stats: &mut Vec<SolverStat>,
) -> (i32, usize) {
    let (tolerance, nonzeros) = (m.opt.tolerance, p.problem.jacobian.len());
    let precondition = |p: &mut Primal| match effective {
        Some(effective) => effective.precondition(&p.grad, &mut p.mgrad),
        None => p.precondition_inertia(),
    };
    precondition(p);
    if p.decrement() < tolerance {
        return (0, nonzeros);
    }
    p.descend();
    let mut iterations = 0;
    while iterations < m.opt.iterations {
        p.grad_old.clone_from(&p.grad);
        p.mgrad_old.clone_from(&p.mgrad);
        let Some(improvement) = p.step(m, effective) else { break };
        precondition(p);
        iterations += 1;
        let gradient = p.gradient();
        stats.push(p.statistics(improvement, gradient, 0));
        if improvement > 0.0 && improvement < tolerance || gradient < tolerance {
            break;
        }
        let beta = direction_weight(p);
        for (s, g) in p.search.iter_mut().zip(&p.mgrad) {
            *s = -g + beta * *s;
        }
    }
    (iterations, nonzeros)
}

/// Weight of the previous direction; leaves the gradient's changes in the memory of the old gradients.
fn direction_weight(p: &mut Primal) -> f64 {
    for (old, new) in [(&mut p.grad_old, &p.grad), (&mut p.mgrad_old, &p.mgrad)] {
        old.iter_mut().zip(new).for_each(|(old, new)| *old = new - *old);
    }
    let (change, mchange) = (&p.grad_old, &p.mgrad_old);
    let curvature = dot_slice(&p.search, change);
    if curvature < MINVAL {
        return 0.0;
    }
    let ahead = dot_slice(change, &p.mgrad);
    let weight =
        (ahead - 2.0 * (dot_slice(change, mchange) / curvature) * dot_slice(&p.search, &p.grad)) / curvature;
    let least = -1.0 / (norm_slice(&p.search) * norm_slice(&p.grad).min(ETA)).max(MINVAL);
    weight.max(least)
}
