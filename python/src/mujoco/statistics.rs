//! What a simulation counts beside its numbers, as pickles keep it: iterations of the solver, warnings, durations of calls.

use super::timed::Timers;
use super::warned::Warned;
use physics::Data as Simulation;
use physics::data::{SolverStat, SolverStatistics};
use pyo3::prelude::*;

/// Every column of the solver's statistics: counts of each island, then a number for each iteration.
pub fn columns(statistics: &SolverStatistics) -> [(&'static str, Vec<f64>); 9] {
    let of = |value: fn(&SolverStat) -> f64| statistics.solver.iter().map(value).collect();
    let counts = |values: &[i32]| values.iter().map(|&x| f64::from(x)).collect();
    [
        ("solver_niter", counts(&statistics.solver_niter)),
        ("solver_nnz", counts(&statistics.solver_nnz)),
        ("improvement", of(|s| s.improvement)),
        ("gradient", of(|s| s.gradient)),
        ("lineslope", of(|s| s.lineslope)),
        ("nactive", of(|s| f64::from(s.nactive))),
        ("nchange", of(|s| f64::from(s.nchange))),
        ("neval", of(|s| f64::from(s.neval))),
        ("nupdate", of(|s| f64::from(s.nupdate))),
    ]
}

/// Calls `put(name, values)` for everything that is counted.
///
/// # Errors
/// Those of `put`.
pub fn dump(
    simulation: &Simulation,
    timers: &Timers,
    mut put: impl FnMut(&str, Vec<f64>) -> PyResult<()>,
) -> PyResult<()> {
    for (name, values) in columns(&simulation.solver) {
        put(name, values)?;
    }
    let mut warned = Warned::default();
    warned.show(&simulation.warnings);
    for (which, name) in Warned::NAMES.into_iter().enumerate() {
        put(name, warned.array(which).iter().map(|&x| f64::from(x)).collect())?;
    }
    put("timer.duration", timers.duration.to_vec())?;
    put("timer.number", timers.number.iter().map(|&x| f64::from(x)).collect())
}

/// Takes over what [`dump`] put under a name; false where it puts nothing under it.
pub fn restore(simulation: &mut Simulation, timers: &mut Timers, name: &str, values: &[f64]) -> bool {
    let whole = || values.iter().map(|&x| x as i32).collect::<Vec<_>>();
    let statistics = &mut simulation.solver;
    if let Some(which) = Warned::NAMES.iter().position(|&known| known == name) {
        let mut warned = Warned::default();
        warned.show(&simulation.warnings);
        warned.array_mut(which).iter_mut().zip(whole()).for_each(|(to, from)| *to = from);
        simulation.warnings = warned.counts();
        return true;
    }
    match name {
        "solver_niter" => statistics.solver_niter = whole(),
        "solver_nnz" => statistics.solver_nnz = whole(),
        "improvement" => each(statistics, values, |s, x| s.improvement = x),
        "gradient" => each(statistics, values, |s, x| s.gradient = x),
        "lineslope" => each(statistics, values, |s, x| s.lineslope = x),
        "nactive" => each(statistics, values, |s, x| s.nactive = x as i32),
        "nchange" => each(statistics, values, |s, x| s.nchange = x as i32),
        "neval" => each(statistics, values, |s, x| s.neval = x as i32),
        "nupdate" => each(statistics, values, |s, x| s.nupdate = x as i32),
        "timer.duration" => timers.duration.iter_mut().zip(values).for_each(|(to, &from)| *to = from),
        "timer.number" => timers.number.iter_mut().zip(whole()).for_each(|(to, from)| *to = from),
        _ => return false,
    }
    true
}

/// Sets a number of every iteration.
fn each(statistics: &mut SolverStatistics, values: &[f64], set: fn(&mut SolverStat, f64)) {
    statistics.solver.resize(values.len(), SolverStat::default());
    statistics.solver.iter_mut().zip(values).for_each(|(s, &x)| set(s, x));
}
