//! `check`: a model beside what MuJoCo recorded of it, or as a world of rapier.

use crate::failure::Failure;
use crate::input::loading::load;
use crate::input::solver::SolverArgument;
use crate::input::source::ModelSource;
use crate::models::world;
use crate::terminal::{show, show_verdict};
use crate::version::MUJOCO;
use clap::{Args, ValueHint};
use physics::Model;
use std::path::PathBuf;
use validation::compile::{compare_compiled, compare_state_sizes};
use validation::motion::{compare_forward, compare_rollout, compare_steps};
use validation::reference::{Reference, ReferenceError};
use validation::tolerance::{QACC, STEP};

/// Compare a model with what MuJoCo recorded of it, or say whether rapier can simulate it
#[derive(Args)]
#[command(
    after_help = "Compared are the compiled arrays, the accelerations (qacc) of recorded states, single steps, \
and a rollout of all steps. A rollout follows MuJoCo when it stays within ten times the distance between MuJoCo's run \
and its twin, the same run from a state 1e-12 away: rounding differs in every step and grows as the motion amplifies it.
The last line says whether the model passed; the exit code is 1 when it did not. The reference is written by \
validation/reference/record.py.

With --solver rapier there is no reference: the report says whether the model becomes a world of rapier, with its degrees of \
freedom, masses, axes of joints and inertia, or names every element that rapier does not support; the exit code is then 1.

Examples:
  robohive check assets/quadruped/quadruped.xml validation/reference/own/quadruped.npz
  cargo run -p robohive-cli --features rapier -- check assets/pile/pile.xml --solver rapier"
)]
pub struct Check {
    /// The model
    #[command(flatten)]
    pub model: ModelSource,
    /// Recorded reference
    #[arg(value_hint = ValueHint::FilePath, required_unless_present = "solver")]
    pub reference: Option<PathBuf>,
    /// What is asked about the model
    #[command(flatten)]
    pub solver: SolverArgument,
}

/// What the words of the report mean, for the line that closes it.
const TERMS: &str = "(qacc: accelerations of the joints; twin: MuJoCo's own run from a state 1e-12 away)";

/// Most arrays that are listed.
const MAX_LISTED: usize = 10;

/// Steps of the rollout whose differences are listed.
const LISTED_STEPS: [usize; 6] = [0, 9, 49, 99, 199, 499];

/// Runs the command: exit code 1 when a comparison disagrees, or rapier cannot simulate the model.
pub fn run(a: &Check) -> Result<(), Failure> {
    // A build without it says so first.
    a.solver.engine()?;
    let reference = match (&a.reference, a.solver.is_own()) {
        (Some(path), true) => path,
        (None, false) => return world::report(&load(&a.model.path, &a.model.reading)?),
        (None, true) => return Err(Failure::usage("--solver own is compared with MuJoCo: give a reference")),
        (Some(_), false) => {
            return Err(Failure::usage(
                "rapier does not follow MuJoCo: remove the reference, or --solver rapier",
            ));
        }
    };
    let m = load(&a.model.path, &a.model.reading)?;
    let reference = Reference::open(reference).map_err(Failure::usage)?;
    let mut report = Report::default();
    show!("{} beside MuJoCo {MUJOCO}", m.name);
    report.compare(&m, &reference).map_err(Failure::usage)?;
    report.close(&m.name)
}

/// Comparisons that disagreed, in the order in which they were made.
#[derive(Default)]
struct Report {
    different: Vec<&'static str>,
}

impl Report {
    fn line(&mut self, what: &'static str, agrees: bool, text: &str) {
        if !agrees {
            self.different.push(what);
        }
        show_verdict(
            agrees,
            &format!("{what:<10} "),
            if agrees { "agrees " } else { "DIFFERS" },
            &format!("   {text}"),
        );
    }

