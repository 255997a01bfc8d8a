//! The engine of a command: our own pipeline, or another one in builds that have it.

use crate::failure::Failure;
use clap::{Args, ValueEnum};
use physics::Engine;

/// The argument that chooses the engine.
#[derive(Clone, Copy, Default, Args)]
pub struct SolverArgument {
    /// Engine that steps the model: our own pipeline, or rapier in builds with --features rapier
    #[arg(long, value_name = "own|rapier", default_value = "own", hide_possible_values = true)]
    solver: Solver,
}

/// An engine by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Solver {
    /// Our own pipeline
    #[default]
    Own,
    /// Rapier
    Rapier,
}

impl SolverArgument {
    /// Whether our own pipeline is asked for.
    pub fn is_own(self) -> bool {
        self.solver == Solver::Own
    }

    /// Its name.
    pub fn name(self) -> String {
        self.solver.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
    }

    /// The engine of a name.
    ///
    /// # Errors
    /// There is none of this name.
    pub fn named(name: &str) -> Result<Self, Failure> {
        let solver = Solver::from_str(name, false);
        solver
            .map(|solver| SolverArgument { solver })
            .map_err(|error| Failure::usage(format!("the solver {name:?}: {error}")))
    }

    /// The engine.
    ///
    /// # Errors
    /// This build does not have it.
    pub fn engine(self) -> Result<Engine, Failure> {
        match self.solver {
            Solver::Own => Ok(Engine::default()),
            Solver::Rapier => rapier(),
        }
    }
}

#[cfg(feature = "rapier")]
fn rapier() -> Result<Engine, Failure> {
    Ok(rapier::engine(rapier::Options::default()))
}

#[cfg(not(feature = "rapier"))]
fn rapier() -> Result<Engine, Failure> {
    Err(Failure::usage(
        "this build has no rapier; install one with `cargo install --path src/cli --features rapier`",
    ))
}
