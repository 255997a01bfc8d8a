//! `check`: a model beside what MuJoCo recorded of it.

use crate::arguments::Check;
use crate::{Failure, load};
use validation::compile::compare_compiled;
use validation::motion::{compare_forward, compare_rollout, compare_steps};
use validation::reference::Reference;
use validation::tolerance::{QACC, STEP};

/// Runs the command: exit code 1 when a comparison disagrees.
pub fn run(a: &Check) -> Result<(), Failure> {
    let m = load(&a.model.path, &a.model.reading)?;
    let reference = Reference::open(&a.reference).map_err(Failure::usage)?;
    let mut agrees = true;
    let mut line = |what: &str, good: bool, text: String| {
        agrees &= good;
        show!("{what:<10} {:<9} {text}", if good { "agrees" } else { "DIFFERS" });
    };

    show!("{} beside MuJoCo 3.12.0", m.name);
    let compiled = compare_compiled(&m, &reference).map_err(Failure::usage)?;
    line("compile", compiled.agrees(), format!("{} fields", compiled.fields));
    for worst in compiled.differences.iter().take(10) {
        show!("{:>22}{worst}, {:.1} x tolerance", "", worst.error);
    }

    let forward = compare_forward(&m, &reference).map_err(Failure::usage)?;
    let text = format!(
        "qacc of {} of {} states within {QACC:e} of the largest component; contact counts equal in {}",
        forward.agreeing, forward.states, forward.equal_contacts
    );
    line("forward", forward.agreeing == forward.states && forward.failure.is_none(), text);
    if let Some((row, worst)) = &forward.worst {
        show!("{:>22}worst: state {row}, {worst}, error {:.1e}", "", worst.error);
    }
    if let Some(failure) = &forward.failure {
        show!("{:>22}{failure}", "");
    }

    let single = compare_steps(&m, &reference).map_err(Failure::usage)?;
    let text = format!(
        "{} of {} single steps from MuJoCo's states within {STEP:e}; largest difference {:.1e}",
        single.agreeing, single.steps, single.worst.0
    );
    line("step", single.agreeing == single.steps, text);

    let rollout = compare_rollout(&m, &reference).map_err(Failure::usage)?;
    let text = format!(
        "{} steps, largest difference {:.1e}; MuJoCo from its own twin {:.1e}",
        rollout.steps, rollout.divergence, rollout.twin
    );
    line("rollout", rollout.follows(), text);
    for step in [0, 9, 49, 99, 199, 499] {
        if let Some(difference) = rollout.by_step.get(step) {
            show!("{:>22}after step {:>3}: {difference:.1e}", "", step + 1);
        }
    }
    if let Some((step, failure)) = &rollout.failure {
        show!("{:>22}step {step}: {failure}", "");
    }
    if let Some(step) = rollout.first_outside {
        show!("{:>22}outside the bound from step {step}", "");
    }
    if agrees { Ok(()) } else { Err(Failure::new("the comparison disagrees")) }
}