    fn compare(&mut self, m: &Model, reference: &Reference) -> Result<(), ReferenceError> {
        let sizes = compare_state_sizes(m, reference)?;
        if !sizes.is_empty() {
            let texts: Vec<_> =
                sizes.iter().map(|(name, ours, theirs)| format!("{name} {ours} (MuJoCo {theirs})")).collect();
            self.line("sizes", false, &format!("{}; nothing else can be compared", texts.join(", ")));
            return Ok(());
        }
        self.compiled(m, reference)?;
        self.forward(m, reference)?;
        self.steps(m, reference)?;
        self.rollout(m, reference)
    }

    fn compiled(&mut self, m: &Model, reference: &Reference) -> Result<(), ReferenceError> {
        let compiled = compare_compiled(m, reference)?;
        let outside = compiled.differences.len();
        let text = match outside {
            0 => format!("{} arrays", compiled.fields),
            n => format!("{n} of {} arrays, the worst first", compiled.fields),
        };
        self.line("compile", compiled.agrees(), &text);
        for worst in compiled.differences.iter().take(MAX_LISTED) {
            show!("{:>21}{worst}, {:.1} x tolerance", "", worst.error);
        }
        if outside > MAX_LISTED {
            show!("{:>21}and {} more", "", outside - MAX_LISTED);
        }
        Ok(())
    }

    fn forward(&mut self, m: &Model, reference: &Reference) -> Result<(), ReferenceError> {
        let forward = compare_forward(m, reference)?;
        let text = format!(
            "qacc of {} of {} states within {QACC:e} of the largest component; contact counts equal in {}",
            forward.agreeing, forward.states, forward.equal_contacts
        );
        self.line("forward", forward.agreeing == forward.states && forward.failure.is_none(), &text);
        if let Some((row, worst)) = forward.worst.as_ref().filter(|(_, worst)| worst.error > 0.0) {
            show!("{:>21}worst: state {row}, {worst}, error {:.1e}", "", worst.error);
        }
        if let Some(failure) = &forward.failure {
            show!("{:>21}{failure}", "");
        }
        Ok(())
    }

    fn steps(&mut self, m: &Model, reference: &Reference) -> Result<(), ReferenceError> {
        let single = compare_steps(m, reference)?;
        let text = format!(
            "{} of {} single steps from MuJoCo's states within {STEP:e}; largest difference {:.1e}",
            single.agreeing, single.steps, single.worst.0
        );
        self.line("step", single.agreeing == single.steps, &text);
        Ok(())
    }

    fn rollout(&mut self, m: &Model, reference: &Reference) -> Result<(), ReferenceError> {
        let rollout = compare_rollout(m, reference)?;
        let text = format!(
            "{} steps, largest difference {:.1e}; MuJoCo from its own twin {:.1e}",
            rollout.steps, rollout.divergence, rollout.twin
        );
        self.line("rollout", rollout.follows(), &text);
        for step in LISTED_STEPS {
            if let Some(difference) = rollout.by_step.get(step) {
                show!("{:>21}after step {:>3}: {difference:.1e}", "", step + 1);
            }
        }
        if let Some((step, failure)) = &rollout.failure {
            show!("{:>21}step {step}: {failure}", "");
        }
        if let Some(step) = rollout.first_outside {
            show!("{:>21}outside the bound from step {step}", "");
        }
        Ok(())
    }

    /// One line in plain words.
    fn close(self, name: &str) -> Result<(), Failure> {
        match &self.different[..] {
            [] => {
                let text =
                    format!(": {name} compiles to MuJoCo's arrays and moves as MuJoCo recorded it {TERMS}");
                show_verdict(true, "", "passed", &text);
                return Ok(());
            }
            ["sizes"] => {
                let text =
                    format!(": the reference was recorded of another model than {name} (sizes: {SIZES})");
                show_verdict(false, "", "failed", &text);
            }
            parts => {
                let text = format!(": {name} is not as MuJoCo recorded it in: {} {TERMS}", parts.join(", "));
                show_verdict(false, "", "failed", &text);
            }
        }
        Err(Failure::silent(1))
    }
}

/// What the sizes of a state are.
const SIZES: &str = "nq positions, nv velocities, na activations, nu controls";
