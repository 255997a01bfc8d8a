//! Whether a model becomes a world of rapier, in words.

use crate::failure::Failure;
use physics::Model;

/// Reports on a model: exit code 1 when rapier does not support all of it.
#[cfg(feature = "rapier")]
pub fn report(m: &Model) -> Result<(), Failure> {
    use crate::terminal::{show, show_verdict};
    use rapier::{Options, World, refusals};

    /// Largest difference of a world that is its model's.
    const EXACT: f64 = 1e-9;

    show!("{} under rapier", m.name);
    let world = match World::new(m, Options::default()) {
        Ok(world) => world,
        Err(first) => {
            let all = refusals(m);
            let all = if all.is_empty() { vec![first] } else { all };
            for refusal in &all {
                show_verdict(false, "", "refused", &format!("   {refusal}"));
            }
            let elements = if all.len() == 1 { "element" } else { "elements" };
            let text = format!(": {} {elements} of {} cannot be simulated under rapier", all.len(), m.name);
            show_verdict(false, "", "failed", &text);
            return Err(Failure::silent(1));
        }
    };
    let found = world.measure(m);
    let off = found.differences(m);
    let same = (found.nq, found.nv) == (m.nq, m.nv);
    let line = |what: &str, agrees: bool, text: &str| {
        let verdict = if agrees { "agrees " } else { "DIFFERS" };
        show_verdict(agrees, &format!("{what:<10} "), verdict, &format!("   {text}"));
    };
    let sizes = format!("{} positions of {}, {} degrees of freedom of {}", found.nq, m.nq, found.nv, m.nv);
    line("sizes", same, &sizes);
    line("mass", off.mass < EXACT, &format!("{:.6} kg move, {:.1e} off", found.mass, off.mass));
    line("axes", off.axes < EXACT, &format!("joints' axes at most {:.1e} off", off.axes));
    line("inertia", off.inertia < EXACT, &format!("joint-space inertia at most {:.1e} off", off.inertia));
    if same && off.within(EXACT) {
        show_verdict(true, "", "passed", &format!(": {} becomes a world of rapier", m.name));
        return Ok(());
    }
    show_verdict(false, "", "failed", &format!(": the world of {} is not as its model", m.name));
    Err(Failure::silent(1))
}

/// A build without rapier has refused already.
#[cfg(not(feature = "rapier"))]
pub fn report(m: &Model) -> Result<(), Failure> {
    Err(Failure::new(format!("this build has no rapier to look at {} with", m.name)))
}
